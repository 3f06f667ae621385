//! Contact with a stiffness and damping that grow from zero.

use super::{
    Element, ElementKind, Law, Tangent,
    impact_law::{Impact, ImpactLaw},
    number,
    power::{AT_PARAMETER, EXPONENT, FORCE_PARAMETER, PowerLaw},
};
use crate::{
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value},
    phases::Phases,
};

/// A contact with a stiffness and a damping that grow from zero with the depth,
/// `F = F_r (z/y_r)^n (1 + c ẏ)` with `z = y − gap > 0`, else 0.
///
/// | symbol | field         | unit | range |
/// |--------|---------------|------|-------|
/// | `F_r`  | `force`       | N    | > 0   |
/// | `y_r`  | `at`          | m    | > 0   |
/// | `c`    | `dissipation` | s/m  | ≥ 0   |
/// | `n`    | `exponent`    | 1    | ≥ 1, 3/2 (Hertz) where left out |
/// | `gap`  | `gap`         | m    | finite, 0 where left out |
///
/// The force begins at zero where it engages and ends at zero where it lets go, unlike that of a
/// spring and dashpot in parallel. It stores `∫ F_r (z/y_r)^n dz`, and dissipates
/// `F_r (z/y_r)^n c ẏ²`. A mass that meets it at the speed `v` leaves with a speed `e v` that depends
/// on `d = c v` alone: `d (1 + e) = ln((1 + d)/(1 − e d))`. For small `d`, `e ≈ 1 − 2 d/3`.
/// [`Bumper`](super::Bumper) finds `c` from a wanted `e`.
///
/// # Limits
///
/// It never pulls: where `ẏ < −1/c`, the factor `1 + c ẏ` counts as 0. Any reference `y_r` with the force
/// that the law has there is the same law, and gives the same results.
///
/// The slope over the rate vanishes where it engages. A massless node that nothing else damps finds its
/// rate all the same: while it is engaged, the compiler puts a dashpot beside it there, of 10⁻⁸ of the slope
/// that it has at the depth of the impact; only by its force may that of such a contact be below zero.
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::HuntCrossley};
///
/// let contact =
///     HuntCrossley { force: 1000.0, at: 0.001, dissipation: 0.2, exponent: 1.5, gap: 0.0 };
/// assert!((contact.force(0.001, 2.0) - 1400.0).abs() < 1e-10);
/// assert_eq!(contact.force(-0.001, 2.0), 0.0);
/// ```
///
/// # References
///
/// `hunt1975` in `docs/references.bib`; the equation for `e` under [`Bumper`](super::Bumper).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossley {
    /// Force `F_r` at the reference depth, at rest \[N\].
    pub force: f64,
    /// Reference depth `y_r` \[m\].
    pub at: f64,
    /// Part `c` by which the force rises with the rate \[s/m\].
    pub dissipation: f64,
    /// Exponent `n` of the depth.
    pub exponent: f64,
    /// Deformation at which it engages \[m\].
    pub gap: f64,
}

impl Impact for HuntCrossley {
    fn impact(&self) -> ImpactLaw {
        ImpactLaw {
            power: PowerLaw { force: self.force, at: self.at, exponent: self.exponent },
            dissipation: self.dissipation,
            gap: self.gap,
        }
    }
}

impl Element for HuntCrossley {
    fn kind(&self) -> &'static str {
        Self::KIND
    }

    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.impact().force(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        self.impact().tangent(deformation, rate)
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.impact().stored(deformation)
    }

    fn law(&self) -> Law {
        Law::Phased
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        self.impact().validate()
    }

    fn values(&self) -> Vec<Value> {
        [self.force, self.at, self.dissipation, self.exponent, self.gap].map(Value::Number).to_vec()
    }
}

impl ElementKind for HuntCrossley {
    const KIND: &'static str = "hunt-crossley";
    const SUMMARY: &'static str = "contact, F = F_r (z/y_r)^n (1 + c y') for z = y - gap > 0";
    const PARAMETERS: &'static [Parameter] = &[
        FORCE_PARAMETER,
        AT_PARAMETER,
        Parameter::required(
            "dissipation",
            ParameterKind::Quantity(Dimension::new(0, -1, 1)),
            "part c by which the force rises with the rate [s/m], zero or positive",
        ),
        Parameter::optional(
            EXPONENT,
            ParameterKind::Quantity(Dimension::NUMBER),
            "1.5",
            "exponent n of the depth [1], 1 or more",
        ),
        Parameter::optional(
            "gap",
            ParameterKind::Quantity(Dimension::LENGTH),
            "0 m",
            "deformation at which it engages [m]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let contact = Self {
            force: number(values, 0, "force")?,
            at: number(values, 1, "at")?,
            dissipation: number(values, 2, "dissipation")?,
            exponent: number(values, 3, EXPONENT)?,
            gap: number(values, 4, "gap")?,
        };
        contact.validate().map(|()| contact)
    }

    fn sample() -> Self {
        Self { force: 1000.0, at: 0.001, dissipation: 0.2, exponent: 1.5, gap: 0.0 }
    }
}
