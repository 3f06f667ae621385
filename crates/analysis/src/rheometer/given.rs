//! Parameters that protocols share, and how they are read.

use dashpot_network::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value};

use super::{FROM_THE_MODEL, report::Setting};

/// Force of a step where none is given \[N\].
pub(super) const USUAL_FORCE: f64 = 1e3;
/// Deformation of a step where none is given \[m\].
pub(super) const USUAL_DEFORMATION: f64 = 1e-3;
/// Number of instants or frequencies where none is given.
pub(super) const USUAL_POINTS: usize = 200;
/// Most instants or frequencies.
const MOST_POINTS: usize = 100_000;

pub(super) const FORCE: Parameter = Parameter::optional(
    "force",
    ParameterKind::Quantity(Dimension::FORCE),
    "1 kN",
    "height of the force step [N], positive in compression, not zero",
);
pub(super) const HOLD: Parameter = Parameter::optional(
    "hold",
    ParameterKind::Quantity(Dimension::TIME),
    FROM_THE_MODEL,
    "how long the force is held [s], positive; else 5 times the slowest retardation time",
);
pub(super) const END: Parameter = Parameter::optional(
    "end",
    ParameterKind::Quantity(Dimension::TIME),
    FROM_THE_MODEL,
    "end of the test [s]; else 10 times the slowest time of the model after the last change",
);
pub(super) const POINTS: Parameter = Parameter::optional(
    "points",
    ParameterKind::Quantity(Dimension::NUMBER),
    "200",
    "number of points, from 2 to 100000, logarithmic after each change",
);

/// The number at `at`, if there is one.
fn number(values: &[Option<Value>], at: usize) -> Option<f64> {
    values.get(at).and_then(Option::as_ref).and_then(Value::number)
}

/// A number that is positive and finite, if it is given.
pub(super) fn positive(
    values: &[Option<Value>],
    at: usize,
    name: &'static str,
) -> Result<Option<f64>, InvalidParameter> {
    let Some(value) = number(values, at) else { return Ok(None) };
    dashpot_network::parameters::positive(name, value).map(|()| Some(value))
}

/// A number ≥ 0 that is finite, if it is given.
pub(super) fn non_negative(
    values: &[Option<Value>],
    at: usize,
    name: &'static str,
) -> Result<Option<f64>, InvalidParameter> {
    let Some(value) = number(values, at) else { return Ok(None) };
    dashpot_network::parameters::non_negative(name, value).map(|()| Some(value))
}

/// A number that is finite and not zero, if it is given.
pub(super) fn amplitude(
    values: &[Option<Value>],
    at: usize,
    name: &'static str,
) -> Result<Option<f64>, InvalidParameter> {
    let Some(value) = number(values, at) else { return Ok(None) };
    if value.is_finite() && value != 0.0 {
        Ok(Some(value))
    } else {
        Err(InvalidParameter::new(name, "finite and not zero", value))
    }
}

/// The number of points.
pub(super) fn points(values: &[Option<Value>], at: usize) -> Result<usize, InvalidParameter> {
    let Some(value) = number(values, at) else { return Ok(USUAL_POINTS) };
    let fits = value.fract() == 0.0 && (2.0..=MOST_POINTS as f64).contains(&value);
    if !fits {
        return Err(InvalidParameter::new("points", "a whole number from 2 to 100000", value));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "2 to 100000")]
    let count = value as usize;
    Ok(count)
}

/// A parameter as it was used: `given`, or else `chosen`.
pub(super) fn setting(
    name: &'static str,
    unit: &'static str,
    given: Option<f64>,
    chosen: f64,
) -> Setting {
    Setting { name, unit, value: given.unwrap_or(chosen), is_chosen: given.is_none() }
}

/// The number of points as it was used.
pub(super) fn points_used(points: usize) -> Setting {
    Setting { name: "points", unit: "1", value: points as f64, is_chosen: false }
}

/// The end of a test, which must lie beyond `after` \[s\].
pub(super) fn check_end(end: f64, after: f64) -> Result<(), InvalidParameter> {
    if end.is_finite() && end > after {
        return Ok(());
    }
    let range = format!("finite and after the last change, at {after} s");
    Err(InvalidParameter::new("end", range, end))
}
