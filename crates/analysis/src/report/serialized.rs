//! Reports as data for programs: `serde`, in SI units. A number that is not finite is none. What a run
//! took by the clock is left out, so that the same run gives the same text.

use dashpot_network::{Model, parameters::Value};
use dashpot_rheology::Tree;
use serde::{Serialize, Serializer, ser::SerializeMap};

use super::partial::{Neglected, Partial, PutBack, Why};
use crate::{
    Chance, Judged, Ledger, MeasureReport, Note, Odds, Reason, RunReport, ScatterReport,
    SolverReport, Warning,
};

/// States what a type is serialised as: a map of these keys, in this order.
macro_rules! serialized {
    ($type:ty, $own:ident => { $($key:expr => $value:expr),* $(,)? }) => {
        impl Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let $own = self;
                let mut map = serializer.serialize_map(None)?;
                $(map.serialize_entry($key, &$value)?;)*
                map.end()
            }
        }
    };
}
pub(crate) use serialized;

impl Serialize for RunReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("solver", &self.solver)?;
        map.serialize_entry("system", &self.system)?;
        let measures = self.told().map(|own| (&own.key, own));
        map.serialize_entry("measures", &Pairs(measures.collect()))?;
        map.serialize_entry("limits", &self.judged())?;
        if let Some(scatter) = &self.scatter {
            map.serialize_entry("scatter", scatter)?;
        }
        let after_impact = self.energy_after_impact.as_ref();
        map.serialize_entry("energy", &Energy { at_end: &self.energy, after_impact })?;
        map.serialize_entry("events", &self.events)?;
        map.serialize_entry("partial", &self.partial)?;
        map.serialize_entry("segmentation", &self.segmentation)?;
        map.serialize_entry("warnings", &list(&self.warnings, Warning::to_string))?;
        map.serialize_entry("warning_codes", &list(&self.warnings, Warning::code))?;
        map.end()
    }
}

serialized!(ScatterReport, own => {
    "designs" => own.designs,
    "wanted" => own.wanted,
    "seed" => own.seed,
    "sources" => own.sources,
    "measures" => Pairs(own.bands.iter().map(|own| (&own.key, own)).collect()),
    "limits" => own.limits,
    "all_limits" => own.all_limits,
    "instantiated" => own.instantiated,
    "unevaluated" => own.unevaluated,
    "unsolved" => own.unsolved().map(|own| own.count).sum::<usize>(),
    "why" => own.unsolved().next().map(|own| &own.cause.message),
});

serialized!(Chance, own => {
    "key" => own.limit.key,
    own.limit.bound.word() => own.limit.bound.level(),
    "of_mean" => own.limit.of_mean,
    "kept" => own.odds.kept,
    "beyond_known" => own.beyond,
    "harder_outside" => own.outside,
    "exceeded" => own.odds.exceeded,
    "probability" => own.odds.share(),
    "range" => own.odds.range(),
});

serialized!(Odds, own => {
    "kept" => own.kept,
    "exceeded" => own.exceeded,
    "not_known" => own.not_known(),
    "probability" => own.share(),
    "range" => own.range(),
});

serialized!(Judged<'_>, own => {
    "key" => own.limit.key,
    own.limit.bound.word() => own.limit.bound.level(),
    "from" => own.limit.from,
    "of_mean" => own.limit.of_mean,
    "unit" => own.measure.map(|own| own.unit),
    "value" => own.value(),
    "error" => own.error().and_then(finite),
    "verdict" => own.judgement.word(),
    "reason" => own.judgement.reason().map(Reason::word),
    "margin" => own.margin(),
});

serialized!(SolverReport, own => {
    "method" => own.method,
    "why" => own.why,
    "rtol" => own.rtol,
    "accepted" => own.statistics.accepted,
    "rejected" => own.statistics.rejected,
    "rhs_calls" => own.statistics.rhs_calls,
    "jacobian_calls" => own.statistics.jacobian_calls,
    "factorizations" => own.statistics.factorizations,
    "linear_solves" => own.statistics.linear_solves,
    "work" => own.work,
    "solves_for_error" => own.solves_for_error,
});

serialized!(Partial, own => {
    "below" => own.bound,
    "left_out" => own.left_out,
    "put_back" => own.put_back,
    "worst" => own.worst(),
    "moved" => Pairs(own.costs.iter().map(|own| (&own.measure, finite(own.relative))).collect()),
    "unreported" => own.unreported,
    "further_runs" => own.verification.solves,
});

serialized!(Neglected, own => {
    "effect" => own.effect,
    "formula" => own.influence.formula,
    "estimate" => own.influence.value,
    "alone" => own.alone,
});

serialized!(PutBack, own => {
    "effect" => own.effect,
    "formula" => own.influence.formula,
    "estimate" => own.influence.value,
    "moves" => if let Why::Moves(cost) = &own.why { Some(cost) } else { None },
    "error" => own.why.error(),
});

serialized!(Ledger, own => {
    "time" => own.time,
    "start" => own.start,
    "work-in" => own.total_work_in(),
    "drives" => pairs(&own.work_in),
    "kinetic" => own.kinetic,
    "kinetic-in-layers" => pairs(&own.in_layers),
    "stored" => pairs(&own.stored),
    "dissipated" => pairs(&own.dissipated),
    "closure" => finite(own.closure()),
});

/// The balance at the end of the run, and that at the end of the impact, where it ends within.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Energy<'r> {
    #[serde(flatten)]
    at_end: &'r Ledger,
    after_impact: Option<&'r Ledger>,
}

impl Serialize for MeasureReport {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("value", &self.value)?;
        map.serialize_entry("unit", self.unit)?;
        map.serialize_entry("time", &self.time)?;
        map.serialize_entry("window", &self.window.map(|(from, to)| [from, to]))?;
        map.serialize_entry("error", &self.error.and_then(finite))?;
        if let Some(note) = self.note() {
            map.serialize_entry("note", &note)?;
            map.serialize_entry("note_codes", &list(&self.notes, Note::code))?;
        }
        // The times of the window stand above, as they were resolved.
        for (name, value) in self.parameters.iter().filter(|own| Given(&own.1).is_said()) {
            map.serialize_entry(name, &Given(value))?;
        }
        map.end()
    }
}

/// The value of a parameter.
struct Given<'v>(&'v Value);

impl Given<'_> {
    fn is_said(&self) -> bool {
        !matches!(self.0, Value::Window(_) | Value::LeftOut)
    }
}

impl Serialize for Given<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            Value::Number(number) => number.serialize(serializer),
            Value::Word(word) => word.serialize(serializer),
            Value::Formula(formula) => serializer.collect_str(formula),
            Value::Flag => true.serialize(serializer),
            Value::Table(points) => points.serialize(serializer),
            Value::Model(model) => model.model().map(Branches).serialize(serializer),
            Value::Window(_) | Value::LeftOut => serializer.serialize_none(),
        }
    }
}

/// A model as a scene writes it, in SI units: `{"series": [{"spring": 2e7}, {"dashpot": 6e3}]}`.
struct Branches<'m>(&'m Model);

impl Serialize for Branches<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(1))?;
        match self.0 {
            Tree::Part(element) => {
                let (names, values) = (element.parameters().iter(), element.values());
                let given = names.zip(&values).filter(|own| Given(own.1).is_said());
                let given: Vec<_> = given.map(|(own, value)| (own.name, Given(value))).collect();
                match &given[..] {
                    [(_, only)] => map.serialize_entry(element.kind(), only)?,
                    _ => map.serialize_entry(element.kind(), &Pairs(given))?,
                }
            }
            Tree::Series(branches) => {
                map.serialize_entry("series", &list(branches, |own| Branches(&own.tree)))?;
            }
            Tree::Parallel(branches) => {
                map.serialize_entry("parallel", &list(branches, |own| Branches(&own.tree)))?;
            }
        }
        map.end()
    }
}

impl Why {
    /// What keeps the effect in but a measure.
    fn error(&self) -> Option<String> {
        match self {
            Self::Moves(_) => None,
            Self::Fails(error) => Some(error.to_string()),
            Self::Pulls { element, time } => {
                Some(format!("`{element}` would go into tension at {time} s"))
            }
        }
    }
}

pub(crate) fn finite(number: f64) -> Option<f64> {
    number.is_finite().then_some(number)
}

pub(crate) fn list<'a, T, U>(items: &'a [T], item: impl Fn(&'a T) -> U) -> Vec<U> {
    items.iter().map(item).collect()
}

fn pairs(entries: &[(String, f64)]) -> Pairs<&str, Option<f64>> {
    Pairs(list(entries, |(name, amount)| (name.as_str(), finite(*amount))))
}

/// A map in an order of its own.
struct Pairs<K, V>(Vec<(K, V)>);

impl<K: Serialize, V: Serialize> Serialize for Pairs<K, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}
