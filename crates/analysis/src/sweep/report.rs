//! What a sweep yields, and what can go wrong with it as a whole.

use std::{collections::BTreeSet, time::Duration};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::{Row, shards::Raised};
use crate::{
    Cause, Compression, Judgement, Limit, Reason, RunError, Through, Unevaluated, Warning,
    partial::{Cost, Neglected, PutBack},
};

/// What a sweep reports of each point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Column {
    /// Key of the measure, for instance `padding.peak-force`.
    pub key: String,
    /// SI unit of the values.
    pub unit: &'static str,
    /// Whether the values are parts of the thickness of the element: of a peak deformation that is the
    /// `ξmax` of the thesis, which is 1 where the padding is pressed to nothing.
    pub is_share: bool,
}

/// A value that does not exist, or a point that could not be solved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Gap {
    /// The point.
    pub point: usize,
    /// The column; `None` where the whole point could not be solved.
    pub column: Option<usize>,
    /// Why.
    pub cause: Cause,
    /// Whether the value is beyond all limits, as a peak is where speeds jump.
    pub is_infinite: bool,
}

/// What a sweep yields.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepReport {
    /// What is reported of each point.
    pub columns: Vec<Column>,
    /// One value for each column of each point, in the order of the grid; NaN where there is none.
    pub values: Vec<f64>,
    /// The errors of those; NaN where there is no value, or its error is not known.
    pub errors: Vec<f64>,
    /// Why values are missing, in the order of the points.
    pub gaps: Vec<Gap>,
    /// Points and columns whose values may still grow after the end of their runs, in the order of the points.
    pub cut: Vec<(usize, usize)>,
    /// The limits of the scene at the first point, each with the column of its measure.
    pub limits: Vec<(usize, Limit)>,
    /// What runs are warned of, one for each kind.
    pub warnings: Vec<SweepWarning>,
    /// How many points were instantiated; all others were solved in full.
    pub instantiated: usize,
    /// At how many points errors were estimated by further solutions, where no bound is known without them; the
    /// rest have those that their steps tell where they were instantiated, else those of points near them.
    pub estimated: usize,
    /// The instantiated points that were solved in full as well.
    pub checked: Vec<usize>,
    /// The largest difference there, in parts of the value.
    pub largest_difference: f64,
    /// What was left out, where the scene allows that.
    pub partial: Option<PartialOfSweep>,
    /// Wall-clock time.
    pub wall: Duration,
}

/// What was left out of a sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct PartialOfSweep {
    /// The bound: the part of its size by which a measure may move.
    pub bound: f64,
    /// What was left out of all points, the largest influence at the first point first.
    pub left_out: Vec<Neglected>,
    /// What stayed although its estimate was below the bound.
    pub put_back: Vec<PutBack>,
    /// The points that were solved with and without it, rising.
    pub checked: Vec<usize>,
    /// The measure that moves the most at any of those.
    pub worst: Option<Cost>,
    /// Solutions that finding this out took.
    pub solves: usize,
}

impl SweepReport {
    /// How many points there are.
    pub fn points(&self) -> usize {
        self.values.len() / self.columns.len().max(1)
    }

    /// What could not be evaluated, each place by its number and by none of its values; infinite values are known.
    pub fn unevaluated(&self) -> Unevaluated {
        let missing = || self.gaps.iter().filter(|own| !own.is_infinite);
        // A measure and what else is made of it lack one value.
        let mut seen = BTreeSet::new();
        let causes = missing().filter(|own| seen.insert((own.point, &own.cause.of)));
        let causes = causes.map(|own| (&own.cause, own.point));
        let points: BTreeSet<usize> = missing().map(|own| own.point).collect();
        Unevaluated { count: points.len(), ..Unevaluated::at(self.points(), causes) }
    }

    /// What is known of the limit at this place among [`limits`](Self::limits), at each point; `None` where
    /// there is no value, but for one that is infinite. Where errors are estimated, a value without one decides nothing.
    pub fn judged(&self, limit: usize) -> Vec<Option<Judgement>> {
        let (column, ref limit) = self.limits[limit];
        let doubts = self.doubts(limit);
        let mut cut = self.cut.iter().filter(|own| own.1 == column).map(|own| own.0).peekable();
        let infinite = self.gaps.iter().filter(|own| own.is_infinite && own.column == Some(column));
        let infinite: BTreeSet<usize> = infinite.map(|own| own.point).collect();
        let are_estimated = self.errors.iter().any(|error| !error.is_nan());
        let both = self.column(column).zip(self.errors_of(column)).enumerate();
        both.map(|(point, (value, error))| {
            let grows = cut.next_if_eq(&point).is_some();
            let unknown = are_estimated.then_some(f64::INFINITY);
            let error = if error.is_nan() { unknown } else { Some(error) };
            let judged = || limit.bound.judge(value, error, grows).doubted(doubts[point]);
            if value.is_nan() {
                infinite.contains(&point).then(|| limit.bound.judge(f64::INFINITY, None, grows))
            } else {
                Some(judged())
            }
        })
        .collect()
    }

    /// Why it is not known whether a limit is kept, at each point.
    pub fn doubts(&self, limit: &Limit) -> Vec<Option<Reason>> {
        let mut doubts = vec![None; self.points()];
        for own in &self.warnings {
            let doubt = own.warning.doubt(limit, own.points.len() > 1);
            for &point in &own.points {
                doubts[point] = Reason::first([doubts[point], doubt].into_iter().flatten());
            }
        }
        doubts
    }

    /// The values of a column, in the order of the grid.
    pub fn column(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        self.of_column(&self.values, column)
    }

    /// The errors of a column, in the order of the grid.
    pub fn errors_of(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        self.of_column(&self.errors, column)
    }

    fn of_column<'a>(&self, all: &'a [f64], column: usize) -> impl Iterator<Item = f64> + use<'a> {
        all.iter().skip(column).step_by(self.columns.len().max(1)).copied()
    }

    /// Widens the errors by the largest move that what was left out makes, and says what that was.
    pub(super) fn charge(&mut self, partial: PartialOfSweep) {
        if let Some(moved) = partial.worst.as_ref().map(Cost::most) {
            for (error, value) in self.errors.iter_mut().zip(&self.values) {
                *error += moved * value.abs();
            }
        }
        self.partial = Some(partial);
    }
}

/// Why there is no sweep.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SweepError {
    /// A fault of the scene at the first point, or of what is asked of it.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The scene at the first point cannot be made.
    #[error("{0}")]
    NotPosed(String),
    /// An axis has no values, or there are too many points to count.
    #[error("an axis has no values, or all together have too many points")]
    NoPoints,
    /// The scene reports nothing by itself, and nothing is asked for.
    #[error("the scene reports no measure by itself: name one")]
    NoneReported,
    /// Shards that are not the whole of a sweep.
    #[error("point {} of the grid is in no shard, or in two", point + 1)]
    NotWhole {
        /// The first such point, from 0.
        point: usize,
    },
    /// A shard whose values, gaps or warnings are not those of its points.
    #[error("the shard from point {} on speaks of points or columns that it does not have", point + 1)]
    OtherPoints {
        /// Its first point, from 0.
        point: usize,
    },
    /// A point is not warned of what its shard says.
    #[error("point {} is not warned of what its shard says: it was solved by another program", point + 1)]
    OtherWarnings {
        /// The point, from 0.
        point: usize,
    },
    /// The watcher broke it off.
    #[error("the sweep was broken off")]
    BrokenOff,
}

/// A warning of the runs at some points.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepWarning {
    /// What the run at the first of the points is warned of. At the others the numbers differ.
    pub warning: Warning,
    /// The points, rising.
    pub points: Vec<usize>,
}

/// What is to be said of a instantiated impact.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Notice {
    /// From when on \[s\] the element pulls.
    pub(super) pulls: Option<f64>,
    /// Its largest deformation, where that is more than its thickness.
    pub(super) pressed: Option<Compression>,
}

impl Notice {
    /// The warnings that a full run brings of the same.
    pub(super) fn warnings(&self, element: &str) -> Vec<Warning> {
        let element = element.to_owned();
        let pulls =
            self.pulls.map(|time| Warning::Pulls { element: element.clone(), since: Some(time) });
        let pressed = self.pressed.map(|compression| {
            let through = Through { name: element, compression };
            Warning::PressedThrough { through, others: 0 }
        });
        pulls.into_iter().chain(pressed).collect()
    }
}

/// The warnings of all rows, in the order of the first points that they are about, and where they are raised.
/// `element` is the one that notices are about.
pub(super) fn collect(rows: &[Row<'_>], element: &str) -> (Vec<Warning>, Vec<Raised>) {
    let mut all = Kinds::default();
    // Notices are of the same kinds at all points, so each is looked for once.
    let mut known: [Option<usize>; 2] = [None; 2];
    for row in rows {
        for (place, warning) in row.warnings.iter().enumerate() {
            let at = all.of(warning, place);
            all.add(at, row.point);
        }
        let Some(notice) = &row.notice else { continue };
        let alone = [Notice { pressed: None, ..*notice }, Notice { pulls: None, ..*notice }];
        let alone = known.iter_mut().zip(alone).filter(|own| own.1 != Notice::default());
        for (place, (known, own)) in alone.enumerate() {
            let found = || own.warnings(element).first().map(|warning| all.of(warning, place));
            if let Some(kind) = known.or_else(found) {
                *known = Some(kind);
                all.add(kind, row.point);
            }
        }
    }
    all.0
        .into_iter()
        .map(|(own, place)| {
            let neighbours = own.points.chunk_by(|one, next| one + 1 == *next);
            let ranges = neighbours.filter_map(|own| Some(*own.first()?..own.last()? + 1));
            (own.warning, Raised { points: ranges.collect(), place })
        })
        .unzip()
}

/// Warnings by what they say besides numbers, each with its place among those of its first point.
#[derive(Default)]
pub(super) struct Kinds(Vec<(SweepWarning, usize)>);

impl Kinds {
    /// Position of the kind of a warning.
    pub(super) fn of(&mut self, warning: &Warning, place: usize) -> usize {
        self.0.iter().position(|own| own.0.warning.is_like(warning)).unwrap_or_else(|| {
            let own = SweepWarning { warning: warning.clone(), points: Vec::new() };
            self.0.push((own, place));
            self.0.len() - 1
        })
    }

    pub(super) fn add(&mut self, kind: usize, point: usize) {
        let points = &mut self.0[kind].0.points;
        if points.last() != Some(&point) {
            points.push(point);
        }
    }

    pub(super) fn told(self) -> Vec<SweepWarning> {
        self.0.into_iter().map(|own| own.0).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_that_differ_in_numbers_alone_are_of_one_kind() {
        let at = |since: Option<f64>, element: &str| Warning::Pulls {
            element: element.to_owned(),
            since,
        };
        assert!(at(Some(7.43e-3), "padding").is_like(&at(Some(1.02), "padding")));
        assert!(!at(Some(7.43e-3), "padding").is_like(&at(None, "padding")));
        assert!(!at(Some(7.43e-3), "padding").is_like(&at(Some(7.43e-3), "mount")));
    }
}
