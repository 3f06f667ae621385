//! Points of a sweep that are solved in full, each as a single run, and instantiated points beside them.

use std::{ops::ControlFlow, sync::Arc};

use dashpot_dae::methods;

use super::{Column, Gap, Grid, Pose, instantiated::Plan, parallel::share, stamper::Stamper};
use crate::{Cause, Choice, RunReport, Solve, SolveSettings, partial::spread};

/// What is to be said of the values of a point.
#[derive(Debug, Default)]
pub(super) struct Flaws {
    /// Values that are missing.
    pub(super) gaps: Vec<Gap>,
    /// Columns whose values the end of the run cuts off.
    pub(super) cut: Vec<usize>,
}

/// How points are solved in full.
#[derive(Clone, Copy)]
pub(super) struct Full<'f> {
    pub(super) grid: &'f Grid,
    pub(super) pose: &'f Pose<'f>,
    pub(super) columns: &'f [Column],
}

impl Full<'_> {
    /// The run at a point, with its settings changed.
    pub(super) fn run(
        &self,
        point: usize,
        change: impl Fn(&mut SolveSettings),
    ) -> Result<RunReport, Cause> {
        let mut scene_point = (self.pose)(&self.grid.places(point)).map_err(Cause::scene)?;
        change(&mut scene_point.settings);
        Ok(scene_point.network.solve_with(&scene_point.settings)?)
    }

    /// Solves a point as it is asked for but for a `change`, and writes its columns and their errors, or notes why
    /// they are missing. The run; `None` where there is none.
    pub(super) fn write(
        &self,
        point: usize,
        values: &mut [f64],
        errors: &mut [f64],
        flaws: &mut Flaws,
        change: impl Fn(&mut SolveSettings),
    ) -> Option<RunReport> {
        values.fill(f64::NAN);
        errors.fill(f64::NAN);
        match self.run(point, change) {
            Ok(report) => {
                self.read(&report, point, values, errors, flaws);
                Some(report)
            }
            Err(cause) => {
                flaws.gaps.push(Gap { point, column: None, cause, is_infinite: false });
                None
            }
        }
    }

    /// Writes the columns of a run and their errors, and notes why values are missing.
    pub(super) fn read(
        &self,
        report: &RunReport,
        point: usize,
        values: &mut [f64],
        errors: &mut [f64],
        flaws: &mut Flaws,
    ) {
        for (at, column) in self.columns.iter().enumerate() {
            let cause = || Cause::no_value(&column.key, Some(report));
            let gap = |cause, is_infinite| Gap { point, column: Some(at), cause, is_infinite };
            let Some(measure) = report.measure(&column.key) else {
                flaws.gaps.push(gap(cause(), false));
                continue;
            };
            let thickness =
                report.assembly.connection(&measure.target).and_then(|own| own.thickness);
            let unit = if column.is_share { thickness } else { Some(1.0) };
            if let Some((value, unit)) = measure.value.zip(unit) {
                values[at] = value / unit;
                errors[at] = measure.error.map_or(f64::NAN, |error| error / unit);
                flaws.cut.extend(report.is_so_far(measure).then_some(at));
            } else {
                flaws.gaps.push(gap(cause(), measure.is_infinite()));
            }
        }
    }
}

/// At most so many points are solved both ways.
const MOST_CHECKED: usize = 4;
/// Stamped values may differ from full ones by this part of themselves, besides the errors of both.
const AGREEMENT: f64 = 1e-9;
/// The tolerance of full runs whose errors are not estimated, in parts of the accuracy that is wanted …
const TIGHT: f64 = 1e-4;
/// … and what their values may be off by.
const CHECKED: f64 = 0.5;

/// Solves points spread over the grid both ways: those that were instantiated, and the largest difference
/// in parts of a value. `None` where they do not agree, or full runs are warned of something else.
pub(super) fn check(plan: &Plan<'_>, full: &Full<'_>, threads: usize) -> Option<(Vec<usize>, f64)> {
    struct Both {
        point: usize,
        /// Whether it was instantiated, and the largest difference; `None` where both do not agree.
        found: Option<(bool, f64)>,
    }
    let all = spread(full.grid.len());
    let wanted = all.len().min(MOST_CHECKED);
    let picked = (0..wanted).map(|at| all[at * (all.len() - 1) / wanted.saturating_sub(1).max(1)]);
    let mut rows: Vec<Both> = picked.map(|point| Both { point, found: None }).collect();
    let both = |stamper: &mut Option<Box<dyn Stamper + '_>>, row: &mut Both| {
        let count = full.columns.len();
        let (mut values, mut errors) = (vec![0.0; count], vec![0.0; count]);
        let Some(stamper) = stamper else { return };
        let Ok(scene) = (full.pose)(&full.grid.places(row.point)) else {
            row.found = Some((false, 0.0));
            return;
        };
        if !plan.agrees(row.point, &scene) {
            return;
        }
        let Some(notice) = stamper.write(row.point, &mut values, &mut errors) else {
            row.found = Some((false, 0.0));
            return;
        };
        let (mut right, mut bars) = (vec![f64::NAN; count], vec![f64::NAN; count]);
        let flaws = &mut Flaws::default();
        let run = full.write(row.point, &mut right, &mut bars, flaws, |settings| {
            if !plan.parametric.is_linear() {
                settings.method = Choice::Method(Arc::new(methods::Dop853));
                settings.estimate = false;
                settings.rtol = Some(TIGHT * plan.strictest());
            }
        });
        let warned = run.map_or(Vec::new(), |run| run.warnings);
        let noticed = notice.warnings(plan.element());
        if !(warned.len() == noticed.len()
            && warned.iter().zip(&noticed).all(|own| own.0.is_like(own.1)))
        {
            return;
        }
        let mut largest = 0.0_f64;
        for at in 0..count {
            let (difference, size) = ((values[at] - right[at]).abs(), right[at].abs());
            let bar = if bars[at].is_nan() { CHECKED * plan.wishes[at] * size } else { bars[at] };
            // Where errors are not asked for, it is as good as is wanted.
            let own = if errors[at].is_nan() { plan.wishes[at] * size } else { errors[at] };
            let room = own + bar + AGREEMENT * size;
            if difference.is_nan() || difference > room {
                return;
            }
            if difference > 0.0 {
                largest = largest.max(difference / size);
            }
        }
        row.found = Some((true, largest));
    };
    let work = |stamper: &mut Option<Box<dyn Stamper + '_>>, rows: &mut [Both]| {
        rows.iter_mut().for_each(|row| both(stamper, row));
    };
    share(
        &mut rows,
        (1, threads),
        &|| plan.stamper(),
        &work,
        &mut |_, _| ControlFlow::Continue(()),
    );
    let mut largest = 0.0_f64;
    let mut checked = Vec::new();
    for row in rows {
        let (is_instantiated, difference) = row.found?;
        largest = largest.max(difference);
        if is_instantiated {
            checked.push(row.point);
        }
    }
    Some((checked, largest))
}
