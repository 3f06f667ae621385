//! Tests of the whole way from text to scene.

mod alternatives;
mod arithmetic;
mod curves;
mod effects;
mod equality;
mod hints;
mod layers;
mod limits;
mod loads;
mod materials;
mod messages;
mod models;
mod named;
mod odd_units;
mod pads;
mod round_trip;
mod settings;
mod warnings;

use std::sync::Arc;

use dashpot_network::{Model, Network};
use dashpot_rheology::Tree;

use crate::{Checked, Diagnostics, ReadOptions, Scene, read, read_shared};

/// Reads `text` as the file `scene.toml`.
fn read_text(text: &str) -> Result<Checked<Scene>, Diagnostics> {
    read(text, &ReadOptions { file: Some("scene.toml"), ..ReadOptions::default() })
}

fn scene(text: &str) -> Scene {
    read_text(text).unwrap_or_else(|errors| panic!("{errors}")).value
}

fn messages(text: &str) -> String {
    read_text(text).unwrap_err().render(false)
}

/// One line for each part and composition of a model: depth, name, kind and values.
fn shape(model: &Model) -> Vec<String> {
    let mut lines = Vec::new();
    let mut open = vec![(0, "", model)];
    while let Some((depth, name, tree)) = open.pop() {
        let word = match tree {
            Tree::Part(element) => format!("{} {:?}", element.kind(), element.values()),
            Tree::Series(_) => "series".to_owned(),
            Tree::Parallel(_) => "parallel".to_owned(),
        };
        lines.push(format!("{depth} {name} {word}"));
        let branches = tree.branches().iter().rev();
        open.extend(branches.map(|branch| (depth + 1, &*branch.name, &branch.tree)));
    }
    lines
}

/// Everything in a network, as text.
fn contents(network: &Network) -> Vec<String> {
    let nodes = network.nodes().map(|(id, node)| format!("{id:?} {node:?}"));
    let elements = network.connections().iter().map(|connection| {
        format!(
            "{} {:?} {:?} {:?}",
            connection.name,
            connection.between,
            connection.thickness,
            shape(&connection.model)
        )
    });
    let loads = network.loads().iter().map(|load| format!("{load:?}"));
    let effects =
        network.effects().iter().map(|effect| format!("{} {:?}", effect.kind(), effect.values()));
    nodes.chain(elements).chain(loads).chain(effects).collect()
}

/// A scene with one mass on the model in `law`.
fn on_model(law: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 1, velocity = 1 }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], {law} }}\n\
         [run]\nduration = 1\n"
    )
}

fn model(law: &str) -> Model {
    scene(&on_model(law)).network.connections()[0].model.clone()
}

#[test]
fn a_text_is_shared_unless_something_is_set_in_it() {
    let text: Arc<str> = crate::reference().into();
    let own = read_shared(&text, &ReadOptions::default()).unwrap().value;
    assert!(Arc::ptr_eq(&own.text, &text));
    let set = [("head.mass".to_owned(), "5 kg".to_owned())];
    let changed = read_shared(&text, &ReadOptions { set: &set, ..ReadOptions::default() });
    assert_ne!(changed.unwrap().value.text, text);
    assert_eq!(*read(&text, &ReadOptions::default()).unwrap().value.text, *text);
}
