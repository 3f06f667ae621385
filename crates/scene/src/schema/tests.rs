use serde_json::Value;

use dashpot_network::{
    composites::COMPOSITES,
    elements::ELEMENTS,
    parameters::{Dimension, Parameter},
    waveforms::WAVEFORMS,
};

use super::schema;
use crate::{
    ReadOptions,
    kinds::{Example, is_points},
    quantities::basis::Basis,
    read, references, templates,
};

/// The keywords that the schema uses, and no others.
fn fits(root: &Value, schema: &Value, value: &Value) -> bool {
    let Some(rules) = schema.as_object() else { return schema.as_bool().unwrap() };
    rules.iter().all(|(keyword, rule)| rule_fits(root, schema, keyword, rule, value))
}

fn rule_fits(root: &Value, schema: &Value, keyword: &str, rule: &Value, value: &Value) -> bool {
    let each = || rule.as_array().unwrap().iter();
    let number = || usize::try_from(rule.as_u64().unwrap()).unwrap();
    match keyword {
        "$schema" | "$defs" | "title" | "description" | "default" | "examples" => true,
        "$ref" => {
            let path = rule.as_str().unwrap().strip_prefix('#').unwrap();
            fits(root, root.pointer(path).unwrap_or_else(|| panic!("{path}")), value)
        }
        "type" => match rule {
            Value::Array(types) => types.iter().any(|one| is_type(one, value)),
            one => is_type(one, value),
        },
        "enum" => each().any(|one| one == value),
        "const" => rule == value,
        "anyOf" => each().any(|one| fits(root, one, value)),
        "oneOf" => each().filter(|one| fits(root, one, value)).count() == 1,
        "required" => each().all(|key| value.get(key.as_str().unwrap()).is_some()),
        "properties" => rule
            .as_object()
            .unwrap()
            .iter()
            .all(|(key, one)| value.get(key).is_none_or(|own| fits(root, one, own))),
        "additionalProperties" => value.as_object().is_none_or(|table| {
            let known = schema.get("properties").and_then(Value::as_object);
            let is_known = |key: &String| known.is_some_and(|known| known.contains_key(key));
            table.iter().all(|(key, own)| is_known(key) || fits(root, rule, own))
        }),
        "items" => value.as_array().is_none_or(|all| all.iter().all(|own| fits(root, rule, own))),
        "prefixItems" => value
            .as_array()
            .is_none_or(|all| all.iter().zip(each()).all(|(own, rule)| fits(root, rule, own))),
        "minItems" => value.as_array().is_none_or(|all| all.len() >= number()),
        "maxItems" => value.as_array().is_none_or(|all| all.len() <= number()),
        "minProperties" => value.as_object().is_none_or(|all| all.len() >= number()),
        "maxProperties" => value.as_object().is_none_or(|all| all.len() <= number()),
        "minimum" => value.as_u64().is_none_or(|own| own >= rule.as_u64().unwrap()),
        "maximum" => value.as_u64().is_none_or(|own| own <= rule.as_u64().unwrap()),
        other => panic!("the schema uses {other}"),
    }
}

fn is_type(word: &Value, value: &Value) -> bool {
    match word.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        other => panic!("the schema uses type {other}"),
    }
}

fn json(text: &str) -> Value {
    serde_json::to_value(text.parse::<toml::Table>().unwrap()).unwrap()
}

#[test]
fn shipped_scenes_fit_the_schema() {
    let schema = schema();
    for shipped in templates().iter().chain(references()) {
        assert!(fits(&schema, &schema, &json(shipped.text)), "{}", shipped.name);
    }
}

#[test]
fn faults_do_not_fit_the_schema() {
    let schema = schema();
    let scene = |element: &str| {
        json(&format!(
            "[elements]\np = {element}\n[nodes]\na = {{ mass = 1 }}\n[run]\nduration = 1"
        ))
    };
    let fits = |element: &str| fits(&schema, &schema, &scene(element));
    assert!(fits("{ between = [\"a\", \"ground\"], spring = 1 }"));
    assert!(fits("{ between = [\"a\", \"ground\"], series = [{ spring = 1, name = \"s\" }] }"));
    assert!(!fits("{ between = [\"a\", \"ground\"] }"));
    assert!(!fits("{ between = [\"a\"], spring = 1 }"));
    assert!(!fits("{ between = [\"a\", \"ground\"], spring = 1, dashpot = 1 }"));
    assert!(!fits("{ between = [\"a\", \"ground\"], sprong = 1 }"));
    assert!(!fits("{ between = [\"a\", \"ground\"], series = [] }"));
    assert!(!fits("{ between = [\"a\", \"ground\"], rigid = false }"));
}

#[test]
fn materials_composites_and_shifts_have_a_schema() {
    let schema = schema();
    let scene = |rest: &str, element: &str| {
        json(&format!(
            "[elements]\np = {{ between = [\"a\", \"ground\"], {element} }}\n[run]\nduration = 1\n{rest}"
        ))
    };
    let element = |own: &str| fits(&schema, &schema, &scene("", own));
    let material = |own: &str| {
        fits(&schema, &schema, &scene(&format!("[materials]\nm = {own}"), "spring = 1"))
    };
    assert!(element("material = \"m\", thickness = 1, area = \"1 cm^2\""));
    assert!(!element("material = \"m\", thickness = 1"));
    assert!(!element("material = \"m\", thickness = 1, area = 1, spring = 1"));
    assert!(element("series = [{ material = \"m\", thickness = 1, area = 1, name = \"x\" }]"));
    assert!(element("prony = { terms = [[\"1 ms\", 2]], equilibrium = 1 }"));
    assert!(element("prony = [[\"1 ms\", 2]]") && element("kelvin-chain = [[1, 2]]"));
    assert!(!element("prony = { terms = [[\"1 ms\", 2, 3]] }"));
    let shift = "wlf = { temperature = \"0 degC\", reference = 293 }";
    assert!(element(&format!("spring = 1, shift = {{ {shift} }}")));
    assert!(!element("spring = 1, shift = {}"));
    assert!(!element("spring = 1, shift = { wlf = {} }"));
    assert!(material("{ zener = { spring = 1, maxwell = { spring = 1, dashpot = \"1 Pa s\" } } }"));
    assert!(material(&format!("{{ series = [{{ material = \"x\" }}], shift = {{ {shift} }} }}")));
    assert!(!material("{ model = \"x\" }"));
    assert!(!material("{ spring = 1, area = 1 }"));
}

/// The ways in which points may be given, for a kind with these parameters: all that is in the tables besides.
fn ways(word: &str, parameters: &[Parameter], driven: Dimension) -> Vec<String> {
    let example = Example { basis: Basis::Model, driven: Some(driven) };
    let written =
        |own: &Parameter| format!("{} = {}", own.name, example.parameter(own).replace(", …", ""));
    let beside = |is_in: &dyn Fn(&Parameter) -> bool| {
        let own = parameters.iter().filter(|own| is_in(own) && own.default.is_none());
        own.map(written).collect::<Vec<_>>()
    };
    let table = |own: Vec<String>| format!("{word} = {{ {} }}", own.join(", "));
    let others = || beside(&|own| !is_points(own));
    let mut ways = vec![format!("{word} = \"file.csv\"")];
    for file in
        ["file = \"file.csv\"", "file = \"file.csv\", columns = [1, 2], units = [\"-\", \"-\"]"]
    {
        ways.push(table([vec![file.to_owned()], others()].concat()));
        for points in parameters.iter().filter(|own| is_points(own)) {
            let rest = beside(&|own| own.name != points.name);
            let by_file = [format!("{} = \"file.csv\"", points.name)];
            ways.push(table([by_file.to_vec(), rest.clone()].concat()));
            let by_table = [format!("{} = {{ {file} }}", points.name)];
            ways.push(table([by_table.to_vec(), rest].concat()));
        }
    }
    ways.push(table([vec!["columns = [1, 2]".to_owned()], others()].concat()));
    ways
}

/// Whether a scene with these files of numbers can be read, as far as its form goes.
fn is_form(text: &str) -> bool {
    let loader = |_: &str| Ok(b"0 0\n1 1\n2 2\n".to_vec());
    let options = ReadOptions { loader: Some(&loader), ..ReadOptions::default() };
    let is_of_form = |own: &crate::Diagnostic| {
        let told = own.fault.to_string();
        ["unknown key", " has no `", " is a list of ", " is a table", "cannot be read"]
            .iter()
            .any(|form| told.contains(form))
    };
    read(text, &options).map_or_else(|own| !own.list.iter().any(is_of_form), |_| true)
}

#[test]
fn files_stand_in_the_schema_where_the_reader_takes_them() {
    let schema = schema();
    let element = |law: &str| {
        format!(
            "[elements.p]\nbetween = [\"a\", \"ground\"]\n{law}\n[nodes]\na = {{ mass = 1 }}\n[run]\nduration = 1"
        )
    };
    let load = |law: &str| {
        format!("{}\n[loads.l]\non = \"a\"\nforce = {{ {law} }}", element("spring = 1"))
    };
    let elements = ELEMENTS.iter().map(|own| (own.word, own.parameters, Dimension::FORCE));
    let composites = COMPOSITES.iter().map(|own| (own.word, own.parameters, own.about));
    let waveforms = WAVEFORMS.iter().map(|own| (own.word, own.parameters, Dimension::FORCE));
    let scenes = elements.chain(composites).map(|own| (own, &element as &dyn Fn(&str) -> String));
    let scenes = scenes.chain(waveforms.map(|own| (own, &load as &dyn Fn(&str) -> String)));
    let mut verdicts = [0, 0];
    for ((word, parameters, driven), scene) in scenes {
        if !parameters.iter().any(is_points) {
            continue;
        }
        for way in ways(word, parameters, driven) {
            let text = scene(&way);
            let is_read = is_form(&text);
            verdicts[usize::from(is_read)] += 1;
            assert_eq!(fits(&schema, &schema, &json(&text)), is_read, "{way}");
        }
    }
    // Each is told from the other.
    assert!(verdicts.iter().all(|count| *count > 5), "{verdicts:?}");
}
