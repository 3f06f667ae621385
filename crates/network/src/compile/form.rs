//! Sparse linear forms with twice the digits of a double, while the equations are put together.
//!
//! A coefficient of the equations may be the small rest of large terms: of a spring in parallel with
//! the fastest dashpot of a chain only what the other dashpots give way to is left. Thirty-two digits
//! on the way leave sixteen of such a rest over sixteen decades.

use dashpot_dae::LinearForm;
use dashpot_twofold::Twofold;

/// What is left of terms that cancel, relative to the largest of them, is zero below this: a
/// thousand roundings of 106 bits.
const NOTHING: f64 = 1.0 / ((1_u128 << 94) as f64);

/// A sparse linear form `Σ cᵢ zᵢ` over numbered variables, kept sorted by variable.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Form {
    terms: Vec<(usize, Twofold)>,
}

impl Form {
    /// The variable of this number.
    pub(super) fn variable(at: usize) -> Self {
        Self { terms: vec![(at, Twofold::ONE)] }
    }

    /// The sum of `terms`, which may stand in any order and name a variable more than once.
    pub(super) fn sum(mut terms: Vec<(usize, Twofold)>) -> Self {
        terms.sort_by_key(|term| term.0);
        let mut merged = Vec::with_capacity(terms.len());
        for group in terms.chunk_by(|one, other| one.0 == other.0) {
            let mut sum = Twofold::ZERO;
            let mut largest = 0.0_f64;
            for &(_, coefficient) in group {
                sum += coefficient;
                largest = largest.max(coefficient.high().abs());
            }
            if !is_nothing(sum, largest) {
                merged.push((group[0].0, sum));
            }
        }
        Self { terms: merged }
    }

    /// The form of these terms, each of another variable, in rising order; none is zero.
    pub(super) fn of(terms: Vec<(usize, Twofold)>) -> Self {
        Self { terms }
    }

    /// The terms `(variable, coefficient)` in rising order of the variable; none is zero.
    pub(super) fn terms(&self) -> &[(usize, Twofold)] {
        &self.terms
    }

    /// Whether no variable appears.
    pub(super) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// `self + factor · other`; terms that cancel disappear.
    #[must_use]
    pub(super) fn plus(&self, factor: Twofold, other: &Self) -> Self {
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            let (variable, sum, largest) = match (left.peek(), right.peek()) {
                (Some(&&(i, a)), Some(&&(j, _))) if i < j => {
                    left.next();
                    (i, a, 0.0)
                }
                (Some(&&(i, a)), Some(&&(j, b))) if i == j => {
                    left.next();
                    right.next();
                    (i, a + factor * b, a.high().abs())
                }
                (_, Some(&&(j, b))) => {
                    right.next();
                    (j, factor * b, 0.0)
                }
                (Some(&&(i, a)), None) => {
                    left.next();
                    (i, a, 0.0)
                }
                (None, None) => break,
            };
            if !is_nothing(sum, largest) {
                terms.push((variable, sum));
            }
        }
        Self { terms }
    }

    /// The value at the point `z`.
    pub(super) fn at(&self, z: &[f64]) -> f64 {
        self.terms.iter().map(|&(at, coefficient)| coefficient * z[at]).sum::<Twofold>().high()
    }

    /// The form over variables in units of their `scales`, each coefficient rounded once.
    pub(super) fn scaled(&self, scales: &[f64]) -> LinearForm {
        let terms = self.terms.iter();
        LinearForm::sum(terms.map(|&(at, value)| (at, value.high() * scales[at])).collect())
    }
}

fn is_nothing(sum: Twofold, largest: f64) -> bool {
    sum.high().abs() <= NOTHING * largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rest_over_fourteen_decades_keeps_all_digits_of_a_double() {
        let (large, small) = (Twofold::from(1e14) / 3.0, Twofold::ONE / 7.0);
        let sum = Form::sum(vec![(2, large), (0, Twofold::ONE), (2, small), (2, -large)]);
        assert_eq!(sum.terms()[0], (0, Twofold::ONE));
        assert!((sum.scaled(&[1.0; 3]).coefficient(2) * 7.0 - 1.0).abs() <= f64::EPSILON);
        assert_eq!(sum.terms().len(), 2);
    }

    #[test]
    fn what_cancels_but_for_rounding_disappears() {
        let third = Twofold::ONE / 3.0;
        let form = Form::variable(4).plus(-third, &Form::sum(vec![(4, Twofold::from(3.0))]));
        assert!(form.is_zero());
        let form = Form::sum(vec![(1, third), (1, third), (1, third), (1, -Twofold::ONE)]);
        assert!(form.is_zero());
    }
}
