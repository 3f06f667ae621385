//! What samples do not tell of the signal between them.

use crate::Channel;

/// A step that changes by so many times more than those beside it holds a jump.
const JUMP: f64 = 3.0;

/// How far a signal may be from the straight line between its samples, as far as the bends at its samples tell.
///
/// With the change of slope `κ` at both ends of a step `h`, `d = κ1 h` and `e = κ2 h`:
///
/// - a corner inside the step leaves both bends of the same sign; it stands `d e/(d + e)` off the line, and half of
///   that times `h` in the area. A smooth curve is off by a quarter of that height and a third of that area;
/// - a jump inside the step leaves bends of opposite signs and is off by as much as `min(|d|, |e|)`, and half of
///   that times `h` in the area.
///
/// What is shorter than a step and leaves no bend at samples is not seen; that is what a filter before sampling
/// is for.
#[derive(Debug)]
pub struct Sampling<'c> {
    channel: &'c Channel,
    /// Changes of slope at the samples \[unit/s\].
    bends: Vec<f64>,
}

/// What a step may hide.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Hidden {
    /// Height off the line \[unit\], signed as the signal is above or below it; of a jump its magnitude.
    pub(crate) height: f64,
    /// Area between signal and line \[unit s\].
    pub(crate) area: f64,
    /// Whether it is a corner or curve, and no jump.
    pub(crate) is_smooth: bool,
}

impl<'c> Sampling<'c> {
    /// Looks at the bends of a channel.
    pub fn of(channel: &'c Channel) -> Self {
        let (times, values) = (channel.times(), channel.values());
        let slope = |at: usize| (values[at + 1] - values[at]) / (times[at + 1] - times[at]);
        let inner = (1..times.len() - 1).map(|at| slope(at) - slope(at - 1));
        let mut bends: Vec<f64> = [0.0].into_iter().chain(inner).chain([0.0]).collect();
        // The ends are as their neighbours.
        let last = bends.len() - 1;
        if last > 1 {
            (bends[0], bends[last]) = (bends[1], bends[last - 1]);
        }
        Self { channel, bends }
    }

    /// What the step behind a sample may hide.
    pub(crate) fn hidden(&self, at: usize) -> Hidden {
        let times = self.channel.times();
        let step = times[at + 1] - times[at];
        let (d, e) = (self.bends[at] * step, self.bends[at + 1] * step);
        if d * e > 0.0 {
            let height = d * e / (d + e);
            return Hidden { height: -height, area: 0.5 * step * height.abs(), is_smooth: true };
        }
        let height = d.abs().min(e.abs());
        Hidden { height, area: 0.5 * step * height, is_smooth: false }
    }

    /// The steps that touch a window, and two more on either side.
    pub(crate) fn steps(&self, window: (f64, f64)) -> std::ops::Range<usize> {
        let times = self.channel.times();
        let first = times.partition_point(|time| *time <= window.0).saturating_sub(3);
        let last = times.partition_point(|time| *time < window.1) + 2;
        first..last.min(times.len() - 1)
    }

    /// How far the integral over a window, or over one that ends within two steps of it, may be off \[unit s\].
    pub fn area(&self, window: (f64, f64)) -> f64 {
        self.steps(window).map(|at| self.hidden(at).area).sum()
    }

    /// How far the signal may be off the line at most \[unit\].
    pub(crate) fn height(&self) -> f64 {
        (0..self.bends.len() - 1).map(|at| self.hidden(at).height.abs()).fold(0.0, f64::max)
    }

    /// How much larger than its largest sample the magnitude of the signal may be \[unit\].
    pub fn overshoot(&self) -> f64 {
        let values = self.channel.values();
        let largest = self.channel.largest().1;
        let above = |at: usize| {
            let hidden = self.hidden(at);
            let [one, other] = [values[at], values[at + 1]];
            let higher = one.max(other) + hidden.height.max(0.0);
            let lower = -one.min(other) + (-hidden.height).max(0.0);
            let most = if hidden.is_smooth { higher.max(lower) } else { self.beside_a_jump(at) };
            most - largest
        };
        (0..values.len() - 1).map(above).fold(0.0, f64::max)
    }

    /// How large the magnitude may be in a step that holds a jump: up to it the signal may go on as it did in the step
    /// before, and have come behind it as it does in the step after. 0 where the step is as its neighbours are.
    fn beside_a_jump(&self, at: usize) -> f64 {
        let (times, values) = (self.channel.times(), self.channel.values());
        let change =
            |from: usize| (values[from + 1] - values[from]) / (times[from + 1] - times[from]);
        let step = times[at + 1] - times[at];
        let before = at.checked_sub(1).map_or(0.0, |before| step * change(before));
        let after = if at + 2 < values.len() { step * change(at + 1) } else { 0.0 };
        let is_jump = (values[at + 1] - values[at]).abs() > JUMP * before.abs().max(after.abs());
        let ends = [values[at] + before, values[at + 1] - after].map(f64::abs);
        if is_jump { ends[0].max(ends[1]) } else { 0.0 }
    }

    /// How far the time at which what is made of the values passes a level may be off, in each step of a window \[s\].
    pub(crate) fn passages(
        &self,
        level: f64,
        window: (f64, f64),
        made: impl Fn(f64) -> f64,
    ) -> impl Iterator<Item = f64> {
        let (times, values) = (self.channel.times(), self.channel.values());
        let shift = move |at: usize| {
            let [one, other] = [made(values[at]), made(values[at + 1])];
            let step = times[at + 1] - times[at];
            if (one < level) == (other < level) {
                return 0.0;
            }
            let height = self.hidden(at).height.abs();
            (height * step / (other - one).abs()).min(step)
        };
        self.steps(window).map(shift)
    }
}
