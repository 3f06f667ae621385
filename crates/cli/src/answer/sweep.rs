//! What a sweep has to say, as one JSON object, as a table and in words.

use dashpot_analysis::{
    partial::Cost,
    sweep::{Column, SweepReport},
};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use dashpot_scene::{Scene, Tunables, Variation, units::si_unit};
use serde::Serialize;

use super::{measures::unit_of_kind, partial::estimate};
use crate::numbers::{Unit, apart, bound};

/// Digits of what is computed.
const DIGITS: usize = 5;
/// Faults of so many points are told.
const MOST_TOLD: usize = 3;

/// What was varied, and in what.
pub(crate) struct Swept<'s> {
    pub(crate) scene: &'s Scene,
    pub(crate) tunables: &'s Tunables,
    pub(crate) variations: &'s [Variation],
    /// The number of the scene that each variation is of.
    pub(crate) matched: &'s [usize],
}

impl Swept<'_> {
    /// SI unit of a parameter.
    pub(crate) fn unit(&self, parameter: usize) -> String {
        let own = self.tunables.all()[self.matched[parameter]].dimension;
        let dimension = self.variations[parameter].dimension.or(own);
        dimension.filter(|own| *own != Dimension::NUMBER).map_or("1".to_owned(), si_unit)
    }

    /// One line for each parameter.
    pub(crate) fn in_words(&self) -> Vec<String> {
        let line = |(own, &at): (&Variation, &usize)| {
            let last = own.len() - 1;
            let scale = if own.is_logarithmic { " at equal ratios" } else { "" };
            let path = &self.tunables.all()[at].path;
            let path = if *path == own.name { String::new() } else { format!(" ({path})") };
            format!(
                "{}{path}: {} values from {} to {}{scale}; {} in the scene",
                own.name,
                own.len(),
                own.text(0),
                own.text(last),
                self.tunables.shown(at)
            )
        };
        self.variations.iter().zip(self.matched).map(line).collect()
    }
}

/// The name of a column.
pub(crate) fn name(column: &Column) -> String {
    if column.is_share { format!("{} over thickness", column.key) } else { column.key.clone() }
}

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

/// The unit in which values of a column are read that are as large as this one.
pub(crate) fn unit(column: &Column, largest: f64) -> Unit {
    let kind = column.key.rsplit_once('.').map_or("", |own| own.1);
    unit_of_kind(kind, column.unit).unwrap_or_else(|| Unit::suiting(largest, column.unit))
}

/// The smallest and the largest value of each measure.
pub(crate) fn summary(report: &SweepReport) -> Table {
    let rows = report.columns.iter().enumerate().map(|(at, column)| {
        let finite = || report.column(at).filter(|own| own.is_finite());
        let ends = [finite().reduce(f64::min), finite().reduce(f64::max)];
        let text = |own: Option<f64>| {
            own.map_or("–".to_owned(), |own| unit(column, own).text(own, DIGITS))
        };
        let [low, high] = ends.map(text);
        vec![name(column), low, high]
    });
    Table {
        caption: String::new(),
        header: ["measure", "lowest", "highest"].map(str::to_owned).to_vec(),
        rows: rows.collect(),
    }
}

/// How it was solved, what is missing, and what was left out.
pub(crate) fn remarks(report: &SweepReport) -> Vec<String> {
    let points = report.values.len() / report.columns.len().max(1);
    let mut all = vec![match (report.stamped, points - report.stamped) {
        (0, full) => format!("{full} points, each solved in full"),
        (stamped, 0) => format!("{stamped} points, stamped from one compiled form"),
        (stamped, full) => {
            format!("{stamped} points stamped from one compiled form, {full} solved in full")
        }
    }];
    for (at, column) in report.columns.iter().enumerate().filter(|own| own.1.is_share) {
        let count = report.column(at).filter(|own| *own > 1.0).count();
        if count > 0 {
            let element = column.key.rsplit_once('.').map_or("", |own| own.0);
            all.push(format!(
                "`{element}` is pressed by more than its thickness at {count} of {points} points: what \
                 a linear law gives there means nothing"
            ));
        }
    }
    if !report.checked.is_empty() {
        all.push(format!(
            "{} of them solved in full as well: the largest difference is {}",
            report.checked.len(),
            bound(report.largest_difference)
        ));
    }
    if let Some(own) = &report.partial {
        let names: Vec<String> = own
            .left_out
            .iter()
            .map(|own| {
                let estimate = estimate(&own.influence.formula, own.influence.value);
                format!("{} ({estimate})", own.effect)
            })
            .collect();
        let names = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
        let most = own.worst.as_ref().map_or(String::new(), |worst| {
            format!("; `{}` moves by {}, the most of all", worst.measure, apart(worst.most()))
        });
        all.push(format!(
            "left out everywhere: {names}{most}; solved with and without it at {} points",
            own.checked.len()
        ));
        let back: Vec<&str> = own.put_back.iter().map(|own| own.effect.as_str()).collect();
        if !back.is_empty() {
            all.push(format!("put back, because it matters at one of them: {}", back.join(", ")));
        }
    }
    let failed: Vec<_> = report.gaps.iter().filter(|own| own.column.is_none()).collect();
    if let Some(first) = failed.first() {
        all.push(format!("{} points have no solution; the first: {}", failed.len(), first.reason));
    }
    let mut told: Vec<(usize, &str, usize)> = Vec::new();
    for own in &report.gaps {
        let Some(column) = own.column else { continue };
        match told.iter_mut().find(|known| (known.0, known.1) == (column, own.reason.as_str())) {
            Some(known) => known.2 += 1,
            None => told.push((column, &own.reason, 1)),
        }
    }
    for (column, reason, count) in told.into_iter().take(MOST_TOLD) {
        let name = name(&report.columns[column]);
        all.push(format!("`{name}` has no value at {count} of {points} points: {reason}"));
    }
    all
}
