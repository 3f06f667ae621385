//! Stop at a given deformation of an element.

use std::sync::Arc;

use dashpot_rheology::{Branch, Tree};

use super::{Effect, EffectKind, site::connection_of};
use crate::{
    Influence, Model, Network, NetworkError, Situation,
    elements::{Contact, Dashpot, Spring},
    parameters,
    parameters::{InvalidParameter, Kind as _},
    part,
};

parameters! {
    /// Bottoming out: beyond the deformation `at` a stop beside the element pushes and never pulls.
    ///
    /// | symbol | field         | unit  | range |
    /// |--------|---------------|-------|-------|
    /// | `d`    | `at`          | m     | ≥ 0   |
    /// | `e`    | `restitution` | 1     | 0 … 1, of a rigid stop |
    /// | `k`    | `stiffness`   | N/m   | ≥ 0; a rigid stop where there is none |
    /// | `c`    | `damping`     | N s/m | ≥ 0, of a stop with stiffness |
    ///
    /// The stop is the connection `<element>.stop` between the ends of the element. A rigid one is a
    /// [`Contact`] with the gap `d`, `y ≤ d`: masses that meet on it have an impact. One with stiffness
    /// has the force `max(0, k (y − d) + c ẏ)` in contact: the contact in series with a spring and a
    /// dashpot side by side, which lets go where the force falls to zero and then returns by itself.
    ///
    /// # Limits
    ///
    /// The element goes on to bear its own force beside the stop, by its law beyond `d`. A rigid stop
    /// makes the speeds jump where masses meet on it, so peaks of force and acceleration are infinite
    /// there. A stop with damping begins with the force `c ẏ` at once.
    ///
    /// # References
    ///
    /// `signorini1959` in `docs/references.bib` for the rigid stop; `mindlin1945`, "bi-linear
    /// elasticity", for cushions that bottom abruptly.
    #[derive(Debug, Clone, PartialEq)]
    pub struct Stop on element: "stop",
        "the element bottoms out at a deformation; the stop never pulls", checked by Self::suits
    {
        /// deformation at which the stop is met [m], zero or positive
        pub at: Option<f64> = Quantity(Dimension::LENGTH),
            follows "the thickness of the element", range NonNegative;
        /// restitution e of masses that meet on a rigid stop [1], 0 to 1
        pub restitution: f64 = Quantity(Dimension::NUMBER), default "0", range Part;
        /// stiffness k of the stop [N/m], zero or positive
        pub stiffness: Option<f64> = Quantity(Dimension::STIFFNESS),
            follows "rigid", range NonNegative;
        /// damping c of a stop with stiffness [N s/m], zero or positive
        pub damping: f64 = Quantity(Dimension::DAMPING), default "0 N s/m", range NonNegative;
    }
    sample {
        element: "padding".to_owned(),
        at: Some(0.015),
        restitution: 0.0,
        stiffness: Some(2e8),
        damping: 1e4,
    }
}

/// Says that `parameter` has no place beside what else was given.
fn needless(parameter: &'static str, range: &'static str, value: f64) -> InvalidParameter {
    InvalidParameter::new(parameter, range, value)
}

impl Stop {
    fn contact(&self, gap: f64) -> Contact {
        Contact { gap, restitution: self.restitution }
    }

    /// The model of a stop at `gap` \[m\]; `None` where it takes no force.
    fn model(&self, gap: f64) -> Option<Model> {
        let contact = part(self.contact(gap));
        let Some(stiffness) = self.stiffness else { return Some(contact) };
        let spring = (stiffness > 0.0).then(|| part(Spring { stiffness }));
        let dashpot = (self.damping > 0.0).then(|| part(Dashpot { damping: self.damping }));
        let named = |word: &'static str| move |tree| Branch::new(word, tree);
        let mut parts: Vec<_> =
            [spring.map(named(Spring::KIND)), dashpot.map(named(Dashpot::KIND))]
                .into_iter()
                .flatten()
                .collect();
        let resistance = match parts.len() {
            0 | 1 => parts.pop()?,
            _ => Branch::new("parallel", Tree::Parallel(parts)),
        };
        Some(Tree::Series(vec![Branch::new(Contact::KIND, contact), resistance]))
    }
}

impl Stop {
    /// What belongs to a rigid stop or to one with stiffness alone.
    fn suits(&self) -> Result<(), InvalidParameter> {
        match self.stiffness {
            None if self.damping > 0.0 => {
                Err(needless("damping", "zero without `stiffness`: a rigid stop", self.damping))
            }
            Some(_) if self.restitution > 0.0 => {
                let range = "zero beside `stiffness`: only masses on a rigid stop are reflected";
                Err(needless("restitution", range, self.restitution))
            }
            _ => Ok(()),
        }
    }
}

impl Effect for Stop {
    on_element!();

    fn rewrite(&self, network: &mut Network) -> Result<(), NetworkError> {
        let at = connection_of(network, Self::KIND, &self.element)?;
        let element = &network.connections[at];
        let gap = self.at.or(element.thickness);
        let gap = gap.ok_or_else(|| NetworkError::NoDepth { element: self.element.clone() })?;
        let [from, to] = element.between;
        if let Some(model) = self.model(gap) {
            network.connect(format!("{}.stop", self.element), from, to, model);
            network.pad_mut(at).stop = Some(network.connections.len() - 1);
        }
        Ok(())
    }

    fn influences(&self, situation: &Situation<'_>) -> Vec<Influence> {
        let network = situation.network;
        let found = connection_of(network, Self::KIND, &self.element);
        let Some(connection) = found.ok().and_then(|at| network.connections.get(at)) else {
            return Vec::new();
        };
        let limit = self.at.or(connection.thickness);
        let Some((limit, depth)) = limit.zip(situation.depth(connection)) else {
            return Vec::new();
        };
        let formula = "max(0, 1 − d/y)";
        vec![Influence::beyond(formula, depth, limit)]
    }
}

impl EffectKind for Stop {
    const PER_ELEMENT: bool = true;

    fn would_be(situation: &Situation<'_>) -> Vec<Self> {
        let on = |element: &str| Self {
            element: element.to_owned(),
            at: None,
            restitution: 0.0,
            stiffness: None,
            damping: 0.0,
        };
        let pads = situation.struck().filter(|own| own.thickness.is_some());
        pads.map(|pad| on(&pad.name)).collect()
    }
}
