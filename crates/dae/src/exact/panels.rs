//! Outputs as piecewise polynomials, with a bound of the interpolation error that holds everywhere.

use dashpot_twofold::Accumulator;

use super::{
    Complex,
    block::{Block, exponential_of},
    coordinates::SpanCoordinates,
    modes::Modes,
    number,
};
use crate::chebyshev::Interpolation;

/// Degree of the panels.
const DEGREE: usize = 16;
/// Interpolation error of a function that is not resolved, relative to its size (1 + Lebesgue
/// constant at degree 16 is below 4).
const UNRESOLVED: f64 = 4.0;
/// Steps per octave to which panel widths are rounded, so that neighbours can share their table.
const PER_OCTAVE: f64 = 4.0;
/// Part of the largest size that counts where the solution itself has decayed.
const FLOOR: f64 = 1e-2;
/// Most panels of a signal, so that no input can make it run for ever; the method declines before
/// that, and the error of a last panel that is too wide would be stated.
const MOST: usize = 4_000_000;
/// Narrowest panel, relative to its span.
const NARROWEST: f64 = 1e-18;

/// Rounding of a panel's borders and of a place within it, relative to the time.
const TIMING: f64 = f64::EPSILON;

/// One polynomial of an output on `[start, end]`, dimensionless.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Piece {
    /// Where it begins.
    pub(super) start: f64,
    /// Where it ends.
    pub(super) end: f64,
    /// Its Chebyshev coefficients.
    pub(super) coefficients: Vec<f64>,
}

/// The modal form of an output: `Σ_j Re (r_j c_j(t))`.
#[derive(Debug, Clone)]
pub(super) struct ModalRow {
    row: Vec<Complex>,
    /// `|r_j|`.
    sizes: Vec<f64>,
    /// What each `|c_j|` adds at most to the size of the output's rate.
    rates: Vec<f64>,
}

/// What is known about a piecewise polynomial as a whole.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Quality {
    /// Largest sum of the sizes of all terms: rounding is relative to it.
    pub(super) size: f64,
    /// Bound of the error.
    pub(super) error: f64,
}

impl ModalRow {
    /// The row `form · X` of a linear form over `z`.
    pub(super) fn new(modes: &Modes, form: &[(usize, f64)]) -> Self {
        let mut row = vec![Complex::default(); modes.len()];
        for block in modes.blocks.iter().filter(|block| block.weight > 0.0) {
            for j in block.range() {
                let (mut re, mut im) = (Accumulator::default(), Accumulator::default());
                for &(i, coefficient) in form {
                    let (x, low) = (modes.basis[(i, j)], modes.basis_low[(i, j)]);
                    re.add_product(coefficient, x.re);
                    im.add_product(coefficient, x.im);
                    re.add_small(coefficient * low.re);
                    im.add_small(coefficient * low.im);
                }
                row[j] = Complex::new(re.value(), im.value()) * block.weight;
            }
        }
        let sizes: Vec<f64> = row.iter().map(|r| r.norm()).collect();
        let mut rates = vec![0.0; modes.len()];
        for block in modes.blocks.iter().filter(|block| block.weight > 0.0) {
            for (rate, column) in rates[block.range()].iter_mut().zip(block.matrix.column_iter()) {
                let pushed = column.iter().zip(&sizes[block.range()]);
                *rate = pushed.map(|(d, r)| d.norm() * r).sum();
            }
        }
        Self { row, sizes, rates }
    }

    /// The value where the modal coordinates are `c`.
    pub(super) fn value(&self, c: &[Complex]) -> f64 {
        self.row.iter().zip(c).map(|(r, c)| (r * c).re).sum()
    }

    /// The sum of all terms' sizes where those of the modal coordinates are `c`.
    fn size_at(&self, c: &[f64]) -> f64 {
        self.sizes.iter().zip(c).map(|(r, c)| r * c).sum()
    }

    /// A bound of the output's rate where the sizes of the modal coordinates are `c`.
    fn rate_at(&self, c: &[f64]) -> f64 {
        self.rates.iter().zip(c).map(|(rate, c)| rate * c).sum()
    }

    /// An upper bound of the sum of all terms' sizes over a span.
    pub(super) fn size(&self, modes: &Modes, span: &SpanCoordinates, length: f64) -> f64 {
        let part = |block: &Block| {
            let sizes: Vec<f64> = span.start[block.range()].iter().map(|c| c.norm()).collect();
            let largest = block.largest(length, &sizes);
            block.range().zip(largest).map(|(i, c)| self.sizes[i] * c).sum::<f64>()
        };
        modes.blocks.iter().filter(|block| block.weight > 0.0).map(part).sum()
    }

    /// The error bound over a span that the coordinates cause.
    pub(super) fn error(&self, modes: &Modes, span: &SpanCoordinates) -> f64 {
        let part =
            |block: &Block| block.range().map(|i| self.sizes[i] * span.error[i]).sum::<f64>();
        modes.blocks.iter().filter(|block| block.weight > 0.0).map(part).sum()
    }

    /// Appends the output on `[start, start + length]`, a span whose coordinates are given, and
    /// updates the `quality`.
    ///
    /// A panel of width `h` misses the solution by at most `4 (h/4)^n/n! · |g^(n)|`, `n = 17`; the
    /// derivative is bounded mode by mode by `|r_j| |λ_j|^n |c_j|`, and no mode can contribute more
    /// than its own size. The widest panel is taken for which that is below the rounding errors.
    pub(super) fn interpolate(
        &self,
        modes: &Modes,
        span: &SpanCoordinates,
        (start, length): (f64, f64),
        scale: f64,
        quality: &mut Quality,
        pieces: &mut Vec<Piece>,
    ) {
        let inherited = self.error(modes, span);
        let mut worst = 0.0_f64;
        let mut table = Table::default();
        let (mut at, mut width) = (0.0, length);
        loop {
            let coordinates = coordinates_at(modes, &span.start, at);
            let sizes = sizes_of(&coordinates);
            let local = self.size_at(&sizes);
            quality.size = quality.size.max(local);
            let tolerance = 2.0 * f64::EPSILON * (local + FLOOR * scale);
            let remaining = length - at;
            let exhausted = pieces.len() >= MOST;
            let least = if exhausted {
                remaining
            } else {
                (NARROWEST * length).max(4.0 * f64::EPSILON * at)
            };
            width = (4.0 * width).min(remaining).max(least);
            let missed = self.narrow(modes, &sizes, tolerance, least, &mut width);
            let shifted = TIMING * (start + at + width) * self.rate_at(&sizes);
            let missed = missed + shifted;
            worst = if missed.is_finite() { worst.max(missed) } else { f64::INFINITY };
            let end = if width >= remaining { length } else { at + width };
            table.prepare(modes, end - at);
            let mut coefficients = self.fit(modes, &coordinates, &table);
            trim(&mut coefficients, 0.1 * tolerance);
            pieces.push(Piece { start: start + at, end: start + end, coefficients });
            at = end;
            if at >= length {
                break;
            }
        }
        // The sizes at the starts of all panels are known, and here that at the very end.
        let last = sizes_of(&coordinates_at(modes, &span.start, length));
        quality.size = quality.size.max(self.size_at(&last));
        worst = worst.max(TIMING * (start + length) * self.rate_at(&last));
        let error = inherited + worst;
        // Also where it is not a number: then nothing is known.
        quality.error = if error.is_finite() { quality.error.max(error) } else { f64::INFINITY };
    }

    /// Narrows a panel until it is good to `tolerance`, and returns by how much it may miss.
    fn narrow(
        &self,
        modes: &Modes,
        sizes: &[f64],
        tolerance: f64,
        least: f64,
        width: &mut f64,
    ) -> f64 {
        loop {
            let missed = self.missed(modes, sizes, *width);
            if missed <= tolerance || *width <= least {
                return missed;
            }
            let factor = (tolerance / missed).powf(1.0 / number(DEGREE + 1));
            let next = (*width * factor.clamp(0.1, 0.97)).max(least);
            // Rounded down to a step of the scale, so that neighbours have the same width.
            *width = ((next.log2() * PER_OCTAVE).floor() / PER_OCTAVE).exp2();
        }
    }

    /// The bound of the interpolation error of a panel of this width, at whose start the modal
    /// coordinates are of these sizes.
    fn missed(&self, modes: &Modes, sizes: &[f64], width: f64) -> f64 {
        let part = |block: &Block| {
            let range = block.range();
            let rows = &self.sizes[range.clone()];
            if rows.iter().all(|&r| r == 0.0) {
                return 0.0;
            }
            let (size, missed) = block.sizes_on_panel(rows, &sizes[range], width, DEGREE + 1);
            // A product of an overflow and an underflow is not a number: then the size counts.
            if missed < size { 4.0 * missed } else { UNRESOLVED * size }
        };
        modes.blocks.iter().map(part).sum()
    }

    /// The interpolating polynomial on the panel for which the table was prepared.
    fn fit(&self, modes: &Modes, coordinates: &[Complex], table: &Table) -> Vec<f64> {
        let mut values = vec![0.0; DEGREE + 1];
        for (block, factors) in modes.blocks.iter().zip(&table.factors) {
            if block.weight == 0.0 {
                continue;
            }
            if block.len() == 1 {
                let term = self.row[block.start] * coordinates[block.start];
                for (value, factor) in values.iter_mut().zip(factors) {
                    *value += term.re * factor.re - term.im * factor.im;
                }
            } else {
                for (value, &time) in values.iter_mut().zip(&table.times) {
                    let mut vector = coordinates[block.range()].to_vec();
                    block.advance(time, &mut vector);
                    *value += self.row[block.range()]
                        .iter()
                        .zip(&vector)
                        .map(|(r, c)| (r * c).re)
                        .sum::<f64>();
                }
            }
        }
        let mut coefficients = vec![0.0; DEGREE + 1];
        Interpolation::of_degree(DEGREE).coefficients(&values, &mut coefficients);
        coefficients
    }
}

/// `e^{D t} c`.
pub(super) fn coordinates_at(modes: &Modes, start: &[Complex], t: f64) -> Vec<Complex> {
    let mut coordinates = start.to_vec();
    if t != 0.0 {
        for block in modes.blocks.iter().filter(|block| block.weight > 0.0) {
            block.advance(t, &mut coordinates[block.range()]);
        }
    }
    coordinates
}

fn sizes_of(coordinates: &[Complex]) -> Vec<f64> {
    coordinates.iter().map(|c| c.norm()).collect()
}

/// `e^{λ t}` of all single modes at the nodes of a panel of one width.
#[derive(Debug, Default)]
struct Table {
    width: f64,
    times: Vec<f64>,
    factors: Vec<Vec<Complex>>,
}

impl Table {
    #[expect(clippy::float_cmp, reason = "panels of the very same width share the table")]
    fn prepare(&mut self, modes: &Modes, width: f64) {
        if self.width == width && !self.factors.is_empty() {
            return;
        }
        self.width = width;
        let nodes = Interpolation::of_degree(DEGREE);
        self.times = nodes.nodes().iter().map(|x| 0.5 * width * (1.0 + x)).collect();
        let factors = |block: &Block| {
            if block.len() > 1 || block.weight == 0.0 {
                return Vec::new();
            }
            let (high, low) = (block.matrix[(0, 0)], block.low[(0, 0)]);
            self.times.iter().map(|&t| exponential_of(high, low, t)).collect()
        };
        self.factors = modes.blocks.iter().map(factors).collect();
    }
}

/// Drops the last coefficients as long as their sum stays below `negligible`.
fn trim(coefficients: &mut Vec<f64>, negligible: f64) {
    let mut dropped = 0.0;
    while coefficients.len() > 1 {
        dropped += coefficients[coefficients.len() - 1].abs();
        if dropped > negligible {
            break;
        }
        coefficients.pop();
    }
}
