//! Outputs over time on demand: all of them as the CSV has them, or their values at single times.

use dashpot_analysis::{RunReport, table_at};
use dashpot_report::Table;
use dashpot_scene::Scene;
use serde::Serialize;

use super::{Answer, deviations, files::sample_times, floor};
use crate::{counts::check_memory, error::CliError, output::list};
use dashpot_report::numbers::{Unit, constant};

/// Digits of a value at a time.
const DIGITS: usize = 5;
/// A value smaller than this part of the largest of its unit is zero.
const ZERO: f64 = 1e-12;

/// A run as an object, with what the command line asks for besides.
#[derive(Serialize)]
pub(super) struct Run<'r, T> {
    #[serde(flatten)]
    report: &'r RunReport,
    /// All outputs at the times of the CSV.
    #[serde(skip_serializing_if = "Option::is_none")]
    curves: Option<Outputs>,
    /// All outputs at the times that were named.
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<Outputs>,
    /// How far it is from each measured curve.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    measured: Vec<T>,
    /// What no pad can beat.
    #[serde(skip_serializing_if = "Option::is_none")]
    floor: Option<floor::Object>,
}

/// Outputs at some times, in SI units.
#[derive(Serialize)]
struct Outputs {
    time: Vec<f64>,
    outputs: Vec<Output>,
}

#[derive(Serialize)]
struct Output {
    name: String,
    unit: &'static str,
    values: Vec<f64>,
}

impl<'r, T> Run<'r, T> {
    pub(super) fn of(report: &'r RunReport, floor: Option<&floor::Told>) -> Self {
        let floor = floor.map(|own| own.object(report));
        Self { report, curves: None, at: None, measured: Vec::new(), floor }
    }
}

impl Answer {
    /// A run of it as an object.
    pub(super) fn object_of<'r>(&'r self, run: &'r RunReport) -> Run<'r, impl Serialize> {
        let curves = self.wishes.curves.then(|| outputs(run, sample_times(run, &self.scene.run)));
        let at = (!self.wishes.at.is_empty()).then(|| outputs(run, self.wishes.at.clone()));
        let measured = list(self.compared(run, run.solver.method).map(deviations::object));
        Run { curves, at, measured, ..Run::of(run, self.floor.as_ref()) }
    }

    /// The values at the times that were named, from the best run.
    pub(super) fn values_at(&self) -> Option<Table> {
        let run = self.best().filter(|_| !self.wishes.at.is_empty())?;
        let found = outputs(run, self.wishes.at.clone());
        let times = found.time.iter().map(|time| constant(*time, "s"));
        let header = list(["at".to_owned()].into_iter().chain(times).chain(["unit".to_owned()]));
        let of_unit = |unit: &str| {
            let alike = found.outputs.iter().filter(|own| own.unit == unit);
            alike.flat_map(|own| &own.values).fold(0.0_f64, |most, own| most.max(own.abs()))
        };
        let row = |own: &Output| {
            let least = ZERO * of_unit(own.unit);
            let most = own.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
            let unit = Unit::suiting(most.max(least), own.unit);
            let text = |value: &f64| {
                if value.abs() <= least { "0".to_owned() } else { unit.number(*value, DIGITS) }
            };
            let cells = own.values.iter().map(text);
            list([own.name.clone()].into_iter().chain(cells).chain([unit.symbol.clone()]))
        };
        Some(Table { caption: String::new(), header, rows: list(found.outputs.iter().map(row)) })
    }
}

/// Memory \[B\] of a value of a curve, with its text.
const VALUE_BYTES: usize = 40;
/// Of large networks no more outputs are kept.
const MOST_OUTPUTS: usize = 1000;

/// Refuses curves of a scene by so many methods that take too much memory as an object.
pub(super) fn check_size(scene: &Scene, methods: usize) -> Result<(), CliError> {
    let (outputs, times) = (scene.assembly.system.outputs.len(), scene.run.samples);
    let values = outputs.min(MOST_OUTPUTS).saturating_mul(times).saturating_mul(methods.max(1));
    check_memory(
        || format!("curves of {outputs} outputs at {times} times"),
        values.saturating_mul(VALUE_BYTES),
        "`samples` under [run] says at how many times; `--at` names some; `--out DIR` writes all as CSV piece by piece",
    )
}

/// Refuses times that the run does not reach.
pub(super) fn reached(at: &[f64], end: f64) -> Result<(), CliError> {
    match at.iter().find(|time| **time > end) {
        None => Ok(()),
        Some(time) => Err(CliError::BeyondEnd { time: *time, end }),
    }
}

fn outputs(run: &RunReport, mut time: Vec<f64>) -> Outputs {
    let end = run.trajectory.t_end;
    time.retain(|time| *time <= end);
    let table = table_at(&run.assembly, &run.trajectory, time);
    let output = |own: dashpot_analysis::Column| Output {
        name: own.name,
        unit: own.unit,
        // A zero has no sign.
        values: list(own.values.into_iter().map(|value| value + 0.0)),
    };
    Outputs { outputs: list(table.columns.into_iter().map(output)), time: table.times }
}
