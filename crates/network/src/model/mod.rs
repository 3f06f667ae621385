//! Two-terminal models made of elements, also as linear models and as values of parameters.

pub(crate) mod depth;
pub(crate) mod stiffness;

use std::{any::Any, sync::Arc};

use dashpot_rheology::{LinearModel, Primitive, Tree};

use crate::{
    elements::{Dashpot, ELEMENTS, Element, Law, Rigid, Spring},
    parameters::{Field, ModelValue, Opaque, Value, registered},
};

/// A two-terminal model composed of elements: `a + b` is a series, `a | b` stands in parallel.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Model, dashpot, elements::PowerSpring, linear_model, spring};
///
/// let zener = spring(6e4) | spring(2e5) + dashpot(400.0);
/// assert!((linear_model(&zener).relaxation(0.0) / 2.6e5 - 1.0).abs() < 1e-14);
///
/// let skin = PowerSpring { force: 200.0, at: 0.01, exponent: 1.5 };
/// let pad: Model = zener + skin;
/// assert_eq!(pad.branches().len(), 2);
/// ```
pub type Model = Tree<Arc<dyn Element>>;

/// The model that is one element.
pub fn part(element: impl Element + 'static) -> Model {
    Tree::Part(Arc::new(element))
}

/// The model that is one [`Spring`] of this stiffness \[N/m\], positive.
pub fn spring(stiffness: f64) -> Model {
    part(Spring { stiffness })
}

/// The model that is one [`Dashpot`] of this damping \[N s/m\], positive.
pub fn dashpot(damping: f64) -> Model {
    part(Dashpot { damping })
}

impl Opaque for Model {
    fn is_same(&self, other: &dyn Opaque) -> bool {
        (other as &dyn Any).downcast_ref().is_some_and(|other| is_same(self, other))
    }
}

fn is_same(one: &Model, other: &Model) -> bool {
    if let (Tree::Part(one), Tree::Part(other)) = (one, other) {
        // What is not in the register has no parameters that tell it from others of its kind.
        let is_told = registered(ELEMENTS, one.kind()).is_some();
        let is_like = one.kind() == other.kind() && one.values() == other.values();
        return is_like && (is_told || Arc::ptr_eq(one, other));
    }
    let pairs = || one.branches().iter().zip(other.branches());
    std::mem::discriminant(one) == std::mem::discriminant(other)
        && one.branches().len() == other.branches().len()
        && pairs().all(|(one, other)| one.name == other.name && is_same(&one.tree, &other.tree))
}

impl ModelValue {
    /// A model as a value.
    pub fn new(model: Model) -> Self {
        Self(Arc::new(model))
    }

    /// The model.
    pub fn model(&self) -> Option<&Model> {
        (&*self.0 as &dyn Any).downcast_ref()
    }
}

impl Field for Model {
    const EXPECTED: &'static str = "a model";

    fn of(value: &Value) -> Option<Self> {
        if let Value::Model(value) = value { value.model().cloned() } else { None }
    }

    fn value(&self) -> Value {
        Value::Model(ModelValue::new(self.clone()))
    }
}

/// What a model is, seen from outside: all its material functions and canonical forms.
///
/// # Examples
///
/// ```
/// use dashpot_network::{dashpot, linear_model, spring};
///
/// let maxwell = spring(2e7) + dashpot(6e3);
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
        Primitive::Spring(stiffness) => spring(stiffness),
        Primitive::Dashpot(damping) => dashpot(damping),
        Primitive::Rigid => part(Rigid),
    })
}
