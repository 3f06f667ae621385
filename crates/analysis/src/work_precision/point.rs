//! One method up the ladder of tolerances, and how long each solution takes.

use std::{
    hint::black_box,
    sync::Arc,
    time::{Duration, Instant},
};

use dashpot_dae::{Method, Run, Silent, SolveError, Statistics, switching};
use dashpot_network::Assembly;

use super::{
    CostFailure, CostPoint, CostReport, Ladder, Spread, declines, deviation::underestimates,
    reference::Judge, watch::Watch,
};
use crate::{
    Choice, RunError, RunReport, Solution, SolveSettings, measures::selection::Selected,
    solution::threshold_at, solve_assembly,
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
                    report.underestimates.extend(underestimates(&point));
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
        let wanted = self.ladder.repeats.unwrap_or_else(|| repeats(&solved.solver.statistics));
        let repeats = wanted.min(left / each).max(1);
        watch.charge(repeats.saturating_mul(each));
        self.judged(method.as_ref(), rtol, &solved, repeats)
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
        let (time, integration) = times(self.assembly, method, &run, self.selected, repeats)?;
        let (state, events, measures) = self.judge.errors(solved);
        let method = method.name();
        Ok(CostPoint { method, rtol, work, time, integration, repeats, state, events, measures })
    }
}

/// Steps that all repeats of a solution take together, about.
const STEPS: usize = 20_000;
/// Fewest and most repeats that are chosen by the number of steps.
const REPEATS: (usize, usize) = (5, 51);
/// Repeats of a method that takes no steps.
const STEPLESS: usize = 25;

/// Number of repeats that suits a solution of this work.
pub(super) fn repeats(work: &Statistics) -> usize {
    let (fewest, most) = REPEATS;
    match work.accepted + work.rejected {
        0 => STEPLESS,
        // An odd number has a median of its own.
        steps => (STEPS / steps).clamp(fewest, most) | 1,
    }
}

/// The times to solve and to read all measures, and of the first part alone \[s\].
pub(super) fn times(
    assembly: &Assembly,
    method: &dyn Method,
    run: &Run,
    selected: &[Selected],
    repeats: usize,
) -> Result<(Spread, Spread), SolveError> {
    let (mut whole, mut integration) = (Vec::new(), Vec::new());
    for _ in 0..repeats {
        let begin = Instant::now();
        let trajectory = match &assembly.switching {
            None => method.integrate(&assembly.system, run, &mut Silent)?,
            Some(phased) => switching::integrate(method, phased.as_ref(), run, &mut Silent)?,
        };
        integration.push(begin.elapsed().as_secs_f64());
        let threshold = threshold_at((!method.is_exact()).then_some(run.rtol));
        let solution = Solution::new(assembly, &trajectory).doubting(threshold);
        for entry in selected {
            black_box(entry.measure.read(&solution, entry.target));
        }
        whole.push(begin.elapsed().as_secs_f64());
    }
    Ok((spread(whole), spread(integration)))
}

/// Median and quartiles, by linear interpolation between the values in order.
pub(super) fn spread(mut values: Vec<f64>) -> Spread {
    values.sort_by(f64::total_cmp);
    let at = |share: f64| {
        let place = share * values.len().saturating_sub(1) as f64;
        let below = values.get(whole(place)).copied().unwrap_or(0.0);
        let above = values.get(whole(place.ceil())).copied().unwrap_or(below);
        below + place.fract() * (above - below)
    };
    Spread { median: at(0.5), lower: at(0.25), upper: at(0.75) }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a place in a list, below 2^52"
)]
fn whole(place: f64) -> usize {
    place as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_the_values_in_order() {
        let own = spread(vec![5.0, 1.0, 4.0, 2.0, 3.0]);
        assert_eq!((own.lower, own.median, own.upper), (2.0, 3.0, 4.0));
        let own = spread(vec![1.0, 2.0]);
        assert_eq!((own.lower, own.median, own.upper), (1.25, 1.5, 1.75));
        let own = spread(vec![7.0]);
        assert_eq!((own.lower, own.median, own.upper), (7.0, 7.0, 7.0));
    }

    #[test]
    fn short_solutions_are_repeated_more_often() {
        let of = |accepted| repeats(&Statistics { accepted, ..Statistics::default() });
        assert_eq!([of(0), of(100), of(1000), of(1_000_000)], [25, 51, 21, 5]);
    }
}
