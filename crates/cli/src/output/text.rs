//! Results for people: headings, paragraphs, tables and plots in 80 columns.

use dashpot_plot::{Chart, Table};

use crate::{
    terminal::Tone,
    terminal::{Terminal, WIDTH},
    text::{columns, fitted, labelled, side_by_side, table, wrapped},
};

/// A text that is being written.
pub(crate) struct Text {
    terminal: Terminal,
    text: String,
}

impl Text {
    pub(crate) fn written(terminal: Terminal, write: impl FnOnce(&mut Self)) -> String {
        let mut text = Self { terminal, text: String::new() };
        write(&mut text);
        text.text
    }

    /// Whether a plot is wanted: on terminals, unless the command line says otherwise.
    pub(crate) fn is_plotted(&self, wish: crate::args::When) -> bool {
        wish.is_now(self.terminal.output.attended)
    }

    pub(crate) fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Lines as they are.
    pub(crate) fn lines(&mut self, lines: &str) {
        self.text.push_str(lines);
    }

    /// Warnings, each behind a mark.
    pub(crate) fn warnings(&mut self, warnings: &[String]) {
        for warning in warnings {
            for (at, line) in wrapped(warning, WIDTH - 2).iter().enumerate() {
                let line = format!("{} {line}", if at == 0 { "!" } else { " " });
                self.line(&self.terminal.toned(Tone::Warning, &line));
            }
        }
    }

    pub(crate) fn blank(&mut self) {
        self.line("");
    }

    /// The title of the whole, or of what follows an empty line.
    pub(crate) fn title(&mut self, words: &str) {
        self.toned(Tone::Heading, words);
    }

    pub(crate) fn toned(&mut self, tone: Tone, words: &str) {
        for line in wrapped(words, WIDTH) {
            self.line(&self.terminal.toned(tone, &line));
        }
    }

    /// A line that begins in a tone.
    pub(crate) fn begun(&mut self, tone: Tone, begin: &str, rest: &str) {
        self.line(&(self.terminal.toned(tone, begin) + rest));
    }

    /// A heading after an empty line.
    pub(crate) fn heading(&mut self, words: &str) {
        self.blank();
        self.title(words);
    }

    /// Words over the whole width.
    pub(crate) fn words(&mut self, words: &str) {
        wrapped(words, WIDTH).iter().for_each(|line| self.line(line));
    }

    /// Words that are less important, indented.
    pub(crate) fn faint(&mut self, words: &str) {
        for line in wrapped(words, WIDTH - 2) {
            self.line(&format!("  {}", self.terminal.toned(Tone::Faint, &line)));
        }
    }

    /// Indented paragraphs, one for each of these texts.
    pub(crate) fn paragraphs<S: AsRef<str>>(&mut self, texts: impl IntoIterator<Item = S>) {
        for text in texts {
            wrapped(text.as_ref(), WIDTH - 2)
                .iter()
                .for_each(|line| self.line(&format!("  {line}")));
        }
    }

    /// The same, each of them with all but its first line indented further.
    pub(crate) fn items<S: AsRef<str>>(&mut self, texts: impl IntoIterator<Item = S>) {
        for text in texts {
            for (at, line) in wrapped(text.as_ref(), WIDTH - 4).iter().enumerate() {
                self.line(&format!("{}{line}", if at == 0 { "  " } else { "    " }));
            }
        }
    }

    /// A label and a text beside it.
    pub(crate) fn labelled(&mut self, label: &str, label_width: usize, words: &str) {
        self.text += &labelled(label, label_width, words, WIDTH);
    }

    /// A table after an empty line, in parts where it is too wide; nothing if it has no rows.
    pub(crate) fn table(&mut self, table: &Table) {
        if table.rows.is_empty() {
            return;
        }
        self.blank();
        if !table.caption.is_empty() {
            self.title(&table.caption);
        }
        self.rows(table);
    }

    /// A table without its caption after an empty line, with a faint header; its last column is wrapped.
    pub(crate) fn figures(&mut self, content: &Table) {
        let (header, rows) = fitted(content, WIDTH - 2);
        self.blank();
        for line in header.lines() {
            self.line(&format!("  {}", self.terminal.toned(Tone::Faint, line)));
        }
        rows.iter().for_each(|row| self.line(&format!("  {row}")));
    }

    /// The header and the rows of a table after an empty line, in parts where it is too wide.
    pub(crate) fn rows_below(&mut self, content: &Table) {
        self.blank();
        self.rows(content);
    }

    /// The header and the rows of a table.
    pub(crate) fn rows(&mut self, content: &Table) {
        self.rows_led(content, 1);
    }

    /// The same, where so many first columns stand before each part.
    pub(crate) fn rows_led(&mut self, content: &Table, lead: usize) {
        for (at, part) in side_by_side(content, lead, WIDTH - 2).iter().enumerate() {
            if at > 0 {
                self.blank();
            }
            let (header, rows) = table(part);
            let lines = header.lines().chain(rows.iter().map(String::as_str));
            for line in lines.filter(|line| columns(line) > 0) {
                self.line(&format!("  {line}"));
            }
        }
    }

    /// A chart of so many lines after an empty line.
    pub(crate) fn chart(&mut self, chart: &Chart, height: usize) {
        self.text.push('\n');
        self.text.push_str(&chart.text(WIDTH, height));
    }
}
