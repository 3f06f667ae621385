//! Energy taken up at the end of the run.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Energy, Family, MeasureKind, Reading};
use crate::Solution;

parameters! {
    /// The energy that an element has taken up at the end of the run, `∫ F ẏ dt` over all of it \[J\];
    /// otherwise as [`Energy`].
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct EnergyAtEnd: "energy-at-end",
        "energy taken up by the element until the end of the run [J]"
    {}
}

impl MeasureKind for EnergyAtEnd {
    const UNIT: &'static str = "J";
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        MeasureKind::read(&Energy { window: WindowWish::Run }, solution, target)
    }
}
