//! Branch and bound over all intervals.

use std::{cmp::Ordering, collections::BinaryHeap};

use super::{Optimum, RESOLUTION, area::Area, criterion, middle_of};

/// Boxes that are looked into before the search settles for a bound.
const MOST_BOXES: usize = 2_000_000;
/// After so many boxes so much of a maximum may be missed, in parts of it, which then is stated: long records have
/// thousands of pulses that are all as good as each other.
const COARSER: [(usize, f64); 2] = [(50_000, 1e-9), (150_000, 1e-6)];
/// Times between which intervals are tried before the search.
const MOST_FIRST: usize = 64;
/// A box that is as short as this, in parts of the interval, is not divided further: what it may hold beyond its
/// middle is stated instead.
const SMALLEST: f64 = 1e-12;
/// By so much, in parts of it, an interval from sample to sample may exceed the cap: times of samples are rounded.
const ROUNDED_CAP: f64 = 1e-9;

/// The same by a search through all intervals.
pub(super) fn searched(area: &Area<'_>, window: (f64, f64), cap: f64) -> Optimum {
    better(area, cap, Optimum::none(window))
}

/// The same, if it exceeds another one.
pub(super) fn better(area: &Area<'_>, cap: f64, best: Optimum) -> Optimum {
    let mut search = Search::new(area, cap, None, best);
    search.run();
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
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
}

pub(super) struct Search<'a> {
    area: &'a Area<'a>,
    cap: f64,
    /// Times at which intervals begin and end alone; `None` for all.
    places: Option<&'a [f64]>,
    /// Starts of intervals as long as the cap of which either end lies between two monotone pieces.
    turns: Vec<f64>,
    pub(super) best: Optimum,
    open: BinaryHeap<Candidate>,
    visited: usize,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        area: &'a Area<'a>,
        cap: f64,
        places: Option<&'a [f64]>,
        best: Optimum,
    ) -> Self {
        Self { area, cap, places, turns: Vec::new(), best, open: BinaryHeap::new(), visited: 0 }
    }

    pub(super) fn run(&mut self) {
        let times = self.places.unwrap_or(self.area.knots());
        let [Some(&from), Some(&to)] = [times.first(), times.last()] else { return };
        if self.area.largest() <= 0.0 || self.cap <= 0.0 {
            return;
        }
        // Good intervals first, so that most boxes are dropped at once.
        let first = times.iter().step_by(times.len().div_ceil(MOST_FIRST));
        let first: Vec<f64> = first.copied().chain([to]).collect();
        for (at, &from) in first.iter().enumerate() {
            for &to in &first[at + 1..] {
                self.consider(from, to);
            }
        }
        let all = Side { from, to };
        self.push(Family::Free(all, all));
        // From sample to sample those as long as the cap are among the others.
        if self.places.is_none() && to - self.cap > from {
            let last = to - self.cap;
            let knots = self.area.knots().iter();
            self.turns = knots.flat_map(|knot| [*knot, knot - self.cap]).collect();
            self.turns.retain(|place| *place > from && *place < last);
            self.turns.sort_by(f64::total_cmp);
            self.push(Family::Capped(Side { from, to: last }));
        }
        while let Some(candidate) = self.open.pop() {
            if candidate.bound <= self.enough() {
                break;
            }
            self.visited += 1;
            if self.visited > MOST_BOXES {
                self.give_up(candidate.bound);
                break;
            }
            match candidate.family {
                Family::Free(first, last) => self.divide_free(first, last),
                Family::Capped(side) => self.divide_capped(side),
            }
        }
        if self.resolution() > RESOLUTION {
            self.give_up(self.enough());
        }
    }

    /// What a box has to exceed to be looked into.
    fn enough(&self) -> f64 {
        self.best.value * (1.0 + self.resolution())
    }

    fn resolution(&self) -> f64 {
        let passed = COARSER.iter().rev().find(|coarser| self.visited > coarser.0);
        passed.map_or(RESOLUTION, |coarser| coarser.1)
    }

    /// Leaves a box as it is.
    fn give_up(&mut self, bound: f64) {
        self.best.threshold = self.best.threshold.max(bound - self.best.value);
    }

    /// The longest interval.
    fn longest(&self) -> f64 {
        if self.places.is_some() { self.cap * (1.0 + ROUNDED_CAP) } else { self.cap }
    }

    pub(super) fn consider(&mut self, from: f64, to: f64) {
        if self.places.is_some() && to - from > self.longest() {
            return;
        }
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
            Family::Free(first, last) if last.from - first.to > self.longest() => return,
            Family::Free(first, last) => {
                let shortest = (last.from - first.to).max(0.0);
                let longest = (last.to - first.from).min(self.longest());
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
        if bound > self.enough() {
            self.open.push(Candidate { bound, family });
        }
    }

    fn divide_free(&mut self, first: Side, last: Side) {
        let knots = [first, last].map(|side| self.area.middle_knot(side.from, side.to));
        let in_pieces = knots == [None; 2];
        let Some(places) = self.places else {
            self.consider(first.middle(), last.middle());
            if !in_pieces {
                self.divide(first, last, knots);
            } else if !self.is_settled(first, last) {
                let longer = first.length() >= last.length();
                let middles = [longer.then(|| first.middle()), Some(last.middle())];
                self.divide(first, last, middles);
            }
            return;
        };
        let middles = [first, last].map(|side| middle_of(places, side.from, side.to));
        self.consider(middles[0].unwrap_or(first.from), middles[1].unwrap_or(last.to));
        if middles == [None; 2] {
            for from in [first.from, first.to] {
                self.consider(from, last.from);
                self.consider(from, last.to);
            }
        } else if !(in_pieces && self.is_settled(first, last)) {
            self.divide(first, last, middles);
        }
    }

    /// Whether a box within monotone pieces holds nothing better, or one edge of it stands for all.
    fn is_settled(&mut self, first: Side, last: Side) -> bool {
        let mean = self.mean(first, last);
        // A later start loses s(t1) and shortens the interval; the criterion rises with t1 while
        // s(t1) < 0.6 mean, and with t2 while s(t2) > 0.6 mean.
        let critical = Range { low: 0.6 * mean.low, high: 0.6 * mean.high };
        let is_long = |side: Side| side.length() > 0.0;
        let starts = is_long(first).then(|| self.area.range(first.from, first.to));
        let ends = is_long(last).then(|| self.area.range(last.from, last.to));
        // From sample to sample the longer of two intervals may be too long.
        let all_fit = self.places.is_none() || last.to - first.from <= self.cap;
        if let Some(height) = starts {
            if height.high <= critical.low {
                self.keep_edge(first.to, |time| Family::Free(time, last));
                return true;
            }
            if height.low >= critical.high && all_fit {
                self.keep_edge(first.from, |time| Family::Free(time, last));
                return true;
            }
        }
        if let Some(height) = ends {
            if height.low >= critical.high && all_fit {
                self.keep_edge(last.to, |time| Family::Free(first, time));
                return true;
            }
            if height.high <= critical.low {
                self.keep_edge(last.from, |time| Family::Free(first, time));
                return true;
            }
        }
        let shortest = last.from - first.to;
        if mean.low <= 0.0 {
            return first.length() + last.length() <= 0.0;
        }
        let slope = |height: Option<Range>| {
            let of = |height: f64, mean: f64| (1.5 - 2.5 * height / mean).abs() / shortest;
            let at = |height: f64| of(height, mean.low).max(of(height, mean.high));
            height.map_or(0.0, |height| at(height.low).max(at(height.high)))
        };
        let (from, to) = (first.middle(), last.middle());
        let middle = criterion(self.area.between(from, to), to - from);
        let apart = slope(starts) * first.length() + slope(ends) * last.length();
        let bound = middle * (0.5 * apart).exp();
        if bound <= self.enough() {
            return true;
        }
        let smallest = (SMALLEST * shortest).max(4.0 * f64::EPSILON * last.to.abs());
        let is_smallest = first.length().max(last.length()) <= smallest;
        if is_smallest {
            self.give_up(bound);
        }
        is_smallest
    }

    /// Divides a box at one of two times, within its starts or its ends.
    fn divide(&mut self, first: Side, last: Side, [of_first, of_last]: [Option<f64>; 2]) {
        match (of_first, of_last) {
            (None, None) => {}
            (Some(time), _) if first == last => {
                let [early, late] = first.parts(time);
                for (first, last) in [(early, early), (early, late), (late, late)] {
                    self.push(Family::Free(first, last));
                }
            }
            (Some(time), other) if other.is_none() || first.length() >= last.length() => {
                first.parts(time).into_iter().for_each(|part| self.push(Family::Free(part, last)));
            }
            (_, Some(time)) | (Some(time), _) => {
                last.parts(time).into_iter().for_each(|part| self.push(Family::Free(first, part)));
            }
        }
    }

    fn divide_capped(&mut self, side: Side) {
        let middle = side.middle();
        self.consider(middle, middle + self.cap);
        if let Some(turn) = middle_of(&self.turns, side.from, side.to) {
            return side.parts(turn).into_iter().for_each(|part| self.push(Family::Capped(part)));
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
        let slope = (ends.high - starts.low).max(starts.high - ends.low);
        let area = self.area.between(middle, middle + self.cap) + 0.5 * side.length() * slope;
        let bound = criterion(area, self.cap);
        if bound <= self.enough() {
            return;
        }
        if side.length() <= (SMALLEST * self.cap).max(inward) {
            return self.give_up(bound);
        }
        side.parts(middle).into_iter().for_each(|part| self.push(Family::Capped(part)));
    }

    /// Goes on with one edge of a box in which the criterion is monotone; not where the signal is continuous, as a
    /// neighbour has more.
    fn keep_edge(&mut self, edge: f64, family: impl Fn(Side) -> Family) {
        if self.places.is_some() || self.area.is_border(edge) {
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
