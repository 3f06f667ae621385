//! From a network to the report of a run.

pub(crate) mod attempts;
pub(crate) mod large;
pub(crate) mod memory;
pub(crate) mod settings;

use std::sync::Arc;

use dashpot_dae::{Budget, Direction, Guard, Method, MethodKind, Observer, Run, methods};
use dashpot_network::{
    Assembly, Network,
    parameters::{ParameterKind, Value, WindowWish},
};

use crate::{
    Choice, ContactReport, MeasureReport, Note, Reading, RunError, RunReport, Solution,
    SolveSettings, SolverReport, SystemReport, Warning,
    energy::ledger::{leak, ledger},
    errors::{
        accuracy::excess,
        magnitude::{is_open, largest},
        refinement::{MOST_LOST, Outcome},
        solved::{Solved, Task},
    },
    impact::{
        contacts::{self, meetings_after},
        holding::slider_fault,
        idle::{idle_times, without_idle_forces},
    },
    measures::selection::{Selected, select},
    partial::{contribution::modes, solve_partial},
    report::{events, warnings, wording::quantity},
    solve::{attempts::Found, large::keep, memory::is_large},
};

/// Tolerance of a single solution whose error is not estimated, when none is given.
const SINGLE: f64 = 1e-6;

/// Compiles a network, integrates it, and reports.
///
/// A method that bounds its own error solves once. The others solve at four tolerances a factor √10
/// apart and take the errors of the finest solution from the differences; as long as an error
/// exceeds what is wanted, or the energy does not close as well, they go on to the next tolerance.
///
/// # Errors
///
/// Any [`RunError`]: what is wrong with the network or the settings, a method that fails, and an
/// energy balance that is off by more than 1 % of the energy turned over.
pub fn solve(
    network: &Network,
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    settings.validate()?;
    let assembly = Arc::new(network.compile(settings.duration)?);
    solve_partial(network, &assembly, settings, observer)
}

/// Integrates a network that is compiled already, and reports; otherwise as [`solve`]. `effects`
/// are the words of those that are on.
///
/// # Errors
///
/// As [`solve`], but for the network.
pub fn solve_assembly(
    assembly: &Arc<Assembly>,
    effects: &[&'static str],
    settings: &SolveSettings,
    observer: &mut dyn Observer,
) -> Result<RunReport, RunError> {
    settings.validate()?;
    memory::foresee(assembly)?;
    let selected = select(assembly, &settings.measures)?;
    check_keys(settings, &selected)?;
    let run = Run {
        t_end: settings.duration,
        rtol: settings.rtol.unwrap_or(SINGLE),
        nominal: Vec::new(),
        guards: guards(assembly, settings)?,
        keep: keep(assembly, &selected),
        budget: Budget::of(settings.budget),
    };
    let is_free = matches!(settings.method, Choice::Auto);
    let first = choose(&settings.method, assembly, &run);
    let is_exact = first.as_ref().is_ok_and(|own| own.0.is_exact());
    let reach = if is_exact { None } else { reach(&settings.method, assembly, &run) };
    // Each attempt is by a method of its own.
    let task = Task { assembly, settings, selected: &selected, method: &methods::Auto };
    let found = first.and_then(|first| {
        let mut others = if is_free { attempts::others(first.0.as_ref()) } else { Vec::new() };
        let most = if reach.is_some() { attempts::HOPELESS } else { u64::MAX };
        let found = attempts::first_that_solves(&task, &run, (first, most), &mut others, observer)?;
        Ok(attempts::improved(&task, &run, found, others, observer))
    });
    let (found, run) = match (found, reach) {
        (Err(error), Some(reach)) => match attempts::of_a_part(&task, &run, reach, observer) {
            Some((found, part)) => (found, part),
            None => return Err(error),
        },
        (found, _) => (found?, run),
    };
    let Found { method, why, outcome } = found;
    let work = run.budget.done();
    run.budget.close();
    let task = Task { method: method.as_ref(), ..task };
    report(assembly, effects, &task, &run, (why, work), outcome)
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
    let selected = select(assembly, &settings.measures)?;
    check_keys(settings, &selected)?;
    guards(assembly, settings)?;
    Ok(selected.into_iter().map(|entry| entry.key).collect())
}

/// Which measures that [`solve_assembly`] would report can have no value whatever the solution, each
/// with the reason.
///
/// # Errors
///
/// [`RunError::UnknownTarget`] for measures of what does not exist.
pub fn hopeless_measures(
    assembly: &Assembly,
    settings: &SolveSettings,
) -> Result<Vec<(String, Note)>, RunError> {
    let selected = select(assembly, &settings.measures)?;
    let hopeless = selected.into_iter().filter_map(|own| {
        own.measure.needs().lacking(assembly, own.target).map(|why| (own.key, why))
    });
    Ok(hopeless.collect())
}

/// The method that `auto` chooses for a run of `duration` \[s\], and why.
pub fn choice(assembly: &Assembly, duration: f64) -> (&'static str, String) {
    let (method, why) = methods::Auto::choose(&assembly.system, &Run::to(duration));
    (method.name(), reason(assembly, method.as_ref(), why))
}

/// Why a method fits, of what switches said for all of the run.
fn reason(assembly: &Assembly, method: &dyn Method, why: String) -> String {
    if assembly.switching.is_none() || !method.is_exact() {
        return why;
    }
    let states = assembly.system.states();
    format!("between switchings the scene is linear, with {states} states at first")
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
    let guard = |stop: &crate::Stop| {
        let output = assembly.output(&stop.output).ok_or_else(|| RunError::UnknownOutput {
            output: stop.output.clone(),
            known: assembly.system.outputs.iter().map(|output| output.name.to_owned()).collect(),
        })?;
        Ok(Guard {
            name: condition(stop, assembly.system.outputs.at(output).unit),
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

/// What has happened when a run stops, in words; the level is in the SI unit `unit`.
fn condition(stop: &crate::Stop, unit: &str) -> String {
    let way = match stop.direction {
        Direction::Rising => "rose above",
        Direction::Falling => "fell below",
        Direction::Either => "reached",
    };
    let level = if stop.level == 0.0 { format!("0 {unit}") } else { quantity(stop.level, unit) };
    format!("{} {way} {level}", stop.output)
}

fn report(
    assembly: &Arc<Assembly>,
    effects: &[&'static str],
    task: &Task<'_>,
    run: &Run,
    (why, work): (String, u64),
    outcome: Outcome,
) -> Result<RunReport, RunError> {
    let Outcome { solved, errors, open_end, solves_for_error, wall_for_error, obstacle, .. } =
        outcome;
    if let Some(error) = lost(assembly, &solved) {
        return Err(error);
    }
    let Solved { rtol, doubt, trajectory, readings, energy, known, .. } = solved;
    let cut = (run.t_end < task.settings.duration).then_some(run.t_end);
    let mut solution = Solution::new(assembly, &trajectory).doubting(doubt);
    if let Some(known) = known {
        solution = solution.knowing(known);
    }
    let idle = idle_times(&solution);
    let read = task.selected.iter().zip(readings).zip(errors);
    let measures: Vec<MeasureReport> = read
        .map(|((entry, reading), error)| {
            let wish = task.settings.accuracy.of(&entry.key);
            let kind = || largest(&solution, &energy, entry.measure.unit());
            let is_open = is_open(&reading, error, wish, kind);
            let report = measure_report(entry, reading, error, wish);
            let report = without_idle_forces(report, &solution, &idle);
            as_far_as_known(report, is_open.then(|| error.unwrap_or(f64::INFINITY)), cut)
        })
        .collect();
    let contacts = contact_reports(&solution);
    let impact = solution.scene_impact();
    let is_known = trajectory.digest().is_none() || impact.end >= trajectory.t_end;
    let energy_after_impact =
        (impact.has_ended() && is_known).then(|| ledger(&solution, impact.end));
    let events = events::collect(run, assembly, &trajectory, &contacts);
    let mut warnings = warnings::collect(&warnings::Findings {
        solution: &solution,
        accuracy: &task.settings.accuracy,
        measures: &measures,
        contacts: &contacts,
        energy: &energy,
        estimate: task.settings.estimate,
        open_end: open_end.as_ref(),
        obstacle: obstacle.as_ref(),
        guards: &run.guards,
        effects,
        idle: &idle,
    });
    if let Some(end) = cut {
        let duration = task.settings.duration;
        warnings.insert(0, Warning::FollowedInPart { until: end, duration });
    }
    let missing = solution.missing();
    if !missing.is_empty() {
        let names = missing.iter().filter_map(|&at| assembly.system.outputs.get(at));
        let outputs = names.map(|output| output.name.to_owned()).collect();
        return Err(RunError::NotKept { outputs });
    }
    drop(solution);
    let why = if trajectory.digest().is_some() {
        format!("{why}; only what the measures need is kept of so large a solution")
    } else {
        why
    };
    if is_large(assembly) && !assembly.has_impactor() {
        warnings.push(Warning::Unasked);
    }
    Ok(RunReport {
        solver: SolverReport {
            method: trajectory.method,
            why,
            rtol: (!task.method.is_exact()).then_some(rtol),
            doubt,
            statistics: trajectory.statistics,
            solves_for_error,
            wall_for_error,
            work,
        },
        system: SystemReport {
            states: assembly.system.states(),
            algebraic: assembly.system.algebraic(),
            modes: modes(assembly),
            effects: effects.to_vec(),
        },
        measures,
        contacts,
        energy,
        energy_after_impact,
        events,
        partial: None,
        segmentation: None,
        warnings,
        assembly: Arc::clone(assembly),
        trajectory,
    })
}

/// What is to be said of a solution in which so much energy is missing, or too much, that nothing of it
/// can be trusted, or in which sliders do what they cannot.
pub(crate) fn lost(assembly: &Assembly, solved: &Solved) -> Option<RunError> {
    let Solved { trajectory, energy, .. } = solved;
    let closure = energy.closure();
    let (method, solution) = (trajectory.method, Solution::new(assembly, trajectory));
    if !closure.is_finite() {
        return Some(RunError::BeyondRange);
    }
    if closure.abs() > MOST_LOST {
        return Some(RunError::EnergyLost { method, closure, leak: leak(&solution) });
    }
    slider_fault(&solution, energy).map(|fault| RunError::Slider { method, fault })
}

fn measure_report(
    entry: &Selected,
    reading: Reading,
    error: Option<f64>,
    wish: f64,
) -> MeasureReport {
    let parameters = entry.measure.parameters().iter().zip(entry.measure.values());
    let parameters = parameters.filter(|(parameter, _)| parameter.kind != ParameterKind::Window);
    let excess = excess(&reading, error, wish);
    let comes_and_goes = error.is_some_and(f64::is_infinite);
    let reading = if comes_and_goes { reading.noting(Note::ComesAndGoes) } else { reading };
    MeasureReport {
        key: entry.key.clone(),
        target: entry.name.clone(),
        kind: entry.measure.kind(),
        unit: entry.measure.unit(),
        value: reading.value,
        time: reading.time,
        window: reading.window,
        error,
        notes: reading.notes,
        window_wish: window_wish(entry),
        parameters: parameters.map(|(parameter, value)| (parameter.name, value)).collect(),
        is_undetermined: false,
        size: reading.size,
        excess,
    }
}

/// The report without its value, where that hangs on what is not followed beyond the time `cut` \[s\], or
/// the error of what is `open` says so.
fn as_far_as_known(report: MeasureReport, open: Option<f64>, cut: Option<f64>) -> MeasureReport {
    let until = report.window.map(|own| own.1).or(report.time);
    match (cut, open) {
        // What reaches to the end of a part of the run hangs on the rest of it.
        (Some(end), _) if until.is_none_or(|until| until >= end) => {
            report.undetermined(Note::NotFollowed)
        }
        (_, Some(error)) => {
            let unit = report.unit;
            report.undetermined(Note::LargeError(error, unit))
        }
        _ => report,
    }
}

fn window_wish(entry: &Selected) -> Option<WindowWish> {
    entry.measure.values().iter().find_map(|value| match value {
        Value::Window(wish) => Some(*wish),
        _ => None,
    })
}

fn contact_reports(solution: &Solution<'_>) -> Vec<ContactReport> {
    let connections = solution.assembly().connections.iter().enumerate();
    connections
        .filter(|(_, connection)| {
            connection.force.is_some() && solution.touches_impactor(connection)
        })
        .map(|(at, connection)| {
            let impact = solution.element_impact(at);
            let (assembly, trajectory) = (solution.assembly(), solution.trajectory());
            let again = meetings_after(assembly, trajectory, at, impact.end);
            let is_glued = contacts::is_glued(assembly, at);
            ContactReport { element: connection.name.clone(), impact, is_glued, again }
        })
        .collect()
}

#[cfg(test)]
mod faults;
#[cfg(test)]
mod random;
#[cfg(test)]
mod rest;
#[cfg(test)]
mod tests;
