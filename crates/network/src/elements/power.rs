//! The power law that several elements share.

use super::number;
use crate::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, positive};

/// Key of the force at the reference deformation.
pub(super) const FORCE: &str = "force";
/// Key of the reference deformation.
pub(super) const AT: &str = "at";
/// Key of the exponent.
pub(super) const EXPONENT: &str = "exponent";

/// The parameter [`FORCE`] of a law over the deformation.
pub(super) const FORCE_PARAMETER: Parameter = Parameter::required(
    FORCE,
    ParameterKind::Quantity(Dimension::FORCE),
    "force F_r at the deformation `at` [N], positive",
);
/// The parameter [`AT`] of a law over the deformation.
pub(super) const AT_PARAMETER: Parameter = Parameter::required(
    AT,
    ParameterKind::Quantity(Dimension::LENGTH),
    "reference deformation y_r [m], positive",
);

/// `F_r (y/y_r)^n` for `y ≥ 0`, with `n ≥ 1`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PowerLaw {
    /// `F_r`.
    pub(super) force: f64,
    /// `y_r`.
    pub(super) at: f64,
    /// `n`.
    pub(super) exponent: f64,
}

impl PowerLaw {
    /// The law of the first three of an element's values.
    pub(super) fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        Ok(Self {
            force: number(values, 0, FORCE)?,
            at: number(values, 1, AT)?,
            exponent: number(values, 2, EXPONENT)?,
        })
    }

    pub(super) fn values(&self) -> Vec<Value> {
        [self.force, self.at, self.exponent].map(Value::Number).to_vec()
    }

    pub(super) fn value(&self, deformation: f64) -> f64 {
        self.force * (deformation / self.at).powf(self.exponent)
    }

    pub(super) fn slope(&self, deformation: f64) -> f64 {
        self.secant() * self.exponent * (deformation / self.at).powf(self.exponent - 1.0)
    }

    /// The integral of [`value`](Self::value) from 0.
    pub(super) fn integral(&self, deformation: f64) -> f64 {
        self.value(deformation) * deformation / (self.exponent + 1.0)
    }

    /// The slope of the line from 0 to the reference, `F_r/y_r`.
    pub(super) fn secant(&self) -> f64 {
        self.force / self.at
    }

    pub(super) fn validate(&self) -> Result<(), InvalidParameter> {
        positive(FORCE, self.force)?;
        positive(AT, self.at)?;
        at_least_one(EXPONENT, self.exponent)?;
        in_range(AT, self.at, self.secant() * self.exponent)
    }
}

/// Accepts finite numbers ≥ 1.
pub(super) fn at_least_one(parameter: &'static str, value: f64) -> Result<(), InvalidParameter> {
    if value.is_finite() && value >= 1.0 {
        Ok(())
    } else {
        Err(InvalidParameter::new(parameter, "1 or more, and finite", value))
    }
}

/// Accepts `value` where the `slope` that it leads to is a normal number.
pub(super) fn in_range(
    parameter: &'static str,
    value: f64,
    slope: f64,
) -> Result<(), InvalidParameter> {
    if slope.is_normal() {
        Ok(())
    } else {
        let range = "such that the slope of the law fits into double precision";
        Err(InvalidParameter::new(parameter, range, format!("{value:?}")))
    }
}
