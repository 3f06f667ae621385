//! Where steps end in a span whose driving functions have corners.

use dashpot_numerics::dop853::{GROWTH, allowed};

use crate::methods::stepping::Walk;

/// A step crosses corners where it holds so many of them: to end at a single one costs no more, and is exact.
const CROSSED: usize = 2;
/// Where steps that cross corners shrink to one that does not, so many corners more are ended at before the next attempt, each
/// time twice as many.
const MOST_HELD: usize = 64;

/// The corners within a span at which a step may end, or which it may cross.
pub(super) struct Corners {
    /// When they come, counted from the start of the span; at last its end.
    times: Vec<f64>,
    /// The next one, and the one before.
    next: usize,
    before: f64,
    /// The first one that may be crossed, and how many more must not be where an attempt fails.
    free: usize,
    hold: usize,
    /// Whether the step at hand crosses some.
    is_crossing: bool,
}

impl Corners {
    pub(super) fn of(walk: &Walk<'_>) -> Self {
        let (start, end) = walk.span;
        let first = walk.corners.partition_point(|&time| time <= start);
        let inside = walk.corners[first..].iter().take_while(|&&time| time < end);
        let times = inside.map(|time| time - start).chain([end - start]).collect();
        Self { times, next: 0, before: 0.0, free: 0, hold: 1, is_crossing: false }
    }

    /// The step that is wanted behind one of this length and error that has been cut from what was wanted: where corners may be
    /// crossed it grows as the error lets it.
    pub(super) fn kept(&self, (wanted, step): (f64, f64), error: f64) -> f64 {
        let most = if self.times.len() > 1 { GROWTH.1 } else { 1.0 };
        allowed(step, error).min(most * wanted).max(wanted)
    }

    /// The borders between which a step of this length from `t` on is to end: the corners beside it, or those of the span where
    /// many lie within it.
    pub(super) fn around(&mut self, t: f64, step: f64) -> (f64, f64) {
        let last = self.times.len() - 1;
        while self.next < last && self.times[self.next] <= t {
            self.before = self.times[self.next];
            self.next += 1;
        }
        let crossed = self.times.get(self.next + CROSSED - 1);
        let is_crossing =
            self.next >= self.free && crossed.is_some_and(|&corner| corner < t + step);
        if self.is_crossing && !is_crossing {
            self.free = self.next + self.hold;
            self.hold = (2 * self.hold).min(MOST_HELD);
        }
        self.is_crossing = is_crossing;
        if is_crossing {
            (f64::NEG_INFINITY, self.times[last])
        } else {
            (self.before, self.times[self.next])
        }
    }

    /// The step at hand is accepted.
    pub(super) fn go_on(&mut self) {
        if self.is_crossing {
            self.hold = 1;
        }
        self.is_crossing = false;
    }
}
