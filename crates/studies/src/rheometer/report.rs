//! What tests have shown, in words and tables.

use dashpot_analysis::rheometer::Note;
use dashpot_report::{Block, Place, Report, Table};

use super::{
    Made, Tested, beside, figures,
    tables::{
        agreement, characteristics, error_of_all, figure_table, missing, settings, shared_settings,
        side_by_side, spectrum_table,
    },
    variants::summary,
};
use crate::VERSION;

/// Everything that is said of them.
pub(super) fn report(tested: &Tested) -> Report {
    let (units, common) = (tested.units, characteristics(&tested.tests));
    let mut report = Report::titled(&tested.word);
    let simulated = tested.specimen.nonlinear();
    report.notes(simulated.map(|kind| format!("`{kind}` is not linear: the model is simulated")));
    report.block(Place::Everywhere, Block::Rows(figure_table(common, units)));
    report.notes(missing(common, units));
    report.table(spectrum_table(&tested.specimen, units));
    for group in tested.groups() {
        add_test(&mut report, tested, group);
    }
    for (name, chart) in figures::figures(tested) {
        report.figure(format!("{name}.svg"), chart);
    }
    let version = [("dashpot".to_owned(), VERSION.to_owned())];
    let settings = version.iter().chain(&tested.set);
    let settings = settings.map(|(name, value)| vec![name.clone(), value.clone()]);
    report.details = vec![Table::plain("Settings", settings)];
    report.scene_text.clone_from(&tested.scene_text);
    report
}

/// Adds what is said of tests that differ in the values of their parameters alone.
fn add_test(report: &mut Report, tested: &Tested, group: &[Made]) {
    let (units, common) = (tested.units, characteristics(&tested.tests).len());
    let (settings, figures, missing) = if let [alone] = group {
        let figures = &alone.report.figures[common..];
        let settings = settings(&alone.report.settings, units);
        (settings, figure_table(figures, units), missing(figures, units))
    } else {
        (shared_settings(group, units), side_by_side(group, common, units), Vec::new())
    };
    let together = error_of_all(group);
    let of_each = group.iter().flat_map(|made| {
        let notes = made.report.notes.iter().map(Note::to_string);
        let label = |text: String| {
            if made.label.is_empty() { text } else { format!("{}: {text}", made.label) }
        };
        let agreed = if together.is_some() { Vec::new() } else { agreement(&made.report) };
        agreed.into_iter().chain(notes).map(label)
    });
    let protocol = group.first().map_or("", |made| made.report.protocol);
    report.block(
        Place::Everywhere,
        Block::Heading(format!("{protocol}: {}", summary(protocol)), settings),
    );
    report.block(Place::Everywhere, Block::Rows(figures));
    report.notes(missing.into_iter().chain(of_each).chain(together.clone()));
    if let Some(deviations) = beside::deviations(group, units) {
        report.table(deviations);
        report.notes(tested.measured.iter().filter_map(|measured| measured.note.clone()));
    }
    for (_, chart) in figures::charts(group, tested.measured.as_ref(), units) {
        report.block(Place::Terminals, Block::Chart(chart));
    }
}
