//! Contacts that pull.

use super::{Solution, contacts};

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
        let floor = FAINT * extremes.iter().map(|own| own.1).fold(0.0, f64::max);
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
