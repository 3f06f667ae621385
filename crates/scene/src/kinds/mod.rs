//! What readers ask of the registers, and how their kinds are written.

mod entries;
mod file_units;
mod files;
pub(crate) mod parameters;
mod points;
pub(crate) mod records;
mod value;

use dashpot_network::{
    composites::COMPOSITES,
    elements::ELEMENTS,
    parameters::{Dimension, Parameter, ParameterKind, Range},
};
use dashpot_rheology::{FORMS, Form, Part, Role};

use crate::quantities::{basis::Basis, words::example_text};

/// Whether the parameters of a kind are a table of amplitudes over time.
pub(crate) fn is_table(parameters: &[Parameter]) -> bool {
    matches!(parameters, [first, ..] if first.kind == ParameterKind::TimeTable)
}

/// Whether a parameter is a list of points, which a file may hold.
pub(crate) fn is_points(parameter: &Parameter) -> bool {
    parameter.kind.is_points()
}

/// Whether the name of a file alone may stand for the values of these parameters.
pub(crate) fn are_file(parameters: &[Parameter]) -> bool {
    let mut required = parameters.iter().filter(|own| own.default.is_none());
    parameters.iter().any(is_points) && required.all(is_points)
}

/// Whether the parameters of a kind hold a model.
pub(crate) fn has_model(parameters: &[Parameter]) -> bool {
    parameters.iter().any(is_model)
}

/// Whether a parameter is a model.
pub(crate) fn is_model(parameter: &Parameter) -> bool {
    parameter.kind == ParameterKind::Model
}

/// The form of this word or alias.
pub(crate) fn form(word: &str) -> Option<&'static Form> {
    FORMS.iter().find(|form| form.word == word || form.aliases.contains(&word))
}

/// The words with which a model begins.
pub(crate) fn model_words() -> Vec<&'static str> {
    let composed = ["series", "parallel", "model", "material"];
    let elements = ELEMENTS.iter().map(|kind| kind.word);
    let forms = FORMS.iter().flat_map(|form| [&[form.word], form.aliases].concat());
    let composites = COMPOSITES.iter().map(|kind| kind.word);
    elements.chain(composed).chain(forms).chain(composites).collect()
}

/// How values are written in an example.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Example {
    /// Whether they belong to a model or to a material.
    pub(crate) basis: Basis,
    /// Dimension of amplitudes in a model; `None` where it is not known.
    pub(crate) driven: Option<Dimension>,
}

impl Example {
    /// For kinds that have no amplitudes, or amplitudes of anything.
    pub(crate) const PLAIN: Self = Self { basis: Basis::Model, driven: None };

    /// How a kind with these parameters is written after its word and `=`.
    pub(crate) fn value(self, parameters: &[Parameter]) -> String {
        let required = parameters.iter().filter(|parameter| parameter.default.is_none());
        let required = required.collect::<Vec<_>>();
        match required.as_slice() {
            [] => "{}".to_owned(),
            [only] => self.parameter(only),
            several => {
                let pair = |parameter: &&Parameter| {
                    format!("{} = {}", parameter.name, self.parameter(parameter))
                };
                format!("{{ {} }}", several.iter().map(pair).collect::<Vec<_>>().join(", "))
            }
        }
    }

    /// How one parameter is written.
    pub(crate) fn parameter(self, parameter: &Parameter) -> String {
        match parameter.kind {
            ParameterKind::Quantity(Dimension::NUMBER) => match parameter.range {
                Range::AtLeastOne => "1.5".to_owned(),
                Range::Count => "200".to_owned(),
                _ => "0.5".to_owned(),
            },
            ParameterKind::Quantity(dimension) => self.quantity(dimension),
            ParameterKind::TemperatureDifference => "\"50 K\"".to_owned(),
            ParameterKind::Amplitude => self.amplitude(),
            ParameterKind::TimeTable => {
                let value = self.amplitude();
                format!("[[\"1 ms\", {value}], [\"5 ms\", {value}]]")
            }
            ParameterKind::Curve(first, second) => {
                let point = format!("[{}, {}]", self.quantity(first), self.quantity(second));
                format!("[{point}, …]")
            }
            ParameterKind::LawFormula if self.basis.is_material() => {
                "\"200 kPa * tanh(y / 20 %)\"".to_owned()
            }
            ParameterKind::LawFormula => "\"2 kN * tanh(y / 5 mm)\"".to_owned(),
            ParameterKind::TimeFormula => {
                let amplitude = self.amplitude();
                format!("\"{} * (t / 1 ms)^2\"", amplitude.trim_matches('"'))
            }
            ParameterKind::Choice(words) => format!("\"{}\"", words.first().unwrap_or(&"")),
            ParameterKind::Flag => "true".to_owned(),
            ParameterKind::Window => "\"impact\"".to_owned(),
            ParameterKind::Node => "\"head\"".to_owned(),
            ParameterKind::Model => "{ spring = \"4 kN/m\" }".to_owned(),
        }
    }

    fn amplitude(self) -> String {
        self.driven.map_or_else(|| "\"…\"".to_owned(), |driven| self.quantity(driven))
    }

    fn quantity(self, dimension: Dimension) -> String {
        format!("\"{}\"", example_text(self.basis.dimension(dimension)))
    }

    /// How the parts of a form are written: `{ spring = "20 MN/m", dashpot = "6 kN s/m" }`.
    pub(crate) fn parts(self, parts: &[Part]) -> String {
        let value = |part: &Part| match part.role {
            Role::Spring => self.quantity(Dimension::STIFFNESS),
            Role::Dashpot => self.quantity(Dimension::DAMPING),
            Role::Form { parts, .. } => self.parts(parts),
        };
        let pairs = parts.iter().map(|part| format!("{} = {}", part.name, value(part)));
        format!("{{ {} }}", pairs.collect::<Vec<_>>().join(", "))
    }
}
