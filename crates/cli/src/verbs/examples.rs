//! Examples in the help of verbs: a command that is wider than a terminal goes on in further lines, as shells read it.

use clap::Command;

use crate::terminal::WIDTH;
use dashpot_report::layout::columns;

/// What stands before a command, and before its further lines.
const INDENT: &str = "  ";
const FURTHER: &str = "    ";

/// A verb with the commands of its help on lines that a terminal has room for.
pub(super) fn on_lines(verb: Command) -> Command {
    let Some(text) = verb.get_after_help().map(ToString::to_string) else { return verb };
    let is_wide = |line: &&str| line.starts_with(INDENT) && columns(line) > WIDTH;
    let lines = text.lines().map(|own| Some(own).filter(is_wide).map_or(own.to_owned(), broken));
    verb.after_help(lines.collect::<Vec<_>>().join("\n"))
}

/// A command on several lines, each but the last with a sign behind it that it goes on.
fn broken(command: &str) -> String {
    let mut lines = vec![INDENT.to_owned()];
    for part in parts(command) {
        let last = lines.len() - 1;
        let line = &mut lines[last];
        let is_begun = !line.trim().is_empty();
        // A blank before the part, and one with the sign behind it.
        if is_begun && columns(line) + 1 + columns(&part) + 2 > WIDTH {
            line.push_str(" \\");
            lines.push(FURTHER.to_owned() + &part);
        } else {
            line.push_str(if is_begun { " " } else { "" });
            line.push_str(&part);
        }
    }
    lines.join("\n")
}

/// The words of a command, each option with its value.
fn parts(command: &str) -> Vec<String> {
    let mut parts: Vec<String> = Vec::new();
    for word in words(command) {
        let is_value = |own: &&mut String| own.starts_with('-') && !own.contains(' ');
        match parts.last_mut().filter(is_value).filter(|_| !word.starts_with('-')) {
            Some(option) => option.extend([" ", word]),
            None => parts.push(word.to_owned()),
        }
    }
    parts
}

/// What stands between the blanks of a command that are not within quotes.
fn words(command: &str) -> impl Iterator<Item = &str> {
    let mut quote = None;
    let is_end = move |own: char| {
        quote = match quote {
            None if matches!(own, '"' | '\'') => Some(own),
            Some(open) if open == own => None,
            open => open,
        };
        own == ' ' && quote.is_none()
    };
    command.split(is_end).filter(|own| !own.is_empty())
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::*;
    use crate::verbs::Arguments;

    /// The lines of examples in the help of a verb, as a terminal shows it.
    fn examples(verb: &Command) -> Option<String> {
        let help = verb.clone().term_width(WIDTH).render_long_help().to_string();
        let (_, rest) = help.split_once("Examples:\n").or(help.split_once("Begin with:\n"))?;
        rest.split("\n\n").next().map(str::to_owned)
    }

    /// What a shell makes of a command, up to what else stands on its line.
    fn arguments(command: &str) -> Vec<String> {
        let ends = ["   ", " | ", " > "].map(|end| command.find(end).unwrap_or(command.len()));
        let own = &command[..ends.into_iter().fold(command.len(), usize::min)];
        let plain = |word: &str| {
            let quote = ['"', '\''].into_iter().find(|own| word.contains(*own));
            quote.map_or(word.to_owned(), |quote| word.replace(quote, ""))
        };
        words(own).map(plain).collect()
    }

    #[test]
    fn examples_can_be_pasted_and_are_read() {
        let mut command = Arguments::command();
        command.build();
        let mut count = 0;
        for verb in [&command].into_iter().chain(command.get_subcommands()) {
            let Some(examples) = examples(verb) else { continue };
            assert!(examples.lines().all(|own| columns(own) <= WIDTH), "{examples}");
            for own in examples.replace("\\\n", "").lines().map(str::trim) {
                if own.starts_with("for ") || own == "done" {
                    continue;
                }
                let read = Arguments::try_parse_from(arguments(&own.replace("$i/4", "1/4")));
                assert!(own.starts_with("dashpot") && read.is_ok(), "{own}: {:?}", read.err());
                count += 1;
            }
        }
        assert!(count > 50, "{count}");
    }

    #[test]
    fn an_option_stays_with_its_value() {
        let own = "  dashpot fit pad.toml --vary \"K=10..1000 kN/m\" --to \"drop.csv:acc=head.acceleration\" --cfc 180";
        let lines = broken(own);
        let right = "  dashpot fit pad.toml --vary \"K=10..1000 kN/m\" \\\n    --to \"drop.csv:acc=head.acceleration\" --cfc 180";
        assert_eq!(lines, right);
    }
}
