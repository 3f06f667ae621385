//! Dimensions in words, and how quantities of them are written.

use dashpot_network::parameters::Dimension;
use dashpot_units::{STANDARD_GRAVITY, format_short, si_unit};

use super::basis::{AREA, Basis, DENSITY};

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

/// Units in which the field thinks, where they are not those of SI, and what one of them is.
const USUAL: [(Dimension, &str, f64); 5] = [
    (Dimension::ACCELERATION, "g", STANDARD_GRAVITY),
    (Dimension::FORCE, "kN", 1e3),
    (Dimension::LENGTH, "mm", 1e-3),
    (Dimension::TIME, "ms", 1e-3),
    (Dimension::PRESSURE, "kPa", 1e3),
];

/// What to write in place of a number without a unit.
pub fn with_units(number: &str, dimension: Dimension) -> String {
    let usual = USUAL.iter().find(|own| own.0 == dimension);
    let usual = usual.map_or(String::new(), |own| format!("\"{number} {}\" or ", own.1));
    format!("{usual}\"{number} {}\"", si_unit(dimension))
}

/// A value in the unit of SI, and in that of the field where that is another one.
pub(crate) fn in_both_units(value: f64, dimension: Dimension) -> String {
    let short = |value: f64| format_short(value, Dimension::NUMBER, 4);
    let own = format!("{} {}", short(value), si_unit(dimension));
    let usual = USUAL.iter().find(|own| own.0 == dimension);
    usual.map_or(own.clone(), |(_, unit, one)| format!("{own} = {} {unit}", short(value / one)))
}

/// How a quantity of a dimension is written.
pub(crate) fn example_text(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::NUMBER => "20 %",
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
