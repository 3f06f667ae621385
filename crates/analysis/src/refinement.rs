//! As many solutions as the errors ask for.

use std::time::Duration;

use dashpot_dae::{Method, Observer, Run, SolveError, Trajectory};
use dashpot_network::Assembly;

use crate::{
    Ledger, Reading, Solution, SolveSettings,
    accuracy::{error_bar, excess, rounding},
    ledger::ledger,
    selection::Selected,
};

/// Part of the energy turned over beyond which a balance that does not close fails the run.
pub(crate) const MOST_LOST: f64 = 0.01;
/// Exponent of the first tolerance that is tried, 1e-4.
const COARSEST: i32 = 4;
/// Exponent of the last tolerance that is tried, 1e-12.
const FINEST: i32 = 12;

/// What is to be solved, and how.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) assembly: &'a Assembly,
    pub(crate) settings: &'a SolveSettings,
    pub(crate) selected: &'a [Selected],
    pub(crate) method: &'a dyn Method,
}

/// A solution with the measures read off it.
pub(crate) struct Solved {
    pub(crate) rtol: f64,
    pub(crate) trajectory: Trajectory,
    pub(crate) readings: Vec<Reading>,
    pub(crate) energy: Ledger,
}

/// The solution to report, and what is known about its errors.
pub(crate) struct Outcome {
    pub(crate) solved: Solved,
    pub(crate) errors: Vec<Option<f64>>,
    pub(crate) solves_for_error: usize,
    pub(crate) wall_for_error: Duration,
    /// What kept the accuracy from being reached.
    pub(crate) obstacle: Option<SolveError>,
}

impl Task<'_> {
    /// One solution where the method bounds its error or nobody asks for it, else as many as it
    /// takes.
    pub(crate) fn run(
        &self,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, SolveError> {
        if self.method.is_exact() || !self.settings.estimate {
            self.once(run, observer)
        } else {
            self.refined(run, observer)
        }
    }

    /// Whether the solution is as accurate as is wanted, as far as is known.
    pub(crate) fn suffices(&self, outcome: &Outcome) -> bool {
        self.is_good_enough(&outcome.solved, &outcome.errors)
    }

    fn solve(&self, run: &Run, observer: &mut dyn Observer) -> Result<Solved, SolveError> {
        let trajectory = self.method.integrate(&self.assembly.system, run, observer)?;
        let solution = Solution::new(self.assembly, &trajectory);
        let read = |entry: &Selected| entry.measure.read(&solution, entry.target);
        let readings = self.selected.iter().map(read).collect();
        let energy = ledger(&solution, solution.end());
        drop(solution);
        Ok(Solved { rtol: run.rtol, trajectory, readings, energy })
    }

    /// One solution, with the bounds that the method states, if any.
    fn once(&self, run: &Run, observer: &mut dyn Observer) -> Result<Outcome, SolveError> {
        let solved = self.solve(run, observer)?;
        let bound = |reading: &Reading| reading.error.map(|error| error + rounding(reading));
        let bounded = self.settings.estimate && self.method.is_exact();
        let errors = solved.readings.iter().map(|reading| bound(reading).filter(|_| bounded));
        Ok(Outcome {
            errors: errors.collect(),
            solved,
            solves_for_error: 0,
            wall_for_error: Duration::ZERO,
            obstacle: None,
        })
    }

    /// Solutions at falling tolerances: three if the tolerance is given, else until the accuracy is
    /// reached.
    fn refined(&self, run: &Run, observer: &mut dyn Observer) -> Result<Outcome, SolveError> {
        let mut last: Vec<Solved> = Vec::new();
        let mut solves = 0;
        let mut wall = Duration::ZERO;
        let mut obstacle = None;
        for rtol in self.tolerances() {
            match self.solve(&run.clone().with_rtol(rtol), observer) {
                Ok(finer) => {
                    solves += 1;
                    wall += finer.trajectory.statistics.wall;
                    if last.len() == 3 {
                        last.remove(0);
                    }
                    last.push(finer);
                }
                Err(error) if is_final(&error) => return Err(error),
                Err(error) => {
                    obstacle = Some(error);
                    // A finer solution may fail where rounding rules; a coarse one may fail where
                    // a finer one does not.
                    if last.len() == 3 {
                        break;
                    }
                    last.clear();
                }
            }
            if last.len() == 3 {
                obstacle = None;
                let errors = self.errors(&last);
                if last.last().is_some_and(|finest| self.is_good_enough(finest, &errors)) {
                    break;
                }
            }
        }
        let errors = self.errors(&last);
        let Some(solved) = last.pop() else {
            return Err(obstacle.unwrap_or(SolveError::NotApplicable {
                method: self.method.name(),
                reason: "no tolerance led to a solution".to_owned(),
            }));
        };
        let wall_for_error = wall.saturating_sub(solved.trajectory.statistics.wall);
        Ok(Outcome { errors, solved, solves_for_error: solves - 1, wall_for_error, obstacle })
    }

    fn tolerances(&self) -> Vec<f64> {
        match self.settings.rtol {
            Some(rtol) => vec![100.0 * rtol, 10.0 * rtol, rtol],
            // Powers of ten as they are written.
            None => (COARSEST..=FINEST).map(|exponent| 1.0 / 10.0_f64.powi(exponent)).collect(),
        }
    }

    /// The error of each measure of the last of three solutions; unknown if there are fewer.
    fn errors(&self, solved: &[Solved]) -> Vec<Option<f64>> {
        let [coarse, middle, fine] = solved else { return vec![None; self.selected.len()] };
        let closure = fine.energy.closure();
        let readings = coarse.readings.iter().zip(&middle.readings).zip(&fine.readings);
        let bar = |((coarse, middle), fine)| error_bar([coarse, middle, fine], closure);
        readings.map(bar).collect()
    }

    fn is_good_enough(&self, solved: &Solved, errors: &[Option<f64>]) -> bool {
        let accuracy = &self.settings.accuracy;
        let measures = self.selected.iter().zip(&solved.readings).zip(errors);
        let mut excesses = measures
            .map(|((entry, reading), &error)| excess(reading, error, accuracy.of(&entry.key)));
        let closure = solved.energy.closure().abs();
        excesses.all(|excess| excess <= 1.0) && closure <= accuracy.default.min(MOST_LOST)
    }
}

/// Whether another tolerance would change nothing about the error.
fn is_final(error: &SolveError) -> bool {
    matches!(
        error,
        SolveError::Cancelled { .. }
            | SolveError::NotApplicable { .. }
            | SolveError::InvalidSetting { .. }
    )
}
