//! What a sweep yields as data for programs.

use serde::{Serialize, Serializer, ser::SerializeMap};

use super::{Gap, PartialOfSweep, SweepReport, SweepWarning};
use crate::{
    Judgement, Limit, Reason,
    partial::Cost,
    report::serialized::{finite, list, serialized},
};

serialized!(SweepReport, own => {
    "measures" => own.columns.iter().enumerate().map(|(at, _)| Filled(own, at)).collect::<Vec<_>>(),
    "points" => own.points(),
    "unevaluated" => own.unevaluated(),
    "instantiated" => own.instantiated,
    "estimated" => own.estimated,
    "checked" => own.checked,
    "largest_difference" => finite(own.largest_difference),
    "gaps" => own.gaps.iter().map(|gap| Missing(own, gap)).collect::<Vec<_>>(),
    "limits" => (0..own.limits.len()).map(|at| OfGrid(own, at)).collect::<Vec<_>>(),
    "warnings" => own.warnings,
    "left_out" => own.partial,
});

serialized!(SweepWarning, own => {
    "text" => own.warning.to_string(),
    "code" => own.warning.code(),
    "points" => own.points,
});

serialized!(PartialOfSweep, own => {
    "bound" => own.bound,
    "effects" => list(&own.left_out, |own| &own.effect),
    "checked" => own.checked,
    "measure" => own.worst.as_ref().map(|worst| &worst.measure),
    "moves" => own.worst.as_ref().map(Cost::most).and_then(finite),
    "solves" => own.solves,
});

/// A column of a sweep, by its place.
struct Filled<'r>(&'r SweepReport, usize);

serialized!(Filled<'_>, own => {
    "key" => own.0.columns[own.1].key,
    "over_thickness" => own.0.columns[own.1].is_share,
    "unit" => own.0.columns[own.1].unit,
    "values" => own.0.column(own.1).map(finite).collect::<Vec<_>>(),
    "errors" => own.0.errors_of(own.1).map(finite).collect::<Vec<_>>(),
});

/// A limit and what is known of it at all points, by its place.
struct OfGrid<'r>(&'r SweepReport, usize);

impl OfGrid<'_> {
    fn limit(&self) -> &Limit {
        &self.0.limits[self.1].1
    }
}

serialized!(OfGrid<'_>, own => {
    "key" => own.limit().key,
    own.limit().bound.word() => own.limit().bound.level(),
    "from" => own.limit().from,
    "of_mean" => own.limit().of_mean,
    "unit" => own.0.columns[own.0.limits[own.1].0].unit,
    "verdicts" => list(&own.0.judged(own.1), |own| own.map(Judgement::word)),
    "reasons" => list(&own.0.judged(own.1), |own| own.and_then(Judgement::reason).map(Reason::word)),
    "margins" => {
        let values = own.0.column(own.0.limits[own.1].0);
        values.map(|value| own.limit().bound.margin(value).and_then(finite)).collect::<Vec<_>>()
    },
});

struct Missing<'r>(&'r SweepReport, &'r Gap);

serialized!(Missing<'_>, own => {
    "point" => own.1.point,
    "measure" => own.1.column.map(|at| &own.0.columns[at].key),
    "kind" => own.1.cause.kind,
    "reason" => own.1.cause.message,
});
