//! What is asked of the tests.

use dashpot_analysis::rheometer::{ProtocolKind, ProtocolVisitor, visit_protocols};
use dashpot_network::parameters::{Dimension, ParameterKind};

use super::Units;
use crate::{args::RheometerArguments, error::CliError, input::setting};

/// The words of the tests that are asked for, all of them by default.
pub(super) fn tests(arguments: &RheometerArguments) -> Vec<String> {
    if arguments.test.is_empty() {
        protocols().into_iter().map(|own| own.word.to_owned()).collect()
    } else {
        arguments.test.clone()
    }
}

/// A test: its word, what it is, and its parameters with their dimensions.
struct Protocol {
    word: &'static str,
    summary: &'static str,
    parameters: Vec<(&'static str, Dimension)>,
}

fn protocols() -> Vec<Protocol> {
    struct Collect(Vec<Protocol>);
    impl ProtocolVisitor for Collect {
        fn visit<P: ProtocolKind>(&mut self) {
            let parameters = P::PARAMETERS.iter().map(|own| match own.kind {
                ParameterKind::Quantity(dimension) => (own.name, dimension),
                _ => (own.name, Dimension::NUMBER),
            });
            let parameters = parameters.collect();
            self.0.push(Protocol { word: P::KIND, summary: P::SUMMARY, parameters });
        }
    }
    let mut collect = Collect(Vec::new());
    visit_protocols(&mut collect);
    collect.0
}

/// What a test is.
pub(super) fn summary(test: &str) -> &'static str {
    protocols().iter().find(|own| own.word == test).map_or("", |own| own.summary)
}

/// Whether a test has a parameter.
pub(super) fn has_parameter(test: &str, name: &str) -> bool {
    protocols().iter().any(|own| own.word == test && own.parameters.iter().any(|own| own.0 == name))
}

/// The parameters of `--with` in SI units; each must belong to one of the tests.
pub(super) fn given<'a>(
    arguments: &'a RheometerArguments,
    units: Units,
) -> Result<Vec<(&'a str, f64)>, CliError> {
    let tests = tests(arguments);
    let asked: Vec<(&'static str, Dimension)> = protocols()
        .into_iter()
        .filter(|own| tests.iter().any(|test| test == own.word))
        .flat_map(|own| own.parameters)
        .collect();
    let read = |(name, text): &'a (String, String)| {
        let Some((_, dimension)) = asked.iter().find(|own| own.0 == *name) else {
            let mut known: Vec<&'static str> = asked.iter().map(|own| own.0).collect();
            known.sort_unstable();
            known.dedup();
            return Err(CliError::UnknownSetting { name: name.clone(), known });
        };
        let expected = if units.is_material { per_material(*dimension) } else { *dimension };
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
