//! Where and when the energy goes missing in a balance that does not close.

mod parts;

use std::fmt;

pub(super) use parts::within;
use parts::{Parts, count};
use thiserror::Error;

use super::ledger;
use crate::{Solution, wording::quantity};

/// Equal slices of the run that are balanced one by one, besides the instants of switches.
const SLICES: u32 = 128;
/// Part of the missing energy that the time span of a [`Leak`] holds at least.
const MOST: f64 = 0.5;

/// A place at which a balance is made up.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Place {
    /// An element, by name: the work done on its ends is not what it stores and dissipates.
    #[error("in the element `{0}`")]
    Element(String),
    /// An impact in an element, by name: the energy that it takes is not the one lost.
    #[error("in the impact in `{0}`")]
    Impact(String),
    /// The mass of a node, by name: the work of the forces on it is not its kinetic energy.
    #[error("at the mass `{0}`")]
    Node(String),
}

/// Where most of the energy goes missing, or comes from, in a balance that does not close.
#[derive(Debug, Clone, PartialEq)]
pub struct Leak {
    /// The shortest span of time \[s\] that holds half of the missing energy.
    pub window: (f64, f64),
    /// What has the largest part in it.
    pub place: Place,
    /// The energy \[J\] that goes missing there within the span; negative if it is too much.
    pub missing: f64,
    /// The momentum \[N s\] that the mass gains within the span beyond the impulse of all forces on
    /// it; `None` where the place is an element.
    pub momentum: Option<f64>,
}

impl fmt::Display for Leak {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { window: (from, to), place, .. } = self;
        if from < to {
            let (from, to) = (quantity(*from, "s"), quantity(*to, "s"));
            write!(f, "half of it from {from} to {to}, most of that {place}")?;
        } else {
            write!(f, "half of it at {}, most of that {place}", quantity(*from, "s"))?;
        }
        match self.momentum {
            Some(momentum) if momentum != 0.0 => {
                write!(f, ", whose momentum is off by {}", quantity(momentum, "N s"))
            }
            _ => Ok(()),
        }
    }
}

/// Where most of the energy goes missing; `None` where none does, or where only a part of the solution was kept.
///
/// Each slice of time is balanced for each part: for a mass the work of all forces on it against its
/// kinetic energy, for an element the work done on its ends against what it stores and dissipates,
/// and at each switch what jumps against the impulses. The sum over all is what the ledger misses.
pub fn leak(solution: &Solution<'_>) -> Option<Leak> {
    if solution.trajectory().digest().is_some() {
        return None;
    }
    let missing = ledger(solution, solution.end()).missing();
    if missing.is_nan() || missing == 0.0 {
        return None;
    }
    let sign = missing.signum();
    let times = times(solution);
    let all = Parts::balance(solution, &times, 0..count(&times));
    let totals: Vec<f64> = all.totals().iter().map(|total| sign * total).collect();
    let (from, to) = shortest_span(&totals, &times)?;
    let parts = Parts::balance(solution, &times, from..to + 1);
    let (place, missing, momentum) = parts.largest(sign)?;
    Some(Leak { window: (span(from, &times).0, span(to, &times).1), place, missing, momentum })
}

/// The borders of the slices: regular times, switches, and jumps of what drives the network.
fn times(solution: &Solution<'_>) -> Vec<f64> {
    let end = solution.end();
    let system = &solution.assembly().system;
    let jumps = system.breakpoints(end / system.time_scale).into_iter();
    let jumps = jumps.map(|time| time * system.time_scale);
    let switches = solution.trajectory().switches.iter().map(|switch| switch.time);
    let regular = (0..=SLICES).map(|at| end * f64::from(at) / f64::from(SLICES));
    let within = |time: &f64| (0.0..=end).contains(time);
    let mut times: Vec<f64> = regular.chain(switches.chain(jumps).filter(within)).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// The time span of a cell: slices have even numbers, the instants between them odd ones.
fn span(cell: usize, times: &[f64]) -> (f64, f64) {
    let at = |index: usize| times.get(index).copied().unwrap_or_default();
    (at(cell.div_ceil(2)), at(cell / 2 + 1))
}

/// The first and the last one of the cells that hold the wanted part of the sum in the shortest time.
fn shortest_span(totals: &[f64], times: &[f64]) -> Option<(usize, usize)> {
    let wanted = MOST * totals.iter().sum::<f64>();
    if wanted.is_nan() || wanted <= 0.0 {
        return None;
    }
    let mut best: Option<(f64, usize, usize)> = None;
    for first in 0..totals.len() {
        let mut sum = 0.0;
        for (last, total) in totals.iter().enumerate().skip(first) {
            sum += total;
            let length = span(last, times).1 - span(first, times).0;
            if best.is_some_and(|best| best.0 <= length) {
                break;
            }
            if sum >= wanted {
                best = Some((length, first, last));
                break;
            }
        }
    }
    best.map(|(_, first, last)| (first, last))
}

#[cfg(test)]
mod tests;
