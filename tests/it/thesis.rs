//! The thesis' reference impact through the compiler and the methods, against its tables.

pub(crate) use dashpot::network::{dashpot, spring};
use dashpot::{
    dae::{Method, Run, Signal, Silent, Trajectory, methods},
    network::{Assembly, Model, Network, Node},
    rheology::{Branch, Tree},
    scene::{ReadOptions, read},
};

use crate::independent::{Groups, PRINTED, has_digits};

pub(crate) fn kelvin(stiffness: f64, damping: f64) -> Model {
    Tree::Parallel(vec![
        Branch::new("spring", spring(stiffness)),
        Branch::new("dashpot", dashpot(damping)),
    ])
}

/// K1 ∥ C1 in a row with K2 and C2, the spring K2 on the impactor's side.
pub(crate) fn burgers(k1: f64, c1: f64, k2: f64, c2: f64) -> Model {
    Tree::series([spring(k2), dashpot(c2), kelvin(k1, c1)])
}

/// The impact of chapter II: impactor, pad, support.
pub(crate) fn impact(mass: f64, speed: f64, pad: Model, support: [f64; 3]) -> Network {
    let [m3, k3, c3] = support;
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", mass).moving(speed));
    let panel = network.add_node(Node::mass("panel", m3));
    network.connect("padding", head, panel, pad);
    network.connect("mount", panel, network.ground(), kelvin(k3, c3));
    network
}

/// The reference case in SI, with the support's damping \[N s/m\].
pub(crate) fn reference(c3: f64) -> Network {
    impact(10.0, 10.0, burgers(2e7, 4e3, 2e7, 6e3), [100.0, 5e7, c3])
}

/// The padding and support that stand for groups, with m1 = V0 = δ = 1 (appendix D, corrected).
pub(crate) fn from_groups(groups: &Groups) -> Network {
    let Groups { a, b, c, d, alpha, beta, gamma } = *groups;
    let q = a - b * c / d - d / c;
    let m3 = 1.0 / gamma;
    impact(1.0, 1.0, burgers(d / q, c / q, c, d / b), [m3, beta * m3, alpha * m3])
}

pub(crate) struct Solved {
    pub(crate) assembly: Assembly,
    pub(crate) trajectory: Trajectory,
}

pub(crate) fn solve(network: &Network, method: &str, duration: f64, rtol: f64) -> Solved {
    let assembly = network.compile(duration).unwrap();
    let method: Box<dyn Method> = methods::by_name(method).unwrap();
    let run = Run::to(duration).with_rtol(rtol);
    let trajectory = method.integrate(&assembly.system, &run, &mut Silent).unwrap();
    Solved { assembly, trajectory }
}

impl Solved {
    pub(crate) fn signal(&self, name: &str) -> Signal {
        let output = self.assembly.output(name).unwrap_or_else(|| panic!("no output {name}"));
        self.trajectory.signal(&self.assembly.system, output)
    }
}

fn digits(what: &str, value: f64, printed: &str) {
    assert!(has_digits(value, printed), "{what}: {value:.15} is not {printed}");
}

#[test]
fn both_columns_of_the_table_for_printed_groups_are_exact_to_all_digits() {
    for (alpha, expected) in PRINTED {
        let solved = solve(&from_groups(&Groups::printed(alpha)), "exact", 10.0, 1e-6);
        let (force, way) = (solved.signal("padding.force"), solved.signal("padding.deformation"));
        let rate = solved.signal("padding.rate");
        let release = force.first_crossing(0.0, (0.1, 10.0), Some(false)).unwrap().time;
        let (peak, deepest) = (force.maximum((0.0, release)), way.maximum((0.0, release)));
        let omega = force.integral_of_product(&rate, (0.0, 5.0));
        let found = [peak.value, peak.time, deepest.value, deepest.time, release, omega];
        for (value, printed) in found.into_iter().zip(expected) {
            digits("printed groups", value, printed);
        }
        if alpha < 1.0 {
            let taken = force.integral_of_product(&rate, (0.0, 10.0));
            digits("omega(10)", taken, "0.481784126");
        } else {
            let largest = force.integral_of_product(&rate, (0.0, deepest.time));
            digits("omega at xi max", largest, "0.499715337");
        }
    }
}

#[test]
fn both_columns_of_the_table_in_si_are_exact_to_all_digits() {
    for (c3, expected) in [
        (
            1e4,
            [
                "38359.411601",
                "0.978689266",
                "17.538566287",
                "6.852164736",
                "7.425568132",
                "-0.481681328",
                "479.124454",
                "5019.610794",
            ],
        ),
        (
            1e7,
            [
                "39091.473661",
                "1.013937856",
                "16.961880656",
                "4.663139515",
                "5.822143300",
                "-0.113413391",
                "499.715175",
                "5362.343040",
            ],
        ),
    ] {
        let solved = solve(&reference(c3), "exact", 0.02, 1e-6);
        let (force, way) = (solved.signal("padding.force"), solved.signal("padding.deformation"));
        let release = force.first_crossing(0.0, (1e-4, 0.02), Some(false)).unwrap().time;
        let (peak, deepest) = (force.maximum((0.0, release)), way.maximum((0.0, release)));
        let work = force.integral_of_product(&solved.signal("padding.rate"), (0.0, 0.01));
        let reading = solved.signal("head.acceleration");
        let severity =
            reading.integral_of((0.0, release), &[0.0], |a| (a.abs() / 9.806_65).powf(2.5));
        let found = [
            peak.value,
            1e3 * peak.time,
            1e3 * deepest.value,
            1e3 * deepest.time,
            1e3 * release,
            solved.signal("head.velocity").value(release),
            work,
            severity,
        ];
        for (value, printed) in found.into_iter().zip(expected) {
            digits("reference-si", value, printed);
        }
    }
}

#[test]
fn families_with_one_group_varied_match_the_thesis_page() {
    let base = Groups::printed(0.2);
    for (groups, phi, xi) in [
        (Groups { a: 20.0, ..base }, "0.8482", "0.8672"),
        (Groups { a: 35.0, ..base }, "0.7074", "0.8905"),
        (Groups { b: 50.0, ..base }, "0.8824", "0.6913"),
        (Groups { b: 80.0, ..base }, "0.6952", "1.0314"),
        (Groups { c: 5.0, ..base }, "0.7769", "0.8794"),
        (Groups { c: 12.0, ..base }, "0.7696", "0.8727"),
        (Groups { d: 60.0, ..base }, "0.6103", "1.1411"),
        (Groups { d: 100.0, ..base }, "0.9169", "0.7085"),
    ] {
        let solved = solve(&from_groups(&groups), "exact", 10.0, 1e-6);
        let force = solved.signal("padding.force");
        let release = force.first_crossing(0.0, (0.1, 10.0), Some(false)).unwrap().time;
        digits("phi max", force.maximum((0.0, release)).value, phi);
        digits("xi max", solved.signal("padding.deformation").maximum((0.0, release)).value, xi);
    }
}

#[test]
fn the_exact_method_agrees_with_the_independent_equations_everywhere() {
    for alpha in [0.2, 200.0] {
        let groups = Groups::printed(alpha);
        let independent = groups.solve(10.0);
        let solved = solve(&from_groups(&groups), "exact", 10.0, 1e-6);
        let (phi, xi) = (solved.signal("padding.force"), solved.signal("padding.deformation"));
        let zeta_rate = solved.signal("head.velocity");
        for at in 0..=1000 {
            let tau = f64::from(at) * 0.01;
            assert!((phi.value(tau) - independent.phi(tau)).abs() < 1e-12, "phi({tau})");
            assert!((xi.value(tau) - independent.xi(tau)).abs() < 1e-12, "xi({tau})");
            assert!((zeta_rate.value(tau) - independent.zeta_rate(tau)).abs() < 1e-12);
        }
    }
}

#[test]
fn every_method_approaches_the_independent_equations() {
    let groups = Groups::printed(0.2);
    let independent = groups.solve(10.0);
    for method in ["bdf", "tr-bdf2", "esdirk34", "tsit45"] {
        let error = |rtol: f64| {
            let solved = solve(&from_groups(&groups), method, 10.0, rtol);
            let phi = solved.signal("padding.force");
            (0..=1000)
                .map(|at| f64::from(at) * 0.01)
                .map(|tau| (phi.value(tau) - independent.phi(tau)).abs())
                .fold(0.0, f64::max)
        };
        let [coarse, fine] = [1e-4, 1e-7].map(error);
        assert!(
            coarse < 0.2 && fine < 2e-3 * 0.767 && fine < 0.2 * coarse,
            "{method}: {coarse:e} {fine:e}"
        );
    }
}

#[test]
fn three_routes_through_the_compiler_give_one_answer() {
    let text = include_str!("../../crates/scene/templates/reference.toml");
    let named = read(text, &ReadOptions::default()).unwrap().value.network;
    let part_by_part = impact(
        10.0,
        10.0,
        Tree::series([
            Tree::series([spring(2e7), dashpot(6e3)]),
            Tree::parallel([dashpot(4e3), spring(2e7)]),
        ]),
        [100.0, 5e7, 1e4],
    );
    let mut graph = Network::new();
    let head = graph.add_node(Node::mass("head", 10.0).moving(10.0));
    let [one, two] = ["one", "two"].map(|name| graph.add_node(Node::massless(name)));
    let panel = graph.add_node(Node::mass("panel", 100.0));
    graph.connect("padding", head, one, spring(2e7));
    graph.connect("flow", one, two, dashpot(6e3));
    graph.connect("kelvin-spring", two, panel, spring(2e7));
    graph.connect("kelvin-dashpot", two, panel, dashpot(4e3));
    graph.connect("mount-spring", panel, graph.ground(), spring(5e7));
    graph.connect("mount-dashpot", panel, graph.ground(), dashpot(1e4));
    let outputs = [
        "padding.force",
        "head.position",
        "head.velocity",
        "head.acceleration",
        "panel.position",
        "panel.velocity",
    ];
    let solved = [named, part_by_part, graph].map(|network| solve(&network, "exact", 0.02, 1e-6));
    for output in outputs {
        let signals = solved.each_ref().map(|solved| solved.signal(output));
        let scale = signals[0].bound();
        for at in 0..=500 {
            let time = f64::from(at) * 4e-5;
            let [first, second, third] = signals.each_ref().map(|signal| signal.value(time));
            assert!((first - second).abs() < 1e-10 * scale, "{output} at {time}");
            assert!((first - third).abs() < 1e-10 * scale, "{output} at {time}");
        }
    }
}
