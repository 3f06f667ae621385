//! Numbers without a unit in the place of what has one in the scene.

use dashpot_network::parameters::Dimension;
use dashpot_units::{parse_quantity, si_unit};
use thiserror::Error;

/// What becomes of numbers without a unit where one is expected. They are in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum BareNumbers {
    /// Nothing is said but of those that are probably meant in another unit: for programs.
    #[default]
    Silent,
    /// Each gives a warning, where it is written.
    Warned,
    /// Each is an error.
    Refused,
}

/// A number without a unit where the scene has one that is not of SI, so that it is hardly meant.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{given}` has no unit: a bare number is in {si}, and the scene says {scene}")]
pub struct BareNumber {
    /// What was given: name and number, or range of numbers.
    pub given: String,
    /// The unit of SI in which it would be read.
    pub si: String,
    /// What the scene says.
    pub scene: String,
    /// The unit of that.
    pub unit: String,
}

impl BareNumber {
    /// That of `given`, which has no unit, in place of the text `scene` in this `unit`; `None` where that is of SI, if bare
    /// numbers are not refused.
    pub(crate) fn of(given: &str, (scene, unit): (&str, &str), bare: BareNumbers) -> Option<Self> {
        let one = parse_quantity(&format!("1 {unit}")).ok()?;
        let dimension = one.dimension.filter(|own| *own != Dimension::NUMBER)?;
        #[expect(clippy::float_cmp, reason = "1 is the factor of SI units")]
        let is_si = one.value == 1.0 && bare != BareNumbers::Refused;
        let (given, scene, unit) = (given.to_owned(), scene.to_owned(), unit.to_owned());
        (!is_si).then(|| Self { given, si: si_unit(dimension), scene, unit })
    }

    /// The same for `value`, where that is a number without a unit, and not zero, which is the same in all.
    pub(crate) fn of_set(name: &str, value: &str, scene: (&str, &str)) -> Option<Self> {
        let quantity = parse_quantity(value).ok()?;
        let is_bare = quantity.dimension.is_none() && quantity.value != 0.0;
        let given = || format!("{name}={}", value.trim());
        is_bare.then(|| Self::of(&given(), scene, BareNumbers::Silent)).flatten()
    }

    /// What to write.
    pub fn help(&self) -> String {
        let Self { given, si, unit, .. } = self;
        let other = format!(", or with `{si}` if that is meant");
        format!("write \"{given} {unit}\"{}", if unit == si { "" } else { &other })
    }
}
