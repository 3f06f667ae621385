//! Runs that begin in balance under gravity: the forces are the weights, and nothing moves.

use dashpot::{
    analysis::{RunReport, Solve},
    scene::{ReadOptions, read},
};

use super::trial::run;

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
    by_gravity(methods, [nodes, elements, &format!("gravity = {{}}\n{effects}")], check);
}

fn by_gravity(methods: &[&str], [nodes, elements, effects]: [&str; 3], check: impl Fn(&RunReport)) {
    let text = format!(
        "[nodes]\n{nodes}\n[elements]\n{elements}\n[effects]\n{effects}\n[run]\nduration = \"0.2 s\"\n"
    );
    let scene = read(&text, &ReadOptions::default()).unwrap().value;
    for &method in methods {
        let report = scene.network.solve_with(&scene.settings(method).unwrap()).unwrap();
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

const MAXWELL: &str = "maxwell = { spring = 100000, dashpot = 1000 }";
const BURGERS: &str = "burgers = { maxwell = { spring = 100000, dashpot = 1000 }, \
                       kelvin = { spring = 60000, dashpot = 800 } }";
const KELVIN_VOIGT: &str = "kelvin-voigt = { spring = 100000, dashpot = 1000 }";
const FOAM: &str = "hysteretic-foam = { modulus = 2e5, plateau = 2e4, densification = 500, \
                    exponent = 1.5, thickness = 0.02, area = 0.0166, set = 0.2, unloading-exponent = 2 }";
/// Stiffness under the panel \[N/m\], whose mass is 3 kg.
const MOUNT: f64 = 50_000.0;

/// A head on a pad on a panel that sags by 3 g/`MOUNT`.
fn struck_panel(start: &str, pad: &str, effects: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 5, {start} }}\npanel = {{ mass = 3 }}\n\
         [elements]\npad = {{ between = [\"head\", \"panel\"], {pad} }}\n\
         mount = {{ between = [\"panel\", \"ground\"], kelvin-voigt = {{ spring = {MOUNT}, dashpot = 100 }} }}\n\
         [effects]\ngravity = {{}}\n{effects}\n[run]\nduration = 0.06\n"
    )
}

fn starts_at(report: &RunReport, output: &str, expected: f64) {
    let solution = report.solution();
    let signal = solution.signal(report.assembly.output(output).unwrap());
    let off = signal.value(0.0) - expected;
    assert!(off.abs() <= 1e-14, "{}: {output} is {off} off", report.solver.method);
}

#[test]
fn an_impactor_meets_an_undeformed_pad_on_a_panel_that_has_sagged() {
    let static_equilibrium = 3.0 * G / MOUNT;
    for pad in [MAXWELL, BURGERS, KELVIN_VOIGT] {
        let glued = run(&struck_panel("velocity = 2", pad, ""), "exact");
        for at in ["head", "panel"] {
            let text =
                struck_panel("velocity = 2", pad, &format!("separation.pad = {{ at = \"{at}\" }}"));
            for method in ["exact", "bdf", "esdirk34"] {
                let report = run(&text, method);
                starts_at(&report, "head.position", static_equilibrium);
                starts_at(&report, "panel.position", static_equilibrium);
                starts_at(&report, "pad.deformation", 0.0);
                // As long as it pushes, a pad does not know that it could part.
                for measure in ["pad.peak-force", "pad.contact-time", "head.peak-acceleration"] {
                    let value =
                        |report: &RunReport| report.measure(measure).unwrap().value.unwrap();
                    let (found, expected) = (value(&report), value(&glued));
                    let allowed = report.solver.rtol.map_or(1e-9, |rtol| 1e3 * rtol);
                    let off = (found / expected - 1.0).abs();
                    assert!(off <= allowed, "{method}, {pad}, {at}: {measure} is {off} off");
                }
            }
        }
    }
    let foam = run(&struck_panel("velocity = 2", FOAM, ""), "bdf");
    starts_at(&foam, "head.position", static_equilibrium);
    starts_at(&foam, "pad.deformation", 0.0);
}

#[test]
fn what_is_dropped_falls_its_height_to_what_has_sagged() {
    let (static_equilibrium, height) = (3.0 * G / MOUNT, 0.002);
    for pad in [MAXWELL, KELVIN_VOIGT] {
        let text = struck_panel("drop = 0.002", pad, "separation.pad = {}");
        let report = run(&text, "exact");
        starts_at(&report, "head.position", static_equilibrium - height);
        let touch = report.trajectory.switches.first().unwrap().time;
        assert!((touch - (2.0 * height / G).sqrt()).abs() <= 1e-12, "touches at {touch}");
    }
}

#[test]
fn a_panel_that_is_struck_without_a_pad_has_sagged_all_the_same() {
    let report = run(&struck_panel("velocity = 2", "contact = { gap = 0.001 }", ""), "exact");
    let static_equilibrium = 3.0 * G / MOUNT;
    starts_at(&report, "head.position", static_equilibrium);
    let report = run(&struck_panel("velocity = 2", "contact = {}", ""), "exact");
    starts_at(&report, "head.position", static_equilibrium);
    starts_at(&report, "panel.position", static_equilibrium);
}

#[test]
fn sliders_that_cannot_hold_the_weight_have_slid_before() {
    let weight = 10.0 * G;
    // The law of the pad, and where it stands: of springs of 1 kN/m as if the weight had grown slowly.
    let cases = [
        ("{ spring = 1000 }, { friction = 1 }", (weight - 1.0) / 1000.0),
        ("{ spring = 1000 }, { friction = 60 }, { friction = 20 }", (weight - 80.0) / 1000.0),
        ("{ spring = 1000 }, { friction = 60 }, { friction = 40 }", 0.0),
        (
            "{ spring = 1000 }, { series = [{ spring = 1000 }, { friction = 10 }] }",
            (weight - 10.0) / 1000.0,
        ),
        ("{ spring = 1000 }, { series = [{ spring = 1000 }, { friction = 50 }] }", weight / 2000.0),
        (
            "{ series = [{ spring = 1000 }, { friction = 40 }] }, \
             { series = [{ cubic-spring = { stiffness = 1000, cubic = 0 } }, { friction = 200 }] }",
            (weight - 40.0) / 1000.0,
        ),
    ];
    for (parts, place) in cases {
        for sign in [1.0, -1.0] {
            let element = format!(
                "pad = {{ between = [\"box\", \"ground\"], parallel = [{parts}, {{ dashpot = 10 }}] }}"
            );
            let pulled = format!("gravity = {{ value = {} }}", sign * G);
            by_gravity(&["exact", "bdf"], ["box = { mass = 10 }", &element, &pulled], |report| {
                carries(report, "pad", sign * weight);
                let solution = report.solution();
                let start = solution.signal(report.assembly.nodes[1].position).value(0.0);
                let off = start - sign * place;
                assert!(off.abs() <= 1e-9 * weight / 1000.0, "{parts}: {start} off by {off}");
            });
        }
    }
}

#[test]
fn a_weight_that_only_a_slider_too_weak_holds_has_no_balance() {
    let text = "[nodes]\nbox = { mass = 10 }\n[elements]\nrail = { between = [\"box\", \
                \"ground\"], friction = 50 }\n[effects]\ngravity = {}\n[run]\nduration = 1\n";
    let error = read(text, &ReadOptions::default()).unwrap_err().to_string();
    assert!(error.contains("start in balance") && error.contains("box"), "{error}");
}
