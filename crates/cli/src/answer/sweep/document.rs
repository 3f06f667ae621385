//! The object of a sweep in JSON.

use dashpot_analysis::{partial::Cost, sweep::SweepReport};
use serde::Serialize;

use super::Swept;

/// The object that `sweep --json` prints, in SI units. What is missing is null.
#[derive(Serialize)]
pub(crate) struct Document<'a> {
    dashpot: &'static str,
    title: Option<&'a str>,
    file: Option<&'a str>,
    parameters: Vec<Parameter<'a>>,
    measures: Vec<Measure<'a>>,
    points: usize,
    stamped: usize,
    checked: &'a [usize],
    largest_difference: f64,
    gaps: Vec<Missing<'a>>,
    warnings: Vec<Warned<'a>>,
    left_out: Option<LeftOut<'a>>,
}

#[derive(Serialize)]
struct Parameter<'a> {
    name: &'a str,
    path: &'a str,
    unit: String,
    values: &'a [f64],
}

#[derive(Serialize)]
struct Measure<'a> {
    key: &'a str,
    over_thickness: bool,
    unit: &'static str,
    values: Vec<Option<f64>>,
    errors: Vec<Option<f64>>,
}

#[derive(Serialize)]
struct Missing<'a> {
    point: usize,
    measure: Option<&'a str>,
    reason: &'a str,
}

#[derive(Serialize)]
struct Warned<'a> {
    text: &'a str,
    points: &'a [usize],
}

#[derive(Serialize)]
struct LeftOut<'a> {
    bound: f64,
    effects: Vec<&'a str>,
    checked: &'a [usize],
    measure: Option<&'a str>,
    moves: Option<f64>,
    solves: usize,
}

impl<'a> Document<'a> {
    /// All that was found. Values stand in the order of the points: the last parameter varies fastest.
    pub(crate) fn of(swept: &'a Swept<'a>, report: &'a SweepReport) -> Self {
        let parameters = swept.variations.iter().zip(swept.matched).enumerate();
        let measures = report.columns.iter().enumerate();
        let width = report.columns.len();
        let column = |all: &[f64], at: usize| -> Vec<Option<f64>> {
            let own = all.iter().skip(at).step_by(width);
            own.map(|own| own.is_finite().then_some(*own)).collect()
        };
        Self {
            dashpot: env!("CARGO_PKG_VERSION"),
            title: swept.scene.title.as_deref(),
            file: swept.scene.file.as_deref(),
            parameters: parameters
                .map(|(at, (own, &tunable))| Parameter {
                    name: &own.name,
                    path: &swept.tunables.all()[tunable].path,
                    unit: swept.unit(at),
                    values: &own.values,
                })
                .collect(),
            measures: measures
                .map(|(at, own)| Measure {
                    key: &own.key,
                    over_thickness: own.is_share,
                    unit: own.unit,
                    values: column(&report.values, at),
                    errors: column(&report.errors, at),
                })
                .collect(),
            points: report.values.len() / width.max(1),
            stamped: report.stamped,
            checked: &report.checked,
            largest_difference: report.largest_difference,
            gaps: report
                .gaps
                .iter()
                .map(|own| Missing {
                    point: own.point,
                    measure: own.column.map(|at| report.columns[at].key.as_str()),
                    reason: &own.reason,
                })
                .collect(),
            warnings: report
                .warnings
                .iter()
                .map(|own| Warned { text: &own.text, points: &own.points })
                .collect(),
            left_out: report.partial.as_ref().map(|own| LeftOut {
                bound: own.bound,
                effects: own.left_out.iter().map(|own| own.effect.as_str()).collect(),
                checked: &own.checked,
                measure: own.worst.as_ref().map(|own| own.measure.as_str()),
                moves: own.worst.as_ref().map(Cost::most).filter(|own| own.is_finite()),
                solves: own.solves,
            }),
        }
    }
}
