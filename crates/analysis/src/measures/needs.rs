//! What measures can be asked of.

use dashpot_network::Assembly;

/// Note on a measure of the acceleration of a node that has none of its own.
pub(crate) const MASSLESS: &str = "the node is no mass that the forces on it move";

/// Note on the strain of an element whose thickness is not known.
pub(super) const NO_THICKNESS: &str =
    "its thickness is not known: give it a `thickness` or `layers`";

/// Note on the stress in an element whose area is not known.
pub(super) const NO_AREA: &str =
    "its area is not known: give it `thickness` and `area`, or `layers`";

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
    pub(crate) fn lacking(self, assembly: &Assembly, target: usize) -> Option<&'static str> {
        match self {
            Self::Nothing => None,
            Self::Acceleration => assembly.nodes[target].acceleration.is_none().then_some(MASSLESS),
            Self::Thickness => {
                assembly.connections[target].segments.is_empty().then_some(NO_THICKNESS)
            }
            Self::Area => {
                let segments = &assembly.connections[target].segments;
                segments.iter().all(|own| own.area.is_none()).then_some(NO_AREA)
            }
        }
    }
}
