//! `dashpot list`.

use std::fmt::Write as _;

use clap::ValueEnum;
use dashpot_scene::{Shipped, references, templates};

use crate::{
    args::{Family, ListArguments},
    error::{CliError, Status},
    registers::{Entry, entries},
    terminal::Tone,
    terminal::{Terminal, WIDTH, print},
    text::{columns, wrapped},
};

/// All families, in the order in which they are listed.
const FAMILIES: [(Family, &str); 11] = [
    (Family::Elements, "Elements: laws between two nodes, composed by `series` and `parallel`"),
    (Family::Forms, "Forms: models by name, composed of springs and dashpots"),
    (Family::Composites, "Composites: models that a few numbers describe as a whole"),
    (Family::Shifts, "Shifts: for `shift` beside the law of a model; they multiply all its times"),
    (Family::Waveforms, "Waveforms: functions of time for `force`, `motion` and `acceleration`"),
    (Family::Effects, "Effects: off unless they are named in [effects]"),
    (Family::Measures, "Measures: numbers read off a run; * marks those that every run reports"),
    (Family::Methods, "Methods: ways to solve, for `--method` and `methods` in [run]"),
    (Family::Tests, "Tests: of a model alone, by `dashpot rheometer --test NAME`"),
    (Family::Templates, "Templates: scenes to start from, by `dashpot new NAME`"),
    (Family::Scenes, "Scenes: built in, for `dashpot run NAME`"),
];

/// What the parameter of that name is, which most measures have.
const WINDOW: &str = "`impact` (default), `run`, or a pair of times";

/// Prints every kind of one family, or of all, or one kind alone.
pub(crate) fn list(arguments: &ListArguments, terminal: Terminal) -> Result<Status, CliError> {
    let word = arguments.what.as_deref();
    let only = word.and_then(|word| Family::from_str(word, true).ok());
    let kind = word.filter(|_| only.is_none());
    let mut text = String::new();
    for (family, title) in FAMILIES.into_iter().filter(|own| only.is_none_or(|only| only == own.0))
    {
        let mut entries = match family {
            Family::Templates => templates().iter().map(shipped).collect(),
            Family::Scenes => references().iter().map(shipped).collect(),
            family => entries(family),
        };
        if let Some(kind) = kind {
            entries.retain(|entry| is_called(entry, kind));
            if entries.is_empty() {
                continue;
            }
        }
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, title));
        let widest = entries.iter().map(|entry| columns(&entry.name)).max().unwrap_or(0);
        entries.iter().for_each(|entry| text += &described(entry, widest));
        if family == Family::Measures {
            let _ = writeln!(text, "  A `window` is {WINDOW}.");
        }
    }
    match kind.filter(|_| text.is_empty()) {
        Some(kind) => Err(CliError::UnknownKind { word: kind.to_owned() }),
        None => print(&text).map(|()| Status::Done),
    }
}

/// Whether this is a word for the entry; the mark of those that every run reports is none of it.
fn is_called(entry: &Entry, word: &str) -> bool {
    entry.name.trim_end_matches('*') == word || entry.aliases.contains(&word)
}

fn shipped(shipped: &Shipped) -> Entry {
    Entry::plain(shipped.name, shipped.summary)
}

/// The text of a scene in lines of at most `room` columns, broken behind commas, where it may be read in
/// so.
fn parted(example: &str, room: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for part in example.split_inclusive(", ") {
        let last = lines.len() - 1;
        if !lines[last].is_empty() && columns(&lines[last]) + columns(part.trim_end()) > room {
            lines.push(String::new());
        }
        let last = lines.len() - 1;
        lines[last] += part;
    }
    lines.iter().map(|line| line.trim_end().to_owned()).collect()
}

fn described(entry: &Entry, widest: usize) -> String {
    let mut text = String::new();
    let room = WIDTH - widest - 4;
    for (at, line) in wrapped(&entry.summary, room).iter().enumerate() {
        let name = if at == 0 { entry.name.as_str() } else { "" };
        let _ = writeln!(text, "  {name:widest$}  {line}");
    }
    if let Some(example) = &entry.example {
        for (at, line) in parted(example, WIDTH - 10).iter().enumerate() {
            let indent = if at == 0 { "" } else { "  " };
            let _ = writeln!(text, "      {indent}{line}");
        }
    }
    for detail in &entry.details {
        for (at, line) in wrapped(detail, WIDTH - 10).iter().enumerate() {
            let indent = if at == 0 { "" } else { "  " };
            let _ = writeln!(text, "      {indent}{line}");
        }
    }
    text
}
