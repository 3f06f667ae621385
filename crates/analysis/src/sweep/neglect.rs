//! What may be left out of all points of a sweep.

use dashpot_dae::Silent;
use dashpot_network::{Detail, Network};

use super::{Grid, PartialOfSweep, Pose, ScenePoint, SweepError};
use crate::partial::{decide, spread};

/// The corners of a grid are looked at up to so many parameters.
const MOST_CORNERED: usize = 6;

/// What may be left out of all points, where the scene at the first one allows that.
pub(super) fn decided(
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
        wall_in_full: found.wall_in_full(grid.len()),
        left_out: found.left_out(),
        put_back: found.put_back.clone(),
    };
    Ok(Some((report, found.details())))
}
