//! What `fit` writes: a scene into a file, or all that it says into a folder.

use dashpot_report::{Page, ReportFigure, Table};

use super::{
    FitArguments, Fitted,
    figures::{self, names, of_model, of_scene},
    is_on,
    scene::FittedScene,
    words,
};
use crate::{
    args::Switch,
    error::CliError,
    folder::Staged,
    input::title,
    output::{PAGE, Study as _, VERSION, list},
    said,
};
use dashpot_report::numbers::share;
use dashpot_studies::{origin, sketch};

/// The scene or model with what was found, in a folder.
const SCENE: &str = "fitted.toml";

/// The files of a folder besides the result.
pub(super) fn all_names(records: usize) -> impl Iterator<Item = String> {
    names(records).into_iter().chain([SCENE, PAGE].map(str::to_owned))
}

impl FitArguments {
    /// What the command line asks for, in words, for a page.
    pub(super) fn in_words(&self) -> Vec<(&'static str, String)> {
        let on = |own: Option<Switch>| if is_on(own) { "on" } else { "off" };
        let mut all: Vec<(&str, String)> = Vec::new();
        all.extend(self.to.iter().map(|own| ("to", own.text.clone())));
        all.extend(self.vary.iter().map(|own| ("vary", own.clone())));
        all.extend(self.values.set.iter().map(|own| ("set", format!("{}={}", own.0, own.1))));
        all.extend(self.cfc.map(|own| ("cfc", own.class().to_string())));
        all.extend(self.cfc.map(|_| ("padding", self.padding().words()[0].to_owned())));
        all.extend(self.noise.clone().map(|own| ("noise", own)));
        all.extend(self.gain.map(|own| ("gain", share(own))));
        all.push(("shift", on(self.shift).to_owned()));
        all.push(("robust", on(self.robust).to_owned()));
        if self.vary.is_empty() {
            all.push(("error", share(self.error())));
            all.extend(self.solid.then(|| ("solid", "yes".to_owned())));
        } else {
            all.push(("offset", on(self.offset).to_owned()));
            all.push(("starts", format!("{}, seed {}", self.starts(), self.seed())));
        }
        all
    }
}

/// Adds all files of a scene that was fitted but the result.
pub(super) fn write_fitted_scene(
    files: &mut Staged<'_>,
    fitted: &FittedScene<'_>,
) -> Result<(), CliError> {
    let text = fitted.scene_text(&fitted.comments());
    files.add_scene(SCENE, &fitted.written(&text))?;
    let figures = figures::write(files, &of_scene(fitted))?;
    let notes = said::notes(&fitted.plan.scene).into_iter().chain(fitted.notes());
    let known = fitted.warnings();
    let details = [settings(
        &fitted.plan.arguments.in_words(),
        origin::rows(&fitted.plan.scene, &crate::input::load),
    )];
    let drawn = fitted.fitted.as_ref();
    files.add(
        PAGE,
        Page {
            title: title(&fitted.plan.scene).to_owned(),
            warnings: list(said::warnings(&fitted.plan.scene, &known).into_iter().chain(known)),
            verdict: fitted.verdict_lines(),
            tables: with_rows(fitted.tables().into_iter().chain([Table::list("Remarks", notes)])),
            network: drawn.and_then(|own| sketch::of_network(&own.network, own.run.duration)),
            figures,
            details: details.to_vec(),
            scene_text: text,
        }
        .html(),
    )
}

/// Adds all files of a model that was fitted but the result.
pub(super) fn write_model(files: &mut Staged<'_>, fitted: &Fitted<'_>) -> Result<(), CliError> {
    files.add_scene(SCENE, &fitted.written())?;
    let figures: Vec<ReportFigure> = figures::write(files, &of_model(fitted))?;
    let tables = [words::records(fitted), words::determined(fitted), words::branches(fitted)];
    let notes = Table::list("Remarks", words::notes(fitted));
    let own = vec!["dashpot".to_owned(), VERSION.to_owned()];
    files.add(
        PAGE,
        Page {
            title: fitted.name().to_owned(),
            warnings: words::warnings(fitted),
            verdict: words::verdict(fitted),
            tables: with_rows(tables.into_iter().chain([notes])),
            network: None,
            figures,
            details: vec![settings(&fitted.arguments.in_words(), vec![own])],
            scene_text: fitted.text.clone(),
        }
        .html(),
    )
}

fn with_rows(tables: impl Iterator<Item = Table>) -> Vec<Table> {
    list(tables.filter(|own| !own.rows.is_empty()))
}

fn settings(asked: &[(&'static str, String)], further: Vec<Vec<String>>) -> Table {
    let rows = asked.iter().map(|(name, value)| vec![(*name).to_owned(), value.clone()]);
    Table::plain("Settings", rows.chain(further))
}
