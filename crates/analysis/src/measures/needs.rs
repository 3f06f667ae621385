//! What measures can be asked of.

use dashpot_network::Assembly;

use crate::Note;

/// What an element or node must have so that a measure of it can have a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Needs {
    /// Nothing that others of its family lack.
    Nothing,
    /// An acceleration that an accelerometer reads, as every free mass has.
    Acceleration,
    /// A thickness, of the whole element or of a part of it.
    Thickness,
    /// An area, of the whole element or of a part of it.
    Area,
}

impl Needs {
    /// Why the element or node number `target` can have no value; `None` where it can.
    pub(crate) fn lacking(self, assembly: &Assembly, target: usize) -> Option<Note> {
        match self {
            Self::Nothing => None,
            Self::Acceleration => {
                assembly.nodes[target].acceleration.is_none().then_some(Note::Massless)
            }
            Self::Thickness => {
                assembly.connections[target].segments.is_empty().then_some(Note::NoThickness)
            }
            Self::Area => {
                let segments = &assembly.connections[target].segments;
                segments.iter().all(|own| own.area.is_none()).then_some(Note::NoArea)
            }
        }
    }
}
