//! What may have switched before a run ends.

use super::Leg;
use crate::{Dense, Direction, Run, pieces::ROUNDING};

/// By how much more than it takes a run is to be longer.
const AMPLE: f64 = 2.0;
/// Longest margin in parts of the run: what takes longer rests, or settles on its level.
const LONGEST: f64 = 0.05;

/// How much longer the last `leg` would have to be for outputs on their way out to be seen beyond the levels
/// of their guards, if by the error of the method they may be there before its end \[s\]. `doubt` is as in
/// [`LegEnd::doubt`](super::LegEnd::doubt).
pub(super) fn margin(leg: &Leg, dense: &dyn Dense, run: &Run, doubt: f64) -> Option<f64> {
    let system = leg.system.as_ref();
    let of_guard = |guard: &crate::Guard| {
        let outward = match guard.direction {
            Direction::Rising => 1.0,
            Direction::Falling => -1.0,
            Direction::Either => return None,
        };
        let signal = dense.signal(system, guard.output);
        let last = signal.panels.last().filter(|panel| panel.length() > 0.0)?;
        let left = outward * (guard.level - last.value(last.end));
        let speed = outward * last.slope(last.end);
        let largest = signal.noise / (ROUNDING * f64::EPSILON);
        let span = AMPLE * (left.max(0.0) + AMPLE * run.rtol * largest) / speed;
        let is_near = speed > 0.0 && left <= doubt * largest && span <= LONGEST * run.t_end;
        is_near.then_some(span)
    };
    leg.guards.iter().filter_map(of_guard).reduce(f64::max)
}
