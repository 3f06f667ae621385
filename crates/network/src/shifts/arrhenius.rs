//! The shift of Arrhenius.

use super::ShiftKind;
use crate::{
    elements::number,
    parameters::{
        Dimension, InvalidParameter, Parameter, ParameterKind, Value, above_absolute_zero,
        non_negative,
    },
};

/// Boltzmann constant `k_B` \[J/K\], exact by the definition of the kelvin (SI brochure, 2019).
const BOLTZMANN: f64 = 1.380_649e-23;

/// The shift of Arrhenius, `ln a_T = (E/k_B) (1/T − 1/T_ref)`.
///
/// | symbol  | field         | unit | range |
/// |---------|---------------|------|-------|
/// | `T`     | `temperature` | K    | > 0   |
/// | `T_ref` | `reference`   | K    | > 0   |
/// | `E`     | `energy`      | J    | ≥ 0   |
///
/// `E` is the energy for one molecule, so the law has the constant of Boltzmann; an energy for a mole
/// is the same when it is divided by the number of molecules in a mole, as in `"80 kJ/mol"`.
///
/// # Limits
///
/// It describes thermally activated flow far above and below the glass transition. Across the
/// transition the energy is no constant; there [`Wlf`](super::Wlf) holds.
///
/// # References
///
/// `arrhenius1889` in `docs/references.bib`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrhenius {
    /// The temperature `T` of the model \[K\].
    pub temperature: f64,
    /// The temperature `T_ref` at which its times hold \[K\].
    pub reference: f64,
    /// Activation energy `E` of one molecule \[J\].
    pub energy: f64,
}

impl ShiftKind for Arrhenius {
    const KIND: &'static str = "arrhenius";
    const SUMMARY: &'static str = "times multiplied by a_T, ln a_T = (E/k_B) (1/T - 1/T_ref)";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required(
            "temperature",
            ParameterKind::Quantity(Dimension::TEMPERATURE),
            "temperature T [K or degC]",
        ),
        Parameter::required(
            "reference",
            ParameterKind::Quantity(Dimension::TEMPERATURE),
            "temperature T_ref at which the times of the model hold [K or degC]",
        ),
        Parameter::required(
            "energy",
            ParameterKind::Quantity(Dimension::ENERGY),
            "activation energy E, for instance \"80 kJ/mol\"; without \"/mol\" that of one molecule [J]",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let shift = Self {
            temperature: number(values, 0, "temperature")?,
            reference: number(values, 1, "reference")?,
            energy: number(values, 2, "energy")?,
        };
        shift.factor().map(|_| shift)
    }

    fn values(&self) -> Vec<Value> {
        [self.temperature, self.reference, self.energy].map(Value::Number).into()
    }

    fn factor(&self) -> Result<f64, InvalidParameter> {
        above_absolute_zero("temperature", self.temperature)?;
        above_absolute_zero("reference", self.reference)?;
        non_negative("energy", self.energy)?;
        // One difference of the temperatures, so that no digits are lost where they are close.
        let below_reference = (self.reference - self.temperature) / self.reference;
        let exponent = self.energy / BOLTZMANN / self.temperature * below_reference;
        let factor = exponent.exp();
        if factor.is_normal() {
            Ok(factor)
        } else {
            let range = "such that the factor a_T fits into double precision (an energy for a \
                         mole is written as \"80 kJ/mol\")";
            Err(InvalidParameter::new(
                "energy",
                range,
                format!("{:?} J for one molecule", self.energy),
            ))
        }
    }

    fn sample() -> Self {
        Self { temperature: 308.15, reference: 293.15, energy: 1.328_431_253_739_077e-19 }
    }
}
