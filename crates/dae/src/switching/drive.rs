//! From interval to interval.

use std::{ops::ControlFlow, time::Instant};

use dashpot_numerics::DoubleDouble;

use super::{
    IntervalEnd, ModeInterval, Switching,
    chain::{Chain, Solved},
    precision::{Afterwards, Perturbed, end_margin, smaller_sizes},
    predicted::follow,
};
use crate::{
    Event, Keep, Method, Observer, Outcome, Progress, Run, Shared, SolveError, Statistics, Switch,
    Trajectory, pieces::MOST_BYTES,
};

/// Most intervals of a run.
const MOST_INTERVALS: usize = 200_000;
/// Unknowns up to which an interval of a method with steps keeps its equations, which tell rates.
const FEW: usize = 8;
/// Roundings of the time that two instants are apart which are one.
const AT_ONCE: f64 = 1.0;
/// Most intervals that begin at one instant: more are a sign that no phases hold there.
const MOST_AT_ONCE: usize = 64;
/// Most that such errors may be in parts of a quantity: were they as large as the quantity itself, a part
/// could not be told to have left its level, and would switch there again and again.
const LARGEST_ERROR: f64 = 0.1;
/// Roundings of a method that has no other error.
const ROUNDINGS: f64 = 1e3;

/// Solves a run interval by interval with one method.
///
/// A method without an error of its own solves a run of several intervals twice where errors will be asked for, the
/// second time with the state at the end of each interval perturbed in its last digits: by what comes of that the errors
/// of its signals are estimated.
///
/// # Errors
///
/// What the method says of an interval; [`SolveError::Switching`] where no interval can follow, or
/// too many do at one instant; [`SolveError::TooManySwitches`] where too many do in all.
pub fn integrate(
    method: &dyn Method,
    switching: &dyn Switching,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Trajectory, SolveError> {
    let begin = Instant::now();
    let threshold = if method.is_exact() {
        ROUNDINGS * f64::EPSILON
    } else {
        (run.errors_at_events * run.rtol).min(LARGEST_ERROR)
    };
    let mut shared = Shared::default();
    let Solution { mut chain, name, t_end, first_phases, mut found } =
        solve(method, switching, run, (threshold, MOST_INTERVALS), &mut shared, observer)?;
    if method.is_exact() && run.is_bounded && chain.intervals.len() > 1 {
        let perturbed = Perturbed { inner: switching };
        let unwatched = Run { guards: Vec::new(), t_end, ..run.clone() };
        let limits = (threshold, Perturbed::most_intervals(chain.intervals.len()));
        let end = Progress { time: t_end, steps: found.statistics.accepted };
        let mut afterwards = Afterwards { end, observer };
        shared.again();
        chain.doubled = Some(
            match solve(method, &perturbed, &unwatched, limits, &mut shared, &mut afterwards) {
                Ok(other) => other.chain.intervals,
                Err(error @ SolveError::Cancelled { .. }) => return Err(error),
                Err(_) => Vec::new(),
            },
        );
    }
    found.statistics.wall = begin.elapsed();
    let outcome = found.outcome.map_or(Outcome::Finished, |guard| Outcome::Stopped { guard });
    Ok(Trajectory {
        method: name,
        outcome,
        t_end,
        events: found.events,
        first_phases,
        switches: found.switches,
        statistics: found.statistics,
        dense: Box::new(chain),
    })
}

/// All intervals of a run.
struct Solution {
    chain: Chain,
    name: &'static str,
    t_end: f64,
    first_phases: Vec<(usize, f64)>,
    found: Found,
}

fn solve(
    method: &dyn Method,
    switching: &dyn Switching,
    run: &Run,
    (threshold, most_intervals): (f64, usize),
    shared: &mut Shared,
    observer: &mut dyn Observer,
) -> Result<Solution, SolveError> {
    let mut interval = switching.first(threshold)?;
    let first_phases = interval.phases.clone();
    let mut drive =
        Drive { start: DoubleDouble::ZERO, steps: 0, run, observer, chain: Chain::default() };
    let mut found = Found { switches: interval.switches.clone(), ..Found::default() };
    let (mut at_once, mut bytes) = (0, 0);
    loop {
        let start = drive.start.high();
        let (trajectory, reached) = drive.interval(method, &interval, shared, &mut found)?;
        let t_end = reached.high();
        let goes_on = found.goes_on(&interval, &trajectory, t_end, run);
        if trajectory.outcome == Outcome::Finished && !goes_on && !method.is_exact() {
            drive.chain.end_margin =
                end_margin(&interval, trajectory.dense.as_ref(), run, threshold);
        }
        let length = trajectory.t_end / interval.system.time_scale;
        let state = trajectory.dense.sample(&interval.system, &[length]);
        let at_end =
            |event: &&Event| event.time >= trajectory.t_end && event.guard < interval.guards.len();
        let fired: Vec<usize> =
            trajectory.events.iter().filter(at_end).map(|event| event.guard).collect();
        let name = trajectory.method;
        bytes += trajectory.dense.bytes();
        drive.chain.intervals.push(Solved {
            start,
            end: t_end,
            phases: interval.phases.clone(),
            system: interval.system.reporting(length, if method.is_exact() { 0 } else { FEW }),
            dense: trajectory.dense,
        });
        if bytes > MOST_BYTES {
            let steps = found.statistics.accepted;
            return Err(SolveError::TooLarge { method: name, time: t_end, steps, bytes });
        }
        if run.budget.charge_choices(interval.tried) {
            let work = run.budget.done();
            return Err(SolveError::BudgetSpent { method: name, time: t_end, work });
        }
        if !goes_on {
            return Ok(Solution { chain: drive.chain, name, t_end, first_phases, found });
        }
        let comes_on = t_end - start > AT_ONCE * f64::EPSILON * t_end;
        at_once = if comes_on { 0 } else { at_once + 1 };
        if at_once > MOST_AT_ONCE {
            return Err(found.endless(t_end));
        }
        if drive.chain.intervals.len() >= most_intervals {
            let parts = found.last_parts();
            return Err(SolveError::TooManySwitches {
                time: t_end,
                intervals: most_intervals,
                parts,
            });
        }
        let end = IntervalEnd {
            interval: &interval,
            time: t_end,
            length,
            state: &state,
            fired: &fired,
            threshold,
        };
        interval = switching.next(&end)?;
        drive.chain.hangs_on_threshold |= interval.hangs_on_threshold;
        found.switches.extend(interval.switches.iter().cloned());
        drive.start = reached;
    }
}

/// Where a run is.
struct Drive<'r> {
    /// Start of the interval \[s\], the sum of all intervals before: rounded, it would shift every
    /// interval of many short ones the same way.
    start: DoubleDouble,
    /// Steps of the intervals before.
    steps: usize,
    run: &'r Run,
    observer: &'r mut dyn Observer,
    chain: Chain,
}

/// What a run has met.
#[derive(Default)]
struct Found {
    events: Vec<Event>,
    switches: Vec<Switch>,
    statistics: Statistics,
    outcome: Option<usize>,
}

impl Found {
    /// Whether another interval follows the one of this `trajectory`, which ends at `t_end` in the
    /// run; takes down the run's own guard that has ended it.
    fn goes_on(
        &mut self,
        interval: &ModeInterval,
        trajectory: &Trajectory,
        t_end: f64,
        run: &Run,
    ) -> bool {
        let own = interval.guards.len();
        self.outcome = match trajectory.outcome {
            Outcome::Finished => None,
            Outcome::Stopped { guard } if guard >= own => Some(guard - own),
            Outcome::Stopped { .. } => {
                // A condition of the run's own may be met at the same instant.
                let met = |event: &&Event| {
                    event.time >= trajectory.t_end
                        && event.guard >= own
                        && run.guards[event.guard - own].stops
                };
                trajectory.events.iter().find(met).map(|event| event.guard - own)
            }
        };
        self.outcome.is_none() && t_end < run.t_end
    }

    /// The error of a run that does not come on.
    fn endless(&self, time: f64) -> SolveError {
        let parts = self.last_parts();
        let parts = if parts.is_empty() { "what is watched" } else { parts.as_str() };
        let reason = format!("{parts} switches without end");
        SolveError::Switching { time, reason }
    }

    /// The names of what switched last.
    fn last_parts(&self) -> String {
        let mut names: Vec<String> =
            self.switches.iter().rev().take(4).map(|switch| format!("`{}`", switch.name)).collect();
        names.sort();
        names.dedup();
        names.join(", ")
    }
}

impl Drive<'_> {
    /// Solves one interval; returns it and the time of its end in the run.
    fn interval(
        &mut self,
        method: &dyn Method,
        interval: &ModeInterval,
        shared: &mut Shared,
        found: &mut Found,
    ) -> Result<(Trajectory, DoubleDouble), SolveError> {
        let own = interval.guards.len();
        let last = interval.until.map_or(self.run.t_end, |until| until.min(self.run.t_end));
        let run = Run {
            t_end: (DoubleDouble::from(last) - self.start).high(),
            tolerance_scaling: Vec::new(),
            guards: interval.guards.iter().chain(&self.run.guards).cloned().collect(),
            keep: Keep::Everything,
            budget: self.run.budget.clone(),
            ..*self.run
        };
        let mut shifted =
            Shifted { start: self.start.high(), steps: self.steps, observer: &mut *self.observer };
        let start = self.start.high();
        let later = |error: SolveError| error.later(start);
        let followed = match interval.predicted {
            Some(predicted) => {
                follow(interval, predicted, method, &run, &mut shifted).map_err(later)?
            }
            None => None,
        };
        let trajectory = match followed {
            Some(trajectory) => trajectory,
            None => solve_to_size(interval, method, run, shared, &mut shifted).map_err(later)?,
        };
        let finished = trajectory.outcome == Outcome::Finished;
        let t_end = if finished { last.into() } else { self.start + trajectory.t_end };
        let users = trajectory.events.iter().filter(|event| event.guard >= own);
        found.events.extend(users.map(|event| Event {
            time: (self.start + event.time).high(),
            guard: event.guard - own,
            rising: event.rising,
        }));
        self.steps += trajectory.statistics.accepted;
        found.statistics.add(&trajectory.statistics);
        Ok((trajectory, t_end))
    }
}

/// Solves an interval as often as it takes for what its guards watch to be followed to its own
/// size. A finer solution that fails leaves the one before.
fn solve_to_size(
    interval: &ModeInterval,
    method: &dyn Method,
    mut run: Run,
    shared: &mut Shared,
    observer: &mut Shifted<'_>,
) -> Result<Trajectory, SolveError> {
    let mut found = method.integrate_interval(&interval.system, &run, shared, observer)?;
    if method.is_exact() {
        return Ok(found);
    }
    while let Some(sizes) = smaller_sizes(interval, &run, &found) {
        observer.steps += found.statistics.accepted;
        run.tolerance_scaling = sizes;
        let work = found.statistics;
        match method.integrate_interval(&interval.system, &run, shared, observer) {
            Ok(finer) => found = finer,
            Err(error @ SolveError::Cancelled { .. }) => return Err(error),
            Err(_) => break,
        }
        found.statistics.add(&work);
    }
    Ok(found)
}

/// Tells an observer of the whole run.
struct Shifted<'r> {
    start: f64,
    steps: usize,
    observer: &'r mut dyn Observer,
}

impl Observer for Shifted<'_> {
    fn progress(&mut self, progress: Progress) -> ControlFlow<()> {
        let Progress { time, steps } = progress;
        self.observer.progress(Progress { time: self.start + time, steps: self.steps + steps })
    }
}
