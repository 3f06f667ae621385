//! From leg to leg.

use std::{ops::ControlFlow, time::Instant};

use dashpot_numerics::Twofold;

use super::{
    Leg, LegEnd, Switching,
    chain::{Chain, Solved},
    flight::follow,
    precision::{margin, smaller_sizes},
    shaken::{Afterwards, Shaken},
};
use crate::{
    Event, Keep, Method, Observer, Outcome, Progress, Run, Shared, SolveError, Statistics, Switch,
    Trajectory, pieces::MOST_BYTES,
};

/// Most legs of a run.
const MOST_LEGS: usize = 200_000;
/// Most legs that begin at one instant: more are a sign that no phases hold there.
const MOST_AT_ONCE: usize = 64;
/// Errors of stepping methods at events, in parts of their tolerance.
const ERRORS_PER_TOLERANCE: f64 = 1e2;
/// Most that such errors may be in parts of a quantity: were they as large as the quantity itself, a part
/// could not be told to have left its level, and would switch there again and again.
const LARGEST_ERROR: f64 = 0.1;
/// Roundings of a method that has no other error.
const ROUNDINGS: f64 = 1e3;

/// Solves a run leg by leg with one method.
///
/// A method without an error of its own solves a run of several legs twice, the second time with the
/// state at the end of each leg shaken in its last digits: by what comes of that the errors of its
/// signals are estimated.
///
/// # Errors
///
/// What the method says of a leg; [`SolveError::Switching`] where no leg can follow, or too many do at one instant;
/// [`SolveError::TooManySwitches`] where too many do in all.
pub fn integrate(
    method: &dyn Method,
    switching: &dyn Switching,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Trajectory, SolveError> {
    let begin = Instant::now();
    let doubt = if method.is_exact() {
        ROUNDINGS * f64::EPSILON
    } else {
        (ERRORS_PER_TOLERANCE * run.rtol).min(LARGEST_ERROR)
    };
    let mut shared = Shared::default();
    let Solution { mut chain, name, t_end, first_phases, mut found } =
        solve(method, switching, run, (doubt, MOST_LEGS), &mut shared, observer)?;
    if method.is_exact() && chain.legs.len() > 1 {
        let shaken = Shaken { inner: switching };
        let unwatched = Run { guards: Vec::new(), t_end, ..run.clone() };
        let limits = (doubt, Shaken::most_legs(chain.legs.len()));
        let end = Progress { time: t_end, steps: found.statistics.accepted };
        let mut afterwards = Afterwards { end, observer };
        chain.doubled =
            Some(match solve(method, &shaken, &unwatched, limits, &mut shared, &mut afterwards) {
                Ok(other) => other.chain.legs,
                Err(error @ SolveError::Cancelled { .. }) => return Err(error),
                Err(_) => Vec::new(),
            });
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

/// All legs of a run.
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
    (doubt, most_legs): (f64, usize),
    shared: &mut Shared,
    observer: &mut dyn Observer,
) -> Result<Solution, SolveError> {
    let mut leg = switching.first(doubt)?;
    let first_phases = leg.phases.clone();
    let mut drive =
        Drive { start: Twofold::ZERO, steps: 0, run, observer, chain: Chain::default() };
    let mut found = Found { switches: leg.switches.clone(), ..Found::default() };
    let (mut at_once, mut bytes) = (0, 0);
    loop {
        let start = drive.start.high();
        let (mut trajectory, reached) = drive.leg(method, &leg, &mut found)?;
        let t_end = reached.high();
        let goes_on = found.goes_on(&leg, &trajectory, t_end, run);
        if trajectory.outcome == Outcome::Finished && !goes_on && !method.is_exact() {
            drive.chain.margin = margin(&leg, trajectory.dense.as_ref(), run, doubt);
        }
        let length = trajectory.t_end / leg.system.time_scale;
        let state = trajectory.dense.sample(&leg.system, &[length]);
        let at_end =
            |event: &&Event| event.time >= trajectory.t_end && event.guard < leg.guards.len();
        let fired: Vec<usize> =
            trajectory.events.iter().filter(at_end).map(|event| event.guard).collect();
        let name = trajectory.method;
        trajectory.dense.share(shared);
        bytes += trajectory.dense.bytes();
        drive.chain.legs.push(Solved {
            start,
            end: t_end,
            phases: leg.phases.clone(),
            system: leg.system.reporting(length),
            dense: trajectory.dense,
        });
        if bytes > MOST_BYTES {
            let steps = found.statistics.accepted;
            return Err(SolveError::TooLarge { method: name, time: t_end, steps, bytes });
        }
        if run.budget.charge_choice() {
            let work = run.budget.done();
            return Err(SolveError::BudgetSpent { method: name, time: t_end, work });
        }
        if !goes_on {
            return Ok(Solution { chain: drive.chain, name, t_end, first_phases, found });
        }
        at_once = if t_end > start { 0 } else { at_once + 1 };
        if at_once > MOST_AT_ONCE {
            return Err(found.endless(t_end));
        }
        if drive.chain.legs.len() >= most_legs {
            let parts = found.last_parts();
            return Err(SolveError::TooManySwitches { time: t_end, legs: most_legs, parts });
        }
        let end = LegEnd { leg: &leg, time: t_end, length, state: &state, fired: &fired, doubt };
        leg = switching.next(&end)?;
        found.switches.extend(leg.switches.iter().cloned());
        drive.start = reached;
    }
}

/// Where a run is.
struct Drive<'r> {
    /// Start of the leg \[s\], the sum of all legs before: rounded, it would shift every leg of many short
    /// ones the same way.
    start: Twofold,
    /// Steps of the legs before.
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
    /// Whether another leg follows the one of this `trajectory`, which ends at `t_end` in the run; takes
    /// down the run's own guard that has ended it.
    fn goes_on(&mut self, leg: &Leg, trajectory: &Trajectory, t_end: f64, run: &Run) -> bool {
        let own = leg.guards.len();
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
            self.switches.iter().rev().take(4).map(|own| format!("`{}`", own.name)).collect();
        names.sort();
        names.dedup();
        names.join(", ")
    }
}

impl Drive<'_> {
    /// Solves one leg; returns it and the time of its end in the run.
    fn leg(
        &mut self,
        method: &dyn Method,
        leg: &Leg,
        found: &mut Found,
    ) -> Result<(Trajectory, Twofold), SolveError> {
        let own = leg.guards.len();
        let last = leg.until.map_or(self.run.t_end, |own| own.min(self.run.t_end));
        let run = Run {
            t_end: (Twofold::from(last) - self.start).high(),
            rtol: self.run.rtol,
            nominal: Vec::new(),
            guards: leg.guards.iter().chain(&self.run.guards).cloned().collect(),
            keep: Keep::Everything,
            budget: self.run.budget.clone(),
        };
        let mut shifted =
            Shifted { start: self.start.high(), steps: self.steps, observer: &mut *self.observer };
        let followed = match leg.flight {
            Some(flight) => follow(leg, flight, method, &run, &mut shifted)?,
            None => None,
        };
        let trajectory = match followed {
            Some(trajectory) => trajectory,
            None => solve_to_size(leg, method, run, &mut shifted)?,
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

/// Solves a leg as often as it takes for what its guards watch to be followed to its own size. A finer
/// solution that fails leaves the one before.
fn solve_to_size(
    leg: &Leg,
    method: &dyn Method,
    mut run: Run,
    observer: &mut Shifted<'_>,
) -> Result<Trajectory, SolveError> {
    let mut found = method.integrate(&leg.system, &run, observer)?;
    if method.is_exact() {
        return Ok(found);
    }
    while let Some(sizes) = smaller_sizes(leg, &run, &found) {
        observer.steps += found.statistics.accepted;
        run.nominal = sizes;
        let work = found.statistics;
        match method.integrate(&leg.system, &run, observer) {
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
