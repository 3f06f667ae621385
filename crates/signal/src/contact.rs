//! When the pulse is.

use crate::{Channel, Uncertainty, sampling::Sampling};

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
