//! A straight line, the law of a phase.

use super::{Element, Law, Tangent};
use crate::parameters::{Described, Parameter, Value};

/// The force `F = F₀ + k y` within a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Line {
    /// `k` \[N/m\].
    stiffness: f64,
    /// `F₀` \[N\], the force at zero deformation.
    push: f64,
    /// What it stores \[J\] at zero deformation.
    at_zero: f64,
}

impl Line {
    /// The line of a stiffness \[N/m\] with the force `push` \[N\] at zero deformation. It stores nothing where
    /// it has no force, or at zero deformation where it has one everywhere.
    pub(super) fn new(stiffness: f64, push: f64) -> Self {
        let at_zero = if stiffness > 0.0 { 0.5 * push * (push / stiffness) } else { 0.0 };
        Self { stiffness, push, at_zero }
    }

    /// The same with the energy that `other` stores at the deformation `corner` \[m\].
    pub(super) fn going_on(self, other: &Self, corner: f64) -> Self {
        let own = Self { at_zero: 0.0, ..self };
        Self { at_zero: other.stored(corner) - own.stored(corner), ..self }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.push.is_finite() && self.at_zero.is_finite()
    }
}

impl Described for Line {
    fn kind(&self) -> &'static str {
        "line"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    fn values(&self) -> Vec<Value> {
        Vec::new()
    }
}

impl Element for Line {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.push + self.stiffness * deformation
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: self.stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.at_zero + (self.push + 0.5 * self.stiffness * deformation) * deformation
    }

    fn law(&self) -> Law {
        Law::Spring(self.stiffness)
    }

    fn push(&self) -> f64 {
        self.push
    }
}
