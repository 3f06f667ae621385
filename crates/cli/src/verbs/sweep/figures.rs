//! What `sweep` draws: lines over one parameter, and maps over two.

use dashpot_analysis::{Bound, Judgement, Limit, Reason, sweep::SweepReport};
use dashpot_plot::{Chart, Direction, Map, MapLimit, Pattern, ReferenceLine, Scale, Series, Side};
use dashpot_scene::Variation;

use super::{
    Swept, Varied,
    titles::{capital, parameter, parameters, quantity},
    words::{self, shown},
};
use crate::input::title;
use dashpot_report::numbers::Unit;

/// A family of at most so many lines is drawn besides its map, and wholly …
const MOST_FAMILY: usize = 12;
/// … and of a larger one, and of words, so many lines.
const MOST_LINES: usize = 7;
/// A map has at least so many rows and columns.
const LEAST_OF_MAP: usize = 4;
/// Values of a map that rise by this factor have colours by their ratios: what keeps a limit lies among the lowest, which
/// colours by differences would not tell apart.
const RATIO_OF_MAP: f64 = 4.0;
/// What is to be said of a curve where it does not decide.
const UNDECIDED: &str = "dotted: undecided";
/// What is to be said of a padding that is as deep as it is thick.
const PRESSED: &str = "ξmax = 1";
/// Ratios of neighbours are equal within this part of them.
const EQUAL: f64 = 1e-3;

/// The figures of a sweep.
#[derive(Clone, Copy)]
pub(super) struct Figures {
    pub(super) lines: bool,
    pub(super) map: bool,
}

impl Figures {
    pub(super) fn of(varied: &Varied) -> Self {
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
    if varied.is_of_rows() {
        return Some(
            "no figures: lines and maps join neighbours, and designs of a table or a sample have none",
        );
    }
    Some(match &varied.variations[..] {
        [_, _] | [_] if varied.variations.iter().all(Variation::is_of_words) => {
            "no figures over words alone; `dashpot run SCENE --variant …` draws curves over each other"
        }
        _ => "no figures: lines and maps are drawn over one parameter or two",
    })
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
fn axis(swept: &Swept, at: usize) -> (String, Scale, Vec<f64>) {
    let own = &swept.varied.variations[at];
    let (unit, places) = swept.in_unit(at);
    let is_of_ratios = own.is_logarithmic || are_of_ratios(places);
    let scale =
        if is_of_ratios { Scale::logarithmic("") } else { Scale::suiting(places.iter().copied()) };
    (label(&parameter(&own.name), &Unit::plain(&unit)), scale, places.to_vec())
}

/// Whether rising values stand at equal ratios, which are not nearly equal differences as well.
fn are_of_ratios(values: &[f64]) -> bool {
    let [first, second, .., last] = values else { return false };
    let ratio = second / first;
    let is_equal = |pair: &[f64]| (pair[1] / pair[0] / ratio - 1.0).abs() <= EQUAL;
    *first > 0.0 && last / first >= 4.0 && values.windows(2).all(is_equal)
}

/// Positions of the lines of a family that are drawn, from its first to its last one.
fn drawn(count: usize, is_of_words: bool) -> Vec<usize> {
    let most = if is_of_words || count > MOST_FAMILY { MOST_LINES } else { MOST_FAMILY };
    let wanted = count.min(most);
    (0..wanted).map(|at| at * (count - 1) / (wanted - 1).max(1)).collect()
}

/// A column over the first parameter, one line for each value of the second; over that which takes numbers,
/// where the other takes words.
pub(super) fn lines(swept: &Swept, column: usize) -> Chart {
    let report = &swept.report;
    let variations = &swept.varied.variations;
    let over = usize::from(variations[0].is_of_words());
    let (x_label, x_scale, x) = axis(swept, over);
    let unit = unit(report, column);
    let values: Vec<f64> = report.column(column).map(|own| unit.of(own)).collect();
    let family = variations.get(1 - over);
    let count = family.map_or(1, Variation::len);
    let is_of_words = family.is_some_and(Variation::is_of_words);
    let name_of = |at: usize| match family {
        Some(own) if own.is_of_words() => own.text(at),
        Some(own) => shown(own, at),
        None => String::new(),
    };
    let [along, across] = if over == 0 { [count, 1] } else { [1, x.len()] };
    let open = undecided(report, column);
    let line = |(number, at): (usize, usize)| {
        let point = |place: usize| place * along + at * across;
        let places = x.iter().enumerate().map(|(place, x)| (*x, values[point(place)]));
        let open: Vec<bool> = (0..x.len()).map(|place| open[point(place)]).collect();
        parted(name_of(at), &places.collect::<Vec<_>>(), &open, number)
    };
    let drawn = drawn(count, is_of_words);
    let parts: Vec<[Series; 2]> = drawn.iter().copied().enumerate().map(line).collect();
    let is_open = parts.iter().any(|own| !own[1].points.is_empty());
    let remark = title(&swept.scene).to_owned();
    let note = if is_open { format!("{remark}; {UNDECIDED}") } else { remark };
    let series: Vec<Series> =
        parts.into_iter().flatten().filter(|own| !own.points.is_empty()).collect();
    let own = quantity(&report.columns[column]);
    let for_each = family.map_or_else(String::new, |family| match drawn.len() {
        all if all == count => format!(", for each {}", parameter(&family.name)),
        some => format!(", for {some} of {count} values of {}", parameter(&family.name)),
    });
    let heading = format!("{} over {}{for_each}", capital(&own), parameter(&variations[over].name));
    let line_at = |at, label: String| ReferenceLine::new(Direction::Horizontal, at, label);
    let pressed = report.columns[column].is_share.then(|| line_at(1.0, PRESSED.to_owned()));
    let limits = limits_of(report, column).map(|limit| {
        line_at(unit.of(limit.bound.level()), words::limit(&report.columns[column], limit))
    });
    Chart {
        title: heading,
        note,
        x_label,
        x_scale,
        y_label: label(&own, &unit),
        y_scale: Scale::suiting(values.iter().copied()),
        family: if family.is_some() && !is_of_words { series.len() } else { 0 },
        series,
        lines: pressed.into_iter().chain(limits).collect(),
        ..Chart::default()
    }
}

/// At which points a limit on a column is undecided.
fn undecided(report: &SweepReport, column: usize) -> Vec<bool> {
    let mut all = vec![false; report.points()];
    for at in (0..report.limits.len()).filter(|at| report.limits[*at].0 == column) {
        for (own, judged) in all.iter_mut().zip(report.judged(at)) {
            *own |= judged.and_then(Judgement::reason).is_some();
        }
    }
    all
}

/// A line of this number in its parts: plain between points that decide, dotted to those that are `open`. The part that
/// reaches the last point has the name.
fn parted(name: String, points: &[(f64, f64)], open: &[bool], number: usize) -> [Series; 2] {
    let gap = |at: usize| (points[at].0, f64::NAN);
    let (mut plain, mut dotted) = (Vec::new(), Vec::new());
    for (at, point) in points.iter().enumerate() {
        plain.push(if open[at] { gap(at) } else { *point });
        let is_open = at > 0 && (open[at - 1] || open[at]);
        if is_open {
            dotted.extend([gap(at - 1), points[at - 1], *point]);
        }
    }
    if open.iter().all(|own| *own) {
        plain.clear();
    }
    let is_last_open = open.last().is_some_and(|own| *own);
    let [solid, open] = if is_last_open { [String::new(), name] } else { [name, String::new()] };
    [
        Series::drawn(solid, (number, Pattern::Solid), plain),
        Series::drawn(open, (number, Pattern::Dotted), dotted),
    ]
}

/// A column over both parameters, with the lines of limits and that on which a padding is pressed to nothing.
pub(super) fn map(swept: &Swept, column: usize) -> Map {
    let report = &swept.report;
    let (x_label, x_scale, x) = axis(swept, 0);
    let (y_label, y_scale, y) = axis(swept, 1);
    let count = [x.len(), y.len()];
    let own = &report.columns[column];
    let element = own.key.rsplit_once('.').map(|key| key.0);
    let pressed = report.columns.iter().enumerate().filter(|(_, other)| {
        let other_element = other.key.rsplit_once('.').map(|key| key.0);
        other.is_share && (other_element == element || shares(report) == 1)
    });
    let pressed = pressed.map(|(at, _)| MapLimit {
        values: turned(count, &report.column(at).collect::<Vec<_>>()),
        at: 1.0,
        label: PRESSED.to_owned(),
        kept: Side::Below,
        ..MapLimit::default()
    });
    let label_of = |of: usize, limit: &Limit| {
        let words = words::limit(&report.columns[of], limit);
        if of == column { words } else { format!("{} {words}", quantity(&report.columns[of])) }
    };
    let bounds = report.limits.iter().enumerate().map(|(at, (of, limit))| MapLimit {
        values: turned(count, &decided(report, *of)),
        errors: turned(count, &known(report, *of)),
        doubted: turned(count, &doubted(report, at)),
        at: limit.bound.level(),
        label: label_of(*of, limit),
        kept: match limit.bound {
            Bound::Max(_) => Side::Below,
            Bound::Min(_) => Side::Above,
        },
    });
    let limits = pressed.chain(bounds).collect();
    let unit = unit(report, column);
    let values: Vec<f64> = report.column(column).map(|own| unit.of(own)).collect();
    let values = turned(count, &values);
    let shown = limits_of(report, column).map(|own| unit.of(own.bound.level()));
    let shown = shown.chain(own.is_share.then_some(1.0)).collect();
    let names: Vec<&str> = swept.varied.variations.iter().map(|own| own.name.as_str()).collect();
    let quantity = quantity(own);
    Map {
        title: format!("{} over {}", capital(&quantity), parameters(&names)),
        note: title(&swept.scene).to_owned(),
        x_label,
        y_label,
        x_scale,
        y_scale,
        value_label: label(&quantity, &unit),
        value_scale: Scale::of_ratios_from(RATIO_OF_MAP, values.iter().copied()),
        shown,
        values,
        limits,
        markers: Vec::new(),
        x,
        y,
    }
}

/// Values of points as a map has them: rows of the first parameter, one above the other.
fn turned<T: Copy>([columns, rows]: [usize; 2], values: &[T]) -> Vec<T> {
    let place = |at: usize| (at % columns) * rows + at / columns;
    (0..values.len()).map(|at| values[place(at)]).collect()
}

/// The errors of a column; zero where they are not known.
fn known(report: &SweepReport, column: usize) -> Vec<f64> {
    report.errors_of(column).map(|own| if own.is_finite() { own } else { 0.0 }).collect()
}

/// The values of a column; none where errors were estimated and this one is not known.
fn decided(report: &SweepReport, column: usize) -> Vec<f64> {
    let are_estimated = report.errors.iter().any(|own| !own.is_nan());
    let both = report.column(column).zip(report.errors_of(column));
    let is_told = |error: f64| !are_estimated || error.is_finite();
    both.map(|(own, error)| if is_told(error) { own } else { f64::NAN }).collect()
}

/// Where the limit at this place is undecided for another reason than that its error reaches across, or would be if it
/// were kept.
fn doubted(report: &SweepReport, limit: usize) -> Vec<bool> {
    let (column, ref own) = report.limits[limit];
    let judged = report.judged(limit).into_iter().zip(report.doubts(own));
    let values = decided(report, column);
    let is_open = |judged: Option<Judgement>, doubt: Option<Reason>, value: f64| match judged {
        Some(Judgement::Undecided(Reason::Error)) => value.is_nan(),
        Some(Judgement::Undecided(_)) => true,
        Some(_) => doubt.is_some(),
        None => false,
    };
    judged.zip(values).map(|((judged, doubt), value)| is_open(judged, doubt, value)).collect()
}

/// The limits on the measure of a column.
fn limits_of(report: &SweepReport, column: usize) -> impl Iterator<Item = &Limit> {
    report.limits.iter().filter(move |own| own.0 == column).map(|own| &own.1)
}

/// How many columns are shares of a thickness.
fn shares(report: &SweepReport) -> usize {
    report.columns.iter().filter(|column| column.is_share).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_ratios_are_told_from_equal_differences() {
        for (values, right) in [
            (&[5.0, 10.0, 20.0][..], true),
            (&[1.0, 1.1, 1.21], false),
            (&[5.0, 10.0, 15.0], false),
            (&[0.0, 10.0, 20.0], false),
            (&[5.0, 50.0], false),
        ] {
            assert_eq!(are_of_ratios(values), right, "{values:?}");
        }
    }

    #[test]
    fn a_line_is_dotted_to_points_that_decide_nothing() {
        let points = [(0.0, 0.0), (1.0, 1.0), (2.0, 4.0), (3.0, 9.0)];
        let parts = |open: [bool; 4]| {
            let parts = parted("K".to_owned(), &points, &open, 2);
            assert!(parts.iter().all(|own| own.stroke.is_some_and(|own| own.colour == 2)));
            let finite = |own: &Series| -> Vec<f64> {
                own.points.iter().filter(|own| own.1.is_finite()).map(|own| own.0).collect()
            };
            (finite(&parts[0]), finite(&parts[1]), parts.map(|own| own.name))
        };
        let (plain, dotted, names) = parts([false; 4]);
        assert_eq!((plain.len(), dotted.len(), names[0].as_str()), (4, 0, "K"));
        let (plain, dotted, names) = parts([false, false, true, true]);
        assert_eq!((plain, dotted), (vec![0.0, 1.0], vec![1.0, 2.0, 2.0, 3.0]));
        assert_eq!(names, ["", "K"]);
        let (plain, dotted, _) = parts([true; 4]);
        assert_eq!((plain.len(), dotted.len()), (0, 6));
    }

    #[test]
    fn twelve_numbers_are_drawn_and_of_more_and_of_words_seven() {
        assert_eq!(drawn(1, false), [0]);
        assert_eq!(drawn(12, false).len(), 12);
        assert_eq!(drawn(13, false), [0, 2, 4, 6, 8, 10, 12]);
        assert_eq!(drawn(9, true).len(), 7);
    }
}
