//! Materials in compression, in shear and with their sides held: the one modulus made of the other.

use dashpot::{
    analysis::Solve,
    scene::{ReadOptions, read, read_named_model},
};

/// Young's modulus \[Pa\] and Poisson's ratio.
const YOUNG: f64 = 1e6;
const RATIO: f64 = 0.3;

fn scene(material: &str, pad: &str) -> String {
    format!(
        "[materials]\nrubber = {{ {material} }}\n[nodes]\nm = {{ mass = 4, velocity = 0.5 }}\n[elements]\n\
         pad = {{ between = [\"m\", \"ground\"], {pad} }}\n[run]\nduration = 0.2\n"
    )
}

const PAD: &str = "material = \"rubber\", thickness = \"2 cm\", area = \"10 cm^2\"";

/// The peak force on a spring of modulus `modulus`: v √(k m) with k = modulus · A/h.
fn peak(modulus: f64) -> f64 {
    0.5 * (modulus * 1e-3 / 0.02 * 4.0).sqrt()
}

fn force(text: &str) -> f64 {
    let scene = read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let report = scene.value.network.solve_with(&scene.value.settings("exact").unwrap()).unwrap();
    report.value("pad.peak-force").unwrap()
}

fn refusal(text: &str) -> String {
    read(text, &ReadOptions::default()).unwrap_err().render(false)
}

#[test]
fn each_loading_takes_its_own_modulus() {
    let shear = YOUNG / (2.0 * (1.0 + RATIO));
    let confined = YOUNG * (1.0 - RATIO) / ((1.0 + RATIO) * (1.0 - 2.0 * RATIO));
    let young = format!("spring = \"1 MPa\", poisson = {RATIO:?}");
    let of_shear = format!("spring = {shear:?}, moduli = \"shear\", poisson = {RATIO:?}");
    for material in [young, of_shear] {
        for (loading, modulus) in [
            ("", YOUNG),
            (", loaded = \"compression\"", YOUNG),
            (", loaded = \"shear\"", shear),
            (", loaded = \"confined\"", confined),
        ] {
            let found = force(&scene(&material, &format!("{PAD}{loading}")));
            let right = peak(modulus);
            assert!((found / right - 1.0).abs() < 1e-12, "{material}{loading}: {found} {right}");
        }
    }
}

#[test]
fn what_does_not_change_needs_no_ratio_and_foam_of_no_ratio_is_the_same_confined() {
    for (material, loading) in [
        ("spring = \"1 MPa\"", "compression"),
        ("spring = \"1 MPa\", moduli = \"shear\"", "shear"),
        ("spring = \"1 MPa\", poisson = 0", "confined"),
    ] {
        let found = force(&scene(material, &format!("{PAD}, loaded = \"{loading}\"")));
        assert!((found / peak(YOUNG) - 1.0).abs() < 1e-12, "{material} {loading}");
    }
    // The material by itself has the moduli that are written.
    let text = scene("spring = \"1 MPa\", moduli = \"shear\", poisson = 0.3", PAD);
    let own = read_named_model(&text, "rubber", &ReadOptions::default()).unwrap().value;
    assert!(dashpot::scene::write_model(&own.model).contains("1 MN/m"));
}

#[test]
fn dashpots_and_layers_with_mass_are_loaded_alike() {
    // A whole of 2 (1 + ν) times the moduli in compression is the same pad in shear.
    let of = |spring: f64, dashpot: f64, loading: &str| {
        let material = format!(
            "kelvin-voigt = {{ spring = {spring:?}, dashpot = {dashpot:?} }}, poisson = {RATIO:?}"
        );
        force(&scene(&material, &format!("{PAD}, loaded = \"{loading}\"")))
    };
    let factor = 2.0 * (1.0 + RATIO);
    let (one, other) = (of(1e6, 500.0, "compression"), of(factor * 1e6, factor * 500.0, "shear"));
    assert!((one / other - 1.0).abs() < 1e-12, "{one} {other}");
    let layer = |spring: f64, loading: &str| {
        let layers = format!(
            "segments = 4, layers = [{{ material = \"rubber\", thickness = \"2 cm\", area = \"10 cm^2\", \
             density = 1000, loaded = \"{loading}\" }}]"
        );
        force(&scene(&format!("spring = {spring:?}, poisson = {RATIO:?}"), &layers))
    };
    let (one, other) = (layer(1e6, "compression"), layer(factor * 1e6, "shear"));
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
}

#[test]
fn what_is_missing_is_named() {
    let shear = format!("{PAD}, loaded = \"shear\"");
    let confined = format!("{PAD}, loaded = \"confined\"");
    let power =
        "power-spring = { force = \"300 kPa\", at = \"50 %\", exponent = 2 }, poisson = 0.3";
    for (material, pad, told) in [
        ("spring = 1", &*shear, "material `rubber` has moduli in compression, and no `poisson`"),
        (
            "spring = 1, moduli = \"shear\"",
            PAD,
            "material `rubber` has moduli in shear, and no `poisson`",
        ),
        ("spring = 1, poisson = 0.5", &*confined, "does not give way where its sides are held"),
        ("spring = 1, poisson = 0.6", PAD, "`poisson` must be above -1 and at most 0.5"),
        (power, &*shear, "is not linear: its curve in one loading does not follow"),
        ("spring = 1, moduli = \"young\"", PAD, "`young` is not what moduli are"),
        ("spring = 1, loaded = \"shear\"", PAD, "a material has no `loaded`"),
        ("spring = 1", "spring = 1, loaded = \"shear\"", "`loaded` goes with a material, which"),
        (
            "spring = 1",
            "foam = { modulus = 1, plateau = 1, densification = 1 }, thickness = 1, area = 1, loaded = \"shear\"",
            "`loaded` goes with a material, which",
        ),
        ("spring = 1", &*format!("{PAD}, loaded = \"bent\""), "`bent` is not a way of loading"),
    ] {
        let rendered = refusal(&scene(material, pad));
        assert!(rendered.contains(told), "{told}: {rendered}");
    }
}
