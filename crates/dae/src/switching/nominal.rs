//! Sizes of unknowns in legs that see little of them.
//!
//! Scales are made for a whole run: what a weight could do in all of it may be 10⁹ times what a gap leaves
//! it. A method that follows places to its tolerance of such a scale knows nothing of when the gap closes.
//! A leg in which a guard's output stays that small is solved once more, with sizes of its own.

use super::Leg;
use crate::{Dense, Run, System, Trajectory, UnknownKind, pieces::ROUNDING};

/// An output that has strayed from its level by less than this part of what tolerances are made for is
/// solved for again.
const SMALL: f64 = 1e-3;
/// Least size of what balances determine, which they do no better than to roundings of what they balance.
const LEAST_BALANCED: f64 = 1e-5;
/// Least size of all others.
const LEAST: f64 = 1e-20;

/// The sizes with which a leg is to be solved again; `None` where those of the `run` have done.
pub(super) fn smaller(leg: &Leg, run: &Run, trajectory: &Trajectory) -> Option<Vec<f64>> {
    let system = leg.system.as_ref();
    let before = |unknown: usize| run.nominal.get(unknown).copied().unwrap_or(1.0);
    let mut found: Option<Vec<f64>> = None;
    for guard in &leg.guards {
        let output = system.outputs.at(guard.output);
        let scale = output.scale.abs();
        let terms = || output.unknowns.terms().map(|(at, factor)| (at, scale * factor.abs()));
        let unit: f64 = terms().map(|(at, factor)| factor * before(at)).sum();
        let held = held(trajectory.dense.as_ref(), system, guard.output, guard.level);
        if !(held > 0.0 && held < SMALL * unit) {
            continue;
        }
        let sizes = found.get_or_insert_with(|| (0..system.len()).map(before).collect());
        for (at, factor) in terms() {
            let least = match system.unknowns[at].kind {
                UnknownKind::Algebraic => LEAST_BALANCED,
                UnknownKind::Differential => LEAST,
            };
            sizes[at] = sizes[at].min((held / factor).max(least));
        }
    }
    found.filter(|sizes| sizes.iter().enumerate().any(|(at, &own)| own < SMALL * before(at)))
}

/// The most that an output has strayed from its level, or had to be summed up of.
fn held(dense: &dyn Dense, system: &System, output: usize, level: f64) -> f64 {
    let signal = dense.signal(system, output);
    let terms = signal.noise / (ROUNDING * f64::EPSILON);
    let gap = |coefficients: &[f64]| {
        let (constant, rest) = coefficients.split_first().unwrap_or((&0.0, &[]));
        (constant - level).abs() + rest.iter().map(|own| own.abs()).sum::<f64>()
    };
    signal.panels.iter().map(|panel| gap(&panel.coefficients)).fold(terms, f64::max)
}
