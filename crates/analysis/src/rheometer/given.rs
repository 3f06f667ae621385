//! Parameters that protocols share, and how they are read.

use dashpot_network::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Range};

use super::{FROM_THE_MODEL, report::Setting};

/// Force of a step where none is given \[N\].
pub(super) const USUAL_FORCE: f64 = 1e3;
/// Deformation of a step where none is given \[m\].
pub(super) const USUAL_DEFORMATION: f64 = 1e-3;
/// Number of instants or frequencies where none is given.
pub(super) const USUAL_POINTS: usize = 200;

pub(super) const FORCE: Parameter = Parameter::new(
    "force",
    ParameterKind::Quantity(Dimension::FORCE),
    "height of the force step [N], positive in compression, not zero",
)
.default("1 kN")
.range(Range::NotZero);
pub(super) const HOLD: Parameter = Parameter::new(
    "hold",
    ParameterKind::Quantity(Dimension::TIME),
    "how long the force is held [s], positive; else 5 times the slowest retardation time",
)
.default(FROM_THE_MODEL)
.range(Range::Positive);
pub(super) const END: Parameter = Parameter::new(
    "end",
    ParameterKind::Quantity(Dimension::TIME),
    "end of the test [s]; else 10 times the slowest time of the model after the last change",
)
.default(FROM_THE_MODEL)
.range(Range::Positive);
pub(super) const POINTS: Parameter = Parameter::new(
    "points",
    ParameterKind::Quantity(Dimension::NUMBER),
    "number of points, from 2 to 100000, logarithmic after each change",
)
.default("200")
.range(Range::Count);

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
