//! Errors, times and work as tables, and what is to be said in sentences.

use std::time::Duration;

use dashpot_analysis::work_precision::{
    CostFailure, CostPoint, CostReport, Deviation, Spread, Subject, Timing, TrueMeasure,
    Underestimate,
};
use dashpot_report::{
    Columns, Table,
    numbers::{duration, rounded, significant},
};

use crate::{alike, list};

/// What does not exist.
const NONE: &str = "–";
/// What may be smaller, too.
const AT_MOST: &str = "≤";

/// What an error is one of, as readers know it.
pub(super) fn subject(report: &CostReport, subject: Subject) -> &str {
    match subject {
        Subject::State => "state",
        Subject::Events => "events",
        Subject::Measure(at) => report.measures.get(at).map_or("", |measure| measure.key.as_str()),
    }
}

/// A tolerance, or that there is none.
fn tolerance(rtol: Option<f64>) -> String {
    rtol.map_or("–".to_owned(), |rtol| format!("{rtol:e}"))
}

/// An accuracy as it is asked for: in percent, or where it is strict, as a power of ten.
fn wish(accuracy: f64) -> String {
    if accuracy < 1e-5 {
        format!("{accuracy:e}")
    } else {
        format!("{} %", rounded(100.0 * accuracy, "1", 3))
    }
}

/// Errors and times of all solutions.
pub(super) fn errors(report: &CostReport) -> Table {
    let measures = match report.asked.as_slice() {
        [only] => subject(report, Subject::Measure(*only)),
        all if all.len() < report.measures.len() => "asked measures",
        _ => "all measures",
    };
    solutions()
        .column("time", |point| time(point.time.median))
        .column("spread", |point| spread(point.time))
        .column("state", |point| error(point.state))
        .column("events", |point| events(&point.events))
        .column(measures, |point| error(point.largest(&report.asked)))
        .table("Relative errors", &report.points)
}

/// The work of all solutions by steps.
pub(super) fn work(report: &CostReport) -> Table {
    solutions()
        .column("steps", |point| point.work.accepted.to_string())
        .column("rejected", |point| point.work.rejected.to_string())
        .column("rhs", |point| point.work.rhs_calls.to_string())
        .column("Jacobians", |point| point.work.jacobian_calls.to_string())
        .column("LU", |point| point.work.factorizations.to_string())
        .column("solves", |point| point.work.linear_solves.to_string())
        .column("integration", |point| time(point.integration.median))
        .table("Work", report.points.iter().filter(|point| point.work.accepted > 0))
}

/// The columns that name a solution.
fn solutions<'c>() -> Columns<'c, &'c CostPoint> {
    Columns::new()
        .column("method", |point: &&CostPoint| point.method.to_owned())
        .column("rtol", |point| tolerance(point.rtol))
}

/// The cheapest method for each measure at these accuracies.
pub(super) fn cheapest(report: &CostReport, accuracies: &[f64]) -> Table {
    let wishes = accuracies.iter().map(|accuracy| wish(*accuracy));
    let header = ["cheapest for".to_owned()].into_iter().chain(wishes);
    let cell = |places: &[usize], accuracy: f64| {
        let own = report.cheapest_of(places, accuracy);
        own.map_or(NONE.to_owned(), |own| solution(own.method, own.rtol))
    };
    let with_value =
        |own: &&usize| report.measures.get(**own).is_some_and(|measure| measure.value.is_some());
    let row = |&at: &usize| {
        let mut row = vec![subject(report, Subject::Measure(at)).to_owned()];
        row.extend(accuracies.iter().map(|accuracy| cell(&[at], *accuracy)));
        row
    };
    Table::new("The cheapest", header, report.asked.iter().filter(with_value).map(row))
}

/// The error of every measure in every solution.
pub(super) fn measures(report: &CostReport) -> Table {
    let solutions = report.points.iter().map(|own| solution(own.method, own.rtol));
    let header = ["measure".to_owned()].into_iter().chain(solutions);
    let row = |(at, own): (usize, &TrueMeasure)| {
        let mut row = vec![own.key.clone()];
        let deviation =
            |point: &CostPoint| point.measures.get(at).and_then(|measure| measure.deviation);
        row.extend(report.points.iter().map(|point| error(deviation(point))));
        row
    };
    let rows = report.measures.iter().enumerate().map(row);
    Table::new("Relative error of every measure", header, rows)
}

/// A method and its tolerance, where it has one.
fn solution(method: &str, rtol: Option<f64>) -> String {
    rtol.map_or(method.to_owned(), |rtol| format!("{method} {rtol:e}"))
}

/// A time that was measured \[s\].
pub(super) fn time(seconds: f64) -> String {
    duration(Duration::from_secs_f64(seconds.max(0.0)))
}

/// The interquartile range in parts of the median.
fn spread(spread: Spread) -> String {
    format!("{} %", significant((100.0 * spread.relative()).ceil(), 2))
}

fn events(timing: &Timing) -> String {
    match timing.missed + timing.extra {
        0 => error(timing.deviation),
        count => format!("{count} differ"),
    }
}

/// A relative error to two digits, or what it does not exceed.
pub(super) fn error(own: Option<Deviation>) -> String {
    match own {
        None => NONE.to_owned(),
        Some(own) if !own.at_most().is_finite() => {
            if own.value.is_finite() { "unknown" } else { "missing" }.to_owned()
        }
        Some(own) if own.is_resolved() => power(own.value),
        Some(own) => format!("{AT_MOST} {}", power(own.known_within)),
    }
}

/// A small number with one digit behind the point.
pub(super) fn power(value: f64) -> String {
    if value > 0.0 { format!("{value:.1e}") } else { "0".to_owned() }
}

/// More errors that nobody tells of are not listed one by one.
const MOST_GROUPS: usize = 8;
/// Ratios of times up to which a digit costs nothing.
const NOTHING: f64 = 1.05;

/// What errors are taken from.
pub(super) fn reference_notes(report: &CostReport) -> Vec<String> {
    let own = &report.reference;
    let mut notes = Vec::new();
    let name = match own.rtol {
        None => "the exact solution".to_owned(),
        Some(rtol) => format!("`{}` at a tolerance of {rtol:e}", own.method),
    };
    let apart: Vec<String> = [
        ("the state", own.state_agreement),
        ("the times of events", own.event_agreement),
        ("any measure", own.measure_agreement),
    ]
    .into_iter()
    .filter_map(|(what, apart)| Some(format!("{} in {what}", power(apart?))))
    .collect();
    notes.push(match own.witness {
        Some((method, rtol)) => {
            let apart = match apart.as_slice() {
                [] => "nothing that can be compared".to_owned(),
                [only] => only.clone(),
                [first @ .., last] => format!("{} and {last}", first.join(", ")),
            };
            format!(
                "true is {name}; `{method}` at {rtol:e}, a method of another family, differs by \
                 {apart}"
            )
        }
        None => format!("true is {name}; no other method solves this scene"),
    });
    if let Some(why) = &own.why_not_exact {
        notes.push(format!("there is no exact solution: {why}"));
    }
    let always = [
        "times are medians, to solve and to read all measures, with their interquartile range as spread",
        "errors are relative: of the state to the largest value of each unknown, of events to the \
         length of the run; ≤ stands where the truth is not known better",
    ];
    let of_several = "of several measures it is the worst one; `--measure` asks for one, `--out` and \
                      `--json` hold the error of each";
    let of_several = Some(of_several).filter(|_| report.asked.len() > 1);
    notes.extend(always.into_iter().chain(of_several).map(str::to_owned));
    notes
}

/// Methods that decline, and solutions that failed; errors in the same words once.
pub(super) fn failures(report: &CostReport) -> Vec<String> {
    let is_same = |one: &&CostFailure, own: &&CostFailure| {
        let is_alike = one.error == own.error && own.rtol.is_some() && !own.ends;
        one.method == own.method && is_alike
    };
    let sentence = |group: &Vec<&CostFailure>| {
        let (own, rtols) = (group[0], list(group.iter().map(|own| tolerance(own.rtol))));
        let (method, error) = (own.method, &own.error);
        let rest = if own.ends { "; finer tolerances are not tried" } else { "" };
        match own.rtol {
            None => format!("{method}: {error}"),
            Some(_) => format!("{method} at {} failed: {error}{rest}", rtols.join(", ")),
        }
    };
    alike(&report.failures, is_same).iter().map(sentence).collect()
}

/// Errors that a run does not tell of, the largest first; those of one method in one thing are told together.
pub(super) fn underestimated(report: &CostReport) -> Vec<String> {
    let of = |own: &Underestimate| (own.method, own.subject, own.warned, own.error.is_finite());
    let mut groups = alike(&report.underestimates, |one, other| of(one) == of(other));
    let worst = |group: &[&Underestimate]| group.iter().map(|own| own.error).fold(0.0, f64::max);
    groups.sort_by(|one, other| worst(other).total_cmp(&worst(one)));
    let mut lines: Vec<String> =
        groups.iter().take(MOST_GROUPS).map(|group| together(report, group)).collect();
    if let Some(more @ 1..) = groups.len().checked_sub(MOST_GROUPS) {
        lines.push(format!("… {more} more; `--json` has all"));
    }
    lines
}

/// Errors of one method in one thing.
fn together(report: &CostReport, group: &[&Underestimate]) -> String {
    let Some(own) = group.iter().max_by(|one, other| one.error.total_cmp(&other.error)) else {
        return String::new();
    };
    let what = subject(report, own.subject);
    let mut rtols: Vec<f64> = group.iter().filter_map(|own| own.rtol).collect();
    rtols.sort_by(|one, other| other.total_cmp(one));
    let rtols: Vec<String> = rtols.into_iter().map(|rtol| tolerance(Some(rtol))).collect();
    let at = if own.rtol.is_some() { format!(" at {}", rtols.join(", ")) } else { String::new() };
    let most = if group.len() > 1 { "up to " } else { "" };
    let how = match (own.subject, own.bar) {
        (Subject::Events, _) if !own.error.is_finite() => {
            "other events than the true ones".to_owned()
        }
        _ if !own.error.is_finite() => format!("{what} has a value in one solution only"),
        (_, Some(bar)) => {
            let (error, bar) = (power(own.error), power(bar));
            format!("{what} is off by {most}{error} where the bar is {bar}")
        }
        (Subject::Events, None) => format!("events are off by {most}{}", power(own.error)),
        _ => format!("{what} is off by {most}{}", power(own.error)),
    };
    let warned = if own.warned { "; the run warns" } else { "; the run is silent" };
    format!("{}{at}: {how}{warned}", own.method)
}

/// The cheapest method at each accuracy, and what the next digit costs.
pub(super) fn answer(report: &CostReport, accuracies: &[f64]) -> String {
    let which = match report.asked.as_slice() {
        [only] => format!("For {}", subject(report, Subject::Measure(*only))),
        all if all.len() < report.measures.len() => "For the measures asked".to_owned(),
        _ => "For all measures".to_owned(),
    };
    let part = |&accuracy: &f64| {
        let wish = wish(accuracy);
        let Some(point) = report.cheapest(accuracy) else {
            return format!("at {wish} nothing tried reaches it");
        };
        let at = point.rtol.map_or(String::new(), |rtol| format!(" at rtol {rtol:e}"));
        let digit = match report.next_digit(accuracy) {
            None => "the next digit is not reached".to_owned(),
            Some(ratio) if ratio < NOTHING => match report.cheapest(0.1 * accuracy) {
                Some(next) if next.rtol.is_none() => {
                    format!("the next digit costs nothing: `{}` has it", next.method)
                }
                _ => "the next digit costs nothing".to_owned(),
            },
            Some(ratio) => {
                format!("the next digit takes {} times as long", significant(ratio, 2))
            }
        };
        format!("at {wish} it is `{}`{at} in {} ({digit})", point.method, time(point.time.median))
    };
    let parts: Vec<String> = accuracies.iter().map(part).collect();
    format!("{which}, the cheapest method: {}. `auto` chooses `{}`.", parts.join("; "), report.auto)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_below_what_is_known_are_bounds() {
        let of = |value, known_within| error(Some(Deviation { value, known_within }));
        assert_eq!(of(2.34e-5, 1e-9), "2.3e-5");
        assert_eq!(of(2e-10, 1e-9), "≤ 1.0e-9");
        assert_eq!(of(0.0, f64::INFINITY), "unknown");
        assert_eq!(of(f64::INFINITY, 1e-9), "missing");
        assert_eq!(error(None), "–");
    }
    #[test]
    fn accuracies_are_written_as_they_are_asked_for() {
        assert_eq!([1e-2, 1e-3, 5e-4, 1e-6].map(wish), ["1 %", "0.1 %", "0.05 %", "1e-6"]);
    }
}
