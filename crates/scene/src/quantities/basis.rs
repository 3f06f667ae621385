//! Models in N and m, materials in Pa and parts of the thickness.
//!
//! A law between force and deformation is one between stress and strain: `F(y) = A σ(y/h)`. So every
//! quantity of a law, N^f m^d s^k, is written Pa^f s^k in a material, and a pad has A^f h^d times as
//! much: moduli become stiffnesses by A/h, stresses forces by A, strains deformations by h.

use dashpot_network::parameters::{
    Dimension, Formula, InvalidParameter, Parameter, ParameterKind, Value,
};
use dashpot_units::{Exponent, Quantity};

use crate::text::source::Place;

/// Area \[m²\].
pub(crate) const AREA: Dimension = Dimension::new(0, 2, 0);

/// Density \[kg/m³\].
pub(crate) const DENSITY: Dimension = Dimension::new(1, -3, 0);

/// A pad that is made of a material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pad {
    /// Thickness h \[m\].
    pub(crate) thickness: f64,
    /// Area A \[m²\].
    pub(crate) area: f64,
    /// How it is loaded, and where that is said; `None` for a material by itself, whose values are as written.
    pub(crate) loading: Option<(Loading, Place)>,
    /// The stress in that loading over that which is written.
    factor: f64,
}

/// How a pad is loaded, which says which modulus of its material counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Loading {
    /// Across its thickness, its sides free: Young's modulus.
    Compression,
    /// Along its faces: the shear modulus.
    Shear,
    /// Across its thickness, its sides held: the oedometric modulus.
    Confined,
}

impl Pad {
    /// A pad of a material as it is written.
    pub(crate) const fn new(thickness: f64, area: f64) -> Self {
        Self { thickness, area, loading: None, factor: 1.0 }
    }

    /// The same, loaded in this way.
    pub(crate) fn loaded(self, loading: (Loading, Place)) -> Self {
        Self { loading: Some(loading), ..self }
    }

    /// The same in a loading in which stresses are so many times those that are written.
    pub(crate) fn with_factor(self, factor: f64) -> Self {
        Self { factor, ..self }
    }

    /// Whether its stresses are not those that are written.
    pub(crate) fn is_converted(self) -> bool {
        self.factor.to_bits() != 1.0_f64.to_bits()
    }

    /// The area on which the written stresses would act \[m²\].
    fn effective_area(self) -> f64 {
        self.factor * self.area
    }

    /// All of it as bits.
    pub(crate) fn to_bits(self) -> [u64; 2] {
        [self.thickness, self.effective_area()].map(f64::to_bits)
    }
}

/// What the values of a model measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Basis {
    /// Force over deformation: forces in N, lengths in m, stiffnesses in N/m.
    Model,
    /// Stress over strain: forces in Pa, lengths in parts of the thickness, moduli in Pa; with the
    /// pad that is made of it.
    Material(Pad),
}

/// The part of a strain that is out of the question, below and above; positive in compression.
const STRAINS: [f64; 2] = [-10.0, 1.0];

impl Basis {
    /// The values of a material as they are written: those of a cube of 1 m.
    pub(crate) const MATERIAL: Self = Self::Material(Pad::new(1.0, 1.0));

    /// Whether values are those of a material.
    pub(crate) fn is_material(self) -> bool {
        matches!(self, Self::Material(_))
    }

    /// The dimension in which a quantity is written that has the dimension `in_model` in a model: with a stress for
    /// each force and a strain for each length, N^f m^d s^k is Pa^f s^k in a material.
    pub(crate) fn dimension(self, in_model: Dimension) -> Dimension {
        match self {
            Self::Model => in_model,
            Self::Material(_) => Dimension { length: -in_model.mass, ..in_model },
        }
    }

    /// A written value as that of the pad: times A^f h^d.
    fn of_pad(self, value: f64, in_model: Dimension) -> f64 {
        let Self::Material(pad) = self else { return value };
        let (thickness, area) = (pad.thickness, pad.effective_area());
        let [forces, lengths] = powers(in_model);
        let (times, over) = match (forces, lengths) {
            (0, 0) => return value,
            (1, -1) => (area, thickness),
            (-1, 1) => (thickness, area),
            _ => (area.powi(forces), thickness.powi(-lengths)),
        };
        value * (times / over)
    }

    /// The written `values` of `parameters` as those of the pad, with an error for the first one
    /// that is beyond double precision then.
    pub(crate) fn of_pad_all(
        self,
        parameters: &[Parameter],
        values: &[Value],
        driven: Dimension,
    ) -> Result<Vec<Value>, InvalidParameter> {
        let scaled = |name: &'static str, value: f64, dimension: Dimension| {
            let scaled = self.of_pad(value, dimension);
            // Zero stays zero; all else that was a normal number has to be one afterwards.
            if scaled.is_normal() || !value.is_normal() {
                return Ok(scaled);
            }
            let range = "such that it fits into double precision for a pad of this size";
            Err(InvalidParameter::new(name, range, value))
        };
        let table = |name, points: &[(f64, f64)], first, second| {
            let point = |&(at, value): &(f64, f64)| {
                Ok((scaled(name, at, first)?, scaled(name, value, second)?))
            };
            points.iter().map(point).collect::<Result<_, InvalidParameter>>().map(Value::Table)
        };
        let pairs = parameters.iter().zip(values);
        let all = pairs.map(|(parameter, value)| match (parameter.kind, value) {
            // The size of the pad is its own.
            _ if is_size(parameter) => Ok(value.clone()),
            (ParameterKind::Quantity(dimension), Value::Number(number)) => {
                scaled(parameter.name, *number, dimension).map(Value::Number)
            }
            (ParameterKind::Amplitude, Value::Number(number)) => {
                scaled(parameter.name, *number, driven).map(Value::Number)
            }
            (ParameterKind::Curve(first, second), Value::Table(points)) => {
                table(parameter.name, points, first, second)
            }
            (ParameterKind::LawFormula, Value::Formula(formula)) => {
                Ok(Value::Formula(self.of_pad_formula(parameter.kind, formula)))
            }
            (_, Value::Table(points)) => table(parameter.name, points, Dimension::TIME, driven),
            (_, other) => Ok(other.clone()),
        });
        all.collect()
    }

    /// A stress over the strain and its rate as a force over those of the pad.
    fn of_pad_formula(self, kind: ParameterKind, formula: &Formula) -> Formula {
        let Self::Material(pad) = self else { return formula.clone() };
        let (thickness, area) = (pad.thickness, pad.effective_area());
        let names: Vec<&str> = kind.variables().iter().map(|own| own.0).collect();
        let thickness = Quantity::of(thickness, Dimension::LENGTH);
        formula.scaled(Quantity::of(area, AREA), &names, thickness)
    }

    /// Refuses strains that no pad can have: they are written where `in_model` is a length.
    pub(crate) fn check(
        self,
        name: &'static str,
        in_model: Dimension,
        value: f64,
    ) -> Result<(), InvalidParameter> {
        let [least, most] = STRAINS;
        if !self.is_material() || in_model != Dimension::LENGTH || (least..=most).contains(&value) {
            return Ok(());
        }
        let range = format!("a strain from {least} to {most} (positive in compression)");
        Err(InvalidParameter::new(name, range, value))
    }
}

/// Whether a kind may stand in a material: what acts across a gap, or is a pad of its own, is no material.
pub(crate) fn fits_material(parameters: &[Parameter]) -> bool {
    use ParameterKind::{Amplitude, Model, TimeTable};
    let is_none = |own: &Parameter| matches!(own.kind, Amplitude | TimeTable | Model);
    !parameters.iter().any(|own| own.name == "gap" || is_none(own))
}

/// Whether a parameter is the thickness or area of the pad that an element is.
pub(crate) fn is_size(parameter: &Parameter) -> bool {
    parameter.follows && SIZE.contains(&parameter.name)
}

/// Whether a kind is a pad of a material, with a size of its own.
pub(crate) fn is_sized(parameters: &[Parameter]) -> bool {
    parameters.iter().any(is_size)
}

/// The keys of the size of a pad.
pub(crate) const SIZE: [&str; 2] = ["thickness", "area"];

/// The powers f of the force and d of the deformation in a dimension N^f m^d s^k. A pressure is a
/// stress in a model, too, and has nothing of a pad.
pub(crate) fn powers(dimension: Dimension) -> [i32; 2] {
    // Those of parameters are whole numbers.
    let [mass, length] = [dimension.mass, dimension.length].map(Exponent::truncated);
    if mass == -length { [0, 0] } else { [mass, length - mass] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stiffness_turns_into_modulus_and_time_stays() {
        let written = |dimension| Basis::MATERIAL.dimension(dimension);
        assert_eq!(written(Dimension::STIFFNESS), Dimension::new(1, -1, -2));
        assert_eq!(written(Dimension::DAMPING), Dimension::new(1, -1, -1));
        assert_eq!(written(Dimension::new(-1, 0, 2)), Dimension::new(-1, 1, 2));
        assert_eq!(written(Dimension::FORCE), Dimension::PRESSURE);
        assert_eq!(written(Dimension::new(1, -2, -2)), Dimension::PRESSURE);
        assert_eq!(written(Dimension::LENGTH), Dimension::NUMBER);
        assert_eq!(written(Dimension::VELOCITY), Dimension::FREQUENCY);
        for same in [Dimension::TIME, Dimension::NUMBER, Dimension::PRESSURE] {
            assert_eq!(written(same), same);
        }
        assert_eq!(Basis::Model.dimension(Dimension::STIFFNESS), Dimension::STIFFNESS);
    }

    #[test]
    fn a_pad_has_stress_times_area_at_strain_times_thickness() {
        let pad = Basis::Material(Pad::new(0.5, 0.25));
        let number = |dimension| Parameter::new("a", ParameterKind::Quantity(dimension), "");
        let parameters = [
            number(Dimension::STIFFNESS),
            number(Dimension::new(-1, 0, 2)),
            number(Dimension::TIME),
            // A force by A, lengths by h, a cube by A/h³, a pressure by nothing.
            number(Dimension::FORCE),
            number(Dimension::VELOCITY),
            number(Dimension::new(1, -2, -2)),
            number(Dimension::PRESSURE),
        ];
        let values = [8.0; 7].map(Value::Number);
        let of_pad = pad.of_pad_all(&parameters, &values, Dimension::FORCE).unwrap();
        assert_eq!(of_pad, [4.0, 16.0, 8.0, 2.0, 4.0, 16.0, 8.0].map(Value::Number));
        let tiny = [3e-308, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0].map(Value::Number);
        let error = pad.of_pad_all(&parameters, &tiny, Dimension::FORCE).unwrap_err();
        assert!(error.to_string().contains("double precision for a pad of this size, but it is"));
    }
}
