//! Pads that are composed of pads: each is looked at by itself, against the same pads as elements of
//! their own; measured laws beyond their points, and pads that pull without an impactor.

use dashpot::{
    analysis::{RunReport, Solve, undefined_measures},
    scene::{ReadOptions, Scene, read},
};

/// Bounds of two exact solutions together, with much to spare.
const SAME: f64 = 1e-8;

fn scene(text: &str) -> Scene {
    read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{text}\n{faults}")).value
}

fn run(text: &str) -> RunReport {
    let scene = scene(text);
    scene.network.solve_with(&scene.settings("auto").unwrap()).unwrap()
}

fn value(report: &RunReport, key: &str) -> f64 {
    report.measure(key).and_then(|own| own.value).unwrap_or_else(|| panic!("no {key}"))
}

fn warned(report: &RunReport, part: &str) -> bool {
    report.warnings.iter().any(|warning| warning.to_string().contains(part))
}

const MATERIALS: &str = r#"
[materials.stiff]
zener = { spring = "0.3 MPa", maxwell = { spring = "0.5 MPa", dashpot = "2 kPa s" } }
[materials.soft]
kelvin-voigt = { spring = "0.1 MPa", dashpot = "0.5 kPa s" }
[nodes]
parcel = { mass = "20 kg", velocity = "4 m/s" }
"#;
const TOP: &str = "material = \"stiff\", thickness = \"30 mm\", area = \"400 cm^2\"";
const BOTTOM: &str = "material = \"soft\", thickness = \"30 mm\", area = \"400 cm^2\"";
const RUN: &str = "[run]\nduration = \"60 ms\"\n";

#[test]
fn layers_in_series_are_pressed_as_elements_of_their_own() {
    let two = run(&format!(
        "{MATERIALS}middle = {{}}\n[elements]\n\
         top = {{ between = [\"parcel\", \"middle\"], {TOP} }}\n\
         bottom = {{ between = [\"middle\", \"ground\"], {BOTTOM} }}\n\
         [measures]\nbottom = [\"peak-strain\", \"peak-stress\"]\n{RUN}"
    ));
    assert!(warned(&two, "the bottom is pressed in by"), "{:?}", two.warnings);
    let models = format!("[models]\nwhole = {{ series = [{{ {TOP} }}, {{ {BOTTOM} }}] }}\n");
    let pair = format!("series = [{{ {TOP}, name = \"top\" }}, {{ {BOTTOM}, name = \"bottom\" }}]");
    let cases = [
        (pair.clone(), "bottom"),
        (format!("{pair}, thickness = \"60 mm\", area = \"400 cm^2\""), "bottom"),
        (format!("series = [{{ {TOP} }}, {{ parallel = [{{ {BOTTOM} }}] }}]"), "parallel.soft"),
        ("model = \"whole\"".to_owned(), "soft"),
        ("series = [{ model = \"whole\" }, { rigid = true }]".to_owned(), "whole.soft"),
    ];
    for (law, path) in cases {
        let one = run(&format!(
            "{models}{MATERIALS}[elements]\ncushion = {{ between = [\"parcel\", \"ground\"], {law} }}\n\
             [measures]\ncushion = [\"peak-strain\", \"peak-stress\"]\n{RUN}"
        ));
        for kind in ["peak-strain", "peak-stress"] {
            let (own, same) =
                (value(&one, &format!("cushion.{kind}")), value(&two, &format!("bottom.{kind}")));
            assert!((own - same).abs() <= SAME * same, "{law}: {kind} {own}, {same}");
        }
        let text = format!("the cushion.{path} is pressed in by");
        assert!(warned(&one, &text), "{law}: {:?}", one.warnings);
        assert!(!warned(&one, "the cushion is pressed in"), "{law}: {:?}", one.warnings);
    }
}

#[test]
fn pads_side_by_side_are_told_once() {
    let report = run(&format!(
        "{MATERIALS}[elements]\ncushion = {{ between = [\"parcel\", \"ground\"], \
         parallel = [{{ {BOTTOM} }}, {{ dashpot = 10 }}] }}\n[measures]\n\
         cushion = [\"peak-stress\"]\n{RUN}"
    ));
    let told =
        report.warnings.iter().filter(|warning| warning.to_string().contains("is pressed in by"));
    assert_eq!(told.count(), 1, "{:?}", report.warnings);
    assert!(value(&report, "cushion.peak-stress") > 0.0);
}

#[test]
fn sizes_around_pads_in_a_row_are_theirs_together() {
    let shown = |sizes: &str| {
        let text = format!(
            "{MATERIALS}[elements]\ncushion = {{ between = [\"parcel\", \"ground\"], \
             series = [{{ {TOP} }}, {{ {BOTTOM} }}]{sizes} }}\n{RUN}"
        );
        let checked = read(&text, &ReadOptions::default()).unwrap();
        let pad = &checked.value.network.connections()[0];
        (checked.warnings.render(false), pad.thickness, pad.area)
    };
    let (warnings, thickness, area) = shown("");
    assert_eq!((warnings.as_str(), area), ("", Some(0.04)));
    assert!(thickness.is_some_and(|thickness| (thickness - 0.06).abs() < 1e-15), "{thickness:?}");
    assert_eq!(shown(", thickness = \"60 mm\", area = \"400 cm^2\"").0, "");
    for (sizes, expected) in [
        (", thickness = \"70 mm\"", "is 70 mm, but its parts together have 60 mm"),
        (", thickness = \"50 mm\"", "is 50 mm, but its parts together have 60 mm"),
        (", area = \"600 cm^2\"", "is 0.06 m^2, but each of its parts has 0.04 m^2"),
    ] {
        let warnings = shown(sizes).0.replace('\n', " ");
        let words: Vec<&str> = warnings.split_whitespace().collect();
        assert!(words.join(" ").contains(expected), "{sizes}: {warnings}");
    }
}

#[test]
fn a_measured_law_beyond_its_last_point_is_told() {
    let text = |points: &str| {
        format!(
            "[nodes]\nhead = {{ mass = \"5 kg\", velocity = \"5 m/s\" }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], table-spring = [{points}] }}\n\
             [effects]\nseparation.pad = {{}}\n[run]\nduration = \"40 ms\"\n"
        )
    };
    // A straight line of 100 kN/m: it is pressed v √(m/k) deep, 35.4 mm.
    let line = run(&text("[0, 0], [\"20 mm\", \"2 kN\"]"));
    let told = "pad.table-spring is pressed 15.4 mm beyond the end of its law at 20.0 mm";
    assert!(warned(&line, told), "{:?}", line.warnings);
    let longer = run(&text("[0, 0], [\"40 mm\", \"4 kN\"]"));
    assert!(!warned(&longer, "of its law"), "{:?}", longer.warnings);
    let glued = run(&text("[0, 0], [\"40 mm\", \"4 kN\"]").replace("separation.pad = {}", ""));
    let told = "is stretched 35.4 mm beyond the beginning of its law at 0, at";
    assert!(warned(&glued, told), "{:?}", glued.warnings);
}

#[test]
fn without_an_impactor_what_lies_at_a_head_may_not_pull_unseen() {
    let text = |measure: &str| {
        format!(
            "[nodes]\nhead = {{ mass = \"5 kg\" }}\n\
             seat = {{ acceleration = {{ half-sine = {{ peak = \"100 g0\", duration = \"6 ms\" }} }} }}\n\
             [elements]\npad = {{ between = [\"seat\", \"head\"], \
             kelvin-voigt = {{ spring = \"100 kN/m\", dashpot = \"200 N s/m\" }} }}\n\
             [measures]\nhead = [\"{measure}\"]\n[run]\nduration = \"80 ms\"\n"
        )
    };
    assert!(warned(&run(&text("hic15")), "the pad is in tension: separation is off"));
    // What is not asked whom it hurts may be a mount.
    assert!(!warned(&run(&text("peak-displacement")), "pulls"));
}

#[test]
fn measures_that_can_have_no_value_are_known_before() {
    let text = "[nodes]\nhead = { mass = 5, velocity = 1 }\n[elements]\n\
                pad = { between = [\"head\", \"ground\"], spring = 1e4 }\n[measures]\n\
                ground = [\"hic15\"]\nhead = [\"hic15\"]\npad = [\"peak-stress\", \"peak-strain\"]\n\
                [run]\nduration = \"0.1 s\"\n";
    let scene = scene(text);
    let found = undefined_measures(&scene.assembly, &scene.settings("auto").unwrap()).unwrap();
    let mut keys: Vec<&str> = found.iter().map(|own| own.0.as_str()).collect();
    keys.sort_unstable();
    assert_eq!(keys, ["ground.hic15", "pad.peak-strain", "pad.peak-stress"]);
    let report = run(text);
    for measure in &report.measures {
        assert!(keys.contains(&measure.key.as_str()) == measure.value.is_none(), "{}", measure.key);
    }
}

#[test]
fn a_law_without_bound_followed_further_than_it_is_given_is_told() {
    // What stops 5 kg at 5 m/s within some 20 mm that the law has: 62.5 J against 811 k L²/2 and more.
    let text = |law: &str, speed: f64| {
        format!(
            "[nodes]\nhead = {{ mass = \"5 kg\", velocity = {speed} }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], {law} }}\n\
             [effects]\nseparation.pad = {{}}\n[run]\nduration = \"40 ms\"\n"
        )
    };
    let laws = [
        ("stiffening-spring = { stiffness = 2000, limit = 0.02 }", "at 20.0 mm"),
        (
            "foam = { modulus = \"100 kPa\", plateau = \"10 kPa\", densification = \"1 kPa\", \
             exponent = 2, thickness = \"20 mm\", area = \"10 cm^2\" }",
            "at 19.8 mm",
        ),
    ];
    for (law, place) in laws {
        let hard = run(&text(law, 50.0));
        let told = format!("beyond the end of its law {place}, at");
        assert!(warned(&hard, &told), "{law}: {:?}", hard.warnings);
        let soft = run(&text(law, 0.1));
        assert!(!warned(&soft, "of its law"), "{law}: {:?}", soft.warnings);
    }
}
