//! What `sweep` writes into a folder.

use std::{fmt::Write as _, io};

use dashpot_analysis::{
    Judgement,
    sweep::{Column, SweepReport},
};
use dashpot_report::ReportFigure;

use super::{
    Swept, Varied,
    figures::{Figures, lines, map},
    page::page,
    words::{name, zero_within},
};
use crate::{
    error::CliError,
    folder::Staged,
    output::{PAGE, csv, list},
};

const TABLE: &str = "sweep.csv";
/// Heading of the numbers of warnings.
pub(super) const WARNINGS: &str = "warnings";

fn line_file(column: &Column) -> String {
    stem(column) + ".svg"
}

fn map_file(column: &Column) -> String {
    stem(column) + "-map.svg"
}

/// The key of a column as the name of a file: what is no part of such a name everywhere is written as
/// in addresses, so that different keys have different names.
fn stem(column: &Column) -> String {
    let mut name = String::new();
    for char in column.key.chars() {
        if "/\\:*?\"<>|%".contains(char) {
            let _ = write!(name, "%{:02X}", u32::from(char));
        } else {
            name.push(char);
        }
    }
    name + if column.is_share { "-over-thickness" } else { "" }
}

/// The files that are written besides the result.
pub(super) fn names(varied: &Varied, columns: &[Column]) -> Vec<String> {
    let figures = Figures::of(varied);
    let lines = columns.iter().filter(|_| figures.lines).map(line_file);
    let maps = columns.iter().filter(|_| figures.map).map(map_file);
    [TABLE, PAGE].map(str::to_owned).into_iter().chain(lines).chain(maps).collect()
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, swept: &Swept) -> Result<(), CliError> {
    files.add_with(TABLE, |out| table(swept, out))?;
    let figures = Figures::of(&swept.varied);
    let mut drawn = Vec::new();
    let columns = swept.report.columns.iter().enumerate();
    // There is nothing to see in what is left of zero.
    for (at, column) in columns.filter(|own| zero_within(&swept.report, own.0).is_none()) {
        let mut add = |name: String, own: ReportFigure| {
            let added = files.add(name, &own.svg);
            drawn.push(own);
            added
        };
        if figures.map {
            add(map_file(column), ReportFigure::of_map(&map(swept, at)))?;
        }
        if figures.lines {
            add(line_file(column), ReportFigure::of(&lines(swept, at))?)?;
        }
    }
    files.add(PAGE, page(swept, drawn).html())
}

/// Writes values and errors at all points, in SI units, what is known of the limits, and the numbers of the
/// warnings there, as CSV; what is missing is blank.
pub(super) fn table(swept: &Swept, out: &mut dyn io::Write) -> io::Result<()> {
    let (variations, report) = (&swept.varied.variations, &swept.report);
    let judged = list((0..report.limits.len()).map(|at| report.judged(at)));
    let width = report.columns.len();
    let points = report.values.chunks(width).zip(report.errors.chunks(width));
    let mut warned = list(report.warnings.iter().map(|warning| warning.points.iter().peekable()));
    let rows = points.enumerate().map(|(point, (values, errors))| {
        let places = swept.varied.places(&swept.grid.places(point)).into_iter();
        let own = places.zip(variations).map(|(place, own)| {
            own.words.get(place).cloned().unwrap_or_else(|| number(own.values[place]))
        });
        let both = values.iter().zip(errors).flat_map(|(value, error)| [*value, *error]);
        let raised = warned
            .iter_mut()
            .enumerate()
            .filter_map(|(at, points)| points.next_if_eq(&&point).map(|_| (at + 1).to_string()));
        let raised = list(raised).join(" ");
        let judged = judged.iter().map(|own| own[point].map_or("", Judgement::word).to_owned());
        list(own.chain(both.map(number)).chain(judged).chain([raised]))
    });
    csv(out, header(&swept.varied, report), rows)
}

/// The headings of a table of all points: parameters, measures with their errors, limits, warnings.
pub(super) fn header(varied: &Varied, report: &SweepReport) -> Vec<String> {
    let own = varied.variations.iter().enumerate().map(|(at, own)| {
        let unit = || format!(" [{}]", varied.unit(at));
        if own.is_of_words() { own.name.clone() } else { own.name.clone() + &unit() }
    });
    let found = report.columns.iter().flat_map(|column| {
        let (name, unit) = (name(column), column.unit);
        [format!("{name} [{unit}]"), format!("error of {name} [{unit}]")]
    });
    let limits = report.limits.iter().map(|(column, limit)| {
        let (bound, unit) = (limit.bound, report.columns[*column].unit);
        format!("{} {} {} {unit}", limit.key, bound.sign(), number(bound.level()))
    });
    list(own.chain(found).chain(limits).chain([WARNINGS.to_owned()]))
}

/// The shortest digits that give the number back.
fn number(value: f64) -> String {
    if !value.is_finite() {
        return String::new();
    }
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}
