//! What fits are drawn from, and the tables of the same rows.

use std::f64::consts::TAU;

use dashpot_fit::{
    linear::{FittedCurve, FittedRow, Kind},
    network::Kind as TestKind,
};
use dashpot_plot::{
    Chart, FitChannel, FitQuantity, FitRow, FitSeries, Of,
    figures::{CREEP, FitFigure, HISTORY, OSCILLATION, RELAXATION},
};
use dashpot_report::ReportFigure;

use super::{Fitted, scene::FittedScene, target::Compared, words::rms};
use crate::{
    error::CliError,
    folder::Staged,
    output::{csv, list},
};

/// A record with what was fitted to it.
pub(super) struct Drawn {
    pub(super) chart: Chart,
    series: FitSeries,
    /// The heading of its first column, and the unit of the others.
    x: &'static str,
    unit: &'static str,
}

/// Names of the files of so many records.
pub(super) fn names(records: usize) -> Vec<String> {
    let each = 1..=records;
    list(each.flat_map(|at| ["csv", "svg"].map(|ending| format!("record-{at}.{ending}"))))
}

/// Adds a figure and a table of each record; returns the figures for a page.
pub(super) fn write(files: &mut Staged<'_>, all: &[Drawn]) -> Result<Vec<ReportFigure>, CliError> {
    let mut figures = Vec::new();
    for (at, own) in all.iter().enumerate() {
        let figure = ReportFigure::of(&own.chart)?;
        files.add(format!("record-{}.svg", at + 1), &figure.svg)?;
        let (header, rows) = (own.header(), own.rows());
        files.add_with(format!("record-{}.csv", at + 1), |out| csv(out, header, rows))?;
        figures.push(figure);
    }
    Ok(figures)
}

impl Drawn {
    /// The columns behind the first one: heading, and the value of each row; without those that are empty.
    fn columns(&self) -> Vec<(String, Vec<Option<f64>>)> {
        let of = |own: &FitChannel, what: &str, value: fn(&FitRow) -> Option<f64>| {
            let name = format!("{} {what}", own.name);
            (format!("{} [{}]", name.trim(), self.unit), list(own.rows.iter().map(value)))
        };
        let each = self.series.channels.iter().flat_map(|own| {
            [
                of(own, "measured", |row| Some(row.measured)),
                of(own, "fitted", |row| Some(row.model)),
                of(own, "half of the band", |row| row.half),
                of(own, "nearest network", |row| row.floor),
            ]
        });
        list(each.filter(|own| own.1.iter().any(Option::is_some)))
    }

    fn header(&self) -> Vec<String> {
        let columns = self.columns().into_iter().map(|own| own.0);
        list([self.x.to_owned()].into_iter().chain(columns))
    }

    fn rows(&self) -> Vec<Vec<Option<f64>>> {
        let columns = self.columns();
        let first = self.series.channels.first();
        let each = first.into_iter().flat_map(|own| own.rows.iter().enumerate());
        let row = |(at, own): (usize, &FitRow)| {
            let values = columns.iter().map(|column| column.1.get(at).copied().flatten());
            list([Some(own.x)].into_iter().chain(values))
        };
        list(each.map(row))
    }
}

/// A figure, what its first column is over, what it shows, and the SI unit of that.
pub(super) type DrawnAs = (&'static FitFigure, &'static str, FitQuantity, &'static str);

/// What a column of a record of a material or a pad is drawn as.
pub(super) fn drawn_as(kind: Kind, is_material: bool) -> DrawnAs {
    let (figure, x) = match kind {
        Kind::Relaxation => (&RELAXATION, "time [s]"),
        Kind::Creep => (&CREEP, "time [s]"),
        Kind::Storage | Kind::Loss => (&OSCILLATION, "frequency [Hz]"),
        Kind::Stress | Kind::Strain => (&HISTORY, "time [s]"),
    };
    let (quantity, unit) = match (kind, is_material) {
        (Kind::Relaxation | Kind::Storage | Kind::Loss, true) => (FitQuantity::Modulus, "Pa"),
        (Kind::Relaxation | Kind::Storage | Kind::Loss, false) => (FitQuantity::Stiffness, "N/m"),
        (Kind::Creep, true) => (FitQuantity::Compliance, "1/Pa"),
        (Kind::Creep, false) => (FitQuantity::PadCompliance, "m/N"),
        (Kind::Stress, true) => (FitQuantity::Stress, "Pa"),
        (Kind::Stress, false) => (FitQuantity::Force, "N"),
        (Kind::Strain, true) => (FitQuantity::Strain, "1"),
        (Kind::Strain, false) => (FitQuantity::Deformation, "m"),
    };
    (figure, x, quantity, unit)
}

/// The records that a scene was fitted to.
pub(super) fn of_scene(fitted: &FittedScene<'_>) -> Vec<Drawn> {
    let each = fitted.plan.curves.iter().zip(&fitted.fit.tests);
    list(each.map(|((asked, curve), test)| {
        let (figure, x, quantity, unit) = match &curve.output {
            Compared::Output(own) => (&HISTORY, "time [s]", quantity(own.of), curve.output.unit()),
            Compared::Alone(own) => own.drawn(),
        };
        let is_oscillation = curve.output.is_oscillation();
        let is_relative = curve.output.kind() == TestKind::Modulus;
        let rows = curve.rows.iter().zip(&test.residual).enumerate();
        let rows = rows.map(|(at, (row, left))| FitRow {
            x: if is_oscillation { row.0 / TAU } else { row.0 },
            measured: row.1,
            model: if is_relative { row.1 * left.exp() } else { row.1 + left },
            half: test
                .band
                .get(at)
                .copied()
                .flatten()
                .map(|half| half * if is_relative { row.1 } else { 1.0 }),
            floor: None,
        });
        let series = FitSeries {
            title: format!("{}, {}", curve.output.key(), asked.file),
            note: String::new(),
            quantity,
            channels: vec![FitChannel { name: "", rows: rows.collect() }],
            branches: Vec::new(),
        };
        Drawn { chart: figure.chart(&series), series, x, unit }
    }))
}

fn quantity(of: Of) -> FitQuantity {
    match of {
        Of::Deformation => FitQuantity::Deformation,
        Of::Acceleration => FitQuantity::Acceleration,
        Of::Velocity => FitQuantity::Velocity,
        Of::Force | Of::Time | Of::Energy => FitQuantity::Force,
    }
}

/// The records that a model was fitted to.
pub(super) fn of_model(fitted: &Fitted<'_>) -> Vec<Drawn> {
    let records = fitted.records.iter().zip(&fitted.fit.records).enumerate();
    list(records.filter_map(|(at, (told, own))| {
        let curves = fitted.fit.curves.iter().filter(|own| own.record == at);
        let curves: Vec<&FittedCurve> = list(curves);
        let kind = curves.first()?.kind;
        let (figure, x, quantity, unit) = drawn_as(kind, fitted.is_material());
        let is_oscillation = kind.is_oscillation();
        let place = |at: f64| if is_oscillation { at / TAU } else { at };
        let branch =
            |own: &(f64, f64)| (if is_oscillation { (TAU * own.0).recip() } else { own.0 }, own.1);
        let floor = rms(own.floor, own, fitted.units().answer);
        let series = FitSeries {
            title: format!("{}: {}, {}", fitted.name(), told.what.replace('`', ""), told.file),
            note: format!("no network of springs and dashpots comes nearer than {floor}"),
            quantity,
            channels: list(curves.iter().map(|own| channel(own, place))),
            branches: list(fitted.fit.spectrum.branches.iter().map(branch)),
        };
        Some(Drawn { chart: figure.chart(&series), series, x, unit })
    }))
}

fn channel(own: &FittedCurve, place: impl Fn(f64) -> f64) -> FitChannel {
    let name = match own.kind {
        Kind::Storage => "storage",
        Kind::Loss => "loss",
        _ => "",
    };
    let row = |row: &FittedRow| FitRow {
        x: place(row.at),
        measured: row.measured,
        model: row.model,
        half: row.half,
        floor: Some(row.floor),
    };
    let mut rows: Vec<FitRow> = list(own.rows.iter().map(row));
    rows.sort_by(|one, other| one.x.total_cmp(&other.x));
    FitChannel { name, rows }
}
