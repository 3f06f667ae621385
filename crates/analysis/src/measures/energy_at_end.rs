//! Energy taken up at the end of the run.

use dashpot_network::parameters::{InvalidParameter, Parameter, Value, WindowWish};

use super::{Energy, Family, MeasureKind, Reading};
use crate::Solution;

/// The energy that an element has taken up at the end of the run, `∫ F ẏ dt` over all of it \[J\];
/// otherwise as [`Energy`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EnergyAtEnd;

impl MeasureKind for EnergyAtEnd {
    const KIND: &'static str = "energy-at-end";
    const SUMMARY: &'static str = "energy taken up by the element until the end of the run [J]";
    const UNIT: &'static str = "J";
    const PARAMETERS: &'static [Parameter] = &[];
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;

    fn from_values(_values: &[Value]) -> Result<Self, InvalidParameter> {
        Ok(Self)
    }

    fn values(&self) -> Vec<Value> {
        Vec::new()
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        MeasureKind::read(&Energy { window: WindowWish::Run }, solution, target)
    }
}
