//! Models in N and m, materials in Pa and parts of the thickness.
//!
//! A law between force and deformation is one between stress and strain: `F(y) = A σ(y/h)`. So every
//! quantity of a law, N^f m^d s^k, is written Pa^f s^k in a material, and a pad has A^f h^d times as
//! much: moduli become stiffnesses by A/h, stresses forces by A, strains deformations by h.

use dashpot_network::parameters::{
    Dimension, Formula, InvalidParameter, Parameter, ParameterKind, Value,
};

use crate::{
    diagnostics::{Faults, fault::Fault},
    text::source::Place,
    units::{Exponent, Quantity, format_short},
};

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

/// Two sizes that differ by less, in parts of themselves, are one that is written in two units.
const SAME: f64 = 1e-9;

/// A thickness \[m\] or area \[m²\], and where it is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Size {
    pub(crate) value: f64,
    pub(crate) place: Place,
}

/// What the tables around a law say about the size of its pad.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct EnclosingPad {
    /// What stands beside the law, by the order of [`SIZE`].
    pub(crate) beside: [Option<Size>; 2],
    /// Whether what stands there is faulty, which has been told.
    pub(crate) is_faulty: [bool; 2],
    /// The thickness of the element of which the law is a part.
    pub(crate) around: Option<Size>,
    /// Its area \[m²\].
    pub(crate) around_area: Option<f64>,
    /// Whether it is one of several parts in a row, which are thinner than the whole.
    pub(crate) in_row: bool,
}

impl EnclosingPad {
    /// What stands beside the law under one of the keys [`SIZE`].
    pub(crate) fn beside(&self, key: &str) -> Option<Size> {
        SIZE.iter().position(|known| *known == key).and_then(|at| self.beside[at])
    }

    /// The size of the element around the law, which stands at `place`, under one of the keys [`SIZE`], where the law lies
    /// between the same ends.
    pub(crate) fn around(&self, key: &str, place: Place) -> Option<Size> {
        let area = self.around_area.map(|value| Size { value, place });
        if key == SIZE[0] { self.around } else { area }.filter(|_| !self.in_row)
    }

    /// What is wrong where `owner` has no size of its own under this key.
    pub(crate) fn missing(&self, key: &'static str, owner: &str) -> Option<Fault> {
        let at = SIZE.iter().position(|known| *known == key);
        if at.is_some_and(|at| self.is_faulty[at]) {
            return None;
        }
        let example = if key == SIZE[0] { "2 cm" } else { "100 cm^2" };
        let what = if self.in_row {
            "each part of a `series` has a thickness and an area of its own, beside its law"
        } else if self.around.is_some() && key == SIZE[1] {
            "each of several parts side by side has an area of its own, in the table of its law"
        } else {
            "a material becomes a pad by its thickness and area"
        };
        let help = format!("{what}, for example `{key} = \"{example}\"`");
        let (key, owner) = (key.to_owned(), owner.to_owned());
        Some(Fault::MissingKey { key, owner, example: String::new() }.with_help(help))
    }

    /// Notes where the size `own` of a part contradicts what stands around it.
    pub(crate) fn check(&self, key: &'static str, size: Size, faults: &Faults) {
        if size.value <= 0.0 {
            return;
        }
        if let Some(other) = self.beside(key)
            && (size.value - other.value).abs() > SAME * other.value
        {
            note(key, [size, other], "both are that of one pad: give it once", faults);
        }
        let Some(whole) = self.around.filter(|_| key == SIZE[0]) else { return };
        let excess = size.value - whole.value;
        if self.in_row && excess > SAME * whole.value {
            note(key, [size, whole], "a part in series is no thicker than the whole", faults);
        } else if !self.in_row && excess.abs() > SAME * whole.value {
            let help = "what lies between the same ends has one thickness: correct one, or leave \
                        that of the element out";
            note(key, [size, whole], help, faults);
        }
    }
}

/// The size of what a model stands for, where it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Extent {
    /// Thickness h \[m\].
    pub(crate) thickness: Option<f64>,
    /// Area A \[m²\].
    pub(crate) area: Option<f64>,
    /// Thickness of those parts that have one \[m\]: no pad is thinner.
    pub(crate) least: f64,
}

impl Extent {
    /// That of what no size is known of.
    pub(crate) const UNKNOWN: Self = Self { thickness: None, area: None, least: 0.0 };

    pub(crate) fn of(Pad { thickness, area, .. }: Pad) -> Self {
        Self { thickness: Some(thickness), area: Some(area), least: thickness }
    }

    /// That of parts in a row: as thick as all together where each of them has a thickness, and with
    /// the area that each of them has.
    pub(crate) fn in_row(parts: impl ExactSizeIterator<Item = Self> + Clone) -> Self {
        let least = parts.clone().map(|part| part.least).sum();
        let thickness = parts.clone().map(|part| part.thickness).sum();
        Self { thickness, area: same(parts.map(|part| part.area)), least }
    }

    /// That of parts side by side: the thickness of those that have one. On what area the force of
    /// all of them acts, they do not say.
    pub(crate) fn beside(parts: impl ExactSizeIterator<Item = Self> + Clone) -> Self {
        let area = if parts.len() == 1 { parts.clone().find_map(|part| part.area) } else { None };
        let thickness = same(parts.clone().filter_map(|part| part.thickness).map(Some));
        let least = parts.map(|part| part.least).fold(0.0, f64::max);
        Self { thickness, area, least }
    }

    /// Warns where the size that is given for the whole is not that of the parts in it.
    pub(crate) fn check(&self, owner: &str, [thickness, area]: [Option<Size>; 2], faults: &Faults) {
        let differs = |size: Size, own: f64| (size.value - own).abs() > SAME * own;
        let tell = |size: Size, key: &str, dimension, own: f64, why: &str| {
            let [given, own] = [size.value, own].map(|size| format_short(size, dimension, 6));
            let message = format!("`{key}` of {owner} is {given}, but {why} {own}");
            let help = format!("leave `{key}` of {owner} out, or correct one of them");
            faults.warning(size.place, Fault::odd(message, help));
        };
        if let Some(size) = thickness {
            let parts = self.thickness.filter(|thickness| differs(size, *thickness));
            let least = Some(self.least).filter(|own| size.value < (1.0 - SAME) * own);
            if let Some(own) = parts.or(least) {
                let why = "its parts together have";
                tell(size, SIZE[0], Dimension::LENGTH, own, why);
            }
        }
        if let Some((size, own)) = area.zip(self.area).filter(|(size, own)| differs(*size, *own)) {
            tell(size, SIZE[1], AREA, own, "each of its parts has");
        }
    }
}

/// The size of all, where it is one.
fn same(mut all: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let first = all.next()??;
    all.all(|own| own.is_some_and(|own| (own - first).abs() <= SAME * first)).then_some(first)
}

fn note(key: &'static str, [own, other]: [Size; 2], help: &str, faults: &Faults) {
    let dimension = if key == SIZE[0] { Dimension::LENGTH } else { AREA };
    let [found, expected] = [own, other].map(|size| format_short(size.value, dimension, 6));
    let place = faults.whereabouts(other.place);
    let fault = Fault::SizesDiffer { key, found, expected, place };
    faults.error(own.place, fault.with_help(help));
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
