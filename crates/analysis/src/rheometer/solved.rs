//! Runs of a rig by the run's own solver, for models that are not linear and for tests that need more than
//! single instants.

use std::sync::Arc;

use dashpot_dae::Silent;

use super::{
    Obstacle,
    history::Instant,
    rig::Rig,
    track::{TOLERANCES, Track, estimated, read},
};
use crate::{Choice, Signals, SolveSettings, Stop, run::solve_bounded, solve_signals};

/// Work that one run may take, some seconds.
const BUDGET: u64 = 200_000_000;

/// A run to `reach` \[s\] at one relative tolerance, which ends early where a stop says so; it is judged by its energy, or
/// will be before anything is stated that hangs on it.
pub(super) fn solve(
    rig: &Rig<'_>,
    choice: &Choice,
    (reach, rtol): (f64, f64),
    stops: Vec<Stop>,
    is_judged: bool,
) -> Result<Signals, Obstacle> {
    let network = rig.network().ok_or(Obstacle::ChangesAtOnce)?;
    let assembly = Arc::new(network.compile(reach)?);
    let settings = SolveSettings {
        method: choice.clone(),
        rtol: Some(rtol),
        estimate: false,
        stops,
        budget: BUDGET,
        ..SolveSettings::lasting(reach)
    };
    if !is_judged {
        return Ok(solve_signals(&assembly, &settings, [], &mut Silent)?);
    }
    let report = solve_bounded(&assembly, &[], &settings, true, &mut Silent)?;
    Ok(Signals { assembly, rtol: report.solver.rtol, trajectory: report.trajectory })
}

/// The outputs of a rig over runs to `reach`, with their errors and the method that was used.
pub(super) fn tracks(
    rig: &Rig<'_>,
    choice: &Choice,
    reach: f64,
    instants: &[Instant],
) -> Result<(&'static str, Vec<Track>), Obstacle> {
    let at = |rtol: f64| {
        let solved = solve(rig, choice, (reach, rtol), Vec::new(), true)?;
        let numbers = rig.outputs.iter().map(|output| solved.assembly.output(output));
        let numbers: Option<Vec<usize>> = numbers.collect();
        let solution = solved.solution();
        let tracks = numbers.ok_or(Obstacle::Undetermined)?.into_iter();
        let tracks = tracks.map(|number| read(&solution.glance(number), reach, instants)).collect();
        Ok::<(_, Vec<Track>), Obstacle>(((solved.trajectory.method, solved.rtol.is_none()), tracks))
    };
    let [coarse, middle, fine] = TOLERANCES;
    let ((method, is_exact), own) = at(coarse)?;
    if is_exact {
        return Ok((method, own));
    }
    Ok((method, estimated(&own, &at(middle)?.1, at(fine)?.1)))
}
