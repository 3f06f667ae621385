//! The JSON schema of scenes, made from the registers.

use std::collections::BTreeMap;

use dashpot_analysis::Family;
use dashpot_network::parameters::{Dimension, Parameter, ParameterKind};
use dashpot_rheology::{Part, Role};
use serde_json::{Map, Value, json};

use crate::{
    fault::{described, example_text},
    kinds::{Kind, registers},
};

/// The JSON schema (draft 2020-12) of scenes, for editors: `#:schema ./scene.schema.json`.
pub fn schema() -> Value {
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "dashpot scene",
        "description": "Masses, springs and dashpots, and an impact on them.",
        "type": "object",
        "properties": {
            "title": { "type": "string", "description": "what the scene is" },
            "values": {
                "description": "named values, usable wherever a quantity is expected",
                "type": "object",
                "additionalProperties": { "type": ["number", "string"] },
            },
            "models": {
                "description": "two-terminal models, by name",
                "type": "object",
                "additionalProperties": reference("model"),
            },
            "nodes": {
                "description": "points with one displacement; `ground` is always there",
                "type": "object",
                "additionalProperties": reference("node"),
            },
            "elements": {
                "description": "models between nodes",
                "type": "object",
                "additionalProperties": reference("element"),
            },
            "effects": closed(
                "what acts besides the elements, and only if named",
                registers().effects.iter().map(|kind| (kind.word, effect(kind))),
            ),
            "loads": {
                "description": "forces on nodes",
                "type": "object",
                "additionalProperties": reference("load"),
            },
            "measures": {
                "description": "measures of elements and nodes besides those always reported",
                "type": "object",
                "additionalProperties": one_or_many(&reference("measure")),
            },
            "accuracy": accuracy(),
            "run": run(),
        },
        "required": ["elements", "run"],
        "additionalProperties": false,
        "$defs": definitions(),
    })
}

fn definitions() -> Value {
    let mut all = Map::new();
    let mut add = |name: &str, schema: Value| all.insert(name.to_owned(), schema);
    for dimension in [
        Dimension::NUMBER,
        Dimension::MASS,
        Dimension::LENGTH,
        Dimension::TIME,
        Dimension::FREQUENCY,
        Dimension::VELOCITY,
        Dimension::ACCELERATION,
        Dimension::FORCE,
        Dimension::STIFFNESS,
        Dimension::DAMPING,
        Dimension::IMPULSE,
        Dimension::ENERGY,
    ] {
        if let Some((name, _)) = dimension.named() {
            add(name, quantity(dimension));
        }
    }
    add("model", composed("a two-terminal model", Map::new(), &[]));
    let name = described_as(json!({ "type": "string" }), "name of the branch in paths");
    add("branch", composed("a branch of a model", object([("name", name)]), &[]));
    let own = object([
        (
            "between",
            json!({
                "description": "its ends, the impactor's side first",
                "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2,
            }),
        ),
        ("thickness", described_as(reference("length"), "thickness of the pad [m], positive")),
    ]);
    add("element", composed("a model between two nodes", own, &["between"]));
    add("node", node());
    add("force-function", function(Dimension::FORCE));
    add("length-function", function(Dimension::LENGTH));
    add(
        "load",
        json!({
            "type": "object",
            "properties": {
                "on": { "type": "string", "description": "the node that feels the force" },
                "force": described_as(reference("force-function"), "positive towards the support"),
            },
            "required": ["on", "force"],
            "additionalProperties": false,
        }),
    );
    add("measure", measure());
    Value::Object(all)
}

fn node() -> Value {
    let properties = [
        ("mass", described_as(reference("mass"), "mass [kg], zero or positive; none by default")),
        ("velocity", described_as(reference("velocity"), "start velocity: makes it an impactor")),
        ("drop", described_as(reference("length"), "height of a fall that ends at t = 0")),
        ("fixed", json!({ "const": true, "description": "nothing moves it" })),
        ("motion", described_as(reference("length-function"), "its displacement over time")),
    ];
    closed("a point with one displacement", properties)
}

fn measure() -> Value {
    let measures = &registers().measures;
    let words = measures.iter().map(|measure| measure.kind.word).collect::<Vec<_>>();
    let tables = measures.iter().map(|measure| {
        let of = match measure.family {
            Family::Element => "of an element",
            Family::Node => "of a node",
        };
        let mut properties = parameters(measure.kind.parameters, Dimension::NUMBER);
        properties.insert("kind".to_owned(), json!({ "const": measure.kind.word }));
        json!({
            "description": format!("{} ({of})", measure.kind.summary),
            "type": "object",
            "properties": properties,
            "required": ["kind"],
            "additionalProperties": false,
        })
    });
    let plain = json!({ "enum": words });
    json!({ "anyOf": std::iter::once(plain).chain(tables).collect::<Vec<_>>() })
}

fn accuracy() -> Value {
    let wish = reference("number");
    json!({
        "description": "how accurate the measures are to be, relative to their size",
        "type": "object",
        "properties": { "default": described_as(wish.clone(), "for all measures; 0.1 %") },
        "additionalProperties": {
            "anyOf": [wish.clone(), { "type": "object", "additionalProperties": wish }],
        },
    })
}

fn run() -> Value {
    let method = json!({ "enum": registers().methods });
    let condition = json!({
        "type": "object",
        "properties": {
            "when": { "type": "string", "description": "an output, for instance `padding.force`" },
            "falls-below": { "type": ["number", "string"] },
            "rises-above": { "type": ["number", "string"] },
        },
        "required": ["when"],
        "oneOf": [{ "required": ["falls-below"] }, { "required": ["rises-above"] }],
        "additionalProperties": false,
    });
    json!({
        "description": "how long, by which methods, and when to stop",
        "type": "object",
        "properties": {
            "duration": described_as(reference("time"), "length of the run [s]"),
            "samples": {
                "description": "points of the output grid; the solution does not depend on it",
                "type": "integer", "minimum": 1, "maximum": 10_000_000, "default": 501,
            },
            "methods": described_as(one_or_many(&method), "methods; `auto` chooses"),
            "rtol": described_as(reference("number"), "the methods' own relative tolerance"),
            "stop": {
                "description": "conditions that end the run early",
                "type": "array", "items": condition,
            },
        },
        "required": ["duration"],
        "additionalProperties": false,
    })
}

/// A table with one law and the keys `own`.
fn composed(description: &str, own: Map<String, Value>, required: &[&str]) -> Value {
    let mut laws = BTreeMap::new();
    for kind in &registers().elements {
        let schema = described_as(kind_value(kind.parameters, Dimension::FORCE), kind.summary);
        laws.insert(kind.word, schema);
    }
    for form in &registers().forms {
        for word in [&[form.word], form.aliases].concat() {
            laws.insert(word, described_as(parts(form.parts), form.summary));
        }
    }
    let branches = json!({ "type": "array", "items": reference("branch"), "minItems": 1 });
    laws.insert("series", described_as(branches.clone(), "branches in a row"));
    laws.insert("parallel", described_as(branches, "branches side by side"));
    let model = json!({ "type": "string" });
    laws.insert("model", described_as(model, "a model by name, or `file.toml:name`"));
    let one = laws.keys().map(|word| json!({ "required": [word] })).collect::<Vec<_>>();
    let mut properties = own;
    properties.extend(laws.into_iter().map(|(word, schema)| (word.to_owned(), schema)));
    json!({
        "description": description,
        "type": "object",
        "properties": properties,
        "required": required,
        "oneOf": one,
        "additionalProperties": false,
    })
}

fn parts(parts_of_form: &[Part]) -> Value {
    let schema = |part: &Part| match part.role {
        Role::Spring => reference("stiffness"),
        Role::Dashpot => reference("damping"),
        Role::Form { parts: inner, .. } => parts(inner),
    };
    let names = parts_of_form.iter().map(|part| part.name).collect::<Vec<_>>();
    let mut table = closed("", parts_of_form.iter().map(|part| (part.name, schema(part))));
    table["required"] = json!(names);
    table
}

/// A table with one function of time.
fn function(driven: Dimension) -> Value {
    let kinds = registers().waveforms.iter();
    let schema = |kind: &Kind<_>| described_as(kind_value(kind.parameters, driven), kind.summary);
    let mut table = closed("a function of time", kinds.map(|kind| (kind.word, schema(kind))));
    (table["minProperties"], table["maxProperties"]) = (json!(1), json!(1));
    table
}

fn effect<T>(kind: &Kind<T>) -> Value {
    let table = kind_value(kind.parameters, Dimension::FORCE);
    let plain = kind.parameters.iter().all(|parameter| parameter.default.is_some());
    let schema = if plain { json!({ "anyOf": [{ "const": true }, table] }) } else { table };
    described_as(schema, kind.summary)
}

/// What follows the word of a kind.
fn kind_value(all: &[Parameter], driven: Dimension) -> Value {
    let required = all.iter().filter(|parameter| parameter.default.is_none()).collect::<Vec<_>>();
    let names = required.iter().map(|parameter| parameter.name).collect::<Vec<_>>();
    let table = json!({
        "type": "object",
        "properties": parameters(all, driven),
        "required": names,
        "additionalProperties": false,
    });
    match required.as_slice() {
        [only] if all.len() == 1 => parameter(only, driven),
        [only] => json!({ "anyOf": [parameter(only, driven), table] }),
        _ => table,
    }
}

fn parameters(all: &[Parameter], driven: Dimension) -> Map<String, Value> {
    all.iter().map(|own| (own.name.to_owned(), parameter(own, driven))).collect()
}

fn parameter(parameter: &Parameter, driven: Dimension) -> Value {
    let time = reference("time");
    let pair = |first: &Value, second: &Value| json!({ "type": "array", "prefixItems": [first, second], "minItems": 2, "maxItems": 2 });
    let mut schema = match parameter.kind {
        ParameterKind::Quantity(dimension) => named_quantity(dimension),
        ParameterKind::Amplitude => named_quantity(driven),
        ParameterKind::TimeTable => {
            json!({ "type": "array", "items": pair(&time, &named_quantity(driven)) })
        }
        ParameterKind::Choice(words) => json!({ "enum": words }),
        ParameterKind::Flag => json!({ "const": true }),
        ParameterKind::Window => {
            json!({ "anyOf": [{ "enum": ["impact", "run"] }, pair(&time, &time)] })
        }
    };
    if let Some(default) = parameter.default {
        schema["default"] = json!(default);
    }
    described_as(schema, parameter.help)
}

fn named_quantity(dimension: Dimension) -> Value {
    dimension.named().map_or_else(|| quantity(dimension), |(name, _)| reference(name))
}

fn quantity(dimension: Dimension) -> Value {
    json!({
        "description": format!("{}, a bare number in SI units, or a named value", described(dimension)),
        "type": ["number", "string"],
        "examples": [example_text(dimension)],
    })
}

fn one_or_many(schema: &Value) -> Value {
    json!({ "anyOf": [schema, { "type": "array", "items": schema, "minItems": 1 }] })
}

fn closed<'k>(description: &str, own: impl IntoIterator<Item = (&'k str, Value)>) -> Value {
    let table =
        json!({ "type": "object", "properties": object(own), "additionalProperties": false });
    if description.is_empty() { table } else { described_as(table, description) }
}

fn object<'k>(entries: impl IntoIterator<Item = (&'k str, Value)>) -> Map<String, Value> {
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

fn described_as(mut schema: Value, description: &str) -> Value {
    schema["description"] = json!(description);
    schema
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

#[cfg(test)]
mod tests;
