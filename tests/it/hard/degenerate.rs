//! Spectra with several equal eigenvalues: equal masses, equal branches, symmetric networks, masses that nothing
//! holds. The linearised equations of two equal masses that just touch have four eigenvalues of nearly zero.

use dashpot::network::ConnectionOutputs;

use super::{
    case::Case,
    scene::{ENDS, Text},
    table::judge,
    trial::Trial,
};

/// What lets go of the pad.
const PARTS: &str = "[effects]\nseparation.pad = { at = \"head\" }\n";
/// A contact without damping that lets go by itself.
const CONTACT: &str = "hunt-crossley = { force = \"1 kN\", at = \"1 mm\", dissipation = 0.0 }";

#[test]
fn degenerate_spectra() {
    judge("degenerate", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let foam = "foam = { modulus = 2e6, plateau = 1e5, densification = 2e4, exponent = 3.0, thickness = 0.02, \
                area = 1e-3 }";
    let laws = [
        ("hunt-crossley", CONTACT, ""),
        ("bumper", "bumper = { force = 1e3, at = 1e-3, restitution = 1.0, speed = 1.0 }", ""),
        (
            "foundation",
            "foundation = { law = { cubic-spring = { stiffness = 2e5, cubic = 1e11 } }, \
             shape = \"sphere\", radius = \"50 mm\" }",
            "",
        ),
        ("power-spring", "power-spring = { force = 1e3, at = 1e-3, exponent = 3.0 }", PARTS),
        ("cubic-spring", "cubic-spring = { stiffness = 0.0, cubic = 1e12 }", PARTS),
        ("stiffening-spring", "stiffening-spring = { stiffness = 1e5, limit = 1e-3 }", PARTS),
        (
            "rate-spring",
            "rate-spring = { force = 1e3, at = 1e-3, gain = 0.0, reference-rate = 1.0, exponent = 2.0 }",
            PARTS,
        ),
        ("foam", foam, PARTS),
        (
            "table-spring",
            "table-spring = [[-1e-3, -50.0], [0.0, 0.0], [1e-3, 50.0], [2e-3, 300.0], [4e-3, 2e3]]",
            PARTS,
        ),
        ("formula", "formula = { force = \"200 N * sinh(y / 1 mm)\", up-to = \"5 mm\" }", PARTS),
    ];
    let mut cases: Vec<Case> = laws.map(equal_masses).into();
    cases.extend([head_on(), two_wagons(), near_a_wall(), symmetric(), equal_branches()]);
    cases.extend([["1", "1", "2"], ["1", "1", "1"], ["2", "1", "1"]].map(chain));
    cases.push(untouched());
    cases
}

/// The deformation at which the parts of an element have stored an energy.
fn depth(trial: &Trial<'_>, element: &str, energy: f64) -> f64 {
    let assembly = &trial.report.assembly;
    let ConnectionOutputs { primitives, .. } = assembly.connection(element).unwrap();
    let parts = &assembly.primitives[primitives.clone()];
    let stored = |y: f64| parts.iter().map(|own| own.element.stored(y)).sum::<f64>();
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if stored(middle) < energy { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// One of 100 g at 1 m/s meets another at rest: they exchange their speeds.
fn equal_masses((law, model, effects): (&'static str, &'static str, &'static str)) -> Case {
    let text = Text::head(0.1, 1.0)
        .node("anvil", "mass = 0.1")
        .element("pad", ["head", "anvil"], model)
        .measure("anvil", ENDS)
        .measure("pad", "[{ kind = \"peak-deformation\", window = \"run\" }]")
        .with(effects)
        .lasting(0.02);
    Case::new(format!("equal masses meet by a {law}"), "momentum and energy", text, |trial| {
        trial.measure("head.end-velocity", 0.0);
        trial.measure("anvil.end-velocity", 1.0);
        // At the same speed, half of the energy is in the pad.
        trial.measure("pad.peak-deformation", depth(trial, "pad", 0.025));
        trial.energy_closes();
    })
}

fn head_on() -> Case {
    let text = Text::head(0.1, 1.0)
        .node("other", "mass = 0.1, velocity = -1.0")
        .element("pad", ["head", "other"], CONTACT)
        .measure("other", ENDS)
        .lasting(0.01);
    Case::new("equal masses meet head-on", "momentum and energy", text, |trial| {
        trial.measure("head.end-velocity", -1.0);
        trial.measure("other.end-velocity", 1.0);
        trial.energy_closes();
    })
}

fn two_wagons() -> Case {
    let text = Text::head(2e4, 2.0)
        .node("wagon", "mass = 2e4")
        .element(
            "pad",
            ["head", "wagon"],
            "table-spring = [[0.0, 0.0], [0.02, 1e5], [0.06, 6e5], [0.105, 2e6]]",
        )
        .measure("wagon", ENDS)
        .with(PARTS)
        .lasting(1.0);
    Case::new("two wagons of 20 t meet by their buffers", "momentum and energy", text, |trial| {
        trial.measure("head.end-velocity", 0.0);
        trial.measure("wagon.end-velocity", 2.0);
        trial.energy_closes();
    })
}

fn near_a_wall() -> Case {
    let wall = CONTACT.replace(" }", ", gap = \"5 mm\" }");
    let text = Text::head(0.1, 1.0)
        .node("ball", "mass = 0.1")
        .element("pad", ["head", "ball"], CONTACT)
        .element("wall", ["ball", "ground"], &wall)
        .measure("ball", ENDS)
        .lasting(0.05);
    let name = "a ball strikes an equal one at rest near a wall, and is struck by it";
    Case::new(name, "momentum and energy", text, |trial| {
        trial.measure("head.end-velocity", -1.0);
        trial.measure("ball.end-velocity", 0.0);
        trial.energy_closes();
    })
}

fn symmetric() -> Case {
    let text = Text::head(0.2, 1.0)
        .node("left", "mass = 0.1")
        .node("right", "mass = 0.1")
        .element("one", ["head", "left"], CONTACT)
        .element("other", ["head", "right"], CONTACT)
        .measure("left", ENDS)
        .measure("right", ENDS)
        .lasting(0.02);
    Case::new("a mass meets two of half of it at once", "momentum and energy", text, |trial| {
        trial.measure("head.end-velocity", 0.0);
        trial.measure("left.end-velocity", 1.0);
        trial.measure("right.end-velocity", 1.0);
        trial.energy_closes();
    })
}

/// Three equal branches side by side between two equal masses.
fn equal_branches() -> Case {
    let cube = "{ cubic-spring = { stiffness = 1e4, cubic = 1e10 } }";
    let text = Text::head(0.1, 1.0)
        .node("anvil", "mass = 0.1")
        .element("pad", ["head", "anvil"], &format!("parallel = [{cube}, {cube}, {cube}]"))
        .measure("anvil", ENDS)
        .measure("pad", "[{ kind = \"peak-deformation\", window = \"run\" }]")
        .with(PARTS)
        .lasting(0.02);
    Case::new("equal masses, equal branches", "momentum and energy", text, |trial| {
        trial.measure("head.end-velocity", 0.0);
        trial.measure("anvil.end-velocity", 1.0);
        trial.measure("pad.peak-deformation", depth(trial, "pad", 0.025));
        trial.energy_closes();
    })
}

/// Three masses in a row that touch.
fn chain(masses: [&'static str; 3]) -> Case {
    let [first, second, third] = masses.map(|own| own.parse::<f64>().unwrap());
    let text = Text::head(first, 1.0)
        .node("second", &format!("mass = {second:?}"))
        .node("third", &format!("mass = {third:?}"))
        .element("pad", ["head", "second"], CONTACT)
        .element("next", ["second", "third"], CONTACT)
        .measure("second", ENDS)
        .measure("third", ENDS)
        .lasting(0.1);
    let name = format!("masses of {} in a row", masses.join(":"));
    Case::new(name, "momentum and energy", text, move |trial| {
        let speed = |node: &str| trial.signal(&format!("{node}.velocity")).value(trial.end());
        let all = [(first, "head"), (second, "second"), (third, "third")];
        let momentum: f64 = all.iter().map(|own| own.0 * speed(own.1)).sum();
        trial.number("momentum", momentum, first, first, Some(1e-9 * first));
        let energy: f64 = all.iter().map(|own| 0.5 * own.0 * speed(own.1).powi(2)).sum();
        trial.number("kinetic energy", energy, 0.5 * first, 0.5 * first, None);
        trial.energy_closes();
    })
}

/// Jordan blocks: bodies that nothing holds, and that do not meet.
fn untouched() -> Case {
    let far = CONTACT.replace(" }", ", gap = \"10 m\" }");
    let text = Text::head(1.0, 1.0)
        .node("second", "mass = 1.0")
        .node("third", "mass = 1.0, velocity = 0.5")
        .element("pad", ["head", "second"], &far)
        .element("next", ["second", "third"], &far)
        .measure("second", ENDS)
        .with("[loads]\npush = { on = \"second\", force = { constant = 2.0 } }")
        .lasting(1.0);
    Case::new("equal masses that nothing holds", "closed form", text, |trial| {
        trial.ends("head", 1.0, 1.0);
        trial.ends("second", 1.0, 2.0);
        trial.energy_closes();
    })
}
