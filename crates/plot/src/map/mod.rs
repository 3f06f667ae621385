//! Maps: a value over two quantities, as colours with lines of equal value.

mod contours;
mod lines;
mod svg;

use crate::{Scale, axis::Axis};

/// A value over two quantities.
///
/// The points stand on a grid; values that are not finite are gaps.
///
/// # Examples
///
/// ```
/// use dashpot_plot::{Map, MapLimit, Scale};
///
/// let map = Map {
///     title: "Peak force".into(),
///     x_label: "stiffness (MN/m)".into(),
///     y_label: "damping (kN s/m)".into(),
///     value_label: "peak force (kN)".into(),
///     x: vec![5.0, 10.0, 20.0],
///     y: vec![2.0, 4.0],
///     values: vec![30.0, 34.0, 38.0, 31.0, 35.0, 40.0],
///     limits: vec![MapLimit {
///         values: vec![1.4, 1.1, 0.9, 1.2, 0.9, 0.8],
///         at: 1.0,
///         label: "as deep as it is thick".into(),
///     }],
///     ..Map::default()
/// };
/// assert!(map.svg().contains("as deep as it is thick"));
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Map {
    /// Heading.
    pub title: String,
    /// A remark below the heading; empty for none.
    pub note: String,
    /// Quantity and unit along the horizontal axis.
    pub x_label: String,
    /// Quantity and unit along the vertical axis.
    pub y_label: String,
    /// Scale of the horizontal axis.
    pub x_scale: Scale,
    /// Scale of the vertical axis.
    pub y_scale: Scale,
    /// Quantity and unit of the values.
    pub value_label: String,
    /// Places of the columns, ascending.
    pub x: Vec<f64>,
    /// Places of the rows, ascending.
    pub y: Vec<f64>,
    /// Values, row by row.
    pub values: Vec<f64>,
    /// Lines on which another quantity has a certain value.
    pub limits: Vec<MapLimit>,
}

/// A line on which a quantity has a certain value, such as that of a padding pressed to nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct MapLimit {
    /// The quantity, row by row.
    pub values: Vec<f64>,
    /// Its value on the line.
    pub at: f64,
    /// Text at the line.
    pub label: String,
}

impl Map {
    /// Both axes, which end where the data do.
    fn axes(&self, ticks: (usize, usize)) -> (Axis, Axis) {
        let axis = |scale: &Scale, places: &[f64], ticks| {
            Axis::of(scale, places.iter().copied(), false, ticks)
        };
        (axis(&self.x_scale, &self.x, ticks.0), axis(&self.y_scale, &self.y, ticks.1))
    }

    /// The value at a column of a row; what is missing is a gap.
    fn value(&self, column: usize, row: usize) -> f64 {
        self.values.get(row * self.x.len() + column).copied().unwrap_or(f64::NAN)
    }
}
