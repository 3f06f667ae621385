//! Models as linear models, and back.

use std::sync::Arc;

use dashpot_rheology::{LinearModel, Primitive, Tree};

use crate::{
    Element, Model,
    elements::{Dashpot, Law, Rigid, Spring},
    part,
};

/// What a model is, seen from outside: all its material functions and canonical forms.
///
/// # Examples
///
/// ```
/// use dashpot_network::{elements::{Dashpot, Spring}, linear_model, part};
/// use dashpot_rheology::Tree;
///
/// let maxwell = Tree::series([part(Spring { stiffness: 2e7 }), part(Dashpot { damping: 6e3 })]);
/// let model = linear_model(&maxwell);
/// assert!((model.relaxation(3e-4) / (2e7 * (-1_f64).exp()) - 1.0).abs() < 1e-14);
/// ```
pub fn linear_model(model: &Model) -> LinearModel {
    LinearModel::of(model, |element| primitive(element.as_ref()))
}

/// Whether every element of a model is a linear spring, dashpot or rigid link.
pub fn is_linear(model: &Model) -> bool {
    first_nonlinear(model).is_none()
}

/// The first element of a model that is no linear spring, dashpot or rigid link.
pub fn first_nonlinear(model: &Model) -> Option<&Arc<dyn Element>> {
    model.leaves().find(|leaf| matches!(leaf.law(), Law::Nonlinear { .. } | Law::Phased))
}

/// An element as a part of a linear model. One that is not [linear](is_linear) has no linear model;
/// whoever asks for one must have made sure of that.
pub fn primitive(element: &dyn Element) -> Primitive {
    match element.law() {
        Law::Nonlinear { .. } | Law::Phased => Primitive::Spring(f64::NAN),
        Law::Spring(stiffness) => Primitive::Spring(stiffness),
        Law::Dashpot(damping) => Primitive::Dashpot(damping),
        Law::Rigid => Primitive::Rigid,
    }
}

/// The elements of a canonical network.
pub fn model_of(tree: &Tree<Primitive>) -> Model {
    tree.map(|tree| match *tree {
        Primitive::Spring(stiffness) => part(Spring { stiffness }),
        Primitive::Dashpot(damping) => part(Dashpot { damping }),
        Primitive::Rigid => part(Rigid),
    })
}
