//! What `cost` draws, and what it writes into a folder.

use dashpot_analysis::work_precision::{CostPoint, CostReport, Deviation};
use dashpot_plot::{PrecisionCurve, PrecisionSeries};
use dashpot_report::{Page, ReportFigure, Table};

use super::{
    Costs,
    tables::{answer, cheapest, errors, measures, reference_notes, work},
};
use crate::{
    error::CliError,
    folder::Staged,
    input::title,
    output::{PAGE, csv, list},
};
use dashpot_studies::sketch;

/// One row for each solution.
const TABLE: &str = "cost.csv";
/// Error over time, of the measures and of the state, and over work.
const FIGURES: [&str; 3] = ["error-time.svg", "state-error-time.svg", "error-work.svg"];

/// The files that are written besides the result.
pub(super) fn names() -> Vec<String> {
    FIGURES.iter().chain([&TABLE, &PAGE]).map(|own| (*own).to_owned()).collect()
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

/// The three figures: name and drawing.
fn figures(report: &CostReport) -> Result<Vec<(String, ReportFigure)>, CliError> {
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
    let charts = [of_measures.time_chart(), of_state.time_chart(), of_measures.work_chart()];
    let drawn = FIGURES.into_iter().zip(charts);
    drawn.map(|(name, chart)| Ok((name.to_owned(), ReportFigure::of(&chart)?))).collect()
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, costs: &Costs) -> Result<(), CliError> {
    let figures = figures(&costs.report)?;
    let rows = costs.report.points.iter().map(row);
    files.add_with(TABLE, |out| csv(out, header(&costs.report), rows))?;
    files.add(PAGE, page(costs, &figures).html())?;
    figures.into_iter().try_for_each(|(name, own)| files.add(name, own.svg))
}

fn page(costs: &Costs, figures: &[(String, ReportFigure)]) -> Page {
    let Costs { scene, report, accuracies } = costs;
    let faults = costs.faults().map(|(caption, lines)| Table::list(caption, lines));
    let details =
        [Table::list("What is true", reference_notes(report)), work(report), measures(report)];
    let details = details.into_iter().chain(faults);
    Page {
        title: title(scene).to_owned(),
        warnings: Vec::new(),
        verdict: vec![answer(report, accuracies)],
        tables: vec![errors(report), cheapest(report, accuracies)],
        network: sketch::figure(scene),
        figures: figures.iter().map(|own| own.1.clone()).collect(),
        details: details.filter(|detail| !detail.rows.is_empty()).collect(),
        scene_text: scene.text.to_string(),
    }
}

/// Times, work, and each error beside how well the truth is known.
fn header(report: &CostReport) -> Vec<String> {
    let own = [
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
    let measures = report.measures.iter().map(|measure| measure.key.as_str());
    let errors = ["state", "events"].into_iter().chain(measures).flat_map(|name| {
        [format!("error of {name} [1]"), format!("truth of {name} known within [1]")]
    });
    list(own.map(str::to_owned).into_iter().chain(errors))
}

fn row(cost_point: &CostPoint) -> impl serde::Serialize {
    let (time, work) = (&cost_point.time, &cost_point.work);
    let counts = [
        cost_point.repeats,
        work.accepted,
        work.rejected,
        work.rhs_calls,
        work.jacobian_calls,
        work.factorizations,
        work.linear_solves,
        cost_point.events.missed,
        cost_point.events.extra,
    ];
    let measures = cost_point.measures.iter().map(|measure| measure.deviation);
    let errors = [cost_point.state, cost_point.events.deviation].into_iter().chain(measures);
    let errors =
        errors.flat_map(|error| [error.map(|own| own.value), error.map(|own| own.known_within)]);
    let times = [time.median, time.lower, time.upper, cost_point.integration.median];
    (cost_point.method, cost_point.rtol, times, counts, list(errors))
}
