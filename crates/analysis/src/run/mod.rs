//! From a compiled network to the report of its run: methods, budget, one attempt after the other.

pub(crate) mod attempts;

mod events;
mod outcome;
mod preloads;
mod warnings;

use std::{collections::BTreeSet, sync::Arc, time::Instant};

use dashpot_dae::{Budget, Guard, Method, MethodKind, Observer, Run, Trajectory, methods};
use dashpot_network::{Assembly, Network};

use self::{attempts::Found, outcome::report};
use crate::{
    Choice, ContactReport, Note, RunError, RunReport, Solution, SolveSettings, Stop,
    errors::solved::{Task, keep, keep_also},
    measures::selection::{Selected, select},
    memory, threshold_at,
};

/// Tolerance of a single solution whose error is not estimated, when none is given.
const SINGLE: f64 = 1e-6;

/// Integrates a network that is compiled already, and reports; otherwise as [`Solve`](crate::Solve). `effects`
/// are the words of those that are on.
///
/// # Errors
///
/// As [`Solve`](crate::Solve), but for the network.
pub fn solve_assembly(
    assembly: &Arc<Assembly>,
    effects: &[&'static str],
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    solve_bounded(assembly, effects, settings, settings.estimate, observer)
}

/// The same; signals of a method that bounds its errors have theirs, or may have none.
pub(crate) fn solve_bounded(
    assembly: &Arc<Assembly>,
    effects: &[&'static str],
    settings: &SolveSettings,
    is_bounded: bool,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    let started = Instant::now();
    settings.validate()?;
    let selected = select(assembly, &settings.measures, &settings.limits)?;
    check_keys(settings, &selected)?;
    // Each attempt is by a method of its own.
    let (selected, method) = (&selected[..], &methods::Auto);
    let task = Task { assembly, settings, selected, method, is_judged: true };
    let (found, run) = found(assembly, &task, (&BTreeSet::new(), is_bounded), observer)?;
    let work = run.budget.done();
    run.budget.close();
    let Found { method, why, outcome } = found;
    let task = Task { method: method.as_ref(), ..task };
    let mut report = report(assembly, effects, &task, &run, outcome)?;
    report.solver.work = work;
    report.solver.wall_in_all = started.elapsed();
    report.solver.why = match report.trajectory.digest() {
        Some(_) => {
            format!("{why}; only what the measures need is kept of so large a solution")
        }
        None => why,
    };
    Ok(report)
}

/// A solution of which signals alone are asked for.
#[derive(Debug)]
pub struct Signals {
    /// The compiled network.
    pub assembly: Arc<Assembly>,
    /// The solution.
    pub trajectory: Trajectory,
    /// The tolerance of its method, if that has one.
    pub rtol: Option<f64>,
}

impl Signals {
    /// What reads it.
    pub fn solution(&self) -> Solution<'_> {
        Solution::new(&self.assembly, &self.trajectory).doubting(threshold_at(self.rtol))
    }

    /// The contacts of the elements that touch an impactor.
    pub fn contacts(&self) -> Vec<ContactReport> {
        outcome::contact_reports(&self.solution())
    }
}

/// A single solution of a network that is compiled already, of which these outputs are kept in any case: for studies
/// that read many. It has no measures, and is not judged by its energy: whoever states a result has it judged by
/// [`solve_assembly`].
///
/// # Errors
///
/// As [`solve_assembly`].
pub fn solve_signals(
    assembly: &Arc<Assembly>,
    settings: &SolveSettings,
    outputs: impl IntoIterator<Item = usize>,
    observer: &mut dyn Observer,
) -> Result<Signals, RunError> {
    settings.validate()?;
    let settings = &SolveSettings { estimate: false, ..settings.clone() };
    let task = Task { assembly, settings, selected: &[], method: &methods::Auto, is_judged: false };
    let outputs = outputs.into_iter().collect();
    let (found, _) = found(assembly, &task, (&outputs, false), observer)?;
    let Found { method, outcome, .. } = found;
    let rtol = (!method.is_exact()).then_some(outcome.solved.rtol);
    Ok(Signals { assembly: Arc::clone(assembly), trajectory: outcome.solved.trajectory, rtol })
}

/// The best solution of a task by the methods that settings allow, and the run that it is one of; of a large network
/// it keeps some outputs besides.
fn found(
    assembly: &Arc<Assembly>,
    task: &Task<'_>,
    (outputs, is_bounded): (&BTreeSet<usize>, bool),
    observer: &mut dyn Observer,
) -> Result<(Found, Run), RunError> {
    let settings = task.settings;
    memory::foresee(assembly)?;
    let run = Run {
        rtol: settings.rtol.unwrap_or(SINGLE),
        guards: guards(assembly, settings)?,
        keep: keep_also(&keep(assembly, task.selected), outputs),
        budget: Budget::of(settings.budget),
        is_bounded,
        ..Run::to(settings.duration)
    };
    let is_free = matches!(settings.method, Choice::Auto);
    let first = choose(&settings.method, assembly, &run);
    let is_exact = first.as_ref().is_ok_and(|first| first.0.is_exact());
    let reach = if is_exact { None } else { reach(&settings.method, assembly, &run) };
    let found = first.and_then(|first| {
        let allows_explicit = methods::Auto::allows_explicit(&assembly.system, &run);
        let others = || attempts::others(first.0.as_ref(), allows_explicit);
        let mut others = if is_free { others() } else { Vec::new() };
        let most = if reach.is_some() { attempts::UNDEFINED } else { u64::MAX };
        let found = attempts::first_that_solves(task, &run, (first, most), &mut others, observer)?;
        if !task.is_judged {
            return Ok(found);
        }
        Ok(attempts::improved(task, &run, found, others, observer))
    });
    match (found, reach) {
        (Err(error), Some(reach)) => attempts::of_a_part(task, &run, reach, observer).ok_or(error),
        // Figures of a part, with their errors, are better than figures of all of it of which nothing is known.
        (Ok(found), Some(reach)) if !task.knows(&found.outcome) => {
            let part = attempts::of_a_part(task, &run, reach, observer);
            Ok(part.unwrap_or((found, run)))
        }
        (found, _) => Ok((found?, run)),
    }
}

/// How far `exact` follows a run that has more oscillations than are followed \[s\], if it is by a method
/// that may be `exact`.
fn reach(choice: &Choice, assembly: &Assembly, run: &Run) -> Option<f64> {
    let is_asked_for = matches!(choice, Choice::Auto) || choice.name() == methods::Exact::KIND;
    (is_asked_for && assembly.switching.is_none())
        .then(|| methods::Exact::reach(&assembly.system, run))
        .flatten()
}

/// The keys of the measures that [`solve_assembly`] would report, without solving anything.
///
/// # Errors
///
/// What is wrong with the settings.
pub fn reported_measures(
    assembly: &Assembly,
    settings: &SolveSettings,
) -> Result<Vec<String>, RunError> {
    settings.validate()?;
    let selected = select(assembly, &settings.measures, &settings.limits)?;
    check_keys(settings, &selected)?;
    guards(assembly, settings)?;
    Ok(selected.into_iter().map(|entry| entry.key).collect())
}

/// Which measures that [`solve_assembly`] would report can have no value whatever the solution, each with the reason.
///
/// # Errors
///
/// [`RunError::UnknownTarget`] for measures of what does not exist.
pub fn undefined_measures(
    assembly: &Assembly,
    settings: &SolveSettings,
) -> Result<Vec<(String, Note)>, RunError> {
    let selected = select(assembly, &settings.measures, &settings.limits)?;
    let undefined = selected.into_iter().filter_map(|own| {
        own.measure.needs().lacking(assembly, own.target).map(|why| (own.key, why))
    });
    Ok(undefined.collect())
}

/// The method that `auto` chooses for a run of `duration` \[s\], and why.
pub fn choice(assembly: &Assembly, duration: f64) -> (&'static str, String) {
    let (method, why) = methods::Auto::choose(&assembly.system, &Run::to(duration));
    (method.name(), reason(assembly, method.as_ref(), why))
}

/// Why a method fits, of what switches said for all of the run.
fn reason(assembly: &Assembly, method: &dyn Method, why: String) -> String {
    let Some(phased) = assembly.switching.as_ref().filter(|_| method.is_exact()) else {
        return why;
    };
    let states = assembly.system.states();
    let others =
        if phased.has_linear_phases() { "" } else { ", as long as no law is reached that is not" };
    format!("between switchings the scene is linear, with {states} states at first{others}")
}

fn choose(
    choice: &Choice,
    assembly: &Assembly,
    run: &Run,
) -> Result<(Arc<dyn Method>, String), RunError> {
    let (method, why) = match choice {
        Choice::Auto => {
            let (method, why) = methods::Auto::choose(&assembly.system, run);
            (Arc::from(method), why)
        }
        Choice::Method(method) => (Arc::clone(method), method.applies(&assembly.system, run)?),
    };
    let why = reason(assembly, method.as_ref(), why);
    Ok((method, why))
}

fn check_keys(settings: &SolveSettings, selected: &[Selected]) -> Result<(), RunError> {
    let is_known = |key: &&String| selected.iter().any(|entry| entry.key == **key);
    match settings.accuracy.by_measure.keys().find(|key| !is_known(key)) {
        None => Ok(()),
        Some(key) => Err(RunError::UnknownMeasure {
            key: key.clone(),
            known: selected.iter().map(|entry| entry.key.clone()).collect(),
        }),
    }
}

pub(crate) fn guards(
    assembly: &Assembly,
    settings: &SolveSettings,
) -> Result<Vec<Guard>, RunError> {
    let guard = |stop: &Stop| {
        let output = assembly.output(&stop.output).ok_or_else(|| RunError::UnknownOutput {
            output: stop.output.clone(),
            known: assembly.system.outputs.iter().map(|output| output.name.to_string()).collect(),
        })?;
        Ok(Guard {
            name: stop.text(assembly.system.outputs.at(output).unit),
            output,
            level: stop.level,
            direction: stop.direction,
            stops: true,
            begins: None,
            rate_of: None,
        })
    };
    settings.stops.iter().map(guard).collect()
}

/// The words of the effects that are on.
pub(crate) fn words(network: &Network) -> Vec<&'static str> {
    network.effects().iter().map(|effect| effect.kind()).collect()
}

#[cfg(test)]
mod tests;
