//! Where a signal passes a level.

use std::iter;

use dashpot_numerics::chebyshev::{self, bracketed_root, evaluate, sign_changes};

use super::{Crossing, Panel, Signal};

impl Signal {
    /// All places in the window at which the signal passes or touches the `level`, in order of time.
    ///
    /// A value within [`noise`](Self#structfield.noise), or a few roundings, of the level is *on* it. The signal passes
    /// the level where it comes from one side of it to the other, in one jump or through places on it; it touches the
    /// level where it comes from one side, to the level itself, and back to the same side. So
    /// - it does not pass the level where it begins or ends on it (see [`departure`](Self::departure));
    /// - two passages between which it strays from the level by no more than the noise are one touch;
    /// - a signal that rests on the level, that is for at least one panel, neither passes nor
    ///   touches it there; if it leaves to the other side, the passage is where it does so.
    pub fn crossings(&self, level: f64, window: (f64, f64)) -> Vec<Crossing> {
        let mut found = Vec::new();
        self.visit_crossings(level, window, |crossing| {
            found.push(crossing);
            true
        });
        found
    }

    /// The first of the [`crossings`](Self::crossings) that goes the way of `rising`: `Some(true)`
    /// up, `Some(false)` down, `None` any, touches included.
    pub fn first_crossing(
        &self,
        level: f64,
        window: (f64, f64),
        rising: Option<bool>,
    ) -> Option<Crossing> {
        let mut first = None;
        self.visit_crossings(level, window, |crossing| {
            let wanted = rising.is_none() || crossing.rising == rising;
            if wanted {
                first = Some(crossing);
            }
            !wanted
        });
        first
    }

    /// The side of the `level` on which the signal is at and after `t`, `Some(true)` above: that of its value, or if
    /// this is on the level, of its first derivative that is not zero beyond its noise. `None` if it stays on the level
    /// to its end. At the end of the signal the last panel is thought to go on.
    pub fn departure(&self, level: f64, t: f64) -> Option<bool> {
        for panel in self.panels.get(self.panel_at(t)..)? {
            let mut gap = panel.coefficients.clone();
            *gap.first_mut()? -= level;
            let mut noise = self.floor(panel, level);
            let x = panel.place(t);
            let (mut left, mut order) = (gap.len(), 0_u32);
            while left > 0 {
                let value = evaluate(&gap, x);
                if value.abs() > noise {
                    return Some(value > 0.0);
                }
                left -= 1;
                noise *= growth(panel.coefficients.len() - 1, order);
                gap = chebyshev::derivative(&gap);
                order += 1;
            }
        }
        None
    }

    /// Whether all of a panel is so far from a level that no [floor](Self::floor) reaches there.
    fn is_far(&self, panel: &Panel, level: f64) -> bool {
        let middle = panel.coefficients.first().copied().unwrap_or(0.0);
        let spread = chebyshev::variation(&panel.coefficients);
        let rounding = 8.0 * f64::EPSILON * (level.abs() + middle.abs() + spread);
        (middle - level).abs() > 2.0 * spread + rounding + self.noise
    }

    /// Calls `visit` with each crossing until it returns `false`.
    fn visit_crossings(
        &self,
        level: f64,
        window: (f64, f64),
        mut visit: impl FnMut(Crossing) -> bool,
    ) {
        let mut follower = Follower::default();
        for panel in self.panels_in(window) {
            let [first, last] = chebyshev::at_ends(&panel.coefficients);
            if self.is_far(&panel, level) {
                for (x, value) in [(-1.0, first), (1.0, last)] {
                    let point = Point { time: panel.time(x), gap: value - level, noise: 0.0 };
                    if let Some((time, rising)) = follower.advance(point, || point.time)
                        && !visit(Crossing { time, slope: self.slope(time), rising })
                    {
                        return;
                    }
                }
                continue;
            }
            let noise = self.floor(&panel, level);
            let search = Search::new(&panel, level, noise);
            let mut before = None;
            let inside = search.turns.iter().map(|&x| (x, evaluate(&panel.coefficients, x)));
            for (x, value) in iter::once((-1.0, first)).chain(inside).chain([(1.0, last)]) {
                let gap = value - level;
                let point = Point { time: panel.time(x), gap, noise };
                let crossed = follower.advance(point, || match before {
                    Some(before) => search.passage(before, (x, gap)),
                    None => point.time,
                });
                if let Some((time, rising)) = crossed {
                    let crossing = Crossing { time, slope: self.slope(time), rising };
                    if !visit(crossing) {
                        return;
                    }
                }
                before = Some((x, gap));
            }
            if search.rests && panel.length() > 0.0 {
                follower.rest(panel.end);
            }
        }
    }
}

/// The quotient of Markov's bounds of a polynomial's derivatives of one order and the next: the
/// product over the orders bounds a derivative by the polynomial itself.
fn growth(degree: usize, order: u32) -> f64 {
    let n = f64::from(u32::try_from(degree).unwrap_or(u32::MAX));
    let k = f64::from(order);
    (n * n - k * k) / (2.0 * k + 1.0)
}

/// The search for a level within one panel.
#[derive(Debug)]
struct Search<'a> {
    panel: &'a Panel,
    level: f64,
    /// Places inside between which the panel is monotone, as far as that matters.
    turns: Vec<f64>,
    /// Whether all of it is on the level.
    rests: bool,
}

impl<'a> Search<'a> {
    fn new(panel: &'a Panel, level: f64, noise: f64) -> Self {
        let middle = panel.coefficients.first().map_or(0.0, |c| (c - level).abs());
        let spread = chebyshev::variation(&panel.coefficients);
        let rests = middle + spread <= noise;
        // In a panel that stays on one side, or on the level, nothing is to be found inside.
        let turns = if !rests && middle <= spread + noise {
            sign_changes(&chebyshev::derivative(&panel.coefficients))
        } else {
            Vec::new()
        };
        Self { panel, level, turns, rests }
    }

    /// When the level is passed between two places `(x, gap)` on different sides.
    fn passage(&self, before: (f64, f64), after: (f64, f64)) -> f64 {
        if self.rests {
            return self.panel.end;
        }
        let mut gap = self.panel.coefficients.clone();
        if let Some(constant) = gap.first_mut() {
            *constant -= self.level;
        }
        let slope = chebyshev::derivative(&gap);
        self.panel.time(bracketed_root(&gap, &slope, before, after))
    }
}

/// A place of the signal, as seen from the level.
#[derive(Debug, Clone, Copy)]
struct Point {
    time: f64,
    /// Value minus level.
    gap: f64,
    /// Size of a gap that cannot be told from zero.
    noise: f64,
}

impl Point {
    /// The side of the level it is on, if any.
    fn side(self) -> Option<bool> {
        (self.gap.abs() > self.noise).then_some(self.gap > 0.0)
    }
}

/// A stay on the level.
#[derive(Debug, Clone, Copy)]
struct Dwell {
    /// Its point farthest to the other side.
    deepest: Point,
    /// Where the sign changed last.
    passage: f64,
    /// Whether it took a whole panel.
    rests: bool,
}

/// Follows a signal from one point to the next, between which it is monotone or jumps.
#[derive(Debug, Default)]
struct Follower {
    last: Option<Point>,
    /// The side on which the signal was last.
    side: Option<bool>,
    dwell: Option<Dwell>,
}

impl Follower {
    /// Goes on to `point`; `root` tells when the gap is zero on the way there, if its sign
    /// changes. Returns time and direction of a crossing that is then known.
    fn advance(&mut self, point: Point, root: impl FnOnce() -> f64) -> Option<(f64, Option<bool>)> {
        let last = self.last.replace(point);
        let changes = last.is_some_and(|last| {
            last.gap != 0.0 && point.gap != 0.0 && (last.gap < 0.0) != (point.gap < 0.0)
        });
        let Some(side) = point.side() else {
            let came_from = self.side?;
            let passage = if changes { root() } else { point.time };
            let dwell = self.dwell.get_or_insert(Dwell { deepest: point, passage, rests: false });
            if changes || point.gap == 0.0 {
                dwell.passage = passage;
            }
            let depth = |point: Point| if came_from { -point.gap } else { point.gap };
            if depth(point) > depth(dwell.deepest) {
                dwell.deepest = point;
            }
            return None;
        };
        let came_from = self.side.replace(side);
        let dwell = self.dwell.take();
        match (came_from, dwell) {
            (None, _) => None,
            (Some(before), Some(dwell)) if before == side => {
                (!dwell.rests).then_some((dwell.deepest.time, None))
            }
            (Some(before), None) if before == side => None,
            (Some(_), Some(dwell)) if !changes => Some((dwell.passage, Some(side))),
            (Some(_), _) => Some((root(), Some(side))),
        }
    }

    /// Notes that the signal was on the level for a whole panel that ended at `end`.
    fn rest(&mut self, end: f64) {
        if let Some(dwell) = &mut self.dwell {
            dwell.rests = true;
            dwell.passage = end;
        }
    }
}
