//! What `thesis` writes into a folder.

use std::{fs, path::Path};

use dashpot_plot::ReportFigure;
use dashpot_thesis::{
    Column, DURATION, Drawing, Figure, Recomputation, Scales, figure_stems, figures,
};

use crate::{
    error::CliError,
    folder::{RESULT, unwritable},
    sketch::sketch,
};

/// Everything on one page.
const PAGE: &str = "report.html";
/// The same in Markdown.
const MARKDOWN: &str = "report.md";

/// The files that are written besides the result.
pub(crate) fn file_names() -> Vec<String> {
    let figures = figure_stems().flat_map(|own| [format!("{own}.svg"), format!("{own}.csv")]);
    figures.chain([PAGE, MARKDOWN].map(str::to_owned)).collect()
}

/// Writes everything into the folder `path`, and returns the names of the files.
pub(crate) fn write(path: &Path, json: &str, all: &Recomputation) -> Result<Vec<String>, CliError> {
    let figures = figures(&all.study)?;
    let mut files = vec![(RESULT.to_owned(), json.as_bytes().to_vec())];
    let mut drawings = Vec::new();
    for own in &figures {
        let svg = svg(own)?;
        let caption = format!("Figure {}. {}", own.number, own.title);
        drawings.push(ReportFigure { caption, svg: svg.clone() });
        files.push((format!("{}.svg", own.stem()), svg.into_bytes()));
        if !own.columns.is_empty() {
            let name = format!("{}.csv", own.stem());
            let table = csv(&own.columns).map_err(std::io::Error::from);
            files.push((name.clone(), table.map_err(unwritable(&path.join(name)))?));
        }
    }
    files.push((MARKDOWN.to_owned(), all.markdown(&figures).into_bytes()));
    files.push((PAGE.to_owned(), all.page(drawings).html().into_bytes()));
    for (name, content) in &files {
        let file = path.join(name);
        fs::write(&file, content).map_err(unwritable(&file))?;
    }
    Ok(files.into_iter().map(|own| own.0).collect())
}

fn svg(figure: &Figure) -> Result<String, CliError> {
    Ok(match &figure.drawing {
        Drawing::Chart(chart) => chart.svg()?,
        Drawing::Network(network) => sketch(network, DURATION * Scales::CHAPTER_4.time()).svg(),
    })
}

/// The numbers of a figure as CSV.
fn csv(columns: &[Column]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(|own| &own.name))?;
    let rows = columns.iter().map(|own| own.values.len()).max().unwrap_or(0);
    for row in 0..rows {
        // A zero has no sign.
        let value = |own: &Column| own.values.get(row).map(|own| own + 0.0);
        writer.serialize(columns.iter().map(value).collect::<Vec<_>>())?;
    }
    writer.into_inner().map_err(|error| error.into_error().into())
}
