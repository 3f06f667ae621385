//! The modal form of an output.

use std::ops::Range;

use dashpot_numerics::Accumulator;
use dashpot_numerics::chebyshev::Interpolation;
use nalgebra::{DMatrix, DVectorView};

use super::{
    Complex,
    block::{Block, exponential_of, size_of},
    coordinates::SpanCoordinates,
    modes::Modes,
    tables::{Bounds, COUNT, DEGREE, at_most},
};

/// The modal form of an output: `Σ_j Re (r_j c_j(t))`.
#[derive(Debug, Clone)]
pub(super) struct ModalRow {
    row: Vec<Complex>,
    /// `|r_j|`.
    sizes: Vec<f64>,
    /// What each `|c_j|` adds at most to the size of the output's rate.
    rates: Vec<f64>,
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
        self.row.iter().zip(c).map(|(r, c)| r.re * c.re - r.im * c.im).sum()
    }

    /// The sum of all terms' sizes where those of the modal coordinates are `c`.
    pub(super) fn size_at(&self, c: &[f64]) -> f64 {
        self.sizes.iter().zip(c).map(|(r, c)| r * c).sum()
    }

    /// A bound of the output's rate where the sizes of the modal coordinates are `c`.
    pub(super) fn rate_at(&self, c: &[f64]) -> f64 {
        self.rates.iter().zip(c).map(|(rate, c)| rate * c).sum()
    }

    /// An upper bound of the sum of all terms' sizes over a span, in which the coordinates are at most so
    /// [large](largest_of).
    pub(super) fn size(&self, modes: &Modes, largest: &[f64]) -> f64 {
        let part = |block: &Block| block.range().map(|i| self.sizes[i] * largest[i]).sum::<f64>();
        modes.blocks.iter().filter(|block| block.weight > 0.0).map(part).sum()
    }

    /// The error bound over a span that the coordinates cause.
    pub(super) fn error(&self, modes: &Modes, span: &SpanCoordinates) -> f64 {
        let part =
            |block: &Block| block.range().map(|i| self.sizes[i] * span.error[i]).sum::<f64>();
        modes.blocks.iter().filter(|block| block.weight > 0.0).map(part).sum()
    }

    /// The bound of the interpolation error of a panel of this width, at whose start the modal
    /// coordinates are of these sizes.
    pub(super) fn missed(&self, modes: &Modes, sizes: &[f64], width: f64) -> f64 {
        let part = |block: &Block| self.missed_of(block, &sizes[block.range()], width);
        modes.blocks.iter().filter(|block| self.has_part(block)).map(part).sum()
    }

    /// That of a block alone.
    pub(super) fn missed_of(&self, block: &Block, sizes: &[f64], width: f64) -> f64 {
        if sizes.iter().all(|size| *size == 0.0) {
            return 0.0;
        }
        let (size, missed) =
            block.sizes_on_panel(self.sizes_in(block.range()), sizes, width, COUNT);
        at_most(missed, size)
    }

    /// The same where the errors of the blocks are bounded in parts of sizes.
    pub(super) fn missed_within(&self, modes: &Modes, bounds: &[Bounds], sizes: &[f64]) -> f64 {
        let parts = modes.blocks.iter().zip(bounds).filter(|(block, _)| self.has_part(block));
        let missed = |(block, bounds): (&Block, &Bounds)| match bounds {
            Bounds::None => 0.0,
            Bounds::Single(weight) => weight * self.sizes[block.start] * sizes[block.start],
            Bounds::Cluster { largest, missed } => {
                let (row, own) = (self.sizes_in(block.range()), &sizes[block.range()]);
                at_most(product(row, missed, own), product(row, largest, own))
            }
        };
        parts.map(missed).sum()
    }

    /// The interpolating polynomial on a panel of this width, at whose start the modal coordinates are given.
    pub(super) fn fit(&self, modes: &Modes, coordinates: &[Complex], width: f64) -> [f64; COUNT] {
        let mut values = [0.0; COUNT];
        for block in modes.blocks.iter().filter(|block| self.has_part(block)) {
            self.add_values(block, &coordinates[block.range()], width, &mut values);
        }
        coefficients(&values)
    }

    /// That of a block alone.
    pub(super) fn fit_block(
        &self,
        block: &Block,
        coordinates: &[Complex],
        width: f64,
    ) -> [f64; COUNT] {
        let mut values = [0.0; COUNT];
        self.add_values(block, coordinates, width, &mut values);
        coefficients(&values)
    }

    /// Adds a block's part at the nodes of a panel.
    fn add_values(
        &self,
        block: &Block,
        coordinates: &[Complex],
        width: f64,
        values: &mut [f64; COUNT],
    ) {
        let nodes = Interpolation::of_degree(DEGREE);
        let factors = self.factors_in(block.range());
        let times = nodes.nodes().iter().map(|x| 0.5 * width * (1.0 + x));
        if let ([factor], [coordinate]) = (factors, coordinates) {
            let (high, low, term) = (block.matrix[(0, 0)], block.low[(0, 0)], factor * coordinate);
            for (value, time) in values.iter_mut().zip(times) {
                *value += (term * exponential_of(high, low, time)).re;
            }
            return;
        }
        let (motion, mut vector) = (block.motion(), coordinates.to_vec());
        for (value, time) in values.iter_mut().zip(times) {
            vector.copy_from_slice(coordinates);
            motion.advance(time, &mut vector);
            *value += factors.iter().zip(&vector).map(|(r, c)| (r * c).re).sum::<f64>();
        }
    }

    /// Whether a block has a part in the output.
    pub(super) fn has_part(&self, block: &Block) -> bool {
        block.weight > 0.0 && self.sizes_in(block.range()).iter().any(|&size| size != 0.0)
    }

    /// The factors of some modes.
    pub(super) fn factors_in(&self, range: Range<usize>) -> &[Complex] {
        &self.row[range]
    }

    /// The magnitudes of the factors of some modes.
    pub(super) fn sizes_in(&self, range: Range<usize>) -> &[f64] {
        &self.sizes[range]
    }
}

/// `row · matrix · sizes`.
fn product(row: &[f64], matrix: &DMatrix<f64>, sizes: &[f64]) -> f64 {
    let columns = matrix.column_iter().zip(sizes).filter(|(_, size)| **size != 0.0);
    let column =
        |own: DVectorView<'_, f64>| row.iter().zip(own.iter()).map(|(a, b)| a * b).sum::<f64>();
    columns.map(|(own, size)| column(own) * size).sum()
}

fn coefficients(values: &[f64; COUNT]) -> [f64; COUNT] {
    let mut coefficients = [0.0; COUNT];
    Interpolation::of_degree(DEGREE).coefficients(values, &mut coefficients);
    coefficients
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

/// Bounds of `|c_j|` over a span of this length; 0 of modes that are not evaluated.
pub(super) fn largest_of(modes: &Modes, span: &SpanCoordinates, length: f64) -> Vec<f64> {
    let mut all = vec![0.0; modes.len()];
    for block in modes.blocks.iter().filter(|block| block.weight > 0.0) {
        let sizes: Vec<f64> = span.start[block.range()].iter().map(|c| c.norm()).collect();
        all[block.range()].copy_from_slice(&block.largest(length, &sizes));
    }
    all
}

/// `|c_j|` of all coordinates.
pub(super) fn sizes_of(coordinates: &[Complex]) -> Vec<f64> {
    coordinates.iter().map(|&c| size_of(c)).collect()
}
