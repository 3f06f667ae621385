//! What the README shows is what the command prints.

use std::{fs, path::Path, process::Command};

use serde_json::Value;

use super::blocks;

fn printed(arguments: &[&str], folder: &Path) -> String {
    let command =
        Command::new(env!("CARGO_BIN_EXE_dashpot")).args(arguments).current_dir(folder).output();
    let output = command.unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", text(output.stderr));
    text(output.stdout)
}

/// The words of each line but the errors in percent, which differ by rounding between machines, and
/// the times that solving takes.
fn words(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let mut is_timed = false;
    for line in text.lines() {
        is_timed |= line.contains("rtol");
        let words: Vec<&str> = line.split_whitespace().collect();
        let is_error = |at: usize| words.get(at + 1).is_some_and(|next| next.starts_with('%'));
        let kept =
            words.iter().enumerate().filter(|(at, word)| !(is_error(*at) || word.contains('%')));
        if !is_timed {
            lines.push(kept.map(|(_, word)| *word).collect::<Vec<_>>().join(" "));
        }
    }
    lines
}

#[test]
fn the_verdict_is_the_one_that_the_first_command_prints() {
    let shown = blocks("README.md", "text").remove(0);
    let folder = tempfile::tempdir().unwrap();
    let (shown, printed) = (words(&shown), words(&printed(&["run"], folder.path())));
    assert!(shown.len() > 10);
    for line in shown {
        assert!(printed.contains(&line), "`{line}` is not printed");
    }
}

#[test]
fn the_answer_in_json_is_that_of_the_first_scene() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pad.toml"), &blocks("README.md", "toml")[0]).unwrap();
    let answer: Value =
        serde_json::from_str(&printed(&["run", "pad.toml", "--json"], folder.path())).unwrap();
    let found = &answer["runs"][0]["measures"]["liner.peak-force"];
    let shown: Value = serde_json::from_str(&blocks("README.md", "json")[0]).unwrap();
    let keys = |value: &Value| value.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(found), keys(&shown));
    for key in ["value", "time"] {
        let (found, shown) = (found[key].as_f64().unwrap(), shown[key].as_f64().unwrap());
        assert!((found - shown).abs() <= 1e-9 * shown, "{key}: {found} and {shown}");
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
        // One argument stands in quotes and has a blank in it.
        let arguments: Vec<&str> = command
            .split('"')
            .enumerate()
            .flat_map(|(at, part)| match at % 2 {
                0 => part.split_whitespace().collect(),
                _ => vec![part],
            })
            .collect();
        printed(&arguments, folder.path());
        count += 1;
    }
    assert!(count >= 5);
}
