//! The reference impact with one padding, written in many ways.

use dashpot::{
    analysis::{MeasureReport, RunReport, Solve, SolveSettings},
    network::{Network, linear_model, model_of},
    rheology::{
        Canonical, LinearModel, Tree,
        appendix_a::{Burgers, SpringDashpot},
    },
    scene::{Scene, reference, references},
};

use super::{canonical, kelvin, lay, lay_bridge, maxwell, padded, padded_by, pair, scene};
use crate::{independent::has_digits, thesis};

/// What an impact may differ by when constants are rounded to doubles: the limit that is promised.
/// One rounding of all constants moves these measures by less than 1e-14.
const SAME: f64 = 1e-10;

fn run(network: &Network, scene: &Scene, method: &str) -> RunReport {
    let settings = SolveSettings::lasting(scene.run.duration).by_name(method).unwrap();
    network.solve_with(&settings).unwrap()
}

/// The pairs of what both runs report.
fn pairs<'r>(
    one: &'r RunReport,
    other: &'r RunReport,
) -> impl Iterator<Item = (&'r MeasureReport, &'r MeasureReport)> {
    one.measures
        .iter()
        .filter_map(|measure| other.measure(&measure.key).map(|other| (measure, other)))
}

#[track_caller]
fn assert_exactly_the_same(case: &str, one: &RunReport, other: &RunReport, least: usize) {
    let mut count = 0;
    for (a, b) in pairs(one, other) {
        let [x, y] = [a, b].map(|own| own.value.unwrap());
        let (gap, scale) = ((x - y).abs(), x.abs().max(y.abs()));
        assert!(scale > 0.0 && gap <= SAME * scale, "{case}, {}: {x:e} and {y:e}", a.key);
        count += 1;
    }
    assert!(count >= least, "{case}: only {count} measures");
}

#[track_caller]
fn assert_the_same_within_errors(case: &str, one: &RunReport, other: &RunReport, least: usize) {
    let mut count = 0;
    for (a, b) in pairs(one, other) {
        let gap = (a.value.unwrap() - b.value.unwrap()).abs();
        let allowed = a.error.unwrap() + b.error.unwrap();
        assert!(gap <= allowed, "{case}, {}: {gap:e} beyond {allowed:e}", a.key);
        count += 1;
    }
    assert!(count >= least, "{case}: only {count} measures");
}

/// The networks of a scene whose `padding` is one model in four forms.
fn forms_of_the_thesis_pad(scene: &Scene) -> Vec<(&'static str, Network)> {
    let own = linear_model(&scene.network.connections()[0].model);
    let constants = |spring, dashpot| SpringDashpot { spring, dashpot };
    let burgers = Burgers { maxwell: constants(2e7, 6e3), kelvin: constants(2e7, 4e3) };
    let two = burgers.to_two_maxwell().unwrap();
    let element = |spring_dashpot: SpringDashpot| {
        Tree::series(pair(spring_dashpot.spring, spring_dashpot.dashpot))
    };
    let two = Tree::parallel([two.slow, two.fast].map(element));
    let form = |form| padded(scene, model_of(&canonical(&own, form)));
    vec![
        ("burgers", scene.network.clone()),
        ("two maxwell by appendix A", padded(scene, model_of(&two))),
        ("canonical maxwell", form(Canonical::Maxwell)),
        ("canonical kelvin", form(Canonical::Kelvin)),
    ]
}

/// The same padding as a graph: part by part, and as a bridge.
fn graphs_of_the_thesis_pad(scene: &Scene) -> Vec<(&'static str, Network)> {
    let row = Tree::series([maxwell(), kelvin()]);
    vec![
        ("part by part", padded_by(scene, |network, ends| lay(network, ends, &row, "padding"))),
        (
            "bridge",
            padded_by(scene, |network, ends| lay_bridge(network, ends, [&maxwell(), &kelvin()])),
        ),
    ]
}

#[test]
fn an_impact_does_not_depend_on_the_form_of_the_padding_by_exact() {
    for shipped in references() {
        let scene = scene(shipped.text);
        let first = run(&scene.network, &scene, "exact");
        for (form, network) in forms_of_the_thesis_pad(&scene) {
            let case = format!("{}, {form}", shipped.name);
            let other = run(&network, &scene, "exact");
            assert_eq!(first.measures.len(), other.measures.len(), "{case}");
            assert_exactly_the_same(&case, &first, &other, 8);
        }
        for (form, network) in graphs_of_the_thesis_pad(&scene) {
            // The padding is no element here, so only the head's measures are of the same thing.
            let case = format!("{}, {form}", shipped.name);
            assert_exactly_the_same(&case, &first, &run(&network, &scene, "exact"), 2);
        }
    }
}

#[test]
fn an_impact_does_not_depend_on_the_form_of_the_padding_by_bdf_within_its_errors() {
    for shipped in references() {
        let scene = scene(shipped.text);
        let all: Vec<_> = forms_of_the_thesis_pad(&scene)
            .into_iter()
            .chain(graphs_of_the_thesis_pad(&scene))
            .collect();
        let runs: Vec<_> =
            all.iter().map(|(form, network)| (form, run(network, &scene, "bdf"))).collect();
        for (at, (form, one)) in runs.iter().enumerate() {
            for (against, other) in &runs[..at] {
                let case = format!("{}, {form} and {against}", shipped.name);
                assert_the_same_within_errors(&case, one, other, 2);
            }
        }
    }
}

#[test]
fn both_bodies_move_alike_at_every_time_whatever_the_form() {
    let scene = scene(reference());
    let all: Vec<_> = forms_of_the_thesis_pad(&scene)
        .into_iter()
        .chain(graphs_of_the_thesis_pad(&scene))
        .collect();
    let solved: Vec<_> = all
        .iter()
        .map(|(form, network)| (form, thesis::solve(network, "exact", scene.run.duration, 1e-6)))
        .collect();
    let outputs = ["position", "velocity", "acceleration"];
    for output in ["head", "panel"].iter().flat_map(|body| outputs.map(|of| format!("{body}.{of}")))
    {
        let first = solved[0].1.signal(&output);
        for (form, other) in &solved[1..] {
            let signal = other.signal(&output);
            for at in 0..=500 {
                let time = f64::from(at) * 4e-5;
                let gap = (first.value(time) - signal.value(time)).abs();
                assert!(gap <= SAME * first.bound(), "{form}, {output} at {time}: {gap:e}");
            }
        }
    }
}

#[test]
fn a_bridge_that_is_out_of_balance_does_what_its_driving_point_says() {
    // Arms and cross link are all unlike, so that every part shows.
    let bridge = |network: &mut Network, ends: [dashpot::network::NodeId; 2]| {
        let middles =
            ["left", "right"].map(|name| network.add_node(dashpot::network::Node::massless(name)));
        let arms = [
            (ends[0], middles[0], Tree::series(pair(3e7, 8e3))),
            (middles[0], ends[1], Tree::parallel(pair(9e6, 2e3))),
            (ends[0], middles[1], Tree::parallel(pair(4e6, 1e3))),
            (middles[1], ends[1], Tree::series(pair(2.5e7, 5e3))),
            (middles[0], middles[1], Tree::parallel(pair(6e6, 7e2))),
        ];
        for (at, (from, to, arm)) in arms.iter().enumerate() {
            lay(network, [*from, *to], arm, &format!("arm-{at}"));
        }
    };
    let scene = scene(reference());
    let found = super::massless(&super::alone(bridge)).model;
    let graph = padded_by(&scene, bridge);
    let reports = [Canonical::Maxwell, Canonical::Kelvin]
        .map(|form| padded(&scene, model_of(&canonical(&found, form))));
    let exact = run(&graph, &scene, "exact");
    let bdf = run(&graph, &scene, "bdf");
    for network in &reports {
        assert_exactly_the_same("bridge", &exact, &run(network, &scene, "exact"), 2);
        assert_the_same_within_errors("bridge", &bdf, &run(network, &scene, "bdf"), 2);
    }
}

/// The reference scene with its pad's Kelvin element replaced by `fibre`.
fn fibre_padding(fibre: &str) -> Scene {
    let law = format!(
        "series = [{{ spring = \"20 MN/m\" }}, {{ dashpot = \"6 kN s/m\" }}, {{ {fibre} }}]"
    );
    let lines = reference()
        .lines()
        .map(|line| if line.starts_with("burgers") { law.as_str() } else { line });
    scene(&lines.collect::<Vec<_>>().join("\n"))
}

/// Twelve Kelvin–Voigt elements from 1 µs to 0.3 s, a bell around 0.2 ms, as compliant together as
/// the thesis' one.
fn twelve() -> String {
    let bell = |at: u32| (-0.5 * ((f64::from(at) - 5.0) / 2.5).powi(2)).exp();
    let whole: f64 = (0..12).map(bell).sum();
    let terms = (0..12).map(|at| {
        let (time, compliance) = (1e-6 * 10f64.powf(0.5 * f64::from(at)), 5e-8 * bell(at) / whole);
        format!("[{time:e}, {compliance:e}]")
    });
    format!("kelvin-chain = [{}]", terms.collect::<Vec<_>>().join(", "))
}

#[test]
fn a_fibre_of_twelve_modes_runs_by_both_methods_and_in_every_form() {
    let log_normal = "log-normal-fibre = { compliance = \"5e-8 m/N\", time = \"0.2 ms\", \
        width = 1, from = \"1 us\", to = \"1 s\", error = \"0.0001 %\" }";
    for fibre in [&twelve(), log_normal] {
        let scene = fibre_padding(fibre);
        let own = linear_model(&scene.network.connections()[0].model);
        let modes = own.kelvin().unwrap().elements().len();
        assert!(modes >= 12, "{modes}");
        // A row of n Kelvin elements, a spring and a dashpot is n + 1 Maxwell elements.
        assert_eq!(own.maxwell().unwrap().elements().len(), modes + 1);
        let [exact, bdf] = ["exact", "bdf"].map(|method| run(&scene.network, &scene, method));
        assert_the_same_within_errors(fibre, &exact, &bdf, 8);
        for form in [Canonical::Maxwell, Canonical::Kelvin] {
            let network = padded(&scene, model_of(&canonical(&own, form)));
            assert_exactly_the_same(fibre, &exact, &run(&network, &scene, "exact"), 8);
            assert_the_same_within_errors(fibre, &bdf, &run(&network, &scene, "bdf"), 8);
        }
    }
}

#[test]
fn more_modes_of_the_same_compliance_are_another_padding() {
    let [one, twelve] = [ONE, &twelve()].map(|fibre| {
        let scene = fibre_padding(fibre);
        run(&scene.network, &scene, "exact").measure("padding.peak-force").unwrap().value.unwrap()
    });
    assert!((twelve / one - 1.0).abs() > 0.01, "{one} and {twelve}");
}

/// The thesis' Kelvin element as a fibre of one mode: C1/K1 and 1/K1.
const ONE: &str = "kelvin-chain = [[\"0.2 ms\", \"5e-8 m/N\"]]";

#[test]
fn a_fibre_of_one_mode_gives_the_numbers_of_the_thesis() {
    // A narrow bell has the width's share of other times: its compliance is spread over
    // (ln 10 · 1e-7)² = 5e-14, relatively.
    let narrow = "log-normal-fibre = { compliance = \"5e-8 m/N\", time = \"0.2 ms\", \
        width = 1e-7, from = \"1 us\", to = \"1 s\" }";
    for fibre in [ONE, narrow] {
        let scene = fibre_padding(fibre);
        let own: LinearModel = linear_model(&scene.network.connections()[0].model);
        assert_eq!(own.least_elements(), 4);
        let report = run(&scene.network, &scene, "exact");
        let value = |key: &str| report.measure(key).unwrap().value.unwrap();
        for (found, printed) in [
            (value("padding.peak-force"), "38359.411601"),
            (1e3 * value("padding.peak-deformation"), "17.538566287"),
            (1e3 * value("padding.contact-time"), "7.425568132"),
            (value("head.severity-index"), "5019.610794"),
        ] {
            assert!(has_digits(found, printed), "{fibre}: {found:.12} is not {printed}");
        }
    }
}
