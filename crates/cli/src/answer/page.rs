//! The answer as one HTML page.

use dashpot_plot::{Report, ReportFigure, Table};

use super::{
    Answer, energy_table, measures::notes, measures_table, reasons, settings::settings_table,
    solving_table, verdict,
};
use crate::as_run;

/// The page with these drawings.
pub(crate) fn page(answer: &Answer, figures: Vec<ReportFigure>) -> Report {
    let mut tables = vec![measures_table(answer)];
    let notes: Vec<Vec<String>> = notes(answer).into_iter().map(|note| vec![note]).collect();
    if !notes.is_empty() {
        tables.push(Table { caption: "Remarks".to_owned(), header: Vec::new(), rows: notes });
    }
    tables.extend(answer.best().map(energy_table));
    let why = reasons(answer).into_iter().map(|(method, why)| vec![method, why]).collect();
    let failed = answer.failed.iter().map(|(method, error)| format!("{method} failed: {error}"));
    let details = vec![
        solving_table(answer),
        Table { caption: "Why these methods".to_owned(), header: Vec::new(), rows: why },
        settings_table(answer),
    ];
    let changes = answer.changes.told().into_iter();
    let verdict = verdict(answer).into_iter();
    let lines = verdict.map(|line| format!("{}: {}", line.label, line.text));
    Report {
        title: answer.title().to_owned(),
        warnings: failed.chain(answer.warnings()).collect(),
        verdict: changes.chain(lines).collect(),
        tables,
        figures,
        details,
        scene_text: as_run::text(&answer.scene, &answer.changes),
    }
}
