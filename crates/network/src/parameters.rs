//! What a kind says about its parameters, so that parser, help, schema and tests need no second
//! list.

use std::{borrow::Cow, fmt};

use dashpot_rheology::Tree;
pub use dashpot_units::Dimension;
use thiserror::Error;

use crate::Model;

/// What a parameter's value is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterKind {
    /// A number of the given dimension.
    Quantity(Dimension),
    /// A difference of two temperatures \[K\]. Degrees Celsius count from a point of their own, so
    /// they do not say one.
    TemperatureDifference,
    /// A number with the dimension of what is driven: force for a load, length for a motion.
    Amplitude,
    /// Pairs of time and amplitude; the kind says in which order.
    TimeTable,
    /// Pairs of two quantities of these dimensions.
    Curve(Dimension, Dimension),
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

/// One parameter of a kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameter {
    /// Key in kebab-case.
    pub name: &'static str,
    /// What its value is.
    pub kind: ParameterKind,
    /// Value where the key is left out, in the form in which it would be written; `None` if it is
    /// required.
    pub default: Option<&'static str>,
    /// Whether it follows from the rest of the scene where the key is left out: the default then
    /// says in words from what, and the value is [`Value::LeftOut`].
    pub follows: bool,
    /// One line of help with symbol, unit and range.
    pub help: &'static str,
}

impl Parameter {
    /// A required parameter.
    pub const fn required(name: &'static str, kind: ParameterKind, help: &'static str) -> Self {
        Self { name, kind, default: None, follows: false, help }
    }

    /// A parameter that may be left out.
    pub const fn optional(
        name: &'static str,
        kind: ParameterKind,
        default: &'static str,
        help: &'static str,
    ) -> Self {
        Self { name, kind, default: Some(default), follows: false, help }
    }

    /// A parameter that follows from the rest of the scene where it is left out; `from` says how.
    pub const fn following(
        name: &'static str,
        kind: ParameterKind,
        from: &'static str,
        help: &'static str,
    ) -> Self {
        Self { name, kind, default: Some(from), follows: true, help }
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

/// A model as the value of a parameter. Two are equal where their trees, the names of branches, and
/// the kinds and values of elements are.
#[derive(Debug, Clone)]
pub struct ModelValue(pub Model);

impl PartialEq for ModelValue {
    fn eq(&self, other: &Self) -> bool {
        is_same(&self.0, &other.0)
    }
}

fn is_same(one: &Model, other: &Model) -> bool {
    if let (Tree::Part(one), Tree::Part(other)) = (one, other) {
        return one.kind() == other.kind() && one.values() == other.values();
    }
    let pairs = || one.branches().iter().zip(other.branches());
    std::mem::discriminant(one) == std::mem::discriminant(other)
        && one.branches().len() == other.branches().len()
        && pairs().all(|(one, other)| one.name == other.name && is_same(&one.tree, &other.tree))
}

/// The part of a run that a measure looks at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WindowWish {
    /// From first contact to the first zero of the contact force.
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

/// Accepts finite numbers ≥ 0.
///
/// # Errors
///
/// [`InvalidParameter`] for all others, NaN included.
pub fn non_negative(parameter: &'static str, value: f64) -> Result<(), InvalidParameter> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(InvalidParameter::new(parameter, "zero or positive, and finite", value))
    }
}

/// Accepts finite numbers > 0.
///
/// # Errors
///
/// [`InvalidParameter`] for all others, NaN included.
pub fn positive(parameter: &'static str, value: f64) -> Result<(), InvalidParameter> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(InvalidParameter::new(parameter, "positive and finite", value))
    }
}

/// Accepts finite numbers.
///
/// # Errors
///
/// [`InvalidParameter`] for infinities and NaN.
pub fn finite(parameter: &'static str, value: f64) -> Result<(), InvalidParameter> {
    if value.is_finite() { Ok(()) } else { Err(InvalidParameter::new(parameter, "finite", value)) }
}

/// Accepts temperatures above absolute zero \[K\].
///
/// # Errors
///
/// [`InvalidParameter`] for all others, NaN included.
pub fn above_absolute_zero(parameter: &'static str, value: f64) -> Result<(), InvalidParameter> {
    if value.is_finite() && value > 0.0 {
        Ok(())
    } else {
        Err(InvalidParameter::new(parameter, "above absolute zero, and finite", kelvins(value)))
    }
}

/// A temperature \[K\] as text for a message, without the digits that come from rounding.
pub(crate) fn kelvins(value: f64) -> String {
    let rounded = (value * 1e6).round() / 1e6;
    format!("{} K", if rounded == 0.0 || !rounded.is_finite() { value } else { rounded })
}
