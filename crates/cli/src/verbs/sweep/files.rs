//! What `sweep` draws, and what it writes into a folder.

use std::{fmt::Write as _, io};

use dashpot_analysis::{
    Judgement, Limit,
    sweep::{Column, SweepReport},
};
use dashpot_plot::{Chart, Direction, Map, MapLimit, ReferenceLine, Scale, Series};
use dashpot_scene::Variation;

use super::{
    Swept, Varied,
    words::{self, name, shown},
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    numbers::Unit,
    output::{csv, list},
};

/// Values at all points.
const TABLE: &str = "sweep.csv";
/// Heading of the numbers of warnings.
const WARNINGS: &str = "warnings";
/// A family of at most so many lines is drawn besides its map …
const MOST_FAMILY: usize = 12;
/// … and of any family at most so many lines, as many as there are colours.
const MOST_LINES: usize = 7;
/// A map has at least so many rows and columns.
const LEAST_OF_MAP: usize = 4;
/// What is to be said of a padding that is as deep as it is thick.
const PRESSED: &str = "ξmax = 1";

/// The figures of a sweep.
#[derive(Clone, Copy)]
struct Figures {
    lines: bool,
    map: bool,
}

impl Figures {
    fn of(varied: &Varied) -> Self {
        match &varied.variations[..] {
            // Nothing says that rows of a table follow each other.
            _ if varied.is_of_rows() => Self { lines: false, map: false },
            [one, rest @ ..] | [rest @ .., one] if one.is_of_words() => {
                let lines = rest.len() == 1 && !rest[0].is_of_words();
                Self { lines, map: false }
            }
            [_] => Self { lines: true, map: false },
            [first, second] => {
                let map = first.len() >= LEAST_OF_MAP && second.len() >= LEAST_OF_MAP;
                Self { lines: !map || second.len() <= MOST_FAMILY, map }
            }
            _ => Self { lines: false, map: false },
        }
    }
}

/// Why there is no figure, where there is none.
pub(super) fn undrawn(varied: &Varied) -> Option<&'static str> {
    let figures = Figures::of(varied);
    if figures.lines || figures.map {
        return None;
    }
    Some(match &varied.variations[..] {
        [_, _] | [_] if varied.variations.iter().all(Variation::is_of_words) => {
            "no figures over words alone; `dashpot run SCENE --variant …` draws curves over each other"
        }
        _ => "no figures: lines and maps are drawn over one parameter or two",
    })
}

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
    [TABLE.to_owned()].into_iter().chain(lines).chain(maps).collect()
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, swept: &Swept) -> Result<(), CliError> {
    files.add_with(TABLE, |out| table(swept, out))?;
    let figures = Figures::of(&swept.varied);
    for (at, column) in swept.report.columns.iter().enumerate() {
        if figures.lines {
            files.add(line_file(column), lines(swept, at).svg()?)?;
        }
        if figures.map {
            files.add(map_file(column), map(swept, at).svg())?;
        }
    }
    Ok(())
}

/// Writes values and errors at all points, in SI units, what is known of the limits, and the numbers of the
/// warnings there, as CSV; what is missing is blank.
pub(super) fn table(swept: &Swept, out: &mut dyn io::Write) -> io::Result<()> {
    let (variations, report) = (&swept.varied.variations, &swept.report);
    let own = variations.iter().enumerate();
    let own = own.map(|(at, own)| {
        if own.is_of_words() {
            own.name.clone()
        } else {
            format!("{} [{}]", own.name, swept.unit(at))
        }
    });
    let found = report.columns.iter().flat_map(|column| {
        let (name, unit) = (name(column), column.unit);
        [format!("{name} [{unit}]"), format!("error of {name} [{unit}]")]
    });
    let limits = report.limits.iter().map(|(column, limit)| {
        let (bound, unit) = (limit.bound, report.columns[*column].unit);
        format!("{} {} {} {unit}", limit.key, bound.sign(), number(bound.level()))
    });
    let header = own.chain(found).chain(limits).chain([WARNINGS.to_owned()]);
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
    csv(out, header, rows)
}

/// The shortest digits that give the number back.
fn number(value: f64) -> String {
    if !value.is_finite() {
        return String::new();
    }
    let (plain, scientific) = (value.to_string(), format!("{value:e}"));
    if scientific.len() < plain.len() { scientific } else { plain }
}

/// The unit in which a column is drawn: that of its largest value.
pub(super) fn unit(report: &SweepReport, column: usize) -> Unit {
    let most = report.column(column).filter(|own| own.is_finite()).map(f64::abs);
    words::unit(&report.columns[column], most.fold(0.0, f64::max))
}

fn label(name: &str, unit: &Unit) -> String {
    if unit.symbol.is_empty() { name.to_owned() } else { format!("{name} ({})", unit.symbol) }
}

/// Label, scale and places of a parameter, in the unit of the command line.
fn axis(swept: &Swept, parameter: usize) -> (String, Scale, Vec<f64>) {
    let own = &swept.varied.variations[parameter];
    let (unit, places) = swept.in_unit(parameter);
    let scale = if own.is_logarithmic { Scale::logarithmic("") } else { Scale::Linear };
    (label(&own.name, &Unit::plain(&unit)), scale, places.to_vec())
}

/// Positions of at most [`MOST_LINES`] lines of a family, from its first to its last one.
fn drawn(count: usize) -> Vec<usize> {
    let wanted = count.min(MOST_LINES);
    (0..wanted).map(|at| at * (count - 1) / (wanted - 1).max(1)).collect()
}

/// A column over the first parameter, one line for each value of the second; over that which takes numbers,
/// where the other takes words.
fn lines(swept: &Swept, column: usize) -> Chart {
    let report = &swept.report;
    let variations = &swept.varied.variations;
    let over = usize::from(variations[0].is_of_words());
    let (x_label, x_scale, x) = axis(swept, over);
    let unit = unit(report, column);
    let values: Vec<f64> = report.column(column).map(|own| unit.of(own)).collect();
    let family = variations.get(1 - over);
    let count = family.map_or(1, Variation::len);
    let name_of = |at: usize| match family {
        Some(own) if own.is_of_words() => own.text(at),
        Some(own) => format!("{} = {}", own.name, shown(own, at)),
        None => String::new(),
    };
    let [along, across] = if over == 0 { [count, 1] } else { [1, x.len()] };
    let line = |at: usize| {
        let value = |place: usize| values[place * along + at * across];
        let points = x.iter().enumerate().map(|(place, x)| (*x, value(place)));
        Series::new(name_of(at), points.collect())
    };
    let own = &report.columns[column];
    let left_out =
        if count > MOST_LINES { format!(", {MOST_LINES} of {count} lines") } else { String::new() };
    let line_at = |at: f64, label: String| {
        let direction = Direction::Horizontal;
        ReferenceLine { direction, at, label, colour: None }
    };
    let pressed = own.is_share.then(|| line_at(1.0, PRESSED.to_owned()));
    let limits = limits_of(report, column)
        .map(|limit| line_at(unit.of(limit.bound.level()), words::limit(report, column, limit)));
    Chart {
        title: name(own) + &left_out,
        note: title(&swept.scene).to_owned(),
        x_label,
        x_scale,
        y_label: label(&name(own), &unit),
        series: drawn(count).into_iter().map(line).collect(),
        lines: pressed.into_iter().chain(limits).collect(),
        ..Chart::default()
    }
}

/// A column over both parameters, with the line on which a padding is pressed to nothing.
fn map(swept: &Swept, column: usize) -> Map {
    let report = &swept.report;
    let (x_label, x_scale, x) = axis(swept, 0);
    let (y_label, y_scale, y) = axis(swept, 1);
    let turned = |values: Vec<f64>| -> Vec<f64> {
        let place = |at: usize| (at % x.len()) * y.len() + at / x.len();
        (0..values.len()).map(|at| values[place(at)]).collect()
    };
    let own = &report.columns[column];
    let element = own.key.rsplit_once('.').map(|key| key.0);
    let limits = report.columns.iter().enumerate().filter(|(_, other)| {
        let other_element = other.key.rsplit_once('.').map(|key| key.0);
        other.is_share && (other_element == element || shares(report) == 1)
    });
    let limits = limits.map(|(at, _)| MapLimit {
        values: turned(report.column(at).collect()),
        at: 1.0,
        label: PRESSED.to_owned(),
    });
    let bounds = report.limits.iter().map(|(of, limit)| MapLimit {
        values: turned(report.column(*of).collect()),
        at: limit.bound.level(),
        label: words::limit(report, *of, limit),
    });
    let limits = limits.chain(bounds).collect();
    let unit = unit(report, column);
    Map {
        title: name(own),
        note: title(&swept.scene).to_owned(),
        x_label,
        y_label,
        x_scale,
        y_scale,
        value_label: label(&name(own), &unit),
        values: turned(report.column(column).map(|own| unit.of(own)).collect()),
        limits,
        x,
        y,
    }
}

/// The limits on the measure of a column.
fn limits_of(report: &SweepReport, column: usize) -> impl Iterator<Item = &Limit> {
    report.limits.iter().filter(move |own| own.0 == column).map(|own| &own.1)
}

/// How many columns are shares of a thickness.
fn shares(report: &SweepReport) -> usize {
    report.columns.iter().filter(|column| column.is_share).count()
}
