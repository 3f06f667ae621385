//! `dashpot cost`.

mod files;
mod tables;

use std::{collections::BTreeMap, path::PathBuf};

use clap::Args;
use dashpot_analysis::{
    Choice, RunError,
    work_precision::{CostPoint, CostReport, Ladder, Subject, work_precision_assembly},
};
use dashpot_scene::Scene;
use serde::Serialize;

use self::tables::{answer, cheapest, errors, failures, reference_notes, underestimated, work};
use crate::{
    args::{MethodNames, SceneArguments, budget, method_names},
    error::{CliError, Status},
    folder::{Folder, Staged},
    input::title,
    operand::{note_means, print_notes},
    output::{Study, Text, VERSION, emit, list, object},
    progress::Bar,
    terminal::Terminal,
};
use dashpot_report::numbers::rounded;

/// The accuracies that everyone asks for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-6];

/// `cost`.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    dashpot cost                                     the built-in reference impact\n  \
    dashpot cost pad.toml --measure pad.peak-force   what one number costs\n  \
    dashpot cost pad.toml --method bdf,tsit45        some methods alone\n  \
    dashpot cost pad.toml --out cost                 CSV, JSON, SVG and HTML\n\n\
    Each method solves the scene at tolerances from 1e-3 to 1e-11. Errors are taken from the \
    exact solution, or from two solutions by methods of different families. Times are those of \
    this machine; the counts of work are the same everywhere.")]
pub(crate) struct CostArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Methods that are tried [default: all].
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = MethodNames(method_names()))]
    method: Vec<String>,
    /// Measures by which methods are ranked, such as padding.peak-force [default: those that the
    /// scene wants an accuracy of, else all].
    #[arg(long, value_name = "KEY,…", value_delimiter = ',')]
    measure: Vec<String>,
    /// Most work of each solution, in units of a step of one unknown, 20 to 60 ns [default: 1e9, 20 to 60 s].
    #[arg(long, value_name = "UNITS", value_parser = budget)]
    budget: Option<u64>,
    /// How often each solution is repeated for its time [default: the more often, the fewer steps it has].
    #[arg(long, value_name = "NUMBER", value_parser = clap::value_parser!(u16).range(1..))]
    repeat: Option<u16>,
    /// Folder for CSV, JSON, SVG and HTML; it is made if need be.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Prints one JSON object, in SI units, in place of text.
    #[arg(long)]
    json: bool,
}

/// What errors and times have been found.
struct Costs {
    scene: Scene,
    report: CostReport,
    /// The accuracies for which the cheapest method is told.
    accuracies: Vec<f64>,
}

/// Finds out what accuracy costs in a scene.
pub(crate) fn cost(arguments: &CostArguments, terminal: Terminal) -> Result<Status, CliError> {
    let scene = arguments.scene.read(terminal)?;
    let folder = Folder::wanted(arguments.out.as_deref(), files::names())?;
    let mut settings = scene.settings("auto")?;
    settings.budget = arguments.budget.unwrap_or(settings.budget);
    let mut bar = Bar::new("cost", settings.duration, terminal.error.attended);
    let report =
        work_precision_assembly(&scene.assembly, &settings, &ladder(&scene, arguments)?, &mut bar)?;
    drop(bar);
    let accuracies = accuracies(scene.accuracy.default);
    let costs = Costs { scene, report, accuracies };
    print_notes(&costs.scene.notes);
    note_means(&costs.scene, terminal);
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
        text.items(reference_notes(report));
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

    /// All that was found, with the cheapest methods for each accuracy.
    fn object(&self) -> impl Serialize {
        let Self { scene, report, accuracies } = self;
        let measures = report.measures.iter().map(|measure| {
            let (value, unit, size, known_within) =
                (measure.value, measure.unit, measure.size, measure.known_within);
            (measure.key.as_str(), object! { value, unit, size, known_within })
        });
        object! {
            dashpot: VERSION,
            title: &scene.title,
            file: &scene.file,
            truth: reference_solution(report),
            auto: report.auto,
            asked: list(report.asked.iter().map(|&at| subject(report, Subject::Measure(at)))),
            measures: measures.collect::<BTreeMap<_, _>>(),
            points: list(report.points.iter().map(|own| point(report, own))),
            failures: list(report.failures.iter().map(|failure| object! {
                method: failure.method,
                rtol: failure.rtol,
                error: failure.error.to_string(),
                finer_tried: !failure.ends,
            })),
            silent: list(report.underestimates.iter().map(|underestimate| object! {
                method: underestimate.method,
                rtol: underestimate.rtol,
                what: subject(report, underestimate.subject),
                error: underestimate.error,
                bar: underestimate.bar,
                warned: underestimate.warned,
            })),
            cheapest: list(accuracies.iter().map(|&accuracy| cheapest_object(report, accuracy))),
        }
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
            ("True error exceeds the estimate", underestimated(&self.report)),
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

fn reference_solution(report: &CostReport) -> impl Serialize {
    let own = &report.reference;
    object! {
        method: own.method,
        rtol: own.rtol,
        why_not_exact: own.why_not_exact.as_ref().map(ToString::to_string),
        witness: own.witness.map(|(method, rtol)| object! { method, rtol }),
        agreement: object! {
            state: own.state_agreement,
            events: own.event_agreement,
            measures: own.measure_agreement,
        },
    }
}

fn point(report: &CostReport, cost_point: &CostPoint) -> impl Serialize {
    let reached = cost_point.measures.iter().map(|measure| {
        object! {
            error: measure.deviation.map(|deviation| deviation.value),
            known_within: measure.deviation.map(|deviation| deviation.known_within),
            bar: measure.bar,
            warned: measure.warned,
        }
    });
    let keys = report.measures.iter().map(|measure| measure.key.as_str());
    object! {
        method: cost_point.method,
        rtol: cost_point.rtol,
        time_s: cost_point.time,
        integration_s: cost_point.integration,
        repeats: cost_point.repeats,
        accepted: cost_point.work.accepted,
        rejected: cost_point.work.rejected,
        rhs_calls: cost_point.work.rhs_calls,
        jacobian_calls: cost_point.work.jacobian_calls,
        factorizations: cost_point.work.factorizations,
        linear_solves: cost_point.work.linear_solves,
        state: cost_point.state,
        events: cost_point.events,
        measures: keys.zip(reached).collect::<BTreeMap<_, _>>(),
    }
}

/// The cheapest method, and how many times as long ten times the accuracy takes.
fn cheapest_object(report: &CostReport, accuracy: f64) -> impl Serialize + use<> {
    let point = report.cheapest(accuracy);
    object! {
        accuracy,
        method: point.map(|point| point.method),
        rtol: point.and_then(|point| point.rtol),
        time_s: point.map(|point| point.time.median),
        next_digit: report.next_digit(accuracy),
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
