//! The gallery shows every scene of the folder, with what comes out and what it costs.

use std::{collections::BTreeSet, fs};

use dashpot::analysis::RunReport;

use super::{OUTDATED, is_update, root, shown::check, text};
use crate::gallery::runs;

const CHAPTER: &str = "docs/gallery.md";

/// The scenes that the gallery shows, in its order: the files behind its headings.
fn scenes() -> Vec<String> {
    let chapter = text(CHAPTER);
    let lines = chapter.lines().filter_map(|line| line.strip_prefix("[The scene](../scenes/"));
    lines.filter_map(|rest| rest.split_once(".toml)")).map(|(name, _)| name.to_owned()).collect()
}

#[test]
fn the_gallery_shows_what_the_command_prints_and_draws_and_what_it_costs() {
    let (texts, figures) = check(CHAPTER);
    let scenes = scenes();
    assert!(scenes.len() >= 10, "{scenes:?}");
    assert!(texts == scenes.len() && figures == scenes.len(), "{texts} texts, {figures} figures");
    // After the texts, as both may write to the chapter.
    check_costs();
}

#[test]
fn every_scene_is_in_the_gallery_or_in_the_chapter_on_separation() {
    let other = text("docs/separation-and-thickness.md");
    let shown: BTreeSet<String> = scenes().into_iter().collect();
    for entry in fs::read_dir(root().join("scenes")).unwrap() {
        let file = entry.unwrap().file_name().into_string().unwrap();
        let Some(name) = file.strip_suffix(".toml") else { continue };
        let is_known = shown.contains(name) || other.contains(&format!("scenes/{file}"));
        assert!(is_known, "{file} is shown nowhere");
    }
}

/// What a scene costs by one method; "–" where a method has no such thing.
fn cells(run: &RunReport) -> [String; 3] {
    let work = &run.solver.statistics;
    let count = |count: usize| if count == 0 { "–".to_owned() } else { count.to_string() };
    let solves = 1 + run.solver.solves_for_error;
    [run.solver.method.to_owned(), count(work.accepted), solves.to_string()]
}

/// The table of costs, one row for each scene and method.
fn costs() -> String {
    let mut table = String::from(
        "| scene | effects | unknowns | modes | switchings | method | steps | solves |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    for name in scenes() {
        for (at, run) in runs(&name, |text| text).iter().enumerate() {
            let [method, steps, solves] = cells(run);
            let effects = match run.system.effects.join(", ") {
                none if none.is_empty() => "none".to_owned(),
                some => some,
            };
            let size = run.system.states + run.system.algebraic;
            let (modes, switchings) = (run.system.modes, run.trajectory.switches.len());
            let first = match at {
                0 => format!("`{name}` | {effects} | {size} | {modes} | {switchings}"),
                _ => " | | | |".to_owned(),
            };
            let row = [first, format!("`{method}`"), steps, solves].join(" | ");
            table.extend(["| ", &row, " |\n"]);
        }
    }
    table
}

/// Holds the table of costs against the runs, or brings it up to date.
fn check_costs() {
    let chapter = text(CHAPTER);
    let (before, rest) = chapter.split_once("<!-- generated: costs -->\n").unwrap();
    let (old, after) = rest.split_once("<!-- end -->").unwrap();
    let new = costs();
    if is_update() {
        let all = format!("{before}<!-- generated: costs -->\n{new}<!-- end -->{after}");
        fs::write(root().join(CHAPTER), all).unwrap();
        return;
    }
    // Numbers of steps may differ a little where rounding does.
    assert_eq!(old.lines().count(), new.lines().count(), "{OUTDATED}");
    for (old, new) in old.lines().zip(new.lines()) {
        for (one, other) in old.split('|').zip(new.split('|')) {
            match (one.trim().parse::<f64>(), other.trim().parse::<f64>()) {
                (Ok(one), Ok(other)) => {
                    assert!((one - other).abs() <= 2.0 + 0.1 * one, "{old}\n{new}\n{OUTDATED}");
                }
                _ => assert_eq!(one, other, "{OUTDATED}"),
            }
        }
    }
}
