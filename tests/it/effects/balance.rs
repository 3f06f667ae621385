//! Runs that begin in balance under gravity: the forces are the weights, and nothing moves.

use dashpot::{
    analysis::{RunReport, solve},
    dae::Silent,
    scene::{ReadOptions, read},
};

const G: f64 = 9.806_65;

/// Solves a scene at rest under gravity by both methods.
fn at_rest(nodes: &str, elements: &str, effects: &str, check: impl Fn(&RunReport)) {
    by(&["exact", "bdf"], [nodes, elements, effects], check);
}

/// What is off at rest: roundings by `exact`, and by a method with steps those of the residuals that it
/// solves for, in parts of its tolerance.
fn rounding(report: &RunReport) -> f64 {
    report.solver.rtol.map_or(1e-12, |rtol| 1e-4 * rtol)
}

fn by(methods: &[&str], [nodes, elements, effects]: [&str; 3], check: impl Fn(&RunReport)) {
    let text = format!(
        "[nodes]\n{nodes}\n[elements]\n{elements}\n[effects]\ngravity = {{}}\n{effects}\n[run]\n\
         duration = \"0.2 s\"\n"
    );
    let scene = read(&text, &ReadOptions::default()).unwrap().value;
    for &method in methods {
        let report = solve(&scene.network, &scene.settings(method), &mut Silent).unwrap();
        let solution = report.solution();
        for node in &report.assembly.nodes {
            let position = solution.signal(node.position);
            let moved = position.value(0.2) - position.value(0.0);
            let widest = position.bound().max(1e-3);
            let off = rounding(&report);
            assert!(moved.abs() <= off * widest, "{method}: {} moves by {moved}", node.name);
            let Some(velocity) = node.velocity else { continue };
            assert!(solution.signal(velocity).bound() <= off, "{method}: {}", node.name);
        }
        assert!(report.events.is_empty(), "{method}: {:?}", report.events);
        check(&report);
    }
}

/// The force in an element is this, from the start to the end.
fn carries(report: &RunReport, element: &str, expected: f64) {
    let connection = report.assembly.connection(element).unwrap();
    let solution = report.solution();
    let force = solution.signal(connection.force.unwrap());
    for time in [0.0, 0.1, 0.2] {
        let off = force.value(time) - expected;
        assert!(
            off.abs() <= rounding(report) * expected.max(1.0),
            "{element} at {time}: {off} off {expected}"
        );
    }
}

#[test]
fn a_mass_rests_on_a_contact_over_a_spring() {
    for (plate, weight) in [("{}", 0.0), ("{ mass = 2 }", 2.0)] {
        at_rest(
            &format!("box = {{ mass = 4 }}\nplate = {plate}"),
            "rest = { between = [\"box\", \"plate\"], contact = {} }\n\
             spring = { between = [\"plate\", \"ground\"], spring = 5000 }",
            "",
            |report| {
                carries(report, "rest", 4.0 * G);
                carries(report, "spring", (4.0 + weight) * G);
            },
        );
    }
}

#[test]
fn stacked_masses_press_the_contact_between_them() {
    at_rest(
        "top = { mass = 4 }\nmiddle = { mass = 3 }\nlow = { mass = 2 }",
        "upper = { between = [\"top\", \"middle\"], contact = {} }\n\
         pad = { between = [\"middle\", \"low\"], kelvin-voigt = { spring = 10000, dashpot = 20 } }\n\
         floor = { between = [\"low\", \"ground\"], contact = {} }",
        "separation.pad = {}",
        |report| {
            carries(report, "upper", 4.0 * G);
            carries(report, "pad", 7.0 * G);
            carries(report, "pad.contact", 7.0 * G);
            carries(report, "floor", 9.0 * G);
        },
    );
}

#[test]
fn a_face_with_mass_adds_its_weight_behind_it() {
    let pad = "pad = { between = [\"top\", \"ground\"], kelvin-voigt = { spring = 10000, dashpot = 20 } }";
    for separation in ["", "separation.pad = {}"] {
        at_rest(
            "top = { mass = 4 }",
            pad,
            &format!("face.pad = {{ mass = 1 }}\n{separation}"),
            |report| {
                carries(report, "pad.contact", 4.0 * G);
                carries(report, "pad", 5.0 * G);
            },
        );
        // A rigid stop at 3 mm takes what the spring does not.
        let effects =
            format!("face.pad = {{ mass = 1 }}\n{separation}\nstop.pad = {{ at = \"3 mm\" }}");
        at_rest("top = { mass = 4 }", pad, &effects, |report| {
            carries(report, "pad.contact", 4.0 * G);
            carries(report, "pad", 30.0);
            carries(report, "pad.stop", 5.0 * G - 30.0);
        });
    }
}

#[test]
fn a_stiffening_pad_under_a_contact_carries_the_weight() {
    let scene = [
        "box = { mass = 4 }",
        "pad = { between = [\"box\", \"ground\"], cubic-spring = { stiffness = 2000, cubic = 1e9 } }",
        "separation.pad = {}",
    ];
    by(&["bdf"], scene, |report| carries(report, "pad", 4.0 * G));
}
