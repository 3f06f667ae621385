//! What the README shows is what the command prints.

use std::{fs, path::Path, process::Command};

use serde_json::Value;

use super::{OUTDATED, arguments, blocks, is_update, root, shown::labels, text};

fn printed(arguments: &[&str], folder: &Path) -> String {
    let command =
        Command::new(env!("CARGO_BIN_EXE_dashpot")).args(arguments).current_dir(folder).output();
    let output = command.unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", text(output.stderr));
    text(output.stdout)
}

/// The words of each line but the errors in percent, which differ by rounding between machines.
fn words(text: &str) -> Vec<String> {
    let kept = |line: &str| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_error = |at: usize| words.get(at + 1).is_some_and(|next| next.starts_with('%'));
        let kept =
            words.iter().enumerate().filter(|(at, word)| !is_error(*at) && !word.contains('%'));
        kept.map(|(_, word)| *word).collect::<Vec<_>>().join(" ")
    };
    text.lines().map(kept).collect()
}

/// Replaces the first code block of this kind.
fn replace(document: &mut String, kind: &str, block: &str) {
    let fence = format!("```{kind}\n");
    let (before, rest) = document.split_once(&fence).unwrap();
    let (_, after) = rest.split_once("\n```\n").unwrap();
    *document = format!("{before}{fence}{}\n```\n{after}", block.trim_end());
}

#[test]
fn what_is_shown_is_what_the_command_prints() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let all = printed(&["run", "--out", "results"], folder);
    // How it was solved, and what was written, is left out.
    let verdict = all.split("\n\n  method ").next().unwrap();
    fs::write(folder.join("pad.toml"), &blocks("README.md", "toml")[0]).unwrap();
    let answer: Value =
        serde_json::from_str(&printed(&["run", "pad.toml", "--json"], folder)).unwrap();
    let measure = &answer["runs"][0]["measures"]["liner.peak-force"];
    let figures = ["network.svg", "force-time.svg"];
    let drawings =
        figures.map(|name| fs::read_to_string(folder.join("results").join(name)).unwrap());
    let pictures = root().join("docs/figures");
    if is_update() {
        let mut readme = text("README.md");
        replace(&mut readme, "text", verdict);
        // The order of the keys is the program's; that of the object that was read is not.
        if serde_json::from_str::<Value>(&blocks("README.md", "json")[0]).ok().as_ref()
            != Some(measure)
        {
            replace(&mut readme, "json", &serde_json::to_string_pretty(measure).unwrap());
        }
        fs::write(root().join("README.md"), readme).unwrap();
        for (name, drawing) in figures.iter().zip(&drawings) {
            fs::write(pictures.join(name), drawing).unwrap();
        }
        return;
    }
    assert_eq!(words(&blocks("README.md", "text")[0]), words(verdict), "{OUTDATED}");
    let shown: Value = serde_json::from_str(&blocks("README.md", "json")[0]).unwrap();
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&shown), keys(measure), "{OUTDATED}");
    for key in ["value", "time"] {
        let (found, shown) = (measure[key].as_f64().unwrap(), shown[key].as_f64().unwrap());
        assert!((found - shown).abs() <= 1e-9 * shown, "{key}: {found} and {shown}, {OUTDATED}");
    }
    for (name, drawing) in figures.iter().zip(&drawings) {
        let picture = fs::read_to_string(pictures.join(name)).unwrap();
        assert_eq!(labels(&picture), labels(drawing), "{name}: {OUTDATED}");
    }
}

#[test]
fn the_commands_of_the_first_scene_succeed() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pad.toml"), &blocks("README.md", "toml")[0]).unwrap();
    let lines = blocks("README.md", "console").concat();
    let mut count = 0;
    for line in lines.lines().filter_map(|line| line.strip_prefix("dashpot ")) {
        let command = line.split(['#', '|']).next().unwrap_or_default().trim();
        printed(&arguments(&command.replace(",99999\"", ",999\"")), folder.path());
        count += 1;
    }
    assert!(count >= 5);
}
