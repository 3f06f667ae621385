//! The solutions that errors are taken from.

use std::sync::Arc;

use dashpot_dae::{MethodKind, SolveError, methods};
use dashpot_network::Assembly;

use super::{
    Deviation, MeasureDeviation, ReferenceSolution, Subject, Timing, TrueMeasure, Underestimate,
    declines,
    deviation::{Match, TimedEvent, apart, known, matched, measures, size, timed_events},
    states::{Probe, States},
    watch::Watch,
};
use crate::{
    MeasureReport, RunError, RunReport, SolveSettings, SolverReport, measures::selection::select,
    report::over, solve_assembly,
};

/// Solutions that a truth takes.
pub(super) const PARTS: usize = 2;
/// Part of the work that is left, one in so many, that each of them may take.
const OF_ALL: usize = 4;
/// Tolerances of the solutions by steps: the first at which a method succeeds counts.
const TIGHT: [f64; 4] = [1e-12, 1e-11, 1e-10, 1e-9];
/// The methods that may give a reference, with their families, in the order in which they are tried.
const FAMILIES: [(&str, Family); 5] = [
    (methods::Bdf::KIND, Family::Multistep),
    (methods::Esdirk34::KIND, Family::Implicit),
    (methods::Dop853::KIND, Family::Explicit),
    (methods::Tsit45::KIND, Family::Explicit),
    (methods::TrBdf2::KIND, Family::Implicit),
];

/// Families of methods, whose errors have nothing to do with each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Family {
    Multistep,
    /// Runge and Kutta, implicit.
    Implicit,
    /// Runge and Kutta, explicit.
    Explicit,
}

/// What is kept of a solution.
struct Told {
    solver: SolverReport,
    measures: Vec<MeasureReport>,
}

impl From<RunReport> for Told {
    fn from(report: RunReport) -> Self {
        Self { solver: report.solver, measures: report.measures }
    }
}

/// What is true, and how well it is known.
pub(super) struct Judge<'a> {
    probe: Probe<'a>,
    /// What is told of the solution and of the other one; they themselves take much memory.
    report: Told,
    witness: Option<Told>,
    why_not_exact: Option<RunError>,
    events: Vec<TimedEvent>,
    states: States,
    /// Length of the run \[s\].
    duration: f64,
    state_agreement: Option<f64>,
    witnessed: Match,
    measures_known: Vec<f64>,
}

impl<'a> Judge<'a> {
    /// Solves the scene exactly, or by a method with the tightest tolerance, and by another one.
    pub(super) fn find(
        assembly: &'a Arc<Assembly>,
        settings: &SolveSettings,
        watch: &mut Watch<'_>,
    ) -> Result<Self, RunError> {
        watch.begin(0);
        let exact = settings.clone().by(methods::Exact);
        let most_work = watch.share(OF_ALL);
        let limited = watch.limited(true, usize::MAX, most_work);
        let exact = solve_assembly(assembly, &[], &exact, limited);
        let exact = exact.map_err(|error| watch.told(methods::Exact::KIND, error));
        let (report, why_not_exact, family) = match exact {
            Ok(report) => (report, None, None),
            Err(error) if is_final(&error) => return Err(error),
            Err(error) => {
                let limits = (watch.share(OF_ALL), &mut *watch);
                let (report, family) = reference_solution(assembly, settings, None, limits)?;
                (report, Some(error), Some(family))
            }
        };
        watch.begin(1);
        let limits = (watch.share(OF_ALL), &mut *watch);
        let witness = reference_solution(assembly, settings, family, limits);
        let witness = match (witness, family) {
            (Ok((report, _)), _) => Some(report),
            // The exact solution states its own errors.
            (Err(error), None) if !is_final(&error) => None,
            (Err(error), _) => return Err(error),
        };
        let probe = Probe::new(assembly, &select(assembly, &settings.measures, &settings.limits)?);
        let events = timed_events(&report);
        let times: Vec<f64> = events.iter().map(|event| event.time).collect();
        let states = probe.states(&report.trajectory, &times);
        let witnessed = witness.as_ref().map(|witness| matched(&events, &timed_events(witness)));
        let witnessed = witnessed.unwrap_or_default();
        let state_agreement = witness
            .as_ref()
            .and_then(|witness| probe.difference(&states, &witness.trajectory, &witnessed.jumps));
        let witness = witness.map(Told::from);
        let others = witness.as_ref().map(|witness| witness.measures.as_slice());
        let measures_known = known(&report.measures, others, family.is_none());
        Ok(Self {
            probe,
            events,
            states,
            duration: settings.duration,
            state_agreement,
            witnessed,
            measures_known,
            report: report.into(),
            witness,
            why_not_exact,
        })
    }

    /// Where the truth comes from.
    pub(super) fn reference(&self) -> ReferenceSolution {
        let solver = &self.report.solver;
        let witness = self.witness.as_ref();
        let apart = witness.iter().flat_map(|witness| {
            let pairs = self.report.measures.iter().zip(&witness.measures);
            pairs.filter_map(|(own, other)| apart(own, other))
        });
        ReferenceSolution {
            method: solver.method,
            rtol: solver.rtol,
            why_not_exact: self.why_not_exact.clone(),
            witness: witness
                .and_then(|witness| Some((witness.solver.method, witness.solver.rtol?))),
            state_agreement: self.state_agreement,
            event_agreement: self.witnessed.apart.map(|apart| self.relative(apart)),
            measure_agreement: apart.reduce(f64::max),
        }
    }

    /// The measures and how well they are known.
    pub(super) fn measures(&self) -> Vec<TrueMeasure> {
        let all = self.report.measures.iter().zip(&self.measures_known);
        all.map(|(own, &known_within)| TrueMeasure {
            key: own.key.clone(),
            unit: own.unit,
            value: own.value,
            size: own.size,
            known_within,
        })
        .collect()
    }

    /// Where the two solutions differ by more than both of their error bars, and events that only one of them has.
    pub(super) fn contradictions(&self) -> Vec<Underestimate> {
        let Some(witness) = &self.witness else { return Vec::new() };
        let underestimate = |subject, error, bar| Underestimate {
            method: witness.solver.method,
            rtol: witness.solver.rtol,
            subject,
            error,
            bar,
            warned: false,
        };
        let pairs = self.report.measures.iter().zip(&witness.measures).enumerate();
        let measures = pairs.filter_map(|(at, (own, other))| {
            let bar = over(own.error? + other.error?, size(own, other));
            let apart = apart(own, other).filter(|apart| *apart > bar)?;
            Some(underestimate(Subject::Measure(at), apart, Some(bar)))
        });
        let is_other = self.witnessed.missed + self.witnessed.extra > 0;
        let events = is_other.then(|| underestimate(Subject::Events, f64::INFINITY, None));
        events.into_iter().chain(measures).collect()
    }

    /// The errors of a run in the state, the times of events, and the measures.
    pub(super) fn errors(
        &self,
        run: &RunReport,
    ) -> (Option<Deviation>, Timing, Vec<MeasureDeviation>) {
        let own = matched(&self.events, &timed_events(run));
        let state = self.probe.difference(&self.states, &run.trajectory, &own.jumps);
        let known_within = self.states.bound.or(self.state_agreement).unwrap_or(f64::INFINITY);
        let state = state.map(|value| Deviation { value, known_within });
        let known_within = self.witnessed.apart.map_or(f64::INFINITY, |apart| self.relative(apart));
        let deviation =
            own.apart.map(|apart| Deviation { value: self.relative(apart), known_within });
        let events = Timing { deviation, missed: own.missed, extra: own.extra };
        (state, events, measures(&self.report.measures, &self.measures_known, run))
    }

    /// A time in parts of the run.
    fn relative(&self, time: f64) -> f64 {
        over(time, self.duration)
    }
}

/// The first solution by steps that succeeds, of a family other than `but`.
fn reference_solution(
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    but: Option<Family>,
    (most_work, watch): (usize, &mut Watch<'_>),
) -> Result<(RunReport, Family), RunError> {
    let mut last = None;
    for (method, family) in FAMILIES.into_iter().filter(|own| Some(own.1) != but) {
        for rtol in TIGHT {
            let own = SolveSettings { rtol: Some(rtol), ..settings.clone() }.by_name(method)?;
            let limited = watch.limited(false, usize::MAX, most_work);
            let solved = solve_assembly(assembly, &[], &own, limited);
            match solved.map_err(|error| watch.told(method, error)) {
                Ok(report) => return Ok((report, family)),
                Err(error) if is_final(&error) => return Err(error),
                Err(error) if declines(&error) || matches!(error, RunError::TooMuchWork { .. }) => {
                    last = Some(error);
                    break;
                }
                Err(error) => last = Some(error),
            }
        }
    }
    Err(last.unwrap_or_else(|| {
        SolveError::NotApplicable {
            method: methods::Auto::KIND,
            reason: "there is no method of another family".to_owned(),
        }
        .into()
    }))
}

/// Whether no other method would do better.
fn is_final(error: &RunError) -> bool {
    match error {
        RunError::Solve(error) => {
            matches!(error, SolveError::Cancelled { .. } | SolveError::InvalidSetting { .. })
        }
        RunError::EnergyLost { .. } | RunError::Slider { .. } | RunError::TooMuchWork { .. } => {
            false
        }
        _ => true,
    }
}
