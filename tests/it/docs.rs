//! The documents say what is true: tables follow from the registers, links lead somewhere, and
//! scenes in them can be read.
//!
//! `UPDATE_DOCS=1 cargo test docs` rewrites the generated parts: the tables of the scene format, the
//! verdict, the JSON and the pictures of the README, and texts, tables and pictures of the chapters.

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

use dashpot::{
    dae::methods,
    scene::{ReadOptions, read, templates, units::parse_quantity},
};

mod chapters;
mod cost;
mod equivalent_models;
mod gallery;
mod laws;
mod readme;
mod registers;
mod separation;
mod shown;
mod third_party;

/// Said of what the program has left behind.
const OUTDATED: &str = "out of date; run UPDATE_DOCS=1 cargo test docs, and look at the changes";

/// Whether documents are to be brought up to date.
fn is_update() -> bool {
    std::env::var_os("UPDATE_DOCS").is_some()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn text(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// All files of Rust in a folder, relative to the root.
fn sources(folder: &str) -> Vec<PathBuf> {
    let (mut all, mut folders) = (Vec::new(), vec![PathBuf::from(folder)]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root().join(&folder)).unwrap() {
            let path = folder.join(entry.unwrap().file_name());
            if root().join(&path).is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                all.push(path);
            }
        }
    }
    all
}

/// All documents in Markdown, relative to the root.
fn documents() -> Vec<PathBuf> {
    let mut all = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"]
        .map(PathBuf::from)
        .to_vec();
    let mut folders = vec![PathBuf::from("docs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(root().join(&folder)).unwrap() {
            let path = folder.join(entry.unwrap().file_name());
            if root().join(&path).is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "md") {
                all.push(path);
            }
        }
    }
    all
}

/// The lines outside of code blocks, and the code blocks with the words after their fence.
fn parted(text: &str) -> (Vec<&str>, Vec<(&str, String)>) {
    let (mut prose, mut blocks) = (Vec::new(), Vec::new());
    let mut open: Option<(&str, String)> = None;
    for line in text.lines() {
        match (line.trim_start().strip_prefix("```"), &mut open) {
            (Some(words), None) => open = Some((words, String::new())),
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (None, Some((_, block))) => block.extend([line, "\n"]),
            (None, None) => prose.push(line),
        }
    }
    assert!(open.is_none(), "a code block has no end");
    (prose, blocks)
}

fn blocks(path: &str, words: &str) -> Vec<String> {
    let text = text(path);
    let blocks = parted(&text).1.into_iter();
    blocks.filter(|(own, _)| *own == words).map(|(_, block)| block).collect()
}

/// What stands between `before` and `after` in a line, wherever it does.
fn between<'t>(line: &'t str, before: &str, after: char) -> Vec<&'t str> {
    line.split(before)
        .skip(1)
        .filter_map(|rest| rest.split_once(after))
        .map(|(own, _)| own)
        .collect()
}

/// The arguments of a command line; those with blanks in them stand in quotes.
fn arguments(command: &str) -> Vec<&str> {
    let parts = command.split('"').enumerate().flat_map(|(at, part)| match at % 2 {
        0 => part.split_whitespace().collect(),
        _ => vec![part],
    });
    parts.collect()
}

/// The anchor that a heading gets.
fn anchor(heading: &str) -> String {
    let kept = |c: &char| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_');
    let slug: String = heading.trim().to_lowercase().chars().filter(kept).collect();
    slug.replace(' ', "-")
}

#[test]
fn the_generated_tables_are_those_of_the_registers() {
    let path = "docs/scene-format.md";
    let old = text(path);
    let mut new = String::new();
    let mut rest = old.as_str();
    let mut sections = registers::sections();
    while let Some((before, after)) = rest.split_once("<!-- generated: ") {
        let (name, after) = after.split_once(" -->\n").unwrap();
        let (_, after) = after.split_once("<!-- end -->").unwrap();
        let at = sections.iter().position(|section| section.0 == name);
        let (_, table) = sections.remove(at.unwrap_or_else(|| panic!("no register `{name}`")));
        new.extend([before, "<!-- generated: ", name, " -->\n", table.as_str(), "<!-- end -->"]);
        rest = after;
    }
    new += rest;
    assert!(sections.is_empty(), "`{}` is missing in {path}", sections[0].0);
    if is_update() {
        fs::write(root().join(path), &new).unwrap();
    } else {
        let differs = old.lines().zip(new.lines()).find(|(old, new)| old != new);
        assert!(old == new, "{path} is {OUTDATED}: {differs:?}");
    }
}

#[test]
fn every_relative_link_leads_to_a_file_and_a_heading_in_it() {
    for document in documents() {
        let text = text(&document);
        for line in parted(&text).0 {
            for target in between(line, "](", ')') {
                if target.contains("://") {
                    continue;
                }
                let (file, heading) = target.split_once('#').unwrap_or((target, ""));
                let folder = document.parent().unwrap();
                let file = if file.is_empty() { document.clone() } else { folder.join(file) };
                let place = format!("{} links to {target}", document.display());
                assert!(root().join(&file).exists(), "{place}, which does not exist");
                if !heading.is_empty() {
                    let other = self::text(&file);
                    let mut headings = parted(&other).0.into_iter().filter(|l| l.starts_with('#'));
                    let found = headings.any(|own| anchor(own.trim_start_matches('#')) == heading);
                    assert!(found, "{place}, where that heading is missing");
                }
            }
        }
    }
}

#[test]
fn the_tables_of_nodes_and_of_runs_have_every_key_of_the_schema() {
    let schema = dashpot::scene::schema();
    let page = text("docs/scene-format.md");
    for (heading, part) in [("## Nodes", "/$defs/node"), ("## Run", "/properties/run")] {
        let section = page.split(&format!("\n{heading}\n")).nth(1).unwrap();
        let section = section.split("\n## ").next().unwrap();
        let keys = schema.pointer(&format!("{part}/properties")).unwrap().as_object().unwrap();
        for key in keys.keys() {
            assert!(section.contains(&format!("| `{key}` |")), "{heading} lacks `{key}`");
        }
    }
}

#[test]
fn every_citation_is_in_the_list_of_references() {
    let list = text("docs/references.bib");
    let keys = list.lines().filter_map(|line| line.strip_prefix('@')?.split_once('{'));
    let keys: BTreeSet<&str> = keys.map(|(_, key)| key.trim_end_matches(',')).collect();
    for document in documents() {
        let text = text(&document);
        for line in parted(&text).0 {
            for cited in between(line, "[@", ']') {
                let key = cited.split(',').next().unwrap();
                assert!(keys.contains(key), "{} cites `{key}`", document.display());
            }
        }
    }
}

#[test]
fn whole_scenes_in_documents_are_valid_and_without_warnings() {
    let mut count = 0;
    for document in ["README.md", "docs/scene-format.md"] {
        for scene in blocks(document, "toml") {
            let options = ReadOptions { file: Some(document), ..ReadOptions::default() };
            let scene = read(&scene, &options).unwrap_or_else(|faults| panic!("{faults}"));
            assert!(scene.warnings.is_empty(), "{}", scene.warnings);
            count += 1;
        }
    }
    assert!(count >= 2);
}

#[test]
fn fragments_in_the_description_of_scenes_make_one_valid_scene() {
    let path = "docs/scene-format.md";
    let whole = blocks(path, "toml fragment").concat();
    let options = ReadOptions { file: Some(path), ..ReadOptions::default() };
    let scene = read(&whole, &options).unwrap_or_else(|faults| panic!("{whole}\n{faults}"));
    assert!(scene.warnings.is_empty(), "{}", scene.warnings);
}

#[test]
fn every_unit_in_the_description_of_scenes_is_read() {
    let text = text("docs/scene-format.md");
    let (_, section) = text.split_once("### Symbols\n").unwrap();
    let table: Vec<&str> =
        section.lines().skip(1).take_while(|line| !line.starts_with('#')).collect();
    let mut count = 0;
    for line in table.into_iter().filter(|line| line.starts_with("| ")) {
        let symbols = line.split('|').nth(2).unwrap_or_default();
        for unit in symbols.split('`').skip(1).step_by(2) {
            assert!(parse_quantity(&format!("1 {unit}")).is_ok(), "`{unit}` is not read");
            count += 1;
        }
    }
    assert!(count > 15);
}

#[test]
fn decisions_are_numbered_without_gaps_and_listed() {
    let mut numbers = Vec::new();
    let list = text("docs/decisions/README.md");
    for entry in fs::read_dir(root().join("docs/decisions")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name != "README.md" {
            numbers.push(name[..3].parse::<usize>().unwrap());
            assert!(list.contains(&format!("({name})")), "{name} is not in the list");
        }
    }
    numbers.sort_unstable();
    assert_eq!(numbers, (1..=numbers.len()).collect::<Vec<_>>());
}

#[test]
fn the_description_of_methods_names_each_of_them() {
    let text = text("docs/methods.md");
    for method in methods::all() {
        assert!(text.contains(&format!("`{}`", method.name())), "`{}` is missing", method.name());
    }
}

#[test]
fn the_architecture_fits_on_two_hundred_lines() {
    assert!(text("ARCHITECTURE.md").lines().count() <= 200);
}

#[test]
fn templates_that_the_readme_names_exist() {
    let text = text("README.md");
    for template in templates() {
        assert!(text.contains(&format!("`{}`", template.name)), "`{}`", template.name);
    }
}
