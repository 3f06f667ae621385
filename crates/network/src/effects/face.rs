//! Mass of an element's face.

use super::{
    Effect, EffectKind,
    site::{AT, Site, at_of, at_value, connection_of, face_of},
};
use crate::{
    Influence, Network, NetworkError, Node, NodeId, Situation, Start, Support,
    elements::{Rigid, number},
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, non_negative},
    part,
};

/// Mass of a padding, lumped on its face.
///
/// | symbol | field  | unit | range |
/// |--------|--------|------|-------|
/// | `m2`   | `mass` | kg   | ≥ 0; 0 is no mass at all |
///
/// The face is the node `<element>.face`. The force `F2` of the element acts on it, and the node
/// that was the end of the element feels the force `F1 = F2 + m2 x1″` of `<element>.contact`.
///
/// With [`Separation`](super::Separation) the contact is one that pushes and never pulls: it parts
/// where `F1` falls to zero, and a touch is an impact on the mass of the face. Without it the face
/// is rigidly linked to its node and moves with it from the start.
///
/// # Limits
///
/// The mass of the padding stands in one place: no wave runs through it. A padding in which waves
/// matter is made of [layers](crate::layers::Layers). Where the face is struck at rest its speed
/// jumps, and the peak of `F1` is infinite.
///
/// # References
///
/// The mass `m2` and the group `B = m1/(m1 + m2)` are those of `thesis` in `docs/references.bib`,
/// whose equations have the face move with the impactor from the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Name of the element.
    pub element: String,
    /// Mass `m2` \[kg\].
    pub mass: f64,
    /// Name of the node on whose side it is; where there is none, the end that separates, or that
    /// on the impactor's side.
    pub at: Option<String>,
    /// How the face begins where it can separate.
    pub touch: Touch,
}

/// How a face with mass begins that can separate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touch {
    /// At rest: the first touch is an impact, plastic or with the restitution of the separation.
    Impact,
    /// With the start speed of the node that it touches.
    Moving,
}

impl Touch {
    const WORDS: [(Self, &'static str); 2] = [(Self::Impact, "impact"), (Self::Moving, "moving")];

    fn word(self) -> &'static str {
        Self::WORDS.iter().find(|entry| entry.0 == self).map_or("", |entry| entry.1)
    }
}

/// How a face begins that moves with `body`.
fn start_with(network: &Network, body: NodeId) -> Start {
    let body = network.node(body);
    let moves = body.mass > 0.0 && body.support == Support::Free;
    if moves { body.start } else { Start::Rest }
}

impl Face {
    /// Gives mass to the face that a separation has made, between it and `body`.
    fn weigh(&self, network: &mut Network, face: NodeId, body: NodeId) -> Result<(), NetworkError> {
        let name = &network.node(body).name;
        if let Some(at) = self.at.as_ref().filter(|at| *at != name) {
            let (element, face, separation) = (self.element.clone(), at.clone(), name.clone());
            return Err(NetworkError::TwoFaces { element, face, separation });
        }
        let start = match self.touch {
            Touch::Impact => Start::Rest,
            Touch::Moving => start_with(network, body),
        };
        let face = &mut network.nodes[face.0];
        (face.mass, face.start) = (self.mass, start);
        Ok(())
    }
}

impl Effect for Face {
    fn kind(&self) -> &'static str {
        Self::KIND
    }

    fn target(&self) -> Option<&str> {
        Some(&self.element)
    }

    fn rewrite(&self, network: &mut Network) -> Result<(), NetworkError> {
        if self.mass == 0.0 {
            return Ok(());
        }
        let pad = network.pad(connection_of(network, Self::KIND, &self.element)?);
        if let Some((face, contact)) = pad.and_then(|own| own.face.zip(own.contact)) {
            let [from, to] = network.connections[contact].between;
            let body = if from.0 == face { to } else { from };
            return self.weigh(network, NodeId(face), body);
        }
        let site = Site::of(network, Self::KIND, &self.element, self.at.as_deref())?;
        let start = start_with(network, site.node(network));
        let face = Node { start, ..Node::mass(face_of(&self.element), self.mass) };
        site.put_face(network, face, part(Rigid));
        Ok(())
    }

    fn influences(&self, situation: &Situation<'_>) -> Vec<Influence> {
        let network = situation.network;
        let site = Site::of(network, Self::KIND, &self.element, self.at.as_deref());
        let mass = site.map_or(0.0, |site| network.node(site.node(network)).mass);
        let found = (mass > 0.0).then(|| Influence::new("m2/m1", self.mass / mass));
        found.into_iter().collect()
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        non_negative("mass", self.mass)
    }

    fn values(&self) -> Vec<Value> {
        let touch = Value::Word(self.touch.word().to_owned());
        vec![Value::Number(self.mass), at_value(self.at.as_ref()), touch]
    }
}

impl EffectKind for Face {
    const KIND: &'static str = "face";
    const SUMMARY: &'static str = "the face of the element has mass";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required(
            "mass",
            ParameterKind::Quantity(Dimension::MASS),
            "mass m2 on the face [kg], zero or positive",
        ),
        Parameter::following(
            "at",
            ParameterKind::Node,
            "where it separates, or the first of `between`",
            AT.help,
        ),
        Parameter::optional(
            "touch",
            ParameterKind::Choice(&["impact", "moving"]),
            "impact",
            "whether a face that can separate is struck at rest or begins with the speed of its node",
        ),
    ];
    const PER_ELEMENT: bool = true;

    fn from_values(target: &str, values: &[Value]) -> Result<Self, InvalidParameter> {
        let touch = match values.get(2) {
            Some(Value::Word(word)) => {
                Touch::WORDS.iter().find(|entry| entry.1 == word).map(|entry| entry.0)
            }
            _ => None,
        };
        let touch = touch.ok_or_else(|| {
            InvalidParameter::new("touch", "`impact` or `moving`", "something else")
        })?;
        let mass = number(values, 0, "mass")?;
        let face = Self { element: target.to_owned(), mass, at: at_of(values.get(1))?, touch };
        face.validate().map(|()| face)
    }

    fn sample() -> Self {
        let (element, at) = ("padding".to_owned(), Some("head".to_owned()));
        Self { element, mass: 0.2, at, touch: Touch::Impact }
    }
}
