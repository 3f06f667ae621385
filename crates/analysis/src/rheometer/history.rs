//! What is done to a model over time, the instants at which its answer is looked at, and that answer in closed form.

use dashpot_dae::{Piece, Waveform};
use dashpot_rheology::{KelvinForm, MaxwellForm};

/// What was done to a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// A force \[N\]; its deformation answers.
    Force,
    /// A deformation \[m\]; its force answers.
    Deformation,
}

/// A point at which the history may jump or bend.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// When \[s\].
    pub(super) time: f64,
    /// The value \[N or m\] just before.
    pub(super) before: f64,
    /// The value \[N or m\] just after.
    pub(super) after: f64,
}

/// The side of a time from which a value is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// Just before.
    Before,
    /// Just after.
    After,
}

/// A time \[s\] and the side from which it is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Instant {
    pub(super) time: f64,
    pub(super) side: Side,
}

impl Instant {
    pub(super) fn before(time: f64) -> Self {
        Self { time, side: Side::Before }
    }

    pub(super) fn after(time: f64) -> Self {
        Self { time, side: Side::After }
    }

    /// Whether something that happens at `time` has happened.
    fn is_past(self, time: f64) -> bool {
        self.time > time || (self.time >= time && self.side == Side::After)
    }
}

/// A straight part of a history, up to an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    /// Where it begins \[s\].
    pub(super) start: f64,
    /// How long it lasts \[s\], positive.
    pub(super) length: f64,
    /// Value at its beginning.
    pub(super) from: f64,
    /// Value at its end.
    pub(super) to: f64,
    /// Change per second.
    pub(super) slope: f64,
}

/// A force \[N\] or deformation \[m\] over time, straight between corners; zero before the first,
/// which is at the time 0, and over at the last.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct History {
    corners: Vec<Corner>,
}

impl History {
    /// A step to `height` at the time 0, or a straight rise to it within `rise`, held until `end`.
    pub(super) fn step(height: f64, rise: f64, end: f64) -> Self {
        let mut corners = Self::edge(0.0, rise, 0.0, height);
        corners.push(Corner { time: end, before: height, after: height });
        Self { corners }
    }

    /// A step or rise to `height`, held for `hold` once it is reached, a step or fall to zero, and nothing until `end`.
    pub(super) fn pulse(height: f64, rise: f64, hold: f64, end: f64) -> Self {
        let mut corners = Self::edge(0.0, rise, 0.0, height);
        corners.extend(Self::edge(rise + hold, rise, height, 0.0));
        corners.push(Corner { time: end, before: 0.0, after: 0.0 });
        Self { corners }
    }

    /// A straight rise with `rate` from the time 0 to `end`.
    pub(super) fn ramp(rate: f64, end: f64) -> Self {
        let start = Corner { time: 0.0, before: 0.0, after: 0.0 };
        Self { corners: vec![start, Corner { time: end, before: rate * end, after: rate * end }] }
    }

    /// A straight way to `height` with `rate` from the time 0 on, and back to zero with `back`, both rates positive.
    pub(super) fn there_and_back(height: f64, rate: f64, back: f64) -> Self {
        let turn = height.abs() / rate;
        let corner = |time, value| Corner { time, before: value, after: value };
        let end = turn + height.abs() / back;
        Self { corners: vec![corner(0.0, 0.0), corner(turn, height), corner(end, 0.0)] }
    }

    /// Straight from point to point, `(time, value)` with rising times from 0 on; a first value that is not zero is a
    /// jump to it.
    pub(super) fn through(points: impl Iterator<Item = (f64, f64)>) -> Self {
        let corner = |(at, (time, value)): (usize, (f64, f64))| {
            let before = if at == 0 { 0.0 } else { value };
            Corner { time, before, after: value }
        };
        Self { corners: points.enumerate().map(corner).collect() }
    }

    fn edge(time: f64, rise: f64, from: f64, to: f64) -> Vec<Corner> {
        if rise > 0.0 {
            let foot = Corner { time, before: from, after: from };
            vec![foot, Corner { time: time + rise, before: to, after: to }]
        } else {
            vec![Corner { time, before: from, after: to }]
        }
    }

    pub(super) fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// When it is over \[s\].
    pub(super) fn end(&self) -> f64 {
        self.corners.last().map_or(0.0, |corner| corner.time)
    }

    /// The straight parts that lie before an instant, the last one cut off there.
    pub(super) fn lines_until(&self, instant: Instant) -> impl Iterator<Item = Line> + '_ {
        self.corners.windows(2).filter_map(move |pair| {
            let (start, full) = (pair[0].time, pair[1].time - pair[0].time);
            let slope = (pair[1].before - pair[0].after) / full;
            let length = full.min(instant.time - start);
            let to = if length < full { pair[0].after + slope * length } else { pair[1].before };
            (length > 0.0).then_some(Line { start, length, from: pair[0].after, to, slope })
        })
    }

    /// Times \[s\] and heights of the jumps that have happened at an instant.
    pub(super) fn jumps_until(&self, instant: Instant) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.corners
            .iter()
            .filter(move |corner| instant.is_past(corner.time))
            .map(|corner| (corner.time, corner.after - corner.before))
            .filter(|jump| jump.1 != 0.0)
    }

    /// The straight part that an instant lies on, or is the end of.
    fn line_at(&self, instant: Instant) -> Option<Line> {
        let past = self.corners.iter().take_while(|corner| instant.is_past(corner.time)).count();
        let pair = self.corners.get(past.checked_sub(1)?..=past)?;
        let slope = (pair[1].before - pair[0].after) / (pair[1].time - pair[0].time);
        let length = instant.time - pair[0].time;
        let to = pair[0].after + slope * length;
        Some(Line { start: pair[0].time, length, from: pair[0].after, to, slope })
    }

    /// The value at an instant; after the end that of the end.
    pub(super) fn value(&self, instant: Instant) -> f64 {
        let at_corner = self.corners.iter().find(|c| c.time.to_bits() == instant.time.to_bits());
        match (at_corner, instant.side) {
            (Some(corner), Side::Before) => corner.before,
            (Some(corner), Side::After) => corner.after,
            (None, _) => match self.line_at(instant) {
                Some(line) => line.to,
                None => self.corners.last().map_or(0.0, |corner| corner.after),
            },
        }
    }

    /// The slope at an instant \[unit/s\], zero before the start and after the end.
    pub(super) fn slope(&self, instant: Instant) -> f64 {
        self.line_at(instant).map_or(0.0, |line| line.slope)
    }

    /// The history as a driving function; `None` where its corners cannot be told apart.
    pub(super) fn waveform(&self) -> Option<Waveform> {
        let piece = |pair: &[Corner]| Piece {
            start: pair[0].time,
            value: pair[0].after,
            slope: (pair[1].before - pair[0].after) / (pair[1].time - pair[0].time),
            ..Piece::default()
        };
        Waveform::new(self.corners.windows(2).map(piece).collect())
    }
}

/// Part of the fastest time, and of each phase, at which the first look is taken.
const EARLY: f64 = 0.01;
/// Distance from a corner, relative to its time, below which instants run together.
const DISTINCT: f64 = 16.0 * f64::EPSILON;

/// About `points` instants of a test: logarithmic in the time since the last corner of the history,
/// from a hundredth of `fastest` \[s\] on. Every corner but the last is looked at from both sides.
pub(super) fn instants(history: &History, fastest: f64, points: usize) -> Vec<Instant> {
    let corners = history.corners();
    let phases = corners.len().saturating_sub(1).max(1);
    let count = (points / phases).max(2);
    let mut all = Vec::with_capacity(points + 2 * corners.len());
    for pair in corners.windows(2) {
        let (start, end) = (pair[0].time, pair[1].time);
        all.extend([Instant::before(start), Instant::after(start)]);
        let first = (EARLY * fastest.min(end - start)).max(DISTINCT * start);
        let offsets = logarithmic(first, end - start, count);
        let mut last = start;
        for time in offsets.into_iter().map(|offset| start + offset) {
            if time > last && time < end {
                all.push(Instant::after(time));
                last = time;
            }
        }
    }
    all.push(Instant::before(history.end()));
    all
}

/// `count` values from `first` to `last`, two or more, each a constant factor above the one before.
pub(super) fn logarithmic(first: f64, last: f64, count: usize) -> Vec<f64> {
    let steps = count.max(2) - 1;
    let decades = (last / first).ln();
    (0..=steps)
        .map(|at| match at {
            0 => first,
            _ if at == steps => last,
            _ => first * (decades * (at as f64 / steps as f64)).exp(),
        })
        .collect()
}

/// Below this exponent the weights of a line are summed as series.
const SHORT: f64 = 1.0;
/// Terms of these series: 1/20! is beyond the digits of a double.
const TERMS: u32 = 20;

/// The parts of a deformation \[m\] that a force makes; the thesis calls them `ε₂`, `ε₁` and `ε₃`.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Parts {
    /// Elastic and at once.
    pub(super) instantaneous: f64,
    /// Elastic and late.
    pub(super) delayed: f64,
    /// By flow, for good.
    pub(super) viscous: f64,
}

impl Parts {
    pub(super) fn total(self) -> f64 {
        self.instantaneous + self.delayed + self.viscous
    }
}

/// The deformation \[m\] under a force \[N\].
pub(super) fn deformation(form: &KelvinForm, force: &History, at: Instant) -> Parts {
    let mut delayed = 0.0;
    for element in form.elements() {
        let rate = element.rate.high();
        for line in force.lines_until(at) {
            let [first, last] = weights(rate * line.length);
            let since = at.time - (line.start + line.length);
            let left = if since > 0.0 { (-rate * since).exp() } else { 1.0 };
            delayed += element.compliance * left * (line.from * first + line.to * last);
        }
    }
    let flowed: f64 =
        force.lines_until(at).map(|line| line.length * 0.5 * (line.from + line.to)).sum();
    Parts {
        instantaneous: form.spring_compliance() * force.value(at),
        delayed,
        viscous: form.fluidity() * flowed,
    }
}

/// The force \[N\] under a deformation \[m\], without the impulses that a dashpot beside all else answers jumps with.
pub(super) fn force(form: &MaxwellForm, deformation: &History, at: Instant) -> f64 {
    let mut force = form.spring() * deformation.value(at);
    if form.dashpot() > 0.0 {
        force += form.dashpot() * deformation.slope(at);
    }
    for element in form.elements() {
        let rate = element.rate.high();
        for (time, height) in deformation.jumps_until(at) {
            force += element.stiffness * height * (-rate * (at.time - time)).exp();
        }
        for line in deformation.lines_until(at) {
            let since = (at.time - (line.start + line.length)).max(0.0);
            let grown = -(-rate * line.length).exp_m1();
            force += element.damping * line.slope * grown * (-rate * since).exp();
        }
    }
    force
}

/// What the two end values of a line of the length `x` weigh at its end, in units of the decay:
/// `x ∫₀¹ e^(−x(1−w)) (1−w) dw` and `x ∫₀¹ e^(−x(1−w)) w dw`.
pub(super) fn weights(x: f64) -> [f64; 2] {
    if x < SHORT {
        let (mut term, mut first, mut last) = (0.5, 0.0, 0.0);
        for k in 0..TERMS {
            first += f64::from(k + 1) * term;
            last += term;
            term *= -x / f64::from(k + 3);
        }
        return [x * first, x * last];
    }
    let left = (-x).exp();
    let first = (1.0 - left) / x - left;
    [first, -(-x).exp_m1() - first]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rheometer::history::Side;

    #[test]
    fn a_pulse_jumps_twice() {
        let pulse = History::pulse(2.0, 0.0, 3.0, 10.0);
        let jumps = |instant| pulse.jumps_until(instant).collect::<Vec<_>>();
        assert!(jumps(Instant::before(0.0)).is_empty());
        assert_eq!(jumps(Instant::before(3.0)), [(0.0, 2.0)]);
        assert_eq!(jumps(Instant::after(3.0)), [(0.0, 2.0), (3.0, -2.0)]);
        assert_eq!(pulse.end().to_bits(), 10.0_f64.to_bits());
        let found: Vec<f64> =
            [Instant::before(0.0), Instant::after(0.0), Instant::before(3.0), Instant::after(3.0)]
                .into_iter()
                .map(|instant| pulse.value(instant))
                .collect();
        assert_eq!(found, [0.0, 2.0, 2.0, 0.0]);
    }

    #[test]
    fn lines_end_at_the_instant() {
        let pulse = History::pulse(2.0, 1.0, 3.0, 10.0);
        let lines: Vec<Line> = pulse.lines_until(Instant::after(4.5)).collect();
        assert_eq!(lines.len(), 3);
        let last = lines[2];
        assert_eq!((last.start, last.length, last.from, last.to), (4.0, 0.5, 2.0, 1.0));
        assert_eq!(pulse.value(Instant::after(4.5)).to_bits(), 1.0_f64.to_bits());
        assert_eq!(pulse.slope(Instant::before(4.0)).to_bits(), 0.0_f64.to_bits());
        assert_eq!(pulse.slope(Instant::after(4.0)).to_bits(), (-2.0_f64).to_bits());
    }

    #[test]
    fn the_driving_function_has_the_same_values() {
        let pulse = History::pulse(2.0, 1.0, 3.0, 10.0);
        let waveform = pulse.waveform().unwrap();
        for time in [0.0, 0.25, 1.0, 2.5, 4.0, 4.75, 5.0, 9.0] {
            let same = waveform.value(time) - pulse.value(Instant::after(time));
            assert!(same.abs() < 1e-15, "{time}");
        }
    }

    #[test]
    fn both_sides_of_each_corner_are_looked_at() {
        let all = instants(&History::pulse(1.0, 0.0, 5.0, 20.0), 1e-3, 40);
        assert!(all.windows(2).all(|pair| pair[0].time <= pair[1].time));
        let sides = |time: f64| -> Vec<Side> {
            let at = all.iter().filter(|instant| (instant.time - time).abs() < 1e-14);
            at.map(|instant| instant.side).collect()
        };
        assert_eq!(sides(0.0), [Side::Before, Side::After]);
        assert_eq!(sides(5.0), [Side::Before, Side::After]);
        assert_eq!(sides(20.0), [Side::Before]);
        assert!((all[2].time - 1e-5).abs() < 1e-18);
        assert!((40..=46).contains(&all.len()), "{}", all.len());
    }

    #[test]
    fn times_that_run_together_are_left_out() {
        let all = instants(&History::pulse(1.0, 0.0, 1e12, 2e12), 1e-9, 100);
        let after: Vec<f64> =
            all.iter().map(|instant| instant.time).filter(|&time| time > 1e12).collect();
        assert!(after.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

#[cfg(test)]
mod response_tests {
    use super::*;

    #[test]
    fn the_weights_of_both_ends_add_up_to_the_creep() {
        for x in [1e-300, 1e-9, 0.3, 0.999_999, 1.000_001, 3.0, 50.0, 1e12] {
            let [first, last] = weights(x);
            let whole = -(-x).exp_m1();
            assert!(((first + last) / whole - 1.0).abs() < 4.0 * f64::EPSILON, "{x}");
            assert!(first > 0.0 && last >= first, "{x}: {first}, {last}");
        }
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        let below = weights(SHORT * (1.0 - f64::EPSILON));
        let above = weights(SHORT);
        for (below, above) in below.iter().zip(above) {
            assert!((below / above - 1.0).abs() < 8.0 * f64::EPSILON);
        }
    }
}
