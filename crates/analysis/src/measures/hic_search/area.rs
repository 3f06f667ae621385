//! The area under a signal, one way or the other, or under its absolute value.

use dashpot_dae::{Panel, Signal};
use dashpot_numerics::chebyshev::{self, Coefficients};

use super::{middle_of, rank, search::Range};

/// Less area than this part of the other is none.
const ROUNDING: f64 = 1e-12;

/// Which way of a signal counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Sense {
    /// `|s|`.
    Magnitude,
    /// `s`, or `−s` with the sign of −1.
    Along(f64),
}

impl Sense {
    fn of(self, value: f64) -> f64 {
        match self {
            Self::Magnitude => value.abs(),
            Self::Along(sign) => sign * value,
        }
    }
}

/// A signal in one sense over a window, cut at knots into monotone pieces, with its exact integral.
#[derive(Debug)]
pub(super) struct Area<'a> {
    sense: Sense,
    /// Where a piece begins or ends, in rising order.
    knots: Vec<f64>,
    /// The knots at which it jumps or ends.
    borders: Vec<f64>,
    /// Parts of panels on which the signal keeps its sign, in order of time.
    parts: Vec<Part<'a>>,
    /// Where they begin \[s\], by which they are found.
    starts: Vec<f64>,
    largest: f64,
}

/// A part of a panel on which the signal keeps its sign.
#[derive(Debug)]
struct Part<'a> {
    panel: &'a Panel,
    /// Coefficients of the panel's antiderivative.
    antiderivative: Coefficients,
    /// The sign of the signal.
    sign: f64,
    /// Whether it counts as area, and not against it.
    is_for: bool,
    /// Where the part begins \[s\], and the value there.
    start: f64,
    height: f64,
    /// Value of the antiderivative there.
    offset: f64,
    /// Area before the part, and what counts against it.
    before: [f64; 2],
}

impl Part<'_> {
    fn areas_until(&self, t: f64) -> [f64; 2] {
        if t <= self.start {
            return self.before;
        }
        let half = 0.5 * self.panel.length();
        let value = chebyshev::evaluate(&self.antiderivative, self.panel.place(t));
        let own = (self.sign * half * (value - self.offset)).max(0.0);
        let [with, against] = self.before;
        if self.is_for { [with + own, against] } else { [with, against + own] }
    }
}

impl<'a> Area<'a> {
    /// Cuts the signal in the window, whose magnitude counts.
    pub(super) fn new(signal: &'a Signal, window: (f64, f64)) -> Self {
        let sense = Sense::Magnitude;
        let window = (window.0.max(signal.start()), window.1.min(signal.end()));
        let inside = |t: &f64| *t > window.0 && *t < window.1;
        let zeros = signal.crossings(0.0, window).into_iter().map(|crossing| crossing.time);
        let zeros: Vec<f64> = zeros.filter(inside).collect();
        let jumps = signal.panels.windows(2).filter_map(|pair| {
            let (before, after) = (pair[0].value(pair[0].end), pair[1].value(pair[1].start));
            let rounding = 1e-12 * (before.abs() + after.abs());
            ((after - before).abs() > signal.noise.max(rounding)).then_some(pair[1].start)
        });
        let jumps: Vec<f64> = jumps.filter(inside).collect();
        let turns = signal.extrema(window).into_iter().map(|extremum| extremum.time);
        let mut knots: Vec<f64> = turns.filter(inside).chain(zeros.iter().copied()).collect();
        knots.extend(jumps.iter().copied().chain([window.0, window.1]));
        knots.sort_by(f64::total_cmp);
        knots.dedup();
        let mut borders = jumps;
        borders.extend([window.0, window.1]);
        borders.sort_by(f64::total_cmp);
        let parts = parts(signal, window, &zeros);
        let starts = parts.iter().map(|part| part.start).collect();
        let largest = signal.absolute_maximum(window).value;
        Self { sense, knots, borders, parts, starts, largest }
    }

    /// The same in another sense.
    pub(super) fn in_sense(&self, sense: Sense) -> Self {
        let mut before = [0.0; 2];
        let ends = self.parts.iter().skip(1).map(|own| own.start).chain(self.knots.last().copied());
        let turned = self.parts.iter().zip(ends).map(|(part, end)| {
            let height = sense.of(part.panel.value(part.start));
            let antiderivative = part.antiderivative.clone();
            let is_for = sense.of(part.sign) > 0.0;
            let own = Part { antiderivative, is_for, height, before, ..*part };
            before = own.areas_until(end);
            own
        });
        let parts = turned.collect();
        let [knots, borders, starts] = [&self.knots, &self.borders, &self.starts].map(Vec::clone);
        Self { sense, knots, borders, parts, starts, largest: self.largest }
    }

    /// That of a signal that is positive in the window and rises to one place, if any, and falls behind it.
    pub(super) fn of_hump(signal: &'a Signal, window: (f64, f64), top: f64) -> Self {
        let mut knots = vec![window.0, top, window.1];
        knots.dedup();
        let sense = Sense::Magnitude;
        let parts = parts(signal, window, &[]);
        let starts = parts.iter().map(|part| part.start).collect();
        let borders = vec![window.0, window.1];
        Self { sense, knots, borders, parts, starts, largest: signal.value(top) }
    }

    /// Whether the signal has both signs in the window, beyond rounding.
    pub(super) fn changes_sign(&self) -> bool {
        let [with, against] = self.of_signs();
        with.min(against) > ROUNDING * with.max(against)
    }

    /// The area where the signal is positive, and where it is negative.
    pub(super) fn of_signs(&self) -> [f64; 2] {
        let mut sums = [0.0_f64; 2];
        let ends = self.parts.iter().skip(1).map(|own| own.start);
        for (part, end) in self.parts.iter().zip(ends.chain(self.knots.last().copied())) {
            let until = part.areas_until(end);
            let own: f64 = until.iter().sum::<f64>() - part.before.iter().sum::<f64>();
            sums[usize::from(part.sign < 0.0)] += own;
        }
        sums
    }

    /// Where the monotone pieces meet, and both ends.
    pub(super) fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The knot in the middle of those between two times.
    pub(super) fn middle_knot(&self, from: f64, to: f64) -> Option<f64> {
        middle_of(&self.knots, from, to)
    }

    /// The largest value of `|s|`.
    pub(super) fn largest(&self) -> f64 {
        self.largest
    }

    /// Whether the signal jumps or ends at `t`.
    pub(super) fn is_border(&self, t: f64) -> bool {
        self.borders.binary_search_by(|border| border.total_cmp(&t)).is_ok()
    }

    /// The part in which a time is.
    fn part(&self, t: f64) -> usize {
        rank(&self.starts, t, |start| *start <= t).saturating_sub(1)
    }

    /// The value at a time at which it does not jump.
    pub(super) fn height(&self, t: f64) -> f64 {
        self.parts.get(self.part(t)).map_or(0.0, |part| self.sense.of(part.panel.value(t)))
    }

    /// Neighbours among both ends and the parts between them, between which it passes a level, each with its value:
    /// it is monotone between the ends, and on different sides of the level there.
    pub(super) fn around(&self, level: f64, [first, last]: [(f64, f64); 2]) -> [(f64, f64); 2] {
        let rises = last.1 > first.1;
        let from = self.starts.partition_point(|start| *start <= first.0);
        let to = self.starts.partition_point(|start| *start < last.0);
        let inside = self.parts.get(from..to).unwrap_or_default();
        let at = inside.partition_point(|part| (part.height < level) == rises);
        let place = |part: &Part<'_>| (part.start, part.height);
        let before = at.checked_sub(1).map_or(first, |before| place(&inside[before]));
        [before, inside.get(at).map_or(last, place)]
    }

    /// The area from `from` to `to`, less what counts against it.
    pub(super) fn between(&self, from: f64, to: f64) -> f64 {
        let [with, against] = self.areas(from, to);
        with - against
    }

    /// No area from one range to another one, which may be the same or overlap, is larger.
    pub(super) fn most(&self, first: (f64, f64), last: (f64, f64)) -> f64 {
        if first.1 > last.0 {
            return self.areas(first.0, last.1)[0];
        }
        let [of_first, of_last] = [first, last].map(|own| self.areas(own.0, own.1)[0]);
        of_first + self.between(first.1, last.0) + of_last
    }

    /// No area from one range to a later one is smaller; 0 at least.
    pub(super) fn least(&self, first: (f64, f64), last: (f64, f64)) -> f64 {
        let [of_first, of_last] = [first, last].map(|own| self.areas(own.0, own.1)[1]);
        (self.between(first.1, last.0) - of_first - of_last).max(0.0)
    }

    /// What counts as area between two times, and what counts against it.
    fn areas(&self, from: f64, to: f64) -> [f64; 2] {
        let until =
            |t: f64| self.parts.get(self.part(t)).map_or([0.0; 2], |part| part.areas_until(t));
        let (from, to) = (until(from), until(to));
        [0, 1].map(|at: usize| (to[at] - from[at]).max(0.0))
    }

    /// Bounds of the value between two times on one monotone piece; from the right at the first, from
    /// the left at the second.
    pub(super) fn range(&self, from: f64, to: f64) -> Range {
        let value = |at: usize, t: f64| {
            self.parts.get(at).map_or(0.0, |own| self.sense.of(own.panel.value(t)))
        };
        let first = value(self.part(from), from);
        let mut at = self.part(to);
        if at > 0 && self.parts[at].start >= to {
            at -= 1;
        }
        let last = value(at, to);
        Range { low: first.min(last), high: first.max(last) }
    }
}

/// The panels of the signal in the window, cut at its zeros, whose magnitude counts.
fn parts<'a>(signal: &'a Signal, window: (f64, f64), zeros: &[f64]) -> Vec<Part<'a>> {
    let mut parts = Vec::with_capacity(signal.panels.len() + zeros.len());
    let mut before = [0.0; 2];
    for panel in &signal.panels {
        let (start, end) = (panel.start.max(window.0), panel.end.min(window.1));
        if start >= end {
            continue;
        }
        let first = zeros.partition_point(|zero| *zero <= start);
        let inside = zeros[first..].iter().copied().take_while(|zero| *zero < end);
        let mut from = start;
        for to in inside.chain([end]) {
            let antiderivative = chebyshev::antiderivative(&panel.coefficients);
            let sign = panel.value(0.5 * (from + to)).signum();
            let offset = chebyshev::evaluate(&antiderivative, panel.place(from));
            let (start, height) = (from, panel.value(from).abs());
            let part =
                Part { panel, antiderivative, sign, is_for: true, start, height, offset, before };
            before = part.areas_until(to);
            parts.push(part);
            from = to;
        }
    }
    parts
}
