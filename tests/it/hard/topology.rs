//! Topology: what may be joined, and in which order it is written.

use std::f64::consts::PI;

use dashpot::{
    analysis::{MeasureWish, SolveSettings, measures::EndVelocity},
    network::{Model, Network, Node, parameters::WindowWish},
    rheology::Tree,
};

use super::{
    case::Case,
    scene::{FORCES, Text, kelvin},
    table::judge,
    trial::Trial,
};
use crate::thesis::{dashpot, spring};

#[test]
fn topology() {
    judge("topology", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = massless_nodes();
    cases.extend([rigid_loop(), duplicates(), unconnected(), free_flight()]);
    cases.extend([many_in_parallel(), many_in_series(), many_kelvins_in_series()]);
    cases.push(nested(128));
    cases.push(dashpots_in_a_row(if is_full() { 10_000 } else { 1_000 }));
    cases.push(struck_chain(99));
    cases.push(struck_chain(if is_full() { 100_000 } else { 300 }));
    cases.extend([reference("as written", false, false), reference("shuffled", true, false)]);
    cases.push(reference("mirrored", false, true));
    cases
}

/// Whether the largest cases are solved at full size.
fn is_full() -> bool {
    std::env::var_os("FULL_SIZE").is_some()
}

/// A mass of 1 kg at 1 m/s on a spring of 100 N/m after 1 s.
fn sine(trial: &Trial<'_>) {
    let (sine, cosine) = 10.0_f64.sin_cos();
    trial.ends("head", 0.1 * sine, cosine);
    trial.measure("head.peak-displacement", 0.1);
}

fn massless_nodes() -> Vec<Case> {
    let dashpots = Text::default()
        .node("driver", "motion = { ramp = { height = 5.0, rise = 10.0 } }")
        .node("node", "")
        .element("in", ["driver", "node"], "dashpot = 3")
        .element("out", ["node", "ground"], "dashpot = 2")
        .element("back", ["node", "ground"], "spring = 10")
        .measure("back", FORCES)
        .lasting(2.0);
    let springs = Text::head(1.0, 1.0)
        .node("node", "")
        .element("front", ["head", "node"], "spring = 200")
        .element("back", ["node", "ground"], "spring = 200")
        .measure("back", FORCES)
        .lasting(1.0);
    let dangling = Text::head(1.0, 1.0)
        .node("tip", "")
        .node("end", "mass = 0")
        .pad("spring = 100")
        .element("string", ["head", "tip"], "spring = 5")
        .element("tail", ["tip", "end"], &kelvin(1.0, 2.0))
        .lasting(1.0);
    vec![
        Case::new(
            "massless node held by two dashpots and a spring",
            "closed form",
            dashpots,
            |trial| {
                let way = |t: f64| -0.15 * (-2.0 * t).exp_m1();
                trial.measure("back.end-deformation", way(2.0));
                trial.output("in.force", 1.0, 3.0 * (0.5 - 0.3 * (-2.0_f64).exp()));
                trial.output("node.position", 1.0, way(1.0));
            },
        ),
        Case::new("massless node held by two springs", "closed form", springs, |trial| {
            sine(trial);
            trial.measure("back.peak-force", 10.0);
            trial.measure("back.peak-deformation", 0.05);
        }),
        Case::new("massless nodes that dangle", "closed form", dangling, sine),
    ]
}

fn rigid_loop() -> Case {
    let text = Text::head(0.5, 1.0)
        .node("b", "mass = 0.25, velocity = 1")
        .node("c", "mass = 0.25, velocity = 1")
        .element("ab", ["head", "b"], "rigid = true")
        .element("bc", ["b", "c"], "rigid = true")
        .element("ca", ["c", "head"], "rigid = true")
        .element("pad", ["c", "ground"], "spring = 100")
        .lasting(1.0);
    Case::new("rigid links in a loop", "closed form", text, sine)
}

fn duplicates() -> Case {
    let text = Text::head(1.0, 1.0)
        .element("one", ["head", "ground"], "spring = 50")
        .element("two", ["head", "ground"], "spring = 50")
        .measure("two", FORCES)
        .lasting(1.0);
    Case::new("an element twice", "closed form", text, |trial| {
        sine(trial);
        trial.measure("two.peak-force", 5.0);
    })
}

fn unconnected() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("other", "mass = 1e-3, velocity = 1")
        .pad("spring = 100")
        .element("side", ["other", "ground"], &kelvin(1e3, 2.0))
        .measure("other", super::scene::ENDS)
        .lasting(1.0);
    Case::new("two parts that are not connected", "closed form", text, |trial| {
        sine(trial);
        // ζ = 1 at 1000 rad/s: v t e^(−ωt).
        trial.measure("other.peak-displacement", 1e-3 * (-1.0_f64).exp());
    })
}

fn free_flight() -> Case {
    let text = Text::head(1.0, 3.0)
        .node("tail", "mass = 2")
        .element("string", ["head", "tail"], "spring = 6")
        .measure("tail", super::scene::ENDS)
        .lasting(100.0);
    Case::new("two masses on a spring in free flight", "closed form", text, |trial| {
        // ω² = k (1/m1 + 1/m2) = 9; the common speed is 1 m/s.
        let (sine, cosine) = 300.0_f64.sin_cos();
        trial.ends("head", 100.0 + 2.0 * sine / 3.0, 1.0 + 2.0 * cosine);
        trial.ends("tail", 100.0 - sine / 3.0, 1.0 - cosine);
    })
}

/// A mass of 1 kg at 1 m/s on a model, as a network.
fn struck(model: Model) -> (Network, SolveSettings) {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 1.0).moving(1.0));
    network.connect("pad", head, network.ground(), model);
    let mut settings = SolveSettings::lasting(1.0);
    let window = WindowWish::Run;
    settings.measures = vec![
        MeasureWish::new("head", EndVelocity { window }),
        MeasureWish::new("head", dashpot::analysis::measures::EndPosition { window }),
        MeasureWish::new("head", dashpot::analysis::measures::PeakDisplacement { window }),
    ];
    (network, settings)
}

fn many_in_parallel() -> Case {
    let model = || Tree::parallel((0..1000).map(|_| spring(0.1)).collect::<Vec<_>>());
    Case::built("1000 springs in parallel", "closed form", move || struck(model()), sine)
}

fn many_in_series() -> Case {
    let model = || Tree::series((0..1000).map(|_| spring(1e5)).collect::<Vec<_>>());
    Case::built("1000 springs in series", "closed form", move || struck(model()), sine)
}

fn many_kelvins_in_series() -> Case {
    let count = if is_full() { 150 } else { 30 };
    let many = f64::from(count);
    let part = move |_| Tree::parallel([spring(100.0 * many), dashpot(4.0 * many)]);
    let model = move || Tree::series((0..count).map(part).collect::<Vec<_>>());
    let name = format!("{count} Kelvin–Voigt elements in series");
    Case::built(
        name,
        "closed form",
        move || struck(model()),
        |trial| {
            let (decay, omega) = (2.0_f64, 96.0_f64.sqrt());
            let (sine, cosine) = omega.sin_cos();
            let way = (-decay).exp() * sine / omega;
            trial.ends("head", way, (-decay).exp() * cosine - decay * way);
        },
    )
}

/// `k ← 1 + 1/(1 + 1/k)` tends to the golden ratio.
fn nested(levels: usize) -> Case {
    let model = move || {
        let mut model = spring(1.0);
        for _ in 0..levels / 2 {
            model = Tree::parallel([spring(1.0), Tree::series([spring(1.0), model])]);
        }
        model
    };
    let name = format!("{levels} nested levels");
    Case::built(
        name,
        "golden ratio",
        move || struck(model()),
        |trial| {
            let omega = (0.5 * (1.0 + 5.0_f64.sqrt())).sqrt();
            trial.ends("head", omega.sin() / omega, omega.cos());
        },
    )
}

/// A mass of 1 kg at 1 m/s, and equal links from it over nodes of this mass to the ground.
fn row(count: usize, mass: f64, link: &Model) -> Network {
    let mut network = Network::new();
    let mut last = network.add_node(Node::mass("head", 1.0).moving(1.0));
    for at in 1..=count {
        let next = if at == count {
            network.ground()
        } else {
            network.add_node(Node::mass(format!("node-{at}"), mass))
        };
        network.connect(format!("link-{at}"), last, next, link.clone());
        last = next;
    }
    network
}

fn dashpots_in_a_row(count: usize) -> Case {
    let link = dashpot(3.0 * count as f64);
    let build = move || (row(count, 0.0, &link), struck(spring(1.0)).1);
    let name = format!("{count} dashpots and massless nodes in a row");
    Case::built(name, "closed form", build, |trial| {
        let decay = (-3.0_f64).exp();
        trial.ends("head", (1.0 - decay) / 3.0, decay);
    })
}

/// A chain of masses of 1 kg and springs of 1 N/m, whose end is struck; its wave passes 100 masses.
fn struck_chain(count: usize) -> Case {
    let build = move || {
        let mut settings = SolveSettings::lasting(100.0);
        settings.measures = vec![MeasureWish::new("head", EndVelocity { window: WindowWish::Run })];
        (row(count, 1.0, &spring(1.0)), settings)
    };
    let name = format!("struck end of a chain of {count} masses");
    let case = Case::built(name, "Bessel function", build, |trial| {
        trial.measure("head.end-velocity", bessel(200.0) / 100.0);
        for time in [1.0, 10.0, 50.0] {
            trial.output("head.velocity", time, bessel(2.0 * time) / time);
        }
    });
    case.steps(6_000)
}

/// J₁(x), by the trapezoidal rule, which converges faster than any power.
fn bessel(x: f64) -> f64 {
    let count = 4000;
    let sum: f64 = (0..count)
        .map(|at| (f64::from(at) + 0.5) * PI / f64::from(count))
        .map(|angle| (angle - x * angle.sin()).cos())
        .sum();
    sum / f64::from(count)
}

/// The reference impact of the thesis with its parts in another order, or seen from the other side.
fn reference(way: &str, is_shuffled: bool, is_mirrored: bool) -> Case {
    let pad = "series = [{ spring = 20e6 }, { dashpot = 6e3 }, { kelvin-voigt = { spring = 20e6, dashpot = 4e3 } }]";
    let turned = "series = [{ kelvin-voigt = { spring = 20e6, dashpot = 4e3 } }, { dashpot = 6e3 }, { spring = 20e6 }]";
    let mut nodes = vec![("head", "mass = 10, velocity = 10"), ("panel", "mass = 100")];
    let mut elements = vec![
        ("padding", ["head", "panel"], pad.to_owned()),
        ("mount", ["panel", "ground"], kelvin(50e6, 10e3)),
    ];
    if is_shuffled {
        nodes.reverse();
        elements.reverse();
        "series = [{ dashpot = 6e3 }, { kelvin-voigt = { dashpot = 4e3, spring = 20e6 } }, { spring = 20e6 }]".clone_into(&mut elements[1].2);
    }
    if is_mirrored {
        nodes[0].1 = "mass = 10, velocity = -10";
        elements[0] = ("padding", ["panel", "head"], turned.to_owned());
        elements[1].1 = ["ground", "panel"];
    }
    let mut text = Text::default();
    for (name, keys) in nodes {
        text = text.node(name, keys);
    }
    for (name, ends, model) in elements {
        text = text.element(name, ends, &model);
    }
    let name = format!("the thesis' reference, {way}");
    Case::new(name, "printed digits", text.lasting(0.02), |trial| {
        trial.measure_known("padding.peak-force", 38_359.411_601, 5e-7);
        trial.measure_known("padding.peak-deformation", 17.538_566_287e-3, 5e-13);
        trial.measure_known("padding.contact-time", 7.425_568_132e-3, 5e-13);
    })
}
