//! Bounds that hold for certain: of a block's exponential, of what rounding does to it, and of errors that
//! drive themselves.

use nalgebra::DVector;

use super::{
    Complex,
    block::{Block, REACH, STEPS, TERMS, largest_column},
};

/// Factor by which a bound is widened at each step of the search for one that confirms itself.
const INFLATION: f64 = 1.1;
/// Most steps of that search.
const SEARCHES: usize = 30;

impl Block {
    /// `Σ_k f_k |N|^k s^k/k! · vector`, where `N` is the block without its diagonal and
    /// `f_k = factor(k)` for rising `k`.
    ///
    /// With `f_k = sup (t/s)^k e^{σ t}` it bounds `|e^{D_i t} v|` entry by entry for `|v| ≤ vector`.
    /// Infinite where the series does not settle.
    fn majorant(&self, s: f64, vector: &[f64], mut factor: impl FnMut(usize) -> f64) -> Vec<f64> {
        // Of nothing there is nothing, however far the powers of the matrix reach.
        if vector.iter().all(|v| *v == 0.0) {
            return vec![0.0; vector.len()];
        }
        let first = factor(0);
        let mut sum: Vec<f64> = vector.iter().map(|v| v * first).collect();
        if self.len() == 1 {
            return sum;
        }
        let sizes = self.matrix.map(Complex::norm);
        let (mut term, mut next) = (vector.to_vec(), vec![0.0; vector.len()]);
        for k in 1..TERMS {
            let step = s / k as f64;
            next.fill(0.0);
            for (j, t) in term.iter().enumerate() {
                for (i, n) in next.iter_mut().enumerate() {
                    if i != j {
                        *n += sizes[(i, j)] * t * step;
                    }
                }
            }
            std::mem::swap(&mut term, &mut next);
            let weight = factor(k);
            let mut settled = true;
            for (sum, t) in sum.iter_mut().zip(&term) {
                let part = t * weight;
                settled &= part <= 1e-4 * *sum;
                *sum += part;
            }
            if settled && k >= self.len() {
                sum.iter_mut().for_each(|sum| *sum *= 1.001);
                return sum;
            }
        }
        vec![f64::INFINITY; term.len()]
    }

    /// A bound of `|e^{D_i t} v|` for all `t` in `[0, s]` and `|v| ≤ vector`.
    pub(super) fn largest(&self, s: f64, vector: &[f64]) -> Vec<f64> {
        self.largest_discounted(s, vector, 0.0)
    }

    /// What rounding within [`advance`](Self::advance) may change in `|e^{D_i t} v|` for any `t` in `[0, s]` and `|v| ≤
    /// vector`, in units of `4 ε`. Zero for a single mode, whose phase is kept to twice the digits.
    ///
    /// The series err as if each entry of `D_i − shift` were rounded, once for each operation; squared
    /// powers err relative to the largest entry.
    pub(super) fn strain(&self, s: f64, vector: &[f64]) -> Vec<f64> {
        let count = self.len();
        if count == 1 {
            return vec![0.0];
        }
        let mut rest = self.offset(self.shift()).map(Complex::norm);
        rest *= s;
        let size = largest_column(&rest);
        let operations = (count as f64 + 6.0) / 8.0 * size.min(REACH).exp();
        let mut pushed = &rest * DVector::from_column_slice(vector);
        if size > REACH * STEPS {
            pushed.fill(size * vector.iter().fold(0.0, |most, v| v.max(most)));
        }
        pushed *= operations;
        let sigma = self.growth_rate();
        self.majorant(s, pushed.as_slice(), |k| largest_power(k + 1, sigma * s))
    }

    /// A bound of `|e^{(D_i − discount) t} v|` for all `t` in `[0, s]` and `|v| ≤ vector`.
    pub(super) fn largest_discounted(&self, s: f64, vector: &[f64], discount: f64) -> Vec<f64> {
        let sigma = self.growth_rate() - discount;
        self.majorant(s, vector, |k| largest_power(k, sigma * s))
    }

    /// A bound of `|e^{D_i s} v|` for `|v| ≤ vector`.
    pub(super) fn last(&self, s: f64, vector: &[f64]) -> Vec<f64> {
        let factor = (self.growth_rate() * s).exp();
        self.majorant(s, vector, |_| factor)
    }

    /// A bound of `∫₀ˢ |e^{(D_i − discount) t} v| dt` for `|v| ≤ vector`.
    pub(super) fn integral(&self, s: f64, vector: &[f64], discount: f64) -> Vec<f64> {
        let sigma = self.growth_rate() - discount;
        let mut decay = 1.0;
        self.majorant(s, vector, |k| {
            let order = k as f64;
            let whole = s / (order + 1.0) * (sigma * s).exp().max(1.0);
            if sigma >= 0.0 || s == 0.0 {
                return whole;
            }
            if k > 0 {
                decay *= order / (-sigma * s);
            }
            whole.min(decay / -sigma)
        })
    }

    /// Bounds of `|row · e^{D_i t} c|` and of `|row| |D_i h/4|^n/n! |e^{D_i t} c|` for all `t` in `[0, h]`: how large
    /// the block's part of an output can be, and how far a polynomial of degree `n − 1` can miss it, but for a factor.
    ///
    /// `sizes` are those of the coordinates `c` at the panel's start.
    pub(super) fn sizes_on_panel(
        &self,
        row: &[f64],
        sizes: &[f64],
        h: f64,
        n: usize,
    ) -> (f64, f64) {
        if let ([row], [own]) = (row, sizes) {
            let rate = self.matrix[(0, 0)];
            let size = row * own * (rate.re * h).exp().max(1.0);
            let step = 0.25 * h * rate.norm();
            return (size, size * taylor_weight(step, n));
        }
        let largest = self.largest(h, sizes);
        let weights = self.derivative_weights(row, 0.25 * h, n);
        let sum = |weights: &[f64]| weights.iter().zip(&largest).map(|(w, c)| w * c).sum();
        (sum(row), sum(&weights))
    }

    /// `|row| |D_i h|^n / n!`, the share of each mode in the `n`-th Taylor term of `row · e^{D_i h}`.
    pub(super) fn derivative_weights(&self, row: &[f64], h: f64, n: usize) -> Vec<f64> {
        let sizes = self.matrix.map(Complex::norm);
        let (mut weights, mut next) = (row.to_vec(), row.to_vec());
        for order in 1..=n {
            let step = h / order as f64;
            for (value, column) in next.iter_mut().zip(sizes.column_iter()) {
                *value = weights.iter().zip(&column).map(|(w, size)| w * size * step).sum();
            }
            std::mem::swap(&mut weights, &mut next);
        }
        weights
    }
}

/// `x^n/n!`; infinite or zero where a power leaves the range of numbers.
fn taylor_weight(x: f64, n: usize) -> f64 {
    let factorial: f64 = (2..=n).map(|k| k as f64).product();
    x.powi(i32::try_from(n).unwrap_or(i32::MAX)) / factorial
}

/// The largest `x^k e^{exponent x}` for `x` in `[0, 1]`.
fn largest_power(k: usize, exponent: f64) -> f64 {
    let order = k as f64;
    if k == 0 {
        exponent.exp().max(1.0)
    } else if exponent >= -order {
        exponent.exp()
    } else {
        (order * (order / -exponent).ln() - order).exp()
    }
}

/// A bound `e` that confirms itself: `first + apply(e) ≤ e`, entry by entry, for a linear `apply`
/// that keeps order. Every quantity `x ≤ first + apply(x)` that is known to be finite lies below it.
///
/// Infinite where no such bound is found: then `apply` does not contract, and nothing is known.
pub(super) fn enclose(first: &[f64], apply: impl Fn(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let mut bound = first.to_vec();
    for _ in 0..SEARCHES {
        let mut next = apply(&bound);
        let mut confirmed = true;
        for ((next, bound), first) in next.iter_mut().zip(&bound).zip(first) {
            *next += first;
            confirmed &= *next <= *bound;
            *next *= INFLATION;
        }
        if confirmed {
            return bound;
        }
        bound = next;
    }
    vec![f64::INFINITY; first.len()]
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

    fn block(size: usize, entries: &[f64]) -> Block {
        let matrix = DMatrix::from_row_slice(size, size, entries).map(|x| Complex::new(x, 0.0));
        Block::new(0, matrix)
    }

    #[test]
    fn bounds_hold_and_are_not_far_off() {
        let jordan = block(2, &[-2.0, 3.0, 0.0, -2.0]);
        // e^{Dt} (0, 1) has the first entry 3 t e^{−2t}: largest 3/(2e), integral 3/4.
        let top = jordan.largest(100.0, &[0.0, 1.0])[0];
        let area = jordan.integral(100.0, &[0.0, 1.0], 0.0)[0];
        assert!((1.0..1.1).contains(&(top / (1.5 / 1_f64.exp()))), "{top}");
        assert!((1.0..1.1).contains(&(area / 0.75)), "{area}");
    }

    #[test]
    fn taylor_weights_are_those_of_the_exponential() {
        let sum: f64 = (0..40).map(|n| taylor_weight(3.0, n)).sum();
        assert!((sum / 3_f64.exp() - 1.0).abs() < 1e-15, "{sum}");
        assert_eq!((taylor_weight(1e300, 17), taylor_weight(1e-300, 17)), (f64::INFINITY, 0.0));
    }

    #[test]
    fn largest_powers_are_found_inside_and_at_the_end() {
        assert_eq!((largest_power(0, -3.0), largest_power(2, 0.0)), (1.0, 1.0));
        assert!((largest_power(1, -4.0) - 0.25 * (-1_f64).exp()).abs() < 1e-16);
        assert!((largest_power(3, -2.0) - (-2_f64).exp()).abs() < 1e-16);
    }

    #[test]
    fn a_bound_confirms_itself_where_there_is_one() {
        // e₀ = 1 + e₁/2, e₁ = e₀/4: e₀ = 8/7, e₁ = 2/7.
        let bound = enclose(&[1.0, 0.0], |e| vec![0.5 * e[1], 0.25 * e[0]]);
        assert!((8.0 / 7.0..2.0).contains(&bound[0]) && (2.0 / 7.0..0.6).contains(&bound[1]));
        assert_eq!(enclose(&[0.0], |e| vec![9.0 * e[0]]), [0.0]);
        assert_eq!(enclose(&[1.0], |e| vec![1.5 * e[0]]), [f64::INFINITY]);
        assert_eq!(enclose(&[f64::NAN], <[f64]>::to_vec), [f64::INFINITY]);
    }
}
