//! The object of what accuracy costs.

use std::collections::BTreeMap;

use dashpot_analysis::work_precision::{CostPoint, CostReport, Subject};
use serde::Serialize;

use super::{Costs, subject};
use crate::output::{VERSION, list, object};

/// All that was found, with the cheapest methods for each accuracy.
pub(super) fn object(costs: &Costs) -> impl Serialize {
    let Costs { scene, report, accuracies } = costs;
    let measures = report.measures.iter().map(|measure| {
        let (value, unit, size, known_within) =
            (measure.value, measure.unit, measure.size, measure.known_within);
        (measure.key.as_str(), object! { value, unit, size, known_within })
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
        failures: list(report.failures.iter().map(|failure| object! {
            method: failure.method,
            rtol: failure.rtol,
            error: failure.error.to_string(),
            finer_tried: !failure.ends,
        })),
        silent: list(report.slips.iter().map(|slip| object! {
            method: slip.method,
            rtol: slip.rtol,
            what: subject(report, slip.subject),
            error: slip.error,
            bar: slip.bar,
            warned: slip.warned,
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

fn point(report: &CostReport, cost_point: &CostPoint) -> impl Serialize {
    let reached = cost_point.measures.iter().map(|measure| {
        object! {
            error: measure.deviation.map(|deviation| deviation.value),
            known_within: measure.deviation.map(|deviation| deviation.known_within),
            bar: measure.bar,
            warned: measure.warned,
        }
    });
    let keys = report.measures.iter().map(|measure| measure.key.as_str());
    object! {
        method: cost_point.method,
        rtol: cost_point.rtol,
        time_s: cost_point.time,
        integration_s: cost_point.integration,
        repeats: cost_point.repeats,
        accepted: cost_point.work.accepted,
        rejected: cost_point.work.rejected,
        rhs_calls: cost_point.work.rhs_calls,
        jacobian_calls: cost_point.work.jacobian_calls,
        factorizations: cost_point.work.factorizations,
        linear_solves: cost_point.work.linear_solves,
        state: cost_point.state,
        events: cost_point.events,
        measures: keys.zip(reached).collect::<BTreeMap<_, _>>(),
    }
}

/// The cheapest method, and how many times as long ten times the accuracy takes.
fn cheapest(report: &CostReport, accuracy: f64) -> impl Serialize + use<> {
    let point = report.cheapest(accuracy);
    object! {
        accuracy,
        method: point.map(|point| point.method),
        rtol: point.and_then(|point| point.rtol),
        time_s: point.map(|point| point.time.median),
        next_digit: report.next_digit(accuracy),
    }
}
