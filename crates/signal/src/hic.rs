//! The head injury criterion of one axis: with the sign of the acceleration, so that a swing back takes from the mean.

use crate::Channel;

/// So many stretches of starts have a best interval each that is looked at more closely.
const STRETCHES: usize = 64;
/// One that is worse than this part of the best can be no better between samples.
const NEAR: f64 = 0.97;
/// Rounds of moving both ends, and halvings of a search for one.
const ROUNDS: usize = 40;
const HALVINGS: usize = 60;

/// The interval that maximises `T (|∫ a dt|/T)^2.5` on the line between samples.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Best {
    /// The criterion \[unit^2.5 s\].
    pub(crate) value: f64,
    /// The best interval \[s\].
    pub(crate) interval: (f64, f64),
    /// The criterion of the best interval from sample to sample.
    pub(crate) on_samples: f64,
}

/// A channel over a unit, with its integral up to each sample.
struct Line<'c> {
    channel: &'c Channel,
    unit: f64,
    sums: Vec<f64>,
    cap: f64,
}

/// `T (V/T)^2.5`.
fn criterion(area: f64, length: f64) -> f64 {
    if length > 0.0 { length * (area.abs() / length).powf(2.5) } else { 0.0 }
}

/// The best interval that is no longer than `cap` \[s\].
///
/// Every interval from sample to sample is tried that can be better than the best so far. No criterion exceeds
/// `V^2.5/T^1.5` with the largest `V` of any, so long ones are left out; and where an interval begins, within the record,
/// the acceleration is no less than 0.6 times its mean, so others are left out as well. The best of 64 stretches of starts are then moved
/// between samples, one end after the other, or both where the cap is active.
pub(crate) fn best(channel: &Channel, unit: f64, cap: f64) -> Best {
    let line = Line::new(channel, unit, cap);
    let found = line.on_samples();
    let most = found.iter().map(|own| own.0).fold(0.0, f64::max);
    let mut best = Best { on_samples: most, ..Best::default() };
    for (_, from, to) in found.into_iter().filter(|own| own.0 >= NEAR * most && own.0 > 0.0) {
        let (value, interval) = line.refined(from, to);
        if value > best.value {
            (best.value, best.interval) = (value, interval);
        }
    }
    best
}

impl<'c> Line<'c> {
    fn new(channel: &'c Channel, unit: f64, cap: f64) -> Self {
        let samples = channel.times().windows(2).zip(channel.values().windows(2));
        let parts = samples.map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1]) / unit);
        let sums = parts.scan(0.0, |sum, part| {
            *sum += part;
            Some(*sum)
        });
        Self { channel, unit, cap, sums: [0.0].into_iter().chain(sums).collect() }
    }

    /// The best interval from sample to sample of each stretch of starts: criterion, first and last sample.
    fn on_samples(&self) -> Vec<(f64, usize, usize)> {
        let (times, sums) = (self.channel.times(), &self.sums);
        let low = sums.iter().copied().fold(f64::INFINITY, f64::min);
        let high = sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let widest = (high - low).powi(5);
        let longest = self.cap * (1.0 + 1e-9);
        let last = times.len() - 1;
        let each = last.div_ceil(STRETCHES).max(1);
        let mut best = NEAR * NEAR * self.about_peak();
        let mut found = Vec::new();
        let whole = (times[last] - times[0]).min(longest);
        for first in (0..last).step_by(each) {
            // Half of the mean leaves room for what is between samples.
            let least = 0.5 * self.unit * (best.sqrt() / whole).powf(0.4);
            // The criterion squared, `V^5/T^3`, which takes no power.
            let mut own = (0.0, first, first);
            for from in first..(first + each).min(last) {
                let near = &self.channel.values()[from.saturating_sub(1)..=from + 1];
                if from > 0 && near.iter().all(|own| own.abs() < least) {
                    continue;
                }
                for to in from + 1..=last {
                    let length = times[to] - times[from];
                    let cube = length * length * length;
                    if length > longest || widest < best * cube {
                        break;
                    }
                    let area = (sums[to] - sums[from]).abs();
                    let square = area * area;
                    let value = square * square * area / cube;
                    if value > own.0 {
                        own = (value, from, to);
                    }
                }
                best = f64::max(best, NEAR * NEAR * own.0);
            }
            found.push((own.0.sqrt(), own.1, own.2));
        }
        found
    }

    /// The square of the best criterion of intervals with the largest sample in their middle.
    fn about_peak(&self) -> f64 {
        let times = self.channel.times();
        let top = self.channel.largest().0;
        let reach = top.min(times.len() - 1 - top);
        let all = (1..=reach).map(|k| (top - k, top + k));
        let all = all.filter(|own| times[own.1] - times[own.0] <= self.cap);
        let value = |own: (usize, usize)| {
            criterion(self.sums[own.1] - self.sums[own.0], times[own.1] - times[own.0])
        };
        all.map(value).fold(0.0, f64::max).powi(2)
    }

    fn until(&self, time: f64) -> f64 {
        let (times, values) = (self.channel.times(), self.channel.values());
        let at = times.partition_point(|own| *own <= time).clamp(1, times.len() - 1) - 1;
        let step = (time - times[at]).clamp(0.0, times[at + 1] - times[at]);
        self.sums[at] + 0.5 * step * (values[at] + self.channel.value(time)) / self.unit
    }

    fn at(&self, from: f64, to: f64) -> f64 {
        criterion(self.until(to) - self.until(from), to - from)
    }

    /// The best interval whose ends are within a step of these samples.
    fn refined(&self, from: usize, to: usize) -> (f64, (f64, f64)) {
        let times = self.channel.times();
        let around =
            |at: usize| (times[at.saturating_sub(1)], times[(at + 1).min(times.len() - 1)]);
        let (starts, ends) = (around(from), around(to));
        let mut own = (times[from], times[to]);
        for _ in 0..ROUNDS {
            let before = own;
            let earliest = starts.0.max(own.1 - self.cap);
            own.0 = highest((earliest.min(own.0), starts.1.min(own.1)), |t| self.at(t, own.1));
            let latest = ends.1.min(own.0 + self.cap);
            own.1 = highest((ends.0.max(own.0), latest.max(own.1)), |t| self.at(own.0, t));
            let length = own.1 - own.0;
            // Of the same length at another place: both ends together.
            let shifts = (starts.0 - own.0, starts.1 - own.0);
            let shifts = (shifts.0.max(ends.0 - own.1), shifts.1.min(ends.1 - own.1));
            let shift = highest(shifts, |shift| self.at(own.0 + shift, own.1 + shift));
            own = (own.0 + shift, own.0 + shift + length);
            if (own.0 - before.0).abs() + (own.1 - before.1).abs() <= 1e-12 * length {
                break;
            }
        }
        let own = (own.0, own.1.min(own.0 + self.cap));
        let on_samples = self.at(times[from], times[to]);
        let value = self.at(own.0, own.1);
        if value >= on_samples { (value, own) } else { (on_samples, (times[from], times[to])) }
    }
}

/// Where a function with one top in a range is highest.
fn highest(range: (f64, f64), f: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = range;
    for _ in 0..HALVINGS {
        let third = (high - low) / 3.0;
        let (one, other) = (low + third, high - third);
        if f(one) < f(other) { low = one } else { high = other }
    }
    0.5 * (low + high)
}
