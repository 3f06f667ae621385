//! From the solution that was found to the report on it.

use std::sync::Arc;

use dashpot_dae::Run;
use dashpot_network::Assembly;

use super::{
    events,
    measured::measures,
    warnings::{self, Findings},
};
use crate::{
    ContactReport, RunError, RunReport, Solution, SolverReport, SystemReport, Warning,
    energy::ledger::ledger,
    errors::{refinement::Outcome, solved::Task},
    impact::{
        contacts::{self, meetings_after},
        sliders::idle_times,
    },
    memory::is_large,
};

/// The report of a run by the method of the task; what it took in all, and why it was that method, are
/// left open.
///
/// # Errors
///
/// A solution that cannot be trusted, or that lacks what the report needs.
pub(super) fn report(
    assembly: &Arc<Assembly>,
    effects: &[&'static str],
    task: &Task<'_>,
    run: &Run,
    mut outcome: Outcome,
) -> Result<RunReport, RunError> {
    if let Some(fault) = outcome.solved.fault(assembly) {
        return Err(fault);
    }
    let known = outcome.solved.known.take();
    let readings = std::mem::take(&mut outcome.solved.readings);
    let Outcome { solved, errors, open_end, obstacle, .. } = &outcome;
    let mut solution = solved.as_read(assembly);
    if let Some(known) = known {
        solution = solution.knowing(known);
    }
    let (settings, energy) = (task.settings, &solved.energy);
    let cut = (run.t_end < settings.duration).then_some(run.t_end);
    let idle = idle_times(&solution);
    let measures = measures(task, (&solution, energy, &idle), readings, errors, cut);
    let contacts = contact_reports(&solution);
    let impact = solution.scene_impact();
    let is_known = solved.trajectory.digest().is_none() || impact.end >= solution.end();
    let energy_after_impact =
        (impact.has_ended() && is_known).then(|| ledger(&solution, impact.end));
    let events = events::collect(run, assembly, &solved.trajectory, &contacts);
    let mut warnings = warnings::collect(&Findings {
        solution: &solution,
        accuracy: &settings.accuracy,
        measures: &measures,
        contacts: &contacts,
        energy,
        estimate: settings.estimate,
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
        energy: outcome.solved.energy,
        energy_after_impact,
        events,
        partial: None,
        segmentation: None,
        warnings,
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
    Err(RunError::NotKept { outputs: names.map(|output| output.name.to_owned()).collect() })
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
        work: 0,
    }
}

/// The contacts of the elements that touch an impactor.
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
