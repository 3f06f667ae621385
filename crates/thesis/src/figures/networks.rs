//! Figures 1, 2, 4 and 21: the impact, the padding under a load that is held, where e^z meets a straight line, and
//! the equivalent model.

use dashpot_analysis::rheometer::{LoadHoldUnload, ProtocolKind, RheometerReport, Specimen};
use dashpot_plot::{Chart, Marker, Series};

use super::{Column, Figure};
use crate::{
    Padding, Pulse, Scales, Study, ThesisError,
    groups::{in_parallel, two_maxwell},
    lambert::intersections,
    words::{short, significant},
};

/// Force \[N\] and times \[s\] of figure 2: held so long, and looked at until.
const FORCE: f64 = 20e3;
const HOLD: f64 = 1e-3;
const END: f64 = 2.5e-3;

pub(super) fn impact(study: &Study) -> Result<Figure, ThesisError> {
    let network = study.system.groups.network(&Scales::CHAPTER_4)?;
    Ok(Figure::of_network(1, "Schematic of impact system", network))
}

pub(super) fn equivalent(study: &Study) -> Result<Figure, ThesisError> {
    let pad = in_parallel(two_maxwell(Padding::CHAPTER_4)?);
    let network = study.system.groups.network_with(&Scales::CHAPTER_4, pad);
    Ok(Figure::of_network(21, "An equivalent model", network))
}

/// The names of the parts in the thesis.
fn part(name: &str) -> String {
    match name {
        "deformation" => "ε, all of it".to_owned(),
        "instantaneous" => "ε2, spring K2".to_owned(),
        "delayed" => "ε1, Kelvin element K1, C1".to_owned(),
        "viscous" => "ε3, dashpot C2".to_owned(),
        other => other.to_owned(),
    }
}

pub(super) fn load_hold_unload() -> Result<Figure, ThesisError> {
    let specimen = Specimen::new(&Padding::CHAPTER_4.model())?;
    let test = LoadHoldUnload {
        force: Some(FORCE),
        hold: Some(HOLD),
        end: Some(END),
        ..LoadHoldUnload::default()
    };
    let report: RheometerReport = test.test(&specimen, &[])?;
    let times = &report.abscissa.values;
    let of_length = || report.series.iter().filter(|own| own.unit == "m");
    let series = of_length().map(|own| {
        let points = times.iter().zip(&own.model).map(|(time, value)| (1e3 * time, 1e3 * value));
        Series::new(part(own.name), points.collect())
    });
    let title = "Stress-strain characteristic of four parameter padding system";
    let chart = Chart {
        title: "Figure 2. Load, hold and unload of the padding".to_owned(),
        note: "A force of 20 kN is put on, held for 1 ms and taken away.".to_owned(),
        x_label: "time (ms)".to_owned(),
        y_label: "deformation (mm)".to_owned(),
        series: series.collect(),
        ..Chart::default()
    };
    let time = Column { name: "time [s]".to_owned(), values: times.clone() };
    let columns = of_length()
        .map(|own| Column { name: format!("{} [m]", own.name), values: own.model.clone() });
    Ok(Figure::of_chart(2, title, chart, [time].into_iter().chain(columns).collect()))
}

/// A pulse whose straight line is drawn, or counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GraphCase {
    /// The letter of its line.
    pub line: char,
    /// What it shows.
    pub what: &'static str,
    /// The pulse, on the padding of chapter IV.
    pub pulse: Pulse,
}

/// Start slopes and decays: two roots, one and none, as in the thesis' figure; then a falling line
/// without any time, and the thesis' own numbers.
const CASES: [(char, &str, f64, f64); 5] = [
    ('a', "two roots", 9.9, 5.0),
    ('b', "one root", 0.5, 5.0),
    ('c', "no root", 2.0, 2.0),
    ('d', "one root, before the impact", 5.0, 2.0),
    ('e', "the thesis' own numbers", Pulse::PRINTED.slope, Pulse::PRINTED.decay),
];
/// So many of them are drawn.
const DRAWN: usize = 3;
/// Range of z, and points in it.
const RANGE: (f64, f64) = (-4.0, 2.0);
const POINTS: u32 = 240;

/// The cases of figure 4, and two more.
pub fn graph_cases() -> Vec<GraphCase> {
    let pulse = |slope, decay| Pulse { slope, decay, ..Pulse::PRINTED };
    let case = |(line, what, slope, decay)| GraphCase { line, what, pulse: pulse(slope, decay) };
    CASES.into_iter().map(case).collect()
}

pub(super) fn graph() -> Figure {
    let (low, high) = RANGE;
    let z = |at: u32| low + (high - low) * f64::from(at) / f64::from(POINTS);
    let places: Vec<f64> = (0..=POINTS).map(z).collect();
    let curve = |of: &dyn Fn(f64) -> f64| places.iter().map(|&z| (z, of(z))).collect::<Vec<_>>();
    let mut series = vec![Series::new("e^z", curve(&f64::exp))];
    let mut markers = Vec::new();
    for graph_case in graph_cases().into_iter().take(DRAWN) {
        let Some(constants) = graph_case.pulse.constants() else { continue };
        let (theta, psi) = (constants.theta, constants.psi);
        let name = format!(
            "{}, {}: P = {}, m = {}, θ = {}, ψ = {}",
            graph_case.line,
            graph_case.what,
            short(graph_case.pulse.slope, 4),
            short(graph_case.pulse.decay, 4),
            significant(theta, 3),
            significant(psi, 3)
        );
        series.push(Series::new(name, curve(&|z| theta * z + psi)));
        for root in intersections(theta, psi) {
            let time = root / (graph_case.pulse.decay - constants.nu);
            let label = format!("z = {}, τ* = {}", significant(root, 3), significant(time, 3));
            markers.push(Marker { x: root, y: root.exp(), label });
        }
    }
    let column = |name: &str, values: Vec<f64>| Column { name: format!("{name} [1]"), values };
    let lines = series.iter().map(|own| {
        let name = own.name.replace(',', ";");
        column(&name, own.points.iter().map(|point| point.1).collect())
    });
    let columns = [column("z", places.clone())].into_iter().chain(lines).collect();
    let title = "Graphical solution to equation 3.39";
    let chart = Chart {
        title: format!("Figure 4. {title}"),
        note: "z = (m − ν) τ* with ν = 10: times after the first contact are to the left of z = 0."
            .to_owned(),
        x_label: "z".to_owned(),
        y_label: "e^z and θ z + ψ".to_owned(),
        series,
        markers,
        ..Chart::default()
    };
    Figure::of_chart(4, title, chart, columns)
}
