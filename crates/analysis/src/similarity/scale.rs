//! Scales between similar scenes.

use std::sync::Arc;

use dashpot_network::{
    Network,
    parameters::{Dimension, InvalidParameter},
};

use super::{
    basis::{Basis, power},
    walk::{Visit, walk, walk_values},
};
use crate::measures::Measure;

/// By how much the base units of one scene are larger in another that is similar to it.
///
/// Temperatures are not scaled: a law's change with temperature is one of the material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Factor of masses, > 0.
    pub mass: f64,
    /// Factor of lengths, > 0.
    pub length: f64,
    /// Factor of times, > 0.
    pub time: f64,
}

impl Scale {
    /// That between a scene and itself.
    pub const ONE: Self = Self { mass: 1.0, length: 1.0, time: 1.0 };

    /// The factor of quantities of a dimension.
    pub fn of(&self, dimension: Dimension) -> f64 {
        let power = |own: f64, exponent: i8| own.powi(i32::from(exponent));
        power(self.mass, dimension.mass)
            * power(self.length, dimension.length)
            * power(self.time, dimension.time)
    }

    /// The factor of a measure's values; that of the severity index and its like, which are in parts
    /// of standard gravity to a power, included.
    pub fn of_measure(&self, measure: &dyn Measure) -> f64 {
        let unit = measure.unit();
        let of_unit = Dimension::all_named()
            .find(|own| own.named().is_some_and(|named| named.1 == unit))
            .map_or(1.0, |own| self.of(own));
        of_unit * power(self.of(Dimension::ACCELERATION), measure.gravities())
    }

    /// The way back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { mass: self.mass.recip(), length: self.length.recip(), time: self.time.recip() }
    }

    /// The scale with these factors of quantities of independent dimensions; what they leave open
    /// stays as it is: the mass first, then length and time.
    pub(super) fn from_factors(factors: &[(Dimension, f64)]) -> Self {
        let mut basis = Basis::default();
        let mut values = Vec::new();
        let open = [Dimension::MASS, Dimension::LENGTH, Dimension::TIME, Dimension::TEMPERATURE];
        let all = factors.iter().copied().chain(open.map(|open| (open, 1.0)));
        for (dimension, factor) in all {
            if basis.take(dimension) {
                values.push(factor);
            }
        }
        let of = |own| basis.product(&values, own).unwrap_or(1.0);
        let [mass, length, time] = [Dimension::MASS, Dimension::LENGTH, Dimension::TIME].map(of);
        Self { mass, length, time }
    }
}

impl Visit for Scale {
    fn quantity(&mut self, _name: &str, dimension: Dimension, value: f64) -> f64 {
        value * self.of(dimension)
    }

    fn size(&mut self, dimension: Dimension, value: f64) -> f64 {
        value * self.of(dimension)
    }
}

/// The similar network: every parameter times the factor of its dimension.
///
/// # Errors
///
/// A value that leaves its range, which is that of double precision.
pub fn scaled(network: &Network, scale: &Scale) -> Result<Network, InvalidParameter> {
    let mut visit = *scale;
    walk(network, &mut visit)
}

/// The measure that tells the same of a scene that is similar at this scale: its parameters times the
/// factors of their dimensions. A measure with a time of its own has another kind for its counterpart, or
/// none.
pub(super) fn similar_measure(measure: &dyn Measure, scale: &Scale) -> Option<Arc<dyn Measure>> {
    let general = measure.general()?;
    let mut visit = *scale;
    let values = walk_values("", general.parameters(), &general.values(), &mut visit).ok()?;
    general.with_values(&values).ok()
}
