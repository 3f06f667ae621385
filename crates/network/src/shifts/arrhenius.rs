//! The shift of Arrhenius.

use super::ShiftKind;
use crate::{
    parameters,
    parameters::{Described, InvalidParameter},
};

/// Boltzmann constant `k_B` \[J/K\], exact by the definition of the kelvin (SI brochure, 2019).
const BOLTZMANN: f64 = 1.380_649e-23;

parameters! {
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
    pub struct Arrhenius: "arrhenius", "times multiplied by a_T, ln a_T = (E/k_B) (1/T - 1/T_ref)" {
        /// temperature T [K or degC], above absolute zero
        pub temperature: f64 = Quantity(Dimension::TEMPERATURE), range AboveAbsoluteZero;
        /// temperature T_ref at which the times of the model hold [K or degC], above absolute zero
        pub reference: f64 = Quantity(Dimension::TEMPERATURE), range AboveAbsoluteZero;
        /// activation energy E, for instance "80 kJ/mol"; without "/mol" that of one molecule [J], zero or positive
        pub energy: f64 = Quantity(Dimension::ENERGY), range NonNegative;
    }
    sample { temperature: 308.15, reference: 293.15, energy: 1.328_431_253_739_077e-19 }
}

impl ShiftKind for Arrhenius {
    fn factor(&self) -> Result<f64, InvalidParameter> {
        self.validate()?;
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
}
