//! What was found as tables and in words.

use dashpot_analysis::rheometer::{Computation, Figure, RheometerReport, Setting, Specimen};
use dashpot_report::{
    Table,
    numbers::{Unit, bound, constant, digits, quantity, rounded},
};
use dashpot_rheology::{KelvinForm, MaxwellForm};
use serde::Serialize;

use super::{Made, STRAIN_RATE, Units};
use crate::list;

/// Digits of what is measured.
const DIGITS: usize = 6;
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
    let (maxwell, kelvin) = (|| linear?.maxwell(), || linear?.kelvin());
    let relaxation = maxwell().map(MaxwellForm::elements).unwrap_or_default();
    let retardation = kelvin().map(KelvinForm::elements).unwrap_or_default();
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
pub(super) fn characteristics(tests: &[Made]) -> &[Figure] {
    let Some((first, others)) = tests.split_first() else { return &[] };
    let is_common = |figure: &&Figure| {
        figure.computed.is_none()
            && others.iter().all(|other| other.report.figures.contains(figure))
    };
    let count = first.report.figures.iter().take_while(is_common).count();
    // A single test has no others to tell its own figures by; those of a model are three.
    &first.report.figures[..count.min(3)]
}

/// Figures as a table, with the values of the model and of the network; those that do not exist are left out.
pub(super) fn figure_table(figures: &[Figure], units: Units) -> Table {
    let is = |has: fn(&Figure) -> bool| figures.iter().any(has);
    let (has_model, has_error) = (is(|own| own.model.is_some()), is(|own| own.error.is_some()));
    let has_computed = is(|own| own.computed.is_some());
    let rows = figures.iter().filter(|figure| figure.note.is_none()).map(|figure| {
        let mut row = vec![units.label(figure.name)];
        row.extend(has_model.then(|| value(figure, figure.model, None, units)));
        row.extend(has_computed.then(|| value(figure, figure.computed, figure.error, units)));
        row.extend(has_error.then(|| error(figure, units)));
        row
    });
    let words = [("model", has_model), ("network", has_computed), ("error", has_error)];
    let words = words.into_iter().filter(|own| own.1).map(|own| own.0);
    Table::new("", [""].into_iter().chain(words).filter(|_| has_computed), rows)
}

/// The figures of tests that differ in their parameters, side by side: those of the network, or else of the
/// model; of each test without its first `common` ones.
pub(super) fn side_by_side(tests: &[Made], common: usize, units: Units) -> Table {
    let of = |made: &Made| made.report.figures[common.min(made.report.figures.len())..].to_vec();
    let all: Vec<Vec<Figure>> = tests.iter().map(of).collect();
    let count = all.iter().map(Vec::len).max().unwrap_or(0);
    let rows = (0..count).map(|at| {
        let name = all.iter().find_map(|own| Some(own.get(at)?.name)).unwrap_or_default();
        let cell = |own: &Vec<Figure>| {
            let Some(figure) = own.get(at) else { return String::new() };
            match (figure.note, figure.computed) {
                (Some(_), _) => "–".to_owned(),
                (None, Some(_)) => value(figure, figure.computed, figure.error, units),
                (None, None) => value(figure, figure.model, None, units),
            }
        };
        [units.label(name)].into_iter().chain(all.iter().map(cell)).collect()
    });
    let labels = tests.iter().map(|made| made.label.as_str());
    Table::new("", [""].into_iter().chain(labels), rows)
}

/// A value of a figure, with the digits that its error justifies; none where there is none.
fn value(own: &Figure, value: Option<f64>, error: Option<f64>, units: Units) -> String {
    let Some(value) = value else { return String::new() };
    let shown = if error.is_some() { digits(value, error, DIGITS) } else { DIGITS };
    in_unit(value, units.of(own.unit), shown)
}

/// How far a figure of the network may be off: relative, or where its value is zero in its unit.
fn error(own: &Figure, units: Units) -> String {
    match (own.computed, own.error) {
        (Some(value), Some(error)) if error < value.abs() => bound(error / value.abs()),
        (Some(_), Some(error)) => in_unit(error, units.of(own.unit), 1),
        (Some(_), None) => "unknown".to_owned(),
        _ => String::new(),
    }
}

/// Figures that do not exist, and why.
pub(super) fn missing(figures: &[Figure], units: Units) -> Vec<String> {
    let sentence = |figure: &Figure| {
        let note = figure.note?;
        Some(format!("no {}: {note}", units.label(figure.name)))
    };
    figures.iter().filter_map(sentence).collect()
}

/// A value in its unit; a strain rate is no frequency.
pub(super) fn in_unit(value: f64, unit: &'static str, digits: usize) -> String {
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

/// The parameters that tests of one kind have in common, in words.
pub(super) fn shared_settings(tests: &[Made], units: Units) -> String {
    let Some((first, others)) = tests.split_first() else { return String::new() };
    let is_shared = |own: &&Setting| others.iter().all(|made| made.report.settings.contains(own));
    let shared: Vec<Setting> = first.report.settings.iter().filter(is_shared).copied().collect();
    settings(&shared, units)
}

/// How far the independent computations are from the model, in whole sentences.
pub(super) fn agreement(report: &RheometerReport) -> Vec<String> {
    let of = |(at, by): (usize, &Computation)| {
        let differences = report.series.iter().filter_map(|series| {
            series.computed.get(at)?.difference.map(|difference| (series.name, difference))
        });
        let worst = differences.max_by(|a, b| a.1.relative.total_cmp(&b.1.relative));
        let place = if report.abscissa.unit == "Hz" { "Hz" } else { "s" };
        let is_alone = report.series.iter().all(|series| series.model.is_empty());
        let found = worst.map_or_else(String::new, |(_, own)| {
            let stated = own.stated.map_or_else(String::new, |stated| {
                format!("; rounding and its own error may be {}", bound(stated))
            });
            let at = quantity(own.at, place, 3);
            format!("differs by {} at most, at {at}{stated}", bound(own.relative))
        });
        let largest = relative_error(report, at);
        let largest = largest.map(|error| match error {
            0.0 => "its values are those of the law, without an error but rounding".to_owned(),
            _ => format!("its error may be {} of the largest value", bound(error)),
        });
        let found = if is_alone { largest.unwrap_or_default() } else { found };
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

/// The error of a computation that has no model beside it, in parts of its largest value.
fn relative_error(report: &RheometerReport, at: usize) -> Option<f64> {
    let is_alone = report.series.iter().all(|series| series.model.is_empty());
    let computed = report.series.first().filter(|_| is_alone)?.computed.get(at)?;
    let values = computed.values.iter().flatten();
    let size = values.fold(0.0_f64, |size, value| size.max(value.abs()));
    (size > 0.0).then_some(computed.error? / size)
}

/// The largest error of several tests, where one method computes them all and there is no more to say of it.
pub(super) fn error_of_all(tests: &[Made]) -> Option<String> {
    let of = |made: &Made| match &made.report.computations[..] {
        [only] if only.obstacle.is_none() => Some((only.method, relative_error(&made.report, 0)?)),
        _ => None,
    };
    let all: Vec<_> = tests.iter().map(of).collect::<Option<_>>()?;
    let method = all.first().filter(|_| all.len() > 1)?.0;
    let worst = all.iter().map(|own| own.1).fold(0.0, f64::max);
    let is_one = all.iter().all(|own| own.0 == method) && !method.starts_with("network");
    let text = match worst {
        0.0 => format!("network by {method}: values of the law, without an error but rounding"),
        _ => format!("network by {method}: errors may be {} of the largest values", bound(worst)),
    };
    is_one.then_some(text)
}
