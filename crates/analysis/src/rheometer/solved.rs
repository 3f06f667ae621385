//! Runs of a rig by the run's own solver, for models that are not linear and for tests that need more than
//! single instants.

use std::sync::Arc;

use dashpot_dae::{Silent, Trajectory};
use dashpot_network::Assembly;

use super::{
    Obstacle,
    history::Instant,
    simulation::{Rig, TOLERANCES, Track, estimated, read},
};
use crate::{Choice, Solution, SolveSettings, Stop, run::solve_assembly};

/// Work that one run may take, some seconds.
const BUDGET: u64 = 200_000_000;

/// A run of a rig.
#[derive(Debug)]
pub(super) struct Solved {
    /// Name of the method that was used.
    pub(super) method: &'static str,
    /// Whether that has no tolerance.
    pub(super) is_exact: bool,
    pub(super) assembly: Arc<Assembly>,
    pub(super) trajectory: Trajectory,
}

impl Solved {
    pub(super) fn solution(&self) -> Solution<'_> {
        Solution::new(&self.assembly, &self.trajectory)
    }
}

/// A run to `reach` \[s\] at one relative tolerance, which ends early where a stop says so.
pub(super) fn solve(
    rig: &Rig<'_>,
    choice: &Choice,
    (reach, rtol): (f64, f64),
    stops: Vec<Stop>,
) -> Result<Solved, Obstacle> {
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
    let report = solve_assembly(&assembly, &[], &settings, &mut Silent)?;
    let (method, is_exact) = (report.solver.method, report.solver.rtol.is_none());
    Ok(Solved { method, is_exact, assembly, trajectory: report.trajectory })
}

/// The outputs of a rig over runs to `reach`, with their errors and the method that was used.
pub(super) fn tracks(
    rig: &Rig<'_>,
    choice: &Choice,
    reach: f64,
    instants: &[Instant],
) -> Result<(&'static str, Vec<Track>), Obstacle> {
    let at = |rtol: f64| {
        let solved = solve(rig, choice, (reach, rtol), Vec::new())?;
        let numbers = rig.outputs.iter().map(|output| solved.assembly.output(output));
        let numbers: Option<Vec<usize>> = numbers.collect();
        let solution = solved.solution();
        let tracks = numbers.ok_or(Obstacle::Undetermined)?.into_iter();
        let tracks = tracks.map(|number| read(&solution.glance(number), reach, instants)).collect();
        Ok::<(_, Vec<Track>), Obstacle>(((solved.method, solved.is_exact), tracks))
    };
    let [coarse, middle, fine] = TOLERANCES;
    let ((method, is_exact), own) = at(coarse)?;
    if is_exact {
        return Ok((method, own));
    }
    Ok((method, estimated(&own, &at(middle)?.1, at(fine)?.1)))
}
