//! The object of what accuracy costs.

use std::collections::BTreeMap;

use dashpot_analysis::work_precision::{CostPoint, CostReport, Subject};
use serde::Serialize;

use super::{Costs, subject};
use crate::output::{VERSION, list, object};

/// All that was found, with the cheapest methods for each accuracy.
pub(super) fn object(costs: &Costs) -> impl Serialize {
    let Costs { scene, report, accuracies } = costs;
    let measures = report.measures.iter().map(|own| {
        let (value, unit, size, known_within) = (own.value, own.unit, own.size, own.known_within);
        (own.key.as_str(), object! { value, unit, size, known_within })
    });
    object! {
        dashpot: VERSION,
        title: &scene.title,
        file: &scene.file,
        truth: truth(report),
        auto: report.auto,
        asked: list(report.asked.iter().map(|&at| subject(report, Subject::Measure(at)))),
        measures: measures.collect::<BTreeMap<_, _>>(),
        points: list(report.points.iter().map(|own| point(report, own))),
        failures: list(report.failures.iter().map(|own| object! {
            method: own.method,
            rtol: own.rtol,
            error: own.error.to_string(),
            finer_tried: !own.ends,
        })),
        silent: list(report.slips.iter().map(|own| object! {
            method: own.method,
            rtol: own.rtol,
            what: subject(report, own.subject),
            error: own.error,
            bar: own.bar,
            warned: own.warned,
        })),
        cheapest: list(accuracies.iter().map(|&accuracy| cheapest(report, accuracy))),
    }
}

fn truth(report: &CostReport) -> impl Serialize {
    let own = &report.truth;
    object! {
        method: own.method,
        rtol: own.rtol,
        why_not_exact: own.why_not_exact.as_ref().map(ToString::to_string),
        witness: own.witness.map(|(method, rtol)| object! { method, rtol }),
        agreement: object! {
            state: own.state_agreement,
            events: own.event_agreement,
            measures: own.measure_agreement,
        },
    }
}

fn point(report: &CostReport, own: &CostPoint) -> impl Serialize {
    let reached = own.measures.iter().map(|own| {
        object! {
            error: own.deviation.map(|own| own.value),
            known_within: own.deviation.map(|own| own.known_within),
            bar: own.bar,
            warned: own.warned,
        }
    });
    let keys = report.measures.iter().map(|own| own.key.as_str());
    object! {
        method: own.method,
        rtol: own.rtol,
        time_s: own.time,
        integration_s: own.integration,
        repeats: own.repeats,
        accepted: own.work.accepted,
        rejected: own.work.rejected,
        rhs_calls: own.work.rhs_calls,
        jacobian_calls: own.work.jacobian_calls,
        factorizations: own.work.factorizations,
        linear_solves: own.work.linear_solves,
        state: own.state,
        events: own.events,
        measures: keys.zip(reached).collect::<BTreeMap<_, _>>(),
    }
}

/// The cheapest method, and how many times as long ten times the accuracy takes.
fn cheapest(report: &CostReport, accuracy: f64) -> impl Serialize + use<> {
    let point = report.cheapest(accuracy);
    object! {
        accuracy,
        method: point.map(|own| own.method),
        rtol: point.and_then(|own| own.rtol),
        time_s: point.map(|own| own.time.median),
        next_digit: report.next_digit(accuracy),
    }
}
