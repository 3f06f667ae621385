//! The fewest branches that keep a stated error: neighbours are merged, and what remains is refined.

use nalgebra::DVector;

use super::{floor::Misfit, problem::Problem, record::Form, spectrum::Spectrum};

/// Steps of refinement behind each merger, and where they do not suffice.
const FEW_STEPS: usize = 5;
const MANY_STEPS: usize = 60;
/// A refinement has settled where a step wins less than this part.
const COARSE: f64 = 1e-3;
const FINE: f64 = 1e-6;
/// So many mergers are tried before there is none.
const TRIALS: usize = 3;

/// In place of the number of a branch: one becomes a spring.
const SPRING: usize = usize::MAX;

/// What the error of a few branches is an error of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Against {
    /// The rows.
    Data,
    /// The curve of the nearest passive network, because that is further from the rows itself.
    Floor,
}

/// The fewest branches.
#[derive(Debug, Clone)]
pub(super) struct Fewest {
    pub(super) spectrum: Spectrum,
    pub(super) residual: DVector<f64>,
    pub(super) against: Against,
    /// Whether the stated error is kept.
    pub(super) is_kept: bool,
}

/// The fewest branches within the part `stated` of the rows or, where the floor is not so near to them, of its
/// curve; `floor` is what the nearest network leaves of them.
pub(super) fn fewest(
    problem: &Problem,
    start: Spectrum,
    floor: &DVector<f64>,
    stated: f64,
) -> Fewest {
    let against =
        if Misfit::of_vector(floor).largest <= stated { Against::Data } else { Against::Floor };
    let off = |residual: &DVector<f64>| match against {
        Against::Data => Misfit::of_vector(residual).largest,
        Against::Floor => Misfit::of_vector(&(residual - floor)).largest,
    };
    let mut best = start;
    let mut residual = best.residual(problem);
    let is_kept = off(&residual) <= stated;
    while let Some((next, left)) = fewer(problem, &best, |left| off(left) <= stated) {
        (best, residual) = (next, left);
    }
    let mut settled = best.clone();
    let left = settled.refine(problem, MANY_STEPS, FINE);
    if off(&left) <= stated || !is_kept {
        (best, residual) = (settled, left);
    }
    // In parallel it stiffens without bound what is faster than the rows: none where the error is kept without.
    if problem.form == Form::Maxwell && best.dashpot > 0.0 {
        let mut without = Spectrum { dashpot: 0.0, ..best.clone() };
        let left = without.refine(problem, MANY_STEPS, FINE);
        if off(&left) <= stated {
            (best, residual) = (without, left);
        }
    }
    Fewest { spectrum: best, residual, against, is_kept }
}

/// The spectrum with one branch less that is good enough; `None` where there is none.
fn fewer(
    problem: &Problem,
    spectrum: &Spectrum,
    is_good: impl Fn(&DVector<f64>) -> bool,
) -> Option<(Spectrum, DVector<f64>)> {
    let mut trials = Vec::new();
    for mut merged in mergers(spectrum, problem).into_iter().take(TRIALS) {
        let left = merged.refine(problem, FEW_STEPS, COARSE);
        if is_good(&left) {
            return Some((merged, left));
        }
        trials.push((left.norm(), merged));
    }
    let (_, mut nearest) = trials.into_iter().min_by(|one, other| one.0.total_cmp(&other.0))?;
    let left = nearest.refine(problem, MANY_STEPS, COARSE * COARSE);
    is_good(&left).then_some((nearest, left))
}

/// Spectra with one branch less, by how little that changes: neighbours as one, the slowest Maxwell element or the
/// fastest Kelvin–Voigt element as a spring.
fn mergers(spectrum: &Spectrum, problem: &Problem) -> Vec<Spectrum> {
    let (all, form) = (&spectrum.branches, problem.form);
    let level = |time: f64| spectrum.at(form, time);
    let mut costs: Vec<(f64, usize)> = (1..all.len())
        .map(|at| {
            let [(one, first), (other, second)] = [all[at - 1], all[at]];
            let apart = (other / one).ln();
            let both = first * second / (first + second);
            (both * apart * apart / level((one * other).sqrt()), at)
        })
        .collect();
    let (end, at) = match form {
        Form::Maxwell => (problem.range.1, all.len().saturating_sub(1)),
        Form::Kelvin => (problem.range.0, 0),
    };
    costs.extend(all.get(at).map(|&(time, strength)| {
        let late =
            if form == Form::Maxwell { -(-end / time).exp_m1() } else { (-end / time).exp() };
        (strength * late * late / level(end), SPRING)
    }));
    costs.sort_by(|one, other| one.0.total_cmp(&other.0));
    let merged = |(_, to): (f64, usize)| {
        let mut own = spectrum.clone();
        if to == SPRING {
            own.spring += own.branches.remove(at).1;
            return own;
        }
        let at = to;
        let (time, strength) = own.branches.remove(at);
        let before = &mut own.branches[at - 1];
        let sum = before.1 + strength;
        *before = (((before.1 * before.0.ln() + strength * time.ln()) / sum).exp(), sum);
        own
    };
    costs.into_iter().map(merged).collect()
}
