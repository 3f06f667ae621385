//! What is odd about a network, but not wrong.

use thiserror::Error;

dashpot_units::words! {
    /// Something about a network that is odd, but not wrong.
    #[derive(Debug, Clone, PartialEq, Error)]
    #[expect(missing_docs, reason = "the messages say what the fields are")]
    pub enum NetworkWarning, pub fn code(&self) {
        /// Rigid links join both ends of an element.
        #[error("rigid links join both ends of `{element}`: it never deforms and carries no force")]
        RigidlyLinked { element: String } = "rigidly-linked",
        /// The ends of an element stand in an order against the impactor's way.
        #[error(
            "`{element}` looks reversed: `between` runs along the impactor's way, so that \
             compression counts positive, but here it counts negative"
        )]
        Reversed { element: String } = "reversed",
        /// A restitution between masses acts on what has none.
        #[error(
            "the restitution {restitution} of `{element}` does nothing: it acts between masses, and {} has no mass",
            .node.as_ref().map_or("what it meets".to_owned(), |own| format!("`{own}`"))
        )]
        IdleRestitution {
            element: String,
            restitution: f64,
            /// The node without mass; `None` for a place inside of a model.
            node: Option<String>,
        } = "idle-restitution",
        /// Two contacts close at one deformation between the same masses.
        #[error(
            "`{}` and `{}` close at once between the same masses: how they share force \
             and impulse is not determined, only the sum is; a stiffness in one of them settles it",
            .elements[0], .elements[1]
        )]
        SharedContacts { elements: [String; 2] } = "shared-contacts",
        /// A load or a motion jumps and moves what has no mass beside a part that dissipates.
        #[error(
            "what moves `{element}` jumps at {time} s, and there is no mass beside it: its force is followed there, but not the \
             work that it takes within the jump, so that energies of elements have no error; a short rise in place of the jump \
             counts it"
        )]
        WithinJump {
            element: String,
            /// When for the first time \[s\].
            time: f64,
        } = "within-jump",
        /// A body strikes a layer in which a dashpot leads from face to face.
        #[error(
            "{0}, in which a dashpot leads from face to face: the force at the first touch \
             grows with the number of segments, without limit; a spring or a mass between the \
             two bounds it"
        )]
        DampedFront(Front) = "damped-front",
        /// A body strikes a layer that is not linear.
        #[error(
            "{0}, which is not linear: the front of the wave is as steep as its segments, \
             and forces, times and what follows from them depend on their number; compare with \
             other numbers"
        )]
        NonlinearFront(Front) = "nonlinear-front",
        /// A body strikes a layer so that the front of the wave is as steep as its segments.
        #[error(
            "{front}, and the front of the wave is as steep as its segments: with few of them \
             its peaks of force, stress and acceleration are too low, with many up to {:.0} % too \
             high, and it lets go too early or too late by the time that the front is spread over; \
             the errors stated include that; a spring between the two blunts the front",
            (100.0 * *.excess).ceil()
        )]
        SteepFront {
            front: Front,
            /// By which part of themselves forces are too high at most.
            excess: f64,
        } = "steep-front",
        /// A load jumps at the face of a layer.
        #[error(
            "`{load}` jumps at the face of `{element}`, and the front of the wave is as steep \
             as its segments: forces in it may be too high by half of the jump, however many \
             segments there are"
        )]
        LoadJumps { load: String, element: String } = "load-jumps",
    }
}

/// A body at the face of a layer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{node}` strikes the layer {layer} of `{element}`")]
pub struct Front {
    /// The node that strikes.
    pub node: String,
    /// The pad.
    pub element: String,
    /// Its layer.
    pub layer: String,
}

impl NetworkWarning {
    /// Names of the elements, nodes and loads that it is about, the first one first.
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::RigidlyLinked { element }
            | Self::Reversed { element }
            | Self::WithinJump { element, .. } => vec![element],
            Self::IdleRestitution { element, node, .. } => {
                [element].into_iter().chain(node).map(String::as_str).collect()
            }
            Self::SharedContacts { elements: [one, other] } => vec![one, other],
            Self::DampedFront(own)
            | Self::NonlinearFront(own)
            | Self::SteepFront { front: own, .. } => vec![&own.node, &own.element],
            Self::LoadJumps { load, element } => vec![load, element],
        }
    }
}
