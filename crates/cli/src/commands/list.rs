//! `dashpot list`.

use std::fmt::Write as _;

use dashpot_scene::{Shipped, references, templates};

use crate::{
    args::{Family, ListArguments},
    error::{CliError, Status},
    registers::{Entry, entries},
    terminal::{Terminal, Tone, WIDTH, print},
    text::{columns, wrapped},
};

/// All families, in the order in which they are listed.
const FAMILIES: [(Family, &str); 8] = [
    (Family::Elements, "Elements: laws between two nodes, composed by `series` and `parallel`"),
    (Family::Forms, "Forms: models by name, composed of springs and dashpots"),
    (Family::Waveforms, "Waveforms: functions of time for `force` and `motion`"),
    (Family::Effects, "Effects: off unless they are named in [effects]"),
    (Family::Measures, "Measures: numbers read off a run; * marks those that every run reports"),
    (Family::Methods, "Methods: ways to solve, for `--method` and `methods` in [run]"),
    (Family::Templates, "Templates: scenes to start from, by `dashpot new NAME`"),
    (Family::Scenes, "Scenes: built in, for `dashpot run NAME`"),
];

/// What the parameter of that name is, which most measures have.
const WINDOW: &str = "`impact` (default), `run`, or a pair of times";

/// Prints every kind of one family, or of all.
pub(crate) fn list(arguments: &ListArguments, terminal: Terminal) -> Result<Status, CliError> {
    let wanted = |family: Family| arguments.family.is_none_or(|only| only == family);
    let mut text = String::new();
    for (family, title) in FAMILIES.into_iter().filter(|(family, _)| wanted(*family)) {
        if !text.is_empty() {
            text.push('\n');
        }
        let _ = writeln!(text, "{}", terminal.toned(Tone::Heading, title));
        let entries = match family {
            Family::Templates => templates().iter().map(shipped).collect(),
            Family::Scenes => references().iter().map(shipped).collect(),
            family => entries(family),
        };
        let widest = entries.iter().map(|entry| columns(&entry.name)).max().unwrap_or(0);
        entries.iter().for_each(|entry| text += &described(entry, widest));
        if family == Family::Measures {
            let _ = writeln!(text, "  A `window` is {WINDOW}.");
        }
    }
    print(&text)?;
    Ok(Status::Done)
}

fn shipped(shipped: &Shipped) -> Entry {
    Entry::plain(shipped.name, shipped.summary)
}

fn described(entry: &Entry, widest: usize) -> String {
    let mut text = String::new();
    let room = WIDTH - widest - 4;
    for (at, line) in wrapped(&entry.summary, room).iter().enumerate() {
        let name = if at == 0 { entry.name.as_str() } else { "" };
        let _ = writeln!(text, "  {name:widest$}  {line}");
    }
    if let Some(example) = &entry.example {
        let _ = writeln!(text, "      {example}");
    }
    for detail in &entry.details {
        for (at, line) in wrapped(detail, WIDTH - 10).iter().enumerate() {
            let indent = if at == 0 { "" } else { "  " };
            let _ = writeln!(text, "      {indent}{line}");
        }
    }
    text
}
