//! Chapters that show what the command prints.
//!
//! A code block `toml NAME` is a file of this name; the scenes of the repository are in the folder
//! `scenes`, and the folder `data` beside the chapter, if there is one, in `data`. A block `console` holds commands, which run in the order of the text. A block `text shown`
//! after it is what they print: standard output, or the message where the input is refused. A line `…`
//! in it stands for what is left out. `text verdict` is the same up to the table of measures, and `text
//! report` up to what it took.
//!
//! The comment `<!-- figure: FOLDER/NAME.svg -->` names what the commands have drawn; the picture in the
//! next line of the text is a copy of it.

use std::{fs, path::Path, process::Command};

use super::{OUTDATED, arguments, between, is_update, parted, root, text};

/// Stands for lines that are left out.
const LEFT_OUT: &str = "…";

/// What the commands of a block print. Models that differ and input that is refused have exit codes
/// of their own; a run that fails must not be in a chapter.
pub(super) fn printed(commands: &str, folder: &Path) -> String {
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

/// The part of a report that a kind of block shows.
fn part<'t>(kind: &str, output: &'t str) -> Option<&'t str> {
    let until: &[&str] = match kind {
        "shown" => return Some(output),
        "verdict" => &["  measure"],
        "report" => &["  method ", "  design "],
        _ => return None,
    };
    // The paragraph in which a line begins so does not belong to it.
    let is_next =
        |own: &&str| own.lines().any(|line| until.iter().any(|own| line.starts_with(own)));
    let kept = output.split("\n\n").take_while(|own| !is_next(own));
    let length = kept.map(|own| own.len() + 2).sum::<usize>().saturating_sub(2);
    output.get(..length.min(output.len()))
}

/// The texts in a drawing.
pub(super) fn labels(drawing: &str) -> Vec<&str> {
    let texts = drawing.split("<text ").skip(1).filter_map(|text| text.split_once('>'));
    texts.filter_map(|(_, rest)| rest.split_once('<')).map(|(label, _)| label.trim()).collect()
}

/// Copies the files that a chapter reads, where there are any.
fn copy_data(from: &Path, to: &Path) {
    let Ok(entries) = fs::read_dir(from) else { return };
    fs::create_dir(to).unwrap();
    for entry in entries.map(Result::unwrap) {
        fs::copy(entry.path(), to.join(entry.file_name())).unwrap();
    }
}

/// Holds a chapter against what its commands print and draw, or brings it up to date. The numbers of
/// texts and of figures that it shows.
pub(super) fn check(path: &str) -> (usize, usize) {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("scenes")).unwrap();
    for entry in fs::read_dir(root().join("scenes")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), folder.path().join("scenes").join(entry.file_name())).unwrap();
    }
    copy_data(&root().join(path).with_file_name("data"), &folder.path().join("data"));
    let mut chapter = text(path);
    let (mut output, mut count) = (String::new(), 0);
    for (kind, block) in parted(&text(path)).1 {
        match kind.split_once(' ') {
            Some(("toml", name)) => fs::write(folder.path().join(name), block).unwrap(),
            None if kind == "console" => output = printed(&block, folder.path()),
            Some(("text", what)) => {
                let Some(output) = part(what, &output) else { continue };
                if is_update() && !block.contains(LEFT_OUT) {
                    let fenced =
                        |content: &str| format!("```{kind}\n{}\n```\n", content.trim_end());
                    assert!(chapter.contains(&fenced(&block)), "a block of {path}:\n{block}");
                    chapter = chapter.replacen(&fenced(&block), &fenced(output), 1);
                } else {
                    let missing = missing(&block, output);
                    assert!(missing.is_none(), "{missing:?} in\n{output}\n{path} is {OUTDATED}");
                }
                count += 1;
            }
            _ => {}
        }
    }
    if is_update() {
        fs::write(root().join(path), chapter).unwrap();
    }
    (count, check_figures(path, folder.path()))
}

/// Holds the pictures of a chapter against those in `folder`; their number.
fn check_figures(path: &str, folder: &Path) -> usize {
    let chapter = text(path);
    let beside = root().join(path).parent().unwrap().to_owned();
    let mut count = 0;
    let mut lines = parted(&chapter).0.into_iter().filter(|line| !line.is_empty());
    while let Some(line) = lines.next() {
        let [from] = between(line, "<!-- figure: ", ' ')[..] else { continue };
        let [to] = between(lines.next().unwrap_or_default(), "](", ')')[..] else {
            panic!("{path}: no picture after {from}");
        };
        let drawing = fs::read_to_string(folder.join(from))
            .unwrap_or_else(|error| panic!("{path}: {from}: {error}"));
        let picture = beside.join(to);
        if is_update() {
            fs::create_dir_all(picture.parent().unwrap()).unwrap();
            fs::write(picture, drawing).unwrap();
        } else {
            let shown = fs::read_to_string(&picture).unwrap();
            assert_eq!(labels(&shown), labels(&drawing), "{path}, {to}: {OUTDATED}");
        }
        count += 1;
    }
    count
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
