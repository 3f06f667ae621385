//! What modes do on panels of certain widths, which all outputs share, and what blocks contribute there to one output.

use std::{
    cell::OnceCell,
    collections::HashMap,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

use dashpot_numerics::chebyshev::Interpolation;
use nalgebra::DMatrix;

use super::{
    Complex,
    block::{Block, exponential_of},
    modes::Modes,
};

/// Degree of the panels.
pub(super) const DEGREE: usize = 16;
/// Coefficients of a panel.
pub(super) const COUNT: usize = DEGREE + 1;
/// Panels of one width, one behind the other, whose coordinates are told from those of the first one.
pub(super) const LINKS: usize = 8;
/// Steps per octave of the widths.
const PER_OCTAVE: f64 = 4.0;
/// Bits of a number that are cut off a width, so that multiples of it and most of their sums are exact.
const CUT: u32 = 32;
/// Largest cluster of modes of which tables are made: they grow as its square.
const MOST_MODES: usize = 24;
/// Interpolation error of a function that is not resolved, relative to its size (1 + Lebesgue
/// constant at degree 16 is below 4).
const UNRESOLVED: f64 = 4.0;
/// Interpolation error in parts of `(h/4)^n/n! · |g^(n)|`.
const RESOLVED: f64 = 4.0;

pub(super) fn width_of(step: i32) -> f64 {
    let width = (f64::from(step) / PER_OCTAVE).exp2();
    f64::from_bits(width.to_bits() >> CUT << CUT)
}

/// The first step that is no narrower than `width`, or as good as the last one that is narrower.
#[expect(
    clippy::cast_possible_truncation,
    reason = "logarithms are small, and bounded by the cast"
)]
pub(super) fn step_of(width: f64) -> i32 {
    (width.log2() * PER_OCTAVE).ceil() as i32
}

/// A bound of the interpolation error from that of a resolved function and the size.
pub(super) fn at_most(missed: f64, size: f64) -> f64 {
    // A product of an overflow and an underflow is not a number: then the size counts.
    if missed < size { RESOLVED * missed } else { UNRESOLVED * size }
}

/// A polynomial with complex coefficients.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    re: [f64; COUNT],
    im: [f64; COUNT],
}

impl Shape {
    pub(super) const ZERO: Self = Self { re: [0.0; COUNT], im: [0.0; COUNT] };

    pub(super) fn of(values: &[Complex; COUNT]) -> Self {
        let mut shape = Self::ZERO;
        let interpolation = Interpolation::of_degree(DEGREE);
        interpolation.coefficients(&values.map(|value| value.re), &mut shape.re);
        interpolation.coefficients(&values.map(|value| value.im), &mut shape.im);
        shape
    }

    /// `sum ← sum + Re (factor · self)`.
    #[inline]
    pub(super) fn add_to(&self, factor: Complex, sum: &mut [f64; COUNT]) {
        for ((sum, re), im) in sum.iter_mut().zip(&self.re).zip(&self.im) {
            *sum += factor.re * re - factor.im * im;
        }
    }

    /// `self ← self + factor · other`.
    pub(super) fn add(&mut self, factor: Complex, other: &Self) {
        for k in 0..COUNT {
            self.re[k] += factor.re * other.re[k] - factor.im * other.im[k];
            self.im[k] += factor.re * other.im[k] + factor.im * other.re[k];
        }
    }
}

/// What bounds the interpolation error of a block on panels of one width.
#[derive(Debug)]
pub(super) enum Bounds {
    /// Of a single mode: the bound in parts of its size at the panel's start.
    Single(f64),
    /// Of a cluster.
    Cluster {
        /// `|e^{D t}|` at most.
        largest: DMatrix<f64>,
        /// `|D h/4|^n/n! |e^{D t}|` at most.
        missed: DMatrix<f64>,
    },
    /// Of a cluster of too many modes, or of one that is not evaluated: none.
    None,
}

/// What a block does on panels of one width.
#[derive(Debug)]
pub(super) enum Course {
    /// Of a single mode.
    Single {
        /// `e^{λ t}`.
        shape: Box<Shape>,
        /// `e^{λ h}`, `e^{2 λ h}`, …, as far as they were asked for.
        links: Box<[OnceLock<Complex>; LINKS]>,
    },
    /// `e^{D t}` of a cluster, column by column.
    Cluster(Vec<Shape>),
    /// As [`Bounds::None`].
    None,
}

/// Panels of one width.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) width: f64,
    /// By block.
    pub(super) bounds: Vec<Bounds>,
    courses: Vec<OnceLock<Course>>,
}

impl Table {
    fn new(modes: &Modes, width: f64) -> Self {
        let bounds = modes.blocks.iter().map(|block| Bounds::of(block, width)).collect();
        let courses = modes.blocks.iter().map(|_| OnceLock::new()).collect();
        Self { width, bounds, courses }
    }

    /// What the block of this number does.
    pub(super) fn course(&self, modes: &Modes, at: usize) -> &Course {
        self.courses[at].get_or_init(|| Course::of(&modes.blocks[at], self.width))
    }

    /// `e^{(k + 1) λ h}` of a single mode.
    pub(super) fn link(&self, modes: &Modes, at: usize, k: usize) -> Option<Complex> {
        let Course::Single { links, .. } = self.course(modes, at) else { return None };
        let (block, time) = (&modes.blocks[at], (k + 1) as f64 * self.width);
        let link = || exponential_of(block.matrix[(0, 0)], block.low[(0, 0)], time);
        Some(*links[k].get_or_init(link))
    }
}

pub(super) fn is_told(block: &Block) -> bool {
    block.weight > 0.0 && block.len() <= MOST_MODES
}

impl Bounds {
    pub(super) fn of(block: &Block, width: f64) -> Self {
        if !is_told(block) {
            return Self::None;
        }
        let count = block.len();
        if count == 1 {
            let (size, missed) = block.sizes_on_panel(&[1.0], &[1.0], width, COUNT);
            return Self::Single(at_most(missed, size));
        }
        let mut unit = vec![0.0; count];
        let mut largest = DMatrix::zeros(count, count);
        let mut weights = DMatrix::zeros(count, count);
        for k in 0..count {
            unit[k] = 1.0;
            largest.column_mut(k).copy_from_slice(&block.largest(width, &unit));
            let row = block.derivative_weights(&unit, 0.25 * width, COUNT);
            weights.row_mut(k).iter_mut().zip(row).for_each(|(own, weight)| *own = weight);
            unit[k] = 0.0;
        }
        let missed = weights * &largest;
        Self::Cluster { largest, missed }
    }
}

impl Course {
    fn of(block: &Block, width: f64) -> Self {
        if !is_told(block) {
            return Self::None;
        }
        let nodes = Interpolation::of_degree(DEGREE);
        let times = nodes.nodes().iter().map(|x| 0.5 * width * (1.0 + x));
        if block.len() == 1 {
            let (high, low) = (block.matrix[(0, 0)], block.low[(0, 0)]);
            let mut values = [Complex::default(); COUNT];
            values.iter_mut().zip(times).for_each(|(own, t)| *own = exponential_of(high, low, t));
            return Self::Single { shape: Box::new(Shape::of(&values)), links: Box::default() };
        }
        let count = block.len();
        let motion = block.motion();
        let mut values = vec![[Complex::default(); COUNT]; count * count];
        let mut column = vec![Complex::default(); count];
        for (node, time) in times.enumerate() {
            for j in 0..count {
                column.fill(Complex::default());
                column[j] = Complex::new(1.0, 0.0);
                motion.advance(time, &mut column);
                for (i, value) in column.iter().enumerate() {
                    values[j * count + i][node] = *value;
                }
            }
        }
        Self::Cluster(values.iter().map(Shape::of).collect())
    }
}

/// The tables that have been asked for.
#[derive(Debug, Default)]
pub(super) struct Tables(Mutex<HashMap<i32, Arc<Table>>>);

impl Tables {
    /// That of panels of the width of this step.
    pub(super) fn at(&self, modes: &Modes, step: i32) -> Arc<Table> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let table = known.entry(step);
        Arc::clone(table.or_insert_with(|| Arc::new(Table::new(modes, width_of(step)))))
    }

    /// Drops them all.
    pub(super) fn clear(&self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = HashMap::new();
    }
}

/// An output on panels of the width of one step.
pub(super) struct Line {
    pub(super) table: Arc<Table>,
    /// The parts of the active blocks.
    pub(super) shares: Vec<Share>,
}

/// A block's part in an output on panels of one width.
pub(super) enum Share {
    /// By which part of its coordinate's size a single mode may be missed at most.
    Single(f64),
    /// That of a cluster.
    Cluster(Box<Cluster>),
    /// That of a block of which no tables are made.
    Apart,
}

/// A cluster's part, mode by mode in parts of the sizes of its coordinates at the panel's start.
pub(super) struct Cluster {
    /// Its largest size.
    size: Vec<f64>,
    /// By how much it may be missed.
    missed: Vec<f64>,
    shapes: OnceCell<Vec<Shape>>,
}

impl Share {
    pub(super) fn new(row: &[f64], bounds: &Bounds) -> Self {
        match bounds {
            Bounds::Single(weight) => Self::Single(row[0] * weight),
            Bounds::Cluster { largest, missed } => {
                let part = |matrix: &DMatrix<f64>| -> Vec<f64> {
                    let columns = matrix.column_iter();
                    columns.map(|column| dot(row, column.as_slice())).collect()
                };
                let shapes = OnceCell::new();
                Self::Cluster(Box::new(Cluster {
                    size: part(largest),
                    missed: part(missed),
                    shapes,
                }))
            }
            Bounds::None => Self::Apart,
        }
    }
}

impl Cluster {
    /// By how much a panel may miss it, at whose start the coordinates are of these sizes.
    pub(super) fn missed(&self, sizes: &[f64]) -> f64 {
        at_most(dot(&self.missed, sizes), dot(&self.size, sizes))
    }

    /// What each coordinate becomes in the output.
    pub(super) fn shapes(&self, row: &[Complex], columns: &[Shape]) -> &[Shape] {
        let shape = |column: &[Shape]| {
            let mut sum = Shape::ZERO;
            row.iter().zip(column).for_each(|(&factor, own)| sum.add(factor, own));
            sum
        };
        self.shapes.get_or_init(|| columns.chunks_exact(row.len()).map(shape).collect())
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
