//! Scales between similar scenes, and dimensions as products of powers of others.

use std::sync::Arc;

use dashpot_network::{
    Network,
    parameters::{Dimension, InvalidParameter},
};
use dashpot_units::Exponent;

use super::walk::{Visit, walk, walk_values};
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
        let raised = |own: f64, exponent: Exponent| power(own, exponent.value());
        raised(self.mass, dimension.mass)
            * raised(self.length, dimension.length)
            * raised(self.time, dimension.time)
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

/// The measure that tells the same of a scene that is similar at this scale: its parameters times the factors of their
/// dimensions. A measure with a time of its own has another kind for its counterpart, or none.
pub(super) fn similar_measure(measure: &dyn Measure, scale: &Scale) -> Option<Arc<dyn Measure>> {
    let general = measure.general()?;
    let mut visit = *scale;
    let values = walk_values("", general.parameters(), &general.values(), &mut visit).ok()?;
    general.with_values(&values).ok()
}

/// Exponents in this part of one are told from their neighbours: no reference has larger determinants than a few.
const FINEST: f64 = 5040.0;

/// Dimensions none of which is a product of powers of the others.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Basis(Vec<Dimension>);

impl Basis {
    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// Takes a dimension in that is independent of all so far, and says whether it was.
    pub(super) fn take(&mut self, dimension: Dimension) -> bool {
        let is_new = self.exponents(dimension).is_none();
        if is_new {
            self.0.push(dimension);
        }
        is_new
    }

    /// The exponents with which its members make up a dimension; `None` where they do not.
    pub(super) fn exponents(&self, dimension: Dimension) -> Option<Vec<f64>> {
        let count = self.0.len();
        let column: Vec<[f64; 4]> = self.0.iter().copied().map(powers).collect();
        let wanted = powers(dimension);
        // One row for each base unit, one column for each member, the wanted one behind them.
        let mut rows: Vec<Vec<f64>> = (0..4)
            .map(|unit| {
                column.iter().map(|own| own[unit]).chain([wanted[unit]]).collect::<Vec<f64>>()
            })
            .collect();
        for at in 0..count {
            // The members are independent, so there is always a pivot.
            let pivot = (at..4).max_by(|&i, &j| rows[i][at].abs().total_cmp(&rows[j][at].abs()))?;
            rows.swap(at, pivot);
            let head = rows[at].clone();
            for row in rows.iter_mut().enumerate().filter(|own| own.0 != at).map(|own| own.1) {
                let factor = row[at] / head[at];
                row.iter_mut().zip(&head).for_each(|(own, head)| *own -= factor * head);
            }
        }
        let is_left = |row: &Vec<f64>| row[count].abs() > 0.5 / FINEST;
        if rows[count.min(4)..].iter().any(is_left) {
            return None;
        }
        let exponent = |at: usize| (rows[at][count] / rows[at][at] * FINEST).round() / FINEST;
        Some((0..count).map(exponent).collect())
    }

    /// The product of powers of `values`, one for each member, that has a dimension.
    pub(super) fn product(&self, values: &[f64], dimension: Dimension) -> Option<f64> {
        let exponents = self.exponents(dimension)?;
        Some(values.iter().zip(exponents).map(|(value, own)| power(*value, own)).product())
    }
}

fn powers(dimension: Dimension) -> [f64; 4] {
    [dimension.mass, dimension.length, dimension.time, dimension.temperature].map(Exponent::value)
}

/// `value` to a power, to the last digits where that is a whole number.
#[expect(clippy::cast_possible_truncation, reason = "exponents are of the order of one")]
pub(super) fn power(value: f64, exponent: f64) -> f64 {
    if exponent.fract() == 0.0 { value.powi(exponent as i32) } else { value.powf(exponent) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffness_is_mass_times_speed_squared_over_length_squared() {
        let mut basis = Basis::default();
        for own in [Dimension::MASS, Dimension::VELOCITY, Dimension::LENGTH] {
            assert!(basis.take(own));
        }
        assert!(!basis.take(Dimension::TIME), "it follows from the others");
        assert_eq!(basis.exponents(Dimension::STIFFNESS), Some(vec![1.0, 2.0, -2.0]));
        let value = basis.product(&[10.0, 10.0, 0.02], Dimension::STIFFNESS);
        assert!((value.unwrap() - 2.5e6).abs() < 1e-8);
        assert_eq!(basis.exponents(Dimension::TEMPERATURE), None);
    }

    #[test]
    fn exponents_may_be_fractions() {
        let mut basis = Basis::default();
        assert!(basis.take(Dimension::MASS) && basis.take(Dimension::STIFFNESS));
        assert_eq!(basis.exponents(Dimension::TIME), Some(vec![0.5, -0.5]));
        assert_eq!(basis.exponents(Dimension::LENGTH), None);
        assert_eq!(Basis::default().exponents(Dimension::NUMBER), Some(Vec::new()));
    }
}
