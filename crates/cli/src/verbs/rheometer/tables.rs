//! What was found as tables and in words.

use dashpot_analysis::rheometer::{Computation, Figure, RheometerReport, Setting, Specimen};
use dashpot_plot::Table;
use dashpot_rheology::{KelvinForm, MaxwellForm};
use serde::Serialize;

use super::{STRAIN_RATE, Units};
use crate::{
    numbers::{Unit, bound, constant, quantity, rounded},
    output::list,
};

/// Digits of what is measured.
const DIGITS: usize = 6;
/// Smaller values, relative to others of their unit, are what rounding leaves of zero.
const NOISE: f64 = 1e-13;
/// Digits of settings that follow from the model.
const CHOSEN_DIGITS: usize = 4;
/// More lines of a spectrum are only counted.
const MOST_LINES: usize = 12;

/// A line of a spectrum: a Maxwell or a Kelvin element.
#[derive(Serialize)]
pub(super) struct Line {
    time: f64,
    stiffness: f64,
    damping: f64,
}

/// The elements of the Maxwell and of the Kelvin form.
pub(super) fn spectra(specimen: &Specimen) -> [Vec<Line>; 2] {
    let linear = specimen.linear();
    let relaxation = linear.maxwell().map(MaxwellForm::elements).unwrap_or_default();
    let retardation = linear.kelvin().map(KelvinForm::elements).unwrap_or_default();
    let line = |time, stiffness, damping| Line { time, stiffness, damping };
    [
        list(relaxation.iter().map(|own| line(own.relaxation_time, own.stiffness, own.damping))),
        list(retardation.iter().map(|own| line(own.retardation_time, own.stiffness, own.damping))),
    ]
}

/// Both spectra side by side.
pub(super) fn spectrum_table(specimen: &Specimen, units: Units) -> Table {
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
    let caption = format!("Spectra of the Maxwell form and of the Kelvin form{more}");
    Table::new(caption, &["relaxation time", &stiffness, "retardation time", &stiffness], rows)
}

/// What characterises the model: the figures that all its tests begin with.
pub(super) fn characteristics(reports: &[RheometerReport]) -> &[Figure] {
    let Some((first, others)) = reports.split_first() else { return &[] };
    let is_common = |figure: &&Figure| {
        figure.computed.is_none() && others.iter().all(|other| other.figures.contains(figure))
    };
    let count = first.figures.iter().take_while(is_common).count();
    // A single test has no others to tell its own figures by; those of a model are three.
    &first.figures[..count.min(3)]
}

/// Figures as a table, with the values of the model and of the network; those that do not exist are
/// left out.
pub(super) fn figure_table(figures: &[Figure], units: Units) -> Table {
    let scale = |unit: &str| {
        let same =
            figures.iter().filter(|figure| figure.unit == unit).filter_map(|figure| figure.model);
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
    let rows = figures.iter().filter(|figure| figure.note.is_none()).map(|figure| {
        vec![units.word(figure.name), value(figure, figure.model), value(figure, figure.computed)]
    });
    let is_computed = figures.iter().any(|figure| figure.computed.is_some());
    let header = if is_computed { &["", "model", "network"][..] } else { &[] };
    Table::new("", header, rows)
}

/// Figures that do not exist, and why.
pub(super) fn missing(figures: &[Figure], units: Units) -> Vec<String> {
    let sentence = |figure: &Figure| {
        let note = figure.note?;
        Some(format!("no {}: {note}", units.word(figure.name)))
    };
    figures.iter().filter_map(sentence).collect()
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
pub(super) fn settings(settings: &[Setting], units: Units) -> String {
    let one = |setting: &Setting| {
        let unit = units.of(setting.unit);
        let value = if unit == STRAIN_RATE {
            in_unit(setting.value, unit, CHOSEN_DIGITS)
        } else if setting.is_chosen {
            rounded(setting.value, unit, CHOSEN_DIGITS)
        } else {
            constant(setting.value, unit)
        };
        match setting.name {
            "points" => format!("{value} points"),
            name => format!("{} {value}", units.word(name)),
        }
    };
    settings.iter().map(one).collect::<Vec<_>>().join(", ").replace(", to ", " to ")
}

/// How far the independent computations are from the model, in whole sentences.
pub(super) fn agreement(report: &RheometerReport) -> Vec<String> {
    let of = |(at, by): (usize, &Computation)| {
        let differences = report.series.iter().filter_map(|series| {
            series.computed.get(at)?.difference.map(|difference| (series.name, difference))
        });
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
