//! What a term of a spectrum adds to the rows of a record, and how that changes with its time.

use super::record::{Column, Kind, Record};

/// A term of a spectrum, of unit strength.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Term {
    /// A spring: in the Maxwell form the equilibrium modulus, in the Kelvin form the instantaneous compliance.
    Spring,
    /// A dashpot: in the Maxwell form a viscosity, in the Kelvin form a fluidity.
    Dashpot,
    /// A branch with this time \[s\].
    Branch(f64),
}

impl Term {
    /// The time of a branch \[s\].
    pub(super) fn time(self) -> Option<f64> {
        if let Self::Branch(time) = self { Some(time) } else { None }
    }
}

/// What branches are multiplied by, so that they have limits for times that are ever shorter or longer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    /// By one.
    None,
    /// Fast Maxwell elements answer as a power of their times `τ`: by `1 + (θ/τ)^n`.
    Fast(f64, i32),
    /// Slow Kelvin–Voigt elements answer as the inverse of their times: by `1 + τ/θ`.
    Slow(f64),
}

impl Scale {
    /// The factor at the logarithm of a time, and its derivative.
    pub(super) fn at(self, log: f64) -> (f64, f64) {
        let (part, power) = match self {
            Self::None => return (1.0, 0.0),
            Self::Fast(time, power) => (f64::from(power) * (time.ln() - log), -f64::from(power)),
            Self::Slow(time) => (log - time.ln(), 1.0),
        };
        (1.0 + part.exp(), power * part.exp())
    }

    /// What it adds to a row whose time is `place` \[s\].
    fn part(self, place: f64) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Fast(time, power) => (time / place).powi(power),
            Self::Slow(time) => place / time,
        }
    }
}

/// Bounds of second derivatives by the logarithm of `τ`: of `e^−x` with `x = t/τ`, of `x e^−x` and `x² e^−x`, of
/// `1/(1 + x²)`, of `x/(1 + x²)`; and of `∫ x⁻¹ e^−x` against a rate of one.
const DECAY: f64 = 0.3091;
const FAST_DECAY: f64 = 1.2;
const STORED: f64 = 0.385;
const LOST: f64 = 0.5;
const RATE: f64 = 0.9403;

/// Rows of one kind, each with its weight: `e^(−t/τ)` of a relaxation, `1 − e^(−t/τ)` of creep, `ω²τ²/(1 + ω²τ²)` of
/// storage, `ωτ/(1 + ω²τ²)` of loss, or the answer to a history.
#[derive(Debug, Clone)]
pub(super) struct Channel {
    kind: Kind,
    places: Vec<f64>,
    history: History,
    /// The measured values.
    pub(super) values: Vec<f64>,
    /// What a deviation is multiplied by, so that it is a part of the value or of the largest.
    pub(super) weights: Vec<f64>,
}

/// What was done, straight between corners and zero before the first, and when the answer was looked at.
#[derive(Debug, Clone)]
struct History {
    corners: Vec<(f64, f64)>,
    /// For each instant the number of corners that have passed, and the time since the last one.
    instants: Vec<(usize, f64)>,
}

impl Channel {
    /// The channels of a record, whose answer was written down `shift` \[s\] later than what was done.
    pub(super) fn of(record: &Record, shift: f64) -> Vec<Self> {
        let largest = record.largest();
        let channel = |Column { kind, places, done, values }: Column| {
            let weight = |own: &f64| largest.unwrap_or(*own).recip();
            let weights = values.iter().map(weight).collect();
            let corners: Vec<(f64, f64)> = places.iter().copied().zip(done).collect();
            let instants = corners.iter().map(|own| place(&corners, own.0 - shift)).collect();
            Self { kind, places, history: History { corners, instants }, values, weights }
        };
        record.columns().into_iter().map(channel).collect()
    }

    /// The same with times of a relaxation that count from this one on; `None` where it is no relaxation.
    pub(super) fn since(&self, first: f64) -> Option<Self> {
        let places = || self.places.iter().map(|own| own - first).collect();
        (self.kind == Kind::Relaxation).then(|| Self { places: places(), ..self.clone() })
    }

    /// The power of their times as which fast Maxwell elements answer in it; 0 where they do not fade.
    pub(super) fn fades(&self) -> Option<i32> {
        match self.kind {
            Kind::Relaxation => None,
            Kind::Storage => Some(2),
            Kind::Stress if self.history.is_struck() => Some(0),
            _ => Some(1),
        }
    }

    /// The shortest and the longest time at which a branch changes from one limit to another \[s\].
    pub(super) fn span(&self) -> (f64, f64) {
        let (own, places) = (&self.history, self.places.iter());
        let times: Vec<f64> = match self.kind {
            Kind::Relaxation | Kind::Creep => places.copied().collect(),
            Kind::Storage | Kind::Loss => places.map(|own| own.recip()).collect(),
            Kind::Stress | Kind::Strain => {
                let steps = own.corners.windows(2).map(|pair| pair[1].0 - pair[0].0);
                let all = (0..own.instants.len()).map(|row| own.elapsed(row));
                steps.chain(own.instants.iter().map(|own| own.1)).chain(all).collect()
            }
        };
        let positive = times.into_iter().filter(|own| *own > 0.0);
        positive.fold((f64::INFINITY, 0.0), |(low, high), own| (low.min(own), high.max(own)))
    }

    /// Bounds of the second derivatives of branches of unit strength times `scale`, by the logarithm of their time.
    pub(super) fn curvature(&self, scale: Scale) -> Vec<f64> {
        let of = |own: &dyn Fn(f64) -> f64| self.places.iter().map(|at| own(*at)).collect();
        match self.kind {
            Kind::Relaxation => of(&|t| DECAY + FAST_DECAY * scale.part(t)),
            Kind::Creep => of(&|t| DECAY * (1.0 + scale.part(t))),
            Kind::Storage => of(&|omega| STORED + LOST * scale.part(omega.recip())),
            Kind::Loss => of(&|omega| LOST + LOST * scale.part(omega.recip())),
            Kind::Stress | Kind::Strain => self.history.curvature(scale),
        }
    }

    /// What a term adds to each row, and for a branch how that changes with the logarithm of its time.
    pub(super) fn term(&self, term: Term, value: &mut [f64], slope: &mut [f64]) {
        slope.fill(0.0);
        let history = &self.history;
        match (term, self.kind) {
            (Term::Branch(time), _) => self.branch(time, value, slope),
            (Term::Spring, Kind::Stress | Kind::Strain) => history.driven(value),
            (Term::Spring, Kind::Loss) | (Term::Dashpot, Kind::Relaxation | Kind::Storage) => {
                value.fill(0.0);
            }
            (Term::Spring, _) => value.fill(1.0),
            (Term::Dashpot, Kind::Creep | Kind::Loss) => value.copy_from_slice(&self.places),
            (Term::Dashpot, Kind::Stress) => history.rate(value),
            (Term::Dashpot, Kind::Strain) => history.integral(value),
        }
    }

    fn branch(&self, time: f64, value: &mut [f64], slope: &mut [f64]) {
        // The value, and how it changes with the logarithm of the time, by `t/τ` or `ωτ`.
        let at: fn(f64) -> (f64, f64) = match self.kind {
            Kind::Relaxation => |x| ((-x).exp(), x * (-x).exp()),
            Kind::Creep => |x| (-(-x).exp_m1(), -x * (-x).exp()),
            Kind::Storage => |x| {
                let [storage, loss] = oscillating(x);
                (storage, 2.0 * loss * loss)
            },
            Kind::Loss => |x| {
                let [storage, loss] = oscillating(x);
                (loss, loss * (1.0 - 2.0 * storage))
            },
            Kind::Stress => return self.history.relaxing(time, value, slope),
            Kind::Strain => return self.history.creeping(time, value, slope),
        };
        let factor = if self.kind.is_oscillation() { time } else { time.recip() };
        for ((value, slope), place) in value.iter_mut().zip(slope).zip(&self.places) {
            (*value, *slope) = at(place * factor);
        }
    }
}

/// Storage and loss of a Maxwell element of unit modulus at `x = ωτ`.
fn oscillating(x: f64) -> [f64; 2] {
    let inverse = x.recip();
    [1.0 / (1.0 + inverse * inverse), 1.0 / (x + inverse)]
}

/// How many corners have passed at an instant, and the time since the last of them.
fn place(corners: &[(f64, f64)], time: f64) -> (usize, f64) {
    let passed = corners.partition_point(|own| own.0 <= time);
    (passed, if passed == 0 { 0.0 } else { time - corners[passed - 1].0 })
}

impl History {
    /// Change per second in the piece behind so many corners.
    fn slope(&self, passed: usize) -> f64 {
        match (self.corners.get(passed.wrapping_sub(1)), self.corners.get(passed)) {
            (Some(from), Some(to)) => (to.1 - from.1) / (to.0 - from.0),
            _ => 0.0,
        }
    }

    fn at_corner(&self, passed: usize) -> f64 {
        if passed == 0 { 0.0 } else { self.corners[passed - 1].1 }
    }

    fn driven(&self, value: &mut [f64]) {
        for (own, &(passed, since)) in value.iter_mut().zip(&self.instants) {
            *own = self.at_corner(passed) + self.slope(passed) * since;
        }
    }

    /// The rate: at a corner that of the piece which ends there.
    fn rate(&self, value: &mut [f64]) {
        for (own, &(passed, since)) in value.iter_mut().zip(&self.instants) {
            let piece = if since > 0.0 { passed } else { passed.saturating_sub(1) };
            *own = self.slope(piece);
        }
    }

    fn integral(&self, value: &mut [f64]) {
        let mut sums = vec![0.0, 0.0];
        for pair in self.corners.windows(2) {
            let area = 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0);
            sums.push(sums[sums.len() - 1] + area);
        }
        for (own, &(passed, since)) in value.iter_mut().zip(&self.instants) {
            let slope = self.slope(passed);
            *own = sums[passed] + (self.at_corner(passed) + 0.5 * slope * since) * since;
        }
    }

    /// `∫ e^(−(t−s)/τ) dx(s)`, and its change with `ln τ`.
    fn relaxing(&self, time: f64, value: &mut [f64], slope: &mut [f64]) {
        let step = |(own, change): (f64, f64), (_, rate): (f64, f64), length: f64| {
            let x = length / time;
            let left = (-x).exp();
            let grown = time * -(-x).exp_m1();
            (
                own * left + rate * grown,
                (change + own * x) * left + rate * (grown - time * x * left),
            )
        };
        // What stands there at the first instant came suddenly.
        self.followed(self.corners.first().map_or(0.0, |own| own.1), step, value, slope);
    }

    /// `∫ (1 − e^(−(t−s)/τ)) dx(s)`, and its change with `ln τ`; not as a difference, which is rounding where `τ` is
    /// long.
    fn creeping(&self, time: f64, value: &mut [f64], slope: &mut [f64]) {
        let step = |(own, change): (f64, f64), (driven, rate): (f64, f64), length: f64| {
            let x = length / time;
            let (left, grown) = ((-x).exp(), -(-x).exp_m1());
            // `x − 1 + e^−x`.
            let late =
                if x < 1e-3 { 0.5 * x * x * (1.0 - x / 3.0 * (1.0 - 0.25 * x)) } else { x - grown };
            (
                own * left + driven * grown + rate * time * late,
                (change + (own - driven) * x) * left + rate * time * (late - x * grown),
            )
        };
        self.followed(0.0, step, value, slope);
    }

    /// A state and its derivative, from `first` at the first corner on, at all instants; `step` takes them over a
    /// length with a value at its beginning and a rate.
    fn followed(
        &self,
        first: f64,
        step: impl Fn((f64, f64), (f64, f64), f64) -> (f64, f64),
        value: &mut [f64],
        slope: &mut [f64],
    ) {
        let mut states = Vec::with_capacity(self.corners.len() + 1);
        states.extend([(0.0, 0.0), (first, 0.0)]);
        let done = |passed: usize| (self.at_corner(passed), self.slope(passed));
        for (at, pair) in self.corners.windows(2).enumerate() {
            states.push(step(states[at + 1], done(at + 1), pair[1].0 - pair[0].0));
        }
        for ((own, change), &(passed, since)) in value.iter_mut().zip(slope).zip(&self.instants) {
            (*own, *change) = step(states[passed], done(passed), since);
        }
    }

    /// How long before a row the history began; 0 where it had not.
    fn elapsed(&self, row: usize) -> f64 {
        let (passed, since) = self.instants[row];
        if passed == 0 { 0.0 } else { self.corners[passed - 1].0 - self.corners[0].0 + since }
    }

    /// Whether a row stands where the history begins with a jump.
    fn is_struck(&self) -> bool {
        self.corners.first().is_some_and(|own| own.1 != 0.0) && self.instants.contains(&(1, 0.0))
    }

    /// Bounds of second derivatives: by how much was done until each row, and how fast.
    fn curvature(&self, scale: Scale) -> Vec<f64> {
        let jump = self.corners.first().map_or(0.0, |own| own.1.abs());
        let fastest = (1..self.corners.len()).map(|own| self.slope(own).abs()).fold(0.0, f64::max);
        let mut done = vec![0.0, jump];
        for pair in self.corners.windows(2) {
            done.push(done[done.len() - 1] + (pair[1].1 - pair[0].1).abs());
        }
        let row = |(row, &(passed, since)): (usize, &(usize, f64))| {
            let done = done[passed] + self.slope(passed).abs() * since;
            let elapsed = self.elapsed(row).max(f64::MIN_POSITIVE);
            let scaled = match scale {
                Scale::None => 0.0,
                Scale::Slow(_) => DECAY * done * scale.part(elapsed),
                Scale::Fast(time, _) if passed > 0 && jump > 0.0 => {
                    RATE * time * fastest + FAST_DECAY * jump * scale.part(elapsed)
                }
                Scale::Fast(time, _) => RATE * time * fastest,
            };
            DECAY * done + scaled
        };
        self.instants.iter().enumerate().map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn records() -> Vec<Record> {
        let pairs: Vec<(f64, f64)> = [0.1, 0.4, 1.0, 3.0, 9.0].map(|t| (t, 2.0)).to_vec();
        let history = vec![
            [-0.5, 0.3, 0.0],
            [0.0, 0.8, 1.0],
            [0.7, 1.2, 2.0],
            [2.0, 1.2, 3.0],
            [5.0, -0.4, 1.0],
        ];
        vec![
            Record::Relaxation(pairs.clone()),
            Record::Creep(pairs.clone()),
            Record::Storage(pairs.clone()),
            Record::Loss(pairs),
            Record::Strained(history.clone()),
            Record::Stressed(history),
        ]
    }

    #[test]
    fn slopes_are_the_derivatives_of_values() {
        for record in records() {
            for (channel, time) in
                Channel::of(&record, 0.1).iter().flat_map(|own| [0.03, 0.9, 40.0].map(|t| (own, t)))
            {
                let count = channel.values.len();
                let at = |time: f64| {
                    let (mut value, mut slope) = (vec![0.0; count], vec![0.0; count]);
                    channel.term(Term::Branch(time), &mut value, &mut slope);
                    (value, slope)
                };
                let step = 1e-5_f64;
                let (low, high) = (at(time * (-step).exp()).0, at(time * step.exp()).0);
                let (_, slope) = at(time);
                for row in 0..count {
                    let difference = (high[row] - low[row]) / (2.0 * step);
                    assert!((difference - slope[row]).abs() < 1e-8, "{record:?} {time} {row}");
                }
            }
        }
    }

    #[test]
    fn slow_branches_are_springs_and_fast_ones_dashpots() {
        let row = |channel: &Channel, term| {
            let count = channel.values.len();
            let (mut value, mut slope) = (vec![0.0; count], vec![0.0; count]);
            channel.term(term, &mut value, &mut slope);
            value
        };
        let [strained, stressed] = [&records()[4], &records()[5]].map(|own| {
            let all = Channel::of(own, 0.0);
            all[0].clone()
        });
        let (slow, spring) = (row(&strained, Term::Branch(1e9)), row(&strained, Term::Spring));
        assert!(slow.iter().zip(&spring).all(|(one, other)| (one - other).abs() < 1e-8));
        // A fast Maxwell element of unit viscosity; the first row is the jump.
        let (fast, dashpot) = (row(&strained, Term::Branch(1e-3)), row(&strained, Term::Dashpot));
        let pairs = fast.iter().zip(&dashpot).skip(1);
        assert!(pairs.into_iter().all(|(one, other)| (one / 1e-3 - other).abs() < 1e-9));
        // A slow Kelvin–Voigt element of unit fluidity flows like a dashpot.
        let (slow, dashpot) = (row(&stressed, Term::Branch(1e6)), row(&stressed, Term::Dashpot));
        assert!(slow.iter().zip(&dashpot).all(|(one, other)| (one * 1e6 - other).abs() < 1e-4));
    }

    #[test]
    fn a_ramp_relaxes_as_in_closed_form() {
        let rows: Vec<[f64; 3]> = [0.0, 0.3, 1.1, 2.0].map(|t| [t, 3.0 * t, 1.0]).to_vec();
        let channel = &Channel::of(&Record::Strained(rows.clone()), 0.0)[0];
        let (mut value, mut slope) = (vec![0.0; 4], vec![0.0; 4]);
        channel.term(Term::Branch(0.7), &mut value, &mut slope);
        for (own, row) in value.iter().zip(&rows) {
            assert!((own - 2.1 * (1.0 - (-row[0] / 0.7_f64).exp())).abs() < 1e-14);
        }
    }
}
