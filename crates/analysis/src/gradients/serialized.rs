//! Derivatives as data for programs.

use serde::{Serialize, Serializer, ser::SerializeMap};

use super::{Derivative, GradientReport, MeasureGradient, NoDerivative, unit_of};
use crate::report::serialized::serialized;

serialized!(GradientReport, own => {
    "method" => own.method,
    "solutions" => own.solutions,
    "unevaluated" => own.unevaluated(),
    "numbers" => own.numbers,
    "measures" => own.measures.iter().map(|one| Row(own, one)).collect::<Vec<_>>(),
    "events" => own.events.iter().map(|one| Row(own, one)).collect::<Vec<_>>(),
});

/// What one measure changes with.
struct Row<'r>(&'r GradientReport, &'r MeasureGradient);

serialized!(Row<'_>, own => {
    "key" => own.1.key,
    "unit" => own.1.unit,
    "value" => own.1.value,
    "error" => own.1.error,
    "derivatives" => own.0.numbers.iter().zip(&own.1.derivatives).map(|(number, found)| {
        Cell(unit_of(own.1.unit, &number.unit), found)
    }).collect::<Vec<_>>(),
});

/// A derivative and its unit.
struct Cell<'r>(String, &'r Result<Derivative, NoDerivative>);

serialized!(Cell<'_>, own => {
    "unit" => own.0,
    "value" => own.1.as_ref().ok().map(|one| one.value),
    "error" => own.1.as_ref().ok().map(|one| one.error),
    "elasticity" => own.1.as_ref().ok().and_then(|one| one.elasticity),
    "refused" => own.1.as_ref().err(),
    "reason" => own.1.as_ref().err().map(ToString::to_string),
});
