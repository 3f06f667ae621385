//! The interval that maximises the head injury criterion.

mod area;
mod hump;

use std::{cmp::Ordering, collections::BinaryHeap};

use area::{Area, Sense};
use dashpot_dae::Signal;

/// Boxes that are looked into before the search settles for a bound.
const MOST_BOXES: usize = 400_000;
/// Knots between which intervals are tried before the search.
const MOST_FIRST: usize = 64;
/// Relative length, in units of the interval, of a box that is not divided further. The criterion
/// is stationary inside, so its value is good to the square of this.
const SMALLEST: f64 = 1e-8;

/// The interval `[t1, t2]` that maximises `(t2 − t1)(V/(t2 − t1))^2.5`, `V = |∫ s dt|`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optimum {
    /// The maximum \[unit^2.5·s\].
    pub value: f64,
    /// Its interval \[s\].
    pub interval: (f64, f64),
    /// How much larger a maximum that was missed could be, beyond rounding.
    pub threshold: f64,
}

impl Optimum {
    /// That of nothing.
    fn none(window: (f64, f64)) -> Self {
        Self { value: 0.0, interval: (window.0, window.0), threshold: 0.0 }
    }
}

/// Finds the largest head injury criterion of a signal over all intervals in the window that are
/// no longer than `cap`.
///
/// The signal of one axis counts with its sign, as SAE J885 and ISO 6487 have it of a channel: a swing back takes from the
/// area. It is looked at in both senses.
///
/// It is cut into monotone pieces, on which its values and its integral, taken from the exact
/// antiderivative, are bounded. Branch and bound over pairs of ranges of pieces, divided down to single
/// ones, drops what can hold no more than the best interval so far, and of single pieces what holds no zero of
/// the derivatives: an optimum lies where
/// `s(t1)` and `s(t2)` are 0.6 times the mean, at a jump or an end of the window, or, where the
/// cap is active, where `s(t1) = s(t2)`. Nothing is sampled, so no optimum is missed. A signal with a single
/// hump needs no more than a search for its level.
///
/// Dense output of a run and the line between the samples of a record are both such signals.
pub fn optimum(signal: &Signal, window: (f64, f64), cap: f64) -> Optimum {
    let area = Area::new(signal, window, Sense::Magnitude);
    let [with, against] = area.of_signs();
    if !area.changes_sign() {
        return hump::optimum(&area, cap).unwrap_or_else(|| searched(&area, window, cap));
    }
    // The sense with more area first: what the other one has to exceed then ends its search at once.
    let first = if with >= against { 1.0 } else { -1.0 };
    let in_sense = |best: Optimum, sign: f64| {
        better(&Area::new(signal, window, Sense::Along(sign)), cap, best)
    };
    [first, -first].into_iter().fold(Optimum::none(window), in_sense)
}

/// The same of the magnitude of a signal that has both signs in the window, as of a resultant; `None` of one that has
/// not, whose magnitude counts as the signal does.
pub(crate) fn optimum_of_magnitude(
    signal: &Signal,
    window: (f64, f64),
    cap: f64,
) -> Option<Optimum> {
    let area = Area::new(signal, window, Sense::Magnitude);
    let found = || hump::optimum(&area, cap).unwrap_or_else(|| searched(&area, window, cap));
    area.changes_sign().then(found)
}

/// The same for a signal that is positive in the window and rises to one place, and falls behind it; either may be
/// missing.
pub(crate) fn optimum_of_hump(signal: &Signal, window: (f64, f64), top: f64, cap: f64) -> Optimum {
    let area = Area::of_hump(signal, window, top);
    hump::optimum(&area, cap).unwrap_or_else(|| searched(&area, window, cap))
}

/// The same by a search through all intervals.
fn searched(area: &Area<'_>, window: (f64, f64), cap: f64) -> Optimum {
    better(area, cap, Optimum::none(window))
}

/// The same, if it exceeds another one.
fn better(area: &Area<'_>, cap: f64, best: Optimum) -> Optimum {
    let mut search = Search { area, cap, best, open: BinaryHeap::new(), visited: 0 };
    if area.largest() > 0.0 && cap > 0.0 {
        search.run();
    }
    search.best
}

/// A range of times, on one monotone piece or of whole ones; a single time where both ends are one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    from: f64,
    to: f64,
}

impl Side {
    fn length(self) -> f64 {
        self.to - self.from
    }

    fn ends(self) -> (f64, f64) {
        (self.from, self.to)
    }

    fn middle(self) -> f64 {
        0.5 * (self.from + self.to)
    }

    fn halves(self) -> [Self; 2] {
        self.parts(self.middle())
    }

    fn parts(self, middle: f64) -> [Self; 2] {
        [Self { to: middle, ..self }, Self { from: middle, ..self }]
    }
}

/// A set of intervals.
#[derive(Debug, Clone, Copy)]
enum Family {
    /// Those that begin in one range and end in another.
    Free(Side, Side),
    /// Those as long as the cap that begin in a range.
    Capped(Side),
}

/// A set of intervals and what no criterion in it exceeds.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    bound: f64,
    family: Family,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// Numbers between which a quantity lies.
#[derive(Debug, Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

struct Search<'a> {
    area: &'a Area<'a>,
    cap: f64,
    best: Optimum,
    open: BinaryHeap<Candidate>,
    visited: usize,
}

impl Search<'_> {
    fn run(&mut self) {
        let knots: Vec<f64> = self.area.knots().to_vec();
        // Good intervals first, so that most boxes are dropped at once.
        let first = knots.iter().step_by(knots.len().div_ceil(MOST_FIRST));
        let first: Vec<f64> = first.chain(knots.last()).copied().collect();
        for (at, &from) in first.iter().enumerate() {
            for &to in &first[at + 1..] {
                self.consider(from, to);
            }
        }
        if let Some((&from, &to)) = knots.first().zip(knots.last()) {
            let all = Side { from, to };
            self.push(Family::Free(all, all));
        }
        for side in self.capped_sides(&knots) {
            self.push(Family::Capped(side));
        }
        while let Some(candidate) = self.open.pop() {
            if candidate.bound <= self.best.value * (1.0 + 1e-14) {
                break;
            }
            self.visited += 1;
            if self.visited > MOST_BOXES {
                let missed = candidate.bound - self.best.value;
                self.best.threshold = self.best.threshold.max(missed);
                break;
            }
            match candidate.family {
                Family::Free(first, last) => self.divide_free(first, last),
                Family::Capped(side) => self.divide_capped(side),
            }
        }
    }

    /// The ranges of starts in which neither end of an interval as long as the cap leaves its
    /// monotone piece.
    fn capped_sides(&self, knots: &[f64]) -> Vec<Side> {
        let (Some(&start), Some(&end)) = (knots.first(), knots.last()) else { return Vec::new() };
        let last = end - self.cap;
        if last <= start {
            return Vec::new();
        }
        let mut places: Vec<f64> = knots
            .iter()
            .copied()
            .chain(knots.iter().map(|knot| knot - self.cap))
            .filter(|&place| place > start && place < last)
            .chain([start, last])
            .collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        places.windows(2).map(|pair| Side { from: pair[0], to: pair[1] }).collect()
    }

    fn consider(&mut self, from: f64, to: f64) {
        // A start from the cap is as good as one just inside it.
        let to = to.min(from + self.cap);
        if to <= from {
            return;
        }
        let value = criterion(self.area.between(from, to), to - from);
        if value > self.best.value {
            self.best = Optimum { value, interval: (from, to), ..self.best };
        }
    }

    fn push(&mut self, family: Family) {
        let bound = match family {
            Family::Free(first, last) if last.from - first.to > self.cap => return,
            Family::Free(first, last) => {
                let shortest = (last.from - first.to).max(0.0);
                let longest = (last.to - first.from).min(self.cap);
                let area = self.area.most(first.ends(), last.ends());
                let largest = self.area.largest();
                let by_height = criterion(largest * longest, longest);
                // A given area weighs most in the shortest time in which it has room.
                let shortest = shortest.max(area / largest);
                by_height.min(criterion(area, shortest))
            }
            Family::Capped(side) => {
                let far = (side.from + self.cap, side.to + self.cap);
                criterion(self.area.most(side.ends(), far), self.cap)
            }
        };
        if bound > self.best.value * (1.0 + 1e-14) {
            self.open.push(Candidate { bound, family });
        }
    }

    fn divide_free(&mut self, first: Side, last: Side) {
        self.consider(first.middle(), last.middle());
        if self.divide_pieces(first, last) {
            return;
        }
        let distance = last.middle() - first.middle();
        if first.length().max(last.length()) <= SMALLEST * distance {
            return;
        }
        let mean = self.mean(first, last);
        let critical = Range { low: 0.6 * mean.low, high: 0.6 * mean.high };
        // A later start loses s(t1) and shortens the interval; the criterion rises with t1 while
        // s(t1) < 0.6 mean, and with t2 while s(t2) > 0.6 mean.
        let starts = (first.length() > 0.0).then(|| self.area.range(first.from, first.to));
        if let Some(height) = starts {
            if height.high <= critical.low {
                return self.keep_edge(first.to, |time| Family::Free(time, last));
            }
            if height.low >= critical.high {
                return self.keep_edge(first.from, |time| Family::Free(time, last));
            }
        }
        let ends = (last.length() > 0.0).then(|| self.area.range(last.from, last.to));
        if let Some(height) = ends {
            if height.low >= critical.high {
                return self.keep_edge(last.to, |time| Family::Free(first, time));
            }
            if height.high <= critical.low {
                return self.keep_edge(last.from, |time| Family::Free(first, time));
            }
        }
        if first.length() >= last.length() {
            first.halves().into_iter().for_each(|half| self.push(Family::Free(half, last)));
        } else {
            last.halves().into_iter().for_each(|half| self.push(Family::Free(first, half)));
        }
    }

    /// Divides a box of more than one piece at a knot; whether it is one.
    fn divide_pieces(&mut self, first: Side, last: Side) -> bool {
        let [of_first, of_last] =
            [first, last].map(|side| self.area.middle_knot(side.from, side.to));
        match (of_first, of_last) {
            (None, None) => return false,
            (Some(knot), _) if first == last => {
                let [early, late] = first.parts(knot);
                for (first, last) in [(early, early), (early, late), (late, late)] {
                    self.push(Family::Free(first, last));
                }
            }
            (Some(knot), other) if other.is_none() || first.length() >= last.length() => {
                first.parts(knot).into_iter().for_each(|part| self.push(Family::Free(part, last)));
            }
            (_, Some(knot)) | (Some(knot), _) => {
                last.parts(knot).into_iter().for_each(|part| self.push(Family::Free(first, part)));
            }
        }
        true
    }

    fn divide_capped(&mut self, side: Side) {
        let middle = side.middle();
        self.consider(middle, middle + self.cap);
        if side.length() <= SMALLEST * self.cap {
            return;
        }
        // Rounding must not carry the far end over a jump.
        let inward = 4.0 * f64::EPSILON * (side.to.abs() + self.cap);
        let starts = self.area.range(side.from + inward, side.to - inward);
        let far = (side.from + self.cap + inward, side.to + self.cap - inward);
        let ends = self.area.range(far.0, far.1);
        // Where the area does not change beyond rounding, one edge stands for all.
        let noise = 1e-13 * self.area.largest();
        if ends.low >= starts.high - noise {
            return self.consider(side.to, side.to + self.cap);
        }
        if ends.high <= starts.low + noise {
            return self.consider(side.from, side.from + self.cap);
        }
        side.halves().into_iter().for_each(|half| self.push(Family::Capped(half)));
    }

    /// Goes on with one edge of a box in which the criterion is monotone. Within a continuous
    /// stretch the neighbour has that edge too, and more.
    fn keep_edge(&mut self, edge: f64, family: impl Fn(Side) -> Family) {
        if self.area.is_border(edge) {
            self.push(family(Side { from: edge, to: edge }));
        }
    }

    /// Bounds of `V/(t2 − t1)` over a box.
    fn mean(&self, first: Side, last: Side) -> Range {
        let largest = self.area.largest();
        let longest = last.to - first.from;
        let shortest = last.from - first.to;
        let low =
            if shortest > 0.0 { self.area.least(first.ends(), last.ends()) / longest } else { 0.0 };
        let high = if shortest > 0.0 {
            (self.area.most(first.ends(), last.ends()) / shortest).min(largest)
        } else {
            largest
        };
        Range { low, high }
    }
}

/// `T (V/T)^2.5`; 0 for an interval without length.
fn criterion(area: f64, length: f64) -> f64 {
    if length > 0.0 && area > 0.0 {
        let mean = area / length;
        length * mean * mean * mean.sqrt()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests;
