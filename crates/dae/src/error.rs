//! What can go wrong while a system is solved.

use thiserror::Error;

/// Why a method did not deliver a trajectory.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The method cannot solve systems of this structure.
    #[error("`{method}` cannot solve this: {reason}")]
    NotApplicable {
        /// The method's name.
        method: &'static str,
        /// Why, and what can.
        reason: String,
    },
    /// A setting is out of its range.
    #[error("`{setting}` must be {range}, but it is {value}")]
    InvalidSetting {
        /// Name of the setting.
        setting: &'static str,
        /// Its range in words.
        range: &'static str,
        /// What was given.
        value: f64,
    },
    /// The step became too small to go on.
    #[error("the step of `{method}` became too small at {at} s (worst unknown: `{unknown}`)", at = seconds(*.time))]
    StepTooSmall {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The unknown that changes fastest.
        unknown: String,
    },
    /// The Newton iteration failed too often.
    #[error("the equations of a step of `{method}` could not be solved at {at} s", at = seconds(*.time))]
    NewtonFailed {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
    },
    /// The balances of the algebraic unknowns were not solved.
    #[error("the balances at {at} s were not solved: no value of `{unknown}` was found", at = seconds(*.time))]
    Inconsistent {
        /// Time reached \[s\].
        time: f64,
        /// The unknown whose balance is farthest from being satisfied.
        unknown: String,
    },
    /// The result contains a number that is not finite.
    #[error("`{method}` lost `{unknown}` at {at} s: its value is not finite", at = seconds(*.time))]
    NotFinite {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The first unknown that is not finite.
        unknown: String,
    },
    /// More steps than the limit were needed.
    #[error("`{method}` took {steps} steps and reached only {at} s", at = seconds(*.time))]
    TooManySteps {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The limit.
        steps: usize,
    },
    /// The run was more work than it may be.
    #[error(
        "the budget of work is spent: `{method}` has reached {at} s after {work:.1e} units", at = seconds(*.time))]
    BudgetSpent {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// Units of work done; see [`Budget`](crate::Budget).
        work: u64,
    },
    /// The solution takes more memory than a run may.
    #[error(
        "the solution of `{method}` takes {} MB after {steps} steps, at {at} s: it is too large \
         to be kept as a whole",
        bytes / 1_000_000, at = seconds(*.time))]
    TooLarge {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// Steps taken.
        steps: usize,
        /// Memory taken \[B\].
        bytes: usize,
    },
    /// The equations that follow a switching are not known.
    #[error("at {at} s: {reason}", at = seconds(*.time))]
    Switching {
        /// Time reached \[s\].
        time: f64,
        /// Which parts, and why.
        reason: String,
    },
    /// More intervals than the limit were needed.
    #[error(
        "{parts} had switched {intervals} times by {at} s: the run takes more than are followed", at = seconds(*.time))]
    TooManySwitches {
        /// Time reached \[s\].
        time: f64,
        /// The limit.
        intervals: usize,
        /// What switched last.
        parts: String,
    },
    /// An observer ended the run.
    #[error("the run was cancelled at {at} s", at = seconds(*.time))]
    Cancelled {
        /// Time reached \[s\].
        time: f64,
    },
    /// The integrator gave up for another reason, which it states.
    #[error("`{method}` failed at {at} s: {reason}", at = seconds(*.time))]
    Integrator {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The integrator's own words.
        reason: String,
    },
}

impl SolveError {
    /// The same with a time that is counted from so much earlier \[s\].
    pub(crate) fn later(mut self, by: f64) -> Self {
        match &mut self {
            Self::StepTooSmall { time, .. }
            | Self::NewtonFailed { time, .. }
            | Self::Inconsistent { time, .. }
            | Self::NotFinite { time, .. }
            | Self::TooManySteps { time, .. }
            | Self::BudgetSpent { time, .. }
            | Self::TooLarge { time, .. }
            | Self::Cancelled { time, .. }
            | Self::Integrator { time, .. } => *time += by,
            _ => {}
        }
        self
    }
}

/// A time in seconds to four digits: only what is very small or large by a power of ten.
pub(crate) fn seconds(time: f64) -> String {
    let rounded = format!("{time:.3e}").parse().unwrap_or(time);
    let is_handy = rounded == 0.0 || (1e-4..1e6).contains(&rounded.abs());
    if is_handy { rounded.to_string() } else { format!("{rounded:e}") }
}
