//! Where the energy of a run comes from and where it goes.

mod digested;
mod leak;
mod series;

use std::{collections::BTreeMap, ops::Range};

use dashpot_dae::Signal;
use dashpot_network::{
    Assembly, PrimitiveOutputs,
    elements::Law,
    phases::{Phase, PhaseLaw},
};
pub use leak::{Leak, Place, leak};
pub use series::{EnergySeries, energy_series};

use crate::{
    Solution,
    energy::roles::{self, EnergyRole},
};

/// The energy balance from the start of a run until a time.
///
/// `start + work in = kinetic + stored + dissipated + missing`.
#[derive(Debug, Clone, PartialEq)]
pub struct Ledger {
    /// Until when \[s\].
    pub time: f64,
    /// Kinetic and stored energy at the start \[J\].
    pub start: f64,
    /// Kinetic energy of all masses \[J\].
    pub kinetic: f64,
    /// What of it the masses of layers have \[J\], by element.
    pub in_layers: Vec<(String, f64)>,
    /// Energy stored in each spring \[J\], by path.
    pub stored: Vec<(String, f64)>,
    /// Energy dissipated in each dashpot \[J\], by path.
    pub dissipated: Vec<(String, f64)>,
    /// Work done by each drive (load, weight, prescribed motion) \[J\].
    pub work_in: Vec<(String, f64)>,
    /// The largest amount of energy that was in play \[J\].
    pub turned_over: f64,
    /// Bound of the error of the balance \[J\], where the method bounds that of its signals.
    pub error: Option<f64>,
}

impl Ledger {
    /// Part of the energy turned over beyond which a balance that does not close fails the run.
    pub(crate) const MOST_LOST: f64 = 0.01;

    /// All work done from outside \[J\].
    pub fn total_work_in(&self) -> f64 {
        total(&self.work_in)
    }

    /// All energy stored \[J\].
    pub fn total_stored(&self) -> f64 {
        total(&self.stored)
    }

    /// All energy dissipated \[J\].
    pub fn total_dissipated(&self) -> f64 {
        total(&self.dissipated)
    }

    /// Adds up the entries of single parts, of which there are many in a large network; it no longer
    /// belongs to its assembly then.
    pub(crate) fn gather_parts(&mut self) {
        for parts in [&mut self.stored, &mut self.dissipated] {
            *parts = vec![("all parts".to_owned(), total(parts))];
        }
    }

    /// Energy stored and dissipated in each element \[J\]: its name and the sums over its parts, in
    /// the order of `assembly`, to which the ledger belongs.
    pub fn by_element<'a>(&self, assembly: &'a Assembly) -> Vec<(&'a str, f64, f64)> {
        let mut stored = self.stored.iter().map(|entry| entry.1);
        let mut dissipated = self.dissipated.iter().map(|entry| entry.1);
        let sums = assembly.connections.iter().map(|connection| {
            let mut sum = (connection.name.as_str(), 0.0, 0.0);
            for primitive in assembly.primitives.get(connection.primitives.clone()).unwrap_or(&[]) {
                let own = EnergyRole::of(primitive.element.as_ref());
                if own.stores {
                    sum.1 += stored.next().unwrap_or(0.0);
                }
                if own.dissipates {
                    sum.2 += dissipated.next().unwrap_or(0.0);
                }
            }
            sum
        });
        sums.collect()
    }

    /// The energy that is missing \[J\]; negative if there is too much.
    pub fn missing(&self) -> f64 {
        self.start + self.total_work_in()
            - (self.kinetic + self.total_stored() + self.total_dissipated())
    }

    /// The missing energy in parts of the energy turned over; 0 where nothing happens, not a number where one
    /// of the energies is none.
    pub fn closure(&self) -> f64 {
        let missing = self.missing();
        if self.turned_over > 0.0 || missing.is_nan() { missing / self.turned_over } else { 0.0 }
    }
}

fn total(entries: &[(String, f64)]) -> f64 {
    entries.iter().map(|entry| entry.1).sum()
}

/// Name of the work that loads and motions do where they jump.
const STEPS: &str = "jumps of loads and motions";

/// Name of the work that moving supports do in impacts.
const IMPACTS: &str = "impacts of moving supports";

/// The energy \[J\] that impacts at the very start lose, before any velocity is reported, and the
/// work that moving supports do in impacts.
fn at_impacts(solution: &Solution<'_>, window: (f64, f64)) -> (f64, f64) {
    let switches = solution.trajectory().switches.iter();
    let own = switches.filter(|switch| switch.impulse > 0.0 && switch.time <= window.1);
    own.fold((0.0, 0.0), |(struck, worked), own| {
        let at_start = if own.time <= 0.0 { own.lost - own.worked } else { 0.0 };
        (struck + at_start, worked + own.worked)
    })
}

/// The energy balance of `solution` until `time` \[s\], by quadrature that is exact for its polynomials.
///
/// Dashpots dissipate `∫ F ẏ dt`; springs store the energy of their deformation. Where a load or a
/// prescribed motion jumps, the work done is the jump of the stored energy.
///
/// Of a run that has kept a part of its outputs only, the balance is known at its end; at any other
/// time its energies are not numbers.
pub fn ledger(solution: &Solution<'_>, time: f64) -> Ledger {
    let assembly = solution.assembly();
    if let Some(digest) = solution.trajectory().digest()
        && time >= solution.end()
    {
        return digested::ledger(assembly, digest, time);
    }
    let window = (0.0, time);
    let mut balance = Balance::default();
    let (mut start, mut kinetic) = (0.0, 0.0);
    let mut of_nodes = Vec::new();
    for (at, node) in assembly.nodes.iter().enumerate().filter(|own| own.1.mass > 0.0) {
        let Some(velocity) = node.velocity else { continue };
        let velocity = solution.glance(velocity);
        let energy = |v: f64| 0.5 * node.mass * v * v;
        let last = velocity.value(time);
        start += energy(velocity.value(0.0));
        kinetic += energy(last);
        of_nodes.push((at, energy(last)));
        balance.add_error(velocity.error.map(|error| node.mass * error * (last.abs() + error)));
    }
    let (mut stored, mut dissipated) = (Vec::new(), Vec::new());
    for primitive in &assembly.primitives {
        let own = EnergyRole::of(primitive.element.as_ref());
        let mut gained = 0.0;
        if own.stores {
            let deformation = solution.glance(primitive.deformation);
            let last = deformation.left_value(time);
            let first = deformation.value(0.0);
            let at_start = roles::stored(solution.run(), primitive, 0.0, first);
            let at_end = roles::stored(solution.run(), primitive, time, last);
            start += at_start;
            gained = at_end - at_start;
            stored.push((primitive.name.to_string(), at_end));
            let slope = |y: f64| primitive.element.tangent(y, 0.0).stiffness.abs();
            let stiffness = slope(last);
            let bound = |error: f64| stiffness * error * (last.abs() + error);
            balance.add_error(deformation.error.map(bound));
        }
        if own.dissipates {
            let energy = dissipation(solution, primitive, window, &mut balance) - gained;
            dissipated.push((primitive.name.to_string(), energy));
        }
    }
    let mut work_in: Vec<(String, f64)> = assembly
        .drives
        .iter()
        .map(|drive| {
            let velocity = solution.rate(drive.velocity, assembly.nodes[drive.node].position);
            (drive.name.clone(), balance.work(&solution.glance(drive.force), &velocity, window))
        })
        .collect();
    let (struck, worked) = at_impacts(solution, window);
    start += struck;
    if worked != 0.0 {
        work_in.push((IMPACTS.to_owned(), worked));
    }
    let steps = steps(solution, 0..assembly.primitives.len(), window);
    if steps != 0.0 {
        work_in.push((STEPS.to_owned(), steps));
    }
    let supplied = start + work_in.iter().map(|entry| entry.1.max(0.0)).sum::<f64>();
    let kept = kinetic + total(&stored) + total(&dissipated);
    let turned_over = if assembly.drives.is_empty() {
        supplied.max(kept)
    } else {
        supplied.max(kept).max(most_in_one_place(solution, window))
    };
    Ledger {
        time,
        start,
        kinetic,
        in_layers: in_layers(assembly, &of_nodes),
        stored,
        dissipated,
        work_in,
        turned_over,
        error: balance.error(),
    }
}

/// What masses of layers have of the kinetic energies \[J\] of nodes, by element.
fn in_layers(assembly: &Assembly, kinetic: &[(usize, f64)]) -> Vec<(String, f64)> {
    let elements = leak::within(assembly);
    let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
    for (node, energy) in kinetic {
        if let Some(&element) = elements.get(&assembly.nodes[*node].body) {
            *sums.entry(element).or_default() += energy;
        }
    }
    sums.into_iter().map(|(at, sum)| (assembly.connections[at].name.clone(), sum)).collect()
}

/// The work \[J\] done on a part within the window, with what impacts in it lose.
fn dissipation(
    solution: &Solution<'_>,
    primitive: &PrimitiveOutputs,
    window: (f64, f64),
    balance: &mut Balance,
) -> f64 {
    let force = &solution.glance(primitive.force);
    let rate = &solution.rate(primitive.rate, primitive.deformation);
    let lost = roles::lost_in_impacts(solution.trajectory(), primitive, window);
    if !does_work(primitive) {
        return lost;
    }
    balance.work(force, rate, window) + lost
}

/// Whether the force of a part can do work: that of a contact cannot.
pub(crate) fn does_work(primitive: &PrimitiveOutputs) -> bool {
    primitive.element.law() != Law::Phased
        || primitive.element.phases().is_some_and(|own| {
            (0..own.names().len()).any(|index| {
                matches!(
                    own.law(Phase { index, memory: 0.0 }),
                    PhaseLaw::Element(_) | PhaseLaw::Force(_)
                )
            })
        })
}

/// The largest energy \[J\] that any one mass or spring holds within the window: what is driven may
/// come to rest again with all energy given back. Where neither holds any it is that of a part that switches.
fn most_in_one_place(solution: &Solution<'_>, window: (f64, f64)) -> f64 {
    let assembly = solution.assembly();
    let largest = |output: usize| solution.glance(output).absolute_maximum(window).value;
    let masses = assembly.nodes.iter().filter(|node| node.mass > 0.0).filter_map(|node| {
        let fastest = largest(node.velocity?);
        Some(0.5 * node.mass * fastest * fastest)
    });
    let springs =
        assembly.primitives.iter().filter_map(|primitive| match primitive.element.law() {
            Law::Spring(_) | Law::Nonlinear { .. } => {
                Some(primitive.element.stored(largest(primitive.deformation)))
            }
            _ => None,
        });
    let most = masses.chain(springs).fold(0.0, f64::max);
    if most > 0.0 {
        return most;
    }
    let storing = assembly.primitives.iter().filter(|own| {
        own.element.law() == Law::Phased && EnergyRole::of(own.element.as_ref()).stores
    });
    let held = storing.map(|primitive| {
        let deformation = solution.glance(primitive.deformation);
        let time = deformation.absolute_maximum(window).time;
        roles::stored(solution.run(), primitive, time, deformation.left_value(time))
    });
    held.fold(0.0, f64::max)
}

/// Adds up the errors of a balance.
#[derive(Debug, Default)]
struct Balance {
    error: f64,
    unbounded: bool,
}

impl Balance {
    fn add_error(&mut self, error: Option<f64>) {
        match error {
            Some(error) => self.error += error,
            None => self.unbounded = true,
        }
    }

    /// `∫ force · velocity dt`.
    fn work(&mut self, force: &Signal, velocity: &Signal, window: (f64, f64)) -> f64 {
        self.add_error(work_error(force, velocity, window));
        force.integral_of_product(velocity, window)
    }

    fn error(&self) -> Option<f64> {
        (!self.unbounded).then_some(self.error)
    }
}

/// Bound of the error \[J\] of `∫ force · velocity dt`, where both signals have one:
/// `∫ |F| dt · e(v) + ∫ |v| dt · e(F)` and the product of the errors.
pub(crate) fn work_error(force: &Signal, velocity: &Signal, window: (f64, f64)) -> Option<f64> {
    let (of_force, of_velocity) = force.error.zip(velocity.error)?;
    let area = |signal: &Signal| signal.area_bound(window);
    let both = (window.1 - window.0) * of_force * of_velocity;
    Some(area(force) * of_velocity + area(velocity) * of_force + both)
}

/// The energy \[J\] that these primitives take up in no time where driving functions jump within
/// the window, its begin excluded.
pub(crate) fn steps(solution: &Solution<'_>, primitives: Range<usize>, window: (f64, f64)) -> f64 {
    let assembly = solution.assembly();
    let system = &assembly.system;
    let end = window.1 / system.time_scale;
    let times = system.breakpoints(end).into_iter().map(|time| time * system.time_scale);
    let times: Vec<f64> = times.filter(|&time| time > window.0).collect();
    if times.is_empty() {
        return 0.0;
    }
    let springs = assembly.primitives.get(primitives).unwrap_or_default().iter();
    let springs = springs.filter(|primitive| {
        let own = EnergyRole::of(primitive.element.as_ref());
        own.stores && (!own.dissipates || primitive.element.law() != Law::Phased)
    });
    springs
        .map(|primitive| {
            let deformation = solution.glance(primitive.deformation);
            let energy = |y: f64| primitive.element.stored(y);
            let taken = times.iter().filter_map(|&time| jump(&deformation, time));
            taken.map(|(before, after)| energy(after) - energy(before)).sum::<f64>()
        })
        .sum()
}

/// The values on both sides of a border of panels at `time`, if they differ beyond the noise.
fn jump(signal: &Signal, time: f64) -> Option<(f64, f64)> {
    let rounding = 1e-12 * signal.end().abs();
    let after = signal.panels.partition_point(|panel| panel.start < time - rounding);
    let (left, right) = (signal.panels.get(after.checked_sub(1)?)?, signal.panels.get(after)?);
    if (right.start - time).abs() > rounding {
        return None;
    }
    let values = (left.value(left.end), right.value(right.start));
    ((values.1 - values.0).abs() > signal.noise).then_some(values)
}

#[cfg(test)]
mod tests;
