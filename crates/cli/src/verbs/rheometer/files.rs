//! What the rheometer writes into a folder.

use std::f64::consts::TAU;

use dashpot_analysis::rheometer::{LoadUnload, RheometerReport, Series};
use dashpot_network::parameters::Kind as _;
use dashpot_plot::{
    Chart, Loop, LoopSeries, Measured, ModelSeries, ModelSubject, RheometerLine, RheometerSeries,
    figures::model::{LOSS_FACTOR, MODEL_FIGURES, SWEEP},
};
use dashpot_report::ReportFigure;
use dashpot_rheology::MaxwellForm;

use super::{Made, Tested, Units, beside::MeasuredLoop, page::page};
use crate::{
    error::CliError,
    folder::Staged,
    numbers::{percent_signed, share},
    output::{PAGE, csv, list},
    text::capital,
};

/// Points of a curve of a model, and how far beyond its times it goes.
const POINTS: i32 = 400;
const BEYOND: f64 = 100.0;

/// The points of a series, from the model and from the first computation.
fn points(report: &RheometerReport, series: &Series) -> [Vec<(f64, f64)>; 2] {
    let places = &report.abscissa.values;
    let model = places.iter().copied().zip(series.model.iter().copied());
    let computed = series.computed.first().map_or(&[][..], |own| &own.values);
    let computed = places.iter().zip(computed).filter_map(|(&at, value)| Some((at, (*value)?)));
    [model.collect(), computed.collect()]
}

/// A test over time as a figure; a sweep is one of the model's.
pub(super) fn series(report: &RheometerReport, units: Units) -> Option<RheometerSeries> {
    let series = report.series.first().filter(|_| report.abscissa.unit == "s")?;
    let [model, simulated] = points(report, series);
    let measured = match (series.unit, units.is_material) {
        ("N", false) => Measured::Force,
        ("N", true) => Measured::Stress,
        (_, false) => Measured::Deformation,
        (_, true) => Measured::Strain,
    };
    let line = |at: f64, label: &str| RheometerLine { at, label: label.to_owned() };
    let lasting = report.figure("stays for good").and_then(|own| own.model);
    let held = report.settings.iter().filter(|setting| matches!(setting.name, "hold" | "rise"));
    let held: f64 = held.map(|held| held.value).sum();
    Some(RheometerSeries {
        title: capital(&report.protocol.replace('-', " ")),
        measured,
        model,
        simulated,
        levels: lasting.map(|lasting| line(lasting, "ε3, stays for good")).into_iter().collect(),
        instants: (held > 0.0 && measured_under_force(measured))
            .then(|| line(held, "unloading"))
            .into_iter()
            .collect(),
    })
}

fn measured_under_force(measured: Measured) -> bool {
    matches!(measured, Measured::Deformation | Measured::Strain)
}

/// The files of these tests.
pub(super) fn names(tests: impl Iterator<Item = String>) -> Vec<String> {
    let models = MODEL_FIGURES.iter().map(|own| format!("model-{}.svg", own.name));
    let tests = tests.flat_map(|test| [format!("{test}.csv"), format!("{test}.svg")]);
    models.chain(tests).chain([PAGE.to_owned()]).collect()
}

/// The figures of tests that differ in the values of their parameters alone, with the names of their files: of loops
/// one for all, else one for each test.
pub(super) fn charts(
    tests: &[Made],
    measured: Option<&MeasuredLoop>,
    units: Units,
) -> Vec<(String, Chart)> {
    let is_loop = |made: &&Made| made.report.protocol == LoadUnload::KIND;
    let Some(first) = tests.first().filter(is_loop) else {
        let one = |made: &Made| Some((made.name.clone(), series(&made.report, units)?.chart()));
        return tests.iter().filter_map(one).collect();
    };
    let loops = tests.iter().map(|made| {
        let name = if made.label.is_empty() { "model" } else { &made.label };
        let off = made.deviation.map_or_else(String::new, |own| {
            format!(": peak {}, rms {}", percent_signed(own.relative_peak()), share(own.rms))
        });
        Loop { name: format!("{name}{off}"), points: run_through(&made.report) }
    });
    let title = if units.is_material { "Stress over strain" } else { "Force over deformation" };
    let own = LoopSeries {
        title: title.to_owned(),
        subject: subject(units),
        loops: loops.collect(),
        measured: measured.map(|own| Loop {
            name: format!("measured, {}", own.file),
            points: own.points.clone(),
        }),
    };
    vec![(first.report.protocol.to_owned(), own.chart())]
}

/// The loop of a test as it is run through: that of the network, or else of the model.
pub(super) fn run_through(report: &RheometerReport) -> Vec<(f64, f64)> {
    let Some((series, drive)) = report.series.first().zip(report.drive.as_ref()) else {
        return Vec::new();
    };
    let computed = series.computed.first().map_or(&[][..], |own| &own.values);
    let pairs = drive.values.iter().zip(computed);
    let points: Vec<(f64, f64)> = pairs.filter_map(|(&at, value)| Some((at, (*value)?))).collect();
    if points.is_empty() {
        return drive.values.iter().copied().zip(series.model.iter().copied()).collect();
    }
    points
}

fn subject(units: Units) -> ModelSubject {
    if units.is_material { ModelSubject::Material } else { ModelSubject::Pad }
}

/// Adds all files but the result.
pub(super) fn write(files: &mut Staged<'_>, tested: &Tested) -> Result<(), CliError> {
    for made in &tested.tests {
        let columns = columns(&made.report, tested.units);
        let header = columns.iter().map(|column| column.0.clone());
        let value = |own: &(String, Vec<Option<f64>>), row: usize| {
            // A zero has no sign, and what is infinite no number.
            own.1.get(row).copied().flatten().filter(|own| own.is_finite()).map(|own| own + 0.0)
        };
        let rows = 0..made.report.abscissa.values.len();
        let rows = rows.map(|row| list(columns.iter().map(|column| value(column, row))));
        files.add_with(format!("{}.csv", made.name), |out| csv(out, header, rows))?;
    }
    let figures = figures(tested)?;
    files.add(PAGE, page(tested, figures.iter().map(|own| own.1.clone()).collect()).html())?;
    figures.into_iter().try_for_each(|(name, own)| files.add(format!("{name}.svg"), own.svg))
}

/// The figures of the model and those of the tests, with the names of their files.
fn figures(tested: &Tested) -> Result<Vec<(String, ReportFigure)>, CliError> {
    let curves = curves(tested);
    let of_model = curves.iter().flat_map(|curves| {
        MODEL_FIGURES.iter().map(|own| {
            let is_swept = [SWEEP.name, LOSS_FACTOR.name].contains(&own.name);
            let shown = if is_swept { &curves[..] } else { &curves[..1] };
            (format!("model-{}", own.name), own.chart(shown, subject(tested.units)))
        })
    });
    let groups = tested.groups();
    let of_tests = groups.flat_map(|group| charts(group, tested.measured.as_ref(), tested.units));
    let all = of_model.chain(of_tests);
    all.map(|(name, chart)| Ok((name, ReportFigure::of(&chart)?))).collect()
}

/// The functions of a linear model, and what a sweep of the network found.
fn curves(tested: &Tested) -> Option<Vec<ModelSeries>> {
    let specimen = &tested.specimen;
    let linear = specimen.linear()?;
    let (fastest, slowest) = specimen.range_of_times();
    let (low, high) = (fastest / BEYOND, slowest * BEYOND);
    let times: Vec<f64> =
        (0..=POINTS).map(|at| low * (high / low).powf(f64::from(at) / f64::from(POINTS))).collect();
    let over = |value: &dyn Fn(f64) -> f64, places: &[f64]| {
        places.iter().map(|&at| (at, value(at))).filter(|own| own.1.is_finite()).collect::<Vec<_>>()
    };
    let omegas: Vec<f64> = times.iter().rev().map(|time| time.recip()).collect();
    let spectrum = linear.maxwell().map(MaxwellForm::elements).unwrap_or_default();
    let model = ModelSeries {
        name: tested.word.clone(),
        relaxation: over(&|t| linear.relaxation(t), &times),
        spectrum: spectrum.iter().map(|own| (own.relaxation_time, own.stiffness)).collect(),
        creep: over(&|t| linear.creep(t), &times),
        storage: over(&|omega| linear.storage(omega), &omegas),
        loss: over(&|omega| linear.loss(omega), &omegas),
        loss_factor: over(&|omega| linear.loss_factor(omega), &omegas),
    };
    let mut reports = tested.tests.iter().map(|made| &made.report);
    let sweep = reports.find(|report| report.abscissa.unit == "Hz");
    let network = sweep.map(|report| {
        let of = |name: &str| {
            let found = report.series(name).map(|series| points(report, series)[1].clone());
            found.unwrap_or_default().into_iter().map(|(at, value)| (TAU * at, value)).collect()
        };
        ModelSeries {
            name: "network".to_owned(),
            storage: of("storage stiffness"),
            loss: of("loss stiffness"),
            loss_factor: of("loss factor"),
            ..ModelSeries::default()
        }
    });
    Some([model].into_iter().chain(network).collect())
}

/// All that a test has found, in columns.
fn columns(report: &RheometerReport, units: Units) -> Vec<(String, Vec<Option<f64>>)> {
    let header = |name: &str, unit| format!("{name} [{}]", units.of(unit));
    let all = |values: &[f64]| values.iter().copied().map(Some).collect();
    let given = [Some(&report.abscissa), report.drive.as_ref()].into_iter().flatten();
    let given = given.map(|given| (header(&given.name, given.unit), all(&given.values)));
    let found = report.series.iter().flat_map(|series| {
        let computed = series.computed.iter().zip(&report.computations).map(|(own, by)| {
            let name = format!("{} by {}", series.name, by.method);
            (header(&name, series.unit), own.values.clone())
        });
        let model = (header(series.name, series.unit), all(&series.model));
        let model = Some(model).filter(|_| !series.model.is_empty());
        list(model.into_iter().chain(computed))
    });
    list(given.chain(found))
}
