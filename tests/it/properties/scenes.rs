//! Texts of scenes: read or refused, at a place within the text.

use std::fmt::Write as _;
use std::sync::LazyLock;

use dashpot::{
    network::{Model, Network, parameters::Value},
    rheology::Tree,
    scene::{
        Diagnostics, ReadOptions, read, read_bytes, read_named_model, read_network, references,
        schema, templates, write_effect, write_model, write_model_table,
    },
};
use proptest::{prelude::*, sample::Index};

use super::{
    config, grammar,
    mutations::{damage, damaged},
};

/// What is wrong with how these bytes are read.
pub(super) fn check(bytes: &[u8]) -> Result<(), String> {
    let options = ReadOptions { file: Some("scene.toml"), ..ReadOptions::default() };
    match read_bytes(bytes, &options) {
        Ok(checked) => {
            placed(&checked.warnings)?;
            let scene = checked.value;
            written_again(&scene.network)?;
            // A scene that is read compiles.
            let compiled = scene.network.compile(scene.run.duration);
            compiled.map_err(|errors| format!("is read, but: {errors}"))?;
        }
        Err(errors) => {
            if errors.is_empty() {
                return Err("refused without a reason".to_owned());
            }
            placed(&errors)?;
        }
    }
    let Ok(text) = std::str::from_utf8(bytes) else { return Ok(()) };
    for name in ["", "foam", "m0", "e0", "pad"] {
        match read_named_model(text, name, &options) {
            Ok(checked) => drop(write_model_table(name, &checked.value.model, &[])),
            Err(errors) => placed(&errors)?,
        }
    }
    match read_network(text, &options) {
        Ok(checked) => {
            placed(&checked.warnings)?;
            refused_by_name(&checked.value)
        }
        Err(errors) => placed(&errors),
    }
}

/// Every place lies within its text, at borders of characters, and every message can be shown.
fn placed(diagnostics: &Diagnostics) -> Result<(), String> {
    for own in &diagnostics.list {
        if own.message().is_empty() {
            return Err("a message without words".to_owned());
        }
        let (Some(span), Some(source)) = (&own.span, &own.source) else { continue };
        if source.text.get(span.clone()).is_none() {
            return Err(format!("{span:?} is no part of the text: {}", own.message()));
        }
        let _ = (own.help(), own.note(), own.line_and_column());
    }
    if !diagnostics.is_empty() && diagnostics.render(false).is_empty() {
        return Err("nothing to show".to_owned());
    }
    Ok(())
}

/// A network compiles, or the errors name what of it is wrong.
fn refused_by_name(network: &Network) -> Result<(), String> {
    let Err(errors) = network.compile(1.0) else { return Ok(()) };
    let nodes = network.nodes().map(|(_, node)| node.name.as_str());
    let elements = network.connections().iter().map(|connection| connection.name.as_str());
    let loads = network.loads().iter().map(|load| load.name.as_str());
    let names: Vec<&str> = nodes.chain(elements).chain(loads).collect();
    for error in &errors.0 {
        let text = error.to_string();
        if !names.iter().any(|name| text.contains(name)) && !network.connections().is_empty() {
            return Err(format!("refused without a name: {text}"));
        }
    }
    Ok(())
}

/// What was read comes back from what is written.
fn written_again(network: &Network) -> Result<(), String> {
    let mut text = String::from(
        "[nodes]\na = { mass = 1, velocity = 1 }\nb = { mass = 1 }\n[run]\nduration = 1\n[models]\n",
    );
    let models: Vec<&Model> =
        network.connections().iter().map(|connection| &connection.model).collect();
    for (at, model) in models.iter().enumerate() {
        writeln!(text, "m{at} = {}", write_model(model)).map_err(|error| error.to_string())?;
    }
    text += "[elements]\n";
    for at in 0..models.len() {
        let between = "between = [\"a\", \"b\"]";
        writeln!(text, "e{at} = {{ {between}, model = \"m{at}\" }}")
            .map_err(|error| error.to_string())?;
    }
    let again = read_network(&text, &ReadOptions::default());
    let again = again.map_err(|errors| format!("is written as what is refused:\n{errors}"))?;
    for (own, model) in again.value.connections().iter().zip(models) {
        let (found, expected) = (shape(&own.model), shape(model));
        if found != expected {
            return Err(format!("{expected:?} comes back as {found:?}"));
        }
    }
    for effect in network.effects() {
        if write_effect(effect.as_ref()).is_empty() {
            return Err(format!("{effect:?} is written as nothing"));
        }
    }
    Ok(())
}

/// One line for each part and composition: depth, name, kind and values, which are written with all digits
/// but the last.
fn shape(model: &Model) -> Vec<String> {
    let mut lines = Vec::new();
    let mut open = vec![(0, "", model)];
    while let Some((depth, name, tree)) = open.pop() {
        let word = match tree {
            Tree::Part(element) => {
                let values: Vec<_> = element.values().iter().map(shown).collect();
                format!("{} {values:?}", element.kind())
            }
            Tree::Series(_) => "series".to_owned(),
            Tree::Parallel(_) => "parallel".to_owned(),
        };
        lines.push(format!("{depth} {name} {word}"));
        let branches = tree.branches().iter().rev();
        open.extend(branches.map(|branch| (depth + 1, &*branch.name, &branch.tree)));
    }
    lines
}

fn shown(value: &Value) -> String {
    match value {
        Value::Number(own) => format!("{own:.14e}"),
        Value::Table(rows) => {
            let row = |(a, b): &(f64, f64)| format!("{a:.14e} {b:.14e}");
            rows.iter().map(row).collect::<Vec<_>>().join(", ")
        }
        other => format!("{other:?}"),
    }
}

fn checked(bytes: &[u8]) -> Result<(), TestCaseError> {
    check(bytes)
        .map_err(|what| TestCaseError::fail(format!("{what}\n{}", String::from_utf8_lossy(bytes))))
}

#[test]
fn grammar_makes_scenes_that_are_read() {
    use proptest::{strategy::ValueTree, test_runner::TestRunner};
    let mut runner = TestRunner::new(config(1));
    let scenes = grammar::scene();
    let texts = (0..300).map(|_| scenes.new_tree(&mut runner).unwrap().current());
    let read = texts.filter(|text| read(text, &ReadOptions::default()).is_ok()).count();
    assert!(read >= 30, "{read} of 300");
}

proptest! {
    #![proptest_config(config(200))]

    #[test]
    fn scenes_of_the_grammar_are_read_or_refused(text in grammar::scene()) {
        checked(text.as_bytes())?;
    }

    #[test]
    fn damaged_scenes_are_read_or_refused(text in grammar::scene(), damage in damage()) {
        checked(&damaged(text.as_bytes(), &damage))?;
    }

    #[test]
    fn damaged_templates_are_read_or_refused(which in any::<Index>(), damage in damage()) {
        let all: Vec<_> = templates().iter().chain(references()).collect();
        checked(&damaged(all[which.index(all.len())].text.as_bytes(), &damage))?;
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        checked(&bytes)?;
    }

    #[test]
    fn keys_of_the_schema_in_any_order_are_read_or_refused(
        keys in prop::collection::vec((any::<Index>(), any::<Index>(), 0..5u8), 0..12),
    ) {
        static WORDS: LazyLock<Vec<String>> = LazyLock::new(words);
        let words = &*WORDS;
        let mut text = String::new();
        for (first, second, shape) in &keys {
            let [first, second] = [first, second].map(|own| &words[own.index(words.len())]);
            let line = match shape {
                0 => format!("[{first}]"),
                1 => format!("[{first}.{second}]"),
                2 => format!("{first} = \"{second}\""),
                3 => format!("{first} = {{ {second} = 1 }}"),
                _ => format!("{first} = [[\"{second}\", 1]]"),
            };
            text.push_str(&line);
            text.push('\n');
        }
        checked(text.as_bytes())?;
    }
}

/// All keys that the schema knows.
fn words() -> Vec<String> {
    let text = schema().to_string();
    let mut words: Vec<String> = text
        .split('"')
        .filter(|word| !word.is_empty() && word.len() < 30)
        .filter(|word| word.chars().all(|c| c.is_ascii_alphanumeric() || c == '-'))
        .map(str::to_owned)
        .collect();
    words.sort();
    words.dedup();
    words
}
