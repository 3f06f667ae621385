//! Rigid link.

use super::{Element, Law, Tangent};
use crate::parameters::{InvalidParameter, Kind, Parameter, ParameterKind, Value};

/// A rigid link, `y = 0`: its ends move as one.
///
/// The compiler merges the nodes at its ends; the force in the link follows from the balance of
/// what hangs on either side. It stores and dissipates nothing.
///
/// # Limits
///
/// Its deformation is 0 from the start, so nodes that it links start with one speed. Several links
/// in parallel share their force in no way that could be told: a loop of them is refused.
///
/// # References
///
/// A constraint of kinematics; there is no law to cite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rigid;

impl Element for Rigid {
    /// Zero: a rigid link has no law for its force, which is a reaction.
    fn force(&self, _deformation: f64, _rate: f64) -> f64 {
        0.0
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent::default()
    }

    fn stored(&self, _deformation: f64) -> f64 {
        0.0
    }

    fn law(&self) -> Law {
        Law::Rigid
    }
}

impl Kind for Rigid {
    const KIND: &'static str = "rigid";
    const SUMMARY: &'static str = "rigid link, y = 0; merges its ends";
    const PARAMETERS: &'static [Parameter] =
        &[Parameter::new("rigid", ParameterKind::Flag, "write `rigid = true`")];

    fn from_values(_values: &[Value]) -> Result<Self, InvalidParameter> {
        Ok(Self)
    }

    fn fields(&self) -> Vec<Value> {
        vec![Value::Flag]
    }

    fn sample() -> Self {
        Self
    }
}
