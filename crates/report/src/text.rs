//! A report as text: headings, paragraphs, tables and plots in 80 columns.

use dashpot_plot::Chart;

use crate::{
    Block, Place, Report, Table, Tone, Tones,
    layout::{WIDTH, columns, fitted, labelled, side_by_side, table, wrapped},
};

/// Lines of a chart.
const CHART: usize = 16;

/// A text of 80 columns that is being written.
pub struct Text {
    tones: Box<dyn Tones>,
    text: String,
}

impl Text {
    /// What `write` writes, in these tones.
    pub fn written(tones: impl Tones + 'static, write: impl FnOnce(&mut Self)) -> String {
        let mut text = Self { tones: Box::new(tones), text: String::new() };
        write(&mut text);
        text.text
    }

    /// A whole report; its charts only where they are to be `plotted`.
    pub fn report(&mut self, report: &Report, plotted: bool) {
        self.warnings(&report.warnings);
        if report.subject.is_empty() {
            self.toned(report.tone, &report.title);
        } else {
            self.begun(report.tone, &report.title, &report.subject);
        }
        report.asked.iter().for_each(|asked| self.faint(asked));
        if !report.verdict.is_empty() {
            self.blank();
            let labels = report.verdict.iter().map(|line| columns(&line.label));
            let width = labels.max().unwrap_or(0);
            report.verdict.iter().for_each(|line| self.labelled(&line.label, width, &line.text));
        }
        for (at, block) in report.blocks(Place::Terminals).enumerate() {
            match block {
                Block::Table(content) => self.table(content),
                Block::Notes(notes) => {
                    if at == 0 && !report.verdict.is_empty() {
                        self.blank();
                    }
                    self.items(notes);
                }
                Block::Rows(content) => self.rows(content),
                Block::Numbers(content) => self.figures(content),
                Block::Heading(words, below) => {
                    self.heading(words);
                    if !below.is_empty() {
                        self.faint(below);
                    }
                }
                Block::Chart(chart) if plotted => self.chart(chart, CHART),
                Block::Chart(_) => {}
            }
        }
    }

    /// A line as it is.
    pub fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Lines as they are.
    pub fn lines(&mut self, lines: &str) {
        self.text.push_str(lines);
    }

    /// Warnings, each behind a mark.
    pub fn warnings(&mut self, warnings: &[String]) {
        for warning in warnings {
            for (at, line) in wrapped(warning, WIDTH - 2).iter().enumerate() {
                let line = format!("{} {line}", if at == 0 { "!" } else { " " });
                self.line(&self.tones.toned(Tone::Warning, &line));
            }
        }
    }

    /// An empty line.
    pub fn blank(&mut self) {
        self.line("");
    }

    /// The title of the whole, or of what follows an empty line.
    pub fn title(&mut self, words: &str) {
        self.toned(Tone::Heading, words);
    }

    /// Words over the whole width in a tone.
    pub fn toned(&mut self, tone: Tone, words: &str) {
        for line in wrapped(words, WIDTH) {
            self.line(&self.tones.toned(tone, &line));
        }
    }

    /// A line that begins in a tone.
    pub fn begun(&mut self, tone: Tone, begin: &str, rest: &str) {
        self.line(&(self.tones.toned(tone, begin) + rest));
    }

    /// A heading after an empty line.
    pub fn heading(&mut self, words: &str) {
        self.blank();
        self.title(words);
    }

    /// Words over the whole width.
    pub fn words(&mut self, words: &str) {
        wrapped(words, WIDTH).iter().for_each(|line| self.line(line));
    }

    /// Words that are less important, indented.
    pub fn faint(&mut self, words: &str) {
        for line in wrapped(words, WIDTH - 2) {
            self.line(&format!("  {}", self.tones.toned(Tone::Faint, &line)));
        }
    }

    /// Indented paragraphs, one for each of these texts.
    pub fn paragraphs<S: AsRef<str>>(&mut self, texts: impl IntoIterator<Item = S>) {
        for text in texts {
            wrapped(text.as_ref(), WIDTH - 2)
                .iter()
                .for_each(|line| self.line(&format!("  {line}")));
        }
    }

    /// The same, each of them with all but its first line indented further.
    pub fn items<S: AsRef<str>>(&mut self, texts: impl IntoIterator<Item = S>) {
        for text in texts {
            for (at, line) in wrapped(text.as_ref(), WIDTH - 4).iter().enumerate() {
                self.line(&format!("{}{line}", if at == 0 { "  " } else { "    " }));
            }
        }
    }

    /// A label and a text beside it.
    pub fn labelled(&mut self, label: &str, label_width: usize, words: &str) {
        self.text += &labelled(label, label_width, words, WIDTH);
    }

    /// A table after an empty line, in parts where it is too wide; nothing if it has no rows.
    pub fn table(&mut self, table: &Table) {
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
    pub fn figures(&mut self, content: &Table) {
        let (header, rows) = fitted(content, WIDTH - 2);
        self.blank();
        for line in header.lines() {
            self.line(&format!("  {}", self.tones.toned(Tone::Faint, line)));
        }
        rows.iter().for_each(|row| self.line(&format!("  {row}")));
    }

    /// The header and the rows of a table after an empty line, in parts where it is too wide.
    pub fn rows_below(&mut self, content: &Table) {
        self.blank();
        self.rows(content);
    }

    /// The header and the rows of a table.
    pub fn rows(&mut self, content: &Table) {
        self.rows_led(content, 1);
    }

    /// The same, where so many first columns stand before each part.
    pub fn rows_led(&mut self, content: &Table, lead: usize) {
        for (at, part) in side_by_side(content, lead, WIDTH - 2).iter().enumerate() {
            if at > 0 {
                self.blank();
            }
            let (header, rows) = table(part);
            let lines = header.lines().chain(rows.iter().map(String::as_str));
            for line in lines.filter(|line| columns(line) > 0) {
                if columns(line) <= WIDTH - 2 {
                    self.line(&format!("  {line}"));
                } else {
                    self.items([line]);
                }
            }
        }
    }

    /// A chart of so many lines after an empty line.
    pub fn chart(&mut self, chart: &Chart, height: usize) {
        self.text.push('\n');
        self.text.push_str(&chart.text(WIDTH, height));
    }
}
