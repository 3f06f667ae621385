//! What `thesis` writes into a folder.

use std::io::Write;

use dashpot_plot::ReportFigure;
use dashpot_thesis::{
    Column, DURATION, Drawing, Figure, Recomputation, Scales, figure_stems, figures,
};

use crate::{error::CliError, folder::Staged, sketch::sketch};

/// Everything on one page.
const PAGE: &str = "report.html";
/// The same in Markdown.
const MARKDOWN: &str = "report.md";

/// The files that are written besides the result.
pub(crate) fn file_names() -> Vec<String> {
    let figures = figure_stems().flat_map(|own| [format!("{own}.svg"), format!("{own}.csv")]);
    figures.chain([PAGE, MARKDOWN].map(str::to_owned)).collect()
}

/// Adds all files but the result.
pub(crate) fn write(files: &mut Staged<'_>, all: &Recomputation) -> Result<(), CliError> {
    let figures = figures(&all.study)?;
    let mut drawings = Vec::new();
    for own in &figures {
        let svg = svg(own)?;
        let caption = format!("Figure {}. {}", own.number, own.title);
        files.add(format!("{}.svg", own.stem()), &svg)?;
        drawings.push(ReportFigure { caption, svg });
        if !own.columns.is_empty() {
            let name = format!("{}.csv", own.stem());
            files.add_with(name, |out| Ok(write_csv(&own.columns, out)?))?;
        }
    }
    files.add(MARKDOWN, all.markdown(&figures))?;
    files.add(PAGE, all.page(drawings).html())
}

fn svg(figure: &Figure) -> Result<String, CliError> {
    Ok(match &figure.drawing {
        Drawing::Chart(chart) => chart.svg()?,
        Drawing::Network(network) => sketch(network, DURATION * Scales::CHAPTER_4.time()).svg(),
    })
}

/// The numbers of a figure as CSV.
fn write_csv(columns: &[Column], out: &mut dyn Write) -> csv::Result<()> {
    let mut writer = csv::Writer::from_writer(out);
    writer.write_record(columns.iter().map(|own| &own.name))?;
    let rows = columns.iter().map(|own| own.values.len()).max().unwrap_or(0);
    for row in 0..rows {
        // A zero has no sign.
        let value = |own: &Column| own.values.get(row).map(|own| own + 0.0);
        writer.serialize(columns.iter().map(value).collect::<Vec<_>>())?;
    }
    Ok(writer.flush()?)
}
