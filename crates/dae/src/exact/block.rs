//! One block of the block-diagonal form and its exponential.

use nalgebra::DMatrix;

use super::{
    Complex,
    double_double::{two_product, two_sum},
    number,
};

/// Size of `M t` up to which the exponential's series is summed in one go.
const REACH: f64 = 2.0;
/// Steps of that size up to which a vector is carried along instead of a matrix.
const STEPS: f64 = 16.0;
/// Most terms of any series here; all end far earlier.
const TERMS: usize = 200;

/// A square block `D_i` of the block-diagonal form: a single eigenvalue, or a cluster.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// Index of its first mode.
    pub(super) start: usize,
    /// `D_i`.
    pub(super) matrix: DMatrix<Complex>,
    /// What rounding cut off `D_i`, to be added to it.
    pub(super) low: DMatrix<Complex>,
    /// How often its contribution counts: once, twice for one of a conjugate pair, or never for
    /// the other one.
    pub(super) weight: f64,
}

/// `e^{λ t}` where `λ = high + low`; the phase is kept to twice the digits of a double.
pub(super) fn exponential_of(high: Complex, low: Complex, t: f64) -> Complex {
    let ((re, re_rest), (im, im_rest)) = (two_product(high.re, t), two_product(high.im, t));
    let (sin, cos) = im.sin_cos();
    let size = re.exp();
    if size == 0.0 || !size.is_finite() {
        return Complex::new(size * cos, size * sin);
    }
    let rest = Complex::new(re_rest + low.re * t, im_rest + low.im * t);
    Complex::new(size * cos, size * sin) * (rest + 1.0)
}

impl Block {
    /// A block that begins at mode `start` and counts once.
    pub(super) fn new(start: usize, matrix: DMatrix<Complex>) -> Self {
        let low = DMatrix::zeros(matrix.nrows(), matrix.nrows());
        Self { start, matrix, low, weight: 1.0 }
    }

    /// Number of modes.
    pub(super) fn len(&self) -> usize {
        self.matrix.nrows()
    }

    /// The modes' indices.
    pub(super) fn range(&self) -> std::ops::Range<usize> {
        self.start..self.start + self.len()
    }

    /// `D_i ← D_i + change`, rounded to twice the digits.
    pub(super) fn correct(&mut self, i: usize, j: usize, change: Complex) {
        let old = (self.matrix[(i, j)], self.low[(i, j)]);
        let (re, re_rest) = two_sum(old.0.re, old.1.re + change.re);
        let (im, im_rest) = two_sum(old.0.im, old.1.im + change.im);
        self.matrix[(i, j)] = Complex::new(re, im);
        self.low[(i, j)] = Complex::new(re_rest, im_rest);
    }

    /// The rate of growth: the largest real part on the diagonal.
    pub(super) fn growth_rate(&self) -> f64 {
        (0..self.len()).map(|i| self.matrix[(i, i)].re).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The growth rate with the mean frequency.
    fn shift(&self) -> Complex {
        let sum: f64 = (0..self.len()).map(|i| self.matrix[(i, i)].im).sum();
        Complex::new(self.growth_rate(), sum / number(self.len()))
    }

    /// `vector ← e^{D_i t} vector`.
    pub(super) fn advance(&self, t: f64, vector: &mut [Complex]) {
        if let [value] = vector {
            *value *= exponential_of(self.matrix[(0, 0)], self.low[(0, 0)], t);
            return;
        }
        // Around the fastest growing eigenvalue nothing that is left can overflow.
        let shift = self.shift();
        let mut rest = self.matrix.clone();
        for i in 0..self.len() {
            rest[(i, i)] -= shift;
        }
        rest += &self.low;
        rest *= Complex::new(t, 0.0);
        let size = rest.column_iter().map(|c| c.iter().map(|z| z.norm()).sum()).fold(0.0, f64::max);
        let steps = (size / REACH).ceil().max(1.0);
        let mut result = vector.to_vec();
        if steps <= STEPS {
            rest /= Complex::new(steps, 0.0);
            let mut left = steps;
            while left > 0.0 {
                series(&rest, &mut result);
                left -= 1.0;
            }
        } else {
            result = squared(rest, steps, &result);
        }
        let factor = exponential_of(shift, Complex::default(), t);
        for (out, value) in vector.iter_mut().zip(result) {
            *out = value * factor;
        }
    }

    /// `Σ_k f_k |N|^k s^k/k! · vector`, where `N` is the block without its diagonal and
    /// `f_k = factor(k)` for rising `k`.
    ///
    /// With `f_k = sup (t/s)^k e^{σ t}` it bounds `|e^{D_i t} v|` entry by entry for `|v| ≤ vector`.
    /// Infinite where the series does not settle.
    fn majorant(&self, s: f64, vector: &[f64], mut factor: impl FnMut(usize) -> f64) -> Vec<f64> {
        let first = factor(0);
        let mut sum: Vec<f64> = vector.iter().map(|v| v * first).collect();
        if self.len() == 1 {
            return sum;
        }
        let mut term = vector.to_vec();
        for k in 1..TERMS {
            let mut next = vec![0.0; term.len()];
            for (j, t) in term.iter().enumerate() {
                for (i, n) in next.iter_mut().enumerate() {
                    if i != j {
                        *n += self.matrix[(i, j)].norm() * t * (s / number(k));
                    }
                }
            }
            term = next;
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

    /// A bound of `t |D_i − shift| |e^{D_i t} v|` for all `t` in `[0, s]` and `|v| ≤ vector`, where the
    /// shift is that of [`advance`](Self::advance): what one rounding of the block's entries changes,
    /// in units of `ε`. Zero for a single mode, whose phase is kept to twice the digits.
    pub(super) fn strain(&self, s: f64, vector: &[f64]) -> Vec<f64> {
        if self.len() == 1 {
            return vec![0.0];
        }
        let shift = self.shift();
        let pushed = |i: usize| -> f64 {
            let push = |(j, v): (usize, &f64)| {
                let middle = if i == j { shift } else { Complex::default() };
                (self.matrix[(i, j)] - middle).norm() * s * v
            };
            vector.iter().enumerate().map(push).sum()
        };
        let pushed: Vec<f64> = (0..self.len()).map(pushed).collect();
        let sigma = self.growth_rate();
        self.majorant(s, &pushed, |k| largest_power(k + 1, sigma * s))
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
            let order = number(k);
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

    /// Bounds of `|row · e^{D_i t} c|` and of `|row| |D_i h/4|^n/n! |e^{D_i t} c|` for all `t` in
    /// `[0, h]`: how large the block's part of an output can be, and how far a polynomial of degree
    /// `n − 1` can miss it, but for a factor.
    pub(super) fn sizes_on_panel(
        &self,
        row: &[f64],
        c: &[Complex],
        h: f64,
        n: usize,
    ) -> (f64, f64) {
        if let ([row], [c]) = (row, c) {
            let rate = self.matrix[(0, 0)];
            let size = row * c.norm() * (rate.re * h).exp().max(1.0);
            let step = 0.25 * h * rate.norm();
            return (size, (1..=n).fold(size, |term, order| term * (step / number(order))));
        }
        let sizes: Vec<f64> = c.iter().map(|c| c.norm()).collect();
        let largest = self.largest(h, &sizes);
        let weights = self.derivative_weights(row, 0.25 * h, n);
        let sum = |weights: &[f64]| weights.iter().zip(&largest).map(|(w, c)| w * c).sum();
        (sum(row), sum(&weights))
    }

    /// `|row| |D_i h|^n / n!`, the share of each mode in the `n`-th Taylor term of `row · e^{D_i h}`.
    fn derivative_weights(&self, row: &[f64], h: f64, n: usize) -> Vec<f64> {
        let mut weights = row.to_vec();
        for order in 1..=n {
            let mut next = vec![0.0; weights.len()];
            for (j, value) in next.iter_mut().enumerate() {
                for (i, w) in weights.iter().enumerate() {
                    *value += w * self.matrix[(i, j)].norm() * (h / number(order));
                }
            }
            weights = next;
        }
        weights
    }
}

/// The largest `x^k e^{exponent x}` for `x` in `[0, 1]`.
fn largest_power(k: usize, exponent: f64) -> f64 {
    let order = number(k);
    if k == 0 {
        exponent.exp().max(1.0)
    } else if exponent >= -order {
        exponent.exp()
    } else {
        (order * (order / -exponent).ln() - order).exp()
    }
}

/// `vector ← e^{matrix} vector` by its series, for small matrices.
fn series(matrix: &DMatrix<Complex>, vector: &mut [Complex]) {
    let mut term = vector.to_vec();
    for k in 1..TERMS {
        let mut next = vec![Complex::default(); term.len()];
        for (j, t) in term.iter().enumerate() {
            for (i, n) in next.iter_mut().enumerate() {
                *n += matrix[(i, j)] * t / number(k);
            }
        }
        term = next;
        let mut settled = true;
        for (sum, t) in vector.iter_mut().zip(&term) {
            settled &= t.norm() <= 1e-18 * sum.norm();
            *sum += t;
        }
        if settled && k >= vector.len() {
            return;
        }
    }
}

/// `e^{matrix} vector` by scaling and squaring.
fn squared(mut matrix: DMatrix<Complex>, steps: f64, vector: &[Complex]) -> Vec<Complex> {
    let halvings = (4.0 * steps).log2().ceil().min(1000.0);
    matrix *= Complex::new((-halvings).exp2(), 0.0);
    let size = matrix.nrows();
    let mut power = DMatrix::identity(size, size);
    for column in 0..size {
        series(&matrix, &mut power.as_mut_slice()[column * size..][..size]);
    }
    let mut left = halvings;
    while left > 0.0 {
        power = &power * &power;
        left -= 1.0;
    }
    (power * nalgebra::DVector::from_column_slice(vector)).as_slice().to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(size: usize, entries: &[f64]) -> Block {
        let matrix = DMatrix::from_row_slice(size, size, entries).map(|x| Complex::new(x, 0.0));
        Block::new(0, matrix)
    }

    #[test]
    fn a_jordan_block_gives_its_polynomial_times_the_exponential() {
        let jordan = block(3, &[-1.0, 1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0]);
        for t in [0.0, 1e-3, 1.0, 30.0, 200.0] {
            let mut v = [0.0, 0.0, 1.0].map(|x| Complex::new(x, 0.0));
            jordan.advance(t, &mut v);
            let expected = 0.5 * t * t * (-t).exp();
            assert!((v[0].re - expected).abs() <= 1e-13 * expected, "{t}");
        }
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
}
