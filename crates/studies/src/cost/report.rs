//! What accuracy costs, as tables, figures and in words.

use dashpot_analysis::work_precision::{CostPoint, CostReport, Deviation};
use dashpot_plot::{Chart, PrecisionCurve, PrecisionSeries};
use dashpot_report::{Block, Line, Place, Report, Table};

use super::{
    Costs,
    tables::{answer, cheapest, errors, failures, measures, reference_notes, underestimated, work},
};
use crate::{Cell, DataTable, list, sketch, title};

/// One row for each solution.
const TABLE: &str = "cost.csv";
/// Error over time, of the measures and of the state, and over work.
const FIGURES: [&str; 3] = ["error-time.svg", "state-error-time.svg", "error-work.svg"];

/// The files that are written besides the object and the page.
pub(super) fn files() -> Vec<String> {
    FIGURES.iter().chain([&TABLE]).map(|file| (*file).to_owned()).collect()
}

/// Everything that is said of it.
pub(super) fn report(costs: &Costs) -> Report {
    let Costs { scene, report: found, accuracies } = costs;
    let mut report = Report::titled(title(scene));
    report.verdict.push(Line { label: String::new(), text: answer(found, accuracies) });
    report.block(Place::Terminals, Block::Notes(reference_notes(found)));
    report.table(errors(found));
    report.block(Place::Terminals, Block::Table(work(found)));
    report.table(cheapest(found, accuracies));
    report.details =
        vec![Table::list("What is true", reference_notes(found)), work(found), measures(found)];
    for (caption, lines) in
        [("Failed", failures(found)), ("True error exceeds the estimate", underestimated(found))]
    {
        if !lines.is_empty() {
            report.block(Place::Terminals, Block::Heading(caption.to_owned(), String::new()));
            report.block(Place::Terminals, Block::Notes(lines.clone()));
            report.details.push(Table::list(caption, lines));
        }
    }
    for (file, chart) in FIGURES.into_iter().zip(charts(found)) {
        report.figure(file, chart);
    }
    report.network = sketch::figure(scene);
    report.scene_text = scene.text.to_string();
    report
}

/// The errors as the plain numbers that figures are drawn from.
fn series(report: &CostReport, title: &str, error: impl Fn(&CostPoint) -> f64) -> PrecisionSeries {
    let mut curves: Vec<PrecisionCurve> = Vec::new();
    for point in &report.points {
        if curves.last().is_none_or(|curve| curve.name != point.method) {
            let name = point.method.to_owned();
            curves.push(PrecisionCurve { name, ..PrecisionCurve::default() });
        }
        if let Some(curve) = curves.last_mut() {
            curve.time.push(point.time.median);
            curve.work.push(point.work.rhs_calls as f64);
            curve.error.push(error(point));
        }
    }
    let note = "no better than the truth is known; time to solve and to read all measures";
    PrecisionSeries { title: title.to_owned(), note: note.to_owned(), curves }
}

/// The three figures.
fn charts(report: &CostReport) -> [Chart; 3] {
    let worst = match report.asked.as_slice() {
        [only] => {
            let key = report.measures.get(*only).map_or("", |measure| measure.key.as_str());
            format!("What accuracy costs: {key}")
        }
        _ => "What accuracy costs: largest error of any measure".to_owned(),
    };
    let of_measures = series(report, &worst, |own| own.worst(&report.asked));
    let of_state = series(report, "What accuracy costs: largest error of the state", |own| {
        own.state.map_or(f64::NAN, Deviation::at_most)
    });
    [of_measures.time_chart(), of_state.time_chart(), of_measures.work_chart()]
}

/// Times, work, and each error beside how well the truth is known.
pub(super) fn table(report: &CostReport) -> DataTable<'_> {
    let measures = report.measures.iter().map(|measure| measure.key.as_str());
    let errors = ["state", "events"].into_iter().chain(measures).flat_map(|name| {
        [format!("error of {name} [1]"), format!("truth of {name} known within [1]")]
    });
    let header = list(COLUMNS.map(str::to_owned).into_iter().chain(errors));
    DataTable { file: TABLE.to_owned(), header, rows: Box::new(report.points.iter().map(row)) }
}

/// The columns of every solution.
const COLUMNS: [&str; 15] = [
    "method",
    "rtol [1]",
    "time [s]",
    "time, lower quartile [s]",
    "time, upper quartile [s]",
    "integration [s]",
    "repeats [1]",
    "steps [1]",
    "rejected [1]",
    "rhs [1]",
    "Jacobians [1]",
    "LU [1]",
    "solves [1]",
    "events missed [1]",
    "events extra [1]",
];

fn row(point: &CostPoint) -> Vec<Cell> {
    let (time, work) = (&point.time, &point.work);
    let counts = [
        point.repeats,
        work.accepted,
        work.rejected,
        work.rhs_calls,
        work.jacobian_calls,
        work.factorizations,
        work.linear_solves,
        point.events.missed,
        point.events.extra,
    ];
    let times = [time.median, time.lower, time.upper, point.integration.median];
    let measures = point.measures.iter().map(|measure| measure.deviation);
    let errors = [point.state, point.events.deviation].into_iter().chain(measures);
    let errors =
        errors.flat_map(|error| [error.map(|own| own.value), error.map(|own| own.known_within)]);
    let numbers = [point.rtol].into_iter().chain(times.map(Some));
    let method = Cell::Text(point.method.to_owned());
    [method]
        .into_iter()
        .chain(numbers.map(Cell::Number))
        .chain(counts.map(Cell::Count))
        .chain(errors.map(Cell::Number))
        .collect()
}
