//! Zeros of polynomials on `[−1, 1]`.

use smallvec::{SmallVec, smallvec};

use super::{at_ends, bound, derivative, evaluate, evaluate_both, restrict, variation};

/// Intervals shorter than this are not divided further.
const NARROWEST: f64 = 1e-15;
/// A step of Newton's method after which nothing is left to be found, if it is by so much smaller than
/// the one before: at a simple zero steps are squared.
const SETTLED: f64 = 1e-10;
const SETTLING: f64 = 1e-3;
/// What rounding leaves of the values of a polynomial whose coefficients have lost their digits, in the
/// range below full precision: some of the smallest numbers.
const SMALLEST: f64 = 64.0 * f64::MIN_POSITIVE * f64::EPSILON;

/// Whether the coefficients prove that `p` rises all the way, or falls all the way; a constant does.
///
/// `false` proves nothing.
fn is_monotone(coefficients: &[f64]) -> bool {
    if coefficients.len() <= 2 {
        return true;
    }
    let slope = derivative(coefficients);
    slope[0].abs() >= variation(&slope)
}

/// All places in `(−1, 1)` at which `p` changes its sign, in rising order.
///
/// Intervals are divided until the coefficients prove that there is no zero in them, or one at
/// most. Pairs of zeros between which `|p|` stays below its rounding error may be left out. A polynomial
/// whose coefficients are not finite has none.
pub fn sign_changes(coefficients: &[f64]) -> Vec<f64> {
    let mut found = Vec::new();
    let total = bound(coefficients);
    let is_lost = coefficients.len() < 2 || !total.is_finite();
    if is_lost || coefficients[0].abs() > total - coefficients[0].abs() {
        return found;
    }
    let noise = (16.0 * f64::EPSILON * total).max(SMALLEST);
    let slope = derivative(coefficients);
    let ends = at_ends(coefficients);
    let mut open: SmallVec<[_; 16]> = smallvec![((-1.0, ends[0]), (1.0, ends[1]))];
    while let Some((a, b)) = open.pop() {
        let own;
        let part = if b.0 - a.0 < 2.0 {
            own = restrict(coefficients, a.0, b.0);
            &own
        } else {
            coefficients
        };
        let spread = variation(part);
        if part[0].abs() > spread + noise {
            continue;
        }
        // Around a zero of higher order whole intervals are alike to within rounding: dividing them
        // further would tell nothing, and have no end.
        let flat = spread <= noise;
        if flat || is_monotone(part) || b.0 - a.0 < NARROWEST {
            if (a.1 < 0.0) != (b.1 < 0.0) {
                found.push(bracketed_root(coefficients, &slope, a, b).clamp(-1.0, 1.0));
            }
            continue;
        }
        let middle = 0.5 * (a.0 + b.0);
        let middle = (middle, evaluate(coefficients, middle));
        open.push((middle, b));
        open.push((a, middle));
    }
    found
}

/// The zero of `p` between two places `(x, p(x))` at which it has different signs, to the last bit,
/// by Newton's method kept within the bracket. `slope` holds the coefficients of `p′`.
pub fn bracketed_root(
    coefficients: &[f64],
    slope: &[f64],
    start: (f64, f64),
    end: (f64, f64),
) -> f64 {
    let (mut a, mut b) = (start, end);
    // The secant's zero is a good first guess, as the piece is monotone as a rule.
    let mut x = a.0 + (b.0 - a.0) * (a.1 / (a.1 - b.1));
    let (mut last_width, mut last_step) = (b.0 - a.0, f64::INFINITY);
    for _ in 0..100 {
        if !(x > a.0 && x < b.0) {
            x = 0.5 * (a.0 + b.0);
            if x <= a.0 || x >= b.0 {
                break;
            }
        }
        let (value, rate) = evaluate_both(coefficients, slope, x);
        if value == 0.0 {
            return x;
        }
        if (value < 0.0) == (a.1 < 0.0) {
            a = (x, value);
        } else {
            b = (x, value);
        }
        let step = value / rate;
        if step.abs() <= 0.25 * f64::EPSILON {
            return x;
        }
        // Where steps shrink so fast, the next one would be below rounding.
        if step.abs() <= SETTLED
            && step.abs() <= SETTLING * last_step
            && x - step > a.0
            && x - step < b.0
        {
            return x - step;
        }
        last_step = step.abs();
        // Where Newton's method does not at least halve its step, halve the bracket.
        if step.abs() < 0.5 * last_width {
            x -= step;
            last_width = step.abs();
        } else {
            x = 0.5 * (a.0 + b.0);
            last_width = 0.5 * (b.0 - a.0);
        }
    }
    if a.1.abs() < b.1.abs() { a.0 } else { b.0 }
}
