//! Polynomials on `[−1, 1]` as sums of Chebyshev polynomials, `p(x) = Σ c_k T_k(x)`.
//!
//! A slice of coefficients is a polynomial; the empty slice is zero.

use std::borrow::Cow;

use smallvec::{SmallVec, smallvec};

mod coefficients;
mod interpolation;
mod roots;

pub use coefficients::Coefficients;
pub use interpolation::Interpolation;
pub use roots::{bracketed_root, sign_changes};

/// Places that are worked on side by side, so that the recurrences do not wait for each other.
const LANES: usize = 6;
/// Places of a polynomial of usual degree, which take no memory besides.
const PLACES: usize = 18;

/// The values `p(−1)` and `p(1)` at both ends, to the last bit those of [`evaluate`].
#[inline]
pub fn at_ends(coefficients: &[f64]) -> [f64; 2] {
    let add = |[first, last]: [f64; 2], c: &f64| [c - first, c + last];
    coefficients.iter().rev().fold([0.0; 2], add)
}

/// The value `p(x)`, `x` in `[−1, 1]`, by Clenshaw's recurrence in Reinsch's form, which keeps its
/// accuracy at the ends of the interval.
#[inline]
pub fn evaluate(coefficients: &[f64], x: f64) -> f64 {
    let [value] = clenshaw(coefficients, [x]);
    value
}

/// The values at each of the `places`, the same as by [`evaluate`] but quicker.
///
/// # Panics
///
/// When `values` is shorter than `places`.
pub fn evaluate_all(coefficients: &[f64], places: &[f64], values: &mut [f64]) {
    assert!(values.len() >= places.len(), "a value for each place");
    for (places, values) in places.chunks(LANES).zip(values.chunks_mut(LANES)) {
        let mut lanes = [0.0; LANES];
        lanes[..places.len()].copy_from_slice(places);
        let found = clenshaw(coefficients, lanes);
        values[..places.len()].copy_from_slice(&found[..places.len()]);
    }
}

/// The values at `x` of two polynomials, the second of which has no more coefficients than the first,
/// the same as by [`evaluate`] but in the time of one.
pub fn evaluate_both(first: &[f64], second: &[f64], x: f64) -> (f64, f64) {
    let pairs =
        first.iter().enumerate().map(|(k, &one)| [one, second.get(k).copied().unwrap_or(0.0)]);
    let [one, other] = recurrence(pairs, [x, x]);
    (one, other)
}

fn clenshaw<const N: usize>(coefficients: &[f64], places: [f64; N]) -> [f64; N] {
    recurrence(coefficients.iter().map(|&c| [c; N]), places)
}

/// The values of `N` polynomials, each at its own place.
fn recurrence<const N: usize>(
    mut coefficients: impl DoubleEndedIterator<Item = [f64; N]>,
    places: [f64; N],
) -> [f64; N] {
    let Some(first) = coefficients.next() else { return [0.0; N] };
    // It starts from the nearer end of the interval, and goes with the sign of that.
    let sides = places.map(|x| if x < 0.0 { -1.0 } else { 1.0 });
    let (mut shifts, mut b, mut differences) = ([0.0; N], [0.0; N], [0.0; N]);
    for i in 0..N {
        shifts[i] = places[i] - sides[i];
    }
    for c in coefficients.rev() {
        for i in 0..N {
            differences[i] = c[i] + 2.0 * shifts[i] * b[i] + sides[i] * differences[i];
            b[i] = differences[i] + sides[i] * b[i];
        }
    }
    let mut values = [0.0; N];
    for i in 0..N {
        values[i] = first[i] + shifts[i] * b[i] + sides[i] * differences[i];
    }
    values
}

/// The coefficients of `p′`, one fewer than those of `p` but at least one.
#[inline]
pub fn derivative(coefficients: &[f64]) -> Coefficients {
    let degree = coefficients.len().saturating_sub(1);
    let mut slope = Coefficients::zeros(degree.max(1));
    let mut factor = 2.0 * degree as f64;
    for k in (1..=degree).rev() {
        slope[k - 1] = factor * coefficients[k] + slope.get(k + 1).copied().unwrap_or(0.0);
        factor -= 2.0;
    }
    slope[0] *= 0.5;
    slope
}

/// The coefficients of the antiderivative `∫₋₁ˣ p`, one more than those of `p`.
pub fn antiderivative(coefficients: &[f64]) -> Coefficients {
    let at = |k: usize| coefficients.get(k).copied().unwrap_or(0.0);
    let mut area = Coefficients::zeros(coefficients.len() + 1);
    let mut start = 0.0;
    for k in 1..=coefficients.len() {
        let before = if k == 1 { 2.0 * at(0) } else { at(k - 1) };
        let c = (before - at(k + 1)) / (2.0 * k as f64);
        start += if k % 2 == 0 { c } else { -c };
        area[k] = c;
    }
    area[0] = -start;
    area
}

/// The integral of `p` over `[−1, 1]`.
#[inline]
pub fn integral(coefficients: &[f64]) -> f64 {
    let even = coefficients.iter().enumerate().step_by(2).rev();
    even.map(|(k, c)| 2.0 * c / (1.0 - k as f64 * k as f64)).sum()
}

/// The integral of `p q` over `[−1, 1]`: `∫ T_j T_k = 1/(1 − (j + k)²) + 1/(1 − (j − k)²)` for even `j + k`.
pub fn integral_of_product(p: &[f64], q: &[f64]) -> f64 {
    const READY: [f64; 63] = {
        let mut ready = [0.0; 63];
        let mut at = 0;
        while at < ready.len() {
            ready[at] = half_of_even(at as f64 - 31.0);
            at += 1;
        }
        ready
    };
    // Orders of one parity by halves of them, so that those of all `j` adjoin.
    let reach = p.len().max(q.len());
    let (table, middle) = if reach <= 32 {
        (Cow::Borrowed(READY.as_slice()), 31)
    } else {
        let own = (0..=2 * reach).map(|at| half_of_even(at as f64 - reach as f64));
        (Cow::Owned(own.collect()), reach)
    };
    let mut sums = Coefficients::zeros(p.len());
    let (even, odd) = sums.split_at_mut(p.len().div_ceil(2));
    for (k, factor) in q.iter().enumerate() {
        let (own, of_odd) = if k.is_multiple_of(2) { (&mut *even, 0) } else { (&mut *odd, 1) };
        let (above, below) = (&table[middle + k / 2 + of_odd..], &table[middle - k / 2..]);
        for ((sum, above), below) in own.iter_mut().zip(above).zip(below) {
            *sum += factor * (above + below);
        }
    }
    let sums = |j: usize| if j.is_multiple_of(2) { even[j / 2] } else { odd[j / 2] };
    p.iter().enumerate().map(|(j, own)| own * sums(j)).sum()
}

/// Half of `∫ T_m` for an even `m`, of half of which it is told.
const fn half_of_even(half: f64) -> f64 {
    1.0 / (1.0 - 4.0 * half * half)
}

/// The polynomial seen on `[a, b]` only: the `q` of the same degree with
/// `q(ξ) = p((a + b)/2 + ξ (b − a)/2)`, exact up to the rounding of [`bound`]`(p)`.
pub fn restrict(coefficients: &[f64], a: f64, b: f64) -> Coefficients {
    let degree = coefficients.len().saturating_sub(1);
    let interpolation = Interpolation::of_degree(degree);
    let place = |&node: &f64| {
        // Exact at both ends, so that adjoining restrictions share their border.
        if node < 0.0 { a + 0.5 * (b - a) * (1.0 + node) } else { b - 0.5 * (b - a) * (1.0 - node) }
    };
    let places: SmallVec<[f64; PLACES]> = interpolation.nodes().iter().map(place).collect();
    let mut values: SmallVec<[f64; PLACES]> = smallvec![0.0; degree + 1];
    evaluate_all(coefficients, &places, &mut values);
    let mut restricted = Coefficients::zeros(degree + 1);
    interpolation.coefficients(&values, &mut restricted);
    restricted
}

/// `Σ |c_k|`, which no `|p(x)|` on `[−1, 1]` exceeds.
#[inline]
pub fn bound(coefficients: &[f64]) -> f64 {
    coefficients.iter().map(|c| c.abs()).sum()
}

/// `Σ |c_k|` without the constant: how far `p` strays at most from `c_0`.
#[inline]
pub fn variation(coefficients: &[f64]) -> f64 {
    bound(coefficients.get(1..).unwrap_or_default())
}

#[cfg(test)]
mod tests;
