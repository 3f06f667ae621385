//! Sums of products.

use crate::{two_product, two_sum};

/// A sum `high + low` that is accumulated as if in 106 bits.
#[derive(Debug, Clone, Copy, Default)]
pub struct Accumulator {
    high: f64,
    low: f64,
}

impl Accumulator {
    /// Adds `x`.
    #[inline]
    pub fn add(&mut self, x: f64) {
        let (sum, rest) = two_sum(self.high, x);
        self.high = sum;
        self.low += rest;
    }

    /// Adds `a b` without rounding the product.
    #[inline]
    pub fn add_product(&mut self, a: f64, b: f64) {
        let (product, rest) = two_product(a, b);
        self.add(product);
        self.low += rest;
    }

    /// Adds something so small that its own rounding does not matter.
    #[inline]
    pub fn add_small(&mut self, x: f64) {
        self.low += x;
    }

    /// The sum, rounded once.
    #[inline]
    pub fn value(self) -> f64 {
        self.high + self.low
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_that_cancels_keeps_its_rest() {
        let mut sum = Accumulator::default();
        let x = 1.0 + f64::EPSILON;
        sum.add_product(x, x);
        sum.add(-1.0);
        sum.add(-2.0 * f64::EPSILON);
        assert!((sum.value() / (f64::EPSILON * f64::EPSILON) - 1.0).abs() < 1e-15);
    }
}
