//! What became of the rows of a measured curve.

use std::fmt;

use dashpot_network::parameters::Dimension;
use dashpot_units::format_short;

/// How far the curve of a law is from the rows of the file that it is read from.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveChange {
    /// Of which parameter it is the curve: "table-spring", "unloading".
    pub curve: &'static str,
    /// Rows of the file that it stands for.
    pub rows: usize,
    /// Points of the curve.
    pub points: usize,
    /// The largest difference, a force \[N\] or a stress \[Pa\].
    pub largest: f64,
    /// Line of the file at which it is, from 1.
    pub line: usize,
    /// The mean of the differences of all rows \[N or Pa\].
    pub mean: f64,
    /// The largest value of the curve \[N or Pa\].
    pub peak: f64,
    /// What the values are.
    pub dimension: Dimension,
    /// The first row, deformation or strain and value, where it is far from rest: a line leads there from (0, 0).
    pub begins: Option<(f64, f64)>,
}

/// A change above this part of the peak is more than noise.
const NOISE: f64 = 0.05;
/// Smaller parts are rounding.
const ROUNDING: f64 = 1e-9;

impl CurveChange {
    /// Whether there is something to say.
    pub(crate) fn is_any(&self) -> bool {
        self.largest > ROUNDING * self.peak || self.points + 1 < self.rows || self.is_late()
    }

    /// Whether it is more than noise.
    pub fn is_large(&self) -> bool {
        self.largest > NOISE * self.peak
    }

    /// Whether the curve begins far from rest.
    fn is_late(&self) -> bool {
        self.begins.is_some_and(|own| own.1 > NOISE * self.peak)
    }
}

impl fmt::Display for CurveChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let shown = |value| format_short(value, self.dimension, 3);
        let Self { curve, rows, points, line, .. } = self;
        write!(f, "`{curve}` has {points} points for {rows} rows")?;
        if self.largest > 0.0 {
            let part = 100.0 * self.largest / self.peak;
            write!(
                f,
                ", and differs from them by {} at most, {part:.2} % of the peak, in line {line}, and by {} in the mean",
                shown(self.largest),
                shown(self.mean),
            )?;
        }
        match self.begins.filter(|_| self.is_late()) {
            Some((_, value)) => {
                write!(
                    f,
                    "; its first row has {} already, to which a line leads from zero",
                    shown(value)
                )
            }
            None => Ok(()),
        }
    }
}
