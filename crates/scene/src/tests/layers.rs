//! Pads of layers.

use dashpot_network::{Network, layers::Resolution, linear_model};

use crate::{ReadOptions, read_named_model, read_network};

/// A head on a pad of two layers.
fn text(more: &str) -> String {
    let layer = |material: &str, thickness: &str, density: &str| {
        format!(
            "{{ material = \"{material}\", thickness = \"{thickness}\", area = \"100 cm^2\", \
             density = \"{density}\" }},\n"
        )
    };
    format!(
        "[materials]\neva = {{ spring = \"2 MPa\" }}\nfoam = {{ spring = \"1 MPa\" }}\n\
         [nodes]\nhead = {{ mass = 5, velocity = 4 }}\n\
         [elements.pad]\nbetween = [\"head\", \"ground\"]\n\
         layers = [\n{}{}]\n{more}\n",
        layer("eva", "10 mm", "120 kg/m^3"),
        layer("foam", "2 cm", "50 kg/m^3")
    )
}

fn network(text: &str) -> Network {
    let read = read_network(text, &ReadOptions::default());
    read.unwrap_or_else(|faults| panic!("{text}\n{faults}")).value
}

fn says(text: &str, expected: &[&str]) {
    let shown = read_network(text, &ReadOptions::default()).unwrap_err().render(false);
    for expected in expected {
        assert!(shown.contains(expected), "{expected}\nis not in\n{shown}");
    }
}

#[test]
fn layers_become_pads_of_their_materials() {
    let network = network(&text(""));
    let pad = &network.connections()[0];
    let layers = pad.layers.as_ref().unwrap();
    let names: Vec<&str> = layers.all.iter().map(|layer| layer.name.as_str()).collect();
    assert_eq!(names, ["eva", "foam"]);
    assert_eq!(layers.resolution, Resolution::Accuracy(0.01));
    assert_eq!(pad.thickness, Some(0.03));
    // 2 MPa and 1 MPa: 2 MN/m and 0.5 MN/m in series.
    let stiffness = linear_model(&pad.model).equilibrium_stiffness();
    assert!((stiffness / 4e5 - 1.0).abs() < 4.0 * f64::EPSILON, "{stiffness}");
    let mass = 0.01 * (120.0 * 0.01 + 50.0 * 0.02);
    assert!((layers.mass() / mass - 1.0).abs() < 4.0 * f64::EPSILON);
}

#[test]
fn the_resolution_is_a_number_of_segments_or_an_accuracy() {
    let resolution = |more: &str| {
        let network = network(&text(more));
        network.connections()[0].layers.as_ref().unwrap().resolution
    };
    assert_eq!(resolution("segments = 20"), Resolution::Segments(20));
    assert_eq!(resolution("accuracy = \"0.1 %\""), Resolution::Accuracy(0.001));
    says(&text("segments = 20\naccuracy = 0.1"), &["`segments`", "`accuracy`"]);
    says(&text("segments = 0"), &["`segments` is a whole number from 1 to 10000"]);
    says(&text("segments = \"many\""), &["`segments` is a whole number"]);
    says(&text("accuracy = 2"), &["`accuracy` must be more than 0 and less than 1"]);
}

#[test]
fn faults_in_layers_are_told_at_their_places() {
    let with = |old: &str, new: &str| {
        let text = text("");
        assert!(text.contains(old));
        text.replacen(old, new, 1)
    };
    says(&with(", density = \"120 kg/m^3\"", ""), &["layer 1 of element `pad` has no `density`"]);
    says(&with("\"120 kg/m^3\"", "\"120 kg\""), &["a density (kg/m^3) is expected here"]);
    says(&with("\"120 kg/m^3\"", "-1"), &["`density` must be zero or positive"]);
    says(&with("\"10 mm\"", "0"), &["`thickness` must be positive"]);
    says(&with("thickness = \"10 mm\", ", ""), &["layer 1 of element `pad` has no `thickness`"]);
    says(&with("\"foam\", thickness", "\"foma\", thickness"), &["`foma`", "did you mean `foam`?"]);
    says(&with("{ material = \"eva\", ", "{ "), &["has no `material`"]);
    says(&with("area = ", "aera = "), &["unknown key `aera`", "`area`"]);
    says(&text("spring = 1"), &["unknown key `spring` in element `pad`"]);
    says(&text("thickness = 1"), &["unknown key `thickness` in element `pad`"]);
    let other = "[elements.k]\nbetween = [\"head\", \"ground\"]\n";
    let segments = format!("{other}spring = 1\nsegments = 3");
    says(&text(&segments), &["unknown key `segments` in element `k`"]);
    says(&text(&format!("{other}layers = []")), &["one layer or more"]);
}

#[test]
fn a_pad_of_layers_is_no_model() {
    let faults = read_named_model(&text(""), "pad", &ReadOptions::default()).unwrap_err();
    assert!(faults.render(false).contains("is made of layers with mass"), "{faults}");
}
