//! Standard output and standard error.

use std::io::{self, ErrorKind, IsTerminal, Write};

use clap::builder::styling::{AnsiColor, Style};
use dashpot_scene::Diagnostics;

use crate::{args::When, error::CliError};

/// Columns of text.
pub(crate) const WIDTH: usize = 80;

/// Where text goes, and whether it is coloured there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Terminal {
    /// Whether a person reads standard output.
    pub(crate) output_is_terminal: bool,
    /// Whether a person reads standard error.
    pub(crate) error_is_terminal: bool,
    output_color: bool,
    error_color: bool,
}

/// What a text is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tone {
    /// A heading.
    Heading,
    /// What the reader must know.
    Warning,
    /// Less important.
    Faint,
}

impl Terminal {
    /// The terminal as it is, with colours as wished.
    pub(crate) fn new(color: When) -> Self {
        let (output, error) = (io::stdout().is_terminal(), io::stderr().is_terminal());
        let refused = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty())
            || std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let colored = |is_terminal: bool| match color {
            When::Auto => is_terminal && !refused,
            When::Always => true,
            When::Never => false,
        };
        Self {
            output_is_terminal: output,
            error_is_terminal: error,
            output_color: colored(output),
            error_color: colored(error),
        }
    }

    /// The text in the colour of its tone, for standard output.
    pub(crate) fn toned(&self, tone: Tone, text: &str) -> String {
        let style = match tone {
            Tone::Heading => Style::new().bold(),
            Tone::Warning => AnsiColor::Yellow.on_default().bold(),
            Tone::Faint => Style::new().dimmed(),
        };
        if self.output_color { format!("{style}{text}{style:#}") } else { text.to_owned() }
    }

    /// Prints to standard output. A reader that has gone away is no error.
    pub(crate) fn print(&self, text: &str) -> Result<(), CliError> {
        let mut output = io::stdout().lock();
        match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
            Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(CliError::Output(error)),
            _ => Ok(()),
        }
    }

    /// Says something on standard error.
    pub(crate) fn note(&self, text: &str) {
        // There is nowhere left to complain to.
        let _ = writeln!(io::stderr().lock(), "{text}");
    }

    /// Warns on standard error.
    pub(crate) fn warn(&self, text: &str) {
        self.labelled("warning", AnsiColor::Yellow, text);
    }

    /// Tells of an error and of what to do.
    pub(crate) fn error(&self, error: &CliError) {
        if let CliError::Scene(diagnostics) = error {
            return self.diagnose(diagnostics);
        }
        self.labelled("error", AnsiColor::Red, &error.to_string());
        if let Some(help) = error.help() {
            self.labelled("help", AnsiColor::Cyan, &help);
        }
    }

    /// Shows faults of a text, or what is odd about it.
    pub(crate) fn diagnose(&self, diagnostics: &Diagnostics) {
        if !diagnostics.is_empty() {
            self.note(&diagnostics.render(self.error_color));
        }
    }

    fn labelled(&self, label: &str, color: AnsiColor, text: &str) {
        let style = color.on_default().bold();
        if self.error_color {
            self.note(&format!("{style}{label}{style:#}: {text}"));
        } else {
            self.note(&format!("{label}: {text}"));
        }
    }
}
