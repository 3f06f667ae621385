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
    #[error("the step of `{method}` became too small at {time:.3e} s (worst unknown: `{unknown}`)")]
    StepTooSmall {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The unknown that changes fastest.
        unknown: String,
    },
    /// The Newton iteration failed too often.
    #[error("the equations of a step of `{method}` could not be solved at {time:.3e} s")]
    NewtonFailed {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
    },
    /// The balances of the algebraic unknowns were not solved.
    #[error("the balances at {time:.3e} s were not solved: no value of `{unknown}` was found")]
    Inconsistent {
        /// Time reached \[s\].
        time: f64,
        /// The unknown whose balance is farthest from being satisfied.
        unknown: String,
    },
    /// The result contains a number that is not finite.
    #[error("`{method}` lost `{unknown}` at {time:.3e} s: its value is not finite")]
    NotFinite {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The first unknown that is not finite.
        unknown: String,
    },
    /// More steps than the limit were needed.
    #[error("`{method}` took {steps} steps and reached only {time:.3e} s")]
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
        "the budget of work is spent: `{method}` has reached {time:.3e} s after {work:.1e} units"
    )]
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
        "the solution of `{method}` takes {} MB after {steps} steps, at {time:.3e} s: it is too large \
         to be kept as a whole",
        bytes / 1_000_000
    )]
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
    #[error("at {time:.6e} s: {reason}")]
    Switching {
        /// Time reached \[s\].
        time: f64,
        /// Which parts, and why.
        reason: String,
    },
    /// More intervals than the limit were needed.
    #[error(
        "{parts} had switched {intervals} times by {time:.6e} s: the run takes more than are followed"
    )]
    TooManySwitches {
        /// Time reached \[s\].
        time: f64,
        /// The limit.
        intervals: usize,
        /// What switched last.
        parts: String,
    },
    /// An observer ended the run.
    #[error("the run was cancelled at {time:.3e} s")]
    Cancelled {
        /// Time reached \[s\].
        time: f64,
    },
    /// The integrator gave up for another reason, which it states.
    #[error("`{method}` failed at {time:.3e} s: {reason}")]
    Integrator {
        /// The method's name.
        method: &'static str,
        /// Time reached \[s\].
        time: f64,
        /// The integrator's own words.
        reason: String,
    },
}
