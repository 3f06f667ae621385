//! Large networks, of whose solutions only a part is kept.
//!
//! A solution of all unknowns at all steps would grow with the square of a network that takes more
//! steps the finer it is. Beyond [`LARGE`](crate::memory::LARGE) unknowns a run keeps the outputs that the measures may ask
//! for, and sums up the energies of everything else on the way.

use std::{collections::BTreeSet, sync::Arc};

use dashpot_dae::{Keep, Part};
use dashpot_network::{Assembly, ConnectionOutputs};

use crate::{
    energy::{ledger::does_work, roles::Accounts},
    impact::bodies,
    measures::{Family, selection::Selected},
    memory::is_large,
};

/// Pads beyond which nobody looks whether one of them is pressed in too far.
const MOST_PADS: usize = 100;

/// What a run keeps whose measures are `selected`: all outputs of their targets and of all impactors,
/// and of what these touch.
pub(crate) fn keep(assembly: &Assembly, selected: &[Selected]) -> Keep {
    match products(assembly) {
        Some(products) if is_large(assembly) => Keep::Part(Arc::new(Part {
            outputs: outputs(assembly, selected).into_iter().collect(),
            products,
            jumps: jumps(assembly),
        })),
        _ => Keep::Everything,
    }
}

/// The same with more outputs.
pub(crate) fn keep_also(keep: &Keep, outputs: &BTreeSet<usize>) -> Keep {
    match keep {
        Keep::Everything => Keep::Everything,
        Keep::Part(part) => {
            let all = part.outputs.iter().chain(outputs).copied().collect();
            Keep::Part(Arc::new(Part { outputs: all, ..part.as_ref().clone() }))
        }
    }
}

/// Force and rate of all parts that dissipate, then force and velocity of all drives; `None` where a
/// rate is not among the outputs.
fn products(assembly: &Assembly) -> Option<Vec<[usize; 2]>> {
    let parts = assembly.primitives.iter();
    let parts = parts
        .filter(|part| Accounts::of(part.element.as_ref()).dissipates && does_work(part))
        .map(|part| Some([part.force, part.rate?]));
    let drives = assembly.drives.iter().map(|drive| Some([drive.force, drive.velocity?]));
    parts.chain(drives).collect()
}

/// The deformations of all springs, where anything jumps.
fn jumps(assembly: &Assembly) -> Vec<usize> {
    if assembly.system.breakpoints(f64::INFINITY).is_empty() {
        return Vec::new();
    }
    let springs = assembly.primitives.iter();
    let springs = springs.filter(|spring| Accounts::of(spring.element.as_ref()).stores);
    springs.map(|spring| spring.deformation).collect()
}

fn outputs(assembly: &Assembly, selected: &[Selected]) -> BTreeSet<usize> {
    let mut wanted = bodies::with_impactor(assembly);
    let mut elements = BTreeSet::new();
    for own in selected {
        match own.measure.applies_to() {
            Family::Node => wanted[assembly.nodes[own.target].body] = true,
            Family::Element => {
                elements.insert(own.target);
            }
        }
    }
    let pads = || assembly.connections.iter().filter(|connection| !connection.segments.is_empty());
    let all_pads = pads().count() <= MOST_PADS;
    for (at, own) in assembly.connections.iter().enumerate() {
        let is_pad = all_pads && !own.segments.is_empty();
        if is_pad || bodies::between(assembly, own).iter().any(|&body| wanted[body]) {
            elements.insert(at);
        }
    }
    let mut found = BTreeSet::new();
    for own in elements.into_iter().filter_map(|at| assembly.connections.get(at)) {
        found.extend(of_element(assembly, own));
        bodies::between(assembly, own).into_iter().for_each(|body| wanted[body] = true);
    }
    for node in assembly.nodes.iter().filter(|node| wanted[node.body]) {
        found.extend([Some(node.position), node.velocity, node.acceleration].into_iter().flatten());
    }
    found
}

fn of_element(assembly: &Assembly, connection_outputs: &ConnectionOutputs) -> Vec<usize> {
    let mut found = vec![connection_outputs.deformation];
    found.extend(
        [connection_outputs.force, connection_outputs.transmitted, connection_outputs.rate]
            .into_iter()
            .flatten(),
    );
    for segment in &connection_outputs.segments {
        found.push(segment.deformation);
        found.extend(segment.force);
    }
    for part in assembly.primitives.get(connection_outputs.primitives.clone()).unwrap_or_default() {
        found.extend([part.force, part.deformation]);
        found.extend(part.rate);
    }
    found
}
