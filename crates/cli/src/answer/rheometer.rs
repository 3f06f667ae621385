//! What the rheometer has to say, as one JSON object and as tables.

use dashpot_analysis::rheometer::{
    Computation, Computed, Figure, RheometerReport, Series, Setting, Specimen,
};
use dashpot_plot::Table;
use dashpot_rheology::{KelvinForm, MaxwellForm};
use serde::Serialize;

use crate::numbers::{Unit, bound, constant, quantity, rounded};

/// Digits of what is measured.
const DIGITS: usize = 6;
/// Smaller values, relative to others of their unit, are what rounding leaves of zero.
const NOISE: f64 = 1e-13;
/// Unit of a strain rate.
const STRAIN_RATE: &str = "1/s";
/// Digits of settings that follow from the model.
const CHOSEN_DIGITS: usize = 4;
/// More lines of a spectrum are only counted.
const MOST_LINES: usize = 12;

/// The units of a pad, or those of a material: per thickness and area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Units {
    /// Whether they are those of a material.
    pub(crate) is_material: bool,
}

impl Units {
    /// The unit that stands for one of a pad.
    pub(crate) fn of(self, unit: &'static str) -> &'static str {
        if !self.is_material {
            return unit;
        }
        match unit {
            "N" | "N/m" => "Pa",
            "N s/m" => "Pa s",
            "m" => "1",
            "m/s" => STRAIN_RATE,
            "m/N" => "1/Pa",
            other => other,
        }
    }

    /// The word that stands for one of a pad.
    fn word(self, name: &str) -> String {
        if !self.is_material {
            return name.to_owned();
        }
        name.replace("stiffness", "modulus")
            .replace("deformation", "strain")
            .replace("force", "stress")
    }
}

/// The object that `rheometer --json` prints, in SI units. What is infinite or missing is null.
#[derive(Serialize)]
pub(crate) struct Document<'r> {
    dashpot: &'static str,
    model: &'r str,
    material: bool,
    relaxation_spectrum: Vec<Line>,
    retardation_spectrum: Vec<Line>,
    tests: Vec<Test<'r>>,
}

#[derive(Serialize)]
struct Line {
    time: f64,
    stiffness: f64,
    damping: f64,
}

#[derive(Serialize)]
struct Test<'r> {
    #[serde(rename = "test")]
    protocol: &'static str,
    settings: Vec<Parameter>,
    abscissa: Column<'r>,
    drive: Option<Column<'r>>,
    series: Vec<Answers<'r>>,
    figures: Vec<Characteristic>,
    notes: &'r [String],
}

#[derive(Serialize)]
struct Parameter {
    name: &'static str,
    unit: &'static str,
    value: f64,
}

#[derive(Serialize)]
struct Column<'r> {
    name: String,
    unit: &'static str,
    values: &'r [f64],
}

#[derive(Serialize)]
struct Answers<'r> {
    name: String,
    unit: &'static str,
    model: &'r [f64],
    computed: Vec<Other<'r>>,
}

#[derive(Serialize)]
struct Other<'r> {
    method: &'static str,
    obstacle: Option<&'r str>,
    values: &'r [Option<f64>],
    difference: Option<f64>,
    stated: Option<f64>,
}

#[derive(Serialize)]
struct Characteristic {
    name: String,
    unit: &'static str,
    model: Option<f64>,
    computed: Option<f64>,
    note: Option<&'static str>,
}

impl<'r> Document<'r> {
    /// All tests of a model.
    pub(crate) fn of(
        model: &'r str,
        units: Units,
        specimen: &Specimen,
        reports: &'r [RheometerReport],
    ) -> Self {
        let [relaxation_spectrum, retardation_spectrum] = spectra(specimen);
        Self {
            dashpot: env!("CARGO_PKG_VERSION"),
            model,
            material: units.is_material,
            relaxation_spectrum,
            retardation_spectrum,
            tests: reports.iter().map(|report| Test::of(report, units)).collect(),
        }
    }
}

impl<'r> Test<'r> {
    fn of(report: &'r RheometerReport, units: Units) -> Self {
        let column = |own: &'r dashpot_analysis::Column| Column {
            name: units.word(&own.name),
            unit: units.of(own.unit),
            values: &own.values,
        };
        let other = |(own, by): (&'r Computed, &'r Computation)| Other {
            method: by.method,
            obstacle: by.obstacle.as_deref(),
            values: &own.values,
            difference: own.difference.map(|own| own.relative),
            stated: own.difference.and_then(|own| own.stated),
        };
        let answers = |own: &'r Series| Answers {
            name: units.word(own.name),
            unit: units.of(own.unit),
            model: &own.model,
            computed: own.computed.iter().zip(&report.computations).map(other).collect(),
        };
        Self {
            protocol: report.protocol,
            settings: report
                .settings
                .iter()
                .map(|own| Parameter { name: own.name, unit: units.of(own.unit), value: own.value })
                .collect(),
            abscissa: column(&report.abscissa),
            drive: report.drive.as_ref().map(column),
            series: report.series.iter().map(answers).collect(),
            figures: report
                .figures
                .iter()
                .map(|own| Characteristic {
                    name: units.word(own.name),
                    unit: units.of(own.unit),
                    model: own.model,
                    computed: own.computed,
                    note: own.note,
                })
                .collect(),
            notes: &report.notes,
        }
    }
}

/// The elements of the Maxwell and of the Kelvin form.
fn spectra(specimen: &Specimen) -> [Vec<Line>; 2] {
    let linear = specimen.linear();
    let relaxation = linear.maxwell().map(MaxwellForm::elements).unwrap_or_default();
    let retardation = linear.kelvin().map(KelvinForm::elements).unwrap_or_default();
    [
        relaxation
            .iter()
            .map(|own| Line {
                time: own.relaxation_time,
                stiffness: own.stiffness,
                damping: own.damping,
            })
            .collect(),
        retardation
            .iter()
            .map(|own| Line {
                time: own.retardation_time,
                stiffness: own.stiffness,
                damping: own.damping,
            })
            .collect(),
    ]
}

/// Both spectra side by side.
pub(crate) fn spectrum_table(specimen: &Specimen, units: Units) -> Table {
    let [relaxation, retardation] = spectra(specimen);
    let count = relaxation.len().max(retardation.len());
    let cells = |line: Option<&Line>| match line {
        None => [String::new(), String::new()],
        Some(own) => {
            [quantity(own.time, "s", DIGITS), quantity(own.stiffness, units.of("N/m"), DIGITS)]
        }
    };
    let rows = (0..count.min(MOST_LINES))
        .map(|at| [cells(relaxation.get(at)), cells(retardation.get(at))].concat());
    let more = if count > MOST_LINES {
        format!(", the first {MOST_LINES} of {count}")
    } else {
        String::new()
    };
    let stiffness = units.word("stiffness");
    Table {
        caption: format!("Spectra of the Maxwell form and of the Kelvin form{more}"),
        header: vec![
            "relaxation time".to_owned(),
            stiffness.clone(),
            "retardation time".to_owned(),
            stiffness,
        ],
        rows: rows.collect(),
    }
}

/// What characterises the model: the figures that all its tests begin with.
pub(crate) fn characteristics(reports: &[RheometerReport]) -> &[Figure] {
    let Some((first, others)) = reports.split_first() else { return &[] };
    let is_common = |own: &&Figure| {
        own.computed.is_none() && others.iter().all(|other| other.figures.contains(own))
    };
    let count = first.figures.iter().take_while(is_common).count();
    // A single test has no others to tell its own figures by; those of a model are three.
    &first.figures[..count.min(3)]
}

/// Figures as a table, with the values of the model and of the network; those that do not exist are
/// left out.
pub(crate) fn figure_table(figures: &[Figure], units: Units) -> Table {
    let scale = |unit: &str| {
        let same = figures.iter().filter(|own| own.unit == unit).filter_map(|own| own.model);
        same.fold(0.0_f64, |scale, value| scale.max(value.abs()))
    };
    let value = |own: &Figure, value: Option<f64>| {
        let shown = |value: f64| {
            // What rounding leaves of a zero is none of the figure's.
            let value = if value.abs() <= NOISE * scale(own.unit) { 0.0 } else { value };
            in_unit(value, units.of(own.unit), DIGITS)
        };
        value.map_or_else(String::new, shown)
    };
    let rows = figures
        .iter()
        .filter(|own| own.note.is_none())
        .map(|own| vec![units.word(own.name), value(own, own.model), value(own, own.computed)]);
    let is_computed = figures.iter().any(|own| own.computed.is_some());
    let header = if is_computed { &["", "model", "network"][..] } else { &[] };
    Table {
        caption: String::new(),
        header: header.iter().map(|own| (*own).to_owned()).collect(),
        rows: rows.collect(),
    }
}

/// Figures that do not exist, and why.
pub(crate) fn missing(figures: &[Figure], units: Units) -> Vec<String> {
    let told = |own: &Figure| Some(format!("no {}: {}", units.word(own.name), own.note?));
    figures.iter().filter_map(told).collect()
}

/// A value in its unit; a strain rate is no frequency.
fn in_unit(value: f64, unit: &'static str, digits: usize) -> String {
    if unit == STRAIN_RATE {
        Unit::plain(unit).text(value, digits)
    } else {
        quantity(value, unit, digits)
    }
}

/// The parameters of a test in words.
pub(crate) fn settings(settings: &[Setting], units: Units) -> String {
    let one = |own: &Setting| {
        let unit = units.of(own.unit);
        let value = if unit == STRAIN_RATE {
            in_unit(own.value, unit, CHOSEN_DIGITS)
        } else if own.is_chosen {
            rounded(own.value, unit, CHOSEN_DIGITS)
        } else {
            constant(own.value, unit)
        };
        match own.name {
            "points" => format!("{value} points"),
            name => format!("{} {value}", units.word(name)),
        }
    };
    settings.iter().map(one).collect::<Vec<_>>().join(", ").replace(", to ", " to ")
}

/// How far the independent computations are from the model, in whole sentences.
pub(crate) fn agreement(report: &RheometerReport) -> Vec<String> {
    let of = |(at, by): (usize, &Computation)| {
        let differences = report
            .series
            .iter()
            .filter_map(|series| series.computed.get(at)?.difference.map(|own| (series.name, own)));
        let worst = differences.max_by(|a, b| a.1.relative.total_cmp(&b.1.relative));
        let place = if report.abscissa.unit == "Hz" { "Hz" } else { "s" };
        let found = worst.map_or_else(String::new, |(_, own)| {
            let stated = own.stated.map_or_else(String::new, |stated| {
                format!("; rounding and its own error may be {}", bound(stated))
            });
            let at = quantity(own.at, place, 3);
            format!("differs by {} at most, at {at}{stated}", bound(own.relative))
        });
        let obstacle = by.obstacle.as_ref().map(|reason| match by.reach {
            Some(reach) => format!("reaches to {}, because {reason}", quantity(reach, place, 3)),
            None => format!("gives nothing, because {reason}"),
        });
        let clauses = [Some(found).filter(|own| !own.is_empty()), obstacle];
        let text = clauses.into_iter().flatten().collect::<Vec<_>>().join("; it ");
        let method = by.method;
        if method.starts_with("network") {
            format!("{method}: {text}")
        } else {
            format!("network by {method}: {text}")
        }
    };
    report.computations.iter().enumerate().map(of).collect()
}
