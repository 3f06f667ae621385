//! Points of a sweep whose errors are known from points near them.

use super::{
    Row,
    full::{Flaws, Full},
    thinned::Thinned,
};
use crate::{Choice, RunReport, SolveSettings, Warning};

/// At which points of a sweep that are solved by steps errors are estimated by further solutions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Estimates {
    /// At every point.
    All,
    /// At three points of each group of 64, which begin at fixed numbers of the grid. The others are solved
    /// once, by the method of those three and at a quarter of their tolerance; they have the largest of
    /// their relative errors. A group whose three differ in kind, by more than 30 times in an error, or of
    /// which the middle one is not within both errors if it is solved once, is halved, and so are its parts:
    /// at every point of one of less than six, and at points that are of another kind than the three. Points that are
    /// instantiated are of another kind than those that are solved in full: each has an error of its own, by the
    /// defects of its steps, at least so many times of that as it was at three of them.
    #[default]
    Some,
    /// At none.
    Off,
}

/// How the points of a sweep are solved.
#[derive(Debug, Clone, Copy)]
pub struct SweepOptions {
    /// How many threads share the points; the results are the same.
    pub threads: usize,
    /// Where errors are estimated.
    pub estimates: Estimates,
}

impl Default for SweepOptions {
    /// One thread, errors estimated at some points.
    fn default() -> Self {
        Self { threads: 1, estimates: Estimates::default() }
    }
}

/// The tolerance of points whose errors are not estimated, in parts of that of those whose are.
const TIGHTER: f64 = 0.25;
/// Relative errors within a group may differ by this factor.
const ALIKE: f64 = 30.0;

/// What is known of a group of points, or a part of one.
pub(super) struct Known {
    method: &'static str,
    rtol: f64,
    /// For each column the largest error relative to its value.
    errors: Vec<f64>,
    warnings: Vec<Warning>,
}

impl Full<'_> {
    /// What these points agree in, if they do.
    fn known(&self, reports: [&RunReport; 3], rows: [&Row<'_>; 3]) -> Option<Known> {
        let [first, ..] = reports;
        let warnings = first.warnings.clone();
        let is_alike = |own: &&RunReport| {
            own.segmentation.is_none()
                && own.solver.method == first.solver.method
                && are_alike(&own.warnings, &warnings)
        };
        if !reports.iter().all(is_alike) {
            return None;
        }
        let rtols =
            reports.iter().map(|own| own.solver.rtol.filter(|_| own.solver.solves_for_error > 0));
        let rtol = rtols.collect::<Option<Vec<f64>>>()?.into_iter().fold(f64::INFINITY, f64::min);
        let relative = |column: usize| {
            let all = rows.iter().map(|row| row.errors[column] / row.values[column].abs());
            let all = all.map(|own| Some(own).filter(|own| own.is_finite()));
            let all = all.collect::<Option<Vec<f64>>>()?;
            let (least, most) = all.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), own| {
                (least.min(*own), most.max(*own))
            });
            (most <= ALIKE * least).then_some(most)
        };
        let errors = (0..self.columns.len()).map(relative).collect::<Option<Vec<f64>>>()?;
        Some(Known { method: first.solver.method, rtol, errors, warnings })
    }

    /// Solves a point once, and returns what the run is warned of, and which columns its end cuts off; `None`
    /// where it is of another kind than those that are known.
    fn once(
        &self,
        known: &Known,
        point: usize,
        values: &mut [f64],
        errors: &mut [f64],
    ) -> Option<(Vec<Warning>, Vec<usize>)> {
        let change = |settings: &mut SolveSettings| {
            settings.estimate = false;
            settings.rtol = Some((TIGHTER * known.rtol).max(1e-13));
            if let Ok(method) = Choice::named(known.method) {
                settings.method = method;
            }
        };
        let report = self.run(point, change).ok()?;
        if !are_alike(&report.warnings, &known.warnings) {
            return None;
        }
        let mut flaws = Flaws::default();
        self.read(&report, point, values, errors, &mut flaws);
        if !flaws.gaps.is_empty() {
            return None;
        }
        for ((value, error), relative) in values.iter().zip(errors).zip(&known.errors) {
            *error = relative * value.abs();
        }
        Some((report.warnings, flaws.cut))
    }
}

impl Thinned for Full<'_> {
    type Solved = RunReport;
    type Known = Known;

    /// Solves a point as it is asked for, and writes what was found.
    fn solved(&mut self, row: &mut Row<'_>) -> Option<RunReport> {
        let report = self.write(row.point, row.values, row.errors, &mut row.flaws, |_| {});
        row.warnings = report.as_ref().map_or(Vec::new(), |own| own.warnings.clone());
        report
    }

    fn agreed(&mut self, reports: [&RunReport; 3], rows: [&Row<'_>; 3]) -> Option<Known> {
        // The one in the middle is the test.
        self.known(reports, rows).filter(|known| {
            let row = rows[1];
            let (mut values, mut errors) = (row.values.to_vec(), row.errors.to_vec());
            let is_taken = self.once(known, row.point, &mut values, &mut errors).is_some();
            let within =
                |at: usize| (values[at] - row.values[at]).abs() <= row.errors[at].max(errors[at]);
            is_taken && (0..values.len()).all(within)
        })
    }

    fn spared(&mut self, known: &Known, row: &mut Row<'_>) -> Option<()> {
        let (warnings, cut) = self.once(known, row.point, row.values, row.errors)?;
        (row.warnings, row.flaws.cut) = (warnings, cut);
        Some(())
    }
}

/// Whether two runs are warned of the same.
fn are_alike(one: &[Warning], other: &[Warning]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| one.is_like(other))
}
