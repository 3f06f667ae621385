//! Polynomials on `[−1, 1]` as sums of Chebyshev polynomials, `p(x) = Σ c_k T_k(x)`.
//!
//! A slice of coefficients is a polynomial; the empty slice is zero.

mod gauss;
mod interpolation;
mod roots;

pub use gauss::GaussLegendre;
pub use interpolation::Interpolation;
pub use roots::{bracketed_root, is_monotone, sign_changes};

/// The value `p(x)`, `x` in `[−1, 1]`, by Clenshaw's recurrence in Reinsch's form, which keeps its
/// accuracy at the ends of the interval.
pub fn evaluate(coefficients: &[f64], x: f64) -> f64 {
    let Some((&first, rest)) = coefficients.split_first() else { return 0.0 };
    let (mut b, mut difference) = (0.0, 0.0);
    if x < 0.0 {
        let shift = x + 1.0;
        for &c in rest.iter().rev() {
            difference = c + 2.0 * shift * b - difference;
            b = difference - b;
        }
        first + shift * b - difference
    } else {
        let shift = x - 1.0;
        for &c in rest.iter().rev() {
            difference += c + 2.0 * shift * b;
            b += difference;
        }
        first + shift * b + difference
    }
}

/// The coefficients of `p′`, one fewer than those of `p` but at least one.
pub fn derivative(coefficients: &[f64]) -> Vec<f64> {
    let degree = coefficients.len().saturating_sub(1);
    let mut slope = vec![0.0; degree.max(1)];
    let mut factor = 2.0 * order(degree);
    for k in (1..=degree).rev() {
        slope[k - 1] = factor * coefficients[k] + slope.get(k + 1).copied().unwrap_or(0.0);
        factor -= 2.0;
    }
    slope[0] *= 0.5;
    slope
}

/// The coefficients of the antiderivative `∫₋₁ˣ p`, one more than those of `p`.
pub fn antiderivative(coefficients: &[f64]) -> Vec<f64> {
    let at = |k: usize| coefficients.get(k).copied().unwrap_or(0.0);
    let mut area = vec![0.0];
    let mut start = 0.0;
    for k in 1..=coefficients.len() {
        let before = if k == 1 { 2.0 * at(0) } else { at(k - 1) };
        let c = (before - at(k + 1)) / (2.0 * order(k));
        start += if k % 2 == 0 { c } else { -c };
        area.push(c);
    }
    area[0] = -start;
    area
}

/// The integral of `p` over `[−1, 1]`.
pub fn integral(coefficients: &[f64]) -> f64 {
    let even = coefficients.iter().enumerate().step_by(2).rev();
    even.map(|(k, c)| 2.0 * c / (1.0 - order(k) * order(k))).sum()
}

/// The integral of `p` from `a` to `b`, both in `[−1, 1]`; its error is relative to `|b − a|`.
pub fn integral_over(coefficients: &[f64], a: f64, b: f64) -> f64 {
    0.5 * (b - a) * integral(&restrict(coefficients, a, b))
}

/// The polynomial seen on `[a, b]` only: the `q` of the same degree with
/// `q(ξ) = p((a + b)/2 + ξ (b − a)/2)`, exact up to the rounding of [`bound`]`(p)`.
pub fn restrict(coefficients: &[f64], a: f64, b: f64) -> Vec<f64> {
    let degree = coefficients.len().saturating_sub(1);
    let interpolation = Interpolation::of_degree(degree);
    let value = |&node: &f64| {
        // Exact at both ends, so that adjoining restrictions share their border.
        let x = if node < 0.0 {
            a + 0.5 * (b - a) * (1.0 + node)
        } else {
            b - 0.5 * (b - a) * (1.0 - node)
        };
        evaluate(coefficients, x)
    };
    let values: Vec<f64> = interpolation.nodes().iter().map(value).collect();
    let mut restricted = vec![0.0; degree + 1];
    interpolation.coefficients(&values, &mut restricted);
    restricted
}

/// `Σ |c_k|`, which no `|p(x)|` on `[−1, 1]` exceeds.
pub fn bound(coefficients: &[f64]) -> f64 {
    coefficients.iter().map(|c| c.abs()).sum()
}

/// `Σ |c_k|` without the constant: how far `p` strays at most from `c_0`.
pub fn variation(coefficients: &[f64]) -> f64 {
    bound(coefficients.get(1..).unwrap_or_default())
}

/// A degree or index as a number.
#[expect(clippy::cast_precision_loss, reason = "degrees are small")]
fn order(k: usize) -> f64 {
    k as f64
}

#[cfg(test)]
mod tests;
