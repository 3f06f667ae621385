//! Values as arguments, and names of kinds from their registers.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dashpot_analysis::{
    Accuracy,
    rheometer::{PROTOCOLS, ProtocolEntry},
};
use dashpot_dae::methods;
use dashpot_rheology::conversion::Target;
use dashpot_scene::{templates, units::parse_quantity};

pub(super) fn assignment(text: &str) -> Result<(String, String), String> {
    let (name, value) = text.rsplit_once('=').unwrap_or((text, ""));
    if name.trim().is_empty() || value.trim().is_empty() {
        return Err("write a name, `=` and a value, such as \"K=25 MN/m\"".to_owned());
    }
    Ok((name.trim().to_owned(), value.trim().to_owned()))
}

pub(super) fn within(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if (0.0..=1.0).contains(&number) => Ok(number),
        _ => Err("it must be a number from 0 to 1, such as 1e-12".to_owned()),
    }
}

pub(super) fn share(text: &str) -> Result<f64, String> {
    use dashpot_network::parameters::Dimension;
    let quantity = parse_quantity(text).map_err(|error| error.to_string())?;
    let is_number = quantity.dimension.is_none_or(|dimension| dimension == Dimension::NUMBER);
    let value = quantity.value;
    // A bare number of this size may be meant in percent.
    let is_doubtful = quantity.dimension.is_none()
        && !text.contains('%')
        && (0.01..=100.0 * Accuracy::LOOSEST).contains(&value);
    if is_number && value > 0.0 && value <= Accuracy::LOOSEST && !is_doubtful {
        return Ok(value);
    }
    Err(if is_doubtful {
        let percent = 100.0 * value;
        let other =
            if value > Accuracy::LOOSEST { String::new() } else { format!(" or \"{percent}%\"") };
        format!("a bare {value} is {percent}%; write \"{value}%\"{other}")
    } else {
        "\n  it must be more than 0 and at most 20%, such as 0.1% or 1e-3".to_owned()
    })
}

/// Units of work: a whole number, or one such as 1e9.
pub(super) fn budget(text: &str) -> Result<u64, String> {
    const MOST: f64 = 1e18;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the range is checked, and no one counts the last units"
    )]
    match text.parse::<f64>() {
        Ok(number) if (1.0..=MOST).contains(&number) => Ok(number as u64),
        _ => Err("it must be a number from 1 to 1e18, such as 1e10".to_owned()),
    }
}

pub(super) fn frequency(text: &str) -> Result<f64, String> {
    use dashpot_network::parameters::Dimension;
    let quantity = parse_quantity(text).map_err(|error| error.to_string())?;
    let is_frequency = quantity.dimension.is_none_or(|dimension| dimension == Dimension::FREQUENCY);
    if quantity.angle != 0 {
        let frequency = quantity.value / std::f64::consts::TAU;
        Err(format!("that is an angular frequency; write \"{frequency:.6} Hz\""))
    } else if is_frequency && quantity.value > 0.0 {
        Ok(quantity.value)
    } else {
        Err("it must be a positive frequency, such as \"20 Hz\"".to_owned())
    }
}

/// The names of methods, blanks around them allowed.
#[derive(Debug, Clone)]
pub(super) struct MethodNames(pub(super) PossibleValuesParser);

impl TypedValueParser for MethodNames {
    type Value = String;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &OsStr,
    ) -> Result<String, clap::Error> {
        let trimmed = value.to_str().map_or(value, |text| OsStr::new(text.trim()));
        self.0.parse_ref(command, argument, trimmed)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}

pub(super) fn method_names() -> PossibleValuesParser {
    let methods = methods::all();
    PossibleValuesParser::new(methods.iter().map(|method| PossibleValue::new(method.name())))
}

pub(super) fn template_names() -> PossibleValuesParser {
    let value =
        |shipped: &dashpot_scene::Shipped| PossibleValue::new(shipped.name).help(shipped.summary);
    PossibleValuesParser::new(templates().iter().map(value))
}

pub(super) fn forms() -> PossibleValuesParser {
    PossibleValuesParser::new(
        Target::all()
            .into_iter()
            .map(|form| PossibleValue::new(form.word).aliases(form.aliases).help(form.summary)),
    )
}

pub(super) fn test_names() -> PossibleValuesParser {
    let value = |protocol_entry: &ProtocolEntry| {
        PossibleValue::new(protocol_entry.word).help(protocol_entry.summary)
    };
    PossibleValuesParser::new(PROTOCOLS.iter().map(value))
}
