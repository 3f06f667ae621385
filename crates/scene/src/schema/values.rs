//! Schemas of quantities and parameters, and what all schemas are made of.

use dashpot_network::parameters::{Dimension, Parameter, ParameterKind};
use serde_json::{Map, Value, json};

use crate::{
    kinds::{
        are_file, is_points, is_table,
        records::{CHANNEL, RECORD_KEYS},
    },
    quantities::{
        basis::{Basis, is_size},
        words::{described, example_text},
    },
};

/// What the values of a kind measure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Values {
    /// Dimension of amplitudes in a model.
    pub(super) driven: Dimension,
    /// Whether they belong to a model or to a material.
    pub(super) basis: Basis,
}

impl Values {
    /// Values of a model, or of what is none.
    pub(super) fn driving(driven: Dimension) -> Self {
        Self { driven, basis: Basis::Model }
    }

    /// What follows the word of a kind.
    pub(super) fn of_kind(self, all: &[Parameter]) -> Value {
        let required =
            all.iter().filter(|parameter| parameter.default.is_none()).collect::<Vec<_>>();
        let names = required.iter().map(|parameter| parameter.name).collect::<Vec<_>>();
        let table = json!({
            "type": "object",
            "properties": self.parameters(all),
            "required": names,
            "additionalProperties": false,
        });
        let mut forms = match required.as_slice() {
            [only] if all.len() == 1 => vec![self.parameter(only)],
            [only] => vec![self.parameter(only), table],
            _ => vec![table],
        };
        if required.len() > 1 && are_file(all) {
            forms.push(reference("file"));
        }
        if all.len() > 1 && all.iter().any(is_points) {
            forms.push(self.beside_file(all));
        }
        if forms.len() == 1 { forms.remove(0) } else { json!({ "anyOf": forms }) }
    }

    /// A table that names a file in place of all points.
    fn beside_file(self, all: &[Parameter]) -> Value {
        let others: Vec<Parameter> = all.iter().filter(|own| !is_points(own)).copied().collect();
        let mut table = of_file();
        if let Some(properties) = table["properties"].as_object_mut() {
            properties.extend(self.parameters(&others));
            if is_table(all) {
                properties.extend(self.of_record());
            }
        }
        let required = others.iter().filter(|own| own.default.is_none()).map(|own| own.name);
        table["required"] = ["file"].into_iter().chain(required).collect();
        table
    }

    /// A list of points over time, or a record in a file.
    fn points_of_record(self, time: &Value, value: &Value) -> Value {
        let list = json!({ "type": "array", "items": pair(time, value) });
        let mut table = of_file();
        if let Some(properties) = table["properties"].as_object_mut() {
            properties.extend(self.of_record());
        }
        json!({ "anyOf": [list, reference("file"), table] })
    }

    /// What becomes of a record before it is a function of time.
    fn of_record(self) -> Map<String, Value> {
        let offset = json!({ "anyOf": [{ "const": "auto" }, named_quantity(self.driven)] });
        let cfc = json!({ "type": "number", "exclusiveMinimum": 0 });
        let all = [
            described_as(reference("time"), "how much later it is than in the file"),
            described_as(
                offset,
                "what is taken off; `auto`: what it reads at rest before the pulse",
            ),
            described_as(cfc, "filters by a channel frequency class of SAE J211"),
            described_as(
                json!({ "type": "string" }),
                "the channel of a test in ISO-MME, by its code or name; needed where several measure what is driven",
            ),
        ];
        RECORD_KEYS.into_iter().chain([CHANNEL]).map(str::to_owned).zip(all).collect()
    }

    /// The parameters by their names.
    pub(super) fn parameters(self, all: &[Parameter]) -> Map<String, Value> {
        let known = all.iter().filter(|own| !(self.basis.is_material() && is_size(own)));
        known.map(|known| (known.name.to_owned(), self.parameter(known))).collect()
    }

    fn parameter(self, parameter: &Parameter) -> Value {
        let time = reference("time");
        let of = |dimension| named_quantity(self.basis.dimension(dimension));
        let mut schema = match parameter.kind {
            ParameterKind::Quantity(dimension) => of(dimension),
            ParameterKind::TemperatureDifference => temperature_difference(),
            ParameterKind::Amplitude => of(self.driven),
            ParameterKind::TimeTable => self.points_of_record(&time, &of(self.driven)),
            ParameterKind::Curve(first, second) => points(&of(first), &of(second)),
            ParameterKind::Choice(words) => json!({ "enum": words }),
            ParameterKind::Flag => json!({ "const": true }),
            ParameterKind::Window => {
                json!({ "anyOf": [{ "enum": ["impact", "run"] }, pair(&time, &time)] })
            }
            ParameterKind::LawFormula | ParameterKind::TimeFormula | ParameterKind::Node => {
                json!({ "type": "string" })
            }
            ParameterKind::Model => json!({ "anyOf": [{ "type": "string" }, reference("model")] }),
        };
        if parameter.follows {
            let from = parameter.default.unwrap_or_default();
            return described_as(schema, &format!("{}; left out: {from}", parameter.help));
        }
        if let Some(default) = parameter.default {
            // What counts in N/m by default is zero, and zero is so in Pa.
            let stays = match parameter.kind {
                ParameterKind::Quantity(dimension) => self.basis.dimension(dimension) == dimension,
                _ => true,
            };
            schema["default"] = if stays { json!(default) } else { json!(0) };
        }
        described_as(schema, parameter.help)
    }
}

/// A list of pairs, or a file of numbers.
fn points(first: &Value, second: &Value) -> Value {
    let list = json!({ "type": "array", "items": pair(first, second) });
    json!({ "anyOf": [list, reference("file"), reference("columns-of-file")] })
}

/// A file of numbers by its name.
pub(super) fn file() -> Value {
    json!({ "type": "string", "description": "a file of numbers such as a CSV file, beside the scene" })
}

/// A file of numbers, with what its columns are.
pub(super) fn of_file() -> Value {
    let column = json!({
        "anyOf": [{ "type": "integer", "minimum": 1 }, { "type": "string" }],
    });
    let columns = described_as(
        pair(&column, &column),
        "two columns by number from 1, or by name; needed where units do not tell them",
    );
    let unit = json!({ "type": "string" });
    let units = described_as(
        pair(&unit, &unit),
        "units of the two columns, where the header of the file does not say them",
    );
    let scale = described_as(
        json!({ "type": ["number", "string"] }),
        "what the values of the second column are multiplied by; it may have scatter",
    );
    let own =
        [("file", reference("file")), ("columns", columns), ("units", units), ("scale", scale)];
    let mut table = closed("", own);
    table["required"] = json!(["file"]);
    table
}

fn pair(first: &Value, second: &Value) -> Value {
    json!({ "type": "array", "prefixItems": [first, second], "minItems": 2, "maxItems": 2 })
}

/// The quantity of a dimension, by reference where there is a definition of it.
pub(super) fn named_quantity(dimension: Dimension) -> Value {
    dimension.named().map_or_else(|| quantity(dimension), |(name, _)| reference(name))
}

pub(super) fn quantity(dimension: Dimension) -> Value {
    json!({
        "description": format!("{}, a bare number in SI units, or a named value", described(dimension)),
        "type": ["number", "string"],
        "examples": [example_text(dimension)],
    })
}

fn temperature_difference() -> Value {
    let description = "a difference of temperatures (K), a bare number in K, or a named value";
    json!({ "description": description, "type": ["number", "string"], "examples": ["50 K"] })
}

pub(super) fn one_or_many(schema: &Value) -> Value {
    json!({ "anyOf": [schema, { "type": "array", "items": schema, "minItems": 1 }] })
}

pub(super) fn closed<'k>(
    description: &str,
    own: impl IntoIterator<Item = (&'k str, Value)>,
) -> Value {
    let table =
        json!({ "type": "object", "properties": object(own), "additionalProperties": false });
    if description.is_empty() { table } else { described_as(table, description) }
}

pub(super) fn object<'k>(
    entries: impl IntoIterator<Item = (&'k str, Value)>,
) -> Map<String, Value> {
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

pub(super) fn described_as(mut schema: Value, description: &str) -> Value {
    schema["description"] = json!(description);
    schema
}

pub(super) fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}
