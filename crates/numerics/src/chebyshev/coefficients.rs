//! Coefficients of one polynomial.

use std::ops::{Deref, DerefMut};

use smallvec::SmallVec;

/// Coefficients up to which a polynomial takes no memory besides its own: those of a step.
const INLINE: usize = 8;

/// The coefficients `c_k` of a polynomial, by rising order; a slice of them wherever one is wanted.
///
/// Polynomials of low degree are made and dropped by the thousand: up to degree 7 they allocate nothing.
///
/// ```
/// use dashpot_numerics::chebyshev::{Coefficients, evaluate};
///
/// let line = Coefficients::from([2.0, -1.0]);
/// assert_eq!(evaluate(&line, 0.5), 1.5);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Coefficients(SmallVec<[f64; INLINE]>);

impl Coefficients {
    /// So many zeros.
    #[inline]
    pub fn zeros(count: usize) -> Self {
        Self(SmallVec::from_elem(0.0, count))
    }

    /// The polynomial cut, or filled up with zeros, to so many coefficients.
    pub fn resize(&mut self, count: usize) {
        self.0.resize(count, 0.0);
    }

    /// Memory that it takes besides its own \[B\].
    pub fn bytes(&self) -> usize {
        if self.0.spilled() { size_of::<f64>() * self.0.capacity() } else { 0 }
    }
}

impl Deref for Coefficients {
    type Target = [f64];

    #[inline]
    fn deref(&self) -> &[f64] {
        &self.0
    }
}

impl DerefMut for Coefficients {
    #[inline]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.0
    }
}

impl From<&[f64]> for Coefficients {
    #[inline]
    fn from(coefficients: &[f64]) -> Self {
        Self(SmallVec::from_slice(coefficients))
    }
}

impl<const N: usize> From<[f64; N]> for Coefficients {
    fn from(coefficients: [f64; N]) -> Self {
        Self::from(coefficients.as_slice())
    }
}

impl From<Vec<f64>> for Coefficients {
    fn from(coefficients: Vec<f64>) -> Self {
        Self::from(coefficients.as_slice())
    }
}

impl FromIterator<f64> for Coefficients {
    fn from_iter<I: IntoIterator<Item = f64>>(coefficients: I) -> Self {
        Self(coefficients.into_iter().collect())
    }
}
