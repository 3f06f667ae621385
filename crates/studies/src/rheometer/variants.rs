//! The tests that are asked for, with the values of their parameters.

use dashpot_analysis::rheometer::PROTOCOLS;
use dashpot_network::parameters::{Dimension, Parameter, ParameterKind, registered};

use super::{RheometerRequest, Units};
use crate::{Assignment, StudyError, list};

/// Combinations of values of one test; more are no table.
pub(super) const MOST_VARIANTS: usize = 24;

/// Points of a loop that is compared with a measured one: straight lines between them are good to some 1e-7.
const POINTS_BESIDE: f64 = 4000.0;

/// The words of the tests that are asked for, all of them by default.
pub(super) fn tests(request: &RheometerRequest) -> Vec<String> {
    if request.test.is_empty() {
        PROTOCOLS.iter().map(|own| own.word.to_owned()).collect()
    } else {
        list(request.test.iter().map(|test| test.0.clone()))
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
    request: &'a RheometerRequest,
    units: Units,
) -> Result<Vec<Given<'a>>, StudyError> {
    let tests = tests(request);
    let asked: Vec<&Parameter> = PROTOCOLS
        .iter()
        .filter(|own| tests.iter().any(|test| test == own.word))
        .flat_map(|own| own.parameters)
        .collect();
    let read = |one: &'a Assignment| {
        let name = &one.name;
        let Some(parameter) = asked.iter().find(|own| own.name == name) else {
            let mut known: Vec<&'static str> = asked.iter().map(|own| own.name).collect();
            known.sort_unstable();
            known.dedup();
            let has = |test: &&str| has_parameter(test, name);
            let of_tests = PROTOCOLS.iter().map(|own| own.word).filter(has).collect();
            return Err(StudyError::UnknownSetting { name: name.clone(), known, of_tests });
        };
        let expected = dimension(parameter);
        let expected = if units.is_material { per_material(expected) } else { expected };
        let values = one.values.iter();
        let values = values.map(|value| Ok((value.text(), value.read(name, expected)?)));
        Ok(Given { name, values: values.collect::<Result<_, StudyError>>()? })
    };
    request.with.iter().map(read).collect()
}

/// The values of a parameter, as they are written and in SI units.
pub(super) struct Given<'a> {
    name: &'a str,
    values: Vec<(String, f64)>,
}

/// A test with one value for each parameter.
#[derive(Clone, Default)]
pub(super) struct Variant<'a> {
    pub(super) given: Vec<(&'a str, f64)>,
    /// What tells it from others of the same test; empty where it is the only one.
    pub(super) label: String,
}

impl Variant<'_> {
    /// The same beside a measured loop, which is `depth` deep where it is not said otherwise; with points enough to
    /// be compared with.
    pub(super) fn beside(mut self, depth: Option<f64>) -> Self {
        let is_given = |name: &str| self.given.iter().any(|own| own.0 == name);
        let depth = depth.filter(|_| !is_given("deformation") && !is_given("force"));
        let points = (!is_given("points")).then_some(("points", POINTS_BESIDE));
        self.given.extend(depth.map(|depth| ("deformation", depth)).into_iter().chain(points));
        self
    }
}

/// A test with every combination of the values of its parameters.
pub(super) fn variants<'a>(
    test: &str,
    given: &[Given<'a>],
) -> Result<Vec<Variant<'a>>, StudyError> {
    let mut all = vec![Variant::default()];
    for own in given.iter().filter(|own| has_parameter(test, own.name)) {
        if all.len().saturating_mul(own.values.len()) > MOST_VARIANTS {
            return Err(StudyError::TooMany { of: "variants of a test", most: MOST_VARIANTS });
        }
        let with = |before: &Variant<'a>, (text, value): &(String, f64)| {
            let mut next = before.clone();
            next.given.push((own.name, *value));
            if own.values.len() > 1 {
                let comma = if next.label.is_empty() { "" } else { ", " };
                next.label = format!("{}{comma}{} {text}", next.label, own.name);
            }
            next
        };
        all = all
            .iter()
            .flat_map(|one| own.values.iter().map(|value| with(one, value)).collect::<Vec<_>>())
            .collect();
    }
    Ok(all)
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
