//! The interval of a signal with a single hump.
//!
//! Of all intervals of one length the best is where the signal is above a level `c`. Over those the criterion rises
//! with the level while `c` is below 0.6 times the mean `m(c)`. So the search is one for the level, where
//! `c = 0.6 m(c)`, or where the interval is as long as the cap.

use dashpot_numerics::roots::false_position;

use super::{Optimum, area::Area, criterion};

/// Levels at which it is looked whether there is one such place.
const LEVELS: usize = 16;
/// How near the signal is to a level at the ends of its interval, in parts of its range: where the sign of a difference
/// is asked for …
const ROUGH: f64 = 1e-4;
/// … and at the optimum, where the criterion is stationary.
const NEAR: f64 = 1e-9;
/// What is left of a bracket in which nothing comes so near, in parts of its upper end.
const NARROW: f64 = 1e-12;

/// The optimum, where the signal rises to one place and falls behind it, or does one of both, and one level alone
/// may be that of the optimum, as far as [`LEVELS`] of them tell.
pub(super) fn optimum(area: &Area<'_>, cap: f64) -> Option<Optimum> {
    let hump = Hump::of(area)?;
    let (lowest, highest) = (hump.ends[0].1.min(hump.ends[1].1), hump.top.1);
    let range = highest - lowest;
    let level = |at: usize| lowest + range * at as f64 / LEVELS as f64;
    // The highest level has no interval of any length; there it is the mean itself.
    let slack =
        |at: usize| if at < LEVELS { hump.slack(level(at), ROUGH * range) } else { 0.4 * highest };
    let is_known = |at: usize| if at < LEVELS { hump.is_slack(level(at)) } else { Some(true) };
    let is_slack = |at: usize| is_known(at).unwrap_or_else(|| slack(at) > 0.0);
    let signs: [bool; LEVELS + 1] = std::array::from_fn(is_slack);
    let turn = signs.iter().position(|is_slack| *is_slack)?;
    if signs[turn..].contains(&false) {
        return None;
    }
    let near = NEAR * range;
    let mut best = lowest;
    if turn > 0 {
        let at = |at: usize| (level(at), slack(at));
        best = root(at(turn - 1), at(turn), near, |level| hump.slack(level, near));
    }
    let mut interval = hump.above(best, near);
    if interval.1 - interval.0 > cap {
        let excess = |level: f64| {
            let interval = hump.above(level, near);
            interval.1 - interval.0 - cap
        };
        let level = root((best, excess(best)), (highest, -cap), NEAR * cap, excess);
        let (from, to) = hump.above(level, near);
        // To the last digit as long as the cap, and where it begins or ends with the window there.
        let end = hump.ends[1].0;
        interval = if to < end { (from, from + cap) } else { (end - cap, end) };
    }
    let value = criterion(area.between(interval.0, interval.1), interval.1 - interval.0);
    Some(Optimum { value, interval, threshold: 0.0 })
}

/// Where a function passes zero between two places at which it has different signs: as soon as it is as `near`.
fn root(start: (f64, f64), end: (f64, f64), near: f64, f: impl Fn(f64) -> f64) -> f64 {
    let looked_at = |x: f64| {
        let value = f(x);
        if value.abs() <= near { Err(x) } else { Ok(value) }
    };
    match false_position(looked_at, start, end, NARROW) {
        Err(found) => found,
        Ok([one, other]) if one.1.abs() < other.1.abs() => one.0,
        Ok([_, other]) => other.0,
    }
}

/// A signal that rises and falls, or does one of both, by times and heights.
struct Hump<'h, 'a> {
    area: &'h Area<'a>,
    ends: [(f64, f64); 2],
    top: (f64, f64),
}

impl<'h, 'a> Hump<'h, 'a> {
    fn of(area: &'h Area<'a>) -> Option<Self> {
        let at = |time: f64| (time, area.height(time));
        let hump = match *area.knots() {
            // At a jump it is not the height that is on both sides.
            [start, top, end] if !area.is_border(top) => {
                Self { area, ends: [at(start), at(end)], top: at(top) }
            }
            [start, end] => {
                let ends = [at(start), at(end)];
                let top = if ends[0].1 > ends[1].1 { ends[0] } else { ends[1] };
                Self { area, ends, top }
            }
            _ => return None,
        };
        let [first, last] = hump.ends.map(|end| end.1);
        let top = hump.top.1;
        (top >= first && top >= last && top > first.min(last)).then_some(hump)
    }

    /// Where it is above a level, the ends as near to it as `near`.
    fn above(&self, level: f64, near: f64) -> (f64, f64) {
        let over = |time: f64| self.area.height(time) - level;
        let side = |end: (f64, f64)| {
            if end.1 >= level {
                return end.0;
            }
            let [before, after] =
                self.around(level, end).map(|(time, height)| (time, height - level));
            match [before.1.abs() <= near, after.1.abs() <= near] {
                [true, _] => before.0,
                [_, true] => after.0,
                _ => root(before, after, near, over),
            }
        };
        (side(self.ends[0]), side(self.ends[1]))
    }

    /// Neighbours between which it passes a level on the side of an end.
    fn around(&self, level: f64, end: (f64, f64)) -> [(f64, f64); 2] {
        let sides = if end.0 < self.top.0 { [end, self.top] } else { [self.top, end] };
        self.area.around(level, sides)
    }

    /// Whether `c − 0.6 m(c)` is positive, where it is so, or not, wherever the ends lie between their neighbours.
    fn is_slack(&self, level: f64) -> Option<bool> {
        let side = |end: (f64, f64)| {
            if end.1 >= level { [end.0; 2] } else { self.around(level, end).map(|own| own.0) }
        };
        let ([out_before, before], [after, out_after]) = (side(self.ends[0]), side(self.ends[1]));
        let most = self.area.between(out_before, out_after) / (after - before);
        let least = self.area.between(before, after) / (out_after - out_before);
        if level > 0.6 * most { Some(true) } else { (level < 0.6 * least).then_some(false) }
    }

    /// `c − 0.6 m(c)`.
    fn slack(&self, level: f64, near: f64) -> f64 {
        let (from, to) = self.above(level, near);
        level - 0.6 * self.area.between(from, to) / (to - from)
    }
}
