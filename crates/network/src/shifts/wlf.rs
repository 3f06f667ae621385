//! The shift of Williams, Landel and Ferry.

use super::ShiftKind;
use crate::{
    elements::number,
    parameters::{
        Dimension, InvalidParameter, Parameter, ParameterKind, Value, above_absolute_zero, kelvins,
        positive,
    },
};

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
pub struct Wlf {
    /// The temperature `T` of the model \[K\].
    pub temperature: f64,
    /// The temperature `T_ref` at which its times hold \[K\].
    pub reference: f64,
    /// `c1` \[1\].
    pub c1: f64,
    /// `c2` \[K\], a difference of temperatures.
    pub c2: f64,
}

impl ShiftKind for Wlf {
    const KIND: &'static str = "wlf";
    const SUMMARY: &'static str =
        "times multiplied by a_T, log10 a_T = -c1 (T - T_ref)/(c2 + T - T_ref)";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::required(
            "temperature",
            ParameterKind::Quantity(Dimension::TEMPERATURE),
            "temperature T [K or degC], above T_ref - c2",
        ),
        Parameter::required(
            "reference",
            ParameterKind::Quantity(Dimension::TEMPERATURE),
            "temperature T_ref at which the times of the model hold [K or degC]",
        ),
        Parameter::optional(
            "c1",
            ParameterKind::Quantity(Dimension::NUMBER),
            "17.44",
            "constant c1 [1], positive; 17.44 is usual where T_ref is the glass transition",
        ),
        Parameter::optional(
            "c2",
            ParameterKind::TemperatureDifference,
            "51.6 K",
            "constant c2 [K], positive; 51.6 K is usual where T_ref is the glass transition",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let shift = Self {
            temperature: number(values, 0, "temperature")?,
            reference: number(values, 1, "reference")?,
            c1: number(values, 2, "c1")?,
            c2: number(values, 3, "c2")?,
        };
        shift.factor().map(|_| shift)
    }

    fn values(&self) -> Vec<Value> {
        [self.temperature, self.reference, self.c1, self.c2].map(Value::Number).into()
    }

    fn factor(&self) -> Result<f64, InvalidParameter> {
        above_absolute_zero("temperature", self.temperature)?;
        above_absolute_zero("reference", self.reference)?;
        positive("c1", self.c1)?;
        positive("c2", self.c2)?;
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

    fn sample() -> Self {
        Self { temperature: 308.15, reference: 293.15, c1: 17.44, c2: 51.6 }
    }
}
