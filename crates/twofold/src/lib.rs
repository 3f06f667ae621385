//! Arithmetic with twice the digits of a double, for what doubles cannot tell apart.

mod accumulator;
mod number;

pub use accumulator::Accumulator;
pub use number::Twofold;

/// `a + b = sum + rest` exactly (Knuth), as long as nothing overflows.
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let other = sum - a;
    (sum, (a - (sum - other)) + (b - other))
}

/// `a b = product + rest` exactly, unless the rest is below the smallest double.
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}
