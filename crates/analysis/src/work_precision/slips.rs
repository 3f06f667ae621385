//! Errors that a run does not tell of.

use super::{CostPoint, Deviation, MeasureDeviation, Slip, Subject, Timing};

/// Error beyond which a run without an error bar is wrong.
const WRONG: f64 = 0.01;

/// What is wrong about a solution beyond what it says itself.
pub(super) fn slips(point: &CostPoint) -> Vec<Slip> {
    let warned = point.measures.iter().any(|own| own.warned);
    let slip = |subject, error, bar, warned| Slip {
        method: point.method,
        rtol: point.rtol,
        subject,
        error,
        bar,
        warned,
    };
    // Of these a run states no error; a warning about any measure tells of them.
    let is_wrong = |own: &Deviation| !warned && own.is_resolved() && own.value > WRONG;
    let state = point.state.filter(is_wrong);
    let state = state.map(|own| slip(Subject::State, own.value, None, warned));
    let events = error_of_events(point);
    let events = events.filter(is_wrong).map(|own| slip(Subject::Events, own.value, None, warned));
    let measures = point.measures.iter().enumerate().filter_map(|(at, own)| {
        let deviation = own.deviation.filter(|deviation| is_untold(deviation, own))?;
        Some(slip(Subject::Measure(at), deviation.value, own.bar, own.warned))
    });
    state.into_iter().chain(events).chain(measures).collect()
}

/// The error of the times of events; infinite where one is missing or there is one too many, and that
/// is felt in the state: touches that move nothing any more are below what a tolerance resolves.
fn error_of_events(point: &CostPoint) -> Option<Deviation> {
    let Timing { deviation, missed, extra } = point.events;
    if missed + extra == 0 {
        return deviation;
    }
    let is_felt = point.state.is_none_or(|own| own.value > WRONG);
    is_felt.then_some(Deviation { value: f64::INFINITY, known_within: 0.0 })
}

/// Whether an error is larger than its bar, more than the truth may be off.
fn is_untold(deviation: &Deviation, own: &MeasureDeviation) -> bool {
    match own.bar {
        Some(bar) => deviation.value > bar + deviation.known_within,
        None => deviation.is_resolved() && deviation.value > WRONG,
    }
}

#[cfg(test)]
mod tests {
    use dashpot_dae::Statistics;

    use super::*;
    use crate::work_precision::Spread;

    fn point(value: f64, bar: Option<f64>) -> CostPoint {
        let spread = Spread { median: 1.0, lower: 1.0, upper: 1.0 };
        let deviation = Some(Deviation { value, known_within: 1e-9 });
        CostPoint {
            method: "bdf",
            rtol: Some(1e-4),
            work: Statistics::default(),
            time: spread,
            integration: spread,
            repeats: 1,
            state: deviation,
            events: Timing { deviation: None, missed: 0, extra: 0 },
            measures: vec![MeasureDeviation { deviation, bar, warned: false }],
        }
    }

    fn subjects(point: &CostPoint) -> Vec<Subject> {
        slips(point).iter().map(|own| own.subject).collect()
    }

    #[test]
    fn an_error_beyond_its_bar_is_a_slip_and_one_within_is_none() {
        assert_eq!(subjects(&point(2e-4, Some(1e-4))), [Subject::Measure(0)]);
        assert!(subjects(&point(2e-4, Some(3e-4))).is_empty());
        assert!(subjects(&point(5e-10, Some(1e-12))).is_empty(), "the truth is not known so well");
    }

    #[test]
    fn without_a_bar_one_percent_is_a_slip() {
        assert!(subjects(&point(0.009, None)).is_empty());
        assert_eq!(subjects(&point(0.011, None)), [Subject::State, Subject::Measure(0)]);
    }

    #[test]
    fn an_event_that_is_missing_is_a_slip_where_the_state_feels_it() {
        let mut own = point(0.0, None);
        own.events.missed = 1;
        assert!(subjects(&own).is_empty());
        own.state = None;
        assert_eq!(subjects(&own), [Subject::Events]);
    }
}
