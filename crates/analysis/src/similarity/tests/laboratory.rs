//! Laboratory tests.

use super::*;

#[test]
fn laboratory_tests_are_similar_and_their_measures_map_back() {
    let real = reference();
    let wish = |name: &str, value| Wish { name: name.to_owned(), value };
    let wishes = [wish("mass", 1.0), wish("speed", 2.0), wish("thickness", 0.005)];
    let found = Laboratory::design(&real, &wishes).unwrap();
    close(found.scale.mass, 0.1, 1e-15);
    close(found.scale.length, 0.25, 1e-15);
    close(found.scale.time, 1.25, 1e-15);
    assert!(Similarity::between(&real, &found.network, 1e-14).unwrap().is_similar());
    let settings = SolveSettings::lasting(0.02).by_name("exact").unwrap();
    let (similar, _) = similar_settings(&settings, &found.scale);
    let one = real.solve_with(&settings).unwrap();
    let other = found.network.solve_with(&similar).unwrap();
    let force = |report: &crate::RunReport| report.measure("padding.peak-force").unwrap().value;
    // Forces go with m V²/δ.
    close(force(&other).unwrap() / force(&one).unwrap(), 0.1 * 0.04 / 0.25, 1e-12);
    let severity = |report: &crate::RunReport| report.measure("head.severity-index").unwrap().value;
    let factor = (0.25_f64 / 1.25 / 1.25).powf(2.5) * 1.25;
    close(severity(&other).unwrap() / severity(&one).unwrap(), factor, 1e-12);
    close(found.scale.of_measure(&SeverityIndex::default()), factor, 1e-14);
}

#[test]
fn wishes_of_a_laboratory_may_be_few_but_not_contradictory() {
    let real = reference();
    let wish = |name: &str, value| Wish { name: name.to_owned(), value };
    let found = Laboratory::design(&real, &[wish("panel.mass", 10.0)]).unwrap();
    let kept: Vec<&str> = found.kept.iter().map(|own| own.name.as_str()).collect();
    assert_eq!(kept, ["head.velocity", "padding.thickness"]);
    close(found.scale.mass, 0.1, 1e-15);
    let both = [wish("mass", 1.0), wish("panel.mass", 20.0)];
    assert!(matches!(
        Laboratory::design(&real, &both),
        Err(SimilarityError::Contradiction { follows, .. }) if (follows - 10.0).abs() < 1e-12
    ));
    assert!(Laboratory::design(&real, &[wish("mass", 1.0), wish("panel.mass", 10.0)]).is_ok());
    let fault = Laboratory::design(&real, &[wish("mass", -1.0)]).unwrap_err().to_string();
    assert!(fault.ends_with(" kg in the scene, so no scale makes it -1 kg"), "{fault}");
    assert!(matches!(
        Laboratory::design(&real, &[wish("size", 1.0)]),
        Err(SimilarityError::UnknownQuantity { .. })
    ));
}

#[test]
fn gravity_that_cannot_be_scaled_is_told() {
    let mut real = reference();
    real.add_effect(Gravity { acceleration: 9.8, start: GravityStart::Equilibrium });
    let wish = |name: &str, value| Wish { name: name.to_owned(), value };
    let wishes = [wish("speed", 5.0), wish("thickness", 0.02)];
    let found = Laboratory::design(&real, &wishes).unwrap();
    let [own, needed] = found.gravity.unwrap();
    close(own, 9.8, 1e-15);
    close(needed, 9.8 / 4.0, 1e-14);
    let under = found.under_real_gravity().unwrap();
    let different = Similarity::between(&real, &under, 1e-12).unwrap();
    let names: Vec<&str> = different.different().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["gravity.value"]);
}
