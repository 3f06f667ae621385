//! Materials that are not linear: laws of stress over strain, written once in `[materials]`, held
//! against the same law of an element with its own thickness and area, against the law evaluated by
//! hand, and resolved into segments.

use dashpot::{
    analysis::{RunReport, ledger::ledger},
    dae::Signal,
    network::Model,
};

use super::trial::{run, scene};

/// Thickness \[m\] and area \[m²\] of all pads.
const SIZE: [f64; 2] = [0.02, 0.012];

/// What thickness and area are in a scene.
const PAD: &str = "thickness = \"20 mm\", area = \"120 cm^2\"";

/// Materials, the same laws for a pad of this size, and their stress over strain by hand.
type Law = (&'static str, &'static str, fn(f64) -> f64);

const LAWS: &[Law] = &[
    (
        "foam = { modulus = \"2 MPa\", plateau = \"0.1 MPa\", densification = \"20 kPa\", exponent = 3 }",
        "foam = { modulus = \"2 MPa\", plateau = \"0.1 MPa\", densification = \"20 kPa\", exponent = 3, \
         thickness = \"2 cm\", area = \"0.012 m^2\" }",
        |e| 1e5 * (1.0 - (-20.0 * e).exp()) + 2e4 * (e / (1.0 - e)).powi(3),
    ),
    (
        "power-spring = { force = \"300 kPa\", at = \"50 %\", exponent = 2.5 }",
        "power-spring = { force = \"3.6 kN\", at = \"10 mm\", exponent = 2.5 }",
        |e| 3e5 * (e / 0.5).powf(2.5),
    ),
    (
        "cubic-spring = { stiffness = \"0.4 MPa\", cubic = \"2 MPa\" }",
        // A/h = 0.6 m and A/h³ = 1500 1/m.
        "cubic-spring = { stiffness = \"240 kN/m\", cubic = \"3e9 N/m^3\" }",
        |e| 4e5 * e + 2e6 * e.powi(3),
    ),
    (
        "stiffening-spring = { stiffness = \"0.4 MPa\", limit = \"80 %\" }",
        "stiffening-spring = { stiffness = \"240 kN/m\", limit = \"16 mm\" }",
        |e| {
            let right = std::f64::consts::FRAC_PI_2;
            4e5 * 0.8 / right * (right * e / 0.8).tan()
        },
    ),
    (
        // Points on a line, so that the curve between them is one.
        "table-spring = [[\"-10 %\", \"-60 kPa\"], [0, 0], [\"30 %\", \"180 kPa\"], [0.8, \"480 kPa\"]]",
        "table-spring = [[\"-2 mm\", \"-720 N\"], [0, 0], [\"6 mm\", \"2.16 kN\"], [\"16 mm\", \"5.76 kN\"]]",
        |e| 6e5 * e,
    ),
    (
        "rate-spring = { force = \"300 kPa\", at = \"50 %\", gain = 0.1, reference-rate = \"2 1/s\" }",
        "rate-spring = { force = \"3.6 kN\", at = \"10 mm\", gain = 0.1, reference-rate = \"40 mm/s\" }",
        |e| 3e5 * (e / 0.5),
    ),
];

/// A scene with the material and a pad; `more` are tables after `[elements]`.
fn text(material: &str, pad: &str, more: &str) -> String {
    format!(
        "[materials.own]\n{material}\n[nodes]\nhead = {{ mass = \"5 kg\", velocity = \"3 m/s\" }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], {pad} }}\n{more}\n[run]\n\
         duration = \"12 ms\"\n"
    )
}

/// The model of the pad.
fn model(text: &str) -> Model {
    scene(text).network.connections()[0].model.clone()
}

/// Its force at a deformation and a rate.
fn force(model: &Model, deformation: f64, rate: f64) -> f64 {
    model.parts()[0].1.force(deformation, rate)
}

#[test]
fn a_pad_of_a_material_is_the_element_of_its_size_and_has_the_stress_by_hand() {
    let [thickness, area] = SIZE;
    for (material, element, stress) in LAWS {
        let of_material = model(&text(material, &format!("material = \"own\", {PAD}"), ""));
        let of_element = model(&text("spring = 1", element, ""));
        for part in 0..=15 {
            let strain = 0.05 * f64::from(part);
            let [found, other] = [&of_material, &of_element].map(|own| {
                let standing = force(own, strain * thickness, 0.0);
                (standing, force(own, strain * thickness, 0.3))
            });
            // A few roundings of the strain, which the steepest law here multiplies by 25.
            let near =
                |one: f64, other: f64| (one - other).abs() <= 200.0 * f64::EPSILON * other.abs();
            assert!(near(found.0, other.0) && near(found.1, other.1), "{material} at {strain}");
            assert!(near(found.0, area * stress(strain)), "{material} at {strain}: {}", found.0);
        }
    }
}

#[test]
fn the_size_of_a_foam_may_stand_in_it_beside_it_or_with_a_material() {
    let (material, element, _) = LAWS[0];
    let written = |pad: &str| {
        let network = scene(&text(material, pad, "")).network;
        let pad = &network.connections()[0];
        let sizes = [pad.thickness.unwrap(), pad.area.unwrap()];
        let is_same = |at: usize| (sizes[at] / SIZE[at] - 1.0).abs() <= 4.0 * f64::EPSILON;
        assert!(is_same(0) && is_same(1), "the measures know another size: {sizes:?}");
        pad.model.parts()[0].1.values()
    };
    let own = written(element);
    assert_eq!(written(&format!("{material}, {PAD}")), own);
    assert_eq!(written(&format!("material = \"own\", {PAD}")), own);
    // And both ways, as long as they agree.
    assert_eq!(written(&format!("{element}, {PAD}")), own);
}

fn value(report: &RunReport, measure: &str) -> (f64, f64) {
    let found = report.measure(measure).unwrap_or_else(|| panic!("no measure {measure}"));
    (found.value.unwrap_or_else(|| panic!("{:?}", found.notes)), found.error.unwrap())
}

#[test]
fn stress_and_strain_of_a_struck_foam_are_those_by_energy() {
    // ½ m v² = h A ∫ σ dε up to the deepest point, by Simpson's rule and bisection.
    let [thickness, area] = SIZE;
    let (material, element, stress) = LAWS[0];
    let density = 0.5 * 5.0 * 9.0 / (thickness * area);
    let energy = |strain: f64| {
        let panels = 2000;
        let step = strain / f64::from(2 * panels);
        let terms = (0..=2 * panels).map(|at| {
            let weight =
                if at == 0 || at == 2 * panels { 1.0 } else { f64::from(2 + 2 * (at % 2)) };
            weight * stress(step * f64::from(at))
        });
        terms.sum::<f64>() * step / 3.0
    };
    let (mut low, mut high) = (0.0, 0.95);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if energy(middle) < density { low = middle } else { high = middle }
    }
    let measures = "[measures]\npad = [\"peak-stress\", \"peak-strain\"]";
    for pad in
        [element.to_owned(), format!("{material}, {PAD}"), format!("material = \"own\", {PAD}")]
    {
        let report = run(&text(material, &pad, measures), "bdf");
        let (strain, error) = value(&report, "pad.peak-strain");
        assert!((strain - low).abs() <= error, "{pad}: {strain} is not {low} ± {error:e}");
        let (found, error) = value(&report, "pad.peak-stress");
        assert!((found - stress(low)).abs() <= error, "{pad}: {found} is not {}", stress(low));
    }
}

/// Errors of a run in parts of its largest values: those of a stepping method are up to 1000 of its
/// tolerance.
fn errors(report: &RunReport) -> f64 {
    1e3 * report.solver.rtol.unwrap()
}

/// The time in which a pad is pressed in and let go \[s\], and how deep \[m\].
const PRESS: f64 = 0.5;
const DEPTH: f64 = 0.012;

/// A layer of 48 g that a haversine presses in by 60 %, and lets go.
fn pressed(material: &str, segments: usize) -> RunReport {
    let text = format!(
        "[materials.own]\n{material}\n[nodes]\nplate = {{ motion = {{ haversine = {{ peak = {DEPTH:?}, \
         duration = {PRESS:?} }} }} }}\n[elements]\npad = {{ between = [\"plate\", \"ground\"], layers \
         = [{{ material = \"own\", {PAD}, density = \"200 kg/m^3\" }}], segments = {segments} }}\n\
         [accuracy]\ndefault = 1e-4\n[run]\nduration = {PRESS:?}\n"
    );
    run(&text, "bdf")
}

/// The depth at a time.
fn depth(time: f64) -> f64 {
    0.5 * DEPTH * (1.0 - (std::f64::consts::TAU * time / PRESS).cos())
}

fn signal(report: &RunReport, name: &str) -> Signal {
    let solution = report.solution();
    let output = solution.assembly().output(name).unwrap_or_else(|| panic!("no output {name}"));
    solution.signal(output).clone()
}

#[test]
fn a_layer_that_is_pressed_in_slowly_has_its_law_however_many_segments_it_has() {
    let [thickness, area] = SIZE;
    let acceleration = 0.5 * DEPTH * (std::f64::consts::TAU / PRESS).powi(2);
    // The forces on the faces differ from that of the law by what moves the mass, which swings up to
    // twice as far where the plate begins with an acceleration at once.
    let inertia = 2.0 * 200.0 * thickness * area * acceleration;
    for (material, _, stress) in &LAWS[..5] {
        // A power law has no slope at rest: nothing determines where its segments are then.
        if material.starts_with("power") {
            continue;
        }
        for segments in [1, 3] {
            let report = pressed(material, segments);
            for face in ["pad.force", "pad.transmitted-force"] {
                let force = signal(&report, face);
                let peak = area * stress(DEPTH / thickness);
                for at in 0..=40 {
                    let time = PRESS * f64::from(at) / 40.0;
                    let expected = area * stress(depth(time) / thickness);
                    let within = inertia + errors(&report) * peak;
                    let error = (force.value(time) - expected).abs();
                    assert!(
                        error <= within,
                        "{material} {segments} {face} {time}: {error:e} {within:e}"
                    );
                }
            }
            for time in [0.3 * PRESS, 0.5 * PRESS, PRESS] {
                let closure = ledger(&report.solution(), time).closure();
                assert!(
                    closure.abs() <= errors(&report),
                    "{material}, {segments} segments: {closure:e}"
                );
            }
        }
    }
}

#[test]
fn foam_that_keeps_a_set_unloads_on_its_lower_curve_in_every_segment() {
    let [thickness, area] = SIZE;
    let material = "hysteretic-foam = { modulus = \"2 MPa\", plateau = \"0.1 MPa\", densification = \
                    \"20 kPa\", exponent = 3, set = \"20 %\", unloading-exponent = 2 }";
    let stress = LAWS[0].2;
    let acceleration = 0.5 * DEPTH * (std::f64::consts::TAU / PRESS).powi(2);
    let inertia = 2.0 * 200.0 * thickness * area * acceleration;
    let report = pressed(material, 3);
    let force = signal(&report, "pad.force");
    for at in 1..=19 {
        let time = PRESS * f64::from(at) / 20.0;
        let (y, set) = (depth(time), 0.2 * DEPTH);
        let factor =
            if time > 0.5 * PRESS { ((y - set) / (DEPTH - set)).max(0.0).powi(2) } else { 1.0 };
        let expected = area * stress(y / thickness) * factor;
        let within = inertia + errors(&report) * area * stress(0.6);
        let error = (force.value(time) - expected).abs();
        assert!(error <= within, "{time}: {error:e} {within:e}");
    }
    let closure = ledger(&report.solution(), 0.8 * PRESS).closure();
    assert!(closure.abs() <= errors(&report), "{closure:e}");
}

#[test]
fn a_struck_layer_keeps_its_energy_whatever_its_segments() {
    // The law and the mass are the same for any number of segments, so is what the head gets back.
    for segments in [2, 6] {
        let layers = format!(
            "layers = [{{ material = \"own\", {PAD}, density = \"40 kg/m^3\" }}], segments = {segments}"
        );
        let report = run(&text(LAWS[0].0, &layers, ""), "bdf");
        for time in [2e-3, 6e-3, 12e-3] {
            let closure = ledger(&report.solution(), time).closure();
            assert!(
                closure.abs() <= errors(&report),
                "{segments} segments: {closure:e} at {time} s"
            );
        }
        let warned = |own: &dashpot::analysis::Warning| {
            own.to_string().contains("is not linear") && own.to_string().contains("other numbers")
        };
        assert!(report.warnings.iter().any(warned), "{:?}", report.warnings);
    }
}
