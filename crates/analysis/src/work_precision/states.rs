//! The state of a run at dense times, and how far another run is from it.

use std::borrow::Cow;

use dashpot_dae::{LinearForm, System, Trajectory, UnknownKind};
use dashpot_network::Assembly;

use crate::{
    measures::{Family, selection::Selected},
    report::sample::regular_times,
};

/// Regular times at which states are compared.
const REGULAR: usize = 1001;
/// Times after the start and after each point where a driving function may jump, at equal ratios,
/// where quick transients lie.
const EARLY: usize = 61;
/// The earliest of them in parts of the run.
const EARLIEST: f64 = 1e-12;
/// Most points of this kind that are looked at closely.
const MOST_BREAKS: usize = 16;
/// Most events between which states are compared.
const MOST_EVENTS: usize = 2000;
/// Most numbers that are kept of a run; of large systems there are fewer times.
const MOST_NUMBERS: usize = 4_000_000;
/// Fewest times.
const FEWEST: usize = 33;
/// Part of the largest quantity of the same unit that a quantity is compared to at least: what is
/// smaller counts for nothing beside it.
const LEAST: f64 = 1e-6;
/// Part of the run next to a jump that counts as the jump.
const WIDTH: f64 = 1e-12;

/// The quantities that are compared.
pub(super) struct Probe<'a> {
    assembly: &'a Assembly,
    /// The system with an output for each of them.
    system: Cow<'a, System>,
    outputs: Vec<usize>,
    /// The differential unknowns that they are, by number; none where those are not the same all the time.
    unknowns: Vec<usize>,
}

/// Values of all quantities at all times.
pub(super) struct States {
    times: Vec<f64>,
    /// One row of times for each quantity.
    values: Vec<Vec<f64>>,
    /// What each quantity is compared to; 0 for one that is always zero.
    sizes: Vec<f64>,
    /// Bound of the relative error of any quantity, where each has one.
    pub(super) bound: Option<f64>,
}

impl<'a> Probe<'a> {
    /// The differential unknowns, or where those change, the outputs of whatever has a measure.
    pub(super) fn new(assembly: &'a Assembly, selected: &[Selected]) -> Self {
        if assembly.switching.is_some() {
            let (outputs, unknowns) = (outputs(assembly, selected), Vec::new());
            return Self { assembly, system: Cow::Borrowed(&assembly.system), outputs, unknowns };
        }
        let unknowns = assembly.system.unknowns.iter().enumerate();
        let differential = unknowns.filter(|(_, own)| own.kind == UnknownKind::Differential);
        let unknowns: Vec<usize> = differential.map(|(at, _)| at).collect();
        let first = assembly.system.outputs.len();
        let outputs = (first..first + unknowns.len()).collect();
        let system = Cow::Owned(with_outputs(&assembly.system, &unknowns));
        Self { assembly, system, outputs, unknowns }
    }

    /// The times at which runs until `end` \[s\] are compared; one of them lies between any two events,
    /// which happen at these times \[s\].
    fn times(&self, end: f64, events: &[f64]) -> Vec<f64> {
        let room = MOST_NUMBERS / self.outputs.len().max(1);
        let mut times = regular_times(end, REGULAR.min(room).max(FEWEST));
        if room > 2 * REGULAR {
            let scale = self.assembly.system.time_scale;
            let breaks = self.assembly.system.breakpoints(end / scale);
            let breaks = breaks.iter().map(|own| own * scale).take(MOST_BREAKS);
            let step = EARLIEST.ln() / (EARLY as f64);
            for from in std::iter::once(0.0).chain(breaks) {
                let after = (1..=EARLY).map(|at| from + end * (step * at as f64).exp());
                times.extend(after.filter(|time| *time < end));
            }
            let mut events: Vec<f64> = events.iter().copied().take(MOST_EVENTS).collect();
            events.sort_by(f64::total_cmp);
            times.extend(events.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
            times.sort_by(f64::total_cmp);
            times.dedup();
        }
        times
    }

    /// The quantities of a run with their sizes and bounds, to compare others with. `events` are the
    /// times of what happens in it \[s\].
    pub(super) fn states(&self, trajectory: &Trajectory, events: &[f64]) -> States {
        let times = self.times(trajectory.t_end, events);
        let (values, errors) = self.values(trajectory, &times);
        let largest: Vec<f64> = values
            .iter()
            .map(|row| row.iter().fold(0.0_f64, |most, own| most.max(own.abs())))
            .collect();
        let sizes = self.sizes(&largest);
        let parts = errors.iter().zip(&sizes).filter(|(_, size)| **size > 0.0);
        let parts: Option<Vec<f64>> = parts.map(|(own, size)| own.map(|own| own / size)).collect();
        let bound = parts.map(|all| all.into_iter().fold(0.0, f64::max));
        States { times, values, sizes, bound }
    }

    /// One row for each quantity, and bounds of their errors, where the method states them.
    fn values(&self, trajectory: &Trajectory, times: &[f64]) -> (Vec<Vec<f64>>, Vec<Option<f64>>) {
        if !self.unknowns.is_empty() && !is_exact(trajectory) {
            let system = &self.assembly.system;
            let scaled: Vec<f64> = times.iter().map(|time| time / system.time_scale).collect();
            let rows = trajectory.dense.sample(system, &scaled);
            let column = |&at: &usize| {
                let scale = system.unknowns[at].scale;
                rows.iter().skip(at).step_by(system.len()).map(|row| row * scale).collect()
            };
            return (self.unknowns.iter().map(column).collect(), vec![None; self.unknowns.len()]);
        }
        let signals = self.outputs.iter().map(|&at| {
            let signal = trajectory.signal(&self.system, at);
            (signal.sample(times), signal.error)
        });
        signals.unzip()
    }

    /// What each quantity is compared to.
    fn sizes(&self, largest: &[f64]) -> Vec<f64> {
        let unit = |at: usize| self.system.outputs.at(self.outputs[at]).unit;
        let of_unit = |wanted: &str| {
            let same = largest.iter().enumerate().filter(|(at, _)| unit(*at) == wanted);
            same.fold(0.0_f64, |most, own| most.max(*own.1))
        };
        let size = |(at, own): (usize, &f64)| own.max(LEAST * of_unit(unit(at)));
        largest.iter().enumerate().map(size).collect()
    }

    /// The largest relative difference between the true states and those of `run`, apart from the times between a jump
    /// in one and the same jump in the other, and from what lies beyond the end of either. `None` where nothing moves.
    pub(super) fn difference(
        &self,
        reference: &States,
        run: &Trajectory,
        jumps: &[(f64, f64)],
    ) -> Option<f64> {
        let (values, _) = self.values(run, &reference.times);
        let width = WIDTH * run.t_end;
        let is_at_jump =
            |time: f64| jumps.iter().any(|&(from, to)| time >= from - width && time <= to + width);
        let counts: Vec<bool> =
            reference.times.iter().map(|&time| time <= run.t_end && !is_at_jump(time)).collect();
        let rows = values.iter().zip(&reference.values).zip(&reference.sizes);
        let moving = rows.filter(|(_, size)| **size > 0.0);
        let off = |((run, reference), size): ((&Vec<f64>, &Vec<f64>), &f64)| {
            let pairs = run.iter().zip(reference).zip(&counts).filter(|(_, counts)| **counts);
            pairs.fold(0.0_f64, |most, ((run, reference), _)| most.max((run - reference).abs()))
                / size
        };
        moving.map(off).reduce(f64::max)
    }
}

fn is_exact(trajectory: &Trajectory) -> bool {
    dashpot_dae::methods::by_name(trajectory.method).is_some_and(|own| own.is_exact())
}

/// The system with an output for each of these unknowns, behind its own.
fn with_outputs(system: &System, numbers: &[usize]) -> System {
    let mut system = system.clone();
    for &at in numbers {
        let unknown = &system.unknowns[at];
        let (own, none) = (LinearForm::term(at, 1.0), LinearForm::zero());
        system.outputs.push(&unknown.name, unknown.unit, unknown.scale, &own, &none);
    }
    system
}

/// Position, velocity and acceleration, or deformation, rate and force, of whatever has a measure.
fn outputs(assembly: &Assembly, selected: &[Selected]) -> Vec<usize> {
    let of = |entry: &Selected| match entry.measure.applies_to() {
        Family::Node => {
            let node = &assembly.nodes[entry.target];
            [Some(node.position), node.velocity, node.acceleration]
        }
        Family::Element => {
            let connection = &assembly.connections[entry.target];
            [Some(connection.deformation), connection.rate, connection.force]
        }
    };
    let mut numbers: Vec<usize> = selected.iter().flat_map(of).flatten().collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}
