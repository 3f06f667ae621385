//! The answer as an object, of one shape for every scene.

use std::time::Duration;

use dashpot_analysis::{
    Ledger, MeasureReport, Note, Partial, RunReport, SolveSettings, Warning,
    partial::{PutBack, Why},
};
use dashpot_network::parameters::{Dimension, Value};
use dashpot_scene::write_model;
use serde::{Serialize, Serializer, ser::SerializeMap};

use super::{Answer, solving::direction};
use crate::output::{Pairs, VERSION, list, object};

/// The whole answer, with the largest difference between the first run and any other, relative.
pub(super) fn object(answer: &Answer) -> impl Serialize {
    let scene = &answer.scene;
    let differences = answer.differences().into_iter();
    object! {
        dashpot: VERSION,
        scene: object! { title: &scene.title, file: &scene.file },
        settings: answer.asked.first().map(|asked| settings(answer, asked)),
        runs: list(answer.runs.iter().zip(&answer.elapsed).map(|(own, time)| run(own, *time))),
        failed: list(answer.failed.iter().map(|(method, error)| object! {
            method, error: error.to_string(),
        })),
        difference: differences.map(|difference| (difference.key, difference.relative)).collect::<Pairs<_, _>>(),
    }
}

fn settings(answer: &Answer, asked: &SolveSettings) -> impl Serialize {
    let single = asked.accuracy.by_measure.iter().map(|(key, &wish)| (key.as_str(), wish));
    let values = answer.scene.values.iter().map(|value| {
        let unit = value.dimension.and_then(Dimension::named).map(|(_, unit)| unit);
        (&value.name, object! { value: value.value, unit })
    });
    object! {
        duration: asked.duration,
        samples: answer.scene.run.samples,
        methods: list(answer.asked.iter().map(|own| own.method.name())),
        rtol: asked.rtol,
        estimate: asked.estimate,
        accuracy: [("default", asked.accuracy.default)].into_iter().chain(single).collect::<Pairs<_, _>>(),
        neglect_below: asked.accuracy.neglect_below,
        stop: list(asked.stops.iter().map(|stop| object! {
            output: &stop.output, level: stop.level, direction: direction(stop),
        })),
        values: values.collect::<Pairs<_, _>>(),
    }
}

fn run(report: &RunReport, elapsed: Duration) -> impl Serialize {
    let measures = report.measures.iter().map(|measure| (&measure.key, Measure(measure)));
    object! {
        solver: solver(report, elapsed),
        system: &report.system,
        measures: measures.collect::<Pairs<_, _>>(),
        energy: Energy {
            at_end: Balance::of(&report.energy),
            after_impact: report.energy_after_impact.as_ref().map(Balance::of),
        },
        events: &report.events,
        partial: report.partial.as_ref().map(partial),
        segmentation: &report.segmentation,
        warnings: list(report.warnings.iter().map(Warning::to_string)),
        warning_codes: list(report.warnings.iter().map(Warning::code)),
    }
}

fn solver(report: &RunReport, elapsed: Duration) -> impl Serialize {
    let (solver, work) = (&report.solver, &report.solver.statistics);
    object! {
        method: solver.method,
        why: &solver.why,
        rtol: solver.rtol,
        accepted: work.accepted,
        rejected: work.rejected,
        rhs_calls: work.rhs_calls,
        jacobian_calls: work.jacobian_calls,
        factorizations: work.factorizations,
        linear_solves: work.linear_solves,
        work: solver.work,
        solves_for_error: solver.solves_for_error,
        wall_s: work.wall.as_secs_f64(),
        wall_for_error_s: solver.wall_for_error.as_secs_f64(),
        wall_in_all_s: elapsed.as_secs_f64(),
    }
}

/// What was left out, and how far each measure is moved, relative.
fn partial(partial: &Partial) -> impl Serialize {
    let costs = partial.costs.iter().map(|cost| (&cost.measure, cost.relative));
    object! {
        below: partial.bound,
        left_out: list(partial.left_out.iter().map(|own| object! {
            effect: &own.effect,
            formula: &own.influence.formula,
            estimate: own.influence.value,
            alone: &own.alone,
        })),
        put_back: list(partial.put_back.iter().map(put_back)),
        worst: partial.worst(),
        moved: costs.collect::<Pairs<_, _>>(),
        unreported: &partial.unreported,
        further_runs: partial.verification.solves,
        wall_of_further_runs_s: partial.verification.wall.as_secs_f64(),
    }
}

fn put_back(put_back: &PutBack) -> impl Serialize {
    let (moves, error) = match &put_back.why {
        Why::Moves(cost) => (Some(cost), None),
        Why::Fails(error) => (None, Some(error.to_string())),
        Why::Pulls { element, time } => {
            (None, Some(format!("`{element}` would go into tension at {time} s")))
        }
    };
    let (formula, estimate) = (&put_back.influence.formula, put_back.influence.value);
    object! { effect: &put_back.effect, formula, estimate, moves, error }
}

/// The balance at the end of the run, and that at the end of the impact, where it ends within.
#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Energy<'a> {
    #[serde(flatten)]
    at_end: Balance<'a>,
    after_impact: Option<Balance<'a>>,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Balance<'a> {
    time: f64,
    start: f64,
    work_in: f64,
    drives: Pairs<&'a str, f64>,
    kinetic: f64,
    stored: Pairs<&'a str, f64>,
    dissipated: Pairs<&'a str, f64>,
    closure: f64,
}

impl<'a> Balance<'a> {
    fn of(ledger: &'a Ledger) -> Self {
        let pairs = |all: &'a [(String, f64)]| {
            all.iter().map(|(name, amount)| (name.as_str(), *amount)).collect()
        };
        Self {
            time: ledger.time,
            start: ledger.start,
            work_in: ledger.total_work_in(),
            drives: pairs(&ledger.work_in),
            kinetic: ledger.kinetic,
            stored: pairs(&ledger.stored),
            dissipated: pairs(&ledger.dissipated),
            closure: ledger.closure(),
        }
    }
}

struct Measure<'a>(&'a MeasureReport);

impl Serialize for Measure<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let measure = self.0;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("value", &measure.value)?;
        map.serialize_entry("unit", measure.unit)?;
        map.serialize_entry("time", &measure.time)?;
        map.serialize_entry("window", &measure.window.map(|(from, to)| [from, to]))?;
        map.serialize_entry("error", &measure.error)?;
        if let Some(note) = measure.note() {
            map.serialize_entry("note", &note)?;
            map.serialize_entry("note_codes", &list(measure.notes.iter().map(Note::code)))?;
        }
        for (name, value) in &measure.parameters {
            match value {
                Value::Number(number) => map.serialize_entry(name, number)?,
                Value::Word(word) => map.serialize_entry(name, word)?,
                Value::Flag => map.serialize_entry(name, &true)?,
                Value::Table(points) => map.serialize_entry(name, points)?,
                Value::Model(value) => {
                    map.serialize_entry(name, &value.model().map(write_model))?;
                }
                // Its times stand above, as they were resolved.
                Value::Window(_) | Value::LeftOut => {}
            }
        }
        map.end()
    }
}
