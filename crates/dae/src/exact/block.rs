//! One block of the block-diagonal form and its exponential.

use dashpot_numerics::{two_product, two_sum};
use nalgebra::DMatrix;

use super::Complex;

/// Size of `M t` up to which the exponential's series is summed in one go.
pub(super) const REACH: f64 = 2.0;
/// Steps of that size up to which a vector is carried along instead of a matrix.
pub(super) const STEPS: f64 = 16.0;
/// Most terms of any series here; all end far earlier.
pub(super) const TERMS: usize = 200;

/// A square block `D_i` of the block-diagonal form: a single eigenvalue, or a cluster.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Block {
    /// Index of its first mode.
    pub(super) start: usize,
    /// `D_i`.
    pub(super) matrix: DMatrix<Complex>,
    /// What rounding cut off `D_i`, to be added to it.
    pub(super) low: DMatrix<Complex>,
    /// How often its contribution counts: once, twice for one of a conjugate pair, or never for the other one.
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

    pub(super) fn moves(&self, coordinates: &[Complex]) -> bool {
        coordinates[self.range()].iter().any(|own| *own != Complex::default())
    }

    /// The rate of growth: the largest real part on the diagonal.
    pub(super) fn growth_rate(&self) -> f64 {
        (0..self.len()).map(|i| self.matrix[(i, i)].re).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The growth rate with the mean frequency.
    pub(super) fn shift(&self) -> Complex {
        let sum: f64 = (0..self.len()).map(|i| self.matrix[(i, i)].im).sum();
        Complex::new(self.growth_rate(), sum / self.len() as f64)
    }

    /// `D_i − shift`.
    pub(super) fn offset(&self, shift: Complex) -> DMatrix<Complex> {
        let mut rest = self.matrix.clone();
        for i in 0..self.len() {
            rest[(i, i)] -= shift;
        }
        rest + &self.low
    }

    /// What it costs to advance by times up to `t` \[s\] beyond what a single mode does, in units of the budget.
    pub(super) fn cost(&self, t: f64) -> u64 {
        /// Some 60 products of small matrices.
        const SQUARED: u64 = 100;
        let size = || largest_column(&self.offset(self.shift()).map(Complex::norm));
        let is_squared = self.len() > 1 && size() * t > REACH * STEPS;
        if is_squared { SQUARED * (self.len() * self.len()) as u64 } else { 0 }
    }

    /// How it moves, to be asked at many times.
    pub(super) fn motion(&self) -> Motion {
        if self.len() == 1 {
            let (shift, low) = (self.matrix[(0, 0)], self.low[(0, 0)]);
            return Motion { shift, low, rest: DMatrix::zeros(0, 0), size: 0.0 };
        }
        // Around the fastest growing eigenvalue nothing that is left can overflow.
        let shift = self.shift();
        let rest = self.offset(shift);
        let size = largest_column(&rest.map(Complex::norm));
        Motion { shift, low: Complex::default(), rest, size }
    }

    /// `vector ← e^{D_i t} vector`.
    pub(super) fn advance(&self, t: f64, vector: &mut [Complex]) {
        self.motion().advance(t, vector);
    }
}

/// The exponential of a block.
#[derive(Debug)]
pub(super) struct Motion {
    shift: Complex,
    low: Complex,
    /// `D_i − shift`; nothing of a single mode.
    rest: DMatrix<Complex>,
    /// The largest sum of a column of it.
    size: f64,
}

impl Motion {
    /// `vector ← e^{D_i t} vector`.
    pub(super) fn advance(&self, t: f64, vector: &mut [Complex]) {
        if vector.iter().all(|value| *value == Complex::default()) {
            return;
        }
        let factor = exponential_of(self.shift, self.low, t);
        if !self.rest.is_empty() {
            let steps = (self.size * t / REACH).ceil().max(1.0);
            if steps <= STEPS {
                let part = self.rest.map(|own| own * t / steps);
                let mut left = steps;
                while left > 0.0 {
                    series(&part, vector);
                    left -= 1.0;
                }
            } else {
                let result = squared(self.rest.map(|own| own * t), steps, vector);
                vector.copy_from_slice(&result);
            }
        }
        vector.iter_mut().for_each(|value| *value *= factor);
    }
}

/// The largest sum of a column.
pub(super) fn largest_column(sizes: &DMatrix<f64>) -> f64 {
    sizes.column_iter().map(|column| column.sum()).fold(0.0, f64::max)
}

/// `vector ← e^{matrix} vector` by its series, for small matrices.
fn series(matrix: &DMatrix<Complex>, vector: &mut [Complex]) {
    let (mut term, mut next) = (vector.to_vec(), vector.to_vec());
    for k in 1..TERMS {
        next.fill(Complex::default());
        let moving = |t: &&Complex| **t != Complex::default();
        let columns = matrix.as_slice().chunks_exact(vector.len());
        for (t, column) in term.iter().zip(columns).filter(|own| moving(&own.0)) {
            // Most blocks are triangular.
            for (n, entry) in next.iter_mut().zip(column).filter(|own| moving(&own.1)) {
                *n += entry * t / k as f64;
            }
        }
        std::mem::swap(&mut term, &mut next);
        if term.iter().all(|t| *t == Complex::default()) {
            return;
        }
        let mut settled = true;
        for (sum, t) in vector.iter_mut().zip(&term) {
            settled &= size_of(*t) <= 1e-18 * size_of(*sum);
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

/// `|z|`.
pub(super) fn size_of(z: Complex) -> f64 {
    let square = z.re * z.re + z.im * z.im;
    // Beyond this range of squares digits are lost.
    if square > 1e-280 && square < 1e280 { square.sqrt() } else { z.norm() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(size: usize, entries: &[f64]) -> Block {
        let matrix = DMatrix::from_row_slice(size, size, entries).map(|x| Complex::new(x, 0.0));
        Block::new(0, matrix)
    }

    #[test]
    fn what_is_at_rest_stays_so_however_long() {
        // Powers of it leave the range of numbers.
        let coupled = block(3, &[-1e-3, 1e25, 1e30, 0.0, -1e-6, 1e30, 0.0, 0.0, 0.0]);
        let mut rest = [Complex::default(); 3];
        coupled.advance(1e10, &mut rest);
        assert_eq!(rest, [Complex::default(); 3]);
        for bound in [coupled.largest(1e10, &[0.0; 3]), coupled.integral(1e10, &[0.0; 3], 0.0)] {
            assert_eq!(bound, [0.0; 3]);
        }
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
}
