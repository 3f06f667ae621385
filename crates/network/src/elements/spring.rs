//! Linear spring.

use super::{Element, ElementKind, Law, Tangent, number};
use crate::parameters::{
    Dimension, InvalidParameter, Parameter, ParameterKind, Value, non_negative,
};

/// A linear (Hookean) spring, `F = k y`.
///
/// | symbol | field       | unit | range |
/// |--------|-------------|------|-------|
/// | `k`    | `stiffness` | N/m  | ≥ 0   |
///
/// The spring stores the energy `½ k y²` and dissipates none. `k = 0` is no spring at all.
///
/// # Limits
///
/// It has no limit of deformation: it may be pressed in by more than the thickness of what it
/// stands for, which is warned of where that is known.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::Spring};
///
/// let spring = Spring { stiffness: 200.0 };
/// assert_eq!(spring.force(0.01, 0.0), 2.0);
/// ```
///
/// # References
///
/// `hooke1678` in `docs/references.bib`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Spring constant `k` \[N/m\].
    pub stiffness: f64,
}

impl Element for Spring {
    fn kind(&self) -> &'static str {
        Self::KIND
    }

    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.stiffness * deformation
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: self.stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        0.5 * self.stiffness * deformation * deformation
    }

    fn law(&self) -> Law {
        Law::Spring(self.stiffness)
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        non_negative("spring", self.stiffness)
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Number(self.stiffness)]
    }
}

impl ElementKind for Spring {
    const KIND: &'static str = "spring";
    const SUMMARY: &'static str = "linear spring, F = k y";
    const PARAMETERS: &'static [Parameter] = &[Parameter::required(
        "spring",
        ParameterKind::Quantity(Dimension::STIFFNESS),
        "spring constant k [N/m], zero or positive",
    )];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let spring = Self { stiffness: number(values, 0, "spring")? };
        spring.validate().map(|()| spring)
    }

    fn sample() -> Self {
        Self { stiffness: 200.0 }
    }
}
