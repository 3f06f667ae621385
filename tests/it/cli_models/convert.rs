//! `dashpot convert`.

use std::fs;

use dashpot::{
    network::Element,
    rheology::conversion::Target,
    scene::{ReadOptions, read_named_model},
};

use super::{Desk, SCENE, ends, measures};
use crate::cli::text;

/// A model of each shape, written otherwise than in the form that it fits.
const SHAPES: [(&str, &str); 6] = [
    ("maxwell", "series = [{ spring = 6e6 }, { dashpot = 4e3 }, { spring = 3e6 }]"),
    ("kelvin-voigt", "parallel = [{ spring = 6e6 }, { dashpot = 4e3 }, { dashpot = 3e3 }]"),
    ("zener", "series = [{ spring = 6e6 }, { kelvin = { spring = 3e6, dashpot = 4e3 } }]"),
    ("jeffreys", "parallel = [{ dashpot = 5e2 }, { maxwell = { spring = 3e6, dashpot = 4e3 } }]"),
    ("burgers", "prony = { terms = [[\"1 ms\", \"3 MN/m\"], [\"0.1 s\", \"4 MN/m\"]] }"),
    ("", "spring = 3e6"),
];

#[test]
fn every_form_takes_the_models_that_fit_it_and_says_why_it_takes_no_other() {
    let models = SHAPES.map(|(name, law)| format!("[models.m-{name}]\n{law}\n")).concat();
    let desk = Desk::with(&[("shapes.toml", &models)]);
    for (fitting, _) in SHAPES {
        let word = desk.word(&format!("shapes.toml:m-{fitting}"));
        for target in Target::all() {
            let is_canonical = target.word.starts_with("generalized");
            let arguments = ["convert", &word, "--to", target.word];
            if is_canonical || target.word == fitting {
                let (shown, said) = ends(&arguments, 0);
                assert!(said.contains("round trip: the same"), "{said}");
                let path = desk.path("converted.toml");
                fs::write(&path, shown).unwrap();
                let converted = format!("{}:m-{fitting}", text(&path));
                ends(&["compare", &word, &converted], 0);
            } else {
                let (shown, said) = ends(&arguments, 2);
                let expected = format!("cannot be written as `{}`: the form is ", target.word);
                assert!(shown.is_empty() && said.contains(&expected), "{said}");
                assert!(said.contains("; the model is ") && said.contains("take every model"));
            }
        }
    }
}

#[test]
fn every_other_word_of_a_form_is_the_form() {
    for target in Target::all() {
        for alias in target.aliases {
            let [own, other] = [target.word, alias]
                .map(|form| crate::cli::run(&["convert", "reference:padding", "--to", form]));
            assert_eq!((own.stdout, own.stderr), (other.stdout, other.stderr), "{alias}");
        }
    }
    let said = ends(&["convert", "reference:padding", "--to", "burger"], 2).1;
    assert!(said.contains("burgers") && said.contains("generalized-maxwell"), "{said}");
}

#[test]
fn what_bears_nothing_or_gives_nothing_has_one_form_only() {
    let desk =
        Desk::with(&[("odd.toml", "[models.rigid]\nrigid = true\n[models.nothing]\nspring = 0\n")]);
    for (name, form, reason) in [
        ("rigid", "generalized-maxwell", "a rigid link has no Maxwell form"),
        ("nothing", "generalized-kelvin", "a model that bears no force has no Kelvin form"),
        ("nothing", "zener", "the form is a spring and a Maxwell element in parallel"),
    ] {
        let word = desk.word(&format!("odd.toml:{name}"));
        let (shown, said) = ends(&["convert", &word, "--to", form], 2);
        assert!(shown.is_empty() && said.contains(reason), "{name} to {form}: {said}");
    }
}

#[test]
fn a_converted_scene_runs_and_gives_the_same_measures() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    let before = measures(&desk.path("scene.toml"));
    assert!(before.len() >= 8);
    for name in ["valox-pad", "padding"] {
        for form in ["generalized-maxwell", "generalized-kelvin", "burgers"] {
            let converted = desk.path(&format!("{name}-{form}.toml"));
            let word = desk.word(&format!("scene.toml:{name}"));
            let shown = ends(&["convert", &word, "--to", form, "--out", text(&converted)], 0).0;
            assert!(shown.starts_with("wrote ") && shown.contains(&format!(":{name}`")), "{shown}");
            let after = measures(&converted);
            assert_eq!(after.len(), before.len());
            for ((key, a), (other, b)) in before.iter().zip(&after) {
                assert_eq!(key, other);
                assert!((a - b).abs() <= 1e-10 * a.abs(), "{name} as {form}, {key}: {a} and {b}");
            }
        }
    }
}

#[test]
fn everything_but_the_model_stays_as_it_is() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    for name in ["valox-pad", "foam", "padding", "mount"] {
        let word = desk.word(&format!("scene.toml:{name}"));
        let shown = ends(&["convert", &word, "--to", "generalized-kelvin"], 0).0;
        let is_kept = |line: &&str| !line.starts_with(name) && !line.contains(" = { maxwell");
        for line in SCENE.lines().filter(is_kept) {
            assert!(
                line.starts_with("zener") || shown.lines().any(|own| own == line),
                "{line}:\n{shown}"
            );
        }
        for comment in
            ["# Pads of May.", "# The pad of the thesis.", "# from chapter IV", "# steel"]
        {
            assert_eq!(shown.matches(comment).count(), 1, "{comment}\n{shown}");
        }
        assert!(shown.contains("# Valox 310") && shown.contains("# what is hit"), "{shown}");
    }
    // An element keeps its ends and its thickness.
    let word = desk.word("scene.toml:padding");
    let shown = ends(&["convert", &word, "--to", "burgers"], 0).0;
    assert!(
        shown.contains("padding = { between = [\"head\", \"panel\"], thickness = \"2 cm\","),
        "{shown}"
    );
    assert!(!shown.contains("model = \"valox-pad\""), "{shown}");
}

#[test]
fn a_material_stays_one() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    let word = desk.word("scene.toml:foam");
    let shown = ends(&["convert", &word, "--to", "generalized-kelvin"], 0).0;
    // K₁K₂/(K₁ + K₂) in series: 3.8 MPa, then 0.8 · 3.8/3 MPa beside 9 kPa s (3.8/3)².
    let options = ReadOptions::default();
    let found = read_named_model(&shown, "foam", &options).unwrap().value;
    assert!(found.is_material && shown.contains("MPa") && shown.contains("kPa s"), "{shown}");
    let constants = constants(&found.model.parts());
    for (found, expected) in
        constants.iter().zip([3.8e6, 0.8e6 * 3.8 / 3.0, 9e3 * (3.8 / 3.0f64).powi(2)])
    {
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} for {expected}");
    }
}

fn constants(parts: &[(String, &std::sync::Arc<dyn Element>)]) -> Vec<f64> {
    parts
        .iter()
        .map(|(_, part)| {
            let tangent = part.tangent(0.0, 0.0);
            tangent.stiffness + tangent.damping
        })
        .collect()
}

/// Models in sections of their own, one of them shifted, and a pad of a material.
const SECTIONS: &str = r#"
[[models.rows.series]] # the first
spring = "4 MN/m"
[[models.rows.series]]
# the second
dashpot = "5 kN s/m"

[models.sub.burgers.maxwell]
spring = "20 MN/m" # stiff
dashpot = "6 kN s/m"
[models.sub.burgers.kelvin] # slow
spring = "20 MN/m"
dashpot = "4 kN s/m"

[models.cold]
model = "sub"
shift = { arrhenius = { temperature = "280 K", reference = "300 K", energy = "40 kJ/mol" } } # winter

[materials.foam]
zener = { spring = "0.8 MPa", maxwell = { spring = "3 MPa", dashpot = "9 kPa s" } }

[nodes]
head = { mass = "10 kg", velocity = "10 m/s" }

[elements.padding]
between = ["head", "ground"] # on the floor
material = "foam" # of May
thickness = "2 cm" # thin
area = "0.5 m^2"
shift = { arrhenius = { temperature = "280 K", reference = "300 K", energy = "40 kJ/mol" } }

[run]
duration = "20 ms"
"#;

#[test]
fn sections_shifts_and_sizes_become_plain_numbers() {
    let desk = Desk::with(&[("sections.toml", SECTIONS)]);
    let before = measures(&desk.path("sections.toml"));
    for name in ["rows", "sub", "cold", "foam", "padding"] {
        let word = desk.word(&format!("sections.toml:{name}"));
        let path = desk.path("converted.toml");
        let arguments = ["convert", &word, "--to", "prony", "--out", text(&path), "--force"];
        ends(&arguments, 0);
        ends(&["compare", &word, &format!("{}:{name}", text(&path))], 0);
        // All else stands, so the impact is as before.
        for ((key, a), (_, b)) in before.iter().zip(measures(&path)) {
            assert!((a - b).abs() <= 1e-10 * a.abs(), "{name}, {key}: {a} and {b}");
        }
        let content = fs::read_to_string(&path).unwrap();
        let is_shifted = matches!(name, "cold" | "padding");
        assert_eq!(
            content.matches("arrhenius").count(),
            if is_shifted { 1 } else { 2 },
            "{content}"
        );
        assert!(content.contains("thickness = \"2 cm\" # thin"), "{content}");
        assert_eq!(content.contains("area"), name != "padding", "{content}");
    }
}

#[test]
fn comments_in_all_sections_of_a_model_are_kept() {
    let desk = Desk::with(&[("sections.toml", SECTIONS)]);
    for (name, comments) in [
        ("padding", &["# on the floor", "# of May", "# thin"][..]),
        ("cold", &["# winter"]),
        ("sub", &["# stiff", "# slow"]),
        ("rows", &["# the first", "# the second"]),
    ] {
        let word = desk.word(&format!("sections.toml:{name}"));
        let shown = ends(&["convert", &word, "--to", "generalized-maxwell"], 0).0;
        for comment in comments {
            assert!(shown.contains(comment), "{name} lost {comment}:\n{shown}");
        }
    }
}

#[test]
fn files_are_not_overwritten_unasked() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    let word = desk.word("scene.toml:valox-pad");
    let path = desk.path("scene.toml");
    let arguments = ["convert", &word, "--to", "prony", "--out", text(&path)];
    let (shown, said) = ends(&arguments, 2);
    assert!(
        shown.is_empty() && said.contains("exists already") && said.contains("--force"),
        "{said}"
    );
    assert_eq!(fs::read_to_string(&path).unwrap(), SCENE);
    ends(&[&arguments[..], &["--force"]].concat(), 0);
    let written = fs::read_to_string(&path).unwrap();
    assert!(written.contains("maxwell-2") && !written.contains("burgers = "), "{written}");
}

#[test]
fn a_file_with_one_model_needs_no_name() {
    let desk =
        Desk::with(&[("pad.toml", "[models.pad]\nmaxwell = { spring = 6e6, dashpot = 4e3 }\n")]);
    let [whole, named] = ["pad.toml", "pad.toml:pad"]
        .map(|word| ends(&["convert", &desk.word(word), "--to", "generalized-kelvin"], 0).0);
    let lines = |shown: &str| -> Vec<String> {
        shown.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
    };
    assert_eq!(lines(&whole), lines(&named));
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    let said = ends(&["convert", &desk.word("scene.toml"), "--to", "prony"], 2).1;
    assert!(said.contains("there are several models here"), "{said}");
    assert!(said.contains("name one of: foam, mount, padding, valox-pad"), "{said}");
}

#[test]
fn the_response_of_a_network_becomes_a_model() {
    let bridge = "[nodes]\ntop = {}\nleft = {}\nright = {}\n[elements]\n\
        a = { between = [\"top\", \"left\"], spring = 1e6 }\n\
        b = { between = [\"left\", \"ground\"], dashpot = 3e3 }\n\
        c = { between = [\"top\", \"right\"], dashpot = 2e3 }\n\
        d = { between = [\"right\", \"ground\"], spring = 5e6 }\n\
        e = { between = [\"left\", \"right\"], spring = 4e6 }\n";
    let desk = Desk::with(&[("bridge.toml", bridge), ("scene.toml", SCENE)]);
    let word = desk.word("bridge.toml:top,ground");
    let path = desk.path("response.toml");
    for form in ["generalized-maxwell", "generalized-kelvin"] {
        ends(&["convert", &word, "--to", form, "--out", text(&path), "--force"], 0);
        ends(&["compare", &word, &format!("{}:response", text(&path))], 0);
    }
    // At low rates the bridge is 1e6, 4e6 and 5e6 N/m in series, c beside and b off: it bears
    // a constant load as a spring.
    let text = fs::read_to_string(&path).unwrap();
    let model = read_named_model(&text, "response", &ReadOptions::default()).unwrap().value.model;
    let stiffness = dashpot::network::linear_model(&model).equilibrium_stiffness();
    let expected = (1e-6_f64 + 0.25e-6 + 0.2e-6).recip();
    assert!((stiffness / expected - 1.0).abs() < 1e-14, "{stiffness}");
    let said = ends(&["convert", &desk.word("scene.toml:head,ground"), "--to", "prony"], 2).1;
    assert!(said.contains("has masses that move"), "{said}");
    let said = ends(&["convert", &desk.word("scene.toml:head,gruond"), "--to", "prony"], 2).1;
    assert!(
        said.contains("there is no node `gruond`; the nodes are ground, head, panel"),
        "{said}"
    );
}

#[test]
fn misspelt_names_are_told_with_the_right_ones() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    for (word, expected) in [
        ("scene.toml:valox-pda", "did you mean `valox-pad`?"),
        ("scene.toml:fom", "did you mean `foam`?"),
        ("scene.toml:paddin", "did you mean `padding`?"),
        ("scnee.toml:padding", "there is no such file"),
    ] {
        let (shown, said) = ends(&["convert", &desk.word(word), "--to", "prony"], 2);
        assert!(shown.is_empty() && said.contains(expected), "{word}: {said}");
    }
    let (_, said) = ends(&["convert", "refrence:padding", "--to", "prony"], 2);
    assert!(said.contains("`refrence` cannot be read: there is no such file"), "{said}");
}

#[test]
fn values_set_from_outside_are_those_of_the_new_model() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    let word = desk.word("scene.toml:valox-pad");
    let arguments = ["convert", &word, "--to", "burgers", "--set", "K = 25 MN/m"];
    let shown = ends(&arguments, 0).0;
    assert!(shown.contains("K = \"20 MN/m\""), "{shown}");
    let found = read_named_model(&shown, "valox-pad", &ReadOptions::default()).unwrap().value.model;
    for (found, expected) in constants(&found.parts()).iter().zip([25e6, 6e3, 2e7, 4e3]) {
        assert!((found / expected - 1.0).abs() < 1e-15, "{found} for {expected}");
    }
    let said = ends(&["convert", &word, "--to", "burgers", "--set", "Q = 25 MN/m"], 2).1;
    assert!(said.contains("there is no value named `Q`"), "{said}");
}

#[test]
fn the_error_of_the_round_trip_is_a_few_roundings() {
    for form in ["generalized-maxwell", "generalized-kelvin", "burgers"] {
        let (shown, said) = ends(&["convert", "reference:padding", "--to", form], 0);
        let note = said.lines().find(|line| line.contains("round trip")).unwrap();
        let text = note.trim_start_matches("note: ");
        let is_said = |line: &str| line.starts_with("# ") && line.contains(text);
        assert!(shown.lines().any(is_said), "{shown}");
        let percent = match text.split_once("within ") {
            Some((_, rest)) => rest.split_once(" %").unwrap().0.parse::<f64>().unwrap(),
            None => 0.0,
        };
        assert!(percent < 100.0 * 10.0 * f64::EPSILON, "{note}");
    }
}

#[test]
fn converting_again_changes_nothing_but_the_last_digits() {
    let desk = Desk::with(&[("scene.toml", SCENE)]);
    for form in ["generalized-maxwell", "generalized-kelvin", "burgers"] {
        let mut word = desk.word("scene.toml:valox-pad");
        let mut seen: Vec<(Vec<String>, Vec<f64>)> = Vec::new();
        for round in 0..3 {
            let path = desk.path(&format!("{form}-{round}.toml"));
            ends(&["convert", &word, "--to", form, "--out", text(&path)], 0);
            let content = fs::read_to_string(&path).unwrap();
            assert_eq!(content.matches("round trip").count(), 1, "{content}");
            let found = read_named_model(&content, "valox-pad", &ReadOptions::default());
            let model = found.unwrap().value.model;
            let paths = model.parts().into_iter().map(|part| part.0).collect();
            seen.push((paths, constants(&model.parts())));
            word = format!("{}:valox-pad", text(&path));
        }
        for (paths, values) in &seen[1..] {
            assert_eq!(paths, &seen[0].0, "{form}");
            for (found, expected) in values.iter().zip(&seen[0].1) {
                let error = (found / expected - 1.0).abs();
                // Each constant is rounded twice, as a double and on the way to its unit.
                assert!(error <= 4.0 * f64::EPSILON, "{form}: {found} for {expected}");
            }
        }
    }
}

#[test]
fn a_fibre_of_many_modes_is_written_and_read_in_every_form() {
    let fibre = "[models.felt]\nseries = [{ spring = 2e7 }, { log-normal-fibre = { \
        compliance = \"5e-8 m/N\", time = \"0.2 ms\", width = 1.5, from = \"1 us\", to = \"1 s\" } }]\n";
    let desk = Desk::with(&[("fibre.toml", fibre)]);
    let word = desk.word("fibre.toml");
    for form in ["generalized-maxwell", "generalized-kelvin"] {
        let path = desk.path(&format!("{form}.toml"));
        let said = ends(&["convert", &word, "--to", form, "--out", text(&path)], 0).1;
        assert!(said.contains("Kelvin elements keep the creep within"), "{said}");
        ends(&["compare", &word, text(&path)], 0);
    }
}
