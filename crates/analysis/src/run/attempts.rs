//! Which methods are tried, in what order, and whose solution is reported.

use std::sync::Arc;

use dashpot_dae::{Budget, Method, Observer, Run, SolveError, methods};

use crate::{
    RunError,
    errors::{
        refinement::{Outcome, is_same_end},
        solved::Task,
    },
};

/// Work of a further method in parts of what has been done before it, where there is a solution already
/// that is not as good as is wanted.
const FURTHER: u64 = 4;
/// Work of a method with steps where there are more oscillations than `exact` follows, or than its budget is enough for:
/// enough where they are not excited.
pub(crate) const UNDEFINED: u64 = 5_000_000;
/// Work of a method after one that has failed, or as much as that: some seconds.
const AFTER_ANOTHER: u64 = 200_000_000;
/// Lifetimes after which an oscillation takes no steps any more.
const DECAYED: f64 = 10.0;
/// Such work that is always granted: some tenths of a second.
const ALWAYS: u64 = 20_000_000;

/// The solution to report.
pub(crate) struct Found {
    pub(crate) method: Arc<dyn Method>,
    pub(crate) why: String,
    pub(crate) outcome: Outcome,
}

/// Solves by `method` and, where that fails and `others` are given, by them, the last one first. Where nothing is known
/// of the errors of the one that does not, those that only lacked work are among the `others` again.
///
/// Each but the last may take half of what is left of the budget, so that one that is stuck leaves something to the
/// next; none more than `most`, and those after the first no more than a while, because what ends one method seldom
/// lets another through: where the first one lacked work, the share of its work that corresponds to how far it got.
/// Errors: what became of the first one, and of the others.
pub(crate) fn first_that_solves(
    task: &Task<'_>,
    run: &Run,
    ((mut method, mut why), most): ((Arc<dyn Method>, String), u64),
    others: &mut Vec<Arc<dyn Method>>,
    observer: &mut dyn Observer,
) -> Result<Found, RunError> {
    let (mut first, mut tried): (Option<RunError>, Vec<&str>) = (None, Vec::new());
    let mut of_first = 0;
    let mut short: Vec<Arc<dyn Method>> = Vec::new();
    loop {
        let share = if others.is_empty() { u64::MAX } else { half(&run.budget, task) };
        let granted = match &first {
            None => u64::MAX,
            Some(RunError::Solve(SolveError::BudgetSpent { time, .. })) => {
                ALWAYS.max(share_of(of_first, time / run.t_end))
            }
            Some(_) => AFTER_ANOTHER.max(run.budget.done()),
        };
        let share = run.budget.part(share.min(granted).min(most));
        let own = Task { method: method.as_ref(), ..*task };
        let error = match own.run(&Run { budget: share, ..run.clone() }, observer) {
            Ok(outcome) => {
                let Some(error) = own.fault(&outcome.solved) else {
                    if !own.knows(&outcome) {
                        others.extend(short.into_iter().rev());
                    }
                    return Ok(Found { method, why, outcome });
                };
                // No other method makes the numbers smaller.
                if first.is_none() && matches!(error, RunError::BeyondRange) {
                    return Err(error);
                }
                let lacks_work = matches!(outcome.obstacle, Some(SolveError::BudgetSpent { .. }));
                short.extend(lacks_work.then(|| Arc::clone(&method)));
                error
            }
            // No other method gets farther.
            Err(
                error @ (SolveError::Cancelled { .. }
                | SolveError::InvalidSetting { .. }
                | SolveError::TooManySwitches { .. }),
            ) => return Err(error.into()),
            Err(error) => {
                let lacks_work = matches!(error, SolveError::BudgetSpent { .. });
                short.extend(lacks_work.then(|| Arc::clone(&method)));
                RunError::Solve(error)
            }
        };
        let is_agreed = match (&first, &error) {
            (Some(RunError::Solve(before)), RunError::Solve(now)) => is_same_end(before, now),
            _ => false,
        };
        let goes_on = !is_agreed && !run.budget.is_spent();
        let Some(next) = others.pop().filter(|_| goes_on) else {
            return Err(none_gets_through(first, error, tried));
        };
        tried.push(next.name());
        // A phase that is reached later may ask for more than the first one.
        why = match &error {
            RunError::EnergyLost { .. } | RunError::Slider { .. } => error.to_string(),
            error => format!("`{}` does not get through: {error}", method.name()),
        };
        if first.is_none() {
            (first, of_first) = (Some(error), run.budget.done());
        }
        method = next;
    }
}

/// A part of some work.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "no more than the work"
)]
fn share_of(work: u64, part: f64) -> u64 {
    (part.clamp(0.0, 1.0) * work as f64) as u64
}

fn half(budget: &Budget, task: &Task<'_>) -> u64 {
    task.settings.budget.saturating_sub(budget.done()) / 2
}

/// The exact solution of the part of a run that ends at `reach` \[s\], and that part.
pub(crate) fn of_a_part(
    task: &Task<'_>,
    run: &Run,
    reach: f64,
    observer: &mut dyn Observer,
) -> Option<(Found, Run)> {
    let part = Run { t_end: reach, ..run.clone() };
    let own = Task { method: &methods::Exact, ..*task };
    let outcome = own.run(&part, observer).ok()?;
    let why = "the scene is linear, and its impact is over before it has oscillated too often";
    Some((Found { method: Arc::new(methods::Exact), why: why.to_owned(), outcome }, part))
}

/// A better solution by one of the `others`, where that which was `found` is not as good as is wanted and
/// its own method cannot make it so.
///
/// They may take a few times the work that it was, or where nothing is known of its errors some seconds. Theirs is
/// better where nothing was known of its errors, or where none of their bars is wider beyond what is wanted, and one
/// is narrower.
pub(crate) fn improved(
    task: &Task<'_>,
    run: &Run,
    mut found: Found,
    others: Vec<Arc<dyn Method>>,
    observer: &mut dyn Observer,
) -> Found {
    // Of second order, the last resort would take too long for what is asked here.
    let last_resort = methods::TrBdf2.name();
    // What an explicit method does not do well itself it has left to backward differentiation.
    let is_explicit = found.method.name() == methods::Dop853.name();
    let is_tried = |other: &Arc<dyn Method>| is_explicit && other.name() == methods::Bdf.name();
    let others = others.into_iter().rev().filter(|other| other.name() != last_resort);
    let mut forecast = None;
    for other in others.filter(|other| !is_tried(other)) {
        let before = Task { method: found.method.as_ref(), ..*task };
        let is_stuck = found.method.is_exact() || found.outcome.obstacle.is_some();
        if !is_stuck || before.suffices(&found.outcome) {
            break;
        }
        let is_known = before.knows(&found.outcome);
        let least = if is_known { ALWAYS } else { AFTER_ANOTHER };
        let granted = least.max(FURTHER * run.budget.done());
        let is_exact = found.method.is_exact();
        let forecast = *forecast.get_or_insert_with(|| {
            if is_exact { forecast_of(task, run, &found.outcome) } else { 0.0 }
        });
        let is_enough = forecast <= granted as f64;
        let budget = run.budget.part(if is_enough { granted } else { UNDEFINED });
        let own = Task { method: other.as_ref(), ..*task };
        let Ok(outcome) = own.run(&Run { budget, ..run.clone() }, observer) else { continue };
        let is_better =
            own.knows(&outcome) && (!is_known || own.is_better(&outcome, &found.outcome));
        if is_better && own.fault(&outcome.solved).is_none() {
            let name = found.method.name();
            let why = if !is_known {
                format!("the error of `{name}` is not known")
            } else if found.method.is_exact() {
                "the error of `exact` may exceed what is wanted".to_owned()
            } else {
                format!("`{name}` does not reach the accuracy that is wanted")
            };
            found = Found { method: other, why, outcome };
        }
    }
    found
}

/// The least work of a method with steps that follows the fastest oscillation of a run that `exact` has solved to the
/// accuracy wanted, if it is excited anew at each switching, or 0 where that is not known: one of order 5, whose phase is
/// off by `(ω h)⁵` in each radian.
fn forecast_of(task: &Task<'_>, run: &Run, exact: &Outcome) -> f64 {
    let (system, trajectory) = (&task.assembly.system, &exact.solved.trajectory);
    let times = 1 + trajectory.switches.len();
    let part = Run { t_end: trajectory.t_end, ..run.clone() };
    let radians = methods::Exact::radians(system, &part, DECAYED * times as f64).unwrap_or(0.0);
    let in_each = (radians / task.settings.accuracy.strictest()).powf(0.2);
    Budget::of_step(system.len()) as f64 * radians * in_each
}

/// The methods that `auto` turns to where this one fails, the last one first. Where `exact` does not get through
/// the explicit one comes first, if the system `allows_explicit`: it leaves what is stiff to backward differentiation by itself.
pub(crate) fn others(first: &dyn Method, allows_explicit: bool) -> Vec<Arc<dyn Method>> {
    let implicit: [Arc<dyn Method>; 3] =
        [Arc::new(methods::TrBdf2), Arc::new(methods::Esdirk34), Arc::new(methods::Bdf)];
    let explicit = (first.is_exact() && allows_explicit).then(|| Arc::new(methods::Dop853) as _);
    implicit.into_iter().chain(explicit).filter(|own| own.name() != first.name()).collect()
}

/// What is said where the last method that is tried fails: what became of the first.
pub(crate) fn none_gets_through(
    first: Option<RunError>,
    last: RunError,
    others: Vec<&'static str>,
) -> RunError {
    match first {
        Some(RunError::Solve(
            error @ (SolveError::StepTooSmall { .. } | SolveError::NewtonFailed { .. }),
        )) => RunError::NoneGetsThrough { error, others },
        // That it does not apply says nothing of why the others fail.
        Some(RunError::Solve(SolveError::NotApplicable { .. })) => {
            let (_, others) = others.split_last().unwrap_or((&"", &[]));
            match last {
                RunError::Solve(SolveError::NotApplicable { .. }) => last,
                last => none_gets_through(Some(last.clone()), last, others.to_vec()),
            }
        }
        Some(first) => first,
        None => last,
    }
}
