//! One method up the ladder of tolerances.

use std::{sync::Arc, time::Duration};

use dashpot_dae::{Method, Run, SolveError, Statistics};
use dashpot_network::Assembly;

use super::{
    CostFailure, CostPoint, CostReport, Ladder, declines, deviation::slips, timing, truth::Judge,
    watch::Watch,
};
use crate::{
    Choice, RunError, RunReport, SolveSettings, measures::selection::Selected, solve_assembly,
};

/// Part of the work that is left, one in so many, which the repeats of one solution may take.
const OF_THE_REST: usize = 8;

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
    /// Adds the solutions of a method at all tolerances to the report, or why there are none. With them all
    /// work may come to `most_work`.
    pub(super) fn climb(
        &self,
        method: &Arc<dyn Method>,
        most_work: usize,
        report: &mut CostReport,
        watch: &mut Watch<'_>,
    ) -> Result<(), RunError> {
        let rtols: Vec<Option<f64>> = if method.is_exact() {
            vec![None]
        } else {
            self.ladder.rtols.iter().copied().map(Some).collect()
        };
        for rtol in rtols {
            match self.point(method, rtol, most_work, watch) {
                Ok(point) => {
                    report.slips.extend(slips(&point));
                    report.points.push(point);
                }
                Err(RunError::Solve(error @ SolveError::Cancelled { .. })) => {
                    return Err(error.into());
                }
                Err(error) => {
                    let declines = declines(&error);
                    let ends = matches!(
                        error,
                        RunError::Solve(
                            SolveError::TooManySteps { .. } | SolveError::BudgetSpent { .. }
                        ) | RunError::TooMuchWork { .. }
                    );
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
        method: &Arc<dyn Method>,
        rtol: Option<f64>,
        most_work: usize,
        watch: &mut Watch<'_>,
    ) -> Result<CostPoint, RunError> {
        let choice = Choice::Method(Arc::clone(method));
        let settings = SolveSettings { rtol, method: choice, ..self.settings.clone() };
        let limited = watch.limited(method.is_exact(), self.ladder.most_steps, most_work);
        let solved = solve_assembly(self.assembly, &[], &settings, limited);
        let solved = solved.map_err(|error| watch.told(method.name(), error))?;
        let solutions = 1 + solved.solver.solves_for_error;
        let each = watch.last().div_ceil(solutions).max(1);
        let left = most_work.saturating_sub(watch.work()) / OF_THE_REST;
        let repeats = self.repeats(&solved).min(left / each).max(1);
        watch.charge(repeats.saturating_mul(each));
        self.judged(method.as_ref(), rtol, &solved, repeats)
    }

    /// How often a solution is repeated for its time.
    fn repeats(&self, solved: &RunReport) -> usize {
        self.ladder.repeats.unwrap_or_else(|| timing::repeats(&solved.solver.statistics))
    }

    fn judged(
        &self,
        method: &dyn Method,
        rtol: Option<f64>,
        solved: &RunReport,
        repeats: usize,
    ) -> Result<CostPoint, RunError> {
        let work = Statistics { wall: Duration::ZERO, ..solved.solver.statistics };
        let run = self.run.clone().with_rtol(rtol.unwrap_or(self.run.rtol));
        let (time, integration) =
            timing::times(self.assembly, method, &run, self.selected, repeats)?;
        let (state, events, measures) = self.judge.errors(solved);
        let method = method.name();
        Ok(CostPoint { method, rtol, work, time, integration, repeats, state, events, measures })
    }
}
