//! The object that `cost --json` prints, in SI units. What is infinite or missing is null.

use std::collections::BTreeMap;

use dashpot_analysis::cost::{
    CostFailure, CostPoint, CostReport, Deviation, MeasureDeviation, Slip, Spread, Subject,
};
use dashpot_scene::Scene;
use serde::Serialize;

use super::subject;

/// All that was found.
#[derive(Serialize)]
pub(crate) struct Document<'a> {
    dashpot: &'static str,
    title: Option<&'a str>,
    file: Option<&'a str>,
    truth: Truth,
    /// The method that `auto` chooses.
    auto: &'static str,
    /// The measures by which methods are ranked.
    asked: Vec<&'a str>,
    measures: BTreeMap<&'a str, Measure>,
    points: Vec<Point<'a>>,
    failures: Vec<Failure>,
    silent: Vec<Untold<'a>>,
    cheapest: Vec<Cheapest>,
}

#[derive(Serialize)]
struct Truth {
    method: &'static str,
    rtol: Option<f64>,
    why_not_exact: Option<String>,
    witness: Option<Witness>,
    agreement: Agreement,
}

#[derive(Serialize)]
struct Witness {
    method: &'static str,
    rtol: f64,
}

/// How far truth and witness differ, relative.
#[derive(Serialize)]
struct Agreement {
    state: Option<f64>,
    events: Option<f64>,
    measures: Option<f64>,
}

#[derive(Serialize)]
struct Measure {
    value: Option<f64>,
    unit: &'static str,
    size: f64,
    known_within: f64,
}

#[derive(Serialize)]
struct Point<'a> {
    method: &'static str,
    rtol: Option<f64>,
    time_s: Time,
    integration_s: Time,
    repeats: usize,
    accepted: usize,
    rejected: usize,
    rhs_calls: usize,
    jacobian_calls: usize,
    factorizations: usize,
    linear_solves: usize,
    state: Option<Error>,
    events: Events,
    measures: BTreeMap<&'a str, Reached>,
}

#[derive(Serialize)]
struct Time {
    median: f64,
    lower_quartile: f64,
    upper_quartile: f64,
}

/// A relative error, and how well the truth is known.
#[derive(Serialize)]
struct Error {
    error: f64,
    known_within: f64,
}

#[derive(Serialize)]
struct Events {
    #[serde(flatten)]
    times: Option<Error>,
    missed: usize,
    extra: usize,
}

#[derive(Serialize)]
struct Reached {
    error: Option<f64>,
    known_within: Option<f64>,
    bar: Option<f64>,
    warned: bool,
}

#[derive(Serialize)]
struct Failure {
    method: &'static str,
    rtol: Option<f64>,
    error: String,
    finer_tried: bool,
}

#[derive(Serialize)]
struct Untold<'a> {
    method: &'static str,
    rtol: Option<f64>,
    what: &'a str,
    /// Null where a value or an event is missing.
    error: f64,
    bar: Option<f64>,
    warned: bool,
}

#[derive(Serialize)]
struct Cheapest {
    accuracy: f64,
    method: Option<&'static str>,
    rtol: Option<f64>,
    time_s: Option<f64>,
    /// How many times as long ten times the accuracy takes.
    next_digit: Option<f64>,
}

impl From<Spread> for Time {
    fn from(own: Spread) -> Self {
        Self { median: own.median, lower_quartile: own.lower, upper_quartile: own.upper }
    }
}

impl From<Deviation> for Error {
    fn from(own: Deviation) -> Self {
        Self { error: own.value, known_within: own.known_within }
    }
}

/// The whole object; the cheapest methods are those for these accuracies.
pub(crate) fn document<'a>(
    scene: &'a Scene,
    report: &'a CostReport,
    accuracies: &[f64],
) -> Document<'a> {
    let own = &report.truth;
    let measures = report.measures.iter().map(|own| {
        let (value, unit, size, known_within) = (own.value, own.unit, own.size, own.known_within);
        (own.key.as_str(), Measure { value, unit, size, known_within })
    });
    let asked = report.asked.iter().map(|&at| subject(report, Subject::Measure(at)));
    let cheapest = accuracies.iter().map(|&accuracy| {
        let point = report.cheapest(accuracy);
        Cheapest {
            accuracy,
            method: point.map(|own| own.method),
            rtol: point.and_then(|own| own.rtol),
            time_s: point.map(|own| own.time.median),
            next_digit: report.next_digit(accuracy),
        }
    });
    Document {
        dashpot: env!("CARGO_PKG_VERSION"),
        title: scene.title.as_deref(),
        file: scene.file.as_deref(),
        truth: Truth {
            method: own.method,
            rtol: own.rtol,
            why_not_exact: own.why_not_exact.as_ref().map(ToString::to_string),
            witness: own.witness.map(|(method, rtol)| Witness { method, rtol }),
            agreement: Agreement {
                state: own.state_agreement,
                events: own.event_agreement,
                measures: own.measure_agreement,
            },
        },
        auto: report.auto,
        asked: asked.collect(),
        measures: measures.collect(),
        points: report.points.iter().map(|own| point(report, own)).collect(),
        failures: report.failures.iter().map(failure).collect(),
        silent: report.slips.iter().map(|own| untold(report, own)).collect(),
        cheapest: cheapest.collect(),
    }
}

fn point<'a>(report: &'a CostReport, own: &CostPoint) -> Point<'a> {
    let reached = |own: &MeasureDeviation| Reached {
        error: own.deviation.map(|own| own.value),
        known_within: own.deviation.map(|own| own.known_within),
        bar: own.bar,
        warned: own.warned,
    };
    let keys = report.measures.iter().map(|own| own.key.as_str());
    Point {
        method: own.method,
        rtol: own.rtol,
        time_s: own.time.into(),
        integration_s: own.integration.into(),
        repeats: own.repeats,
        accepted: own.work.accepted,
        rejected: own.work.rejected,
        rhs_calls: own.work.rhs_calls,
        jacobian_calls: own.work.jacobian_calls,
        factorizations: own.work.factorizations,
        linear_solves: own.work.linear_solves,
        state: own.state.map(Error::from),
        events: Events {
            times: own.events.deviation.map(Error::from),
            missed: own.events.missed,
            extra: own.events.extra,
        },
        measures: keys.zip(own.measures.iter().map(reached)).collect(),
    }
}

fn failure(own: &CostFailure) -> Failure {
    let error = own.error.to_string();
    Failure { method: own.method, rtol: own.rtol, error, finer_tried: !own.ends }
}

fn untold<'a>(report: &'a CostReport, own: &Slip) -> Untold<'a> {
    Untold {
        method: own.method,
        rtol: own.rtol,
        what: subject(report, own.subject),
        error: own.error,
        bar: own.bar,
        warned: own.warned,
    }
}
