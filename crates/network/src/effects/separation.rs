//! Separation at one end of an element.

use std::{f64::consts::PI, sync::Arc};

use super::{
    Effect, EffectKind, Face,
    site::{Site, connection_of, face_of},
};
use crate::{
    Influence, Network, NetworkError, Node, Situation, elements::Contact, parameters,
    parameters::Kind as _, part,
};

parameters! {
    /// An element that pushes at one of its ends and never pulls there.
    ///
    /// | symbol | field         | unit | range |
    /// |--------|---------------|------|-------|
    /// | `e`    | `restitution` | 1    | 0 … 1 |
    ///
    /// The end gets a face of its own, the node `<element>.face`, and between the node that was there
    /// and the face stands a [`Contact`], `<element>.contact`, whose force is that on the node. It lets
    /// go where this force falls to zero. After that the face, which has no mass unless
    /// [`Face`](super::Face) gives it one, moves by itself, and contact comes back where the node meets
    /// it again.
    ///
    /// An element that by its law never pulls at this end, as a
    /// [`HystereticFoam`](crate::elements::HystereticFoam) or a
    /// [`HuntCrossley`](crate::elements::HuntCrossley) contact, alone or in series with others, is its own
    /// contact: the network stays as it is, without a face. Where [`Face`](super::Face) gives it a face
    /// with mass, that can part from the node as any other.
    ///
    /// A restitution acts between masses, so it needs a face with mass. A massless face takes the speed
    /// of what strikes it.
    ///
    /// # Limits
    ///
    /// A face without mass takes no energy and no time: it is at rest at once where only a spring
    /// stands behind it, and creeps back where a dashpot does. There is no adhesion. A massless face
    /// that meets a body again does so without an impact, whatever the speed.
    ///
    /// # References
    ///
    /// The contact is that of `signorini1959` in `docs/references.bib`. The model of `thesis` has none:
    /// its padding stays glued to both its sides.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Separation on element: "separation",
        "the element pushes and never pulls: one of its ends opens"
    {
        /// which of the two nodes of the element
        pub at: Option<String> = Node, follows "the first of `between`";
        /// restitution e of the touch [1], 0 to 1; acts where the face has mass
        pub restitution: f64 = Quantity(Dimension::NUMBER), default "0", range Part;
    }
    sample { element: "padding".to_owned(), at: Some("head".to_owned()), restitution: 0.0 }
}

impl Separation {
    fn contact(&self) -> Contact {
        Contact { gap: 0.0, restitution: self.restitution }
    }

    /// Whether the element's face has mass.
    fn has_heavy_face(&self, network: &Network) -> bool {
        let mut faces = network.effects.iter().filter_map(|effect| effect.of_kind::<Face>());
        faces.any(|face| face.element == self.element && face.mass > 0.0)
    }
}

impl Effect for Separation {
    on_element!();

    fn rewrite(&self, network: &mut Network) -> Result<(), NetworkError> {
        let site = Site::of(network, Self::KIND, &self.element, self.at.as_deref())?;
        if site.never_pulls(network) && !self.has_heavy_face(network) {
            return Ok(());
        }
        site.put_face(network, Node::massless(face_of(&self.element)), part(self.contact()));
        Ok(())
    }

    fn leave(&self, network: &mut Network) {
        let Some(at) = &self.at else { return };
        // The face stays where it is: without a place of its own it would be on the other side.
        for effect in &mut network.effects {
            let face = effect.of_kind::<Face>().filter(|face| face.element == self.element);
            if let Some(face) = face.filter(|face| face.at.is_none()) {
                *effect = Arc::new(Face { at: Some(at.clone()), ..face.clone() });
            }
        }
    }

    fn influences(&self, situation: &Situation<'_>) -> Vec<Influence> {
        let found = connection_of(situation.network, Self::KIND, &self.element);
        let struck = situation.impact.as_ref().zip(found.ok());
        let pulls = |at: usize| !situation.network.connections[at].never_pulls(0);
        let Some((impact, _)) = struck.filter(|&(own, at)| own.struck.contains(&at) && pulls(at))
        else {
            return Vec::new();
        };
        let contact = PI * impact.time();
        let formula = "max(0, 1 − π √(m1/K)/T)";
        vec![Influence::beyond(formula, situation.duration, contact)]
    }
}

impl EffectKind for Separation {
    const PER_ELEMENT: bool = true;

    fn would_be(situation: &Situation<'_>) -> Vec<Self> {
        let on = |element: &str| Self { element: element.to_owned(), at: None, restitution: 0.0 };
        situation.struck().filter(|own| !own.never_pulls(0)).map(|own| on(&own.name)).collect()
    }
}
