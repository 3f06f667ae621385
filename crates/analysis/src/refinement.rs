//! As many solutions as the errors ask for.

use std::time::Duration;

use dashpot_dae::{Method, Observer, Run, SolveError, Trajectory, switching};
use dashpot_network::Assembly;

use crate::{
    Ledger, Reading, Solution, SolveSettings,
    accuracy::{error_bar, excess, is_as_good_as_zero, is_lost_in_noise, rounding},
    ledger::ledger,
    magnitude::largest,
    selection::Selected,
    solution::doubt_at,
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
    /// Part of the largest contact force below which a pull counts as an error of the method.
    pub(crate) doubt: f64,
    /// How deep each contact force first pulls.
    pulls: Vec<Option<f64>>,
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
        let trajectory = match &self.assembly.switching {
            None => self.method.integrate(&self.assembly.system, run, observer)?,
            Some(phased) => switching::integrate(self.method, phased.as_ref(), run, observer)?,
        };
        let doubt = doubt_at((!self.method.is_exact()).then_some(run.rtol));
        let solution = Solution::new(self.assembly, &trajectory).doubting(doubt);
        let readings = self.read(&solution);
        let pulls = if doubt > 0.0 { solution.first_pulls() } else { Vec::new() };
        let energy = ledger(&solution, solution.end());
        drop(solution);
        Ok(Solved { rtol: run.rtol, doubt, pulls, trajectory, readings, energy })
    }

    fn read(&self, solution: &Solution<'_>) -> Vec<Reading> {
        let read = |entry: &Selected| entry.measure.read(solution, entry.target);
        self.selected.iter().map(read).collect()
    }

    /// Reads three solutions again with the doubts about their contact forces that all three
    /// together leave.
    fn settle_doubts(&self, solved: &mut [Solved]) {
        let [coarse, middle, fine] = solved else { return };
        let doubts = doubts([coarse, middle, fine]);
        for (solved, doubt) in [coarse, middle, fine].into_iter().zip(doubts) {
            if solved.doubt.to_bits() != doubt.to_bits() {
                solved.doubt = doubt;
                let solution = Solution::new(self.assembly, &solved.trajectory).doubting(doubt);
                solved.readings = self.read(&solution);
            }
        }
    }

    /// One solution, with the bounds that the method states, if any.
    fn once(&self, run: &Run, observer: &mut dyn Observer) -> Result<Outcome, SolveError> {
        let mut solved = self.solve(run, observer)?;
        let bound = |reading: &Reading| reading.error.map(|error| error + rounding(reading));
        let bounded = self.settings.estimate && self.method.is_exact();
        let errors = solved.readings.iter().map(|reading| bound(reading).filter(|_| bounded));
        let errors: Vec<Option<f64>> = errors.collect();
        self.settle_zeros(&mut solved, &errors);
        Ok(Outcome {
            errors,
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
                self.settle_doubts(&mut last);
                let errors = self.errors(&last);
                if let Some(finest) = last.last_mut() {
                    self.settle_zeros(finest, &errors);
                    if self.is_good_enough(finest, &errors) {
                        break;
                    }
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

    /// Gives values that are as good as zero the size of what they are the remainder of, or of the
    /// largest signal of their unit, to which their errors are nothing.
    fn settle_zeros(&self, solved: &mut Solved, errors: &[Option<f64>]) {
        let accuracy = &self.settings.accuracy;
        let solution = Solution::new(self.assembly, &solved.trajectory);
        for ((entry, reading), &error) in self.selected.iter().zip(&mut solved.readings).zip(errors)
        {
            let wish = accuracy.of(&entry.key);
            let is_good = error.is_none_or(|error| error <= wish * reading.size);
            if is_lost_in_noise(reading, error) && !is_good {
                reading.size = reading.size.max(reading.noise / f64::EPSILON);
                continue;
            }
            if excess(reading, error, wish) <= 1.0 {
                continue;
            }
            let largest = largest(&solution, &solved.energy, entry.measure.unit());
            if is_as_good_as_zero(reading, error, (largest, wish)) {
                reading.size = reading.size.max(largest);
                reading.noise = reading.noise.max(error.unwrap_or(0.0));
            }
        }
    }

    fn is_good_enough(&self, solved: &Solved, errors: &[Option<f64>]) -> bool {
        let accuracy = &self.settings.accuracy;
        let measures = self.selected.iter().zip(&solved.readings).zip(errors);
        let mut excesses = measures
            .map(|((entry, reading), &error)| excess(reading, error, accuracy.of(&entry.key)));
        let closure = solved.energy.closure().abs();
        excesses.all(|excess| excess <= 1.0) && closure <= accuracy.strictest().min(MOST_LOST)
    }
}

/// The doubts with which to read three solutions.
///
/// An error of the method shrinks with the tolerance, while a pull that is one stays as deep: where
/// all three agree on it, it is not in doubt however shallow. Where they do not, and it is not
/// negligible, it is left open: all but the last solution are read as if there were no doubt, so
/// that what hangs on it shows in the error.
fn doubts(solved: [&Solved; 3]) -> [f64; 3] {
    /// How much deeper one pull may be than another that is the same.
    const SAME: f64 = 1.5;
    /// Part of the largest force up to which a pull is none.
    const NEGLIGIBLE: f64 = 1e-10;
    let mut doubts = solved.map(|solved| doubt_at(Some(solved.rtol)));
    let [coarse, middle, fine] = solved.map(|solved| &solved.pulls);
    let mut is_open = false;
    for ((coarse, middle), fine) in coarse.iter().zip(middle).zip(fine) {
        let Some(fine) = *fine else { continue };
        let is_same = |other: f64| fine.max(other) <= SAME * fine.min(other);
        match (*coarse, *middle) {
            (Some(coarse), Some(middle)) if is_same(coarse) && is_same(middle) => {
                let least = 0.5 * coarse.min(middle).min(fine);
                doubts = doubts.map(|doubt| doubt.min(least));
            }
            _ => is_open |= fine > NEGLIGIBLE && fine < doubts[2],
        }
    }
    if is_open { [0.0, 0.0, doubts[2]] } else { doubts }
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
