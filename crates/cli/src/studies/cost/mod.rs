//! `dashpot cost`.

mod files;
mod object;
mod tables;
mod words;

use std::sync::Arc;

use dashpot_analysis::{
    Choice, RunError,
    work_precision::{CostReport, Ladder, Subject, work_precision_assembly},
};
use dashpot_scene::Scene;
use serde::Serialize;

use self::{
    tables::{cheapest, errors, work},
    words::{answer, failures, slips, truth},
};
use crate::{
    args::CostArguments,
    error::{CliError, Status},
    folder::{Folder, Staged},
    input::{read_scene, title},
    numbers::rounded,
    operand::tell,
    output::{Study, Text, emit},
    progress::Bar,
    terminal::Terminal,
};

/// The accuracies that everyone asks for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-6];

/// What errors and times have been found.
struct Costs {
    scene: Scene,
    report: CostReport,
    /// The accuracies for which the cheapest method is told.
    accuracies: Vec<f64>,
}

/// Finds out what accuracy costs in a scene.
pub(crate) fn cost(arguments: &CostArguments, terminal: Terminal) -> Result<Status, CliError> {
    let checked = read_scene(arguments.scene.scene.as_deref(), &arguments.scene.values.set)?;
    terminal.diagnose(&checked.warnings);
    tell(&checked.value.notes);
    let scene = checked.value;
    let folder = Folder::wanted(arguments.out.as_deref(), files::names())?;
    let assembly = Arc::new(scene.assembly.clone());
    let mut settings = scene.settings("auto")?;
    settings.budget = arguments.budget.unwrap_or(settings.budget);
    let mut bar = Bar::new("cost", settings.duration, terminal.error.attended);
    let report =
        work_precision_assembly(&assembly, &settings, &ladder(&scene, arguments)?, &mut bar)?;
    drop(bar);
    let accuracies = accuracies(scene.accuracy.default);
    let costs = Costs { scene, report, accuracies };
    emit(&costs, arguments.json, folder, terminal)?;
    Ok(if costs.report.points.is_empty() { Status::RunFailed } else { Status::Done })
}

/// What is tried: by default everything, judged by the measures that the scene wants an accuracy of.
fn ladder(scene: &Scene, arguments: &CostArguments) -> Result<Ladder, RunError> {
    let measures = if arguments.measure.is_empty() {
        scene.accuracy.by_measure.keys().cloned().collect()
    } else {
        arguments.measure.iter().map(|own| own.trim().to_owned()).collect()
    };
    let methods = arguments.method.iter().map(|own| Choice::named(own));
    Ok(Ladder {
        methods: methods.collect::<Result<_, _>>()?,
        measures,
        repeats: arguments.repeat.map(usize::from),
        ..Ladder::default()
    })
}

impl Study for Costs {
    fn text(&self, text: &mut Text) {
        let Self { scene, report, accuracies } = self;
        text.title(title(scene));
        text.items(truth(report));
        for table in [errors(report), work(report), cheapest(report, accuracies)] {
            text.table(&table);
        }
        for (heading, lines) in self.faults().into_iter().filter(|fault| !fault.1.is_empty()) {
            text.heading(heading);
            text.items(lines);
        }
        text.blank();
        text.words(&answer(report, accuracies));
    }

    fn object(&self) -> impl Serialize {
        object::object(self)
    }

    fn files(&self, files: &mut Staged<'_>) -> Result<(), CliError> {
        files::write(files, self)
    }
}

impl Costs {
    /// Solutions that failed, and errors that no run tells of.
    fn faults(&self) -> [(&'static str, Vec<String>); 2] {
        [
            ("Failed", failures(&self.report)),
            ("True error exceeds the estimate", slips(&self.report)),
        ]
    }
}

/// The accuracies for which the cheapest method is told: the usual ones and that of the scene.
fn accuracies(wish: f64) -> Vec<f64> {
    let is_new = |own: f64| (wish / own - 1.0).abs() > 1e-9;
    let mut all = ACCURACIES.to_vec();
    if all.iter().all(|own| is_new(*own)) {
        all.push(wish);
    }
    all.sort_by(|one, other| other.total_cmp(one));
    all
}

/// What an error is one of, as readers know it.
fn subject(report: &CostReport, subject: Subject) -> &str {
    match subject {
        Subject::State => "state",
        Subject::Events => "events",
        Subject::Measure(at) => report.measures.get(at).map_or("", |measure| measure.key.as_str()),
    }
}

/// A tolerance, or that there is none.
fn tolerance(rtol: Option<f64>) -> String {
    rtol.map_or("–".to_owned(), |rtol| format!("{rtol:e}"))
}

/// An accuracy as it is asked for: in percent, or where it is strict, as a power of ten.
fn wish(accuracy: f64) -> String {
    if accuracy < 1e-5 {
        format!("{accuracy:e}")
    } else {
        format!("{} %", rounded(100.0 * accuracy, "1", 3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn accuracies_are_written_as_they_are_asked_for() {
        assert_eq!([1e-2, 1e-3, 5e-4, 1e-6].map(wish), ["1 %", "0.1 %", "0.05 %", "1e-6"]);
    }

    #[test]
    fn the_accuracy_of_the_scene_is_told_once_in_its_place() {
        assert_eq!(accuracies(1e-3), [1e-2, 1e-3, 1e-6]);
        assert_eq!(accuracies(0.1 / 100.0), [1e-2, 1e-3, 1e-6]);
        assert_eq!(accuracies(1e-4), [1e-2, 1e-3, 1e-4, 1e-6]);
    }
}
