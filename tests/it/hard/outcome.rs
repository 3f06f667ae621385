//! What became of a case.

use dashpot::{analysis::RunError, dae::SolveError};

use super::trial::Check;

/// What became of a case by one method.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outcome {
    /// Every claim holds, to the accuracy wanted.
    Right(Errors),
    /// Every claim holds within its error, and the report says that more was wanted.
    Rough(Errors),
    /// A claim does not hold, and the report says that the accuracy is not reached.
    Warned(Errors, String),
    /// A claim does not hold, and nothing says so.
    Wrong(Errors, String),
    /// The method says that it cannot.
    Declined(String),
    /// The method says that it failed.
    Failed(String),
    /// The network or the scene is turned down.
    Refused(String),
    /// More steps than the case may take.
    Long(usize),
    /// The program panicked.
    Panic(String),
    /// Nothing came back.
    Hang,
}

/// The worst errors of all claims, relative to their scales.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Errors {
    /// The largest true error, beyond what the judge leaves open.
    pub(super) truth: f64,
    /// The most that the judge leaves open.
    pub(super) open: f64,
    /// The largest error that was stated.
    pub(super) stated: f64,
}

impl Outcome {
    /// The outcome of a run that has a report.
    pub(super) fn of_checks(checks: &[Check]) -> Self {
        let relative = |error: f64, scale: f64| if error > 0.0 { error / scale } else { 0.0 };
        let largest = |errors: &mut dyn Iterator<Item = f64>| errors.fold(0.0, f64::max);
        let truth = largest(&mut checks.iter().map(|check| relative(check.error, check.scale)));
        let stated = largest(
            &mut checks.iter().map(|check| relative(check.bar.unwrap_or(0.0), check.scale)),
        );
        let open = largest(&mut checks.iter().map(|check| relative(check.open, check.scale)));
        let errors = Errors { truth, open, stated };
        let is_off = |check: &&Check| check.error.is_nan() || check.error > check.allowed;
        let silent = checks.iter().filter(|check| !check.is_warned).find(is_off);
        if let Some(check) = silent {
            return Self::Wrong(errors, check.what.clone());
        }
        if let Some(check) = checks.iter().find(is_off) {
            return Self::Warned(errors, check.what.clone());
        }
        if checks.iter().any(|check| check.is_warned) {
            Self::Rough(errors)
        } else {
            Self::Right(errors)
        }
    }

    /// The outcome of a run without a report, which took `steps` in all.
    pub(super) fn of_error(error: &RunError, most_steps: usize) -> Self {
        let first = |text: String| text.lines().next().unwrap_or_default().to_owned();
        match error {
            RunError::Solve(SolveError::Cancelled { .. }) => Self::Long(most_steps),
            RunError::Solve(SolveError::NotApplicable { reason, .. }) => {
                Self::Declined(reason.clone())
            }
            RunError::Network(errors) => Self::Refused(first(errors.to_string())),
            other => Self::Failed(first(other.to_string())),
        }
    }

    /// As it stands in the table: words, and powers of ten that its errors stay below.
    pub(super) fn cell(&self) -> String {
        match self {
            Self::Right(errors) => format!("right {}", errors.cell()),
            Self::Rough(errors) => format!("rough {}", errors.cell()),
            Self::Warned(errors, _) => format!("warned {}", errors.cell()),
            Self::Wrong(errors, _) => format!("**wrong and silent** {}", errors.cell()),
            Self::Declined(_) => "declines".to_owned(),
            Self::Failed(_) => "fails".to_owned(),
            Self::Refused(_) => "**refused**".to_owned(),
            Self::Long(_) => "long".to_owned(),
            Self::Panic(_) => "**panic**".to_owned(),
            Self::Hang => "**hang**".to_owned(),
        }
    }

    /// What the method or the program says, where it gives no numbers.
    pub(super) fn words(&self) -> Option<&str> {
        match self {
            Self::Declined(words) | Self::Failed(words) => Some(words),
            _ => None,
        }
    }

    /// Why the outcome is none that a case with an answer may have.
    pub(super) fn defect(&self) -> Option<String> {
        match self {
            Self::Wrong(_, what) => Some(format!("wrong and silent: {what}")),
            Self::Refused(words) => Some(format!("refused: {words}")),
            Self::Panic(words) => Some(format!("panic: {words}")),
            Self::Hang => Some("hang".to_owned()),
            _ => None,
        }
    }

    pub(super) fn is_right(&self) -> bool {
        matches!(self, Self::Right(_))
    }
}

impl Errors {
    fn cell(self) -> String {
        // What the judge cannot tell from right is no smaller than it can tell.
        let truth = if self.truth < self.open {
            format!("≤{}", power_above(self.open))
        } else {
            power_above(self.truth)
        };
        format!("{truth} ({})", power_above(self.stated))
    }
}

/// The next power of ten above three times an error; what is below a rounding is one.
fn power_above(error: f64) -> String {
    if !error.is_finite() {
        return "inf".to_owned();
    }
    let exponent = (3.0 * error).max(1e-16).log10().ceil();
    // What is not small reads better as a plain number.
    if (0.0..=3.0).contains(&exponent) {
        format!("{:.0}", 10_f64.powf(exponent))
    } else {
        format!("1e{exponent:.0}")
    }
}

#[test]
fn powers_read_as_numbers_where_they_are_not_small() {
    let texts = [0.0, 1e-9, 0.2, 0.9, 30.0, 1e5, f64::INFINITY].map(power_above);
    assert_eq!(texts, ["1e-16", "1e-8", "1", "10", "100", "1e6", "inf"]);
}
