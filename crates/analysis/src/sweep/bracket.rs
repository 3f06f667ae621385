//! Where a signal turns, or falls through zero, within a step.

use dashpot_numerics::{
    exponential::advanced,
    roots::Bracket,
    small::{Square, apply},
};

/// Newton's method ends after so many rounds.
const ROUNDS: usize = 12;
/// It has found the place when it moves by less than this part of the step …
const NEAR: f64 = 1e-5;
/// … or what its last move leaves, by the third rate, is less than this part of the value.
const LEFT: f64 = 1e-14;
/// The third rate may be so much larger than the difference of the second ones says.
const CAUTION: f64 = 8.0;

/// A signal and its first two rates at both ends of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flank {
    pub(super) value: [f64; 2],
    pub(super) rate: [f64; 2],
    pub(super) bend: [f64; 2],
}

impl Flank {
    /// The signal that stands at `place` and behind among what is seen at both ends.
    pub(super) fn of(first: &[f64; 6], last: &[f64; 6], place: usize) -> Self {
        Self {
            value: [first[place], last[place]],
            rate: [first[place + 1], last[place + 1]],
            bend: [first[place + 2], last[place + 2]],
        }
    }

    pub(super) fn rises_then_falls(&self) -> bool {
        self.rate[0] > 0.0 && self.rate[1] <= 0.0
    }

    /// The rate within the step as a cubic, by Bernstein's coefficients.
    fn cubic(&self, step: f64) -> [f64; 4] {
        let [first, last] = self.rate;
        let third = step / 3.0;
        [first, first + third * self.bend[0], last - third * self.bend[1], last]
    }

    /// Whether the rate keeps its sign within the step, as far as its values and slopes at both ends tell.
    pub(super) fn is_straight(&self, step: f64) -> bool {
        // It turns up once, which makes no peak.
        self.is_steady(step) || self.rate[0] < 0.0 && self.rate[1] > 0.0
    }

    /// Whether the signal only rises or only falls within the step.
    pub(super) fn is_steady(&self, step: f64) -> bool {
        let cubic = self.cubic(step);
        cubic.iter().all(|own| *own >= 0.0) || cubic.iter().all(|own| *own <= 0.0)
    }

    /// What the signal does not exceed within the step.
    pub(super) fn bound(&self, step: f64) -> f64 {
        self.value[0].min(self.value[1]) + step * self.steepest(step)
    }

    fn steepest(&self, step: f64) -> f64 {
        self.cubic(step).into_iter().fold(0.0, |most: f64, own| most.max(own.abs()))
    }
}

/// A step of the solution.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<'s, const N: usize> {
    pub(super) matrix: &'s Square<N>,
    /// What is seen, over the states.
    pub(super) looks: &'s [[f64; 6]; N],
    pub(super) length: f64,
    /// The states at both ends.
    pub(super) ends: [&'s [f64; N]; 2],
}

impl<const N: usize> Step<'_, N> {
    /// The state at a time after the beginning, by its series from the nearer end.
    pub(super) fn state(&self, time: f64) -> [f64; N] {
        if time > 0.5 * self.length {
            advanced(self.matrix, time - self.length, self.ends[1])
        } else {
            advanced(self.matrix, time, self.ends[0])
        }
    }

    /// When the signal at `place`, whose rate changes its sign in the step, turns, and its value there.
    pub(super) fn turn(&self, flank: &Flank, place: usize) -> Option<(f64, f64)> {
        let mut time = self.first_guess(flank.rate, flank.bend);
        let mut bracket = Bracket { low: 0.0, high: self.length };
        let sign = if flank.rate[0] > 0.0 { 1.0 } else { -1.0 };
        for _ in 0..ROUNDS {
            let seen = apply(self.looks, &self.state(time));
            let (value, rate, bend) = (seen[place], seen[place + 1], seen[place + 2]);
            bracket.cut(time, rate * sign > 0.0);
            let way = -rate / bend;
            let next = time + way;
            if self.is_found(flank, way, value.abs()) {
                return Some((next, value + 0.5 * rate * way));
            }
            time = bracket.within(next);
        }
        None
    }

    /// When the first signal, which is below zero at the end of the step and above at its beginning,
    /// falls through zero, and the second one there.
    pub(super) fn fall(&self, flank: &Flank) -> Option<(f64, f64)> {
        let mut time = self.first_guess(flank.value, flank.rate);
        let mut bracket = Bracket { low: 0.0, high: self.length };
        for _ in 0..ROUNDS {
            let [value, rate, bend, other, other_rate, other_bend] =
                apply(self.looks, &self.state(time));
            bracket.cut(time, value > 0.0);
            // Newton's move, and by how much the bend makes it longer.
            let way = -value / rate * (1.0 + 0.5 * value * bend / (rate * rate));
            let next = time + way;
            if self.is_found(flank, way, (rate * self.length).abs()) {
                return Some((next, other + way * (other_rate + 0.5 * way * other_bend)));
            }
            time = bracket.within(next);
        }
        None
    }

    /// Whether a move is so small that what it leaves does not count beside a size.
    fn is_found(&self, flank: &Flank, way: f64, size: f64) -> bool {
        let third = CAUTION * (flank.bend[1] - flank.bend[0]).abs() / self.length;
        way.abs() <= NEAR * self.length || third * way.abs().powi(3) / 6.0 <= LEFT * size
    }

    /// Where a function that changes its sign passes zero, from its values and slopes at both ends.
    fn first_guess(&self, value: [f64; 2], slope: [f64; 2]) -> f64 {
        let length = self.length;
        let slope = slope.map(|slope| slope * length);
        let [first, last] = value;
        // The cubic through both, and its rate, on 0…1.
        let (b, c, d) = (
            slope[0],
            3.0 * (last - first) - 2.0 * slope[0] - slope[1],
            2.0 * (first - last) + slope[0] + slope[1],
        );
        let mut share = first / (first - last);
        let mut bracket = Bracket { low: 0.0, high: 1.0 };
        for _ in 0..4 {
            let value = first + share * (b + share * (c + share * d));
            let rate = b + share * (2.0 * c + share * 3.0 * d);
            bracket.cut(share, (value > 0.0) == (first > 0.0));
            share = bracket.within(share - value / rate);
        }
        share.clamp(0.0, 1.0) * length
    }
}
