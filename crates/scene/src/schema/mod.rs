//! The JSON schema of scenes, made from the registers.

mod values;

use std::collections::BTreeMap;

use dashpot_analysis::{Family, MEASURES, limits::standards::STANDARDS};
use dashpot_dae::methods::METHODS;
use dashpot_network::{
    composites::COMPOSITES,
    effects::{EFFECTS, EffectEntry},
    elements::{ELEMENTS, Indenter},
    layers::MOST_SEGMENTS,
    parameters::{Dimension, Kind as _, Registered},
    shifts::SHIFTS,
    waveforms::WAVEFORMS,
};
use dashpot_rheology::{FORMS, Part, Role};
use serde_json::{Map, Value, json};

use self::values::{
    Values, closed, described_as, file, named_quantity, object, of_file, one_or_many, quantity,
    reference,
};
use crate::quantities::basis::{AREA, Basis, DENSITY, fits_material};

/// The JSON schema (draft 2020-12) of scenes, for editors: `#:schema ./scene.schema.json`.
pub fn schema() -> Value {
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "dashpot scene",
        "description": "Masses, springs and dashpots, and an impact on them.",
        "type": "object",
        "properties": {
            "title": { "type": "string", "description": "what the scene is" },
            "values": by_name("named values, usable wherever a quantity is expected", &json!({ "type": ["number", "string"] })),
            "models": by_name("two-terminal models, by name", &reference("model")),
            "materials": by_name("laws of stress over strain, which become pads by thickness and area", &reference("material")),
            "nodes": by_name("points with one displacement; `ground` is always there", &reference("node")),
            "elements": by_name("models between nodes", &reference("element")),
            "effects": closed(
                "what acts besides the elements, and only if named",
                EFFECTS.iter().map(|entry| (entry.word, effect(entry))),
            ),
            "loads": by_name("forces on nodes", &reference("load")),
            "measures": by_name(
                "measures of elements and nodes besides those always reported",
                &one_or_many(&reference("measure")),
            ),
            "limits": limits(),
            "accuracy": accuracy(),
            "run": run(),
            "fit": options_of("fit"),
            "design": options_of("design"),
            "scatter": together(),
        },
        "anyOf": [
            { "required": ["elements", "run"] },
            {
                "description": "models alone, for other scenes",
                "properties": { "title": true, "values": true, "models": true, "materials": true },
                "additionalProperties": false,
                "anyOf": [{ "required": ["models"] }, { "required": ["materials"] }],
            },
        ],
        "additionalProperties": false,
        "$defs": definitions(),
    })
}

/// A table of things that have names.
fn by_name(description: &str, schema: &Value) -> Value {
    json!({ "description": description, "type": "object", "additionalProperties": schema })
}

fn together() -> Value {
    let share = json!({ "type": ["string", "number", "object"] });
    let causes = json!({
        "description": "independent causes, and what one standard deviation of each adds to numbers, by their names, \
                        in parts of them",
        "type": "array",
        "items": { "type": "object", "additionalProperties": share },
    });
    closed("numbers that scatter together, such as those of a fit", [("together", causes)])
}

/// The section of a verb.
fn options_of(verb: &str) -> Value {
    let description = format!(
        "options of `dashpot {verb}` by their names, without dashes; those of the command stand above them"
    );
    let plain = json!({ "type": ["string", "number", "boolean"] });
    let list = json!({ "type": "array", "items": { "type": "string" } });
    by_name(&description, &json!({ "anyOf": [plain, list] }))
}

fn definitions() -> Value {
    let mut all = Map::new();
    let mut add = |name: &str, schema: Value| all.insert(name.to_owned(), schema);
    for dimension in Dimension::all_named() {
        if let Some((name, _)) = dimension.named() {
            add(name, quantity(dimension));
        }
    }
    let name =
        || ("name", described_as(json!({ "type": "string" }), "name of the branch in paths"));
    add("file", file());
    add("columns-of-file", of_file());
    add("shift", shift());
    add("model", composed("a two-terminal model", [], &[], Basis::Model));
    add("branch", composed("a branch of a model", [name()], &[], Basis::Model));
    let moduli = json!({
        "enum": ["compression", "shear"],
        "description": "what its moduli are: tensile or compressive with free sides, or those of simple shear",
    });
    let poisson = described_as(reference("number"), "Poisson's ratio, above -1 and at most 0.5");
    let own = [("moduli", moduli), ("poisson", poisson)];
    add("material", composed("a model in Pa", own, &[], Basis::MATERIAL));
    let branch = composed("a branch of a material", [name()], &[], Basis::MATERIAL);
    add("material-branch", branch);
    let between = json!({
        "description": "its ends, the impactor's side first",
        "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2,
    });
    let own = [("between", between.clone()), ("thickness", thickness())];
    let of_model = composed("a model between two nodes", own, &["between"], Basis::Model);
    add("element", json!({ "anyOf": [of_model, layered(&between)] }));
    add("node", node());
    add("force-function", function(Dimension::FORCE));
    add("length-function", function(Dimension::LENGTH));
    add("velocity-function", function(Dimension::VELOCITY));
    add("acceleration-function", function(Dimension::ACCELERATION));
    let on = described_as(json!({ "type": "string" }), "the node that feels the force");
    let force = described_as(reference("force-function"), "positive towards the support");
    let mut load = closed("", [("on", on), ("force", force)]);
    load["required"] = json!(["on", "force"]);
    add("load", load);
    add("measure", measure());
    Value::Object(all)
}

fn node() -> Value {
    let of = |name: &str, description: &str| described_as(reference(name), description);
    let velocity = json!({
        "description": "start velocity: makes it an impactor; a function of time gives its motion",
        "anyOf": [reference("velocity"), reference("velocity-function")],
    });
    let drop = "height of a fall: begins at touch with its speed, sqrt(2 g h); where gravity is on and all that touches \
                it can part, begins that high above, at rest";
    let energy =
        "kinetic energy at the start [J]: makes it an impactor with the speed sqrt(2 E / m)";
    let position =
        "where a mass begins, as a displacement: what is between it and others is deformed then";
    let acceleration =
        "its acceleration over time, from t = 0 on; it begins at rest, or with `velocity`";
    let properties = [
        ("mass", of("mass", "mass [kg], zero or positive; none by default")),
        ("velocity", velocity),
        ("drop", of("length", drop)),
        ("energy", of("energy", energy)),
        ("position", of("length", position)),
        ("fixed", json!({ "const": true, "description": "nothing moves it" })),
        ("motion", of("length-function", "its displacement over time")),
        ("acceleration", of("acceleration-function", acceleration)),
    ];
    closed("a point with one displacement", properties)
}

fn measure() -> Value {
    let words = MEASURES.iter().map(|measure| measure.word).collect::<Vec<_>>();
    let tables = MEASURES.iter().map(|measure| {
        let of = match measure.about.family {
            Family::Element => "of an element",
            Family::Node => "of a node",
        };
        let mut properties = Values::driving(Dimension::NUMBER).parameters(measure.parameters);
        properties.insert("kind".to_owned(), json!({ "const": measure.word }));
        json!({
            "description": format!("{} ({of})", measure.summary),
            "type": "object",
            "properties": properties,
            "required": ["kind"],
            "additionalProperties": false,
        })
    });
    let plain = json!({ "enum": words });
    json!({ "anyOf": std::iter::once(plain).chain(tables).collect::<Vec<_>>() })
}

fn limits() -> Value {
    let words = STANDARDS.iter().map(|own| own.word).collect::<Vec<_>>();
    let level = || json!({ "type": ["number", "string"] });
    let mut table = closed(
        "a limit",
        [
            ("max", described_as(level(), "what the measure may be at most")),
            ("min", described_as(level(), "what it may be at least")),
            (
                "standard",
                json!({ "enum": words, "description": "by a standard, in place of both" }),
            ),
            ("from", described_as(json!({ "type": "string" }), "where the bound is from")),
            ("mean", json!({ "const": true, "description": "on the mean of several tests" })),
        ],
    );
    table["minProperties"] = json!(1);
    let one = json!({ "anyOf": [{ "enum": words }, level(), table] });
    let one = one_or_many(&one);
    let description =
        "what measures may be, by their keys: a quantity is the most, a word a standard";
    by_name(
        description,
        &json!({ "anyOf": [one, { "type": "object", "additionalProperties": one }] }),
    )
}

fn accuracy() -> Value {
    let wish = reference("number");
    let below = "what moves no measure by more may be left out; nothing is";
    json!({
        "description": "how accurate the measures are to be, relative to their size",
        "type": "object",
        "properties": {
            "default": described_as(wish.clone(), "for all measures; 0.1 %"),
            "neglect-below": described_as(wish.clone(), below),
        },
        "additionalProperties": {
            "anyOf": [wish.clone(), { "type": "object", "additionalProperties": wish }],
        },
    })
}

fn run() -> Value {
    let method = json!({ "enum": METHODS.iter().map(|method| method.name).collect::<Vec<_>>() });
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
            "duration": described_as(
                reference("time"),
                "length of the run [s]; `auto` until the impact is over and nothing larger follows",
            ),
            "at-most": described_as(reference("time"), "the longest run that `auto` finds [s]"),
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
fn composed<'k>(
    description: &str,
    own: impl IntoIterator<Item = (&'k str, Value)>,
    required: &[&str],
    basis: Basis,
) -> Value {
    let is_material = basis.is_material();
    let mut laws = BTreeMap::new();
    let fits = |kind: &&Registered<_>| !is_material || fits_material(kind.parameters);
    for kind in ELEMENTS.iter().filter(fits) {
        let values = Values { driven: Dimension::FORCE, basis };
        laws.insert(kind.word, described_as(values.of_kind(kind.parameters), kind.summary));
    }
    for form in FORMS {
        for word in [&[form.word], form.aliases].concat() {
            laws.insert(word, described_as(parts(form.parts, basis), form.summary));
        }
    }
    for kind in COMPOSITES {
        let values = Values { driven: kind.about, basis };
        laws.insert(kind.word, described_as(values.of_kind(kind.parameters), kind.summary));
    }
    let branch = reference(if is_material { "material-branch" } else { "branch" });
    let branches = json!({ "type": "array", "items": branch, "minItems": 1 });
    laws.insert("series", described_as(branches.clone(), "branches in series"));
    laws.insert("parallel", described_as(branches, "branches in parallel"));
    let by_name = |word: &str| {
        let description = format!("a {word} by name, or `file.toml:name`");
        json!({ "type": "string", "description": description })
    };
    laws.insert("material", by_name("material"));
    let mut properties = object(own);
    properties.insert("shift".to_owned(), reference("shift"));
    if !is_material {
        laws.insert("model", by_name("model"));
        properties.insert("thickness".to_owned(), thickness());
        let area = described_as(quantity(AREA), "area of the pad [m^2], positive");
        properties.insert("area".to_owned(), area);
        properties.insert("loaded".to_owned(), loading());
        let values = Values { driven: Dimension::FORCE, basis };
        let indenter = described_as(values.of_kind(Indenter::PARAMETERS), Indenter::SUMMARY);
        properties.insert(Indenter::KIND.to_owned(), indenter);
    }
    let one = laws.keys().map(|&word| match word {
        "material" if !is_material => json!({
            "required": [word, "thickness"],
            "anyOf": [{ "required": ["area"] }, { "required": [Indenter::KIND] }],
        }),
        word => json!({ "required": [word] }),
    });
    let one = one.collect::<Vec<_>>();
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

fn loading() -> Value {
    json!({
        "enum": ["compression", "shear", "confined"],
        "description": "how the pad is loaded: across its thickness with free sides, along its faces, or across it \
                        with its sides held",
    })
}

/// An element made of layers.
fn layered(between: &Value) -> Value {
    let material = json!({ "type": "string", "description": "a material by name" });
    let area = described_as(quantity(AREA), "area [m^2], positive");
    let density = described_as(quantity(DENSITY), "density [kg/m^3], zero or positive");
    let mut layer = closed(
        "a layer with mass",
        [
            ("material", material),
            ("thickness", described_as(reference("length"), "thickness [m], positive")),
            ("area", area),
            ("loaded", loading()),
            ("density", density),
            ("shift", reference("shift")),
        ],
    );
    layer["required"] = json!(["material", "thickness", "area", "density"]);
    let segments = json!({
        "description": "into how many segments the pad is cut",
        "type": "integer", "minimum": 1, "maximum": MOST_SEGMENTS,
    });
    let accuracy = "relative error of the speed of waves; 1 %";
    let mut table = closed(
        "a pad of layers in which waves travel",
        [
            ("between", between.clone()),
            ("layers", json!({ "type": "array", "items": layer, "minItems": 1 })),
            ("segments", segments),
            ("accuracy", described_as(reference("number"), accuracy)),
        ],
    );
    table["required"] = json!(["between", "layers"]);
    table
}

fn thickness() -> Value {
    described_as(reference("length"), "thickness of the pad [m], positive")
}

/// A table with one shift.
fn shift() -> Value {
    let kinds = SHIFTS.iter();
    let values = Values::driving(Dimension::NUMBER);
    let schema = |kind: &Registered<_>| described_as(values.of_kind(kind.parameters), kind.summary);
    let description = "what multiplies all times of the model";
    let mut table = closed(description, kinds.map(|kind| (kind.word, schema(kind))));
    (table["minProperties"], table["maxProperties"]) = (json!(1), json!(1));
    table
}

fn parts(parts_of_form: &[Part], basis: Basis) -> Value {
    let schema = |part: &Part| match part.role {
        Role::Spring => named_quantity(basis.dimension(Dimension::STIFFNESS)),
        Role::Dashpot => named_quantity(basis.dimension(Dimension::DAMPING)),
        Role::Form { parts: inner, .. } => parts(inner, basis),
    };
    let names = parts_of_form.iter().map(|part| part.name).collect::<Vec<_>>();
    let mut table = closed("", parts_of_form.iter().map(|part| (part.name, schema(part))));
    table["required"] = json!(names);
    table
}

/// A table with one function of time.
fn function(driven: Dimension) -> Value {
    let kinds = WAVEFORMS.iter();
    let schema = |kind: &Registered<_>| {
        described_as(Values::driving(driven).of_kind(kind.parameters), kind.summary)
    };
    let mut table = closed("a function of time", kinds.map(|kind| (kind.word, schema(kind))));
    (table["minProperties"], table["maxProperties"]) = (json!(1), json!(1));
    table
}

fn effect(entry: &EffectEntry) -> Value {
    let table = Values::driving(Dimension::FORCE).of_kind(entry.parameters);
    let plain = entry.parameters.iter().all(|parameter| parameter.default.is_some());
    let schema = if plain { json!({ "anyOf": [{ "const": true }, table] }) } else { table };
    if entry.about.is_per_element {
        let by_element = json!({ "type": "object", "additionalProperties": schema });
        return described_as(by_element, &format!("by elements: {}", entry.summary));
    }
    described_as(schema, entry.summary)
}

#[cfg(test)]
mod tests;
