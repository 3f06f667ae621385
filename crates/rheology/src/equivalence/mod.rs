//! Whether two linear models are the same, decided on their poles and strengths.
//!
//! All terms of the relaxance on the imaginary axis lie in one quadrant, so they cannot cancel: if
//! all rates and strengths of two Maxwell forms agree within `ε`, relatively, their complex
//! stiffnesses agree within `2√2 ε` at every frequency. The same goes for the Kelvin forms and the
//! complex compliances, so agreement in one form is enough. Modes that are nearer to each other than
//! [`TOGETHER_WITHIN`] may be compared as one, with an error of its square: what conversion and
//! rounding do to nearly equal times does not make another model.

mod disagreement;

use dashpot_numerics::DoubleDouble;
pub use disagreement::Disagreement;

use crate::{
    LinearModel,
    linear::{Fractions, Line},
};

/// Two models are the same when all rates and strengths of one form agree within this, relatively.
pub const SAME_WITHIN: f64 = 1e-11;

/// Modes whose rates differ by less, relatively, may be compared by their sums. As one mode with the
/// same sum of strengths and of strengths over rates they answer alike within the square of this.
pub const TOGETHER_WITHIN: f64 = 1e-6;

/// Two constants that take the same place in two models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    /// Constant of the first model; 0 where it has none.
    pub first: f64,
    /// Constant of the second model; 0 where it has none.
    pub second: f64,
    /// Their difference over the larger one.
    pub difference: f64,
}

/// A mode of each of two models; one of them may be missing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModePair {
    /// Relaxation or retardation times \[s\].
    pub time: Pair,
    /// Stiffnesses of Maxwell elements \[N/m\], or compliances of Kelvin–Voigt elements \[m/N\].
    pub strength: Pair,
}

/// The constants of two models in one of the canonical forms.
#[derive(Debug, Clone, PartialEq)]
pub struct FormComparison {
    /// What stands alone and bears a load for good: stiffnesses \[N/m\] of the springs of the
    /// Maxwell forms, or fluidities \[m/(N s)\] of the dashpots of the Kelvin forms.
    pub at_long_times: Pair,
    /// What stands alone and shows at once: dampings \[N s/m\] of the dashpots of the Maxwell forms,
    /// or compliances \[m/N\] of the springs of the Kelvin forms.
    pub at_short_times: Pair,
    /// The modes in rising order of their times.
    pub modes: Vec<ModePair>,
    /// Largest relative difference of a rate or strength; 1 where one model lacks a constant.
    pub largest: f64,
}

/// Two models, compared.
#[derive(Debug, Clone, PartialEq)]
pub struct Equivalence {
    /// Whether they are the same from outside, within [`SAME_WITHIN`].
    pub is_same: bool,
    /// Their Maxwell forms; `None` where one of them is rigid.
    pub maxwell: Option<FormComparison>,
    /// Their Kelvin forms; `None` where one of them bears no force.
    pub kelvin: Option<FormComparison>,
    /// Where their responses differ most; `None` where one is rigid or bears no force.
    pub worst: Option<Disagreement>,
}

/// Compares two models.
///
/// # Examples
///
/// ```
/// use dashpot_rheology::{Canonical, LinearModel, Primitive::Spring, equivalence::compare};
///
/// let row = LinearModel::series(&[Spring(2e6).into(), Spring(6e6).into()]);
/// assert!(compare(&row, &Spring(1.5e6).into()).is_same);
/// let other = compare(&row, &Spring(1.5e6 * (1.0 + 1e-9)).into());
/// assert!(!other.is_same && (other.worst.unwrap().stiffness - 1e-9).abs() < 1e-15);
/// ```
pub fn compare(first: &LinearModel, second: &LinearModel) -> Equivalence {
    let maxwell = first.maxwell().zip(second.maxwell());
    let kelvin = first.kelvin().zip(second.kelvin());
    let compared = |within: f64| {
        let near = |fractions: &Fractions| fractions.together(within);
        let maxwell = maxwell.map(|(a, b)| forms(&near(&a.0), &near(&b.0), |line| line.strength));
        let kelvin =
            kelvin.map(|(a, b)| forms(&near(&a.0), &near(&b.0), |line| line.strength / line.rate));
        let is_close = |form_comparison: &FormComparison| form_comparison.largest <= SAME_WITHIN;
        (maxwell.iter().chain(&kelvin).any(is_close), maxwell, kelvin)
    };
    // One by one; else what rounding may have rearranged among neighbours counts as a whole.
    let one_by_one = compared(0.0);
    let together = if one_by_one.0 { None } else { Some(compared(TOGETHER_WITHIN)) };
    let (is_same, maxwell, kelvin) = together.filter(|together| together.0).unwrap_or(one_by_one);
    Equivalence { is_same, maxwell, kelvin, worst: Disagreement::of(first, second) }
}

fn forms(
    first: &Fractions,
    second: &Fractions,
    strength: fn(&Line) -> DoubleDouble,
) -> FormComparison {
    let at_long_times = pair(first.at_zero, second.at_zero);
    let at_short_times = pair(first.constant, second.constant);
    let mut largest = at_long_times.difference.max(at_short_times.difference);
    let time_and_strength = |line: &Line| (line.rate.recip(), strength(line));
    let mut modes: Vec<ModePair> = aligned(&first.lines, &second.lines)
        .map(|(a, b)| {
            let none = (DoubleDouble::ZERO, DoubleDouble::ZERO);
            let [a, b] = [a, b].map(|own| own.map_or(none, time_and_strength));
            ModePair { time: pair(a.0, b.0), strength: pair(a.1, b.1) }
        })
        .collect();
    modes.reverse();
    for mode in &modes {
        largest = largest.max(mode.time.difference).max(mode.strength.difference);
    }
    FormComparison { at_long_times, at_short_times, modes, largest }
}

fn pair(first: DoubleDouble, second: DoubleDouble) -> Pair {
    let larger = if first > second { first } else { second };
    let difference = if larger.high() > 0.0 || larger.high().is_nan() {
        let difference = ((first - second).abs() / larger).high();
        // What is not a number is nowhere the same.
        if difference.is_nan() { f64::INFINITY } else { difference }
    } else {
        0.0
    };
    Pair { first: first.high(), second: second.high(), difference }
}

/// A mode of each of two models; one of them may be missing.
pub(super) type Aligned<'l> = (Option<&'l Line>, Option<&'l Line>);

/// Pairs of the lines of two models in rising order of the rate: all of the shorter list, each with
/// one of the longer so that the ratios of their rates are as near to 1 as can be, all in all.
pub(super) fn aligned<'l>(
    first: &'l [Line],
    second: &'l [Line],
) -> impl Iterator<Item = Aligned<'l>> {
    let is_swapped = first.len() > second.len();
    let (short, long) = if is_swapped { (second, first) } else { (first, second) };
    let partners = partners(short, long);
    let mut taken = partners.into_iter().zip(short).peekable();
    long.iter().enumerate().map(move |(at, line)| {
        let partner = taken.next_if(|own| own.0 == at).map(|own| own.1);
        if is_swapped { (Some(line), partner) } else { (partner, Some(line)) }
    })
}

/// For each line of the shorter list the number of its partner, found by dynamic programming.
fn partners(short: &[Line], long: &[Line]) -> Vec<usize> {
    let spare = long.len() - short.len();
    let log = |line: &Line| line.rate.high().ln();
    // `cost[i][skip]`: of the first i of the shorter list with `skip` of the longer one left out.
    let mut cost = vec![vec![0.0; spare + 1]];
    for (i, line) in short.iter().enumerate() {
        let mut next = vec![f64::INFINITY; spare + 1];
        let mut best = f64::INFINITY;
        for skip in 0..=spare {
            best = f64::min(best, cost[i][skip]);
            next[skip] = best + (log(line) - log(&long[i + skip])).abs();
        }
        cost.push(next);
    }
    let mut skip = spare;
    let mut found: Vec<usize> = (0..short.len())
        .rev()
        .map(|i| {
            skip =
                (0..=skip).min_by(|&a, &b| cost[i + 1][a].total_cmp(&cost[i + 1][b])).unwrap_or(0);
            i + skip
        })
        .collect();
    found.reverse();
    found
}

#[cfg(test)]
mod tests;
