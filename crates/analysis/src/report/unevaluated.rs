//! What a study could not evaluate: scenes at other values that do not exist, whose runs fail, or whose measures have
//! no value. A study claims an optimum, a verdict or a determined number over what was evaluated only.

use std::{
    cmp::Ordering,
    sync::{Mutex, PoisonError},
};

use serde::{Deserialize, Serialize};

use super::RunReport;
use crate::{Note, RunError, Warning};

/// What kind of cause it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum CauseKind {
    /// There is no scene with these values.
    Scene,
    /// Its run failed.
    Run,
    /// A measure has no value.
    NoValue,
    /// A measure may still grow where its run ends.
    Cut,
    /// Something is pressed beyond what is known of it, and its force is extrapolated.
    Beyond,
}

/// Why a scene at other values has no answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Cause {
    /// What kind of cause it is.
    pub kind: CauseKind,
    /// The measure or element that it is about; empty where it is about the whole scene.
    pub of: String,
    /// The message of the error, or of the notes of the measure.
    pub message: String,
}

/// The places of a study that could not be evaluated for one kind of cause.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Missing {
    /// The cause at the first place; at the others its numbers may differ.
    pub cause: Cause,
    /// How many places.
    pub count: usize,
    /// The number of the first place, from 0, in the order of the study …
    pub first: usize,
    /// … and the numbers of the study there, in its order and in SI units; empty where the number tells.
    pub values: Vec<f64>,
}

/// What a study could not evaluate.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Unevaluated {
    /// Places that the study looked at, those that could be evaluated included.
    pub of: usize,
    /// How many of them have no answer.
    pub count: usize,
    /// By kinds of causes, in the order of their first places.
    pub causes: Vec<Missing>,
}

impl Cause {
    /// There is no scene with these values, for what its reader says.
    pub fn scene(message: String) -> Self {
        Self { kind: CauseKind::Scene, of: String::new(), message }
    }

    /// The measure with this key has no value, in this run where there is one.
    pub fn no_value(key: &str, run: Option<&RunReport>) -> Self {
        let is_short = |run: &RunReport| {
            run.warnings.iter().any(|own| matches!(own, Warning::StillFalling { .. }))
        };
        if run.is_some_and(is_short) {
            return Self::cut(key);
        }
        let measure = run.and_then(|run| run.measure(key));
        let message =
            measure.map_or("it is not reported".to_owned(), |own| Note::joined(&own.notes));
        Self { kind: CauseKind::NoValue, of: key.to_owned(), message }
    }

    /// The measure with this key may still grow where its run ends.
    pub fn cut(key: &str) -> Self {
        let message = "the run ends before it is whole: make `duration` longer".to_owned();
        Self { kind: CauseKind::Cut, of: key.to_owned(), message }
    }

    /// What this element is pressed beyond.
    pub fn beyond(element: &str, message: String) -> Self {
        Self { kind: CauseKind::Beyond, of: element.to_owned(), message }
    }

    /// Whether both are of the same kind and about the same.
    pub fn is_like(&self, other: &Self) -> bool {
        self.kind == other.kind && self.of == other.of
    }
}

impl From<RunError> for Cause {
    fn from(error: RunError) -> Self {
        Self { kind: CauseKind::Run, of: String::new(), message: error.to_string() }
    }
}

impl Unevaluated {
    /// What became of so many places, of which these could not be evaluated, by their values.
    pub fn of<'c>(of: usize, all: impl IntoIterator<Item = (&'c Cause, &'c [f64])>) -> Self {
        let mut own = Self { of, ..Self::default() };
        for (at, (cause, values)) in all.into_iter().enumerate() {
            own.add(cause, at, values);
        }
        own
    }

    /// The same by their numbers.
    pub fn at<'c>(of: usize, all: impl IntoIterator<Item = (&'c Cause, usize)>) -> Self {
        let mut own = Self { of, ..Self::default() };
        all.into_iter().for_each(|(cause, at)| own.add(cause, at, &[]));
        own
    }

    fn add(&mut self, cause: &Cause, first: usize, values: &[f64]) {
        self.count += 1;
        if let Some(known) = self.causes.iter_mut().find(|known| known.cause.is_like(cause)) {
            known.count += 1;
        } else {
            let (cause, values) = (cause.clone(), values.to_vec());
            self.causes.push(Missing { cause, count: 1, first, values });
        }
    }

    /// Whether everything was evaluated.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }
}

/// What cannot be evaluated, as it is met by several threads.
#[derive(Debug, Default)]
pub struct Misses(Mutex<Vec<(Vec<f64>, Cause)>>);

impl Misses {
    /// Notes that there is no answer for these numbers of the study, in SI units.
    pub fn note(&self, values: Vec<f64>, cause: Cause) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push((values, cause));
    }

    /// All of them so far, in the order of their numbers, whichever thread met them first.
    pub fn all(&self) -> Vec<(Vec<f64>, Cause)> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner).clone();
        all.sort_by(|one, other| {
            let each = one.0.iter().zip(&other.0).map(|(one, other)| one.total_cmp(other));
            each.fold(Ordering::Equal, Ordering::then)
        });
        all
    }

    /// The same by their causes, among so many places that were looked at.
    pub fn told(&self, of: usize) -> Unevaluated {
        let all = self.all();
        Unevaluated::of(of, all.iter().map(|(values, cause)| (cause, &values[..])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_counted_by_the_kind_of_their_cause() {
        let thin = |at: f64| Cause::scene(format!("the pad is {at} m thick"));
        let (a, b, c) = (thin(0.1), thin(0.2), Cause::no_value("head.peak-acceleration", None));
        let own = Unevaluated::of(5, [(&a, &[0.1][..]), (&c, &[0.15]), (&b, &[0.2])]);
        assert_eq!((own.of, own.count, own.causes.len()), (5, 3, 2));
        assert_eq!((own.causes[0].count, &own.causes[0].values[..]), (2, &[0.1][..]));
        assert_eq!(own.causes[0].cause.message, "the pad is 0.1 m thick");
        assert!(!own.is_empty() && Unevaluated::of(5, []).is_empty());
    }
}
