//! Limits: masses, stiffnesses and dampings that go to zero or beyond all bounds.

use super::{
    case::Case,
    reference::reference,
    scene::{FORCES, Text, kelvin, maxwell},
    table::judge,
};

#[test]
fn limits() {
    judge("limits", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> = ["1e-2", "1e-6", "1e-12", "1e-18", "0"].map(light_node).into();
    cases.extend(["1e4", "1e8", "1e12", "1e16"].map(stiff_joint));
    cases.extend(["1e4", "1e8", "1e12", "1e16", "1e20"].map(damped_joint));
    cases.push(rigid_joint());
    for damping in [0.0, 1e-300, 1e-12, 1e12, 1e100, 1e300] {
        cases.push(kelvin_of(damping));
        cases.push(maxwell_of(damping));
    }
    cases.extend(nothing_in_parallel());
    cases
}

fn light_node(mass: &'static str) -> Case {
    let text = Text::head(1.0, 1.0)
        .node("node", &format!("mass = {mass}"))
        .element("front", ["head", "node"], "spring = 1e4")
        .element("back", ["node", "ground"], &kelvin(2e4, 100.0))
        .measure("node", "[{ kind = \"end-position\", window = \"run\" }]")
        .measure("front", FORCES)
        .lasting(0.05);
    let name = format!("a node of {mass} kg between spring and Kelvin–Voigt");
    Case::new(name, "script", text, move |trial| {
        let get = |quantity| reference(&format!("light-node-{mass}"), quantity);
        trial.ends("head", get("head"), get("velocity"));
        trial.measure("node.end-position", get("node"));
        trial.measure("front.end-deformation", get("force") / 1e4);
        trial.last("front.force", get("force"));
        // The limit itself, from which the light node is off by its mass.
        let mass: f64 = mass.parse().unwrap();
        let limit = reference("light-node-0", "head");
        trial.measure_known("head.end-position", limit, 1e-2 * mass);
    })
}

/// Two masses that a strong dashpot joins, the lighter of which a weak one holds.
fn damped_joint(damping: &'static str) -> Case {
    let ends = "[{ kind = \"end-position\", window = \"run\" }]";
    let strong = kelvin(79486.0, damping.parse().unwrap());
    let text = Text::head(1.3, 1.0)
        .node("link", "mass = 0.0025, velocity = 1")
        .node("body", "mass = 3.1")
        .element("joint", ["head", "link"], &strong)
        .element("pad", ["link", "body"], &kelvin(1.01, 0.3861))
        .element("mount", ["body", "ground"], &kelvin(1.01, 0.3861))
        .measure("body", ends)
        .lasting(10.0);
    let name = format!("joint of {damping} N s/m between moving masses");
    Case::new(name, "script", text, move |trial| {
        let get = |quantity| reference(&format!("damped-joint-{damping}"), quantity);
        trial.ends("head", get("first"), get("velocity"));
        trial.measure("body.end-position", get("third"));
    })
}

fn stiff_joint(stiffness: &'static str) -> Case {
    let text = Text::head(1.0, 1.0)
        .node("body", "mass = 2, velocity = 1")
        .element("joint", ["head", "body"], &format!("spring = {stiffness}"))
        .element("pad", ["body", "ground"], &kelvin(1e3, 10.0))
        .measure("body", "[{ kind = \"end-position\", window = \"run\" }]")
        .lasting(0.1);
    let case = Case::new(
        format!("joint of {stiffness} N/m, equal start speeds"),
        "script",
        text,
        move |trial| {
            let get = |quantity| reference(&format!("stiff-joint-{stiffness}"), quantity);
            trial.measure("head.end-position", get("first"));
            trial.measure("body.end-position", get("second"));
            // The rigid limit, from which the joint is off by its compliance.
            let stiffness: f64 = stiffness.parse().unwrap();
            let limit = reference("stiff-joint-1e16", "first");
            trial.measure_known("head.end-position", limit, 20.0 / stiffness);
        },
    );
    // Its own swing of 10⁸ rad/s is damped by nothing but the method.
    case.steps(300_000)
}

fn rigid_joint() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("body", "mass = 2, velocity = 1")
        .element("joint", ["head", "body"], "rigid = true")
        .element("pad", ["body", "ground"], &kelvin(1e3, 10.0))
        .lasting(0.1);
    Case::new("rigid joint, equal start speeds", "limit", text, |trial| {
        trial.measure_known("head.end-position", reference("stiff-joint-1e16", "first"), 1e-13);
    })
}

/// A power of ten, or nothing at all, as it stands in a name.
fn number(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:e}") }
}

fn kelvin_of(damping: f64) -> Case {
    let text = Text::head(1.0, 1.0).pad(&kelvin(100.0, damping)).lasting(1.0);
    // Steps grow from 10⁻³⁰⁰ s on, and whether it has released takes finer tolerances to tell.
    let steps = if damping > 1e50 { 300_000 } else { 60_000 };
    let case = Case::new(
        format!("Kelvin–Voigt with C = {}", number(damping)),
        "limit",
        text,
        move |trial| {
            let (sine, cosine) = 10.0_f64.sin_cos();
            if damping < 1.0 {
                let off = damping;
                trial.measure_known("head.end-position", 0.1 * sine, off);
                trial.measure_known("head.end-velocity", cosine, 10.0 * off);
            } else {
                // It stops at once, and then creeps back with the time C/K.
                trial.measure("head.peak-displacement", 1.0 / damping);
                trial.measure("head.end-position", (-100.0 / damping).exp() / damping);
            }
        },
    );
    case.steps(steps)
}

fn maxwell_of(damping: f64) -> Case {
    let pad = if damping == 0.0 {
        "series = [{ spring = 100 }, { dashpot = 0 }]".to_owned()
    } else {
        maxwell(100.0, damping)
    };
    let text = Text::head(1.0, 1.0).pad(&pad).lasting(1.0);
    Case::new(format!("Maxwell with C = {}", number(damping)), "limit", text, move |trial| {
        if damping < 1.0 {
            // Nothing holds it but m v' = −C v.
            trial.ends("head", 1.0 - 0.5 * damping, 1.0 - damping);
        } else {
            let (sine, cosine) = 10.0_f64.sin_cos();
            let off = 100.0 / damping;
            trial.measure_known("head.end-position", 0.1 * sine, off);
            trial.measure_known("head.end-velocity", cosine, 10.0 * off);
        }
    })
}

/// Springs, dashpots and masses of nothing, wherever the network stays determinate.
fn nothing_in_parallel() -> Vec<Case> {
    let sine = |trial: &super::trial::Trial<'_>| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        trial.ends("head", 0.1 * sine, cosine);
        trial.measure("pad.peak-force", 10.0);
    };
    let text = |pad: &str| Text::head(1.0, 1.0).pad(pad).measure("pad", FORCES).lasting(1.0);
    let spring = text("parallel = [{ spring = 100 }, { spring = 0 }, { dashpot = 0 }]");
    let arm = text(&format!("parallel = [{{ spring = 100 }}, {{ {} }}]", maxwell(0.0, 1.0)));
    let mount = Text::head(1.0, 1.0)
        .node("tag", "mass = 0")
        .element("pad", ["head", "ground"], "spring = 100")
        .element("string", ["head", "tag"], &kelvin(0.0, 3.0))
        .measure("pad", FORCES)
        .lasting(1.0);
    let dashpot = text(&kelvin(0.0, 2.0));
    vec![
        Case::new("spring and dashpot of nothing beside a spring", "closed form", spring, sine),
        Case::new("Maxwell arm of no stiffness beside a spring", "closed form", arm, sine),
        Case::new("massless tag on a dashpot that loads nothing", "closed form", mount, sine),
        Case::new("Kelvin–Voigt with K = 0", "closed form", dashpot, |trial| {
            let decay = (-2.0_f64).exp();
            trial.ends("head", 0.5 * (1.0 - decay), decay);
            trial.measure("pad.peak-force", 2.0);
        }),
    ]
}
