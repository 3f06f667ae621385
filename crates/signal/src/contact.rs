//! When the pulse is.

use crate::{Channel, sampling::Sampling};

/// The part of the peak above which a pulse counts as contact.
pub const CONTACT_LEVEL: f64 = 0.05;

/// The stretch about the peak in which the magnitude is never below [`CONTACT_LEVEL`] of it.
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
    /// That of a channel whose values may be off by `floor` besides.
    pub(crate) fn of(channel: &Channel, sampling: &Sampling<'_>, floor: f64) -> Self {
        let (times, values) = (channel.times(), channel.values());
        let (top, peak) = channel.largest();
        let level = CONTACT_LEVEL * peak;
        let is_below = |at: &usize| values[*at].abs() < level;
        let passage = |low: usize, high: usize| {
            let [one, other] = [values[low], values[high]];
            // The line passes the level on the side on which the high end is.
            let one = one * other.signum();
            let share = (level - one) / (other.abs() - one);
            let time = times[low] + share * (times[high] - times[low]);
            (time, floor / (other.abs() - one) * (times[high] - times[low]).abs())
        };
        let before = (0..top).rev().find(is_below).map(|at| passage(at, at + 1));
        let behind = (top..values.len()).find(is_below).map(|at| passage(at, at - 1));
        let (start, end) = channel.span();
        let window = (before.map_or(start, |own| own.0), behind.map_or(end, |own| own.0));
        let of_floor: f64 = [before, behind].into_iter().flatten().map(|own| own.1).sum();
        Self {
            window,
            error: sampling.passages(level, window) + of_floor,
            is_cut: before.is_none() || behind.is_none(),
        }
    }

    /// How long it is \[s\].
    pub fn length(&self) -> f64 {
        self.window.1 - self.window.0
    }
}
