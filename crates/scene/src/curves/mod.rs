//! Measured curves as laws take them: never falling, from rest on, unloading below loading.
//!
//! Rows of a test are noisy, repeat a deformation, and begin where the machine began. What a law takes is found by
//! isotonic regression, the curve without a fall that is nearest to the rows by least squares; where it differs from
//! them is a [`CurveChange`], which is told.

mod change;
mod fit;
mod record;
mod thin;

pub use change::CurveChange;
pub(crate) use fit::{fit, unloading};
pub(crate) use record::{outward, split, turning_row};

/// Rows of a curve in the order of a file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    /// Deformation \[m\] or strain.
    pub(crate) at: f64,
    /// Force \[N\] or stress \[Pa\].
    pub(crate) value: f64,
    /// The byte of the text at which the row begins.
    pub(crate) start: usize,
}

/// The points of a law, and how far they are from the rows that they stand for.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fitted {
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) difference: Difference,
}

/// How far a curve is from rows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Difference {
    pub(crate) largest: f64,
    /// The byte at which its row begins.
    pub(crate) start: usize,
    /// The mean of the differences of all rows.
    pub(crate) mean: f64,
    /// The largest value.
    pub(crate) peak: f64,
    pub(crate) rows: usize,
    /// Where the curve begins, where no row is at rest.
    pub(crate) begins: Option<(f64, f64)>,
}

#[cfg(test)]
mod tests;
