//! Figures of runs.

use super::{
    ACCELERATION_TIME, DEFORMATION_TIME, ElementSeries, EnergySeries, FIGURES, FORCE_DEFORMATION,
    FORCE_TIME, Figure, NodeSeries, Of, RunLimit, RunMarker, RunMarkerKind::*, RunRank, RunSeries,
};
use crate::{Chart, Direction, Pattern};

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
    let colours: Vec<_> = chart.series.iter().map(|own| own.stroke.map(|own| own.colour)).collect();
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
    let limit =
        |name: &str, of: Of, at: f64| RunLimit { name: name.into(), of, at, label: "max".into() };
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
    let names =
        |chart: Chart| chart.series.iter().map(|series| series.name.clone()).collect::<Vec<_>>();
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
