//! Derivatives as data.

use serde::Serialize;
use thiserror::Error;

use crate::{Cause, CauseKind, Event, EventReport, RunReport, Unevaluated};

/// A number of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Number {
    /// Its name, for instance `K`.
    pub name: String,
    /// Its SI unit; `1` of a pure number.
    pub unit: String,
    /// Its value in that unit.
    pub value: f64,
}

impl Number {
    /// The number of this name, SI unit and value.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), unit: unit.into(), value }
    }
}

/// The derivative of a measure with respect to a number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Derivative {
    /// The derivative, in SI units.
    pub value: f64,
    /// How far it may be off.
    pub error: f64,
    /// By how many percent the measure rises where the number rises by one; `None` of a measure that is zero.
    pub elasticity: Option<f64>,
    /// The error of the change with the number, in parts of that or of the measure, whichever is larger.
    pub relative_error: f64,
}

/// Why there is no derivative.
#[derive(Debug, Clone, PartialEq, Error, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum NoDerivative {
    /// Steps are parts of the number.
    #[error("the number is 0, and steps are parts of it: give it a size")]
    NumberIsZero,
    /// The measure has no value.
    #[error("the measure has no value: {reason}")]
    NoValue {
        /// Why.
        reason: String,
    },
    /// It has none beside the number, or there is no such scene.
    #[error("beside this value there is none: {reason}")]
    NoNeighbour {
        /// Why.
        reason: String,
    },
    /// Something just touches, or two events coincide.
    #[error(
        "beside this value other events happen, or in another order: the measure has a jump or a kink here"
    )]
    EventsChange,
    /// A kink, as where two maxima are equal.
    #[error(
        "the measure has a kink here: its slope is {below:.4e} below this value, {above:.4e} above"
    )]
    TwoSlopes {
        /// The derivative for smaller numbers, in SI units.
        below: f64,
        /// That for larger ones.
        above: f64,
    },
    /// Differences do not settle as steps become smaller.
    #[error(
        "differences do not settle as steps become smaller: their error is {:.0e} of the measure",
        .relative_error
    )]
    Unsettled {
        /// The error in parts of the measure, or of its change with the number.
        relative_error: f64,
    },
}

/// The derivatives of one measure, or of the time of an event.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureGradient {
    /// Key of the measure; of an event its number and what happens.
    pub key: String,
    /// Its SI unit.
    pub unit: &'static str,
    /// Its value; `None` where there is none.
    pub value: Option<f64>,
    /// How far that may be off.
    pub error: Option<f64>,
    /// The derivative with respect to each number, in their order.
    pub derivatives: Vec<Result<Derivative, NoDerivative>>,
}

/// What the measures of a scene change with.
#[derive(Debug, Clone, PartialEq)]
pub struct GradientReport {
    /// The numbers.
    pub numbers: Vec<Number>,
    /// The measures.
    pub measures: Vec<MeasureGradient>,
    /// The times of the events \[s\], in their order.
    pub events: Vec<MeasureGradient>,
    /// The method.
    pub method: &'static str,
    /// How many solutions it took in all.
    pub solutions: usize,
}

impl GradientReport {
    /// The derivatives that have no value as a run, or one beside it, has none; each by its number in the report.
    pub fn unevaluated(&self) -> Unevaluated {
        let rows = self.measures.iter().chain(&self.events);
        let all = rows.flat_map(|row| row.derivatives.iter().map(|own| (&row.key, own)));
        let causes: Vec<(Cause, usize)> = all
            .enumerate()
            .filter_map(|(at, (key, own))| {
                let (NoDerivative::NoValue { reason } | NoDerivative::NoNeighbour { reason }) =
                    own.as_ref().err()?
                else {
                    return None;
                };
                let (kind, of) = (CauseKind::NoValue, key.clone());
                Some((Cause { kind, of, message: reason.clone() }, at))
            })
            .collect();
        let count = self.numbers.len() * (self.measures.len() + self.events.len());
        Unevaluated::at(count, causes.iter().map(|own| (&own.0, own.1)))
    }

    pub(super) fn made(
        run: &RunReport,
        (keys, numbers): (&[String], &[Number]),
        found: &[Vec<Result<Derivative, NoDerivative>>],
        solutions: usize,
    ) -> Self {
        let of = |at: usize| found.iter().map(|own| own[at].clone()).collect();
        let measure = |(at, key): (usize, &String)| {
            let own = run.measure(key);
            MeasureGradient {
                key: key.clone(),
                unit: own.map_or("1", |own| own.unit),
                value: own.and_then(|own| own.value),
                error: own.and_then(|own| own.error),
                derivatives: of(at),
            }
        };
        let event = |(at, own): (usize, &EventReport)| MeasureGradient {
            key: format!("{}: {}", at + 1, happening(&own.what)),
            unit: "s",
            value: Some(own.time),
            error: own.error,
            // At the tighter tolerance of the neighbours an event may be missing.
            derivatives: found
                .iter()
                .map(|own| own.get(at + keys.len()).cloned())
                .map(|own| own.unwrap_or(Err(NoDerivative::EventsChange)))
                .collect(),
        };
        Self {
            numbers: numbers.to_vec(),
            measures: keys.iter().enumerate().map(measure).collect(),
            events: run.events.iter().enumerate().map(event).collect(),
            method: run.solver.method,
            solutions,
        }
    }

    /// The derivative of the measure with this key with respect to the number of this name; `None` where there is no
    /// such measure or number.
    pub fn derivative(&self, key: &str, number: &str) -> Option<&Result<Derivative, NoDerivative>> {
        let at = self.numbers.iter().position(|own| own.name == number)?;
        self.measures.iter().chain(&self.events).find(|own| own.key == key)?.derivatives.get(at)
    }
}

/// What happens, without the impulse, which changes with the numbers.
fn happening(what: &Event) -> String {
    match what {
        Event::Meets { sides, again, .. } => {
            Event::Meets { sides: sides.clone(), again: *again, collision: None }.to_string()
        }
        Event::Closes { contact, again, .. } => {
            Event::Closes { contact: contact.clone(), again: *again, collision: None }.to_string()
        }
        Event::Impact { contact, .. } => format!("{contact}: impact"),
        Event::PassesOn { contact, .. } => format!("{contact} passes on an impulse"),
        other => other.to_string(),
    }
}

/// The unit of a derivative: that of the measure over that of the number.
pub fn unit_of(measure: &str, number: &str) -> String {
    let is_pure = |unit: &str| unit.is_empty() || unit == "1";
    let over = if number.contains(['/', ' ']) { format!("({number})") } else { number.to_owned() };
    match (is_pure(measure), is_pure(number)) {
        (true, true) => "1".to_owned(),
        (false, true) => measure.to_owned(),
        (true, false) => format!("1/{over}"),
        (false, false) => format!("{measure}/{over}"),
    }
}
