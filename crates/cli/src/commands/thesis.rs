//! `dashpot thesis`.

use std::fmt::Write as _;

use dashpot_thesis::{NumberVerdict, Recomputation};

use crate::{
    answer::thesis::Document,
    args::ThesisArguments,
    error::{CliError, Status},
    folder::Folder,
    shown::Tone,
    terminal::{Terminal, WIDTH, print, print_data},
    text::{labelled, wrapped},
    thesis_folder::{file_names, write},
};

/// Columns of the equations' numbers.
const PLACE: usize = 13;

/// Recomputes the thesis.
pub(crate) fn thesis(arguments: &ThesisArguments, terminal: Terminal) -> Result<Status, CliError> {
    let folder = Folder::wanted(arguments.out.as_deref(), file_names())?;
    let all = Recomputation::new()?;
    let json = serde_json::to_string_pretty(&Document::of(&all))? + "\n";
    if arguments.json {
        print_data(&json)?;
    } else {
        print(&text(&all, terminal))?;
    }
    if let Some(folder) = folder {
        folder.write(|files| write(files, &all), &json, arguments.json)?;
    }
    Ok(Status::Done)
}

fn text(all: &Recomputation, terminal: Terminal) -> String {
    let mut text = String::new();
    for line in all.summary().iter().flat_map(|own| wrapped(own, WIDTH)) {
        let _ = writeln!(text, "{line}");
    }
    let heading = |text: &mut String, words: &str| {
        let _ = writeln!(text, "\n{}", terminal.toned(Tone::Heading, words));
    };
    heading(&mut text, "Numbers of the text, without those that are given");
    for own in all.numbers.iter().filter(|own| own.verdict != NumberVerdict::Given) {
        let words = format!(
            "{}: printed {}, recomputed {}: {}",
            own.what,
            own.printed,
            own.recomputed,
            own.verdict.text()
        );
        text += &labelled(own.place, PLACE, &words, WIDTH);
    }
    heading(&mut text, "Claims");
    for own in &all.claims {
        let words = format!("{}: {}. {}", own.says, own.verdict.text(), own.finding);
        text += &labelled(own.place, PLACE, &words, WIDTH);
    }
    text
}
