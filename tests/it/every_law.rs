//! Every law, alone and under every shape of a body that presses it, with every effect, is run once: it is solved with a
//! ledger that closes, or refused before it is solved, by name.

use std::sync::Arc;

use dashpot::{
    analysis::{RunError, Solve, SolveSettings},
    network::{
        Element,
        elements::{ELEMENTS, Foundation, Indenter, Shape},
        parameters::Dimension,
    },
    scene::{ReadOptions, read, write_kind},
};

/// Lines of a scene by effect.
const EFFECTS: [(&str, &str); 7] = [
    ("none", ""),
    ("gravity", "gravity = { value = \"1 g0\" }"),
    ("gravity in balance", "gravity = { value = \"1 g0\", start = \"equilibrium\" }"),
    ("separation", "separation.pad = {}"),
    ("face", "face.pad = { mass = \"20 g\" }"),
    ("rigid stop", "stop.pad = { at = \"9 mm\", restitution = 0.5 }"),
    (
        "elastic stop",
        "stop.pad = { at = \"9 mm\", stiffness = \"2 MN/m\", damping = \"100 N s/m\" }",
    ),
];

/// Shapes of 80 mm.
fn indenters() -> [(&'static str, Indenter); 4] {
    use Shape::{Cylinder, Dome, Flat, Sphere};
    let of = |shape: Shape| {
        let has = |shapes: &[Shape], value: f64| shapes.contains(&shape).then_some(value);
        Indenter {
            shape,
            radius: has(&[Sphere, Dome, Cylinder], 0.06),
            diameter: has(&[Dome, Flat], 0.08),
            length: has(&[Cylinder], 0.08),
            pad_radius: None,
        }
    };
    [Sphere, Dome, Cylinder, Flat].map(|shape| (shape.word(), of(shape)))
}

/// Every element of the register as text, and every one that a body may press under every shape.
fn pads() -> Vec<(String, String)> {
    let mut pads = Vec::new();
    let text = |element: &Arc<dyn Element>| {
        write_kind(element.kind(), element.parameters(), &element.values(), Dimension::FORCE)
    };
    for kind in ELEMENTS {
        let element = kind.example().unwrap();
        pads.push((kind.word.to_owned(), text(&element)));
        for (shape, indenter) in indenters() {
            let Ok(pressed) = Foundation::new(Arc::clone(&element), indenter) else { continue };
            let pressed: Arc<dyn Element> = Arc::new(pressed);
            pads.push((format!("{} under a {shape}", kind.word), text(&pressed)));
        }
    }
    pads
}

#[test]
fn every_law_under_every_shape_with_every_effect_is_run_or_refused_by_name() {
    let (mut solved, mut refused, mut faults) = (0, 0, Vec::new());
    for (name, pad) in pads() {
        for (effect, line) in EFFECTS {
            let scene = format!(
                "[nodes]\nhead = {{ mass = 5, velocity = 1 }}\n[elements.pad]\nbetween = [\"head\", \"ground\"]\n{pad}\n\
                 [effects]\n{line}\n[run]\nduration = 0.03\n"
            );
            let Ok(read) = read(&scene, &ReadOptions::default()) else {
                refused += 1;
                continue;
            };
            let settings =
                SolveSettings { estimate: false, ..read.value.settings("auto").unwrap() };
            match read.value.network.solve_with(&settings) {
                Ok(report) => {
                    solved += 1;
                    let closure = report.energy.closure().abs();
                    if closure.is_nan() || closure > 1e-3 {
                        faults.push(format!("{name}, {effect}: the ledger is off by {closure}"));
                    }
                }
                Err(RunError::Network(_)) => refused += 1,
                Err(error) => faults.push(format!("{name}, {effect}: {error}")),
            }
        }
    }
    assert!(
        faults.is_empty(),
        "{} of {solved} and {refused}:\n{}",
        faults.len(),
        faults.join("\n")
    );
    assert!(solved > 250, "{solved} solved, {refused} refused");
}

/// Work of a run of some hundred steps.
const FEW_STEPS: u64 = 2_000_000;
/// Stiff pads that push and never pull.
const STIFF: [&str; 5] = [
    "foam = { modulus = \"12 MPa\", plateau = \"0.5 MPa\", densification = \"0.15 MPa\", exponent = 2, \
     thickness = \"15 mm\", area = \"60 cm^2\" }",
    "hysteretic-foam = { modulus = \"12 MPa\", plateau = \"0.5 MPa\", densification = \"0.15 MPa\", exponent = 2, \
     set = 0.5, unloading-exponent = 2, thickness = \"15 mm\", area = \"60 cm^2\" }",
    "hysteretic-table = { loading = [[\"0 m\", \"0 N\"], [\"1 mm\", \"5 kN\"], [\"5 mm\", \"6 kN\"]], \
     unloading = [[\"0 m\", \"0 N\"], [\"1 mm\", \"1 kN\"], [\"5 mm\", \"6 kN\"]] }",
    "hunt-crossley = { force = \"2 kN\", at = \"1 mm\", dissipation = \"0.2 s/m\", exponent = 1 }",
    "bumper = { force = \"2 kN\", at = \"1 mm\", restitution = 0.5, speed = \"5 m/s\", exponent = 1 }",
];

/// At 1e-8 m, far below what the tolerance of a place is, and where it remembers by the last digits of its speed.
#[test]
fn what_rests_on_a_pad_takes_few_steps_however_small_its_deformation_is() {
    let mut faults = Vec::new();
    for pad in STIFF {
        for mass in ["20 g", "1 kg", "20 kg"] {
            for method in ["bdf", "tr-bdf2", "esdirk34", "dop853"] {
                let scene = format!(
                    "[nodes]\nhead = {{ mass = \"{mass}\" }}\n\
                     [elements.pad]\nbetween = [\"head\", \"ground\"]\n\
                     parallel = [{{ {pad} }}, {{ dashpot = \"400 N s/m\" }}]\n\
                     [effects]\ngravity = {{}}\n[run]\nduration = \"20 ms\"\n"
                );
                let scene = read(&scene, &ReadOptions::default()).unwrap().value;
                let settings = scene.settings(method).unwrap();
                let settings = SolveSettings { budget: FEW_STEPS, ..settings };
                if let Err(error) = scene.network.solve_with(&settings) {
                    faults.push(format!("{mass} on {pad} by {method}: {error}"));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}
