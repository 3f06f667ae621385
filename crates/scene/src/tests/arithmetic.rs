//! Values that are computed.

use dashpot_network::Start;

use super::{messages, read_text, scene};
use crate::{ReadOptions, Tunables, read};

const SCENE: &str = r#"
[values]
area = "100 cm^2"
thickness = "25 mm"
m = "8 kg"
load = "2 * m * g0 / area"
E = "100 kPa * (1 + thickness / 50 mm)"
K = "E * area / thickness"

[nodes]
head = { mass = "m", velocity = "sqrt(2 * g0 * 0.76 m)" }

[elements]
pad = { between = ["head", "ground"], spring = "K / 2 + 10 kN/m" }

[run]
duration = "20 ms + load / 1 GPa * 1 s"
"#;

fn value(scene: &crate::Scene, name: &str) -> f64 {
    scene.values.iter().find(|own| own.name == name).map_or(f64::NAN, |own| own.value)
}

#[test]
fn values_are_computed_of_each_other_and_stand_wherever_a_quantity_does() {
    let own = scene(SCENE);
    assert!((value(&own, "load") / (16.0 * 9.80665 / 0.01) - 1.0).abs() < 1e-14);
    assert!((value(&own, "E") / 150e3 - 1.0).abs() < 1e-14);
    assert!((value(&own, "K") / 60e3 - 1.0).abs() < 1e-14);
    let parts = own.network.connections()[0].model.parts();
    let stiffness = parts[0].1.values()[0].number().expect("a stiffness");
    assert!((stiffness / 40e3 - 1.0).abs() < 1e-14);
    let head = own.network.nodes().find(|own| own.1.name == "head").expect("a node").1;
    let speed = (2.0 * 9.80665 * 0.76_f64).sqrt();
    assert!(matches!(head.start, Start::Velocity(own) if (own / speed - 1.0).abs() < 1e-15));
    assert!(read_text(SCENE).is_ok_and(|own| own.warnings.is_empty()));
}

#[test]
fn what_is_set_from_outside_is_seen_by_what_is_computed_of_it() {
    let set = [("thickness".to_owned(), "2 * 25 mm".to_owned())];
    let own = read(SCENE, &ReadOptions { set: &set, ..ReadOptions::default() }).expect("a scene");
    assert!((value(&own.value, "K") / (200e3 * 0.01 / 0.05) - 1.0).abs() < 1e-14);

    let all = Tunables::of(SCENE, None).expect("numbers");
    let (area, computed) = (all.find("area").expect("a number"), all.find("K").expect("a number"));
    assert!((all.all()[computed].value / 60e3 - 1.0).abs() < 1e-14);
    let own = scene(&all.text_with(&[(area, "50 cm^2".to_owned())]));
    assert!((value(&own, "K") / 30e3 - 1.0).abs() < 1e-14);
    let own = scene(&all.text_with(&[(computed, "1 MN/m".to_owned())]));
    assert!((value(&own, "K") / 1e6 - 1.0).abs() < 1e-14);
}

#[test]
fn faults_of_arithmetic_point_at_the_part_that_is_wrong() {
    let cases = [
        ("K / 2 + 10 kN/m", "K / 2 + 10 kN", "cannot be added", "^^^^^^^^^^^^^"),
        ("K / 2 + 10 kN/m", "K / 2 + 10 kN/mn", "`mn` is not a known unit", "^^^^^^^^"),
        ("K / 2 + 10 kN/m", "Kx / 2", "there is no value named `Kx`", "^^"),
        ("K / 2 + 10 kN/m", "K / area", "a stiffness (N/m) is expected here", "^^^^^^^^^^"),
        ("100 kPa * (1", "100 kPa * (* 1", "a number or a name is expected here", "^"),
        ("100 kPa * (1", "100 kPa + (1", "cannot be added", "^"),
        ("E * area /", "K * area /", "the value `K` refers to itself (K → K)", "^"),
    ];
    for (old, new, message, carets) in cases {
        let shown = messages(&SCENE.replacen(old, new, 1));
        assert!(shown.contains(message), "{new}: {shown}");
        assert!(shown.contains(carets), "{new}: {shown}");
        assert_eq!(shown.matches("error").count(), 1, "{new}: {shown}");
    }
    let shown = messages(&SCENE.replacen("m = \"8 kg\"", "m = 8", 1));
    assert!(shown.contains("`m` is \"8\", defined in line 5"), "{shown}");
    let shown = messages(&SCENE.replacen("K / 2 + 10 kN/m", "K / area", 1));
    assert!(shown.contains("`K` is \"E * area / thickness\""), "{shown}");
}

#[test]
fn units_and_scatter_in_the_wrong_place_have_a_remedy() {
    for (new, help) in [
        ("2^3 kN/m", "write `* 1` before the unit, or compute the number"),
        ("(2 + 1) kN/m", "write `* 1 kN` in place of `kN`"),
        ("E * area / thickness ± 5 %", "give it to one under [values], and compute with its name"),
    ] {
        let shown = messages(&SCENE.replacen("K / 2 + 10 kN/m", new, 1));
        let words = shown.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains(help), "{new}: {shown}");
    }
}

#[test]
fn chains_of_values_have_a_limit() {
    let links = |step: i32| -> Vec<String> {
        (1..1000).map(|at| format!("a{at} = \"2 * a{} / 2\"", at + step)).collect()
    };
    let with = |links: &[String], end: i32| {
        let values = format!("[values]\n{}\na{end} = \"1 m\"", links.join("\n"));
        SCENE.replacen("[values]", &values, 1)
    };
    // Rising ones find what they refer to known.
    let shown = messages(&with(&links(1), 1000));
    assert!(shown.contains("in a chain of more than 100"), "{shown}");
    let rising = links(-1);
    let first = format!("[values]\na0 = \"1 m\"\n{}", rising.join("\n"));
    assert!(read_text(&SCENE.replacen("[values]", &first, 1)).is_ok());
}
