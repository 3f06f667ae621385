//! How far measures and events of one run are from those of another, and errors that it does not tell of.

use std::collections::HashMap;

use super::{CostPoint, Deviation, MeasureDeviation, Subject, Timing, Underestimate};
use crate::{Contact, MeasureReport, RunReport, report::over};

/// Differences below so many roundings are none.
const ROUNDINGS: f64 = 64.0;

/// The difference between two values of a measure relative to the true size, or where that is zero, to
/// that of the run: infinite if only one has a value, `None` if neither has.
pub(super) fn apart(reference: &MeasureReport, run: &MeasureReport) -> Option<f64> {
    match (reference.value, run.value) {
        (None, None) => None,
        (Some(reference_value), Some(value)) => {
            Some(over((value - reference_value).abs(), size(reference, run)))
        }
        _ => Some(f64::INFINITY),
    }
}

/// What errors of a measure are relative to.
pub(super) fn size(reference: &MeasureReport, run: &MeasureReport) -> f64 {
    if reference.size > 0.0 { reference.size } else { run.size }
}

/// How well each measure of `truth` is known, relative: its bound where `is_bounded`, else its
/// difference from `witness`; infinite where nothing tells.
pub(super) fn known(
    reference: &[MeasureReport],
    witness: Option<&[MeasureReport]>,
    is_bounded: bool,
) -> Vec<f64> {
    let others: HashMap<&str, &MeasureReport> =
        witness.into_iter().flatten().map(|own| (own.key.as_str(), own)).collect();
    let of = |measure_report: &MeasureReport| {
        let rounding = ROUNDINGS * f64::EPSILON;
        let bound = measure_report.error.filter(|error| is_bounded && error.is_finite());
        let bound = bound.map(|error| over(error, measure_report.size));
        let agreement = || {
            let other = others.get(measure_report.key.as_str())?;
            Some(apart(measure_report, other)?.max(rounding))
        };
        match measure_report.value {
            None => 0.0,
            Some(_) => bound.or_else(agreement).unwrap_or(f64::INFINITY),
        }
    };
    reference.iter().map(of).collect()
}

/// The errors of all measures of `run`, in the order of `truth`.
pub(super) fn measures(
    reference: &[MeasureReport],
    known: &[f64],
    run: &RunReport,
) -> Vec<MeasureDeviation> {
    let others = run.by_key();
    let of = |(own, &known_within): (&MeasureReport, &f64)| {
        let Some(other) = others.get(own.key.as_str()) else {
            return MeasureDeviation { deviation: None, bar: None, warned: false };
        };
        let deviation = apart(own, other).map(|value| Deviation { value, known_within });
        let bar = other.error.map(|error| over(error, size(own, other)));
        let warned = other.excess > 1.0 || other.error.is_some_and(f64::is_infinite);
        MeasureDeviation { deviation, bar, warned }
    };
    reference.iter().zip(known).map(of).collect()
}

/// Error beyond which a run without an error bar is wrong.
const WRONG: f64 = 0.01;

/// What is wrong about a solution beyond what it says itself.
pub(super) fn underestimates(point: &CostPoint) -> Vec<Underestimate> {
    let warned = point.measures.iter().any(|measure| measure.warned);
    let underestimate = |subject, error, bar, warned| Underestimate {
        method: point.method,
        rtol: point.rtol,
        subject,
        error,
        bar,
        warned,
    };
    // Of these a run states no error; a warning about any measure tells of them.
    let is_wrong =
        |deviation: &Deviation| !warned && deviation.is_resolved() && deviation.value > WRONG;
    let state = point.state.filter(is_wrong);
    let state = state.map(|state| underestimate(Subject::State, state.value, None, warned));
    let events = error_of_events(point);
    let events = events
        .filter(is_wrong)
        .map(|event| underestimate(Subject::Events, event.value, None, warned));
    let measures = point.measures.iter().enumerate().filter_map(|(at, own)| {
        let deviation = own.deviation.filter(|deviation| is_untold(deviation, own))?;
        Some(underestimate(Subject::Measure(at), deviation.value, own.bar, own.warned))
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
    let is_felt = point.state.is_none_or(|state| state.value > WRONG);
    is_felt.then_some(Deviation { value: f64::INFINITY, known_within: 0.0 })
}

/// Whether an error is larger than its bar, more than the truth may be off.
fn is_untold(deviation: &Deviation, measure_deviation: &MeasureDeviation) -> bool {
    match measure_deviation.bar {
        Some(bar) => deviation.value > bar + deviation.known_within,
        None => deviation.is_resolved() && deviation.value > WRONG,
    }
}

/// Something that happens at a time.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TimedEvent {
    /// What, without any number that depends on the solution.
    what: String,
    /// When \[s\].
    pub(super) time: f64,
    /// Whether quantities may jump there.
    jumps: bool,
}

/// What switches, what crosses a level that is watched, and glued contacts whose force turns.
pub(super) fn timed_events(report: &RunReport) -> Vec<TimedEvent> {
    let trajectory = &report.trajectory;
    let switches = trajectory.switches.iter().map(|switch| TimedEvent {
        what: format!("{}: {}", switch.name, switch.what),
        time: switch.time,
        jumps: true,
    });
    let crossings = trajectory.events.iter().map(|event| TimedEvent {
        what: format!("condition {}", event.guard),
        time: event.time,
        jumps: false,
    });
    let released =
        |own: &&crate::ContactReport| own.is_glued && own.impact.contact == Contact::Released;
    let releases = report.contacts.iter().filter(released).map(|contact| TimedEvent {
        what: format!("{} turns to tension", contact.element),
        time: contact.impact.end,
        jumps: false,
    });
    switches.chain(crossings).chain(releases).collect()
}

/// How two runs compare in what happens: the first of a kind with the first, and so on.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Match {
    /// The largest difference of a time \[s\] of those events that both have; `None` where they have none.
    pub(super) apart: Option<f64>,
    /// Events of the first run that the second one has not.
    pub(super) missed: usize,
    /// Events of the second run that the first one has not.
    pub(super) extra: usize,
    /// The times between a jump in one run and the same jump in the other \[s\], in order. Where they
    /// are as far apart as half the way to the next one of the kind, they are not the same.
    pub(super) jumps: Vec<(f64, f64)>,
}

/// Matches the events of `run` with those of the reference solution.
pub(super) fn matched(reference: &[TimedEvent], run: &[TimedEvent]) -> Match {
    let mut found = Match::default();
    let mut kinds: Vec<&str> = reference.iter().chain(run).map(|own| own.what.as_str()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for kind in kinds {
        let of = |all: &[TimedEvent]| -> Vec<(f64, bool)> {
            let same = all.iter().filter(|own| own.what == kind);
            same.map(|same| (same.time, same.jumps)).collect()
        };
        let (one, other) = (of(reference), of(run));
        for (at, (&(time, jumps), &(in_run, _))) in one.iter().zip(&other).enumerate() {
            let apart = (time - in_run).abs();
            found.apart = Some(found.apart.unwrap_or(0.0).max(apart));
            let before = at.checked_sub(1).and_then(|at| one.get(at));
            let neighbours = before.into_iter().chain(one.get(at + 1));
            let is_same = |other: &(f64, bool)| apart <= 0.5 * (time - other.0).abs();
            if jumps && neighbours.into_iter().all(is_same) {
                found.jumps.push((time.min(in_run), time.max(in_run)));
            }
        }
        found.missed += one.len().saturating_sub(other.len());
        found.extra += other.len().saturating_sub(one.len());
    }
    found.jumps.sort_by(|one, other| one.0.total_cmp(&other.0));
    found
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
        underestimates(point).iter().map(|underestimate| underestimate.subject).collect()
    }

    #[test]
    fn an_error_beyond_its_bar_is_an_underestimate_and_one_within_is_none() {
        assert_eq!(subjects(&point(2e-4, Some(1e-4))), [Subject::Measure(0)]);
        assert!(subjects(&point(2e-4, Some(3e-4))).is_empty());
        assert!(subjects(&point(5e-10, Some(1e-12))).is_empty(), "the truth is not known so well");
    }

    #[test]
    fn without_a_bar_one_percent_is_an_underestimate() {
        assert!(subjects(&point(0.009, None)).is_empty());
        assert_eq!(subjects(&point(0.011, None)), [Subject::State, Subject::Measure(0)]);
    }

    #[test]
    fn an_event_that_is_missing_is_an_underestimate_where_the_state_feels_it() {
        let mut own = point(0.0, None);
        own.events.missed = 1;
        assert!(subjects(&own).is_empty());
        own.state = None;
        assert_eq!(subjects(&own), [Subject::Events]);
    }
}

#[cfg(test)]
mod event_tests {
    use super::*;

    fn at(what: &str, time: f64) -> TimedEvent {
        TimedEvent { what: what.to_owned(), time, jumps: true }
    }

    #[test]
    fn events_are_matched_by_kind_and_order() {
        let reference = [at("closes", 1.0), at("opens", 2.0), at("closes", 3.0)];
        let run = [at("opens", 2.25), at("closes", 1.0), at("closes", 2.875)];
        let own = matched(&reference, &run);
        assert_eq!((own.apart, own.missed, own.extra), (Some(0.25), 0, 0));
        assert_eq!(own.jumps, [(1.0, 1.0), (2.0, 2.25), (2.875, 3.0)]);
    }

    #[test]
    fn jumps_that_are_nearer_to_the_next_one_are_not_the_same() {
        let reference = [at("opens", 1.0), at("opens", 2.0), at("opens", 3.0)];
        let own = matched(&reference, &[at("opens", 1.25), at("opens", 3.0)]);
        assert_eq!((own.jumps, own.missed), (vec![(1.0, 1.25)], 1));
    }

    #[test]
    fn events_that_only_one_run_has_are_counted() {
        let reference = [at("closes", 1.0), at("opens", 2.0)];
        let own = matched(&reference, &[at("closes", 1.0), at("sticks", 1.0)]);
        assert_eq!((own.apart, own.missed, own.extra), (Some(0.0), 1, 1));
        assert_eq!(matched(&[], &[]), Match::default());
    }
}
