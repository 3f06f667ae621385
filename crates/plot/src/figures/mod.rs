//! The register of figures.
//!
//! A figure is one file here: a type, its [`Figure`] implementation, and a line in [`FIGURES`].

mod deformation_time;
mod energy_time;
mod force_deformation;
mod force_time;
mod markers;
pub mod model;
mod run_series;
mod unit;
mod vibration;
mod work_precision;

use crate::{Chart, Pattern, Series, Stroke};

pub use deformation_time::DeformationTime;
pub use energy_time::EnergyTime;
pub use force_deformation::ForceDeformation;
pub use force_time::ForceTime;
pub use run_series::{ElementSeries, EnergySeries, RunMarker, RunMarkerKind, RunSeries};
use unit::Unit;
pub use vibration::{VibrationCurve, VibrationSeries};
pub use work_precision::{PrecisionCurve, PrecisionSeries};

/// Every figure, in the order of the report. **A new figure is registered here.**
pub const FIGURES: &[&dyn Figure] = &[&ForceTime, &DeformationTime, &ForceDeformation, &EnergyTime];

/// A figure drawn from one or several runs of the same scene.
pub trait Figure: Sync {
    /// Name in files and on the command line, as in `force-time`.
    fn name(&self) -> &'static str;

    /// Heading, as in `Force over time`.
    fn title(&self) -> &'static str;

    /// The chart of `runs`, which differ in their method; what they have nothing of stays empty.
    fn chart(&self, runs: &[RunSeries]) -> Chart;
}

/// Curves beyond these in one figure cannot be told apart.
const MOST_CURVES: usize = 6;

/// One quantity of all runs: a name and, per run, its curve in SI units.
struct Quantity {
    name: String,
    curves: Vec<Vec<(f64, f64)>>,
}

/// The quantities of largest magnitude, in their order, and a remark when some are left out.
fn largest(mut quantities: Vec<Quantity>, kind: &str) -> (Vec<Quantity>, String) {
    let total = quantities.len();
    if total <= MOST_CURVES {
        return (quantities, String::new());
    }
    let size = |q: &Quantity| {
        let values = q.curves.iter().flatten().map(|p| p.1.abs()).filter(|v| v.is_finite());
        values.fold(0.0_f64, f64::max)
    };
    let mut sizes: Vec<f64> = quantities.iter().map(size).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    let least = sizes[MOST_CURVES - 1];
    quantities.retain(|q| size(q) >= least);
    quantities.truncate(MOST_CURVES);
    (quantities, format!("the {MOST_CURVES} largest of {total} {kind}"))
}

/// What stands below a heading: which part of the run is shown, and what is left out.
fn note(runs: &[RunSeries], left_out: &str) -> String {
    let excerpt = runs.first().and_then(excerpt).unwrap_or_default();
    let said = [&*excerpt, left_out].into_iter().filter(|text| !text.is_empty());
    said.collect::<Vec<_>>().join("; ")
}

/// Which part of a run is shown, as in `from 552.1 to 564.5 ms of 600 ms`.
fn excerpt(run: &RunSeries) -> Option<String> {
    let (end, from, to) = (run.excerpt_of?, *run.time.first()?, *run.time.last()?);
    let unit = Unit::time(run.time.iter().copied());
    let number = |time: f64| unit.number_within(time, to - from);
    Some(format!(
        "from {} to {} {} of {}",
        number(from),
        number(to),
        unit.symbol(),
        unit.print(end)
    ))
}

/// Curves scaled from SI to the units of the axes: one colour per quantity, one pattern per run. Of several runs the
/// first is broad and pale, so that another one on it stays visible.
fn curves(
    runs: &[RunSeries],
    quantities: &[Quantity],
    x_factor: f64,
    y_factor: f64,
) -> Vec<Series> {
    let alone = quantities.len() == 1;
    let mut series = Vec::new();
    for (run, of_run) in runs.iter().enumerate() {
        for (colour, quantity) in quantities.iter().enumerate() {
            let Some(curve) = quantity.curves.get(run).filter(|curve| !curve.is_empty()) else {
                continue;
            };
            let name = match (runs.len(), alone) {
                (0 | 1, _) => quantity.name.clone(),
                _ => format!("{}, {}", quantity.name, of_run.method),
            };
            let (pattern, colour) = match run {
                0 if runs.len() > 1 => (Pattern::Broad, colour),
                0 => (Pattern::Solid, colour),
                // A single quantity has colours to spare for its runs.
                _ if alone => (if run == 1 { Pattern::Dashed } else { Pattern::Dotted }, run),
                1 => (Pattern::Dashed, colour),
                _ => (Pattern::Dotted, colour),
            };
            let points = curve.iter().map(|&(x, y)| (x / x_factor, y / y_factor)).collect();
            series.push(Series { name, points, stroke: Some(Stroke { colour, pattern }) });
        }
    }
    series
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Two runs of a decaying impact on two elements; peaks at t = 1 ms.
    pub(crate) fn runs() -> Vec<RunSeries> {
        ["exact", "bdf"].map(run).to_vec()
    }

    fn run(method: &str) -> RunSeries {
        let time: Vec<f64> = (0..=200).map(|i| f64::from(i) * 1e-4).collect();
        let pulse = |t: &f64| t / 1e-3 * (1.0 - t / 1e-3).exp();
        let element = |name: &str, force: f64, thickness| ElementSeries {
            name: name.into(),
            force: time.iter().map(|t| force * pulse(t) - 2e3).collect(),
            deformation: time.iter().map(|t| 17.5e-3 * pulse(&(t / 5.0))).collect(),
            thickness,
            is_contact: false,
        };
        RunSeries {
            method: method.into(),
            elements: vec![
                element("padding", 40_400.0, Some(0.02)),
                element("mount <&>", 20_000.0, None),
            ],
            energy: vec![
                EnergySeries {
                    name: "kinetic".into(),
                    values: time.iter().map(|t| 500.0 - 2e4 * t).collect(),
                },
                EnergySeries {
                    name: "dissipated".into(),
                    values: time.iter().map(|t| 2e4 * t).collect(),
                },
            ],
            markers: vec![RunMarker {
                element: "padding".into(),
                kind: RunMarkerKind::PeakForce,
                time: 1e-3,
                label: "peak 38.4 kN".into(),
                moment: "1.00 ms".into(),
            }],
            excerpt_of: None,
            time,
        }
    }

    #[test]
    fn names_are_unique_and_every_figure_draws_both_runs() {
        for (i, figure) in FIGURES.iter().enumerate() {
            assert!(FIGURES[..i].iter().all(|other| other.name() != figure.name()));
            let chart = figure.chart(&runs());
            assert_eq!(chart.series.len(), 4, "{}", figure.name());
            let named = |method| chart.series.iter().filter(|s| s.name.ends_with(method)).count();
            assert_eq!((named("exact"), named("bdf")), (2, 2), "{}", figure.name());
            assert_eq!(chart.series[0].stroke.map(|s| s.pattern), Some(Pattern::Broad));
            assert_eq!(chart.series[3].stroke.map(|s| s.pattern), Some(Pattern::Dashed));
        }
    }

    #[test]
    fn every_figure_draws_from_nothing() {
        for figure in FIGURES {
            for runs in [vec![], vec![RunSeries::default()]] {
                assert!(figure.chart(&runs).series.is_empty(), "{}", figure.name());
                assert!(figure.chart(&runs).svg().is_ok());
            }
        }
    }

    #[test]
    fn a_marker_sits_on_its_curve_in_the_units_of_the_axes() {
        let chart = ForceTime.chart(&runs());
        let marker = &chart.markers[0];
        assert!((marker.x - 1.0).abs() < 1e-12, "{marker:?}");
        assert!((marker.y - 38.4).abs() < 1e-9, "{marker:?}");
        assert_eq!(chart.y_label, "force (kN)");
    }

    #[test]
    fn a_text_names_its_elements_where_several_are_shown() {
        let labels = |run: RunSeries| -> Vec<String> {
            ForceTime.chart(&[run]).markers.into_iter().map(|marker| marker.label).collect()
        };
        let mut run = run("exact");
        assert_eq!(labels(run.clone()), ["padding: peak 38.4 kN at 1.00 ms"]);
        let second = RunMarker { element: "mount <&>".into(), ..run.markers[0].clone() };
        run.markers.push(second);
        assert_eq!(labels(run.clone()).len(), 2, "the same text at other points");
        run.elements[1].force = run.elements[0].force.clone();
        assert_eq!(labels(run.clone()), ["padding, mount <&>: peak 38.4 kN at 1.00 ms"]);
        run.elements.truncate(1);
        assert_eq!(labels(run), ["peak 38.4 kN at 1.00 ms"]);
    }

    #[test]
    fn limits_have_the_colours_of_their_curves_and_equal_ones_are_one_line() {
        let mut run = run("exact");
        run.elements[1].thickness = Some(0.03);
        let lines = DeformationTime.chart(&[run.clone()]).lines;
        let colours: Vec<_> = lines.iter().map(|line| line.colour).collect();
        assert_eq!(colours, [Some(0), Some(1)]);
        run.elements[1].thickness = Some(0.02);
        let lines = DeformationTime.chart(&[run]).lines;
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].label, "thickness of padding, mount <&>: 20 mm");
        assert_eq!(lines[0].colour, None);
    }

    #[test]
    fn the_gap_of_a_contact_is_drawn_over_time_but_has_no_force_over_it() {
        let mut run = run("exact");
        run.elements[1].is_contact = true;
        let names = |chart: Chart| {
            chart.series.iter().map(|series| series.name.clone()).collect::<Vec<_>>()
        };
        let runs = [run];
        assert_eq!(names(ForceDeformation.chart(&runs)), ["padding"]);
        assert_eq!(names(DeformationTime.chart(&runs)), ["padding", "mount <&>"]);
        assert_eq!(names(ForceTime.chart(&runs)), ["padding", "mount <&>"]);
    }

    #[test]
    fn crowded_figures_keep_the_largest_quantities_and_say_so() {
        let mut run = run("exact");
        run.elements = (0..30)
            .map(|i| ElementSeries {
                name: format!("e{i}"),
                force: vec![f64::from(i); 3],
                ..run.elements[0].clone()
            })
            .collect();
        let chart = ForceTime.chart(&[run]);
        let names: Vec<&str> = chart.series.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["e24", "e25", "e26", "e27", "e28", "e29"]);
        assert_eq!(chart.note, "the 6 largest of 30 elements");
    }

    #[test]
    fn every_figure_says_which_part_of_the_run_it_shows() {
        let mut runs = runs();
        assert!(FIGURES.iter().all(|figure| figure.chart(&runs).note.is_empty()));
        runs[0].excerpt_of = Some(1.0);
        runs[0].time.iter_mut().for_each(|time| *time += 0.5);
        for figure in FIGURES {
            assert_eq!(
                figure.chart(&runs).note,
                "from 500 to 520 ms of 1000 ms",
                "{}",
                figure.name()
            );
        }
    }
}
