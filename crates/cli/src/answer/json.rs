//! The answer as one JSON object, in SI units, of one shape for every scene.

use std::time::Duration;

use dashpot_analysis::{
    Ledger, MeasureReport, Partial, RunReport, SolveSettings,
    partial::{Cost, Why},
};
use dashpot_network::parameters::{Dimension, ModelValue, Value};
use dashpot_scene::write_model;
use serde::{Serialize, Serializer, ser::SerializeMap};

use super::{Answer, settings::direction};

/// The object that `--json` prints. Numbers that are infinite or undefined are null.
#[derive(Serialize)]
pub(crate) struct Document<'a> {
    /// Version of the program; also the mark of files that it wrote.
    dashpot: &'static str,
    scene: Scene<'a>,
    settings: Option<Settings<'a>>,
    runs: Vec<Run<'a>>,
    failed: Vec<Failed<'a>>,
    /// The largest difference between the first run and any other, relative.
    difference: Pairs<String, f64>,
}

#[derive(Serialize)]
struct Scene<'a> {
    title: Option<&'a str>,
    file: Option<&'a str>,
}

#[derive(Serialize)]
struct Settings<'a> {
    duration: f64,
    samples: usize,
    methods: Vec<&'a str>,
    rtol: Option<f64>,
    estimate: bool,
    accuracy: Pairs<&'a str, f64>,
    neglect_below: Option<f64>,
    stop: Vec<Stop<'a>>,
    values: Pairs<&'a str, Named>,
}

#[derive(Serialize)]
struct Stop<'a> {
    output: &'a str,
    level: f64,
    direction: &'static str,
}

#[derive(Serialize)]
struct Named {
    value: f64,
    unit: Option<&'static str>,
}

#[derive(Serialize)]
struct Failed<'a> {
    method: &'a str,
    error: String,
}

#[derive(Serialize)]
struct Run<'a> {
    solver: Solver<'a>,
    system: System<'a>,
    measures: Pairs<&'a str, Measure<'a>>,
    energy: Energy<'a>,
    events: Vec<Event<'a>>,
    /// What was left out; null where nothing was allowed to be.
    partial: Option<Reduced<'a>>,
    /// The segments of layers that the errors include; null where there are none.
    segmentation: Option<Segments>,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct Segments {
    segments: usize,
    compared_with: usize,
}

#[derive(Serialize)]
struct Solver<'a> {
    method: &'static str,
    why: &'a str,
    rtol: Option<f64>,
    accepted: usize,
    rejected: usize,
    rhs_calls: usize,
    jacobian_calls: usize,
    factorizations: usize,
    linear_solves: usize,
    work: u64,
    solves_for_error: usize,
    wall_s: f64,
    wall_for_error_s: f64,
    wall_in_all_s: f64,
}

#[derive(Serialize)]
struct System<'a> {
    states: usize,
    algebraic: usize,
    modes: usize,
    effects: &'a [&'static str],
}

struct Measure<'a>(&'a MeasureReport);

#[derive(Serialize)]
struct Reduced<'a> {
    below: f64,
    left_out: Vec<Neglected<'a>>,
    put_back: Vec<PutBack<'a>>,
    worst: Option<Moved<'a>>,
    /// How far each measure is moved, relative.
    moved: Pairs<&'a str, f64>,
    unreported: &'a [String],
    further_runs: usize,
    wall_of_further_runs_s: f64,
}

#[derive(Serialize)]
struct Neglected<'a> {
    effect: &'a str,
    formula: &'a str,
    estimate: f64,
    /// The measure that it moves the most by itself, where that is known.
    alone: Option<Moved<'a>>,
}

#[derive(Serialize)]
struct PutBack<'a> {
    effect: &'a str,
    formula: &'a str,
    estimate: f64,
    moves: Option<Moved<'a>>,
    error: Option<String>,
}

#[derive(Serialize)]
struct Moved<'a> {
    measure: &'a str,
    relative: f64,
    uncertainty: f64,
}

#[derive(Serialize)]
#[serde(rename_all = "kebab-case")]
struct Energy<'a> {
    #[serde(flatten)]
    at_end: Balance<'a>,
    /// The same at the end of the impact, where it ends within the run.
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

#[derive(Serialize)]
struct Event<'a> {
    time: f64,
    what: &'a str,
}

/// A map in an order of its own.
struct Pairs<K, V>(Vec<(K, V)>);

impl<K: Serialize, V: Serialize> Serialize for Pairs<K, V> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

impl Serialize for Measure<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let measure = self.0;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("value", &measure.value)?;
        map.serialize_entry("unit", measure.unit)?;
        map.serialize_entry("time", &measure.time)?;
        map.serialize_entry("window", &measure.window.map(|(from, to)| [from, to]))?;
        map.serialize_entry("error", &measure.error)?;
        if let Some(note) = &measure.note {
            map.serialize_entry("note", note)?;
        }
        for (name, value) in &measure.parameters {
            match value {
                Value::Number(number) => map.serialize_entry(name, number)?,
                Value::Word(word) => map.serialize_entry(name, word)?,
                Value::Flag => map.serialize_entry(name, &true)?,
                Value::Table(points) => map.serialize_entry(name, points)?,
                Value::Model(ModelValue(model)) => {
                    map.serialize_entry(name, &write_model(model))?;
                }
                // Its times stand above, as they were resolved.
                Value::Window(_) | Value::LeftOut => {}
            }
        }
        map.end()
    }
}

/// The whole answer.
pub(crate) fn document(answer: &Answer) -> Document<'_> {
    let scene = &answer.scene;
    let failed = answer.failed.iter();
    let differences = answer.differences().into_iter();
    Document {
        dashpot: env!("CARGO_PKG_VERSION"),
        scene: Scene { title: scene.title.as_deref(), file: scene.file.as_deref() },
        settings: answer.asked.first().map(|asked| settings(answer, asked)),
        runs: answer.runs.iter().zip(&answer.elapsed).map(|(own, time)| run(own, *time)).collect(),
        failed: failed.map(|(method, error)| Failed { method, error: error.to_string() }).collect(),
        difference: Pairs(differences.map(|own| (own.key, own.relative)).collect()),
    }
}

fn settings<'a>(answer: &'a Answer, asked: &'a SolveSettings) -> Settings<'a> {
    let single = asked.accuracy.by_measure.iter().map(|(key, &wish)| (key.as_str(), wish));
    let values = answer.scene.values.iter().map(|value| {
        let unit = value.dimension.and_then(Dimension::named).map(|(_, unit)| unit);
        (value.name.as_str(), Named { value: value.value, unit })
    });
    let stops = asked.stops.iter();
    Settings {
        duration: asked.duration,
        samples: answer.scene.run.samples,
        methods: answer.asked.iter().map(|own| own.method.as_str()).collect(),
        rtol: asked.rtol,
        estimate: asked.estimate,
        accuracy: Pairs([("default", asked.accuracy.default)].into_iter().chain(single).collect()),
        neglect_below: asked.accuracy.neglect_below,
        stop: stops
            .map(|own| Stop { output: &own.output, level: own.level, direction: direction(own) })
            .collect(),
        values: Pairs(values.collect()),
    }
}

fn run(report: &RunReport, elapsed: Duration) -> Run<'_> {
    let (solver, system) = (&report.solver, &report.system);
    let work = &solver.statistics;
    Run {
        solver: Solver {
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
        },
        system: System {
            states: system.states,
            algebraic: system.algebraic,
            modes: system.modes,
            effects: &system.effects,
        },
        measures: Pairs(
            report.measures.iter().map(|own| (own.key.as_str(), Measure(own))).collect(),
        ),
        energy: Energy {
            at_end: balance(&report.energy),
            after_impact: report.energy_after_impact.as_ref().map(balance),
        },
        events: report.events.iter().map(|own| Event { time: own.time, what: &own.what }).collect(),
        partial: report.partial.as_ref().map(reduced),
        segmentation: report
            .segmentation
            .as_ref()
            .map(|own| Segments { segments: own.segments, compared_with: own.others }),
        warnings: &report.warnings,
    }
}

fn moved(cost: &Cost) -> Moved<'_> {
    Moved { measure: &cost.measure, relative: cost.relative, uncertainty: cost.uncertainty }
}

fn reduced(partial: &Partial) -> Reduced<'_> {
    let left_out = partial.left_out.iter().map(|own| Neglected {
        effect: &own.effect,
        formula: &own.influence.formula,
        estimate: own.influence.value,
        alone: own.alone.as_ref().map(moved),
    });
    let put_back = partial.put_back.iter().map(|own| {
        let (moves, error) = match &own.why {
            Why::Moves(cost) => (Some(moved(cost)), None),
            Why::Fails(error) => (None, Some(error.to_string())),
            Why::Pulls { element, time } => {
                (None, Some(format!("`{element}` would pull from {time} s on")))
            }
        };
        let (formula, estimate) = (own.influence.formula.as_str(), own.influence.value);
        PutBack { effect: &own.effect, formula, estimate, moves, error }
    });
    let costs = partial.costs.iter().map(|own| (own.measure.as_str(), own.relative));
    Reduced {
        below: partial.bound,
        left_out: left_out.collect(),
        put_back: put_back.collect(),
        worst: partial.worst().map(moved),
        moved: Pairs(costs.collect()),
        unreported: &partial.unreported,
        further_runs: partial.verification.solves,
        wall_of_further_runs_s: partial.verification.wall.as_secs_f64(),
    }
}

fn balance(ledger: &Ledger) -> Balance<'_> {
    Balance {
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

fn pairs(entries: &[(String, f64)]) -> Pairs<&str, f64> {
    Pairs(entries.iter().map(|(name, amount)| (name.as_str(), *amount)).collect())
}
