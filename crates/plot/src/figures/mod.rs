//! The register of figures.
//!
//! A figure of runs is one line of [`FIGURES`]: which signal stands over which, and what is marked.

mod markers;
mod measured;
pub mod model;
mod notes;
mod run_series;
mod unit;
mod vibration;
mod work_precision;

use self::{
    markers::markers,
    measured::measured,
    notes::note,
    run_series::{limit_lines, quantities, thickness_lines},
};
use crate::{Chart, Direction, Pattern, Series, Stroke, theme::COLOURS};

pub use measured::MeasuredSeries;
pub use run_series::{
    ElementSeries, EnergySeries, NodeSeries, Of, RunLimit, RunMarker, RunMarkerKind, RunRank,
    RunSeries,
};
pub use vibration::{VibrationCurve, VibrationSeries};
pub use work_precision::{PrecisionCurve, PrecisionSeries};

use RunMarkerKind::{DeepestPoint, PeakForce, TensionStart};

/// Every figure, in the order of the report. **A new figure is registered here.**
pub const FIGURES: &[Figure] = &[
    FORCE_TIME,
    ACCELERATION_TIME,
    VELOCITY_TIME,
    DEFORMATION_TIME,
    FORCE_DEFORMATION,
    ENERGY_TIME,
];

/// Force of each element over time, positive in compression.
pub const FORCE_TIME: Figure = Figure {
    name: "force-time",
    title: "Force over time",
    x: Of::Time,
    y: Of::Force,
    kinds: &[PeakForce, TensionStart],
};

/// Acceleration of each mass over time, as an accelerometer reads it, positive away from the support: free fall is 0.
pub const ACCELERATION_TIME: Figure = Figure {
    name: "acceleration-time",
    title: "Acceleration over time",
    x: Of::Time,
    y: Of::Acceleration,
    kinds: &[],
};

/// Velocity of each mass over time, positive towards the support.
pub const VELOCITY_TIME: Figure = Figure {
    name: "velocity-time",
    title: "Velocity over time",
    x: Of::Time,
    y: Of::Velocity,
    kinds: &[],
};

/// Deformation of each element over time, positive in compression, with the thickness of pads as a limit. Gaps at
/// contacts that are wide beside the deformations are cut off.
pub const DEFORMATION_TIME: Figure = Figure {
    name: "deformation-time",
    title: "Deformation over time",
    x: Of::Time,
    y: Of::Deformation,
    kinds: &[DeepestPoint, TensionStart],
};

/// Force of each element over its deformation, both positive in compression: the area in a loop is the energy lost.
pub const FORCE_DEFORMATION: Figure = Figure {
    name: "force-deformation",
    title: "Force over deformation",
    x: Of::Deformation,
    y: Of::Force,
    kinds: &[PeakForce, DeepestPoint, TensionStart],
};

/// The parts of the energy ledger over time.
pub const ENERGY_TIME: Figure = Figure {
    name: "energy-time",
    title: "Energy over time",
    x: Of::Time,
    y: Of::Energy,
    kinds: &[],
};

/// A figure drawn from one or several runs of the same scene.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// Name in files and on the command line, as in `force-time`.
    pub name: &'static str,
    /// Heading, as in `Force over time`.
    pub title: &'static str,
    x: Of,
    y: Of,
    /// What is marked.
    kinds: &'static [RunMarkerKind],
}

impl Figure {
    /// The figure of this signal over time.
    pub fn over_time(y: Of) -> Option<&'static Self> {
        FIGURES.iter().find(|figure| figure.x == Of::Time && figure.y == y)
    }

    /// The chart of `runs`, which differ in their method or are designs; what they have nothing of stays empty.
    pub fn chart(&self, runs: &[RunSeries]) -> Chart {
        let mut all = quantities(runs, self.x, self.y);
        let widest = if self.y == Of::Deformation { cut_off(runs, &mut all) } else { None };
        let are_designs = runs.iter().any(|run| run.is_design);
        if are_designs {
            all.retain(|quantity| quantity.curves.iter().any(|curve| !curve.is_empty()));
        }
        let (shown, left_out) = largest(all, self.y);
        // Of several designs each has its own peak; the curves tell them.
        let marked = if are_designs { &[] } else { self.kinds };
        let measured = measured(runs, (self.x, self.y));
        let of_measured = || measured.iter().flat_map(|own| &own.points);
        let points = || shown.iter().flat_map(|q| q.curves.iter().flatten()).chain(of_measured());
        let x = self.x.unit(points().map(|p| p.0));
        let y = self.y.unit(points().map(|p| p.1));
        let mut series = curves(runs, &shown, x.factor, y.factor);
        let taken = series.iter().filter_map(|own| Some(own.stroke?.colour + 1)).max();
        series.extend(measured::series(&measured, taken.unwrap_or(0), (x, y)));
        let gaps = widest.map(|gap| format!("gaps wider than {} are cut off", y.print(gap)));
        let thicknesses = match (self.x, self.y) {
            (Of::Deformation, _) => thickness_lines(runs, &shown, Direction::Vertical, x),
            (_, Of::Deformation) => thickness_lines(runs, &shown, Direction::Horizontal, y),
            _ => Vec::new(),
        };
        let limits = limit_lines(runs, &shown, (self.x, x), Direction::Vertical)
            .into_iter()
            .chain(limit_lines(runs, &shown, (self.y, y), Direction::Horizontal));
        Chart {
            title: self.title.into(),
            note: note(runs, left_out, gaps),
            x_label: x.label(&word(runs, self.x)),
            y_label: y.label(self.y.word()),
            markers: markers(runs, &shown, marked, (self.x, x), (self.y, y)),
            lines: limits.chain(thicknesses).collect(),
            family: if has_order(runs, &shown) { runs.len() } else { 0 },
            series,
            has_arrows: self.x != Of::Time,
            ..Chart::default()
        }
    }
}

/// What an axis is labelled with.
fn word(runs: &[RunSeries], of: Of) -> String {
    let is_shifted = of == Of::Time && runs.iter().any(|run| run.first_touch.is_some());
    if is_shifted { "time from first touch".into() } else { of.word().into() }
}

/// The widest gap that is shown, as a part of the largest deformation.
const WIDEST: f64 = 0.5;
/// Curves beyond these in one figure cannot be told apart.
const MOST_CURVES: usize = 6;

/// One quantity of all runs: a name and, per run, its curve in SI units.
struct Quantity {
    name: String,
    curves: Vec<Vec<(f64, f64)>>,
}

/// The quantities of largest magnitude, in their order, and a remark when some are left out.
fn largest(mut quantities: Vec<Quantity>, of: Of) -> (Vec<Quantity>, String) {
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
    let kind = match of {
        Of::Energy => "energies",
        Of::Acceleration | Of::Velocity => "masses",
        _ => "elements",
    };
    (quantities, format!("the {MOST_CURVES} largest of {total} {kind}"))
}

/// Whether the curves are those of one quantity in designs that have an order.
fn has_order(runs: &[RunSeries], shown: &[Quantity]) -> bool {
    let is_whole = |quantity: &Quantity| quantity.curves.iter().all(|curve| !curve.is_empty());
    matches!(shown, [one] if is_whole(one)) && runs.iter().all(|run| run.rank.is_some())
}

/// Patterns of designs, in turn.
const DESIGNS: [Pattern; 4] =
    [Pattern::Solid, Pattern::Dashed, Pattern::Dotted, Pattern::DashDotted];

/// Pattern and colour of a design that has a place in an order.
fn ordered(own: RunRank) -> (Pattern, usize) {
    (DESIGNS[own.group % DESIGNS.len()], own.place)
}

/// Curves scaled from SI to the units of the axes: one colour per quantity, one pattern per run, and of a single
/// quantity of several designs one colour per design. Of several methods the first is broad and pale, so that another
/// one on it stays visible.
fn curves(
    runs: &[RunSeries],
    quantities: &[Quantity],
    x_factor: f64,
    y_factor: f64,
) -> Vec<Series> {
    let alone = quantities.len() == 1;
    let has_order = has_order(runs, quantities);
    let mut series = Vec::new();
    for (run, of_run) in runs.iter().enumerate() {
        for (colour, quantity) in quantities.iter().enumerate() {
            let Some(curve) = quantity.curves.get(run).filter(|curve| !curve.is_empty()) else {
                continue;
            };
            let name = match (runs.len(), alone) {
                (0 | 1, _) => quantity.name.clone(),
                (_, true) if of_run.is_design => of_run.name.clone(),
                _ => format!("{}, {}", quantity.name, of_run.name),
            };
            let rank = of_run.rank.filter(|_| has_order);
            let (pattern, colour) = match run {
                _ if rank.is_some() => rank.map_or((Pattern::Solid, run), ordered),
                _ if of_run.is_design && alone => (DESIGNS[run / COLOURS % DESIGNS.len()], run),
                _ if of_run.is_design => (DESIGNS[run % DESIGNS.len()], colour),
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

/// Leaves out the parts of flights in which a contact is wide open, so that they do not flatten the curves of what
/// deforms. Returns the widest gap that is shown \[m\] where any is wider.
fn cut_off(runs: &[RunSeries], all: &mut [Quantity]) -> Option<f64> {
    let is_contact = |quantity: &Quantity| {
        let elements = runs.iter().flat_map(|run| &run.elements);
        elements.filter(|element| element.name == quantity.name).any(|element| element.is_contact)
    };
    let deforming = all.iter().filter(|own| !is_contact(own));
    let sizes = deforming.flat_map(|own| own.curves.iter().flatten()).map(|point| point.1.abs());
    let widest = WIDEST * sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
    if widest <= 0.0 {
        return None;
    }
    let mut is_cut = false;
    for quantity in all.iter_mut().filter(|own| is_contact(own)) {
        for point in quantity.curves.iter_mut().flatten().filter(|point| point.1 < -widest) {
            (point.1, is_cut) = (f64::NAN, true);
        }
    }
    is_cut.then_some(widest)
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
        let node = |name: &str| NodeSeries {
            name: name.into(),
            acceleration: time.iter().map(|t| 4e3 * pulse(t)).collect(),
            velocity: time.iter().map(|t| 10.0 - 500.0 * t).collect(),
        };
        RunSeries {
            name: method.into(),
            is_design: false,
            rank: None,
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
                kind: PeakForce,
                time: 1e-3,
                label: "peak 38.4 kN".into(),
                moment: "1.00 ms".into(),
            }],
            excerpt_of: None,
            first_touch: None,
            nodes: ["head", "plate"].map(node).to_vec(),
            limits: Vec::new(),
            measured: Vec::new(),
            time,
        }
    }

    #[test]
    fn names_are_unique_and_every_figure_draws_both_runs() {
        for (i, figure) in FIGURES.iter().enumerate() {
            assert!(FIGURES[..i].iter().all(|other| other.name != figure.name));
            let chart = figure.chart(&runs());
            assert_eq!(chart.series.len(), 4, "{}", figure.name);
            let named = |method| chart.series.iter().filter(|s| s.name.ends_with(method)).count();
            assert_eq!((named("exact"), named("bdf")), (2, 2), "{}", figure.name);
            assert_eq!(chart.series[0].stroke.map(|s| s.pattern), Some(Pattern::Broad));
            assert_eq!(chart.series[3].stroke.map(|s| s.pattern), Some(Pattern::Dashed));
        }
    }

    #[test]
    fn every_figure_draws_from_nothing() {
        for figure in FIGURES {
            for runs in [vec![], vec![RunSeries::default()]] {
                assert!(figure.chart(&runs).series.is_empty(), "{}", figure.name);
                assert!(figure.chart(&runs).svg().is_ok());
            }
        }
    }

    #[test]
    fn designs_have_colours_of_their_own_where_one_quantity_is_shown() {
        let design = |name: &str, thickness: f64| {
            let mut own = run(name);
            own.is_design = true;
            own.elements.truncate(1);
            own.elements[0].thickness = Some(thickness);
            own
        };
        let designs = [design("soft", 0.03), design("stiff", 0.02), design("steel", 0.02)];
        let chart = FORCE_DEFORMATION.chart(&designs);
        let names: Vec<&str> = chart.series.iter().map(|own| own.name.as_str()).collect();
        assert_eq!(names, ["soft", "stiff", "steel"]);
        let colours: Vec<_> =
            chart.series.iter().map(|own| own.stroke.map(|own| own.colour)).collect();
        assert_eq!(colours, [Some(0), Some(1), Some(2)]);
        assert!(chart.markers.is_empty() && chart.family == 0);
        let ordered = designs.clone().map(|own| {
            let place = ["steel", "soft", "stiff"].iter().position(|name| *name == own.name);
            let rank = place.map(|place| RunRank { place, group: usize::from(place == 2) });
            RunSeries { rank, ..own }
        });
        let family = FORCE_DEFORMATION.chart(&ordered);
        let strokes: Vec<_> = family.series.iter().filter_map(|own| own.stroke).collect();
        let ranks: Vec<usize> = strokes.iter().map(|own| own.colour).collect();
        assert_eq!((family.family, ranks), (3, vec![1, 2, 0]));
        let patterns: Vec<Pattern> = strokes.iter().map(|own| own.pattern).collect();
        assert_eq!(patterns, [Pattern::Solid, Pattern::Dashed, Pattern::Solid]);
        let lines: Vec<&str> = chart.lines.iter().map(|own| own.label.as_str()).collect();
        assert_eq!(lines, ["thickness of soft: 30 mm", "thickness of stiff, steel: 20 mm"]);
    }

    #[test]
    fn a_limit_is_a_line_where_its_signal_is_shown_and_nowhere_else() {
        let mut run = run("exact");
        let limit = |name: &str, of: Of, at: f64| RunLimit {
            name: name.into(),
            of,
            at,
            label: "max".into(),
        };
        run.limits = vec![
            limit("head", Of::Acceleration, 250.0 * 9.806_65),
            limit("padding", Of::Force, 30e3),
            limit("nothing", Of::Force, 1.0),
        ];
        let told = |figure: Figure| -> Vec<(Direction, f64, Option<usize>)> {
            let lines = figure.chart(&[run.clone()]).lines.into_iter();
            let own = lines.filter(|line| line.label == "max");
            own.map(|line| (line.direction, line.at, line.colour)).collect()
        };
        let force = (Direction::Horizontal, 30.0, Some(0));
        assert_eq!(told(FORCE_TIME), [force]);
        assert_eq!(told(FORCE_DEFORMATION), [force]);
        assert_eq!(told(DEFORMATION_TIME), []);
        let [(direction, at, _)] = told(ACCELERATION_TIME)[..] else { panic!() };
        assert_eq!(direction, Direction::Horizontal);
        assert!((at - 250.0).abs() < 1e-9, "{at}");
    }

    #[test]
    fn a_marker_sits_on_its_curve_in_the_units_of_the_axes() {
        let chart = FORCE_TIME.chart(&runs());
        let marker = &chart.markers[0];
        assert!((marker.x - 1.0).abs() < 1e-12, "{marker:?}");
        assert!((marker.y - 38.4).abs() < 1e-9, "{marker:?}");
        assert_eq!(chart.y_label, "force (kN)");
    }

    #[test]
    fn a_text_names_its_elements_where_several_are_shown() {
        let labels = |run: RunSeries| -> Vec<String> {
            FORCE_TIME.chart(&[run]).markers.into_iter().map(|marker| marker.label).collect()
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
        let lines = DEFORMATION_TIME.chart(&[run.clone()]).lines;
        let colours: Vec<_> = lines.iter().map(|line| line.colour).collect();
        assert_eq!(colours, [Some(0), Some(1)]);
        run.elements[1].thickness = Some(0.02);
        let lines = DEFORMATION_TIME.chart(&[run]).lines;
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
        assert_eq!(names(FORCE_DEFORMATION.chart(&runs)), ["padding"]);
        assert_eq!(names(DEFORMATION_TIME.chart(&runs)), ["padding", "mount <&>"]);
        assert_eq!(names(FORCE_TIME.chart(&runs)), ["padding", "mount <&>"]);
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
        let chart = FORCE_TIME.chart(&[run]);
        let names: Vec<&str> = chart.series.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["e24", "e25", "e26", "e27", "e28", "e29"]);
        assert_eq!(chart.note, "the 6 largest of 30 elements");
    }

    #[test]
    fn wide_gaps_do_not_flatten_what_deforms() {
        let mut runs = runs();
        runs.truncate(1);
        let deepest = runs[0].elements[0].deformation.iter().copied().fold(0.0, f64::max);
        let contact = &mut runs[0].elements[1];
        contact.is_contact = true;
        let last = contact.deformation.len() - 1;
        for (at, gap) in contact.deformation.iter_mut().enumerate() {
            *gap = -(at as f64) / last as f64;
        }
        let chart = DEFORMATION_TIME.chart(&runs);
        let shown = chart.series[1].points.iter().map(|point| point.1);
        let lowest = shown.clone().filter(|shown| shown.is_finite()).fold(0.0, f64::min);
        assert!(lowest < 0.0 && lowest >= -500.0 * deepest, "{lowest}");
        assert!(shown.clone().any(f64::is_nan));
        assert!(chart.note.contains("gaps wider than 8.75 mm are cut off"), "{}", chart.note);
        let whole = DEFORMATION_TIME.chart(&self::runs());
        assert!(!whole.note.contains("gaps"), "{}", whole.note);
    }
}
