//! Mass of an element's face.

use std::sync::Arc;

use super::{
    Effect, EffectKind,
    site::{Site, connection_of, face_of},
};
use crate::{
    Influence, Network, NetworkError, Node, NodeId, Situation, Start, Support, choices,
    elements::Rigid, parameters, parameters::Kind as _, part,
};

parameters! {
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
    pub struct Face on element: "face", "the face of the element has mass" {
        /// mass m2 on the face [kg], zero or positive
        pub mass: f64 = Quantity(Dimension::MASS), range NonNegative;
        /// which of the two nodes of the element
        pub at: Option<String> = Node, follows "where it separates, or the first of `between`";
        /// whether a face that can separate is struck at rest or begins with the speed of its node
        pub touch: Touch = Choice(Touch::WORDS), default "impact";
    }
    sample {
        element: "padding".to_owned(),
        mass: 0.2,
        at: Some("head".to_owned()),
        touch: Touch::Impact,
    }
}

choices! {
    /// How a face with mass begins that can separate.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Touch {
        /// At rest: the first touch is an impact, plastic or with the restitution of the separation.
        Impact = "impact",
        /// With the start speed of the node that it touches.
        Moving = "moving",
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
        let (start, position) = match self.touch {
            Touch::Impact => (Start::Rest, 0.0),
            Touch::Moving => (start_with(network, body), network.node(body).position),
        };
        let face = &mut network.nodes[face.0];
        (face.mass, face.start, face.position) = (self.mass, start, position);
        Ok(())
    }
}

impl Effect for Face {
    on_element!();

    fn rewrite(&self, network: &mut Network) -> Result<(), NetworkError> {
        if self.mass == 0.0 {
            return Ok(());
        }
        let pad = network.pad(connection_of(network, Self::KIND, &self.element)?);
        if let Some((face, contact)) = pad.and_then(|pad| pad.face.zip(pad.contact)) {
            let [from, to] = network.connections[contact].between;
            let body = if from.0 == face { to } else { from };
            return self.weigh(network, NodeId(face), body);
        }
        let site = Site::of(network, Self::KIND, &self.element, self.at.as_deref())?;
        let start = start_with(network, site.node(network));
        let position = network.node(site.node(network)).position;
        let face = Node { start, position, ..Node::mass(face_of(&self.element), self.mass) };
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
}

impl EffectKind for Face {
    const PER_ELEMENT: bool = true;
}
