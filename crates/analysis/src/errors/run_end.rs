//! Errors where it is open whether something switches before the run ends.

use dashpot_dae::{Run, Silent};

use crate::errors::solved::{Solved, Task};

/// Errors of instants at which something switches, in parts of the tolerance and of the time.
const OF_INSTANTS: f64 = 1e2;
/// How much farther back than to the last switching a run ends before it.
const AMPLE: f64 = 2.0;

/// Widens the errors of a solution of a `run` so that they cover what comes of a switching that may lie on
/// either side of the run's end, by the error of the method. The run is solved once more to an end that lies on
/// the other side of it; where that fails, the errors are not known.
pub(crate) fn cover(task: &Task<'_>, run: &Run, finest: &Solved, errors: &mut [Option<f64>]) {
    let t_end = finest.trajectory.t_end;
    if task.assembly.switching.is_none() || t_end < run.t_end {
        return;
    }
    let longer = finest.trajectory.dense.margin();
    let last = finest.trajectory.switches.last().map(|own| t_end - own.time);
    let shorter = last.filter(|since| *since <= OF_INSTANTS * finest.rtol * t_end);
    let shorter = shorter.map(|since| -AMPLE * since.max(4.0 * f64::EPSILON * t_end));
    for change in longer.into_iter().chain(shorter) {
        let other = Run { t_end: t_end + change, ..run.clone() }.with_rtol(finest.rtol);
        let Ok(other) = task.solve(&other, &mut Silent) else {
            errors.fill(None);
            return;
        };
        if other.trajectory.switches.len() == finest.trajectory.switches.len() {
            continue;
        }
        let readings = finest.readings.iter().zip(&other.readings);
        for (error, (own, other)) in errors.iter_mut().zip(readings) {
            match (own.value, other.value) {
                (Some(value), Some(other)) => {
                    *error = error.map(|error| error + (other - value).abs());
                }
                (None, None) => {}
                _ => *error = Some(f64::INFINITY),
            }
        }
    }
}
