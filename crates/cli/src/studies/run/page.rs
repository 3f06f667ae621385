//! The answer as one HTML page.

use dashpot_plot::{Report, ReportFigure, Table};

use super::{
    Answer,
    energy::energy_table,
    measures::{measures_table, notes},
    resolved_scene,
    settings::settings_table,
    solving::{reasons, solving_table},
    verdict::verdict,
};
use crate::input::title;

/// The page with these drawings.
pub(super) fn page(answer: &Answer, figures: Vec<ReportFigure>) -> Report {
    let mut tables = vec![measures_table(answer)];
    tables.extend(Some(Table::list("Remarks", notes(answer))).filter(|own| !own.rows.is_empty()));
    tables.extend(answer.best().map(energy_table));
    let why = reasons(answer).into_iter().map(|(method, why)| vec![method, why]);
    let failed = answer.failed.iter().map(|(method, error)| format!("{method} failed: {error}"));
    let details = vec![
        solving_table(answer),
        Table::new("Why these methods", &[], why),
        settings_table(answer),
    ];
    let changes = answer.changes.told().into_iter();
    let verdict = verdict(answer).into_iter();
    let lines = verdict.map(|line| format!("{}: {}", line.label, line.text));
    Report {
        title: title(&answer.scene).to_owned(),
        warnings: failed.chain(answer.warnings()).collect(),
        verdict: changes.chain(lines).collect(),
        tables,
        figures,
        details,
        scene_text: resolved_scene::text(&answer.scene, &answer.changes),
    }
}
