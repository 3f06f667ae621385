//! What a design is drawn as: the front of two aims, the map of two numbers, and how near limits are along each number.

use dashpot_design::optimum::{Design, Looked, Requirement, along};
use dashpot_plot::{
    Chart, Direction, Map, MapLimit, Marker, Pattern, ReferenceLine, Scale, Series, Side,
};

use super::{
    DesignArguments, Posing,
    among::Choice,
    answer::Answer,
    asked::{Asked, Least},
    with_problem,
    words::what,
};
use crate::{
    input::title,
    output::list,
    varied::Varied,
    verbs::run::{level, unit_of_kind},
};
use dashpot_report::numbers::Unit;

/// Designs along a number.
const ALONG: usize = 81;
/// Shares of limits beyond this are not drawn: what is far beyond would leave no room for what is near.
const FAR: f64 = 2.5;

/// The designs along each number, the others as in the best.
pub(super) fn slices(
    arguments: &DesignArguments,
    posing: &Posing<'_>,
    choice: &Choice,
    best: &Design,
) -> Vec<Vec<Looked>> {
    let effort = arguments.effort();
    with_problem(posing, choice, |problem| {
        let one = |at| along(problem, &best.values, at, (ALONG, effort)).unwrap_or_default();
        list((0..posing.asked.numbers.len()).map(one))
    })
}

fn labelled(name: &str, unit: &str) -> String {
    let unit = unit.replace("^2", "²").replace("^3", "³");
    if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") }
}

/// A number along an axis.
fn number_axis(own: &Varied) -> (String, Scale) {
    let scale = Scale::suiting(own.bounds.iter().map(|bound| bound / own.one));
    (labelled(&own.name, &own.unit), scale)
}

/// The unit and the label of what is made least, for values like these.
fn axis_of(asked: &Asked, least: &Least, best: &Design, largest: f64) -> (Unit, String) {
    let unit = match least {
        Least::Number(at) => {
            let own = &asked.numbers[*at];
            Unit::new(&own.unit, own.one)
        }
        Least::Step(at) => {
            let own = asked.among[*at].options.iter().flatten().next();
            Unit::suiting(largest, own.map_or("1", |own| &own.si))
        }
        Least::Measure(key) => unit_of_measure(best, key, largest),
    };
    let label = labelled(least.name(asked), &unit.symbol);
    (unit, label)
}

fn unit_of_measure(best: &Design, key: &str, largest: f64) -> Unit {
    let measure = best.runs.iter().find_map(|run| run.measure(key));
    let usual = measure.and_then(|own| unit_of_kind(own.kind, own.unit));
    usual.unwrap_or_else(|| Unit::suiting(largest, measure.map_or("1", |own| own.unit)))
}

/// The front of two aims; none of one point.
pub(super) fn front(answer: &Answer, best: &Design) -> Option<Chart> {
    let asked = &answer.asked;
    let and = asked.and.as_ref().filter(|_| answer.front.len() > 1)?;
    let pairs = || answer.front.iter().map(|own| [own.own.design.aim, own.own.other]);
    let largest = |side: usize| pairs().map(|own| own[side].abs()).fold(0.0, f64::max);
    let (x, x_label) = axis_of(asked, &asked.least, best, largest(0));
    let (y, y_label) = axis_of(asked, and, best, largest(1));
    let points: Vec<(f64, f64)> = list(pairs().map(|own| (x.of(own[0]), y.of(own[1]))));
    // Between designs of different choices there is nothing.
    let parts = answer.front.chunk_by(|one, other| one.choice == other.choice);
    let mut at = 0;
    let lines = parts.map(|part| {
        at += part.len();
        Series::drawn("", (0, Pattern::Solid), points[at - part.len()..at].to_vec())
    });
    let lines: Vec<Series> = list(lines);
    let found = Series::drawn("designs", (0, Pattern::Points), points.clone());
    Some(Chart {
        title: format!("The least {} for its {}", asked.least.name(asked), and.name(asked)),
        note: title(&answer.scene).to_owned(),
        x_label,
        y_label,
        x_scale: Scale::suiting(points.iter().map(|own| own.0)),
        y_scale: Scale::suiting(points.iter().map(|own| own.1)),
        series: lines.into_iter().chain([found]).collect(),
        ..Chart::default()
    })
}

/// How near everything that has to be kept is to its bound along a number, the others as in the best.
pub(super) fn limits(answer: &Answer, best: &Design, number: usize) -> Option<Chart> {
    let asked = &answer.asked;
    let own = &asked.numbers[number];
    let slice = answer.slices.get(number).filter(|own| !own.is_empty())?;
    let (x_label, x_scale) = number_axis(own);
    let series = best.kept.iter().enumerate().filter_map(|(at, kept)| {
        let share = |value: f64| match &kept.required.what {
            Requirement::Depth(..) => Some(value),
            Requirement::Limit(limit) if limit.bound.level() != 0.0 => {
                // One for the limit, and more beyond it, on whichever side it lies.
                limit.bound.margin(value).map(|own| 1.0 - own)
            }
            _ => None,
        };
        let points = slice.iter().map(|own_design| {
            let value = own_design.required.get(at).copied().and_then(share).unwrap_or(f64::NAN);
            let shown = if value <= FAR { 100.0 * value } else { f64::NAN };
            (own_design.values[number] / own.one, shown)
        });
        let points: Vec<(f64, f64)> = list(points);
        let is_drawn = points.iter().any(|own| own.1.is_finite());
        is_drawn.then(|| Series::new(what(asked, kept), points))
    });
    let series: Vec<Series> = list(series);
    let found = best.values[number] / own.one;
    (!series.is_empty()).then(|| Chart {
        title: format!("What holds {}", own.name),
        note: format!("{}; the other numbers as in the best design", title(&answer.scene)),
        x_label,
        x_scale,
        y_label: "used of what is allowed (%)".to_owned(),
        series,
        lines: vec![
            ReferenceLine::new(Direction::Horizontal, 100.0, "limit"),
            ReferenceLine::new(Direction::Vertical, found, "best"),
        ],
        ..Chart::default()
    })
}

/// The map of a grid over two numbers: a measure, the lines of all limits with what they forbid, and the best design.
pub(super) fn map(answer: &Answer, best: &Design) -> Option<Map> {
    let asked = &answer.asked;
    let [one, other] = &asked.numbers[..] else { return None };
    if !best.search.is_grid || !asked.totals.is_empty() {
        return None;
    }
    let looked = &best.spread;
    let columns = looked.len().isqrt();
    // The last number runs fastest.
    let at = |column: usize, row: usize| &looked[column * columns + row];
    let turned = |value: &dyn Fn(&Looked) -> f64| -> Vec<f64> {
        let rows = (0..columns).flat_map(|row| (0..columns).map(move |column| (column, row)));
        list(rows.map(|(column, row)| value(at(column, row))))
    };
    let of = |kept: usize| turned(&|own| own.required.get(kept).copied().unwrap_or(f64::NAN));
    let (values, unit, name) = shown(asked, best, &turned)?;
    let drawn_in = |kept: usize| {
        let own = &best.kept[kept];
        match &own.required.what {
            Requirement::Limit(limit) => {
                let (at, kept_on) = (limit.bound.level(), limit.bound.sign() == "<=");
                let measure = best.runs[own.required.test].measure(&limit.key);
                let bound = measure.map_or(String::new(), |own| level(limit, own.kind, own.unit));
                let label = format!("{} {} {bound}", what(asked, own), limit.bound.sign());
                Some((at, if kept_on { Side::Below } else { Side::Above }, label))
            }
            Requirement::Depth(..) => Some((1.0, Side::Below, what(asked, own))),
            Requirement::Ceiling(..) => None,
        }
    };
    let limits = (0..best.kept.len()).filter_map(|kept| {
        let (at, side, label) = drawn_in(kept)?;
        Some(MapLimit { values: of(kept), at, label, kept: side, ..MapLimit::default() })
    });
    let [(x_label, x_scale), (y_label, y_scale)] = [one, other].map(number_axis);
    let place = |own: &Varied, at: usize| best.values[at] / own.one;
    Some(Map {
        title: format!("Designs over {} and {}", one.name, other.name),
        note: format!("{}; hatched: a limit is exceeded", title(&answer.scene)),
        x_label,
        y_label,
        x_scale,
        y_scale,
        value_label: labelled(&name, &unit.symbol),
        value_scale: Scale::of_ratios_from(4.0, values.iter().copied()),
        x: list((0..columns).map(|column| at(column, 0).values[0] / one.one)),
        y: list((0..columns).map(|row| at(0, row).values[1] / other.one)),
        values,
        limits: list(limits),
        markers: vec![Marker { x: place(one, 0), y: place(other, 1), label: "best".to_owned() }],
        ..Map::default()
    })
}

/// A value of each design, in the order of a map.
type Turned<'t> = dyn Fn(&dyn Fn(&Looked) -> f64) -> Vec<f64> + 't;

/// What the colours of a map show: what is made least, or where that is a number itself, the first limit, or how much is
/// used of what is known of the first pad.
fn shown(asked: &Asked, best: &Design, turned: &Turned<'_>) -> Option<(Vec<f64>, Unit, String)> {
    let largest = |all: &[f64]| {
        all.iter().filter(|own| own.is_finite()).fold(0.0, |a: f64, b| a.max(b.abs()))
    };
    let in_unit = |values: Vec<f64>, key: &str| {
        let unit = unit_of_measure(best, key, largest(&values));
        (list(values.iter().map(|own| unit.of(*own))), unit, key.to_owned())
    };
    if let Least::Measure(key) = &asked.least {
        return Some(in_unit(turned(&|own| own.aim), key));
    }
    let limit = best.kept.iter().enumerate().find_map(|(at, own)| match &own.required.what {
        Requirement::Limit(limit) => Some((at, limit)),
        _ => None,
    });
    let of = |at: usize| turned(&|own| own.required.get(at).copied().unwrap_or(f64::NAN));
    if let Some((at, limit)) = limit {
        return Some(in_unit(of(at), &limit.key));
    }
    let first = best.kept.first()?;
    let values = list(of(0).iter().map(|own| 100.0 * own));
    Some((values, Unit::new("%", 0.01), format!("used of {}", what(asked, first))))
}
