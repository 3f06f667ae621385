//! The shift of Williams, Landel and Ferry.

use super::ShiftKind;
use crate::{
    parameters,
    parameters::{Described, InvalidParameter, kelvins},
};

parameters! {
    /// The shift of Williams, Landel and Ferry, `log10 a_T = −c1 (T − T_ref)/(c2 + T − T_ref)`.
    ///
    /// | symbol  | field         | unit | range           |
    /// |---------|---------------|------|-----------------|
    /// | `T`     | `temperature` | K    | > `T_ref` − `c2` |
    /// | `T_ref` | `reference`   | K    | > 0             |
    /// | `c1`    | `c1`          | 1    | > 0             |
    /// | `c2`    | `c2`          | K    | > 0             |
    ///
    /// The constants belong to the reference temperature: 17.44 and 51.6 K, which are average values of
    /// many polymers, hold where the reference is the glass transition.
    ///
    /// # Limits
    ///
    /// It describes polymers from their glass transition to about 100 K above. Towards `T_ref − c2` all
    /// times grow without bound, and at or below it the law has no meaning.
    ///
    /// # References
    ///
    /// `wlf1955` in `docs/references.bib`, eq. 1.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Wlf: "wlf", "times multiplied by a_T, log10 a_T = -c1 (T - T_ref)/(c2 + T - T_ref)" {
        /// temperature T [K or degC], above T_ref - c2
        pub temperature: f64 = Quantity(Dimension::TEMPERATURE), range AboveAbsoluteZero;
        /// temperature T_ref at which the times of the model hold [K or degC], above absolute zero
        pub reference: f64 = Quantity(Dimension::TEMPERATURE), range AboveAbsoluteZero;
        /// constant c1 [1], positive; 17.44 is usual where T_ref is the glass transition
        pub c1: f64 = Quantity(Dimension::NUMBER), default "17.44", range Positive;
        /// constant c2 [K], positive; 51.6 K is usual where T_ref is the glass transition
        pub c2: f64 = TemperatureDifference, default "51.6 K";
    }
    sample { temperature: 308.15, reference: 293.15, c1: 17.44, c2: 51.6 }
}

impl ShiftKind for Wlf {
    fn factor(&self) -> Result<f64, InvalidParameter> {
        self.validate()?;
        let found = || kelvins(self.temperature);
        let above_reference = self.temperature - self.reference;
        let above_limit = self.c2 + above_reference;
        if above_limit <= 0.0 {
            let limit = kelvins(self.reference - self.c2);
            let range = format!(
                "above {limit} (`reference` - c2), below which the law of WLF has no meaning"
            );
            return Err(InvalidParameter::new("temperature", range, found()));
        }
        let factor = 10.0_f64.powf(-self.c1 * (above_reference / above_limit));
        if factor.is_normal() {
            Ok(factor)
        } else {
            let range = "such that the factor a_T fits into double precision";
            Err(InvalidParameter::new("temperature", range, found()))
        }
    }
}
