//! When the pulse is, and when the impact begins and ends.

use crate::{Channel, Uncertainty, sampling::Sampling};

/// Noise is below so many standard deviations where nothing has begun.
const QUIET: f64 = 3.0;
/// Rounding of values, in parts of the peak.
const ROUNDING: f64 = 1e-12;

/// An impact: from the touch, before which nothing acts, to where the channel first comes back to what it reads at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// When it begins \[s\].
    pub touch: f64,
    /// How far that may be off \[s\].
    pub error: f64,
    /// The last sample before it begins.
    pub begin: usize,
    /// The sample at which it is over; the last one of a record that ends before.
    pub end: usize,
}

impl Impact {
    /// That of a channel, which begins at a time that is stated \[s\], or as the record tells.
    ///
    /// It begins behind the last sample before the contact that noise and resolution explain, where the line through the
    /// first sample beyond and the first one of twice its height, and beyond noise, comes from zero. A gentler beginning
    /// is earlier by as much as lies between these two samples at most, where noise hides it, and otherwise by a step.
    pub(crate) fn of(
        channel: &Channel,
        contact: Contact,
        uncertainty: &Uncertainty,
        stated: Option<f64>,
    ) -> Self {
        let (times, values) = (channel.times(), channel.values());
        let (sign, last) = (channel.sign(), values.len() - 1);
        let value = |at: usize| sign * (values[at] - uncertainty.rest);
        let zero = (uncertainty.floor - uncertainty.rest.abs()).max(ROUNDING * channel.largest().1);
        let first = times.partition_point(|time| *time < contact.window.0).min(last);
        let behind = times.partition_point(|time| *time < contact.window.1).min(last);
        let end = (behind..=last).find(|at| value(*at) <= zero).unwrap_or(last);
        if let Some(touch) = stated {
            let begin = times.partition_point(|time| *time <= touch).saturating_sub(1);
            return Self { touch, error: 0.0, begin, end: end.max(begin) };
        }
        // What is never at rest before is taken from where it is least.
        let least = (0..first).map(value).fold(f64::INFINITY, f64::min);
        let noise = QUIET * uncertainty.noise.deviation;
        let quiet = zero.max(noise).max(least);
        let Some(begin) = (0..first).rev().find(|at| value(*at) <= quiet) else {
            return Self { touch: times[0], error: 0.0, begin: 0, end };
        };
        let next = begin + 1;
        let step = times[next] - times[begin];
        let high = (2.0 * value(next)).max(4.0 * noise).max(2.0 * zero);
        let Some(risen) = (next + 1..=last).find(|at| value(*at) >= high) else {
            return Self { touch: times[begin], error: step, begin, end };
        };
        let rise = times[risen] - times[next];
        let hidden = if noise > zero { rise } else { 0.0 };
        let back = value(next) * rise / (value(risen) - value(next));
        let touch = times[next] - back.clamp(0.0, step + hidden);
        let begin = times.partition_point(|time| *time <= touch).saturating_sub(1);
        Self { touch: touch.max(times[0]), error: step.max(hidden), begin, end }
    }
}

/// The part of the peak above which a pulse counts as contact.
pub const CONTACT_LEVEL: f64 = 0.05;

/// The stretch about the peak in which what points as the peak does is never below [`CONTACT_LEVEL`] of it: a swing to the
/// other side is none of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// From when to when \[s\].
    pub window: (f64, f64),
    /// How far its length may be off \[s\].
    pub error: f64,
    /// Whether the record begins or ends within it.
    pub is_cut: bool,
}

impl Contact {
    /// That of a channel whose values may be off. What its passages may be is told by those of the levels above and below
    /// that differ by as much.
    pub(crate) fn of(
        channel: &Channel,
        sampling: &Sampling<'_>,
        uncertainty: &Uncertainty,
    ) -> Self {
        let (top, peak) = channel.largest();
        let level = CONTACT_LEVEL * peak;
        let beyond = uncertainty.of_passages();
        let [before, behind] = [false, true].map(|is_behind| {
            let at = |level: f64| passage(channel, (top, level), is_behind);
            let end = if is_behind { channel.span().1 } else { channel.span().0 };
            let time = at(level);
            let apart = |level: f64| (at(level).unwrap_or(end) - time.unwrap_or(end)).abs();
            let error =
                if beyond > 0.0 { apart(level + beyond).max(apart(level - beyond)) } else { 0.0 };
            (time.unwrap_or(end), error, time.is_none())
        });
        let window = (before.0, behind.0);
        let sign = channel.sign();
        Self {
            window,
            error: sampling.passages(level, window, |own| sign * own).sum::<f64>()
                + before.1
                + behind.1,
            is_cut: before.2 || behind.2,
        }
    }

    /// How long it is \[s\].
    pub fn length(&self) -> f64 {
        self.window.1 - self.window.0
    }
}

/// When the values pass a level first on one side of the largest.
fn passage(channel: &Channel, (top, level): (usize, f64), is_behind: bool) -> Option<f64> {
    let (times, values) = (channel.times(), channel.values());
    let sign = channel.sign();
    let is_below = |at: &usize| sign * values[*at] < level;
    let (low, high) = if is_behind {
        let low = (top + 1..values.len()).find(is_below)?;
        (low, low - 1)
    } else {
        let low = (0..top).rev().find(is_below)?;
        (low, low + 1)
    };
    let [one, other] = [low, high].map(|at| sign * values[at]);
    let share = ((level - one) / (other - one)).clamp(0.0, 1.0);
    Some(times[low] + share * (times[high] - times[low]))
}
