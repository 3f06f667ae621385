//! What is asked of the tests.

use dashpot_analysis::rheometer::PROTOCOLS;
use dashpot_network::parameters::{Dimension, Parameter, ParameterKind, registered};

use super::Units;
use crate::{args::RheometerArguments, error::CliError, input::setting};

/// The words of the tests that are asked for, all of them by default.
pub(super) fn tests(arguments: &RheometerArguments) -> Vec<String> {
    if arguments.test.is_empty() {
        PROTOCOLS.iter().map(|own| own.word.to_owned()).collect()
    } else {
        arguments.test.clone()
    }
}

/// What is to be given for a parameter.
fn dimension(parameter: &Parameter) -> Dimension {
    match parameter.kind {
        ParameterKind::Quantity(dimension) => dimension,
        _ => Dimension::NUMBER,
    }
}

/// What a test is.
pub(super) fn summary(test: &str) -> &'static str {
    registered(PROTOCOLS, test).map_or("", |own| own.summary)
}

/// Whether a test has a parameter.
pub(super) fn has_parameter(test: &str, name: &str) -> bool {
    registered(PROTOCOLS, test)
        .is_some_and(|own| own.parameters.iter().any(|parameter| parameter.name == name))
}

/// The parameters of `--with` in SI units; each must belong to one of the tests.
pub(super) fn given<'a>(
    arguments: &'a RheometerArguments,
    units: Units,
) -> Result<Vec<(&'a str, f64)>, CliError> {
    let tests = tests(arguments);
    let asked: Vec<&Parameter> = PROTOCOLS
        .iter()
        .filter(|own| tests.iter().any(|test| test == own.word))
        .flat_map(|own| own.parameters)
        .collect();
    let read = |(name, text): &'a (String, String)| {
        let Some(parameter) = asked.iter().find(|own| own.name == name) else {
            let mut known: Vec<&'static str> = asked.iter().map(|own| own.name).collect();
            known.sort_unstable();
            known.dedup();
            return Err(CliError::UnknownSetting { name: name.clone(), known });
        };
        let expected = dimension(parameter);
        let expected = if units.is_material { per_material(expected) } else { expected };
        Ok((name.as_str(), setting(name, text, expected)?))
    };
    arguments.with.iter().map(read).collect()
}

/// What a force, deformation or velocity becomes per area and thickness.
fn per_material(dimension: Dimension) -> Dimension {
    match dimension {
        Dimension::FORCE => Dimension::PRESSURE,
        Dimension::LENGTH => Dimension::NUMBER,
        Dimension::VELOCITY => Dimension::FREQUENCY,
        other => other,
    }
}
