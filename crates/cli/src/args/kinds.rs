//! Names of kinds as arguments, from their registers.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dashpot_analysis::rheometer::{PROTOCOLS, ProtocolEntry};
use dashpot_dae::methods;
use dashpot_rheology::conversion::Target;
use dashpot_scene::templates;

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
