//! The balance of a run that was summed up on the way.

use std::collections::HashMap;

use dashpot_dae::{Digest, Product};
use dashpot_network::Assembly;

use super::{Ledger, STEPS, does_work, in_layers, total};
use crate::energy::roles::EnergyRole;

/// The energy balance at the end of a run of `end` \[s\], of which `digest` tells the values at both
/// ends, and force times rate of all parts that dissipate and then of all drives.
///
/// What was in play at most is told by the work of the drives: nothing holds more than was put in.
pub(super) fn ledger(assembly: &Assembly, digest: &Digest, end: f64) -> Ledger {
    let system = &assembly.system;
    let mut products = digest.products.iter().copied();
    let mut next = || products.next().unwrap_or(Product { total: f64::NAN, largest: f64::NAN });
    let (mut start, mut kinetic) = (0.0, 0.0);
    let mut of_nodes = Vec::new();
    for (at, node) in assembly.nodes.iter().enumerate().filter(|own| own.1.mass > 0.0) {
        let Some(velocity) = node.velocity else { continue };
        let [first, last] = digest.ends(system, velocity).map(|v| 0.5 * node.mass * v * v);
        start += first;
        kinetic += last;
        of_nodes.push((at, last));
    }
    let (mut stored, mut dissipated) = (Vec::new(), Vec::new());
    for primitive in &assembly.primitives {
        let own = EnergyRole::of(primitive.element.as_ref());
        let mut gained = 0.0;
        if own.stores {
            let ends = digest.ends(system, primitive.deformation);
            let [first, last] = ends.map(|deformation| primitive.element.stored(deformation));
            start += first;
            gained = last - first;
            stored.push((primitive.name.to_string(), last));
        }
        if own.dissipates {
            let work = if does_work(primitive) { next().total } else { 0.0 };
            dissipated.push((primitive.name.to_string(), work - gained));
        }
    }
    let mut most = 0.0;
    let mut work_in: Vec<(String, f64)> = Vec::with_capacity(assembly.drives.len());
    for drive in &assembly.drives {
        let work = next();
        most += work.largest;
        work_in.push((drive.name.clone(), work.total));
    }
    let jumps = jumps(assembly, digest);
    if jumps != 0.0 {
        work_in.push((STEPS.to_owned(), jumps));
    }
    let supplied = start + work_in.iter().map(|entry| entry.1.max(0.0)).sum::<f64>();
    let kept = kinetic + total(&stored) + total(&dissipated);
    let turned_over = supplied.max(kept).max(start + most);
    let in_layers = in_layers(assembly, &of_nodes);
    let error = None;
    Ledger { time: end, start, kinetic, in_layers, stored, dissipated, work_in, turned_over, error }
}

/// The energy \[J\] that springs take up in no time.
fn jumps(assembly: &Assembly, digest: &Digest) -> f64 {
    if digest.jumps.is_empty() {
        return 0.0;
    }
    let springs = assembly
        .primitives
        .iter()
        .filter(|primitive| EnergyRole::of(primitive.element.as_ref()).stores);
    let mut by_output: HashMap<usize, Vec<_>> = HashMap::new();
    for spring in springs {
        by_output.entry(spring.deformation).or_default().push(&spring.element);
    }
    let taken = digest.jumps.iter().map(|jump| {
        let springs = by_output.get(&jump.output).map_or(&[][..], Vec::as_slice);
        springs
            .iter()
            .map(|spring| spring.stored(jump.after) - spring.stored(jump.before))
            .sum::<f64>()
    });
    taken.sum()
}
