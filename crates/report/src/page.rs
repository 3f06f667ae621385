//! One HTML page that holds everything a result says.

use std::fmt::Write as _;

use dashpot_plot::{Chart, Map, PlotError, escape};

use crate::Table;

/// The style sheet; colours of the theme are turned for dark pages there.
const STYLE: &str = include_str!("style.css");

/// Everything a result says, as texts, tables and drawings, in the order of a page.
///
/// # Examples
///
/// ```
/// use dashpot_report::{Page, Table};
///
/// let report = Page {
///     title: "Head on a padded panel".into(),
///     verdict: vec!["peak force 38.4 kN at 0.98 ms".into()],
///     warnings: vec!["from 7.43 ms the padding is in tension: separation is off".into()],
///     tables: vec![Table {
///         caption: "Measures".into(),
///         header: vec!["measure".into(), "exact".into()],
///         rows: vec![vec!["padding.peak-force".into(), "38.359".into()]],
///     }],
///     ..Page::default()
/// };
/// let page = report.html();
/// assert!(page.starts_with("<!DOCTYPE html>"));
/// assert!(page.find("pulls") < page.find("38.359"));
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Page {
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

/// A drawing with its caption.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ReportFigure {
    /// Text below the drawing; empty for none. The network's is not printed, it only names the drawing to readers
    /// who do not see it.
    pub caption: String,
    /// SVG element as [`Chart::svg`] and [`Sketch::svg`](dashpot_plot::Sketch::svg) write it. It is taken
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

    /// The drawing of a network, which its caption names to readers who do not see it.
    pub(crate) fn network(&self) -> String {
        format!(
            "<figure class=\"sketch\" aria-label=\"{}\"><div class=\"drawing\">\n{}</div></figure>\n",
            escape(&self.caption),
            self.svg
        )
    }

    pub(crate) fn html(&self) -> String {
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

impl Page {
    /// One page without script and without any outer resource. All texts are escaped; what stands between two backticks
    /// in them is set as code.
    pub fn html(&self) -> String {
        let tables = self.tables.iter().map(Table::html);
        let figures = self.figures.iter().map(ReportFigure::html);
        let details = self.details.iter().map(Table::html);
        let parts = [list("warnings", &self.warnings), list("verdict", &self.verdict)];
        let network = self.network.iter().map(ReportFigure::network);
        let parts = parts.into_iter().chain(network).chain(tables).chain(figures).chain(details);
        whole(&self.title, parts, &self.scene_text)
    }
}

/// A page of these parts below its title, with the text of a scene at its end where there is one.
pub(crate) fn whole(
    title: &str,
    parts: impl IntoIterator<Item = String>,
    scene_text: &str,
) -> String {
    let title = escape(title);
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n<h1>{title}</h1>\n"
    );
    page.extend(parts);
    if !scene_text.is_empty() {
        let text = verbatim(scene_text);
        let _ = writeln!(page, "<section><h2>Scene</h2><pre>{text}</pre></section>");
    }
    page + "</main>\n</body>\n</html>\n"
}

impl Table {
    pub(crate) fn html(&self) -> String {
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
        let mut html = String::from("<section>");
        if !self.caption.is_empty() {
            let _ = write!(html, "<h2>{}</h2>", phrase(&self.caption));
        }
        html += "\n<div class=\"table\"><table>\n";
        if !self.header.is_empty() {
            let _ = writeln!(html, "<thead>{}</thead>", row(&self.header, "th"));
        }
        html += "<tbody>\n";
        self.rows.iter().for_each(|cells| html += &row(cells, "td"));
        html + "</tbody>\n</table></div></section>\n"
    }
}

/// A heading, with a line below it where there is something to say.
pub(crate) fn heading(words: &str, below: &str) -> String {
    let below =
        if below.is_empty() { String::new() } else { format!("<p>{}</p>\n", phrase(below)) };
    format!("<h2>{}</h2>\n{below}", phrase(words))
}

pub(crate) fn list(class: &str, lines: &[String]) -> String {
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
    use dashpot_plot::{Series, Sketch, page_colours};

    use super::*;
    use crate::well_formed::assert_well_formed;

    const FIGURES: [&str; 2] = ["Force over time", "Acceleration over time"];

    fn report() -> Page {
        let row = |cells: &[&str]| cells.iter().map(|c| (*c).to_owned()).collect::<Vec<_>>();
        let network = ReportFigure::of_sketch("Network", Sketch::default().svg());
        let figures = FIGURES.iter().map(|title| {
            let series = vec![Series::new("padding", vec![(0.0, 0.0), (1.0, 2.0)])];
            let chart = Chart { title: (*title).to_owned(), series, ..Chart::default() };
            ReportFigure { caption: (*title).to_owned(), ..ReportFigure::of(&chart).unwrap() }
        });
        Page {
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
        for colour in page_colours() {
            assert!(STYLE.contains(&colour), "{colour}");
        }
    }
}
