//! Dimensions in words, and how quantities of them are written.

use dashpot_network::parameters::Dimension;

use super::basis::{AREA, Basis, DENSITY};
use crate::units::si_unit;

/// A dimension by its name and unit, with an article: "a stiffness (N/m)".
pub(crate) fn described(dimension: Dimension) -> String {
    match dimension.named() {
        _ if dimension == Dimension::NUMBER => "a pure number".to_owned(),
        Some((name, unit)) => format!("{} {name} ({unit})", article(name)),
        None if dimension == Basis::MATERIAL.dimension(Dimension::COMPLIANCE) => {
            "a compliance of a material (1/Pa)".to_owned()
        }
        None if dimension == AREA => "an area (m^2)".to_owned(),
        None if dimension == DENSITY => "a density (kg/m^3)".to_owned(),
        None => format!("a quantity in {}", si_unit(dimension)),
    }
}

/// `a` or `an`, as the word wants it.
fn article(word: &str) -> &'static str {
    if word.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" }
}

/// How a quantity of a dimension is written.
pub(crate) fn example_text(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::NUMBER => "0.1 %",
        Dimension::MASS => "10 kg",
        Dimension::LENGTH => "2 cm",
        Dimension::TIME => "10 ms",
        Dimension::FREQUENCY => "50 Hz",
        Dimension::VELOCITY => "10 m/s",
        Dimension::ACCELERATION => "9.81 m/s^2",
        Dimension::FORCE => "2 kN",
        Dimension::STIFFNESS => "20 MN/m",
        Dimension::DAMPING => "6 kN s/m",
        Dimension::IMPULSE => "3 N s",
        Dimension::ENERGY => "80 kJ/mol",
        Dimension::PRESSURE => "2 MPa",
        Dimension::VISCOSITY => "5 kPa s",
        Dimension::COMPLIANCE => "0.05 mm/kN",
        Dimension::TEMPERATURE => "20 degC",
        AREA => "100 cm^2",
        DENSITY => "120 kg/m^3",
        _ if dimension == Basis::MATERIAL.dimension(Dimension::COMPLIANCE) => "0.5 1/MPa",
        _ => "1.5",
    }
}

/// The same in a sentence.
pub(crate) fn example(dimension: Dimension) -> String {
    format!("for example \"{}\"", example_text(dimension))
}
