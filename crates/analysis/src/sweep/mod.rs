//! Families of scenes: measures over a grid of parameters.
//!
//! A sweep is given its scenes by a closure, which poses the scene at any point of a [`Grid`]. Scenes
//! that one impactor strikes are *instantiated*: the form is compiled once, as it is until the impactor is let
//! go, and their numbers are read along the axes of the grid only. Linear ones are solved from them by the
//! powers of one small matrix exponential, without allocating anything, others in explicit steps. What is
//! reported that way is compared with full runs at points spread over the grid. All other scenes, and points
//! whose impact is not of the plain kind or not certain enough, are solved in full.
//!
//! Points are shared among threads, and whole groups of them as [shards](sweep_shard) among machines; the result is
//! the same to the bit whatever their number.

mod axes;
mod bracket;
mod columns;
mod estimates;
mod forces;
mod full;
mod instantiated;
mod parallel;
mod plain;
mod products;
mod propagate;
mod report;
mod scatter;
mod scene_point;
mod serialized;
mod shards;
mod shown;
mod stamper;
mod stopped;
mod sums;
mod table;
mod thinned;

#[cfg(test)]
mod tests;

use std::time::Instant;

use dashpot_dae::Silent;
use dashpot_network::{Detail, Network};

pub(crate) use self::parallel::share;
pub use self::{
    axes::{Axis, Grid, Sweep, SweepRow, Swept, axis},
    columns::columns,
    estimates::{Estimates, SweepOptions},
    forces::{ContactForce, ContactForces, PoseAt},
    parallel::Watch,
    report::{Column, Gap, PartialOfSweep, SweepError, SweepReport, SweepWarning},
    shards::{Raised, Shard, merge, points_of_shard, sweep_in_parts, sweep_shard},
};
use self::{full::Flaws, report::Notice};
use crate::{
    SolveSettings, Warning,
    partial::{decide, spread},
};

/// A scene at a point.
#[derive(Debug, Clone)]
pub struct ScenePoint {
    /// Nodes, elements, loads and effects.
    pub network: Network,
    /// What is asked of its run.
    pub settings: SolveSettings,
}

/// Poses the scene where each parameter takes the value at this position, or says why there is none.
pub type Pose<'p> = dyn Fn(&[usize]) -> Result<ScenePoint, String> + Sync + 'p;

/// One point and its place in the result.
struct Row<'r> {
    point: usize,
    values: &'r mut [f64],
    errors: &'r mut [f64],
    flaws: Flaws,
    /// What a full run is warned of.
    warnings: Vec<Warning>,
    /// What is to be said of a point that was instantiated.
    notice: Option<Notice>,
}

impl Row<'_> {
    /// All that is to be said of the point; `element` is the one that notices are about.
    fn told(&self, element: &str) -> Vec<Warning> {
        let noticed = self.notice.map(|own| own.warnings(element)).unwrap_or_default();
        self.warnings.iter().cloned().chain(noticed).collect()
    }
}

/// Solves the scenes of a grid by so many threads.
///
/// Where their accuracy has a bound for what may be left out, that is decided at the corners of the
/// grid and at points spread over it, as in [`partial::sweep`](crate::partial::sweep()), and what
/// remains is solved everywhere. The errors then include the largest move that was found.
///
/// # Errors
///
/// A fault of the scene at the first point, and a sweep that was broken off. Points that fail are
/// [gaps](SweepReport::gaps).
pub fn sweep(
    grid: &Grid,
    pose: &Pose<'_>,
    columns: &[Column],
    options: SweepOptions,
    watch: &mut Watch<'_>,
) -> Result<SweepReport, SweepError> {
    let started = Instant::now();
    let mut report = shards::ready((grid, pose, columns), options, |ready| {
        let whole = ready.solve(0..grid.len(), watch)?;
        Ok(ready.report(vec![whole]))
    })?;
    report.wall = started.elapsed();
    Ok(report)
}

/// The corners of a grid are looked at up to so many parameters.
const MOST_CORNERED: usize = 6;

/// What may be left out of all points, where the scene at the first one allows that.
fn decided(
    grid: &Grid,
    pose: &Pose<'_>,
    first: &ScenePoint,
) -> Result<Option<(PartialOfSweep, Vec<Detail>)>, SweepError> {
    let Some(bound) = first.settings.accuracy.neglect_below else { return Ok(None) };
    let mut points = spread(grid.len());
    if grid.counts().len() <= MOST_CORNERED {
        points.extend(grid.corners());
    }
    points.sort_unstable();
    points.dedup();
    let scene_point: Vec<(usize, Network)> = points
        .into_iter()
        .filter_map(|point| Some((point, pose(&grid.places(point)).ok()?.network)))
        .collect();
    let networks: Vec<Network> = scene_point.iter().map(|own| own.1.clone()).collect();
    let all: Vec<usize> = (0..networks.len()).collect();
    let found = decide(&networks, &all, &first.settings, &mut Silent)?;
    let worst = found.worst();
    let report = PartialOfSweep {
        bound,
        checked: found.checked().map(|at| scene_point[at].0).collect(),
        worst,
        solves: found.solves(),
        left_out: found.left_out(),
        put_back: found.put_back.clone(),
    };
    Ok(Some((report, found.details())))
}
