//! What tests have shown as figures, and as tables for programs.

use std::f64::consts::TAU;

use dashpot_analysis::rheometer::{LoadUnload, RheometerReport, Series};
use dashpot_network::parameters::Kind as _;
use dashpot_plot::{
    Chart, Loop, LoopSeries, Measured, ModelSeries, ModelSubject, RheometerLine, RheometerSeries,
    figures::model::{LOSS_FACTOR, MODEL_FIGURES, SWEEP},
};
use dashpot_report::{
    layout::capital,
    numbers::{percent_signed, share},
};
use dashpot_rheology::MaxwellForm;

use super::{Made, Tested, Units, beside::MeasuredLoop};
use crate::{Cell, DataTable, list};

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

/// The names of all files, with those of these tests.
pub(super) fn files<'n>(tests: impl Iterator<Item = &'n str>) -> Vec<String> {
    let models = MODEL_FIGURES.iter().map(|figure| format!("model-{}.svg", figure.name));
    let tests = tests.flat_map(|test| [format!("{test}.csv"), format!("{test}.svg")]);
    models.chain(tests).collect()
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

/// The figures of the model and those of the tests, with the names of their files.
pub(super) fn figures(tested: &Tested) -> Vec<(String, Chart)> {
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
    of_model.chain(of_tests).collect()
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

/// All that a test has shown, in columns.
pub(super) fn table(made: &Made, units: Units) -> DataTable<'_> {
    let report = &made.report;
    let header = |name: &str, unit| format!("{name} [{}]", units.of(unit));
    let all = |values: &[f64]| values.iter().copied().map(Some).collect::<Vec<_>>();
    let driven = [Some(&report.abscissa), report.drive.as_ref()].into_iter().flatten();
    let driven = driven.map(|driven| (header(&driven.name, driven.unit), all(&driven.values)));
    let answers = report.series.iter().flat_map(|series| {
        let computed = series.computed.iter().zip(&report.computations).map(|(answer, by)| {
            let name = format!("{} by {}", series.name, by.method);
            (header(&name, series.unit), answer.values.clone())
        });
        let model = (header(series.name, series.unit), all(&series.model));
        let model = Some(model).filter(|_| !series.model.is_empty());
        list(model.into_iter().chain(computed))
    });
    let (header, columns): (Vec<_>, Vec<_>) = driven.chain(answers).unzip();
    let cell = |column: &Vec<Option<f64>>, row: usize| column.get(row).copied().flatten();
    let rows = (0..report.abscissa.values.len())
        .map(move |row| list(columns.iter().map(|column| Cell::Number(cell(column, row)))));
    DataTable { file: format!("{}.csv", made.name), header, rows: Box::new(rows) }
}
