//! What a kind says about its parameters, so that parser, help, schema and tests need no second list.

mod declaration;
mod range;

use std::{any::Any, borrow::Cow, fmt, sync::Arc};

pub use dashpot_formula::{Formula, Variable};
pub use dashpot_units::{Dimension, words};
use thiserror::Error;

pub(crate) use declaration::described_as;
pub use declaration::{Described, Field, Given, Kind, Registered, registered, words};
pub use range::Range;
pub(crate) use range::kelvins;

/// What a parameter's value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterKind {
    /// A number of the given dimension.
    Quantity(Dimension),
    /// A difference of two temperatures \[K\]. Degrees Celsius count from a point of their own, so they do not say one.
    TemperatureDifference,
    /// A number with the dimension of what is driven: force for a load, length for a motion.
    Amplitude,
    /// Pairs of time and amplitude; the kind says in which order.
    TimeTable,
    /// Pairs of two quantities of these dimensions.
    Curve(Dimension, Dimension),
    /// A formula of a force \[N\] over the deformation `y` and its rate `v`.
    LawFormula,
    /// A formula over the time `t`, with the dimension of what is driven.
    TimeFormula,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// `true`; the key's presence says it all.
    Flag,
    /// `"impact"`, `"run"` or a pair of times.
    Window,
    /// The name of a node.
    Node,
    /// A two-terminal model.
    Model,
}

impl ParameterKind {
    /// The variables of a formula; none of all else.
    pub const fn variables(self) -> &'static [Variable] {
        match self {
            Self::LawFormula => &[("y", Dimension::LENGTH), ("v", Dimension::VELOCITY)],
            Self::TimeFormula => &[("t", Dimension::TIME)],
            _ => &[],
        }
    }

    /// Whether it is a list of points, for which scenes take a file of numbers as well.
    pub const fn is_points(self) -> bool {
        matches!(self, Self::TimeTable | Self::Curve(..))
    }
}

/// What a curve of a law is, beyond its dimensions: what a measured one is fitted to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveRole {
    /// It never falls.
    Rising,
    /// It never falls, and goes through (0, 0).
    FromRest,
    /// What is given back from the depth of its last point, on the curve that is the parameter before it. Its
    /// share of that never falls.
    Unloading,
}

/// One parameter of a kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Key in kebab-case.
    pub name: &'static str,
    /// What its value is.
    pub kind: ParameterKind,
    /// Value where the key is left out, in the form in which it would be written; `None` if it is required.
    pub default: Option<&'static str>,
    /// Whether it follows from the rest of the scene where the key is left out: the default then
    /// says in words from what, and the value is [`Value::LeftOut`].
    pub follows: bool,
    /// The range of its number.
    pub range: Range,
    /// What it is where it is a [`ParameterKind::Curve`].
    pub curve: CurveRole,
    /// One line of help with symbol, unit and range.
    pub help: &'static str,
}

impl Parameter {
    /// A parameter that is required, of any finite numbers.
    pub const fn new(name: &'static str, kind: ParameterKind, help: &'static str) -> Self {
        let (range, curve) = (Range::Finite, CurveRole::Rising);
        Self { name, kind, default: None, follows: false, range, curve, help }
    }

    /// The same where it may be left out and is then `text`.
    #[must_use]
    pub const fn default(self, text: &'static str) -> Self {
        Self { default: Some(text), ..self }
    }

    /// The same where it may be left out and then follows from the rest of the scene; `from` says how.
    #[must_use]
    pub const fn follows(self, from: &'static str) -> Self {
        Self { default: Some(from), follows: true, ..self }
    }

    /// The same with numbers of this range alone.
    #[must_use]
    pub const fn range(self, range: Range) -> Self {
        Self { range, ..self }
    }

    /// The same as a curve of this role.
    #[must_use]
    pub const fn curve(self, curve: CurveRole) -> Self {
        Self { curve, ..self }
    }

    /// Checks a value.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] for a number out of range, and for times of a window that are not in
    /// order.
    pub fn check(&self, value: &Value) -> Result<(), InvalidParameter> {
        match *value {
            Value::Number(number) => self.range.check(self.name, number),
            Value::Window(WindowWish::Times(from, to))
                if !(from.is_finite() && to.is_finite() && from < to) =>
            {
                let range = "a pair of times, the earlier one first";
                Err(InvalidParameter::new(self.name, range, format!("{from} s to {to} s")))
            }
            _ => Ok(()),
        }
    }
}

/// A parameter's value, in SI units.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// For [`ParameterKind::Quantity`], [`ParameterKind::TemperatureDifference`] and
    /// [`ParameterKind::Amplitude`].
    Number(f64),
    /// For [`ParameterKind::TimeTable`] and [`ParameterKind::Curve`].
    Table(Vec<(f64, f64)>),
    /// For [`ParameterKind::LawFormula`] and [`ParameterKind::TimeFormula`]; its names are their variables.
    Formula(Formula),
    /// For [`ParameterKind::Choice`] and [`ParameterKind::Node`].
    Word(String),
    /// For [`ParameterKind::Flag`].
    Flag,
    /// For [`ParameterKind::Window`].
    Window(WindowWish),
    /// For [`ParameterKind::Model`].
    Model(ModelValue),
    /// Of a parameter that [follows](Parameter::follows) from the rest of the scene.
    LeftOut,
}

/// A value that is not looked into here.
pub trait Opaque: Any + fmt::Debug + Send + Sync {
    /// Whether it is the same as another one.
    fn is_same(&self, other: &dyn Opaque) -> bool;
}

/// A [model](crate::Model) as the value of a parameter. Two are equal where their trees, the names of
/// branches, and the kinds and values of elements are.
#[derive(Debug, Clone)]
pub struct ModelValue(pub(crate) Arc<dyn Opaque>);

impl PartialEq for ModelValue {
    fn eq(&self, other: &Self) -> bool {
        self.0.is_same(&*other.0)
    }
}

/// The part of a run that a measure looks at.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum WindowWish {
    /// From first contact to the first zero of the contact force.
    #[default]
    Impact,
    /// The whole run.
    Run,
    /// From one time to another \[s\].
    Times(f64, f64),
}

impl Value {
    /// The number, where it is one.
    pub fn number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }
}

/// A parameter out of its range.
#[derive(Debug, Clone, PartialEq, Error)]
#[error("`{parameter}` must be {range}, but it is {found}")]
pub struct InvalidParameter {
    /// Key of the parameter.
    pub parameter: &'static str,
    /// Its range in words, with unit.
    pub range: Cow<'static, str>,
    /// What was given.
    pub found: String,
}

impl InvalidParameter {
    /// Says that `parameter` must be in `range` but is `found`.
    pub fn new(
        parameter: &'static str,
        range: impl Into<Cow<'static, str>>,
        found: impl fmt::Display,
    ) -> Self {
        Self { parameter, range: range.into(), found: found.to_string() }
    }
}
