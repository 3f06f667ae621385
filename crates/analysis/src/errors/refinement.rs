//! As many solutions as the errors ask for.

use std::{collections::BTreeMap, ops::ControlFlow, time::Duration};

use dashpot_dae::{Observer, Run, SolveError};

use super::accuracy::largest;
use crate::{
    Ledger, Reading, Solution,
    errors::{
        accuracy::{
            Evidence, SMALL, SOLUTIONS, excess, is_as_good_as_zero, is_determined,
            is_lost_in_noise, of_energy, rounding,
        },
        instants::Instants,
        open_ends::{OpenEnd, cover_switching, cover_threshold},
        solved::{ALWAYS, Balance, Solved, Task},
    },
    measures::selection::Selected,
    solution::threshold_at,
};

/// At how many tolerances in a row a run may find no way on from one and the same instant before none is
/// looked for any more.
const ENDS_ALIKE: usize = 6;
/// Work of a finer solution in parts of that of the one before: one that takes more will not come to an end.
const FINER: u64 = 16;
/// The first tolerance that is tried, 1e-4, in half decades below 1.
const COARSEST: i32 = 8;
/// How many solutions are good enough, but for an impact whose end is open, before no finer one is made for its sake.
const SOLUTIONS_FOR_ENDS: usize = 2;
/// The last tolerance that is tried, 1e-12, in half decades below 1.
const FINEST: i32 = 24;

/// Memory that all solutions of a run together may keep, from whose differences its errors are estimated \[B\].
const MOST_KEPT: usize = 4_000_000_000;

/// The solution to report, and what is known about its errors.
pub(crate) struct Outcome {
    pub(crate) solved: Solved,
    pub(crate) errors: Vec<Option<f64>>,
    /// The same without what is open about the end of an impact, which no other method may mend.
    pub(crate) of_method: Vec<Option<f64>>,
    /// Whether it is open when an impact ends.
    pub(crate) open_end: Option<OpenEnd>,
    /// The errors of the times of events, as other solutions tell them; `None` where there are none.
    pub(crate) instants: Option<Instants>,
    pub(crate) solves_for_error: usize,
    pub(crate) wall_for_error: Duration,
    /// What kept the accuracy from being reached.
    pub(crate) obstacle: Option<SolveError>,
}

/// The errors of the measures of a solution.
struct Bars {
    errors: Vec<Option<f64>>,
    /// Without what is open about the end of an impact.
    of_method: Vec<Option<f64>>,
    open_end: Option<OpenEnd>,
}

/// Solutions at falling tolerances, on the way to the accuracy that is wanted.
struct Descent {
    /// The finest so far, as many as error bars take at most.
    last: Vec<Solved>,
    solves: usize,
    wall: Duration,
    /// What kept the last one that failed from being solved.
    obstacle: Option<SolveError>,
    /// At how many tolerances in a row the run has ended at one and the same instant.
    alike: usize,
    /// How many more that are good enough but for an open end of the impact.
    left: usize,
    /// Work that the next one may take.
    most: u64,
}

impl Descent {
    fn new() -> Self {
        Self {
            last: Vec::new(),
            solves: 0,
            wall: Duration::ZERO,
            obstacle: None,
            alike: 0,
            left: SOLUTIONS_FOR_ENDS,
            most: u64::MAX,
        }
    }

    /// Whether there are as many as error bars take.
    fn is_full(&self) -> bool {
        self.last.len() == SOLUTIONS
    }

    /// Takes a finer solution, which was so much `work`. Breaks where there is no room for it.
    fn take(&mut self, finer: Solved, work: u64) -> ControlFlow<()> {
        if let Some(error) = one_too_many(&self.last, &finer) {
            self.obstacle = Some(error);
            return ControlFlow::Break(());
        }
        self.most = ALWAYS.max(FINER * work);
        self.solves += 1;
        self.alike = 0;
        self.wall += finer.trajectory.statistics.wall;
        if self.is_full() {
            self.last.remove(0);
        }
        if let Some(before) = self.last.last_mut().and_then(|own| own.balance.get_mut()) {
            before.energy.gather_parts();
        }
        self.last.push(finer);
        ControlFlow::Continue(())
    }

    /// Notes what became of a finer solution. Breaks where those that are finer still do not get through either.
    fn fail(&mut self, error: SolveError) -> ControlFlow<()> {
        let again = self.obstacle.as_ref().is_some_and(|before| is_same_end(before, &error));
        self.alike = if again { self.alike + 1 } else { 1 };
        // A finer solution takes no less.
        let is_too_much = matches!(
            error,
            SolveError::BudgetSpent { .. }
                | SolveError::TooManySteps { .. }
                | SolveError::TooLarge { .. }
        );
        self.obstacle = Some(error);
        // A finer solution may fail where rounding rules; a coarse one may fail where a finer one does not.
        if is_too_much || self.alike == ENDS_ALIKE || self.is_full() {
            return ControlFlow::Break(());
        }
        self.last.clear();
        ControlFlow::Continue(())
    }
}

impl Task<'_> {
    /// One solution where the method bounds its error or nobody asks for it, else as many as it takes.
    pub(crate) fn run(
        &self,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Outcome, SolveError> {
        if self.is_single() { self.once(run, observer) } else { self.refined(run, observer) }
    }

    /// Whether the solution is as accurate as is wanted, as far as is known.
    pub(crate) fn suffices(&self, outcome: &Outcome) -> bool {
        self.knows(outcome) && self.is_good_enough(&outcome.solved, &outcome.of_method)
    }

    /// Whether anything is known of the errors of what is asked for, where errors are asked for.
    pub(crate) fn knows(&self, outcome: &Outcome) -> bool {
        let values = outcome.solved.readings.iter().zip(&outcome.of_method);
        let mut values = values.filter(|(reading, _)| reading.value.is_some()).peekable();
        let has_values = values.peek().is_some();
        !self.settings.estimate || !has_values || values.any(|(_, error)| error.is_some())
    }

    /// Whether an outcome is more accurate than another: no error exceeds both what is wanted and that of the
    /// other, and one that is more than is wanted there is smaller here. Each measure is taken for as large as
    /// in the smaller of both.
    pub(crate) fn is_better(&self, one: &Outcome, other: &Outcome) -> bool {
        let mut improves = false;
        for (at, entry) in self.selected.iter().enumerate() {
            let pair = [one, other].map(|own| (&own.solved.readings[at], own.of_method[at]));
            let size = pair[0].0.size.min(pair[1].0.size);
            let [new, old] = pair.map(|(reading, error)| {
                if reading.value.is_some() && error.is_none() {
                    return f64::INFINITY;
                }
                let reading = Reading { size, ..reading.clone() };
                excess(&reading, error, self.settings.accuracy.of(&entry.key))
            });
            if new > old.max(1.0) {
                return false;
            }
            improves |= old > 1.0 && new < old;
        }
        improves
    }

    /// Reads solutions again with the doubts about their contact forces that all of them together leave.
    fn settle_undecided(&self, solved: &mut [Solved]) {
        let thresholds = thresholds(solved);
        for (solved, threshold) in solved.iter_mut().zip(thresholds) {
            if solved.threshold.to_bits() != threshold.to_bits() {
                solved.threshold = threshold;
                let readings = self.read(&mut solved.as_read(self.assembly));
                solved.readings = readings;
            }
        }
    }

    /// One solution, with the bounds that the method states, if any.
    fn once(&self, run: &Run, observer: &mut dyn Observer) -> Result<Outcome, SolveError> {
        let mut solved = self.solve(run, self.is_judged, observer)?;
        let bound = |reading: &Reading| reading.error.map(|error| error + rounding(reading));
        let bounded = self.settings.estimate && self.method.is_exact();
        let errors = solved.readings.iter().map(|reading| bound(reading).filter(|_| bounded));
        let errors: Vec<Option<f64>> = errors.collect();
        self.settle_zeros(&mut solved, &errors);
        let open_end = if self.is_judged { OpenEnd::of_one(self, &mut solved) } else { None };
        Ok(Outcome {
            of_method: errors.clone(),
            errors,
            open_end,
            instants: None,
            solved,
            solves_for_error: 0,
            wall_for_error: Duration::ZERO,
            obstacle: None,
        })
    }

    /// Solutions at falling tolerances: as many as error bars take if the tolerance is given, else
    /// until the accuracy is reached.
    fn refined(&self, run: &Run, observer: &mut dyn Observer) -> Result<Outcome, SolveError> {
        let mut descent = Descent::new();
        for rtol in tolerances(self.settings.rtol) {
            let budget = run.budget.part(descent.most);
            let own = Run { budget: budget.clone(), ..run.clone() }.with_rtol(rtol);
            let is_judged = descent.last.len() + 1 >= SOLUTIONS;
            let flow = match self.solve(&own, is_judged, observer) {
                Ok(finer) => descent.take(finer, budget.done()),
                Err(error) if is_final(&error) => return Err(error),
                Err(error) => descent.fail(error),
            };
            if flow.is_break() || descent.is_full() && self.is_done(run, &mut descent) {
                break;
            }
        }
        let Descent { mut last, solves, wall, obstacle, .. } = descent;
        let Bars { mut errors, of_method, open_end } = self.bars(run, &last, true);
        for &at in open_end.iter().flat_map(|own| &own.undecided) {
            errors[at] = Some(f64::INFINITY);
        }
        let instants = Instants::of_solutions(&last, self.method.fall());
        let Some(solved) = last.pop() else {
            return Err(obstacle.unwrap_or(SolveError::NotApplicable {
                method: self.method.name(),
                reason: "no tolerance led to a solution".to_owned(),
            }));
        };
        Ok(Outcome {
            wall_for_error: wall.saturating_sub(solved.trajectory.statistics.wall),
            solves_for_error: solves - 1,
            solved,
            errors,
            of_method,
            open_end,
            instants,
            obstacle,
        })
    }

    /// Whether the last of as many solutions as error bars take is accurate enough, or finer ones would not make it so.
    fn is_done(&self, run: &Run, descent: &mut Descent) -> bool {
        descent.obstacle = None;
        self.settle_undecided(&mut descent.last);
        let bars = self.bars(run, &descent.last, false);
        let Some(finest) = descent.last.last_mut() else { return false };
        self.settle_zeros(finest, &bars.errors);
        if self.is_good_enough(finest, &bars.errors) {
            return true;
        }
        if self.is_good_enough(finest, &bars.of_method) {
            descent.left -= 1;
        }
        descent.left == 0
    }

    /// The error of each measure of the last of some solutions; unknown if there are too few. Whether that `is_last` is
    /// whether it is reported whatever they are.
    fn bars(&self, run: &Run, solved: &[Solved], is_last: bool) -> Bars {
        let Some((finest, others)) = solved.split_last().filter(|_| solved.len() == SOLUTIONS)
        else {
            let none = vec![None; self.selected.len()];
            return Bars { errors: none.clone(), of_method: none, open_end: None };
        };
        let energy = &finest.balance(self.assembly).energy;
        let lost = (energy.closure(), energy.turned_over);
        let least = |(entry, reading): (&Selected, &Reading)| {
            of_energy(reading, entry.measure.unit(), lost)
        };
        let evidence = Evidence {
            others: others.iter().map(Solved::told).collect(),
            finest: finest.told(),
            least: self.selected.iter().zip(&finest.readings).map(least).collect(),
            fall: self.method.fall(),
        };
        let mut of_method = evidence.error_bars();
        cover_switching(self, run, finest, &mut of_method);
        // Of what does not suffice anyhow another solution would tell nothing, unless it is what is reported.
        if is_last || self.is_good_enough(finest, &of_method) {
            cover_threshold(self, run, finest, &mut of_method);
        }
        let mut errors = of_method.clone();
        let open_end = OpenEnd::cover(self, solved, &mut errors);
        Bars { errors, of_method, open_end }
    }

    /// Gives values that are as good as zero the size of what they are the remainder of, or of the
    /// largest signal of their unit, to which their errors are nothing.
    fn settle_zeros(&self, solved: &mut Solved, errors: &[Option<f64>]) {
        let accuracy = &self.settings.accuracy;
        let turned_over = solved.balance(self.assembly).energy.turned_over;
        let mut solution = Solution::new(self.assembly, &solved.trajectory);
        if let Some(known) = solved.known.take() {
            solution = solution.knowing(known);
        }
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
            solution.make_room();
            let largest = largest(&solution, turned_over, entry.measure.unit());
            if is_as_good_as_zero(reading, error, (largest, wish)) {
                reading.size = reading.size.max(largest);
                reading.noise = reading.noise.max(error.unwrap_or(0.0));
            }
        }
        self.settle_small(&mut solved.readings, errors);
        solved.known = Some(solution.known()).filter(|_| self.is_single());
    }

    /// Gives values that are small beside the largest of their kind a part of its size, where nobody asks
    /// for them by name.
    fn settle_small(&self, readings: &mut [Reading], errors: &[Option<f64>]) {
        let accuracy = &self.settings.accuracy;
        let kinds: Vec<&str> = self.selected.iter().map(|entry| entry.measure.kind()).collect();
        let mut largest: BTreeMap<&str, f64> = BTreeMap::new();
        for ((kind, reading), &error) in kinds.iter().zip(&*readings).zip(errors) {
            if is_determined(reading, error) {
                let size = largest.entry(kind).or_default();
                *size = size.max(reading.size);
            }
        }
        for ((entry, kind), reading) in self.selected.iter().zip(kinds).zip(readings) {
            let is_asked_for = accuracy.by_measure.contains_key(&entry.key);
            if let Some(size) = largest.get(kind).filter(|_| !is_asked_for) {
                reading.size = reading.size.max(SMALL * size);
            }
        }
    }

    fn is_good_enough(&self, solved: &Solved, errors: &[Option<f64>]) -> bool {
        let accuracy = &self.settings.accuracy;
        let measures = self.selected.iter().zip(&solved.readings).zip(errors);
        let mut excesses = measures
            .map(|((entry, reading), &error)| excess(reading, error, accuracy.of(&entry.key)));
        let Balance { energy, tension } = solved.balance(self.assembly);
        let closure = energy.closure().abs();
        let strictest = accuracy.strictest();
        excesses.all(|excess| excess <= 1.0)
            && closure <= strictest.min(Ledger::MOST_LOST)
            && *tension <= strictest
    }
}

/// That a solution is one too many to be kept beside those before it from which its errors are estimated.
fn one_too_many(before: &[Solved], next: &Solved) -> Option<SolveError> {
    let others = before.iter().rev().take(SOLUTIONS - 1).map(|own| &own.trajectory);
    let trajectory = &next.trajectory;
    let bytes = others.chain([trajectory]).map(|other| other.dense.bytes()).sum();
    let (time, steps) = (trajectory.t_end, trajectory.statistics.accepted);
    let error = SolveError::TooLarge { method: trajectory.method, time, steps, bytes };
    (bytes > MOST_KEPT).then_some(error)
}

/// The tolerances to solve at, a factor √10 apart.
fn tolerances(finest: Option<f64>) -> Vec<f64> {
    /// Where those lie above a tolerance that is given, in half decades.
    const ABOVE: [i32; SOLUTIONS] = [3, 2, 1, 0];
    // Powers of ten as they are written.
    let below = |half_decades: i32| {
        let power = 10.0_f64.powi(half_decades / 2);
        if half_decades % 2 == 0 { power } else { power * 10.0_f64.sqrt() }
    };
    match finest {
        Some(rtol) => ABOVE.map(|above| rtol * below(above)).to_vec(),
        None => (COARSEST..=FINEST).map(|down| 1.0 / below(down)).collect(),
    }
}

/// The doubts with which to read solutions, the last of which is the finest.
///
/// An error of the method shrinks with the tolerance, while a pull that is one stays as deep: where all agree on it, it
/// is not in doubt however shallow. Where they do not, and it is not negligible, it is left open: all but the finest
/// solution are read as if there were no doubt, so that what hangs on it shows in the error.
fn thresholds(solved: &[Solved]) -> Vec<f64> {
    /// How much deeper one pull may be than another that is the same.
    const SAME: f64 = 1.5;
    /// Part of the largest force up to which a pull is none.
    const NEGLIGIBLE: f64 = 1e-10;
    let mut thresholds: Vec<f64> = solved.iter().map(|own| threshold_at(Some(own.rtol))).collect();
    let Some((finest, others)) = solved.split_last() else { return thresholds };
    let own_threshold = threshold_at(Some(finest.rtol));
    let (mut least, mut is_open) = (f64::INFINITY, false);
    for (at, fine) in finest.pulls.iter().enumerate() {
        let Some(fine) = *fine else { continue };
        let is_same = |pull: &f64| fine.max(*pull) <= SAME * fine.min(*pull);
        let pulls = others.iter().map(|other| other.pulls.get(at).copied().flatten());
        match pulls.map(|pull| pull.filter(is_same)).collect::<Option<Vec<f64>>>() {
            Some(pulls) => least = least.min(0.5 * pulls.into_iter().fold(fine, f64::min)),
            None => is_open |= fine > NEGLIGIBLE && fine < own_threshold.min(least),
        }
    }
    for threshold in &mut thresholds {
        *threshold = threshold.min(least);
    }
    if is_open && let Some((_, others)) = thresholds.split_last_mut() {
        others.fill(0.0);
    }
    thresholds
}

/// Whether another tolerance would change nothing about the error.
fn is_final(error: &SolveError) -> bool {
    matches!(
        error,
        SolveError::Cancelled { .. }
            | SolveError::NotApplicable { .. }
            | SolveError::InvalidSetting { .. }
            | SolveError::TooManySwitches { .. }
    )
}

/// Whether two runs found no way on from one and the same instant. Of what switches in a knot, each may
/// name another part.
pub(crate) fn is_same_end(one: &SolveError, other: &SolveError) -> bool {
    /// How far apart instants are the same, in parts of the time.
    const NEAR: f64 = 1e-2;
    match (one, other) {
        (SolveError::Switching { time, .. }, SolveError::Switching { time: other, .. }) => {
            (time - other).abs() <= NEAR * time.max(*other)
        }
        _ => false,
    }
}
