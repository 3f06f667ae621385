//! The interval of a signal with a single hump.
//!
//! Of all intervals of a length `T` the best is where the signal is above a level `c`. Its area `V(T)` is concave, with
//! the slope `c(T)`: at a level the straight line of this slope lies above it everywhere. Between two levels the criterion
//! `V^2.5/T^1.5` is therefore no larger than on the two lines up to where they meet. On a straight line with the area
//! `a + c T`, `a ≥ 0`, it falls up to `T = 1.5 a/c` and rises behind, and so is largest at the ends of any stretch: at one
//! of the levels, or where the lines meet. This bound exceeds the best by the square of what lies between the levels, and
//! they are divided until it does so no more. Where all levels between two are below 0.6 times the least mean, or above 0.6
//! times the largest, the criterion is monotone (means rise with the level), and no bound is needed; above 0.6 times the
//! top it falls with the level, so no level there is asked for. There may be several levels at which it is locally
//! largest: a peak with a long shoulder has two.

use dashpot_numerics::roots::false_position;

use super::{Optimum, RESOLUTION, area::Area, criterion};

/// Levels that are looked at first.
const LEVELS: usize = 4;
/// Where between the best level and another one the next one is looked at.
const BESIDE: f64 = 0.75;
/// Pairs of levels that are divided at most.
const MOST_PAIRS: usize = 2000;
/// How near the signal is to a level at the ends of its interval, in parts of its range, and how near levels come to
/// each other.
const NEAR: f64 = 1e-9;
/// What is left of a bracket in which nothing comes so near, in parts of its upper end.
const NARROW: f64 = 1e-12;

/// The optimum, where the signal rises to one place and falls behind it, or does one of both.
pub(super) fn optimum(area: &Area<'_>, cap: f64) -> Option<Optimum> {
    Hump::of(area).map(|hump| hump.optimum(cap))
}

/// The interval in which the signal is above a level.
#[derive(Debug, Clone, Copy)]
struct Cut {
    level: f64,
    interval: (f64, f64),
    area: f64,
}

impl Cut {
    fn length(&self) -> f64 {
        self.interval.1 - self.interval.0
    }

    fn value(&self) -> f64 {
        criterion(self.area, self.length())
    }

    /// `c − 0.6 m(c)`: the criterion rises with the level where it is negative.
    fn slack(&self) -> f64 {
        self.level - 0.6 * self.area / self.length()
    }

    /// What no criterion exceeds at a level between this and a higher one.
    fn most(&self, higher: &Self) -> f64 {
        let ends = self.value().max(higher.value());
        let apart = higher.level - self.level;
        let longer = self.length() - higher.length();
        // Means rise with the level: the criterion rises all the way, or falls.
        let is_steady = higher.level <= self.level - self.slack() || higher.slack() >= apart;
        if apart <= 0.0 || longer <= 0.0 || is_steady {
            return ends;
        }
        let beyond = (self.area - higher.area - self.level * longer) / apart;
        let beyond = beyond.clamp(0.0, longer);
        ends.max(criterion(higher.area + higher.level * beyond, higher.length() + beyond))
    }
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

    fn optimum(&self, cap: f64) -> Optimum {
        let (lowest, highest) = (self.ends[0].1.min(self.ends[1].1), self.top.1);
        let near = NEAR * (highest - lowest);
        let mut longest = self.cut(lowest, near);
        if longest.length() > cap {
            let excess = |level: f64| self.cut(level, near).length() - cap;
            let bracket = [(lowest, longest.length() - cap), (highest, -cap)];
            longest = self.cut(root(bracket[0], bracket[1], NEAR * cap, excess), near);
            // To the last digit as long as the cap, and where it begins or ends with the window there.
            let ((from, to), end) = (longest.interval, self.ends[1].0);
            longest.interval = if to < end { (from, from + cap) } else { (end - cap, end) };
            longest.area = self.area.between(longest.interval.0, longest.interval.1);
        }
        let range = (0.6 * highest - longest.level).max(0.0);
        let levels = (1..=LEVELS).map(|at| longest.level + range * at as f64 / LEVELS as f64);
        let mut cuts = vec![longest];
        cuts.extend(levels.filter(|level| *level > longest.level).map(|at| self.cut(at, near)));
        let (best, threshold) = self.searched(cuts, near);
        Optimum { value: best.value(), interval: best.interval, threshold }
    }

    /// The best at levels from that of the first of these to that of the last, and what may be missed of it.
    fn searched(&self, mut cuts: Vec<Cut>, near: f64) -> (Cut, f64) {
        let mut best = cuts[0];
        let mut pairs: Vec<[Cut; 2]> = Vec::with_capacity(4 * LEVELS);
        let at = (1..cuts.len())
            .fold(0, |at, other| if cuts[other].value() > cuts[at].value() { other } else { at });
        // The stationary level beside the best of the first to the last digits: then little else is in question.
        let around = |at: usize| cuts[at - 1].slack() < 0.0 && cuts[at].slack() > 0.0;
        if let Some(upper) = (at.max(1)..(at + 2).min(cuts.len())).find(|at| around(*at)) {
            let bracket = [cuts[upper - 1], cuts[upper]].map(|cut| (cut.level, cut.slack()));
            let slack = |level: f64| self.cut(level, near).slack();
            let level = root(bracket[0], bracket[1], near, slack);
            cuts.insert(upper, self.cut(level, near));
        }
        for cut in &cuts {
            if cut.value() > best.value() {
                best = *cut;
            }
        }
        pairs.extend(cuts.windows(2).map(|pair| [pair[0], pair[1]]));
        let (mut most, mut divided) = (0.0_f64, 0);
        while let Some([low, high]) = pairs.pop() {
            let (bound, value) = (low.most(&high), best.value());
            if bound <= value * (1.0 + RESOLUTION) {
                continue;
            }
            divided += 1;
            if high.level - low.level <= 2.0 * near || divided > MOST_PAIRS {
                most = most.max(bound);
                continue;
            }
            // Beside the best level the rest is told from it by its sign.
            let part = match value {
                value if high.value() >= value => BESIDE,
                value if low.value() >= value => 1.0 - BESIDE,
                _ => 0.5,
            };
            let cut = self.cut(low.level + part * (high.level - low.level), near);
            if cut.value() > value {
                best = cut;
            }
            pairs.extend([[low, cut], [cut, high]]);
        }
        (best, (most - best.value()).max(0.0))
    }

    /// The interval above a level, its ends as near to that as `near`.
    fn cut(&self, level: f64, near: f64) -> Cut {
        let interval = self.above(level, near);
        Cut { level, interval, area: self.area.between(interval.0, interval.1) }
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
}
