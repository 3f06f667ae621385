//! How well the times are known at which something happens.

use std::collections::HashMap;

use dashpot_dae::{Run, Trajectory};

use super::{
    accuracy::{Evidence, SOLUTIONS, rounding},
    solved::Solved,
};
use crate::{Reading, Solution};

/// Roundings of a time that is found by itself.
const ROUNDINGS: f64 = 4.0;
/// What moves by less than this many times its error in a panel stands still.
const STILL: f64 = 16.0;

/// Errors of the times \[s\] of a solution's events; `None` where nothing is known of one, infinite where it comes and
/// goes with the tolerance.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Instants {
    /// Of what switches, in the order of [`Trajectory::switches`].
    pub(crate) switches: Vec<Option<f64>>,
    /// Of the conditions that are met, in the order of [`Trajectory::events`].
    pub(crate) crossings: Vec<Option<f64>>,
}

/// A kind of event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum What<'a> {
    /// A part enters a phase.
    Switches(&'a str, &'static str),
    /// The output of a guard crosses its level, rising or not.
    Crosses(usize, bool),
}

/// A kind of event, and how many of the kind there are up to it.
type Place<'a> = (What<'a>, usize);

impl Instants {
    /// Nothing is known of any.
    pub(crate) fn unknown(trajectory: &Trajectory) -> Self {
        Self {
            switches: vec![None; trajectory.switches.len()],
            crossings: vec![None; trajectory.events.len()],
        }
    }

    /// Those of the last of some solutions, as the errors of measures are told from their differences; `fall` is the
    /// power of the tolerance with which the method's errors fall. An event is the same in all of them where it is
    /// as many of its kind into the run.
    pub(crate) fn of_solutions(solved: &[Solved], fall: f64) -> Option<Self> {
        let finest = &solved.last()?.trajectory;
        if solved.len() < SOLUTIONS {
            return Some(Self::unknown(finest));
        }
        let places = all(finest);
        let read = |own: &Solved| -> (f64, Vec<Reading>) {
            let found: HashMap<Place<'_>, f64> = all(&own.trajectory).into_iter().collect();
            let reading = |(place, time): &(Place<'_>, f64)| Reading {
                value: found.get(place).copied(),
                size: *time,
                ..Reading::default()
            };
            (own.rtol, places.iter().map(reading).collect())
        };
        let readings: Vec<(f64, Vec<Reading>)> = solved.iter().map(read).collect();
        let (finest, others) = readings.split_last()?;
        let evidence = Evidence {
            others: others.iter().map(|own| (own.0, own.1.as_slice())).collect(),
            finest: (finest.0, &finest.1),
            least: vec![0.0; places.len()],
            fall,
        };
        let mut switches = evidence.error_bars();
        let crossings = switches.split_off(solved.last()?.trajectory.switches.len());
        Some(Self { switches, crossings })
    }

    /// Those of a solution whose signals have bounds: an output that is off by its bound meets its level so much
    /// earlier or later as its slope tells. What switches watches its part's force, deformation or rate; the
    /// slowest of them that moves counts.
    pub(crate) fn bounded(run: &Run, solution: &Solution<'_>) -> Self {
        let (assembly, trajectory) = (solution.assembly(), solution.trajectory());
        let shift = |output: usize, time: f64| {
            if !solution.keeps(output) {
                return None;
            }
            let signal = solution.signal(output);
            let before = signal.panels.partition_point(|panel| panel.end < time);
            let panel = signal.panels.get(before)?;
            let (slope, error) = (panel.slope(time).abs(), signal.error?);
            // What stands still meets no level: the force of what slides, the deformation where it turns or is held.
            (slope * panel.length() > STILL * error).then(|| error / slope)
        };
        let rounded = |shift: Option<f64>, time: f64| {
            let reading = Reading { size: time, ..Reading::default() };
            let rounding = rounding(&reading).max(ROUNDINGS * f64::EPSILON * time);
            shift.map(|shift| shift.min(trajectory.t_end) + rounding)
        };
        let switches = trajectory.switches.iter().map(|own| {
            if own.time <= 0.0 {
                return Some(0.0);
            }
            let part = assembly.primitives.iter().find(|part| *part.name == *own.name)?;
            let watched = [Some(part.force), Some(part.deformation), part.rate];
            let shifts = watched.into_iter().flatten().filter_map(|at| shift(at, own.time));
            rounded(shifts.reduce(f64::max), own.time)
        });
        let crossings = trajectory.events.iter().map(|own| {
            let output = run.guards.get(own.guard)?.output;
            rounded(shift(output, own.time), own.time)
        });
        Self { switches: switches.collect(), crossings: crossings.collect() }
    }
}

/// All that switches, then all conditions that are met, each with its time \[s\].
fn all(trajectory: &Trajectory) -> Vec<(Place<'_>, f64)> {
    let switches = trajectory.switches.iter();
    let switches = switches.map(|own| (What::Switches(&own.name, own.what), own.time));
    let crossings = trajectory.events.iter();
    let crossings = crossings.map(|own| (What::Crosses(own.guard, own.rising), own.time));
    let mut counts: HashMap<What<'_>, usize> = HashMap::new();
    let placed = switches.chain(crossings).map(|(what, time)| {
        let count = counts.entry(what).or_default();
        *count += 1;
        ((what, *count), time)
    });
    placed.collect()
}
