//! What a sweep yields as data for programs.

use serde::{Serialize, Serializer, ser::SerializeMap};

use super::{Gap, PartialOfSweep, SweepReport, SweepWarning};
use crate::{
    partial::Cost,
    report::serialized::{finite, list, serialized},
};

serialized!(SweepReport, own => {
    "measures": own.columns.iter().enumerate().map(|(at, _)| Filled(own, at)).collect::<Vec<_>>(),
    "points": own.points(),
    "instantiated": own.instantiated,
    "estimated": own.estimated,
    "checked": own.checked,
    "largest_difference": finite(own.largest_difference),
    "gaps": own.gaps.iter().map(|gap| Missing(own, gap)).collect::<Vec<_>>(),
    "warnings": own.warnings,
    "left_out": own.partial,
});

serialized!(SweepWarning, own => {
    "text": own.warning.to_string(),
    "code": own.warning.code(),
    "points": own.points,
});

serialized!(PartialOfSweep, own => {
    "bound": own.bound,
    "effects": list(&own.left_out, |own| &own.effect),
    "checked": own.checked,
    "measure": own.worst.as_ref().map(|worst| &worst.measure),
    "moves": own.worst.as_ref().map(Cost::most).and_then(finite),
    "solves": own.solves,
});

/// A column of a sweep, by its place.
struct Filled<'r>(&'r SweepReport, usize);

serialized!(Filled<'_>, own => {
    "key": own.0.columns[own.1].key,
    "over_thickness": own.0.columns[own.1].is_share,
    "unit": own.0.columns[own.1].unit,
    "values": own.0.column(own.1).map(finite).collect::<Vec<_>>(),
    "errors": own.0.errors_of(own.1).map(finite).collect::<Vec<_>>(),
});

/// A gap of a sweep.
struct Missing<'r>(&'r SweepReport, &'r Gap);

serialized!(Missing<'_>, own => {
    "point": own.1.point,
    "measure": own.1.column.map(|at| &own.0.columns[at].key),
    "reason": own.1.reason,
});
