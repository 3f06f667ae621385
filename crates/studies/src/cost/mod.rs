//! What accuracy costs: true errors of every method against time and work.

mod report;
mod tables;

use std::collections::BTreeMap;

use dashpot_analysis::{
    RunError,
    work_precision::{CostPoint, CostReport, Ladder, Subject, work_precision_assembly},
};
use dashpot_report::Report;
use dashpot_scene::Scene;
use serde::{Serialize, Serializer};

use self::tables::subject;
use crate::{
    Answer, Budget, Context, DataTable, MethodName, Operands, Outcome, Remark, Repeats, Study,
    StudyError, VERSION,
    context::Solving,
    list, object,
    operand::remark_means,
    request,
    study::{self, about_study},
};

/// The accuracies that everyone asks for.
const ACCURACIES: [f64; 3] = [1e-2, 1e-3, 1e-6];

request! {
    /// What is tried in a scene.
    pub CostRequest {
        /// Methods that are tried [default: all].
        method "NAME,…": Vec<MethodName>;
        /// Measures by which methods are ranked, such as padding.peak-force [default: those that the
        /// scene wants an accuracy of, else all].
        measure "KEY,…": Vec<String>;
        /// Most work of each solution, in units of a step of one unknown, 20 to 60 ns [default: 1e9, 20 to 60 s].
        budget "UNITS": Option<Budget>;
        /// How often each solution is repeated for its time [default: the more often, the fewer steps it has].
        repeat "NUMBER": Option<Repeats>;
    }
}

/// The errors, times and work of every method in a scene.
#[derive(Debug)]
#[non_exhaustive]
pub struct Costs {
    /// The scene.
    pub scene: Scene,
    /// Errors, times and work.
    pub report: CostReport,
    /// The accuracies for which the cheapest method is shown, as parts of a measure.
    pub accuracies: Vec<f64>,
}

/// Solves a scene by every method at tolerances from 1e-3 to 1e-11.
///
/// # Errors
///
/// [`StudyError::Run`] for a measure or method that is not there, and where nothing tells the true solution.
pub fn cost(
    scene: Scene,
    request: &CostRequest,
    context: &mut dyn Context,
) -> Result<Costs, StudyError> {
    context.prepare(report::files())?;
    let mut settings = scene.settings("auto")?;
    settings.budget = request.budget.map_or(settings.budget, |budget| budget.0);
    let ladder = ladder(&scene, request)?;
    let mut solving = Solving { end: settings.duration, context };
    let report = work_precision_assembly(&scene.assembly, &settings, &ladder, &mut solving)?;
    let accuracies = accuracies(scene.accuracy.default);
    scene.notes.iter().for_each(|note| context.remark(Remark::Model(note)));
    remark_means(&scene, context);
    Ok(Costs { scene, report, accuracies })
}

/// What is tried: by default everything, judged by the measures that the scene wants an accuracy of.
fn ladder(scene: &Scene, request: &CostRequest) -> Result<Ladder, RunError> {
    let measures = if request.measure.is_empty() {
        scene.accuracy.by_measure.keys().cloned().collect()
    } else {
        request.measure.clone()
    };
    Ok(Ladder {
        methods: MethodName::choices(&request.method)?,
        measures,
        repeats: request.repeat.map(|repeats| repeats.0),
        ..Ladder::default()
    })
}

/// The study.
pub(crate) struct Cost;

impl Study for Cost {
    about_study! {
        "cost", CostRequest, Operands::Scene,
        "Shows what accuracy costs: true errors of every method against time and work",
        "Examples:\n  \
         dashpot cost                                     the built-in reference impact\n  \
         dashpot cost pad.toml --measure pad.peak-force   what one number costs\n  \
         dashpot cost pad.toml --method bdf,tsit45        some methods alone\n  \
         dashpot cost pad.toml --out cost                 CSV, JSON, SVG and HTML\n\n\
         Each method solves the scene at tolerances from 1e-3 to 1e-11. Errors are taken from the \
         exact solution, or from two solutions by methods of different families. Times are those of \
         this machine; the counts of work are the same everywhere.",
        |operands, set, request, context| cost(study::scene(operands, set, context)?, &request, context)?
    }
}

impl Answer for Costs {
    fn report(&self) -> Report {
        report::report(self)
    }

    fn tables(&self) -> Vec<DataTable<'_>> {
        vec![report::table(&self.report)]
    }

    fn outcome(&self) -> Outcome {
        if self.report.points.is_empty() { Outcome::Failed } else { Outcome::Done }
    }
}

impl Serialize for Costs {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { scene, report, accuracies } = self;
        let measures = report.measures.iter().map(|measure| {
            let (value, unit, size, known_within) =
                (measure.value, measure.unit, measure.size, measure.known_within);
            (measure.key.as_str(), object! { value, unit, size, known_within })
        });
        let object = object! {
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
        };
        object.serialize(serializer)
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
    fn the_accuracy_of_the_scene_stands_once_in_its_place() {
        assert_eq!(accuracies(1e-3), [1e-2, 1e-3, 1e-6]);
        assert_eq!(accuracies(0.1 / 100.0), [1e-2, 1e-3, 1e-6]);
        assert_eq!(accuracies(1e-4), [1e-2, 1e-3, 1e-4, 1e-6]);
    }
}
