//! Forces that rest on zero where a contact is open, and contacts that pull all the same.

use dashpot_dae::{Panel, Signal, Switch};

use super::{Solution, contacts};

/// A signal of a system that is linear between switches, zero over a whole panel only where it rests: where it comes to zero without a switch, by
/// rounding alone, it holds the smallest number.
///
/// A contact that opens does so by a switch. Strong dashpots push with what is left of the difference of two
/// speeds, and that may be no digit at all.
pub(super) fn only_at_rest(mut signal: Signal, switches: &[Switch]) -> Signal {
    let mut last: Option<(f64, bool)> = None;
    for panel in &mut signal.panels {
        let is_zero = panel.coefficients.iter().all(|coefficient| *coefficient == 0.0);
        let is_switched = |from: f64| is_within(switches, (from, panel.end));
        let by_rounding = is_zero && last.is_some_and(|(from, acts)| acts && !is_switched(from));
        if by_rounding {
            *panel = Panel::constant(panel.start, panel.end, f64::MIN_POSITIVE);
        }
        last = Some((panel.start, !is_zero || by_rounding));
    }
    signal
}

/// Whether anything switches between two times; `switches` are in order of time.
fn is_within(switches: &[Switch], (from, to): (f64, f64)) -> bool {
    let next = switches.partition_point(|switch| switch.time <= from);
    switches.get(next).is_some_and(|switch| switch.time < to)
}

/// Roundings of the terms of a sum, in parts of its noise, that may be left where they cancel.
const LEFT: f64 = 8.0;

/// The sum of the forces on a body, zero where a switch makes them cancel but for their rounding, as where a
/// slider holds it.
pub(super) fn resting_from_switches(mut sum: Signal, switches: &[Switch]) -> Signal {
    let floor = LEFT * sum.noise;
    let (mut before, mut rests) = (f64::INFINITY, false);
    for panel in &mut sum.panels {
        let is_faint =
            panel.coefficients.iter().map(|coefficient| coefficient.abs()).sum::<f64>() <= floor;
        let is_switched = || is_within(switches, (before, panel.end));
        rests = is_faint && (rests || is_switched());
        before = panel.start;
        if rests {
            *panel = Panel::constant(panel.start, panel.end, 0.0);
        }
    }
    sum
}

/// A contact that pulls, which no contact does: a release that a method has not seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tension {
    /// Number of the connection.
    pub(crate) connection: usize,
    /// When it pulls most \[s\].
    pub(crate) time: f64,
    /// How much \[N\], positive.
    pub(crate) pull: f64,
    /// The same in parts of its largest push, or of a thousandth of the largest push of any contact.
    pub(crate) part: f64,
}

/// Pushes below this part of the largest one are none that a pull could be compared with.
const FAINT: f64 = 1e-3;

impl Solution<'_> {
    /// The contact that pulls most beside what it pushes with; `None` where none pulls beyond rounding. Only
    /// runs that switch have contacts.
    pub(crate) fn tension(&self) -> Option<Tension> {
        self.assembly.switching.as_ref()?;
        let window = (0.0, self.end());
        let connections = self.assembly.connections.iter().enumerate();
        let forces = connections.filter(|(_, own)| contacts::has_contact(self.assembly, own));
        let extremes = forces.filter_map(|(at, own)| {
            let force = self.glance(own.force?);
            let least = force.minimum(window);
            Some((at, force.maximum(window).value, least, force.noise))
        });
        let extremes: Vec<_> = extremes.collect();
        let floor = FAINT * extremes.iter().map(|extreme| extreme.1).fold(0.0, f64::max);
        let pulling = extremes.into_iter().filter(|(.., least, noise)| -least.value > *noise);
        let tensions = pulling.map(|(connection, most, least, _)| Tension {
            connection,
            time: least.time,
            pull: -least.value,
            part: -least.value / most.max(floor),
        });
        tensions.max_by(|one, other| one.part.total_cmp(&other.part))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signal(values: &[f64]) -> Signal {
        let panel =
            |(at, value): (usize, &f64)| Panel::constant(at as f64, at as f64 + 1.0, *value);
        Signal::new(values.iter().enumerate().map(panel).collect(), None, 0.0)
    }

    fn switch(time: f64) -> Switch {
        Switch {
            time,
            part: 0,
            name: "contact".to_owned(),
            phase: 0,
            what: "open",
            memory: 0.0,
            impulse: 0.0,
            lost: 0.0,
            worked: 0.0,
        }
    }

    fn rests(values: &[f64], switches: &[Switch]) -> Vec<bool> {
        let found = only_at_rest(signal(values), switches);
        found.panels.iter().map(|panel| *panel.coefficients == [0.0]).collect()
    }

    #[test]
    fn what_cancels_from_a_switch_on_rests_and_what_dies_down_does_not() {
        let sum = |values: &[f64]| {
            let own = signal(values);
            Signal::new(own.panels, None, 1e-15)
        };
        let rests = |values: &[f64], switches: &[Switch]| -> Vec<bool> {
            let found = resting_from_switches(sum(values), switches);
            found.panels.iter().map(|panel| *panel.coefficients == [0.0]).collect()
        };
        let values = [1.0, 1e-15, -2e-15, 1.0, 1e-15];
        assert_eq!(rests(&values, &[switch(1.0)]), [false, true, true, false, false]);
        assert_eq!(rests(&values, &[]), [false; 5]);
    }

    #[test]
    fn zero_before_anything_acts_and_after_a_switch_is_rest() {
        let values = [0.0, 0.0, 1.0, 0.0, 0.0];
        assert_eq!(rests(&values, &[switch(3.0)]), [true, true, false, true, true]);
    }

    #[test]
    fn zero_that_no_switch_makes_is_rounding() {
        let values = [0.0, 1.0, 0.0, 0.0, 2.0, 0.0];
        assert_eq!(rests(&values, &[]), [true, false, false, false, false, false]);
        assert_eq!(rests(&values, &[switch(5.0)]), [true, false, false, false, false, true]);
    }
}
