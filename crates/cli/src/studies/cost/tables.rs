//! Errors, times and work as tables.

use std::time::Duration;

use dashpot_analysis::work_precision::{
    CostPoint, CostReport, Deviation, Spread, Subject, Timing, TrueMeasure,
};
use dashpot_plot::Table;

use super::{subject, tolerance, wish};
use crate::numbers::{duration, significant};

/// What does not exist.
const NONE: &str = "–";
/// What may be smaller, too.
const AT_MOST: &str = "≤";

/// Errors and times of all solutions.
pub(super) fn errors(report: &CostReport) -> Table {
    let row = |cost_point: &CostPoint| {
        let worst = cost_point.worst_place(&report.asked);
        let worst = worst.and_then(|at| cost_point.measures.get(at)?.deviation);
        vec![
            cost_point.method.to_owned(),
            tolerance(cost_point.rtol),
            time(cost_point.time.median),
            spread(cost_point.time),
            error(cost_point.state),
            events(&cost_point.events),
            error(worst),
        ]
    };
    let measures = match report.asked.as_slice() {
        [only] => subject(report, Subject::Measure(*only)),
        all if all.len() < report.measures.len() => "asked measures",
        _ => "all measures",
    };
    Table::new(
        "Relative errors",
        &["method", "rtol", "time", "spread", "state", "events", measures],
        report.points.iter().map(row),
    )
}

/// The work of all solutions by steps.
pub(super) fn work(report: &CostReport) -> Table {
    let steps = report.points.iter().filter(|point| point.work.accepted > 0);
    let row = |cost_point: &CostPoint| {
        let work = &cost_point.work;
        let mut row = vec![cost_point.method.to_owned(), tolerance(cost_point.rtol)];
        let counts = [
            work.accepted,
            work.rejected,
            work.rhs_calls,
            work.jacobian_calls,
            work.factorizations,
            work.linear_solves,
        ];
        row.extend(counts.map(|count| count.to_string()));
        row.push(time(cost_point.integration.median));
        row
    };
    Table::new(
        "Work",
        &["method", "rtol", "steps", "rejected", "rhs", "Jacobians", "LU", "solves", "integration"],
        steps.map(row),
    )
}

/// The cheapest method for each measure at these accuracies.
pub(super) fn cheapest(report: &CostReport, accuracies: &[f64]) -> Table {
    let mut header = vec!["cheapest for".to_owned()];
    header.extend(accuracies.iter().map(|accuracy| wish(*accuracy)));
    let cell = |places: &[usize], accuracy: f64| match report.cheapest_of(places, accuracy) {
        Some(own) => match own.rtol {
            Some(rtol) => format!("{} {rtol:e}", own.method),
            None => own.method.to_owned(),
        },
        None => NONE.to_owned(),
    };
    let with_value =
        |own: &&usize| report.measures.get(**own).is_some_and(|measure| measure.value.is_some());
    let row = |&at: &usize| {
        let mut row = vec![subject(report, Subject::Measure(at)).to_owned()];
        row.extend(accuracies.iter().map(|accuracy| cell(&[at], *accuracy)));
        row
    };
    let rows = report.asked.iter().filter(with_value).map(row).collect();
    Table { caption: "The cheapest".to_owned(), header, rows }
}

/// The error of every measure in every solution.
pub(super) fn measures(report: &CostReport) -> Table {
    let mut header = vec!["measure".to_owned()];
    header.extend(report.points.iter().map(|point| match point.rtol {
        Some(rtol) => format!("{} {rtol:e}", point.method),
        None => point.method.to_owned(),
    }));
    let row = |(at, own): (usize, &TrueMeasure)| {
        let mut row = vec![own.key.clone()];
        let deviation =
            |point: &CostPoint| point.measures.get(at).and_then(|measure| measure.deviation);
        row.extend(report.points.iter().map(|point| error(deviation(point))));
        row
    };
    let rows = report.measures.iter().enumerate().map(row).collect();
    Table { caption: "Relative error of every measure".to_owned(), header, rows }
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
}
