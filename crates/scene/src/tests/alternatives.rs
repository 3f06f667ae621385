//! What is refused comes with what to write instead, and what is plain is read.

use super::{messages, on_model, read_text, scene};

fn has(shown: &str, parts: &[&str]) {
    for part in parts {
        assert!(shown.contains(part), "no `{part}` in\n{shown}");
    }
}

fn with_loads(loads: &str) -> String {
    format!("{}[loads.push]\non = \"head\"\n{loads}\n", on_model("spring = \"2 kN/m\""))
}

#[test]
fn exponents_are_numbers_and_phases_angles() {
    let power = |exponent: &str| {
        let law = "power-spring = { force = \"2 kN\", at = \"1 cm\", exponent = E }";
        on_model(&law.replace('E', exponent))
    };
    for exponent in ["2", "\"2\"", "\"200 %\"", "\"2 m/m\""] {
        assert!(read_text(&power(exponent)).is_ok(), "{exponent}");
    }
    has(&messages(&power("\"2 mol\"")), &["`2 mol` is an amount of substance", "without a unit"]);
    has(&messages(&power("\"2 rad\"")), &["`2 rad` is an angle; a pure number is expected here"]);
    let named = format!("[values]\nn = \"3 mmol\"\n{}", power("\"n\""));
    has(&messages(&named), &["is an amount of substance"]);
    let sine = "force = { sine = { amplitude = \"1 N\", frequency = \"3 Hz\", phase = P } }";
    for phase in ["\"90 deg\"", "\"1 rad\"", "0.5"] {
        assert!(read_text(&with_loads(&sine.replace('P', phase))).is_ok(), "{phase}");
    }
    has(&messages(&with_loads(&sine.replace('P', "\"1 mol\""))), &["amount of substance"]);
}

#[test]
fn constants_of_laws_have_powers_that_are_no_whole_numbers() {
    let hertz = "formula = { force = \"C * max(0, y)^1.5\", up-to = \"5 mm\" }";
    let values = "[values]\nC = \"2.75e9 N/m^1.5\"\n";
    let text = format!("{values}{}", on_model(hertz));
    let force = |text: &str| {
        let network = scene(text).network;
        let dashpot_rheology::Tree::Part(element) = network.connections()[0].model.clone() else {
            panic!("not one part")
        };
        element.force(1e-3, 0.0)
    };
    let exact = 2.75e9 * 1e-3_f64.powf(1.5);
    assert!((force(&text) / exact - 1.0).abs() < 1e-12);
    let direct = on_model(&hertz.replace('C', "2.75e9 N/m^1.5"));
    assert!((force(&direct) / exact - 1.0).abs() < 1e-12);
    let spring = format!("{values}{}", on_model("spring = \"C * sqrt(1 mm)\""));
    assert!((force(&spring) / (2.75e9 * 1e-3_f64.sqrt() * 1e-3) - 1.0).abs() < 1e-12);
    let wrong = format!("{values}{}", on_model("spring = \"C\""));
    has(&messages(&wrong), &["N/m^1.5", "a stiffness (N/m) is expected here"]);
}

#[test]
fn roots_of_what_is_cut_off_at_zero_have_slopes() {
    for force in [
        "1e6 N * (max(0, y) / 1 m)^1.5 + 100 N s/m * (max(0, y) / 1 m)^0.25 * max(0, v)",
        "2 kN/m * max(0, y) + 100 N s/m * sqrt(max(0, y) / 1 m) * max(0, v)",
        "2 kN/m * y + 1 N * sqrt(max(0, y / 1 m - 0.001))",
    ] {
        let law =
            format!("formula = {{ force = \"{force}\", up-to = \"5 mm\", rate = \"1.5 m/s\" }}");
        if let Err(errors) = read_text(&on_model(&law)) {
            panic!("{force}: {errors}");
        }
    }
}

#[test]
fn the_area_of_a_pad_is_that_of_its_one_part_that_needs_one() {
    let foam = "[materials]\nfoam = { spring = \"1 MPa\" }\n";
    let force = |law: &str| {
        let network = scene(&format!("{foam}{}", on_model(law))).network;
        let parts = network.connections()[0].model.branches().to_vec();
        let springs = parts.iter().filter_map(|branch| match &branch.tree {
            dashpot_rheology::Tree::Part(element) => Some(element.force(1e-3, 0.0)),
            _ => None,
        });
        springs.sum::<f64>()
    };
    let size = "thickness = \"20 mm\", area = \"100 cm^2\"";
    let passed = format!("parallel = [{{ material = \"foam\" }}, {{ dashpot = 10 }}], {size}");
    assert!((force(&passed) - 500.0).abs() < 1e-9);
    let own = "parallel = [{ material = \"foam\", area = \"50 cm^2\" }, { material = \"foam\" }], ";
    assert!((force(&format!("{own}{size}")) - 750.0).abs() < 1e-9);
    // Several would share it, and how is not said.
    let two = format!("parallel = [{{ material = \"foam\" }}, {{ material = \"foam\" }}], {size}");
    let shown = messages(&format!("{foam}{}", on_model(&two)));
    has(&shown, &["has no `area`", "each of several parts side by side has an area of its own"]);
    let row = format!(
        "series = [{{ material = \"foam\", thickness = \"1 cm\" }}, {{ dashpot = 10 }}], {size}"
    );
    has(&messages(&format!("{foam}{}", on_model(&row))), &["has no `area`"]);
}

#[test]
fn a_formula_that_ends_before_the_run_is_called_one() {
    let text =
        with_loads("force = { formula = { value = \"1 N * exp(t / 1 ms)\", until = \"5 ms\" } }");
    let shown = read_text(&text).unwrap().warnings.render(false);
    has(&shown, &["the formula of the load `push` ends at 5 ms", "`until`", "`min(t, 5 ms)`"]);
    assert!(!shown.contains("outside") && !shown.contains("table"), "{shown}");
    // What it says to write.
    let held =
        "force = { formula = { value = \"1 N * exp(min(t, 5 ms) / 1 ms)\", until = \"1 s\" } }";
    assert!(!read_text(&with_loads(held)).unwrap().warnings.render(false).contains("formula"));
}

#[test]
fn a_spring_without_stiffness_is_a_load() {
    let shown = messages(&on_model("preloaded-spring = { stiffness = 0, preload = \"50 N\" }"));
    has(&shown, &["must be positive", "is a load on each of its ends, `force = { constant = …"]);
    assert!(read_text(&with_loads("force = { constant = { value = \"50 N\" } }")).is_ok());
}
