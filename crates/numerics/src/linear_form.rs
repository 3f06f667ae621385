//! Sparse linear forms.

use std::{
    iter::Sum,
    ops::{Add, Mul},
};

use smallvec::{SmallVec, smallvec};

use crate::DoubleDouble;

/// Terms of most forms, which take no memory besides.
const INLINE: usize = 4;

/// A coefficient of a [`LinearForm`].
pub trait Coefficient:
    Copy + Default + Add<Output = Self> + Mul<Output = Self> + Mul<f64, Output = Self> + Sum
{
    /// 1.
    const ONE: Self;
    /// What is left of terms that cancel counts as zero up to this part of the largest of them.
    const NOTHING: f64;

    /// The nearest double.
    fn rounded(self) -> f64;
}

impl Coefficient for f64 {
    const ONE: Self = 1.0;
    const NOTHING: f64 = 0.0;

    fn rounded(self) -> f64 {
        self
    }
}

impl Coefficient for DoubleDouble {
    const ONE: Self = Self::ONE;
    /// A thousand roundings of 106 bits.
    const NOTHING: f64 = 1.0 / ((1_u128 << 94) as f64);

    fn rounded(self) -> f64 {
        self.high()
    }
}

/// Whether a sum of terms is nothing beside the largest of them.
fn is_nothing<T: Coefficient>(sum: T, largest: f64) -> bool {
    sum.rounded().abs() <= T::NOTHING * largest
}

/// A sparse linear form `Σ cᵢ zᵢ` over numbered variables, kept sorted by variable.
///
/// Its coefficients are doubles, or double-double numbers where the small rest of large terms that cancel
/// is to keep its digits: thirty-two of them leave sixteen of a rest over sixteen decades.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinearForm<T = f64> {
    terms: SmallVec<[(usize, T); INLINE]>,
}

impl<T: Coefficient> LinearForm<T> {
    /// The form that is zero everywhere.
    pub fn zero() -> Self {
        Self::default()
    }

    /// The variable of this number.
    pub fn variable(at: usize) -> Self {
        Self { terms: smallvec![(at, T::ONE)] }
    }

    /// The form `coefficient · z_variable`.
    pub fn term(variable: usize, coefficient: T) -> Self {
        Self::sum([(variable, coefficient)])
    }

    /// The sum of `terms`, which may stand in any order and name a variable more than once.
    pub fn sum(terms: impl IntoIterator<Item = (usize, T)>) -> Self {
        let mut terms: SmallVec<[_; INLINE]> = terms.into_iter().collect();
        terms.sort_by_key(|term| term.0);
        let mut merged = SmallVec::new();
        for group in terms.chunk_by(|one, other| one.0 == other.0) {
            let all = group.iter().map(|term| term.1);
            let largest = all.clone().map(|own| own.rounded().abs()).fold(0.0, f64::max);
            if let Some(sum) = all.reduce(Add::add).filter(|sum| !is_nothing(*sum, largest)) {
                merged.push((group[0].0, sum));
            }
        }
        Self { terms: merged }
    }

    /// The form of these terms, each of another variable, in rising order; none is zero.
    pub fn of(terms: impl IntoIterator<Item = (usize, T)>) -> Self {
        Self { terms: terms.into_iter().collect() }
    }

    /// The terms `(variable, coefficient)` in rising order of the variable; none is zero.
    pub fn terms(&self) -> &[(usize, T)] {
        &self.terms
    }

    /// Whether no variable appears.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The coefficient of `variable`, zero where it does not appear.
    pub fn coefficient(&self, variable: usize) -> T {
        let place = self.terms.binary_search_by_key(&variable, |term| term.0);
        place.map_or_else(|_| T::default(), |at| self.terms[at].1)
    }

    /// `self + factor · other`; terms that cancel disappear.
    #[must_use]
    pub fn plus(&self, factor: T, other: &Self) -> Self {
        let mut terms = SmallVec::with_capacity(self.terms.len() + other.terms.len());
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
                    (i, a + factor * b, a.rounded().abs())
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

    /// `factor · self`.
    #[must_use]
    pub fn times(&self, factor: T) -> Self {
        Self::zero().plus(factor, self)
    }

    /// The value at the point `z`.
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn at(&self, z: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, c)| c * z[i]).sum::<T>().rounded()
    }

    /// The form over variables in units of their `scales`, each coefficient rounded once.
    pub fn scaled(&self, scales: &[f64]) -> LinearForm {
        let terms = self.terms.iter();
        let terms = terms.map(|&(at, own)| (at, own.rounded() * scales[at]));
        LinearForm::of(terms.filter(|term| term.1 != 0.0))
    }
}

impl LinearForm {
    /// `Σ |cᵢ zᵢ|`, the scale of the rounding error of [`at`](Self::at).
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn magnitude_at(&self, z: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, c)| (c * z[i]).abs()).sum()
    }
}

/// A [`LinearForm`] that lies among others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormRef<'f> {
    variables: &'f [u32],
    coefficients: &'f [f64],
}

impl<'f> FormRef<'f> {
    /// The terms `(variable, coefficient)` in rising order of the variable; none is zero.
    pub fn terms(self) -> impl ExactSizeIterator<Item = (usize, f64)> + Clone + 'f {
        let variables = self.variables.iter().map(|&variable| variable as usize);
        variables.zip(self.coefficients.iter().copied())
    }

    /// Whether no variable appears.
    pub fn is_zero(self) -> bool {
        self.variables.is_empty()
    }

    /// The coefficient of `variable`, zero where it does not appear.
    pub fn coefficient(self, variable: usize) -> f64 {
        self.terms().find(|term| term.0 == variable).map_or(0.0, |term| term.1)
    }

    /// The value at the point `z`.
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn at(self, z: &[f64]) -> f64 {
        self.terms().map(|(i, c)| c * z[i]).sum()
    }

    /// `Σ |cᵢ zᵢ|`, the scale of the rounding error of [`at`](Self::at).
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn magnitude_at(self, z: &[f64]) -> f64 {
        self.terms().map(|(i, c)| (c * z[i]).abs()).sum()
    }

    /// The same form by itself.
    pub fn to_form(self) -> LinearForm {
        LinearForm::of(self.terms())
    }
}

/// Many linear forms, one behind the other: each takes four bytes and twelve for each term.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Forms {
    /// Where the terms of each form end.
    ends: Vec<u32>,
    variables: Vec<u32>,
    coefficients: Vec<f64>,
}

impl Forms {
    /// Adds a form of these terms, in rising order of the variable.
    ///
    /// # Panics
    ///
    /// When there are 2³² terms in all, or as many variables.
    pub fn push(&mut self, terms: impl Iterator<Item = (usize, f64)>) {
        for (variable, coefficient) in terms {
            self.variables.push(packed(variable));
            self.coefficients.push(coefficient);
        }
        self.ends.push(packed(self.variables.len()));
    }

    /// How many there are.
    #[expect(clippy::len_without_is_empty, reason = "nobody asks")]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The form of this number.
    ///
    /// # Panics
    ///
    /// When there are not so many.
    pub fn form(&self, at: usize) -> FormRef<'_> {
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.between(start, self.ends[at])
    }

    /// All forms in order.
    pub fn iter(&self) -> impl Iterator<Item = FormRef<'_>> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&start, &end)| self.between(start, end))
    }

    fn between(&self, start: u32, end: u32) -> FormRef<'_> {
        let place = start as usize..end as usize;
        FormRef {
            variables: &self.variables[place.clone()],
            coefficients: &self.coefficients[place],
        }
    }

    /// Gives back memory that was set aside for more.
    pub fn shrink_to_fit(&mut self) {
        self.ends.shrink_to_fit();
        self.variables.shrink_to_fit();
        self.coefficients.shrink_to_fit();
    }
}

/// A number in four bytes.
///
/// # Panics
///
/// When it has no room there.
pub fn packed(number: usize) -> u32 {
    u32::try_from(number).unwrap_or_else(|_| panic!("{number} has no room in 32 bits"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rest_over_fourteen_decades_keeps_all_digits_of_a_double() {
        let (large, small) = (DoubleDouble::from(1e14) / 3.0, DoubleDouble::ONE / 7.0);
        let sum =
            LinearForm::sum(vec![(2, large), (0, DoubleDouble::ONE), (2, small), (2, -large)]);
        assert_eq!(sum.terms()[0], (0, DoubleDouble::ONE));
        assert!((sum.scaled(&[1.0; 3]).coefficient(2) * 7.0 - 1.0).abs() <= f64::EPSILON);
        assert_eq!(sum.terms().len(), 2);
    }

    #[test]
    fn what_cancels_but_for_rounding_disappears() {
        let third = DoubleDouble::ONE / 3.0;
        let form = LinearForm::variable(4)
            .plus(-third, &LinearForm::sum(vec![(4, DoubleDouble::from(3.0))]));
        assert!(form.is_zero());
        let form =
            LinearForm::sum(vec![(1, third), (1, third), (1, third), (1, -DoubleDouble::ONE)]);
        assert!(form.is_zero());
    }
}
