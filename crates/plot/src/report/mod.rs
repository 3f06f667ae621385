//! Reports: one HTML page that holds everything a run says.

use std::fmt::Write as _;

use crate::{Chart, Map, PlotError, text_metrics::escape};

/// The style sheet; colours of the theme are turned for dark pages there.
const STYLE: &str = include_str!("style.css");

/// Everything a run says, as texts, tables and drawings.
///
/// # Examples
///
/// ```
/// use dashpot_plot::{Report, Table};
///
/// let report = Report {
///     title: "Head on a padded panel".into(),
///     verdict: vec!["peak force 38.4 kN at 0.98 ms".into()],
///     warnings: vec!["from 7.43 ms the padding is in tension: separation is off".into()],
///     tables: vec![Table {
///         caption: "Measures".into(),
///         header: vec!["measure".into(), "exact".into()],
///         rows: vec![vec!["padding.peak-force".into(), "38.359".into()]],
///     }],
///     ..Report::default()
/// };
/// let page = report.html();
/// assert!(page.starts_with("<!DOCTYPE html>"));
/// assert!(page.find("pulls") < page.find("38.359"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Report {
    /// Title of the page.
    pub title: String,
    /// What a reader must know before any number.
    pub warnings: Vec<String>,
    /// The answer in a few lines.
    pub verdict: Vec<String>,
    /// Results, such as measures and the energy ledger.
    pub tables: Vec<Table>,
    /// The network, which stands above the tables.
    pub network: Option<ReportFigure>,
    /// The figures, which stand below the tables.
    pub figures: Vec<ReportFigure>,
    /// How the results came about: methods, steps, times, resolved settings.
    pub details: Vec<Table>,
    /// The scene as it was read.
    pub scene_text: String,
}

/// A table of texts.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Table {
    /// Heading.
    pub caption: String,
    /// Column headings; empty for none.
    pub header: Vec<String>,
    /// Rows, which may be shorter than the header.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these column headings. A column in which nothing stands is left out, unless it is the first.
    pub fn new(
        caption: impl Into<String>,
        header: impl IntoIterator<Item: ToString>,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Self {
        let mut own = Self::plain(caption, rows);
        own.header = header.into_iter().map(|own| own.to_string()).collect();
        let is_filled =
            |row: &Vec<String>, at: usize| row.get(at).is_some_and(|cell| !cell.is_empty());
        for at in (1..own.header.len()).rev() {
            if own.rows.is_empty() || own.rows.iter().any(|row| is_filled(row, at)) {
                continue;
            }
            own.header.remove(at);
            own.rows.iter_mut().filter(|row| at < row.len()).for_each(|row| drop(row.remove(at)));
        }
        own
    }

    /// A table without headings.
    pub fn plain(caption: impl Into<String>, rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        let rows = rows.into_iter().collect();
        Self { caption: caption.into(), header: Vec::new(), rows }
    }

    /// A table of one column without a heading.
    pub fn list(caption: impl Into<String>, lines: impl IntoIterator<Item = String>) -> Self {
        Self::plain(caption, lines.into_iter().map(|line| vec![line]))
    }
}

/// A drawing with its caption.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ReportFigure {
    /// Text below the drawing; empty for none. The network's is not printed, it only names the drawing to readers
    /// who do not see it.
    pub caption: String,
    /// SVG element as [`Chart::svg`](crate::Chart::svg) and [`Sketch::svg`](crate::Sketch::svg) write it. It is taken
    /// over as it stands.
    pub svg: String,
    /// The same for a phone, as [`Chart::narrow_svg`] writes it; empty where there is none, and `svg` keeps its size there.
    pub narrow: String,
}

impl ReportFigure {
    /// A chart, for pages and for phones, without a caption.
    ///
    /// # Errors
    ///
    /// As those of [`Chart::svg`].
    pub fn of(chart: &Chart) -> Result<Self, PlotError> {
        Ok(Self { caption: String::new(), svg: chart.svg()?, narrow: chart.narrow_svg()? })
    }

    /// A map, for pages and for phones, without a caption.
    pub fn of_map(map: &Map) -> Self {
        Self { caption: String::new(), svg: map.svg(), narrow: map.narrow_svg() }
    }

    /// A drawing that keeps its size.
    pub fn of_sketch(caption: impl Into<String>, svg: String) -> Self {
        Self { caption: caption.into(), svg, narrow: String::new() }
    }

    fn html(&self) -> String {
        let mut html = if self.narrow.is_empty() {
            format!("<figure class=\"sketch\"><div class=\"drawing\">\n{}</div>", self.svg)
        } else {
            format!(
                "<figure><div class=\"drawing wide\">\n{}</div><div class=\"drawing narrow\">\n{}</div>",
                self.svg, self.narrow
            )
        };
        if !self.caption.is_empty() {
            let _ = write!(html, "<figcaption>{}</figcaption>", phrase(&self.caption));
        }
        html + "</figure>\n"
    }
}

impl Report {
    /// The report as one page without script and without any outer resource. All texts are escaped; what stands
    /// between two backticks in them is set as code.
    pub fn html(&self) -> String {
        let title = escape(&self.title);
        let mut page = format!(
            "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
             <meta name=\"color-scheme\" content=\"light dark\"/>\n\
             <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n"
        );
        page += &list("warnings", &self.warnings);
        page += &list("verdict", &self.verdict);
        if let Some(network) = &self.network {
            let _ = writeln!(
                page,
                "<figure class=\"sketch\" aria-label=\"{}\"><div class=\"drawing\">\n{}</div></figure>",
                escape(&network.caption),
                network.svg
            );
        }
        self.tables.iter().for_each(|table| page += &table.html());
        self.figures.iter().for_each(|figure| page += &figure.html());
        self.details.iter().for_each(|table| page += &table.html());
        if !self.scene_text.is_empty() {
            let _ = writeln!(
                page,
                "<section><h2>Scene</h2><pre>{}</pre></section>",
                verbatim(&self.scene_text)
            );
        }
        page += "</main>\n</body>\n</html>\n";
        page
    }
}

impl Table {
    fn html(&self) -> String {
        let columns = self.rows.iter().map(Vec::len).fold(self.header.len(), usize::max);
        let classes: Vec<&str> = (0..columns)
            .map(|c| if self.is_numeric(c) { " class=\"number\"" } else { "" })
            .collect();
        let row = |cells: &[String], tag: &str| {
            let mut html = String::from("<tr>");
            for (column, class) in classes.iter().enumerate() {
                let text = phrase(cells.get(column).map_or("", String::as_str));
                let _ = write!(html, "<{tag}{class}>{text}</{tag}>");
            }
            html + "</tr>\n"
        };
        let mut html =
            format!("<section><h2>{}</h2>\n<div class=\"table\"><table>\n", phrase(&self.caption));
        if !self.header.is_empty() {
            let _ = writeln!(html, "<thead>{}</thead>", row(&self.header, "th"));
        }
        html += "<tbody>\n";
        self.rows.iter().for_each(|cells| html += &row(cells, "td"));
        html + "</tbody>\n</table></div></section>\n"
    }

    /// Whether a column holds numbers only, which are set to the right.
    fn is_numeric(&self, column: usize) -> bool {
        let cells = self.rows.iter().filter_map(|row| row.get(column));
        let mut cells = cells.filter(|cell| !cell.is_empty()).peekable();
        let is_number = |cell: &String| {
            let digits = cell.trim_start_matches(['-', '−', '+', '±', '<', '≤', ' ']);
            digits.starts_with(|c: char| c.is_ascii_digit()) || matches!(cell.as_str(), "–" | "—")
        };
        cells.peek().is_some() && cells.all(is_number)
    }
}

fn list(class: &str, lines: &[String]) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let mut html = format!("<ul class=\"{class}\">\n");
    for line in lines {
        let _ = writeln!(html, "<li>{}</li>", phrase(line));
    }
    html + "</ul>\n"
}

/// Escaped text with the parts between backticks as code; a backtick without a partner stays.
fn phrase(text: &str) -> String {
    let mut html = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('`') {
        html += &escape(before);
        rest = after;
        match after.split_once('`') {
            Some((code, after)) if !code.is_empty() => {
                let _ = write!(html, "<code>{}</code>", escape(code));
                rest = after;
            }
            _ => html.push('`'),
        }
    }
    html + &escape(rest)
}

/// Escaped text that keeps its line breaks and tabs.
fn verbatim(text: &str) -> String {
    let lines: Vec<String> = text
        .lines()
        .map(|line| line.split('\t').map(escape).collect::<Vec<_>>().join("\t"))
        .collect();
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::{FIGURES, tests::runs};
    use crate::sketch::tests::tangled;
    use crate::theme;
    use crate::well_formed::assert_well_formed;

    fn report() -> Report {
        let row = |cells: &[&str]| cells.iter().map(|c| (*c).to_owned()).collect::<Vec<_>>();
        let network = ReportFigure::of_sketch("Network", tangled().svg());
        let figures = FIGURES.iter().map(|figure| ReportFigure {
            caption: figure.title.into(),
            ..ReportFigure::of(&figure.chart(&runs())).unwrap()
        });
        Report {
            title: "Head <of 10 kg> & panel".into(),
            warnings: vec!["from 7.43 ms the padding is in tension: separation is off".into()],
            verdict: row(&["peak force 38.4 kN at 0.98 ms, 391 g", "deepest 17.5 mm, 2.5 mm left"]),
            tables: vec![Table {
                caption: "Measures".into(),
                header: row(&["measure", "unit", "time", "exact", "bdf", "difference"]),
                rows: vec![
                    row(&["padding.peak-force", "kN", "0.979 ms", "38.359", "38.360", "2.9e-6"]),
                    row(&["padding.peak-deformation", "mm", "6.852 ms", "17.539", "17.538"]),
                ],
            }],
            network: Some(network),
            figures: figures.collect(),
            details: vec![Table {
                caption: "Settings".into(),
                header: vec![],
                rows: vec![row(&["run.duration", "20 ms"])],
            }],
            scene_text: "[nodes]\n\thead = { mass = \"10 kg\" } # <b>\n".into(),
        }
    }

    #[test]
    fn the_page_is_well_formed_and_self_contained() {
        let page = report().html();
        assert_well_formed(&page);
        assert!(!page.contains("<script") && !page.contains("href") && !page.contains("src="));
        let outer = page.replace("http://www.w3.org/2000/svg", "");
        assert!(!outer.contains("http"), "an outer resource");
        assert_eq!(page.matches("<svg").count(), 1 + 2 * FIGURES.len());
    }

    #[test]
    fn warnings_come_first_and_texts_are_escaped() {
        let page = report().html();
        assert!(page.find("padding pulls") < page.find("peak force"));
        assert!(page.contains("Head &lt;of 10 kg&gt; &amp; panel"));
        assert!(page.contains("\thead = { mass = &quot;10 kg&quot; } # &lt;b&gt;"));
    }

    #[test]
    fn text_between_backticks_is_code() {
        assert_eq!(phrase("a bound of `exact`"), "a bound of <code>exact</code>");
        assert_eq!(phrase("`a<b>` or `c`."), "<code>a&lt;b&gt;</code> or <code>c</code>.");
        assert_eq!(phrase("a ` alone & ``"), "a <code> alone &amp; </code>`");
        assert_eq!(phrase("at ` last"), "at ` last");
    }

    #[test]
    fn the_network_stands_above_the_tables_and_the_figures_below() {
        let page = report().html();
        let at = |text: &str| page.find(text).unwrap();
        assert!(at("peak force 38.4") < at("class=\"sketch\""));
        assert!(at("class=\"sketch\"") < at("padding.peak-force"));
        assert!(at("padding.peak-force") < at("Force over time"));
        assert!(!page.contains("<figcaption>Network"));
    }

    #[test]
    fn numbers_are_set_to_the_right_and_words_to_the_left() {
        let table = &report().tables[0];
        let numeric: Vec<bool> = (0..6).map(|c| table.is_numeric(c)).collect();
        assert_eq!(numeric, [false, false, true, true, true, true]);
    }

    #[test]
    fn the_style_sheet_turns_every_colour_of_the_theme() {
        for colour in [theme::INK, theme::FAINT, theme::GRID, theme::PAPER, theme::FILL] {
            assert!(STYLE.contains(&colour.hex()), "{}", colour.hex());
        }
    }
}
