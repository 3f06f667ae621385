//! Sweeps by named axes: values in, rows out; and the grid of their points.

use std::{num::NonZero, ops::ControlFlow};

use super::{Column, ScenePoint, SweepError, SweepOptions, SweepReport, Watch, columns, sweep};

/// A parameter and the values that it takes.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Its name, for instance `K2`.
    pub name: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// The axis of a parameter of this name over these values.
pub fn axis(name: impl Into<String>, values: impl IntoIterator<Item = f64>) -> Axis {
    Axis { name: name.into(), values: values.into_iter().collect() }
}

/// Every combination of the values of some parameters.
///
/// # Examples
///
/// ```
/// use dashpot_analysis::{SolveSettings, sweep::{ScenePoint, Sweep, axis}};
/// use dashpot_network::{Network, Node, elements::Spring, part};
///
/// let swept = Sweep::over(axis("K", [1e4, 4e4])).and(axis("m", [1.0, 4.0])).solve(
///     &["pad.peak-force"],
///     |values| {
///         let &[stiffness, mass] = values else { return Err("two axes".to_owned()) };
///         let mut network = Network::new();
///         let head = network.add_node(Node::mass("head", mass).moving(2.0));
///         network.connect("pad", head, network.ground(), part(Spring { stiffness }));
///         Ok(ScenePoint { network, settings: SolveSettings::lasting(0.1) })
///     },
/// )?;
/// // V √(K m)
/// let peak = swept.at(&[1, 0]).and_then(|row| row.value("pad.peak-force")).unwrap();
/// assert!((peak - 400.0).abs() < 1e-6);
/// # Ok::<(), dashpot_analysis::sweep::SweepError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    axes: Vec<Axis>,
}

impl Sweep {
    /// The sweep over one axis.
    pub fn over(axis: Axis) -> Self {
        Self { axes: vec![axis] }
    }

    /// The same sweep over a further axis, which varies faster than all before.
    #[must_use]
    pub fn and(mut self, axis: Axis) -> Self {
        self.axes.push(axis);
        self
    }

    /// Solves the scenes that `pose` makes of one value for each axis, or says why there is none, and reports the
    /// measures with these keys; of none all that the first scene reports. All threads of the machine share the work.
    ///
    /// # Errors
    ///
    /// An axis without values, a fault of the scene at the first point, and a measure that it does not
    /// have. Points that fail are [gaps](SweepReport::gaps).
    pub fn solve(
        self,
        measures: &[&str],
        pose: impl Fn(&[f64]) -> Result<ScenePoint, String> + Sync,
    ) -> Result<Swept, SweepError> {
        self.watched(measures, pose, &mut |_, _| ControlFlow::Continue(()))
    }

    /// The same, of which `watch` is told how far it has come, and may break it off.
    ///
    /// # Errors
    ///
    /// As [`solve`](Self::solve), and that it was broken off.
    pub fn watched(
        self,
        measures: &[&str],
        pose: impl Fn(&[f64]) -> Result<ScenePoint, String> + Sync,
        watch: &mut Watch<'_>,
    ) -> Result<Swept, SweepError> {
        let counts = self.axes.iter().map(|axis| axis.values.len()).collect();
        let grid = Grid::new(counts).ok_or(SweepError::NoPoints)?;
        let scene_point = |places: &[usize]| pose(&self.values(places));
        let first = scene_point(&grid.places(0)).map_err(SweepError::NotPosed)?;
        let keys: Vec<String> = measures.iter().map(|&measure| measure.to_owned()).collect();
        let (columns, wishes) = columns(&first, &keys)?;
        let scene_point = |places: &[usize]| {
            let mut scene_point = scene_point(places)?;
            scene_point.settings.measures.clone_from(&wishes);
            Ok(scene_point)
        };
        let threads = std::thread::available_parallelism().map_or(1, NonZero::get);
        let options = SweepOptions { threads, ..SweepOptions::default() };
        let report = sweep(&grid, &scene_point, &columns, options, watch)?;
        Ok(Swept { sweep: self, grid, report })
    }

    /// The value of each axis at these positions.
    fn values(&self, places: &[usize]) -> Vec<f64> {
        let pairs = self.axes.iter().zip(places);
        pairs.filter_map(|(axis, &place)| axis.values.get(place).copied()).collect()
    }
}

/// A sweep by axes that was solved.
#[derive(Debug, Clone, PartialEq)]
pub struct Swept {
    sweep: Sweep,
    grid: Grid,
    /// All that it yields.
    pub report: SweepReport,
}

impl Swept {
    /// The axes, in the order in which they were named.
    pub fn axes(&self) -> &[Axis] {
        &self.sweep.axes
    }

    /// All points; the last axis varies fastest.
    pub fn rows(&self) -> impl Iterator<Item = SweepRow<'_>> {
        (0..self.grid.len()).map(|point| self.row(point))
    }

    /// The point at which each axis takes the value at this position; `None` where there is no such value.
    pub fn at(&self, places: &[usize]) -> Option<SweepRow<'_>> {
        self.grid.point(places).map(|point| self.row(point))
    }

    fn row(&self, point: usize) -> SweepRow<'_> {
        let SweepReport { columns, values, errors, .. } = &self.report;
        let from = point * columns.len();
        let own = from..from + columns.len();
        SweepRow {
            parameters: self.sweep.values(&self.grid.places(point)),
            columns,
            values: values.get(own.clone()).unwrap_or_default(),
            errors: errors.get(own).unwrap_or_default(),
        }
    }
}

/// A point of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRow<'s> {
    /// The value of each axis.
    pub parameters: Vec<f64>,
    columns: &'s [Column],
    values: &'s [f64],
    errors: &'s [f64],
}

impl SweepRow<'_> {
    /// The measure with this key, in its SI unit; `None` where it has no value, or is not reported.
    pub fn value(&self, key: &str) -> Option<f64> {
        self.of(key, self.values)
    }

    /// How far that may be off; `None` where this is not known.
    pub fn error(&self, key: &str) -> Option<f64> {
        self.of(key, self.errors)
    }

    fn of(&self, key: &str, numbers: &[f64]) -> Option<f64> {
        let at = self.columns.iter().position(|column| column.key == key && !column.is_share)?;
        numbers.get(at).copied().filter(|number| !number.is_nan())
    }
}

/// Every combination of the values of some parameters, by their positions; the last parameter varies fastest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Grid {
    counts: Vec<usize>,
}

impl Grid {
    /// The grid of so many values of each parameter. `None` where there is no parameter, one has no
    /// value, or there are more than `usize::MAX` points.
    pub fn new(counts: Vec<usize>) -> Option<Self> {
        let count = counts.iter().try_fold(1_usize, |count, own| count.checked_mul(*own))?;
        (!counts.is_empty() && count > 0).then_some(Self { counts })
    }

    /// How many values each parameter takes.
    pub fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// Number of points.
    #[expect(clippy::len_without_is_empty, reason = "a grid has a point at least")]
    pub fn len(&self) -> usize {
        self.counts.iter().product()
    }

    /// Writes which value each parameter takes at a point.
    pub fn locate(&self, point: usize, places: &mut [usize]) {
        let mut rest = point;
        for (place, count) in places.iter_mut().zip(&self.counts).rev() {
            (*place, rest) = (rest % count, rest / count);
        }
    }

    /// Which value each parameter takes at a point.
    pub fn places(&self, point: usize) -> Vec<usize> {
        let mut places = vec![0; self.counts.len()];
        self.locate(point, &mut places);
        places
    }

    /// The point at which each parameter takes the value at this position; `None` where one has no such value.
    pub fn point(&self, places: &[usize]) -> Option<usize> {
        let is_one = places.len() == self.counts.len();
        let mut pairs = places.iter().zip(&self.counts);
        pairs
            .try_fold(0, |point, (place, count)| (place < count).then_some(point * count + place))
            .filter(|_| is_one)
    }

    /// The point at which one parameter takes a value, and all others their first one.
    pub fn on_axis(&self, axis: usize, place: usize) -> usize {
        place * self.counts[axis + 1..].iter().product::<usize>()
    }

    /// All points at which every parameter takes its first or its last value, rising.
    pub fn corners(&self) -> Vec<usize> {
        let mut corners = vec![0];
        for (axis, count) in self.counts.iter().enumerate() {
            let last = self.on_axis(axis, count - 1);
            if last > 0 {
                corners.extend(corners.clone().into_iter().map(|corner| corner + last));
            }
        }
        corners.sort_unstable();
        corners
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_parameter_varies_fastest() {
        let grid = Grid::new(vec![2, 3]).unwrap();
        let all: Vec<Vec<usize>> = (0..grid.len()).map(|at| grid.places(at)).collect();
        assert_eq!(all, [[0, 0], [0, 1], [0, 2], [1, 0], [1, 1], [1, 2]]);
        assert!((0..grid.len()).all(|at| grid.point(&grid.places(at)) == Some(at)));
        assert!(grid.point(&[2, 0]).is_none() && grid.point(&[1]).is_none());
        assert_eq!(grid.corners(), [0, 2, 3, 5]);
        assert_eq!((grid.on_axis(0, 1), grid.on_axis(1, 2)), (3, 2));
        assert!(Grid::new(vec![2, 0]).is_none() && Grid::new(vec![]).is_none());
        assert!(Grid::new(vec![usize::MAX, 2]).is_none());
    }
}
