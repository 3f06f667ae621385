//! The model of a report.

use dashpot_plot::{Chart, Map, PlotError};

use crate::{
    ReportFigure, Table, Tone,
    page::{heading, list, whole},
};

/// Everything that a result says to people, once for all faces: [as text](crate::Text::report) and [as a page](Report::html).
///
/// # Examples
///
/// ```
/// use dashpot_report::{Report, Table, Text};
///
/// let mut report = Report::titled("Crate on a truck");
/// report.asked.push("The motion of `floor` is a sine.".to_owned());
/// report.table(Table::new("Modes", ["mode", "frequency"], [vec!["1".into(), "6.3 Hz".into()]]));
/// report.notes(["every ratio within 1e-10 %"]);
/// let text = Text::written((), |text| text.report(&report, false));
/// assert!(text.contains("\nModes\n  mode  frequency\n"));
/// assert!(report.html()?.contains("<td class=\"number\">6.3 Hz</td>"));
/// # Ok::<(), dashpot_plot::PlotError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Title, or a verdict that stands for one.
    pub title: String,
    /// What a verdict is about, behind it on its line; empty where the title says all.
    pub subject: String,
    /// Tone of the title.
    pub tone: Tone,
    /// What a reader must know before any number.
    pub warnings: Vec<String>,
    /// What was asked, in whole sentences.
    pub asked: Vec<String>,
    /// The answer in a few lines.
    pub verdict: Vec<Line>,
    /// What follows, in the order in which it is read.
    blocks: Vec<(Place, Block)>,
    /// The network; on pages only.
    pub network: Option<ReportFigure>,
    /// Drawings, which stand below the blocks of a page.
    figures: Vec<Figure>,
    /// How the results came about: methods, steps, times, resolved settings; on pages only.
    pub details: Vec<Table>,
    /// The scene as it was read; on pages only.
    pub scene_text: String,
}

/// A line of a verdict.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Line {
    /// What it is about; empty where that is clear.
    pub label: String,
    /// What is said of it.
    pub text: String,
}

/// A part of a report.
#[derive(Debug, Clone, PartialEq)]
pub enum Block {
    /// A table with its caption.
    Table(Table),
    /// Paragraphs.
    Notes(Vec<String>),
    /// The rows of a table, below what has been said before.
    Rows(Table),
    /// Numbers of one thing, below what has been said of it: in texts with a faint header and a last column that is wrapped.
    Numbers(Table),
    /// A heading above further blocks, and what is to be known of all of them; empty for nothing.
    Heading(String, String),
    /// A plot; on pages it is a [`Figure`].
    Chart(Chart),
}

/// Where a block stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Everywhere.
    Everywhere,
    /// In texts of 80 columns.
    Terminals,
    /// On pages.
    Pages,
}

/// A drawing, with the name of its file in a folder.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name of the file.
    pub file: String,
    /// What is drawn.
    pub drawing: Drawing,
}

/// What is drawn.
#[derive(Debug, Clone, PartialEq)]
pub enum Drawing {
    /// Curves.
    Chart(Chart),
    /// A value over two quantities.
    Map(Map),
}

impl Figure {
    /// The drawing for a page and for a phone.
    ///
    /// # Errors
    ///
    /// As those of [`Chart::svg`].
    pub fn drawn(&self) -> Result<ReportFigure, PlotError> {
        match &self.drawing {
            Drawing::Chart(chart) => ReportFigure::of(chart),
            Drawing::Map(map) => Ok(ReportFigure::of_map(map)),
        }
    }
}

impl Report {
    /// A report of this title that says nothing yet.
    pub fn titled(title: impl Into<String>) -> Self {
        Self {
            title: title.into(),
            subject: String::new(),
            tone: Tone::Heading,
            warnings: Vec::new(),
            asked: Vec::new(),
            verdict: Vec::new(),
            blocks: Vec::new(),
            network: None,
            figures: Vec::new(),
            details: Vec::new(),
            scene_text: String::new(),
        }
    }

    /// Adds a block where it is shown.
    pub fn block(&mut self, place: Place, block: Block) {
        self.blocks.push((place, block));
    }

    /// Adds a table, if it has rows.
    pub fn table(&mut self, table: Table) {
        self.tables([table]);
    }

    /// Adds those tables that have rows.
    pub fn tables(&mut self, tables: impl IntoIterator<Item = Table>) {
        let filled = tables.into_iter().filter(|table| !table.rows.is_empty());
        self.blocks.extend(filled.map(|table| (Place::Everywhere, Block::Table(table))));
    }

    /// Adds paragraphs.
    pub fn notes<S: Into<String>>(&mut self, notes: impl IntoIterator<Item = S>) {
        let notes: Vec<String> = notes.into_iter().map(Into::into).collect();
        if !notes.is_empty() {
            self.block(Place::Everywhere, Block::Notes(notes));
        }
    }

    /// Adds a chart as a figure of pages and folders.
    pub fn figure(&mut self, file: impl Into<String>, chart: Chart) {
        self.figures.push(Figure { file: file.into(), drawing: Drawing::Chart(chart) });
    }

    /// Adds a map likewise.
    pub fn map(&mut self, file: impl Into<String>, map: Map) {
        self.figures.push(Figure { file: file.into(), drawing: Drawing::Map(map) });
    }

    /// Adds a chart as a figure, which stands in texts as well.
    pub fn plot(&mut self, file: impl Into<String>, chart: Chart) {
        self.block(Place::Terminals, Block::Chart(chart.clone()));
        self.figure(file, chart);
    }

    /// The blocks that are shown at a place.
    pub fn blocks(&self, place: Place) -> impl Iterator<Item = &Block> {
        let is_here = move |own: Place| own == place || own == Place::Everywhere;
        self.blocks.iter().filter(move |(own, _)| is_here(*own)).map(|(_, block)| block)
    }

    /// The figures.
    pub fn figures(&self) -> &[Figure] {
        &self.figures
    }

    /// One page without script and without any outer resource. All texts are escaped; what stands between two backticks
    /// in them is set as code.
    ///
    /// # Errors
    ///
    /// As those of [`Chart::svg`].
    pub fn html(&self) -> Result<String, PlotError> {
        let lines = self.verdict.iter().map(|line| match line.label.as_str() {
            "" => line.text.clone(),
            label => format!("{label}: {}", line.text),
        });
        let verdict: Vec<String> = self.asked.iter().cloned().chain(lines).collect();
        let mut parts = vec![list("warnings", &self.warnings), list("verdict", &verdict)];
        parts.extend(self.network.iter().map(ReportFigure::network));
        parts.extend(self.blocks(Place::Pages).map(|block| match block {
            Block::Table(table) | Block::Rows(table) | Block::Numbers(table) => table.html(),
            Block::Notes(notes) => list("notes", notes),
            Block::Heading(words, below) => heading(words, below),
            Block::Chart(_) => String::new(),
        }));
        for figure in &self.figures {
            parts.push(figure.drawn()?.html());
        }
        let details = self.details.iter().filter(|table| !table.rows.is_empty());
        parts.extend(details.map(Table::html));
        Ok(whole(&format!("{}{}", self.title, self.subject), parts, &self.scene_text))
    }
}
