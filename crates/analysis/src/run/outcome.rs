//! From the solution that was found to the report on it.

use std::{sync::Arc, time::Duration};

use dashpot_dae::Run;
use dashpot_network::{
    Assembly, ConnectionOutputs, NetworkWarning, PrimitiveOutputs,
    parameters::{Kind as _, ParameterKind, Value, WindowWish},
};

use super::{
    events,
    warnings::{self, Findings},
};
use crate::{
    ContactReport, Idle, Ledger, MeasureReport, Note, Reading, RunError, RunReport, Solution,
    SolverReport, SystemReport, Warning,
    energy::ledger::ledger,
    errors::{
        accuracy::{excess, is_open, largest},
        instants::Instants,
        refinement::Outcome,
        solved::Task,
    },
    impact::{
        contacts::{self, meetings_after},
        sliders::idle_times,
    },
    measures::{ContactTime, Family, Impulse, PeakForce, selection::Selected},
    memory::is_large,
    report::zeros::settle_zeros,
};

/// The report of a run by the method of the task; what it took in all, and why it was that method, are left open.
/// Errors: a solution that cannot be trusted, or that lacks what the report needs.
pub(super) fn report(
    assembly: &Arc<Assembly>,
    effects: &[&'static str],
    task: &Task<'_>,
    run: &Run,
    mut outcome: Outcome,
) -> Result<RunReport, RunError> {
    if let Some(fault) = task.fault(&outcome.solved) {
        return Err(fault);
    }
    let known = outcome.solved.known.take();
    let readings = std::mem::take(&mut outcome.solved.readings);
    let Outcome { solved, errors, open_end, obstacle, .. } = &outcome;
    let mut solution = solved.as_read(assembly);
    if let Some(known) = known {
        solution = solution.knowing(known);
    }
    let (settings, energy) = (task.settings, &solved.balance(assembly).energy);
    let cut = (run.t_end < settings.duration).then_some(run.t_end);
    let idle = idle_times(&solution);
    let mut measures = measures(task, (&solution, energy, &idle), readings, errors, cut);
    let rtol = if task.method.is_exact() { 0.0 } else { solved.rtol };
    settle_zeros(&mut measures, energy.turned_over, rtol);
    let contacts = contact_reports(&solution);
    let impact = solution.scene_impact();
    let is_known = solved.trajectory.digest().is_none() || impact.end >= solution.end();
    let energy_after_impact =
        (impact.has_ended() && is_known).then(|| ledger(&solution, impact.end));
    let instants = match &outcome.instants {
        Some(told) => told.clone(),
        None if task.method.is_exact() && settings.estimate => Instants::bounded(run, &solution),
        None => Instants::unknown(&solved.trajectory),
    };
    let release = |element: &str| {
        let key = format!("{element}.{}", ContactTime::KIND);
        measures.iter().find(|own| own.key == key).and_then(|own| own.error)
    };
    let events = events::collect(run, assembly, &solved.trajectory, &contacts, &instants, release);
    let mut warnings = warnings::collect(&Findings {
        solution: &solution,
        task,
        measures: &measures,
        contacts: &contacts,
        energy,
        open_end: open_end.as_ref(),
        obstacle: obstacle.as_ref(),
        guards: &run.guards,
        effects,
        idle: &idle,
    });
    if let Some(until) = cut {
        warnings.insert(0, Warning::FollowedInPart { until, duration: settings.duration });
    }
    if is_large(assembly) && !assembly.has_impactor() {
        warnings.push(Warning::Unasked);
    }
    all_kept(&solution)?;
    drop(solution);
    Ok(RunReport {
        solver: solver_report(task, &outcome),
        system: SystemReport { effects: effects.to_vec(), ..SystemReport::of(assembly) },
        measures,
        contacts,
        energy: energy.clone(),
        energy_after_impact,
        events,
        partial: None,
        segmentation: None,
        warnings,
        limits: settings.limits.clone(),
        scatter: None,
        only: Vec::new(),
        assembly: Arc::clone(assembly),
        trajectory: outcome.solved.trajectory,
    })
}

/// Refuses a solution that lacks outputs which were asked for.
fn all_kept(solution: &Solution<'_>) -> Result<(), RunError> {
    let missing = solution.missing();
    if missing.is_empty() {
        return Ok(());
    }
    let outputs = &solution.assembly().system.outputs;
    let names = missing.iter().filter_map(|&at| outputs.get(at));
    Err(RunError::NotKept { outputs: names.map(|output| output.name.to_string()).collect() })
}

fn solver_report(task: &Task<'_>, outcome: &Outcome) -> SolverReport {
    let solved = &outcome.solved;
    SolverReport {
        method: solved.trajectory.method,
        why: String::new(),
        rtol: (!task.method.is_exact()).then_some(solved.rtol),
        threshold: solved.threshold,
        statistics: solved.trajectory.statistics,
        solves_for_error: outcome.solves_for_error,
        wall_for_error: outcome.wall_for_error,
        wall_in_all: Duration::ZERO,
        work: 0,
    }
}

/// The contacts of the elements that touch an impactor.
pub(super) fn contact_reports(solution: &Solution<'_>) -> Vec<ContactReport> {
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

/// The reports of a task's measures, of which these are the readings and their errors, where the solution is
/// followed to the time `cut` \[s\] only.
fn measures(
    task: &Task<'_>,
    (solution, energy, idle): (&Solution<'_>, &Ledger, &[Idle]),
    readings: Vec<Reading>,
    errors: &[Option<f64>],
    cut: Option<f64>,
) -> Vec<MeasureReport> {
    let is_unknown = |own: &NetworkWarning| matches!(own, NetworkWarning::WithinJump { .. });
    let leaves_out_work = solution.assembly().warnings.iter().any(is_unknown);
    let read = task.selected.iter().zip(readings).zip(errors);
    read.map(|((entry, reading), &error)| {
        let is_work = entry.measure.applies_to() == Family::Element && entry.measure.unit() == "J";
        let error = error.filter(|_| !(leaves_out_work && is_work));
        let wish = task.settings.accuracy.of(&entry.key);
        let kind = || largest(solution, energy.turned_over, entry.measure.unit());
        let is_open = is_open(&reading, error, wish, kind);
        let report = measure_report(entry, reading, error, wish);
        let report = without_idle_forces(report, solution, idle);
        as_far_as_known(report, is_open.then(|| error.unwrap_or(f64::INFINITY)), cut)
    })
    .collect()
}

pub(crate) fn measure_report(
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
    let until = report.window.map(|window| window.1).or(report.time);
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

/// The report on a measure of a force, which is not determined where it hangs on that of an idle slider.
fn without_idle_forces(
    report: MeasureReport,
    solution: &Solution<'_>,
    times: &[Idle],
) -> MeasureReport {
    let is_of_force = [PeakForce::KIND, Impulse::KIND].contains(&report.kind);
    if times.is_empty() || !is_of_force || report.value.is_none() {
        return report;
    }
    let connections = &solution.assembly().connections;
    let Some(at) = connections.iter().position(|connection| connection.name == report.target)
    else {
        return report;
    };
    let impact = solution.element_impact(at);
    let window = report.window.unwrap_or(match report.window_wish {
        Some(WindowWish::Impact) => (impact.start, impact.end),
        Some(WindowWish::Times(from, to)) => (from, to),
        _ => (0.0, solution.end()),
    });
    let hangs = times.iter().find(|time| {
        let span = (time.from.max(window.0), time.to.min(window.1));
        span.0 < span.1 && time.changes(&report, solution, &connections[at], span)
    });
    let Some(idle) = hangs else { return report };
    report.undetermined(Note::IdleSlider(idle.from, idle.to))
}

impl Idle {
    /// Whether another force of the slider within a span of time \[s\] would change what is measured in an element.
    fn changes(
        &self,
        report: &MeasureReport,
        solution: &Solution<'_>,
        element: &ConnectionOutputs,
        span: (f64, f64),
    ) -> bool {
        let Some(force) = element.force else { return false };
        let own = &solution.assembly().primitives[element.primitives.clone()];
        let has =
            |paths: &[String]| own.iter().any(|own| paths.iter().any(|path| **path == *own.name));
        let holds = has(&self.slider.held_by);
        if !holds && !has(&self.slider.sliders) {
            return false;
        }
        let Some(peak) = report.value.filter(|_| report.kind == PeakForce::KIND) else {
            return true;
        };
        if !solution.keeps(force) {
            return true;
        }
        let force = solution.signal(force);
        let (least, most) = (force.minimum(span).value, force.maximum(span).value);
        let bound = if holds {
            let other = self.taken(solution, &solution.assembly().primitives).abs();
            least.abs().max(most.abs()) + 2.0 * other
        } else {
            let slides = self.taken(solution, own);
            let turned = |own: f64| (own - 2.0 * slides).abs();
            least.abs().max(most.abs()).max(turned(least)).max(turned(most))
        };
        let is_within = report.time.is_some_and(|time| span.0 < time && time < span.1);
        is_within || bound > peak.abs()
    }

    /// The force \[N\] that those of these parts which are idle are taken to have.
    fn taken(&self, solution: &Solution<'_>, parts: &[PrimitiveOutputs]) -> f64 {
        let idle =
            parts.iter().filter(|part| self.slider.sliders.iter().any(|own| **own == *part.name));
        let idle = idle.filter(|idle| solution.keeps(idle.force));
        idle.map(|idle| solution.signal(idle.force).value(0.5 * (self.from + self.to))).sum()
    }
}
