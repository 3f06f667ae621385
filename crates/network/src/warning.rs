//! What is odd about a network, but not wrong.

use std::fmt;

/// Something about a network that is odd, but not wrong.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the messages say what the fields are")]
pub enum NetworkWarning {
    /// Rigid links join both ends of an element.
    RigidlyLinked { element: String },
    /// The ends of an element stand in an order against the impactor's way.
    Reversed { element: String },
    /// A restitution between masses acts on what has none.
    IdleRestitution {
        element: String,
        restitution: f64,
        /// The node without mass; `None` for a place inside of a model.
        node: Option<String>,
    },
    /// Two contacts close at one deformation between the same masses.
    SharedContacts { elements: [String; 2] },
    /// A body strikes a layer in which a dashpot leads from face to face.
    DampedFront(Front),
    /// A body strikes a layer that is not linear.
    NonlinearFront(Front),
    /// A body strikes a layer so that the front of the wave is as steep as its segments.
    SteepFront {
        front: Front,
        /// By which part of themselves forces are too high at most.
        excess: f64,
    },
    /// A load jumps at the face of a layer.
    LoadJumps { load: String, element: String },
}

/// A body at the face of a layer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Front {
    /// The node that strikes.
    pub node: String,
    /// The pad.
    pub element: String,
    /// Its layer.
    pub layer: String,
}

impl NetworkWarning {
    fn about(&self) -> (&'static str, Vec<&str>) {
        match self {
            Self::RigidlyLinked { element } => ("rigidly-linked", vec![element]),
            Self::Reversed { element } => ("reversed", vec![element]),
            Self::IdleRestitution { element, node, .. } => {
                let names = [element].into_iter().chain(node);
                ("idle-restitution", names.map(String::as_str).collect())
            }
            Self::SharedContacts { elements: [one, other] } => {
                ("shared-contacts", vec![one, other])
            }
            Self::DampedFront(own) => ("damped-front", vec![&own.node, &own.element]),
            Self::NonlinearFront(own) => ("nonlinear-front", vec![&own.node, &own.element]),
            Self::SteepFront { front, .. } => ("steep-front", vec![&front.node, &front.element]),
            Self::LoadJumps { load, element } => ("load-jumps", vec![load, element]),
        }
    }

    /// What kind of warning it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        self.about().0
    }

    /// Names of the elements, nodes and loads that it is about, the first one first.
    pub fn names(&self) -> Vec<&str> {
        self.about().1
    }
}

impl fmt::Display for Front {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` strikes the layer {} of `{}`", self.node, self.layer, self.element)
    }
}

impl fmt::Display for NetworkWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::RigidlyLinked { element } => write!(
                f,
                "rigid links join both ends of `{element}`: it never deforms and carries no force"
            ),
            Self::Reversed { element } => write!(
                f,
                "`{element}` looks reversed: `between` runs along the impactor's way, so that \
                 compression counts positive, but here it counts negative"
            ),
            Self::IdleRestitution { element, restitution, node } => {
                write!(
                    f,
                    "the restitution {restitution} of `{element}` does nothing: it acts between \
                     masses, and "
                )?;
                match node {
                    Some(node) => write!(f, "`{node}` has no mass"),
                    None => write!(f, "what it meets has no mass"),
                }
            }
            Self::SharedContacts { elements: [one, other] } => write!(
                f,
                "`{one}` and `{other}` close at once between the same masses: how they share force \
                 and impulse is not determined, only the sum is; a stiffness in one of them settles \
                 it"
            ),
            Self::DampedFront(front) => write!(
                f,
                "{front}, in which a dashpot leads from face to face: the force at the first touch \
                 grows with the number of segments, without limit; a spring or a mass between the \
                 two bounds it"
            ),
            Self::NonlinearFront(front) => write!(
                f,
                "{front}, which is not linear: the front of the wave is as steep as its segments, \
                 and forces, times and what follows from them depend on their number; compare with \
                 other numbers"
            ),
            Self::SteepFront { front, excess } => write!(
                f,
                "{front}, and the front of the wave is as steep as its segments: with few of them \
                 its peaks of force, stress and acceleration are too low, with many up to {:.0} % too \
                 high, and it lets go too early or too late by the time that the front is spread over; \
                 the errors stated include that; a spring between the two blunts the front",
                (100.0 * excess).ceil()
            ),
            Self::LoadJumps { load, element } => write!(
                f,
                "`{load}` jumps at the face of `{element}`, and the front of the wave is as steep \
                 as its segments: forces in it may be too high by half of the jump, however many \
                 segments there are"
            ),
        }
    }
}
