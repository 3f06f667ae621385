//! The interval of a signal with a single hump.
//!
//! Of all intervals of one length the best is where the signal is above a level `c`. Over those the criterion rises
//! with the level while `c` is below 0.6 times the mean `m(c)`. So the search is one for the level, where
//! `c = 0.6 m(c)`, or where the interval is as long as the cap.

use std::convert::Infallible;

use dashpot_numerics::roots::false_position;

use super::{Optimum, area::Area, criterion};

/// Levels at which it is looked whether there is one such place.
const LEVELS: usize = 16;
/// What is left of a bracket of levels or times, in parts of the upper end: the criterion is stationary.
const NARROW: f64 = 1e-10;

/// The optimum, where the signal rises to one place and falls behind it, and one level alone may be that of the
/// optimum, as far as [`LEVELS`] of them tell.
pub(super) fn optimum(area: &Area<'_>, cap: f64) -> Option<Optimum> {
    let &[start, top, end] = area.knots() else { return None };
    let [first, highest, last] = [start, top, end].map(|time| area.height(time));
    if !(highest > first && highest > last) {
        return None;
    }
    let hump = Hump { area, start, top, end };
    let lowest = first.min(last);
    let level = |at: usize| lowest + (highest - lowest) * at as f64 / LEVELS as f64;
    // The highest level has no interval of any length; there it is the mean itself.
    let slack = |at: usize| if at < LEVELS { hump.slack(level(at)) } else { 0.4 * highest };
    let slacks: [f64; LEVELS + 1] = std::array::from_fn(slack);
    let turn = slacks.iter().position(|slack| *slack > 0.0)?;
    if slacks[turn..].iter().any(|slack| *slack <= 0.0) {
        return None;
    }
    let mut best = lowest;
    if turn > 0 {
        let at = |at: usize| (level(at), slacks[at]);
        best = root(at(turn - 1), at(turn), |level| hump.slack(level));
    }
    let mut interval = hump.above(best);
    if interval.1 - interval.0 > cap {
        let excess = |level: f64| {
            let interval = hump.above(level);
            interval.1 - interval.0 - cap
        };
        interval = hump.above(root((best, excess(best)), (highest, -cap), excess));
        // To the last digit as long as the cap.
        interval.1 = (interval.0 + cap).min(end);
    }
    let value = criterion(area.between(interval.0, interval.1), interval.1 - interval.0);
    Some(Optimum { value, interval, threshold: 0.0 })
}

/// Where a function passes zero between two places at which it has different signs.
fn root(start: (f64, f64), end: (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    let found = false_position(|x| Ok::<f64, Infallible>(f(x)), start, end, NARROW);
    match found {
        Ok([one, other]) if one.1.abs() < other.1.abs() => one.0,
        Ok([_, other]) => other.0,
        Err(never) => match never {},
    }
}

/// A signal that rises and falls.
struct Hump<'h, 'a> {
    area: &'h Area<'a>,
    start: f64,
    top: f64,
    end: f64,
}

impl Hump<'_, '_> {
    /// Where it is above a level.
    fn above(&self, level: f64) -> (f64, f64) {
        let over = |time: f64| self.area.height(time) - level;
        let highest = over(self.top);
        let side = |end: f64| {
            let (own, top) = ((end, over(end)), (self.top, highest));
            match own {
                (_, over) if over >= 0.0 => end,
                _ if end < self.top => root(own, top, over),
                _ => root(top, own, over),
            }
        };
        (side(self.start), side(self.end))
    }

    /// `c − 0.6 m(c)`.
    fn slack(&self, level: f64) -> f64 {
        let (from, to) = self.above(level);
        level - 0.6 * self.area.between(from, to) / (to - from)
    }
}
