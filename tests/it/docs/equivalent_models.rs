//! The chapter on equivalent models shows what the command prints.
//!
//! A code block `toml NAME` is a file of this name. A block `console` holds commands, which run in
//! the folder of the files, in the order of the text. A block `text shown` after it is what they
//! print: standard output, or the message where the input is refused. A line `…` in it stands for
//! what is left out.

use std::{fs, path::Path, process::Command};

use super::{OUTDATED, arguments, blocks, is_update, parted, root, text};

const CHAPTER: &str = "docs/equivalent-models.md";
/// Stands for lines that are left out.
const LEFT_OUT: &str = "…";

/// What the commands of a block print. Models that differ and input that is refused have exit codes
/// of their own; a run that fails must not be in the chapter.
fn printed(commands: &str, folder: &Path) -> String {
    let mut all = String::new();
    for command in commands.lines() {
        let words = command.strip_prefix("dashpot ").unwrap_or_else(|| panic!("`{command}`"));
        let mut dashpot = Command::new(env!("CARGO_BIN_EXE_dashpot"));
        let output = dashpot.args(arguments(words)).current_dir(folder).output().unwrap();
        let [out, err] =
            [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        match output.status.code() {
            Some(0 | 3) => all += &out,
            Some(2) => all += &err,
            code => panic!("`{command}` ends with {code:?}: {err}"),
        }
    }
    all
}

/// The words but those of shares in percent, which differ by rounding between machines.
fn words(text: &str) -> Vec<&str> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let is_share = |at: usize| words[at].contains('%');
    let is_kept = |at: &usize| !is_share(*at) && (at + 1 == words.len() || !is_share(at + 1));
    (0..words.len()).filter(is_kept).map(|at| words[at]).collect()
}

/// The first of the pieces of `shown` that `printed` does not have, in their order.
fn missing<'t>(shown: &'t str, printed: &str) -> Option<&'t str> {
    let printed = words(printed);
    let pieces: Vec<&str> = shown.split(LEFT_OUT).collect();
    let mut at = 0;
    for (number, piece) in pieces.iter().enumerate() {
        let own = words(piece);
        let is_here = |from: &usize| printed[*from..].starts_with(&own);
        let found = if number == 0 {
            Some(0).filter(is_here)
        } else if number + 1 == pieces.len() {
            printed.len().checked_sub(own.len()).filter(|from| *from >= at).filter(is_here)
        } else {
            (at..=printed.len()).find(is_here)
        };
        match found {
            Some(from) => at = from + own.len(),
            None => return Some(piece),
        }
    }
    (pieces.len() == 1 && at < printed.len()).then_some(shown)
}

#[test]
fn the_chapter_on_equivalent_models_shows_what_the_command_prints() {
    let folder = tempfile::tempdir().unwrap();
    let mut chapter = text(CHAPTER);
    let (mut output, mut count) = (String::new(), 0);
    for (kind, block) in parted(&text(CHAPTER)).1 {
        match kind.split_once(' ') {
            Some(("toml", name)) => fs::write(folder.path().join(name), block).unwrap(),
            None if kind == "console" => output = printed(&block, folder.path()),
            Some(("text", "shown")) => {
                if is_update() && !block.contains(LEFT_OUT) {
                    let fenced =
                        |content: &str| format!("```{kind}\n{}\n```\n", content.trim_end());
                    assert!(chapter.contains(&fenced(&block)));
                    chapter = chapter.replacen(&fenced(&block), &fenced(&output), 1);
                } else {
                    let missing = missing(&block, &output);
                    assert!(missing.is_none(), "{missing:?} in\n{output}\n{CHAPTER} is {OUTDATED}");
                }
                count += 1;
            }
            _ => {}
        }
    }
    assert!(count >= 8, "{count}");
    if is_update() {
        fs::write(root().join(CHAPTER), chapter).unwrap();
    }
}

#[test]
fn a_fibre_takes_as_many_elements_as_the_chapter_says() {
    let chapter = text(CHAPTER);
    let row = |start: &str| -> Vec<&str> {
        let line = chapter.lines().find(|line| line.starts_with(start)).unwrap();
        line.split('|').skip(2).map(str::trim).filter(|cell| !cell.is_empty()).collect()
    };
    let [scene] = &blocks(CHAPTER, "toml fibre-padding.toml")[..] else { panic!("no such scene") };
    let folder = tempfile::tempdir().unwrap();
    let (errors, counts) = (row("| `error` |"), row("| Kelvin elements |"));
    assert!(errors.len() == counts.len() && counts.len() >= 4);
    for (error, count) in errors.iter().zip(counts) {
        assert!(scene.contains("\"0.002 %\""));
        let other = scene.replace("0.002 %", error);
        fs::write(folder.path().join("fibre.toml"), other).unwrap();
        let said = printed("dashpot explain fibre.toml", folder.path());
        assert!(
            said.contains(&format!("`fibre`: {count} Kelvin elements keep")),
            "{error}: {said}"
        );
    }
}

#[test]
fn what_is_missing_in_an_excerpt_is_found() {
    let printed = "one two\nthree 4 % four\nfive\n";
    for good in ["one two three 5 % four five", "one two\n…\nfive", "…\nfour\n…", "one\n…"]
    {
        assert_eq!(missing(good, printed), None, "{good}");
    }
    for bad in ["one two", "one\n…\ntwo three", "two\n…", "…\nfive\nfour\n…", "…\nsix\n…\nfive"]
    {
        assert!(missing(bad, printed).is_some(), "{bad}");
    }
}
