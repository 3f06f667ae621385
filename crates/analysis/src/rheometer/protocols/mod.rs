//! The tests, and what they have in common.

mod load_unload;
mod sweep;
mod under_deformation;
mod under_force;

use dashpot_network::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Range};

pub use self::{
    load_unload::LoadUnload,
    sweep::Sweep,
    under_deformation::{ConstantRate, Relaxation},
    under_force::{Creep, CreepRecovery, LoadHoldUnload},
};
use super::{FROM_THE_MODEL, Note, RheometerError, Setting, Specimen};

/// Force of a step where none is given \[N\].
const USUAL_FORCE: f64 = 1e3;
/// Deformation of a step where none is given \[m\].
const USUAL_DEFORMATION: f64 = 1e-3;
/// Number of instants or frequencies where none is given.
const USUAL_POINTS: usize = 200;

const FORCE: Parameter = Parameter::new(
    "force",
    ParameterKind::Quantity(Dimension::FORCE),
    "height of the force step [N], positive in compression, not zero",
)
.default("1 kN")
.range(Range::NotZero);
const HOLD: Parameter = Parameter::new(
    "hold",
    ParameterKind::Quantity(Dimension::TIME),
    "how long the force is held [s], positive; else 5 times the slowest retardation time",
)
.default(FROM_THE_MODEL)
.range(Range::Positive);
const END: Parameter = Parameter::new(
    "end",
    ParameterKind::Quantity(Dimension::TIME),
    "end of the test [s]; else 10 times the slowest time of the model after the last change",
)
.default(FROM_THE_MODEL)
.range(Range::Positive);
const POINTS: Parameter = Parameter::new(
    "points",
    ParameterKind::Quantity(Dimension::NUMBER),
    "number of points, from 2 to 100000, logarithmic after each change",
)
.default("200")
.range(Range::Count);

/// A parameter as it was used: `given`, or else `chosen`.
fn setting(name: &'static str, unit: &'static str, given: Option<f64>, chosen: f64) -> Setting {
    Setting { name, unit, value: given.unwrap_or(chosen), is_chosen: given.is_none() }
}

/// The number of points as it was used.
fn points_used(points: usize) -> Setting {
    Setting { name: "points", unit: "1", value: points as f64, is_chosen: false }
}

/// The end of a test, which must lie beyond the last change, at `last` \[s\].
fn end_of_test(
    given: Option<f64>,
    last: f64,
    specimen: &Specimen,
) -> Result<Setting, InvalidParameter> {
    let end = setting("end", "s", given, last + LONG * specimen.range_of_times().1);
    if end.value.is_finite() && end.value > last {
        return Ok(end);
    }
    let range = format!("finite and after the last change, at {last} s");
    Err(InvalidParameter::new("end", range, end.value))
}

/// How many times the slowest time a test goes on after the last change.
const LONG: f64 = 10.0;
/// How many times the slowest retardation time a force is held.
const HELD: f64 = 5.0;

/// Refuses to put a force on what bears none.
fn bears_force(protocol: &'static str, specimen: &Specimen) -> Result<(), RheometerError> {
    if specimen.linear().is_none_or(|linear| linear.kelvin().is_some()) {
        return Ok(());
    }
    let reason = "the model bears no force, so it would give way without end under any";
    Err(RheometerError::Impossible { protocol, reason })
}

/// Refuses to deform what is rigid.
fn deforms(protocol: &'static str, specimen: &Specimen) -> Result<(), RheometerError> {
    if specimen.linear().is_none_or(|linear| linear.maxwell().is_some()) {
        return Ok(());
    }
    let reason = "a rigid link does not deform, whatever the force";
    Err(RheometerError::Impossible { protocol, reason })
}

/// What is special about the model under a force step.
fn notes_under_force(specimen: &Specimen) -> Vec<Note> {
    let Some(form) = specimen.kelvin() else { return Vec::new() };
    if specimen.maxwell().is_none() {
        return vec![Note::NothingDeforms];
    }
    let mut notes = Vec::new();
    if form.spring_compliance() == 0.0 {
        notes.push(Note::NoInstantaneousDeformation);
    }
    if form.fluidity() > 0.0 {
        notes.push(Note::Flows);
    }
    notes
}
