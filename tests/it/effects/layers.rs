//! What the segments of layers make of a result, beside the continuum.

use super::trial::run;

/// A hammer of 2.4 kg that strikes a bar of 1.2 kg, fixed behind, at 1 m/s.
fn struck(how: &str, between: &str) -> String {
    format!(
        r#"
        [materials]
        nylon = {{ spring = "2 GPa" }}
        [nodes]
        hammer = {{ mass = "2.4 kg", velocity = "1 m/s" }}
        face = {{}}
        [elements]
        tip = {{ between = ["hammer", "face"], {between} }}
        bar = {{ between = ["face", "ground"], layers = [{{ material = "nylon", thickness = "1 m", area = "10 cm^2", density = "1200 kg/m^3" }}], {how} }}
        [measures]
        bar = ["transmitted-force"]
        [run]
        duration = "3 ms"
        "#
    )
}

#[test]
fn errors_of_a_struck_bar_include_its_segments() {
    // Saint-Venant: the largest force at the fixed end is 2 v √(E ρ) A (1 + exp(−2 m/M)).
    let right = 2.0 * (2e9_f64 * 1200.0).sqrt() * 1e-3 * (1.0 + (-1.0_f64).exp());
    for segments in [4, 7, 14, 28] {
        let report = run(&struck(&format!("segments = {segments}"), "rigid = true"), "exact");
        let force = report.measure("bar.transmitted-force").unwrap();
        let off = (force.value.unwrap() - right).abs();
        assert!(off <= force.error.unwrap(), "{segments}: off by {off}: {force:?}");
        assert!(force.excess > 1.0, "{force:?}");
        let is_told = |own: &dashpot::analysis::Warning| {
            own.to_string().contains("segments of layers instead of")
        };
        assert!(report.warnings.iter().any(is_told), "{:?}", report.warnings);
        let compared = report.segmentation.as_ref().unwrap();
        assert_eq!((compared.segments, compared.others), (segments, segments / 2));
    }
}

#[test]
fn a_soft_tip_leaves_little_to_the_segments() {
    let tip = r#"spring = "200 kN/m""#;
    let of = |how: &str| run(&struck(how, tip), "exact");
    let fine = of("segments = 80");
    let mut last = f64::INFINITY;
    for segments in [5, 10, 20] {
        let report = of(&format!("segments = {segments}"));
        for measure in &report.measures {
            let Some(value) = measure.value else { continue };
            let right = fine.measure(&measure.key).unwrap();
            let allowed = measure.error.unwrap() + right.error.unwrap();
            let off = (value - right.value.unwrap()).abs();
            assert!(off <= allowed, "{segments}: {} is off by {off}", measure.key);
        }
        let force = report.measure("bar.transmitted-force").unwrap();
        let error = force.error.unwrap() / force.value.unwrap();
        assert!(error < 0.6 * last, "{segments}: {error}");
        last = error;
    }
    assert!(last < 0.02, "{last}");
}

#[test]
fn what_has_no_segments_is_solved_once() {
    let layers = r#"layers = [{ material = "nylon", thickness = "1 m", area = "10 cm^2", density = "1200 kg/m^3" }], segments = 9"#;
    let text = struck("segments = 9", "rigid = true").replace(layers, r#"spring = "2 MN/m""#);
    let report = run(&text.replace(r#"bar = ["transmitted-force"]"#, ""), "exact");
    assert_eq!((report.segmentation.is_none(), report.solver.solves_for_error), (true, 0));
}

#[test]
fn a_layer_that_is_thinner_than_nothing_is_told() {
    let text = r#"
        [materials]
        soft = { spring = "0.1 MPa" }
        hard = { spring = "10 MPa" }
        [nodes]
        head = { mass = "5 kg", velocity = "5 m/s" }
        [elements]
        pad = { between = ["head", "ground"], layers = [
            { material = "soft", thickness = "10 mm", area = "1 dm^2", density = "40 kg/m^3" },
            { material = "hard", thickness = "90 mm", area = "1 dm^2", density = "40 kg/m^3" },
        ], segments = 4 }
        [run]
        duration = "30 ms"
        "#;
    let report = run(text, "exact");
    let is_told = |own: &dashpot::analysis::Warning| {
        own.to_string().contains("a part of the pad") && own.to_string().contains("layer soft")
    };
    assert!(report.warnings.iter().any(is_told), "{:?}", report.warnings);
}
