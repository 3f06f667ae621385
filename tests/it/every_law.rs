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
