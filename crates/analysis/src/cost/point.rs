//! One method up the ladder of tolerances.

use std::{sync::Arc, time::Duration};

use dashpot_dae::{Method, Run, SolveError, Statistics};
use dashpot_network::Assembly;

use super::{
    CostFailure, CostPoint, CostReport, Ladder, declines, slips::slips, timing, truth::Judge,
    watch::Watch,
};
use crate::{RunError, RunReport, SolveSettings, selection::Selected, solve_assembly};

/// What solutions are made of and judged by.
pub(super) struct Bench<'a> {
    pub(super) assembly: &'a Arc<Assembly>,
    pub(super) settings: &'a SolveSettings,
    pub(super) selected: &'a [Selected],
    /// The run without its tolerance.
    pub(super) run: Run,
    pub(super) judge: &'a Judge<'a>,
    pub(super) ladder: &'a Ladder,
}

impl Bench<'_> {
    /// Adds the solutions of a method at all tolerances to the report, or why there are none.
    pub(super) fn climb(
        &self,
        method: &dyn Method,
        report: &mut CostReport,
        watch: &mut Watch<'_>,
    ) -> Result<(), RunError> {
        let rtols: Vec<Option<f64>> = if method.is_exact() {
            vec![None]
        } else {
            self.ladder.rtols.iter().copied().map(Some).collect()
        };
        for rtol in rtols {
            match self.point(method, rtol, watch) {
                Ok(point) => {
                    report.slips.extend(slips(&point));
                    report.points.push(point);
                }
                Err(RunError::Solve(error @ SolveError::Cancelled { .. })) => {
                    return Err(error.into());
                }
                Err(error) => {
                    let declines = declines(&error);
                    let ends = matches!(error, RunError::Solve(SolveError::TooManySteps { .. }));
                    let rtol = rtol.filter(|_| !declines);
                    let ends_here = ends && rtol.is_some();
                    let method = method.name();
                    report.failures.push(CostFailure { method, rtol, error, ends: ends_here });
                    if declines || ends {
                        break;
                    }
                }
            }
            watch.next();
        }
        Ok(())
    }

    fn point(
        &self,
        method: &dyn Method,
        rtol: Option<f64>,
        watch: &mut Watch<'_>,
    ) -> Result<CostPoint, RunError> {
        let settings = SolveSettings { rtol, ..self.settings.clone() }.by(method.name());
        let limited = watch.limited(self.ladder.most_steps);
        let solved = solve_assembly(self.assembly, &[], &settings, limited);
        let solved = solved.map_err(|error| watch.told(method.name(), error))?;
        self.judged(method, rtol, &solved)
    }

    fn judged(
        &self,
        method: &dyn Method,
        rtol: Option<f64>,
        solved: &RunReport,
    ) -> Result<CostPoint, RunError> {
        let work = Statistics { wall: Duration::ZERO, ..solved.solver.statistics };
        let repeats = self.ladder.repeats.unwrap_or_else(|| timing::repeats(&work));
        let run = self.run.clone().with_rtol(rtol.unwrap_or(self.run.rtol));
        let (time, integration) =
            timing::times(self.assembly, method, &run, self.selected, repeats)?;
        let (state, events, measures) = self.judge.errors(solved);
        let method = method.name();
        Ok(CostPoint { method, rtol, work, time, integration, repeats, state, events, measures })
    }
}
