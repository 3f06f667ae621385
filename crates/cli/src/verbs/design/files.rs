//! What `design` writes: a scene into a file, or all that it says into a folder.

use dashpot_design::optimum::Design;
use dashpot_report::{Page, ReportFigure, Table};

use super::{
    DesignArguments,
    answer::Answer,
    asked::Asked,
    figures::{front, limits, map},
    tables, words,
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    output::{PAGE, Study as _, csv, list},
    said,
    verbs::run::scatter,
};
use dashpot_report::numbers::share;
use dashpot_studies::{origin, sketch};

/// The scene with what was found, in a folder.
const SCENE: &str = "best.toml";
/// All designs that were spread, and those of the front.
const DESIGNS: &str = "designs.csv";
const FRONT: &str = "front.csv";
const FRONT_FIGURE: &str = "front.svg";
const MAP: &str = "map.svg";

/// The files of a folder besides the result.
pub(super) fn all_names(asked: &Asked, scenes: usize) -> impl Iterator<Item = String> {
    let own = [DESIGNS, FRONT, FRONT_FIGURE, MAP, PAGE].map(str::to_owned);
    let numbers = (0..asked.numbers.len()).map(limits_file);
    own.into_iter().chain((0..scenes).map(scene_file)).chain(numbers)
}

/// The scene with what was found, and those of tests that have their own.
fn scene_file(scene: usize) -> String {
    if scene == 0 { SCENE.to_owned() } else { format!("best-{}.toml", scene + 1) }
}

fn limits_file(number: usize) -> String {
    format!("limits-{}.svg", number + 1)
}

impl DesignArguments {
    /// What the command line asks for, in words, for a page.
    pub(super) fn in_words(&self) -> Vec<(&'static str, String)> {
        let mut all: Vec<(&str, String)> = Vec::new();
        all.extend(self.solve_for.iter().map(|own| ("solve for", own.clone())));
        all.extend(self.vary.iter().map(|own| ("vary", own.clone())));
        all.extend(self.total.iter().map(|own| ("total", own.clone())));
        all.extend(self.least.iter().map(|own| ("least", own.clone())));
        all.extend(self.and.iter().map(|own| ("and", own.clone())));
        all.extend(self.limits.limit.iter().map(|own| ("limit", own.text.clone())));
        let set = |own: &[(String, String)]| {
            list(own.iter().map(|own| format!("{}={}", own.0, own.1))).join(", ")
        };
        all.extend(self.test.iter().map(|own| ("test", own.in_words(set(&own.set)))));
        let scene = &self.scene.values.set;
        all.extend((!scene.is_empty()).then(|| ("set", set(scene))));
        all.extend(self.robust.map(|own| ("robust", share(own))));
        all.push(("sample", self.sample.to_string()));
        all
    }
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, answer: &Answer) -> Result<(), CliError> {
    let Some((_, best)) = answer.best() else { return Ok(()) };
    for at in 0..answer.texts.len() {
        files.add_scene(scene_file(at), &answer.written(at))?;
    }
    files.add_with(DESIGNS, |out| {
        let (header, rows) = designs(answer, best);
        csv(out, header, rows)
    })?;
    if !answer.front.is_empty() {
        files.add_with(FRONT, |out| {
            let (header, rows) = front_rows(answer);
            csv(out, header, rows)
        })?;
    }
    let mut drawn: Vec<(String, ReportFigure)> = Vec::new();
    if let Some(own) = front(answer, best) {
        drawn.push((FRONT_FIGURE.to_owned(), ReportFigure::of(&own)?));
    }
    if let Some(own) = map(answer, best) {
        drawn.push((MAP.to_owned(), ReportFigure::of_map(&own)));
    }
    for number in 0..answer.asked.numbers.len() {
        if let Some(own) = limits(answer, best, number) {
            drawn.push((limits_file(number), ReportFigure::of(&own)?));
        }
    }
    for (name, own) in &drawn {
        files.add(name.clone(), &own.svg)?;
    }
    let figures = drawn.into_iter().map(|own| own.1).collect();
    files.add(PAGE, page(answer, best, figures).html())
}

fn page(answer: &Answer, best: &Design, figures: Vec<ReportFigure>) -> Page {
    let Some((choice, _)) = answer.best() else { return Page::default() };
    let lines = words::lines(answer, choice, best);
    let verdict = lines
        .iter()
        .filter(|own| matches!(own.label, "BEST" | "NONE" | "PASS" | "FAIL" | "UNDECIDED"));
    let verdict = list(verdict.map(|own| format!("{}: {}", own.label, own.text)));
    let rows = lines.iter().map(|own| vec![own.label.to_owned(), own.text.clone()]);
    let told = Table::plain("What was found", rows);
    let scattered = best.runs.iter().filter_map(scatter::table);
    let notes = Table::list("Remarks", said::notes(&answer.scene));
    let tables =
        [told].into_iter().chain(tables::all(answer, best)).chain(scattered).chain([notes]);
    let known = answer.warnings();
    let asked = answer.settings.iter().map(|(name, value)| vec![(*name).to_owned(), value.clone()]);
    Page {
        title: title(&answer.scene).to_owned(),
        warnings: list(said::warnings(&answer.scene, &known).into_iter().chain(known)),
        verdict,
        tables: list(tables.filter(|own| !own.rows.is_empty())),
        network: sketch::figure(&answer.scene),
        figures,
        details: vec![Table::plain(
            "Settings",
            asked.chain(origin::rows(&answer.scene, &crate::input::load)),
        )],
        scene_text: answer.text().to_owned(),
    }
}

type Rows = (Vec<String>, Vec<Vec<String>>);

fn number_names(asked: &Asked) -> impl Iterator<Item = String> + '_ {
    asked.numbers.iter().map(|own| format!("{} [{}]", own.name, own.si))
}

/// All designs that were spread, in SI units; blank where one cannot be solved.
fn designs(answer: &Answer, best: &Design) -> Rows {
    let asked = &answer.asked;
    let required = best.kept.iter().map(|own| words::what(asked, own));
    let further = [asked.least.name(asked).to_owned(), "largest excess".to_owned()];
    let header = list(number_names(asked).chain(required).chain(further));
    let rows = best.spread.iter().map(|own| {
        let required =
            (0..best.kept.len()).map(|at| own.required.get(at).copied().unwrap_or(f64::NAN));
        let all = own.values.iter().copied().chain(required).chain([own.aim, own.excess]);
        list(all.map(number))
    });
    (header, list(rows))
}

/// The designs of the front in SI units.
fn front_rows(answer: &Answer) -> Rows {
    let asked = &answer.asked;
    let names = [Some(&asked.least), asked.and.as_ref()].into_iter().flatten();
    let names =
        names.flat_map(|own| [own.name(asked).to_owned(), format!("error of {}", own.name(asked))]);
    let chosen = asked.among.iter().flat_map(|own| own.names.iter().cloned());
    let held = ["held by".to_owned()];
    let header = list(names.chain(number_names(asked)).chain(chosen).chain(held));
    let rows = answer.front.iter().map(|own| {
        let aims = own.aims(asked).into_iter();
        let aims =
            aims.flat_map(|(value, error)| [number(value), error.map_or(String::new(), number)]);
        let numbers = own.own.design.values.iter().copied().map(number);
        let chosen = asked.chosen(&own.choice).map(|own| own.1.text.clone());
        let held = [words::active(asked, &own.own.design).join("; ")];
        list(aims.chain(numbers).chain(chosen).chain(held))
    });
    (header, list(rows))
}

fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:e}") } else { String::new() }
}
