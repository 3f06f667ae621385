//! A network with other groups, and all else as it was.

use std::sync::Arc;

use dashpot_network::{
    Model, Network, Start,
    effects::{Face, Gravity},
    elements::{Dashpot, Law, Spring},
    first_nonlinear, linear_model,
    parameters::Kind as _,
    part,
};
use dashpot_rheology::{Branch, Tree};

use super::{FourParameterGroups, FourParameterImpact, FourParameterPadding, face, weight};
use crate::similarity::SimilarityError;

/// A drawing of the padding stands for it if its constants come back within this, relatively.
const SAME: f64 = 1e-9;

impl FourParameterGroups {
    /// A network of the thesis' form with these groups in place of its own, and the same `m1`, `V0`
    /// and `δ`: only numbers change. Names, effects and what they say stay, and so does the drawing of
    /// the padding where it is that of a spring, a dashpot and a Kelvin–Voigt element in a row. A
    /// mass on the face and gravity are added where the network has none and the groups ask for them:
    /// the face then begins with the speed of the impactor, and the support in balance.
    ///
    /// # Errors
    ///
    /// [`SimilarityError::OtherForm`], [`SimilarityError::GroupOutOfRange`],
    /// [`SimilarityError::NoPadding`].
    #[expect(clippy::float_cmp, reason = "what stays is the same to the last digit")]
    pub fn put_into(&self, network: &Network) -> Result<Network, SimilarityError> {
        let before = FourParameterImpact::of(network)?;
        let after = before.with_groups(self)?;
        let mut again = Network::new();
        for (id, node) in network.nodes().filter(|node| node.0 != network.ground()) {
            let mut node = node.clone();
            if network.node(id).name == after.names[2] {
                node.mass = after.support_mass;
            } else if [before.gravity] != [after.gravity] && matches!(node.start, Start::Drop(_)) {
                // The speed at touch stays, from another height.
                let height = after.speed * after.speed / (2.0 * after.gravity);
                node.start = if after.gravity > 0.0 {
                    Start::Drop(height)
                } else {
                    Start::Velocity(after.speed)
                };
            }
            again.add_node(node);
        }
        for own in network.connections() {
            let [from, to] = own.between;
            let model = if own.name == after.names[1] {
                padding(&own.model, &before.padding(), &after.padding())
            } else if before.support() == after.support() {
                own.model.clone()
            } else {
                after.support().mount()
            };
            let connection = again.connect(&*own.name, from, to, model);
            (connection.thickness, connection.area) = (own.thickness, own.area);
            connection.pads.clone_from(&own.pads);
        }
        for effect in network.effects() {
            if let Some(own) = effect.of_kind::<Gravity>() {
                again.add_effect(Gravity { acceleration: after.gravity, ..*own });
            } else if let Some(own) = effect.of_kind::<Face>() {
                again.add_effect(Face { mass: after.face_mass, ..own.clone() });
            } else {
                again.add_shared_effect(Arc::clone(effect));
            }
        }
        let has = |kind: &str| network.effects().iter().any(|effect| effect.kind() == kind);
        if after.face_mass > 0.0 && !has(Face::KIND) {
            again.add_effect(face(&after.names[1], &after.names[0], after.face_mass));
        }
        if after.gravity != 0.0 && !has(Gravity::KIND) {
            again.add_effect(weight(after.gravity));
        }
        Ok(again)
    }
}

/// The model of a padding with other constants: in its own drawing where that has these parts.
fn padding(model: &Model, before: &FourParameterPadding, after: &FourParameterPadding) -> Model {
    if before == after {
        return model.clone();
    }
    let drawn = redrawn(model, after);
    let is_same = constants(&drawn).is_some_and(|found| {
        let FourParameterPadding { k1, c1, k2, c2 } = *after;
        let pairs = found.iter().zip([k1, c1, k2, c2]);
        pairs.into_iter().all(|(found, own)| (found - own).abs() <= SAME * own)
    });
    if is_same { drawn } else { after.model() }
}

/// The model with K₁ and C₁ for springs and dashpots that are side by side with others, and with K₂
/// and C₂ for those in a row.
fn redrawn(model: &Model, own: &FourParameterPadding) -> Model {
    let both = model.fold(
        |element| {
            let of = |stiffness, damping| match element.law() {
                Law::Spring(_) => part(Spring { stiffness }),
                Law::Dashpot(_) => part(Dashpot { damping }),
                _ => Tree::Part(Arc::clone(element)),
            };
            (of(own.k2, own.c2), of(own.k1, own.c1))
        },
        |node, parts: Vec<(Model, Model)>| {
            let (in_row, beside): (Vec<Model>, Vec<Model>) = parts.into_iter().unzip();
            let named = |parts: Vec<Model>| -> Vec<Branch<_>> {
                let pairs = node.branches().iter().zip(parts);
                pairs.map(|(own, tree)| Branch::new(own.name.as_str(), tree)).collect()
            };
            if node.is_series() {
                (Tree::Series(named(in_row)), Tree::Series(named(beside)))
            } else {
                (Tree::Parallel(named(beside.clone())), Tree::Parallel(named(beside)))
            }
        },
    );
    both.0
}

/// K₁, C₁, K₂ and C₂ of a linear model that is a spring, a dashpot and a Kelvin–Voigt element in a
/// row from outside.
pub(super) fn constants(model: &Model) -> Option<[f64; 4]> {
    if first_nonlinear(model).is_some() {
        return None;
    }
    let linear = linear_model(model);
    let form = linear.kelvin()?;
    let elements = form.elements();
    let [only] = elements.as_slice() else { return None };
    let (compliance, fluidity) = (form.spring_compliance(), form.fluidity());
    (compliance > 0.0 && fluidity > 0.0)
        .then(|| [only.stiffness, only.damping, compliance.recip(), fluidity.recip()])
}
