//! What blocks contribute to one output on panels of one width.

use std::{cell::OnceCell, sync::Arc};

use nalgebra::DMatrix;

use super::{
    Complex,
    tables::{Bounds, Shape, Table, at_most},
};

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
