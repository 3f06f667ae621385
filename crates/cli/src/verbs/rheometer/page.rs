//! The page of a model that was tested.

use dashpot_report::{Page, ReportFigure, Table};

use super::{
    Tested,
    tables::{characteristics, figure_table, missing, spectrum_table},
};
use crate::output::VERSION;

/// Everything that the tests say, on one page with these figures.
pub(super) fn page(tested: &Tested, figures: Vec<ReportFigure>) -> Page {
    let (units, common) = (tested.units, characteristics(&tested.tests));
    let simulated = tested.specimen.nonlinear();
    let simulated = simulated.map(|kind| format!("`{kind}` is not linear: the model is simulated"));
    let characteristics = figure_table(common, units).rows.into_iter().map(|row| row.join(" "));
    let told: Vec<_> = tested.groups().map(|group| tested.told(group)).collect();
    let spectra = Some(spectrum_table(&tested.specimen, units));
    let of_tests = told.iter().flat_map(|own| [Some(own.figures.clone()), own.deviations.clone()]);
    let tables = [spectra].into_iter().chain(of_tests).flatten();
    let details = told.iter().map(|own| {
        let caption = format!("Settings and notes of {}", own.protocol());
        let measured = tested.measured.iter().filter(|_| own.deviations.is_some());
        let notes = own.remarks.iter().chain(measured.filter_map(|own| own.note.as_ref()));
        Table::list(caption, [&own.settings].into_iter().chain(notes).cloned())
    });
    let version = [("dashpot".to_owned(), VERSION.to_owned())];
    let settings = version.iter().chain(&tested.set);
    let settings = settings.map(|(name, value)| vec![name.clone(), value.clone()]);
    let settings = Table::plain("Settings", settings);
    let verdict = simulated.into_iter().chain(characteristics);
    Page {
        title: tested.word.clone(),
        warnings: Vec::new(),
        verdict: verdict.chain(missing(common, units)).collect(),
        tables: tables.filter(|own| !own.rows.is_empty()).collect(),
        network: None,
        figures,
        details: details.chain([settings]).collect(),
        scene_text: tested.scene_text.clone(),
    }
}
