//! The list of what is built in says what is built in.

use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::Write as _,
    fs,
    process::Command,
};

use serde_json::Value;

use super::{OUTDATED, is_update, root, text};

/// The package for Python, which nothing else depends on.
const PYTHON: &str = "dashpot-python";
const PAGE: &str = "THIRD-PARTY.md";
const HEAD: &str = "\
# Third parties

The program, the libraries and the package for Python are built with these crates from crates.io, under the licences
named. Each crate has the full text of its own. Made by `UPDATE_DOCS=1 cargo test docs::third_party`; `cargo deny
check` (`deny.toml`) refuses any other licence.
";

/// Packages that are built in, by licence: those that normal dependencies lead to, on any platform.
fn packages() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--locked"])
        .current_dir(root())
        .output()
        .unwrap();
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let nodes = metadata["resolve"]["nodes"].as_array().unwrap();
    let dependencies: BTreeMap<&str, &Value> =
        nodes.iter().map(|node| (node["id"].as_str().unwrap(), &node["deps"])).collect();
    let packages = metadata["packages"].as_array().unwrap().iter();
    let python = packages.clone().find(|package| package["name"] == PYTHON).unwrap();
    let roots = [&metadata["resolve"]["root"], &python["id"]];
    let mut open: Vec<&str> = roots.iter().map(|own| own.as_str().unwrap()).collect();
    let mut found = BTreeSet::new();
    while let Some(id) = open.pop() {
        if !found.insert(id) {
            continue;
        }
        for own in dependencies[id].as_array().unwrap() {
            let kinds = own["dep_kinds"].as_array().unwrap();
            if kinds.iter().any(|kind| kind["kind"].is_null()) {
                open.push(own["pkg"].as_str().unwrap());
            }
        }
    }
    let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for own in packages.filter(|package| found.contains(package["id"].as_str().unwrap())) {
        // Those of the workspace have no source.
        if own["source"].is_null() {
            continue;
        }
        let licence = own["license"].as_str().unwrap_or("see its package").replace('/', " OR ");
        let name =
            format!("{} {}", own["name"].as_str().unwrap(), own["version"].as_str().unwrap());
        all.entry(licence).or_default().insert(name);
    }
    all
}

#[test]
fn what_is_built_in_is_listed_with_its_licence() {
    let mut page = HEAD.to_owned();
    for (licence, names) in packages() {
        let names: Vec<String> = names.into_iter().collect();
        write!(page, "\n## {licence}\n\n{}\n", names.join(", ")).unwrap();
    }
    if is_update() {
        fs::write(root().join(PAGE), &page).unwrap();
    }
    assert!(text(PAGE) == page, "{PAGE} is {OUTDATED}");
}
