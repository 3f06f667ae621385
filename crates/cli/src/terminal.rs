//! Standard output and standard error.

use std::{
    fmt::Write as _,
    io::{self, ErrorKind, IsTerminal, Write},
    sync::LazyLock,
};

use clap::builder::styling::{AnsiColor, Style};
pub(crate) use dashpot_report::{Tone, layout::WIDTH};
use dashpot_report::{Tones, layout::hanging};
use dashpot_scene::{Diagnostics, visible};

use crate::{
    args::When,
    error::{CliError, StudyError},
    host,
    part::token,
};

/// Where text goes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Terminal {
    pub(crate) output: Stream,
    pub(crate) error: Stream,
    /// Whether both are read at one place: on a terminal, or because one is sent to the other.
    pub(crate) is_one: bool,
}

/// What is known about a stream.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stream {
    /// Whether it is a terminal, so that a person reads it.
    pub(crate) attended: bool,
    /// Whether text on it is coloured.
    colored: bool,
}

impl Terminal {
    /// The terminal as it is, with colours as wished.
    pub(crate) fn new(color: When) -> Self {
        let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
            || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let stream = |attended: bool| {
            let colored = match color {
                When::Auto => attended && !refused,
                When::Always => true,
                When::Never => false,
            };
            Stream { attended, colored }
        };
        let (output, error) =
            (stream(io::stdout().is_terminal()), stream(io::stderr().is_terminal()));
        let is_one = output.attended && error.attended || have_one_file();
        Self { output, error, is_one }
    }

    /// Nobody reads.
    pub(crate) fn unattended() -> Self {
        let nobody = Stream { attended: false, colored: false };
        Self { output: nobody, error: nobody, is_one: false }
    }

    pub(crate) fn warn(self, text: &str) {
        if !host::said(host::Tone::Warning, text, None) {
            self.labelled("warning", Tone::Warning, text);
        }
    }

    /// Tells of an error and of what to do.
    pub(crate) fn error(self, error: &CliError) {
        match error {
            CliError::Study(StudyError::Scene(diagnostics)) => self.diagnose(diagnostics),
            error => self.fail("", error),
        }
    }

    /// Tells of an error, after a word on where it happened, and of what to do.
    pub(crate) fn fail(self, prefix: &str, error: &CliError) {
        let text = format!("{prefix}{error}");
        if host::said(host::Tone::Error, &text, error.help()) {
            return;
        }
        self.labelled("error", Tone::Error, &text);
        if let Some(help) = error.help() {
            self.labelled("help", Tone::Help, &help);
        }
    }

    /// Shows faults of a text, or what is odd about it.
    pub(crate) fn diagnose(self, diagnostics: &Diagnostics) {
        if !diagnostics.is_empty() && !host::diagnosed(diagnostics) {
            // Its texts are visible already, and it has colours of its own.
            put(&diagnostics.render_within(self.error.colored, WIDTH));
        }
    }

    fn labelled(self, label: &str, tone: Tone, text: &str) {
        let shown = hanging(&format!("{label}: {text}"), WIDTH);
        match shown.strip_prefix(label).filter(|_| self.error.colored) {
            Some(rest) => message(&(marked(tone, label) + rest)),
            None => message(&shown),
        }
    }
}

/// Colours of standard output.
impl Tones for Terminal {
    fn toned(&self, tone: Tone, text: &str) -> String {
        if self.output.colored { marked(tone, text) } else { text.to_owned() }
    }
}

/// Whether both streams lead to the same file, pipe or device.
#[cfg(unix)]
fn have_one_file() -> bool {
    use std::{
        fs::File,
        os::{fd::AsFd, unix::fs::MetadataExt},
    };
    let identity = |stream: &dyn AsFd| {
        let file = File::from(stream.as_fd().try_clone_to_owned().ok()?).metadata().ok()?;
        Some((file.dev(), file.ino()))
    };
    let output = identity(&io::stdout());
    output.is_some() && output == identity(&io::stderr())
}

/// Whether both streams lead to the same file, pipe or device; that is not known here.
#[cfg(not(unix))]
fn have_one_file() -> bool {
    false
}

/// Prints for people to standard output, with no control characters but ours.
pub(crate) fn print(text: &str) -> Result<(), CliError> {
    print_raw(&shown(text))
}

/// Prints for programs to standard output: as it is, unless that is a terminal.
pub(crate) fn print_data(text: &str) -> Result<(), CliError> {
    if io::stdout().is_terminal() && !host::is_called() { print(text) } else { print_raw(text) }
}

/// A reader that has gone away is no error.
fn print_raw(text: &str) -> Result<(), CliError> {
    if host::printed(text) {
        return Ok(());
    }
    let mut output = io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Output(error)),
        _ => Ok(()),
    }
}

/// Says on standard error what may be of interest.
pub(crate) fn note(text: &str) {
    if !host::said(host::Tone::Note, text, None) {
        message(&hanging(&format!("note: {text}"), WIDTH));
    }
}

/// Says something on standard error, with no control characters but ours.
pub(crate) fn message(text: &str) {
    put(&shown(text));
}

fn put(text: &str) {
    // There is nowhere left to complain to.
    let _ = writeln!(io::stderr().lock(), "{text}");
}

/// All tones, each with its letter in a mark.
const TONES: [(char, Tone); 5] = [
    ('h', Tone::Heading),
    ('w', Tone::Warning),
    ('f', Tone::Faint),
    ('e', Tone::Error),
    ('p', Tone::Help),
];
/// The letter of the end of a style.
const END: char = '.';
/// What marks begin with: a character that Unicode leaves to programs, and digits that no text of a file can know.
static MARK: LazyLock<String> = LazyLock::new(|| format!("\u{fdd0}{}", token()));

fn style(tone: Tone) -> Style {
    match tone {
        Tone::Heading => Style::new().bold(),
        Tone::Warning => AnsiColor::Yellow.on_default().bold(),
        Tone::Faint => Style::new().dimmed(),
        Tone::Error => AnsiColor::Red.on_default().bold(),
        Tone::Help => AnsiColor::Cyan.on_default().bold(),
    }
}

/// The text between the marks of a tone.
pub(crate) fn marked(tone: Tone, text: &str) -> String {
    let letter = TONES.iter().find(|own| own.1 == tone).map_or(END, |own| own.0);
    let mark = MARK.as_str();
    format!("{mark}{letter}{text}{mark}{END}")
}

/// The text with styles for marks, and all else visible.
pub(crate) fn shown(text: &str) -> String {
    let mut parts = text.split(MARK.as_str());
    let mut shown = visible(parts.next().unwrap_or_default()).into_owned();
    for part in parts {
        let mut rest = part.chars();
        let letter = rest.next();
        let _ = match TONES.iter().find(|own| Some(own.0) == letter) {
            Some((_, tone)) => write!(shown, "{}", style(*tone)),
            None => write!(shown, "{}", style(Tone::Heading).render_reset()),
        };
        shown += &visible(rest.as_str());
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_our_styles_reach_a_terminal() {
        let text = format!("a{}\n", marked(Tone::Heading, "\u{1b}[31mb\u{9b}c"));
        assert_eq!(shown(&text), "a\u{1b}[1m\\u001b[31mb\\u009bc\u{1b}[0m\n");
        assert_eq!(shown("\u{fdd0}he\u{fdd3}error\u{fdef}"), "\\ufdd0he\\ufdd3error\\ufdef");
    }
}
