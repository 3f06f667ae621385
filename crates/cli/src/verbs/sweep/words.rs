//! What was varied, the ends of what was found, and what is to be said of it.

use dashpot_analysis::{
    Limit, Missing, Warning,
    sweep::{Column, Estimates, Grid, PartialOfSweep, SweepReport, SweepWarning},
};
use dashpot_network::parameters::Dimension;
use dashpot_report::Table;
use dashpot_scene::{Remark, Variation, units::si_unit};

use super::{Form, SweepArguments, Swept, Varied, kept, unmoved::unmoved};
use crate::{
    output::list,
    unevaluated,
    verbs::run::{level, unit_of_kind},
};
use dashpot_report::numbers::{self, Unit, apart, bound, counted, estimate, significant};

/// Digits of what is computed.
const DIGITS: usize = 5;

impl SweepArguments {
    /// What is asked for, in words.
    pub(super) fn in_words(&self, estimates: Estimates) -> Vec<(&'static str, String)> {
        let estimated = match estimates {
            Estimates::All => "estimated at all points",
            Estimates::Some => "estimated at some points",
            Estimates::Off => "not estimated",
        };
        let own = [("errors", Some(estimated.to_owned()))];
        let set = self.scene.values.set.iter();
        let set = list(set.map(|(name, value)| format!("{name}={value}")));
        let asked = [
            ("method", self.method.clone()),
            ("neglect below", self.neglect.map(numbers::share)),
            ("most work of a point", self.budget.map(|budget| budget.0.to_string())),
            ("vary", (!self.vary.is_empty()).then(|| self.vary.join("; "))),
            ("set", (!set.is_empty()).then(|| set.join("; "))),
            ("sample, seed", self.sample.map(|count| format!("{count}, {}", self.seed))),
            ("table", self.points.as_ref().map(|own| own.display().to_string())),
        ];
        own.into_iter().chain(asked).filter_map(|(name, own)| Some((name, own?))).collect()
    }
}

impl Swept {
    /// The unit of a parameter as the command line says it, else the SI unit, and its values therein.
    pub(super) fn in_unit(&self, parameter: usize) -> (String, &[f64]) {
        let own = &self.varied.variations[parameter];
        if own.unit.is_empty() {
            (self.varied.unit(parameter), &own.values)
        } else {
            (own.unit.clone(), &own.numbers)
        }
    }

    /// The values of all parameters at a point, with the line of a table in which they stand.
    pub(super) fn at(&self, point: usize) -> String {
        self.varied.at(&self.grid, point)
    }

    /// The same without the names.
    pub(super) fn values_at(&self, point: usize) -> Vec<String> {
        self.varied.values_at(&self.grid, point)
    }
}

impl Varied {
    /// The values of all parameters at a point of the grid, with the line of a table in which they stand.
    pub(super) fn at(&self, grid: &Grid, point: usize) -> String {
        let line = self.lines.get(point).map(|line| format!("line {line}"));
        let all = self.values_at(grid, point).into_iter().zip(&self.variations);
        let all = all.map(|(value, own)| format!("{} = {value}", own.name));
        line.into_iter().chain(all).collect::<Vec<_>>().join(", ")
    }

    fn values_at(&self, grid: &Grid, point: usize) -> Vec<String> {
        let places = self.places(&grid.places(point)).into_iter();
        places.zip(&self.variations).map(|(place, own)| shown(own, place)).collect()
    }

    /// SI unit of a parameter.
    pub(super) fn unit(&self, parameter: usize) -> String {
        let own = || self.tunables.all()[self.matched[parameter]?].dimension;
        let dimension = self.variations[parameter].dimension.or_else(own);
        dimension
            .filter(|dimension| *dimension != Dimension::NUMBER)
            .map_or("1".to_owned(), si_unit)
    }

    /// One line for each parameter.
    pub(super) fn in_words(&self) -> Vec<String> {
        let line = |(place, (own, &at)): (usize, (&Variation, &Option<usize>))| {
            let Some(at) = at else {
                return format!("{}: names the designs of the table", own.name);
            };
            let last = own.len() - 1;
            let scale = if own.is_logarithmic { " at equal ratios" } else { "" };
            let path = &self.tunables.all()[at].path;
            let path = if *path == own.name { String::new() } else { format!(" ({path})") };
            let shown = self.tunables.shown(at);
            let name = &own.name;
            match self.form {
                Form::Listed => return format!("{name}{path}: by the table; {shown} in the scene"),
                Form::Sampled => {
                    let range = &self.ranges[place];
                    return format!(
                        "{name}{path}: a Latin hypercube of {range}; {shown} in the scene"
                    );
                }
                Form::Combined | Form::Mixed(_) => {}
            }
            if own.is_of_words() {
                return format!("{name}{path}: {}; {shown} in the scene", own.words.join(", "));
            }
            format!(
                "{name}{path}: {} values from {} to {}{scale}; {shown} in the scene",
                own.len(),
                own.text(0),
                own.text(last),
            )
        };
        let all = self.variations.iter().zip(&self.matched);
        all.enumerate().map(line).collect()
    }
}

pub(super) fn name(column: &Column) -> String {
    if column.is_share { format!("{} over thickness", column.key) } else { column.key.clone() }
}

/// Relative difference of two columns that say the same.
const SAME: f64 = 1e-12;

/// The columns that tables for people have: all but a deformation over thickness that a strain repeats.
pub(super) fn told(report: &SweepReport) -> Vec<usize> {
    let all = 0..report.columns.len();
    let is_same = |(one, other): (f64, f64)| {
        (one - other).abs() <= SAME * one.abs() || !one.is_finite() && !other.is_finite()
    };
    let is_repeated = |at: usize, own: &Column| {
        let strains = report.columns.iter().enumerate();
        let mut strains = strains.filter(|(_, own)| !own.is_share && own.unit == "1");
        own.is_share
            && strains.any(|(other, _)| report.column(at).zip(report.column(other)).all(is_same))
    };
    all.filter(|at| !is_repeated(*at, &report.columns[*at])).collect()
}

/// Within how much a column is zero at all points that have a value; `None` where it is not, or errors are not known.
pub(super) fn zero_within(report: &SweepReport, column: usize) -> Option<f64> {
    let both = report.column(column).zip(report.errors_of(column));
    let mut known = both.filter(|own| own.0.is_finite()).peekable();
    known.peek()?;
    let is_zero = |(value, error): (f64, f64)| (value.abs() <= error).then_some(error);
    known.map(is_zero).try_fold(0.0, |most: f64, own| Some(most.max(own?)))
}

/// The columns that are zero at all points.
fn zeros(report: &SweepReport) -> impl Iterator<Item = String> {
    report.columns.iter().enumerate().filter_map(|(at, own)| {
        let error = zero_within(report, at)?;
        Some(format!(
            "`{}` is zero within {} at all points",
            name(own),
            unit(own, error).text(error, 2)
        ))
    })
}

/// The unit in which values of a column are read that are as large as this one.
pub(super) fn unit(column: &Column, largest: f64) -> Unit {
    let kind = column.key.rsplit_once('.').map_or("", |own| own.1);
    unit_of_kind(kind, column.unit).unwrap_or_else(|| Unit::suiting(largest, column.unit))
}

/// The smallest and the largest value of each measure; of a sample what 5 %, half and 95 % of the designs stay
/// below as well.
pub(super) fn summary(report: &SweepReport, is_sample: bool) -> Table {
    let header: &[(&str, f64)] = if is_sample {
        &[("lowest", 0.0), ("5 %", 0.05), ("median", 0.5), ("95 %", 0.95), ("highest", 1.0)]
    } else {
        &[("lowest", 0.0), ("highest", 1.0)]
    };
    let rows = told(report).into_iter().map(|at| {
        let column = &report.columns[at];
        let mut finite: Vec<f64> = report.column(at).filter(|own| own.is_finite()).collect();
        finite.sort_by(f64::total_cmp);
        let text = |own: Option<f64>| {
            own.map_or("–".to_owned(), |own| unit(column, own).text(own, DIGITS))
        };
        let values = header.iter().map(|(_, share)| text(quantile(&finite, *share)));
        let part = match finite.len() {
            count if count == report.points() => String::new(),
            count => format!(" ({count} of {})", report.points()),
        };
        [name(column) + &part].into_iter().chain(values).collect()
    });
    Table::new("", ["measure"].into_iter().chain(header.iter().map(|own| own.0)), rows)
}

/// What this share of rising values stays below, linear between them; `None` of none.
fn quantile(rising: &[f64], share: f64) -> Option<f64> {
    let last = rising.len().checked_sub(1)?;
    let place = share * last as f64;
    let at = (0..last).rev().find(|at| *at as f64 <= place).unwrap_or(0);
    let next = (at + 1).min(last);
    Some(rising[at] + (place - at as f64) * (rising[next] - rising[at]))
}

/// A limit on the measure of a column: `limit 250 g (EN 1078:2012)`.
pub(super) fn limit(column: &Column, limit: &Limit) -> String {
    let kind = limit.key.rsplit_once('.').map_or("", |own| own.1);
    let level = level(limit, kind, column.unit);
    let from = limit.from.as_ref().map_or(String::new(), |from| format!(" ({from})"));
    let of_mean = if limit.of_mean { ", of the mean" } else { "" };
    format!("{} {level}{of_mean}{from}", limit.bound.word())
}

/// The level of a limit with its sign: `≤ 250 g`.
pub(super) fn level_of(column: &Column, limit: &Limit) -> String {
    let kind = limit.key.rsplit_once('.').map_or("", |own| own.1);
    format!("{} {}", limit.bound.sign(), level(limit, kind, column.unit))
}

/// A value of a parameter to four digits.
pub(super) fn shown(variation: &Variation, at: usize) -> String {
    match variation.words.get(at) {
        Some(word) => word.clone(),
        None => {
            format!("{} {}", short(variation.numbers[at]), variation.unit).trim_end().to_owned()
        }
    }
}

/// A number to four digits, without zeros at its end.
pub(super) fn short(number: f64) -> String {
    let text = significant(number, 4);
    match text.split_once('.') {
        Some(_) if !text.contains('e') => {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => text,
    }
}

/// Warnings of so many kinds are counts.
const MOST_WARNED: usize = 8;

/// How it was solved, what runs are warned of, what is missing, and what was left out.
pub(super) fn notes(swept: &Swept) -> Vec<String> {
    let (report, points) = (&swept.report, swept.report.points());
    let mut all = kept::kept(swept);
    all.extend(zeros(report));
    all.extend(means(swept));
    all.extend(solving(swept));
    all.extend(warnings(swept, report, points));
    all.extend(report.partial.iter().flat_map(left_out));
    all.extend(infinite(report));
    all.extend(unmoved(swept));
    all
}

/// What a reader must know before any number: warnings, and what is missing.
pub(super) fn warned(swept: &Swept) -> Vec<String> {
    let (report, points) = (&swept.report, swept.report.points());
    let partial = report.partial.iter().flat_map(left_out);
    let all = missing(swept).into_iter().chain(infinite(report));
    all.chain(warnings(swept, report, points)).chain(partial).chain(unmoved(swept)).collect()
}

/// The columns that are infinite at some points.
fn infinite(report: &SweepReport) -> Vec<String> {
    let count = |at: usize| {
        report.gaps.iter().filter(|own| own.is_infinite && own.column == Some(at)).count()
    };
    let counts = (0..report.columns.len()).map(|at| (at, count(at))).filter(|own| own.1 > 0);
    let text = |(at, count): (usize, usize)| {
        format!(
            "`{}` is infinite at {count} of {} points",
            name(&report.columns[at]),
            report.points()
        )
    };
    list(counts.map(text))
}

pub(super) fn solving(swept: &Swept) -> Vec<String> {
    let (report, points) = (&swept.report, swept.report.points());
    let mut all = vec![solved(report.instantiated, points)];
    if !report.checked.is_empty() {
        all.push(format!(
            "{} of them solved in full as well: the largest difference is {}",
            report.checked.len(),
            bound(report.largest_difference)
        ));
    }
    let is_of_some = matches!(swept.estimates, Estimates::Some);
    if is_of_some && (1..points).contains(&report.estimated) {
        all.push(format!(
            "errors estimated at {} of them; the others have those of {} (`--estimate all` for all)",
            report.estimated,
            match report.instantiated {
                0 => "points near them",
                own if own == points => "their steps",
                _ => "their steps, or of points near them",
            }
        ));
    }
    all
}

/// The numbers with scatter that do not vary here.
fn means(swept: &Swept) -> impl Iterator<Item = String> {
    let Varied { tunables, matched, .. } = &swept.varied;
    let is_varied =
        |path: &str| matched.iter().flatten().any(|at| tunables.all()[*at].path == path);
    let held = swept.scene.scatter.iter().filter(move |own| !is_varied(&own.path));
    held.map(|own| format!("{}: {}", own.name, Remark::Mean(own.text.clone())))
}

pub(super) fn solved(instantiated: usize, points: usize) -> String {
    match (instantiated, points - instantiated) {
        (0, 1) => "1 point, solved in full".to_owned(),
        (0, full) => format!("{full} points, each solved in full"),
        (instantiated, 0) => {
            format!("{}, instantiated from one compiled form", counted(instantiated, "point"))
        }
        (instantiated, full) => {
            format!(
                "{} instantiated from one compiled form, {full} solved in full",
                counted(instantiated, "point")
            )
        }
    }
}

/// What runs are warned of, with the numbers by which the table calls it; not what the scene's own text
/// has brought already.
fn warnings(swept: &Swept, report: &SweepReport, points: usize) -> Vec<String> {
    let known = &swept.scene.assembly.warnings;
    let sentence = |(at, own): (usize, &SweepWarning)| {
        let first = own.points.first().map_or(String::new(), |point| swept.at(*point));
        let of = if points == 1 {
            "at the only point".to_owned()
        } else if own.points.len() == points {
            format!("at all {points} points")
        } else {
            format!("at {} of {points} points", own.points.len())
        };
        format!("warning {}, {of}, first at {first}: {}", at + 1, own.warning)
    };
    let is_known = |sweep_warning: &SweepWarning| matches!(&sweep_warning.warning, Warning::Network(sweep_warning) if known.contains(sweep_warning));
    let new = report.warnings.iter().enumerate().filter(|own| !is_known(own.1));
    let mut all: Vec<String> = new.map(sentence).collect();
    let more = all.len().saturating_sub(MOST_WARNED);
    all.truncate(MOST_WARNED);
    if more > 0 {
        all.push(format!("{more} more kinds of warnings are in the JSON object"));
    }
    all
}

fn left_out(partial_of_sweep: &PartialOfSweep) -> Vec<String> {
    let names = list(partial_of_sweep.left_out.iter().map(|own| {
        let estimate = estimate(&own.influence.formula, own.influence.value);
        format!("{} ({estimate})", own.effect)
    }));
    let most = partial_of_sweep.worst.as_ref().map_or(String::new(), |worst| {
        format!("; `{}` moves by {}, the most of all", worst.measure, apart(worst.most()))
    });
    let names = if names.is_empty() { "nothing".to_owned() } else { names.join(", ") };
    let checked = counted(partial_of_sweep.checked.len(), "point");
    let mut all = vec![format!(
        "left out everywhere: {names}{most}; solved with and without it at {checked} ({})",
        counted(partial_of_sweep.solves, "run")
    )];
    let back: Vec<&str> = partial_of_sweep.put_back.iter().map(|own| own.effect.as_str()).collect();
    if !back.is_empty() {
        all.push(format!("put back, because it matters at one of them: {}", back.join(", ")));
    }
    all
}

/// What could not be evaluated.
pub(super) fn missing(swept: &Swept) -> Vec<String> {
    let at = |own: &Missing| swept.at(own.first);
    unevaluated::sentences(&swept.report.unevaluated(), "point", at)
}
