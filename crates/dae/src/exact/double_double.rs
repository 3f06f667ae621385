//! Sums of products with twice the digits of a double.

/// A sum `high + low` that is accumulated as if in 106 bits.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Accumulator {
    high: f64,
    low: f64,
}

impl Accumulator {
    /// Adds `x`.
    #[inline]
    pub(super) fn add(&mut self, x: f64) {
        let (sum, rest) = two_sum(self.high, x);
        self.high = sum;
        self.low += rest;
    }

    /// Adds `a b` without rounding the product.
    #[inline]
    pub(super) fn add_product(&mut self, a: f64, b: f64) {
        let (product, rest) = two_product(a, b);
        self.add(product);
        self.low += rest;
    }

    /// Adds something so small that its own rounding does not matter.
    #[inline]
    pub(super) fn add_small(&mut self, x: f64) {
        self.low += x;
    }

    /// The sum, rounded once.
    #[inline]
    pub(super) fn value(self) -> f64 {
        self.high + self.low
    }
}

/// `a + b = sum + rest` exactly (Knuth).
#[inline]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// `a b = product + rest` exactly (Dekker), for factors below 1e290.
#[inline]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    (product, a2 * b2 - (((product - a1 * b1) - a2 * b1) - a1 * b2))
}

/// Two halves of 26 bits.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let shifted = 134_217_729.0 * a;
    let high = shifted - (shifted - a);
    (high, a - high)
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
