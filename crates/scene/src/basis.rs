//! Models in N/m and N s/m, materials in Pa and Pa s.

use dashpot_network::parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value};

/// Area \[m²\].
pub(crate) const AREA: Dimension = Dimension::new(0, 2, 0);

/// Density \[kg/m³\].
pub(crate) const DENSITY: Dimension = Dimension::new(1, -3, 0);

/// What the values of a model measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Basis {
    /// Force over deformation: stiffnesses in N/m.
    Model,
    /// Stress over strain: moduli in Pa.
    Material {
        /// Area over thickness \[m\] of the pad that is made of it; 1 for the material itself.
        area_over_thickness: f64,
    },
}

impl Basis {
    /// The values of a material as they are written.
    pub(crate) const MATERIAL: Self = Self::Material { area_over_thickness: 1.0 };

    /// Whether values are those of a material.
    pub(crate) fn is_material(self) -> bool {
        matches!(self, Self::Material { .. })
    }

    /// The dimension in which a quantity is written that has the dimension `in_model` in a model:
    /// (N/m)^e s^k is Pa^e s^k in a material.
    pub(crate) fn dimension(self, in_model: Dimension) -> Dimension {
        match self {
            Self::Model => in_model,
            Self::Material { .. } => {
                Dimension { length: in_model.length - stiffness_power(in_model), ..in_model }
            }
        }
    }

    /// A written value as that of the pad: times (A/h)^e.
    fn of_pad(self, value: f64, in_model: Dimension) -> f64 {
        let Self::Material { area_over_thickness } = self else { return value };
        match stiffness_power(in_model) {
            0 => value,
            1 => value * area_over_thickness,
            -1 => value / area_over_thickness,
            power => value * area_over_thickness.powi(i32::from(power)),
        }
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
        let pairs = parameters.iter().zip(values);
        let all = pairs.map(|(parameter, value)| match (parameter.kind, value) {
            (ParameterKind::Quantity(dimension), Value::Number(number)) => {
                scaled(parameter.name, *number, dimension).map(Value::Number)
            }
            (ParameterKind::Amplitude, Value::Number(number)) => {
                scaled(parameter.name, *number, driven).map(Value::Number)
            }
            (_, Value::Table(points)) => {
                let point = |&(at, value): &(f64, f64)| {
                    scaled(parameter.name, value, driven).map(|value| (at, value))
                };
                points.iter().map(point).collect::<Result<_, _>>().map(Value::Table)
            }
            (_, other) => Ok(other.clone()),
        });
        all.collect()
    }
}

/// Whether all values of a kind become those of a pad by its area over its thickness: a force or a
/// length of an element does not.
pub(crate) fn fits_material(parameters: &[Parameter]) -> bool {
    let fits = |dimension: Dimension| {
        stiffness_power(dimension) != 0 || (dimension.mass == 0 && dimension.length == 0)
    };
    parameters.iter().all(|own| match own.kind {
        ParameterKind::Quantity(dimension) => fits(dimension),
        ParameterKind::Curve(first, second) => fits(first) && fits(second),
        ParameterKind::Amplitude | ParameterKind::TimeTable => false,
        _ => true,
    })
}

/// The power e of the stiffness in a dimension (N/m)^e s^k; 0 for all other dimensions.
fn stiffness_power(dimension: Dimension) -> i8 {
    if dimension.length == 0 { dimension.mass } else { 0 }
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
        for same in [Dimension::TIME, Dimension::FREQUENCY, Dimension::NUMBER, Dimension::ENERGY] {
            assert_eq!(written(same), same);
        }
        assert_eq!(Basis::Model.dimension(Dimension::STIFFNESS), Dimension::STIFFNESS);
    }

    #[test]
    fn a_pad_has_its_stiffness_in_proportion_to_area_over_thickness() {
        let pad = Basis::Material { area_over_thickness: 0.5 };
        let number = |dimension| Parameter::required("a", ParameterKind::Quantity(dimension), "");
        let parameters = [
            number(Dimension::STIFFNESS),
            number(Dimension::new(-1, 0, 2)),
            number(Dimension::TIME),
        ];
        let values = [8.0, 8.0, 8.0].map(Value::Number);
        let of_pad = pad.of_pad_all(&parameters, &values, Dimension::FORCE).unwrap();
        assert_eq!(of_pad, [4.0, 16.0, 8.0].map(Value::Number));
        let tiny = [3e-308, 1.0, 1.0].map(Value::Number);
        let error = pad.of_pad_all(&parameters, &tiny, Dimension::FORCE).unwrap_err();
        assert!(error.to_string().contains("double precision for a pad of this size, but it is"));
    }
}
