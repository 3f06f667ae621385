//! Records that are no good, by every way in: `signal`, `run --measured`, `fit` and a scene. Each is refused with its file and
//! what to do, or warned of; none gives a number without a word.

use std::fs;

use tempfile::TempDir;

use crate::cli::{code, err, out, run};

const SCENE: &str = "[values]\nK = \"100 kN/m\"\nC = \"200 N s/m\"\n[nodes]\n\
     head = { mass = \"4 kg\", velocity = \"2 m/s\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], kelvin-voigt = { spring = \"K\", dashpot = \"C\" } }\n\
     [effects]\nseparation.pad = { at = \"head\" }\n[run]\nduration = \"30 ms\"\n";

/// A half-sine of 50 g and 20 ms, 5 ms late, every so many ms until 40 ms.
fn pulse(step: f64, unit: &str, factor: f64) -> String {
    let count = (40.0 / step) as usize;
    let row = |at: usize| {
        let t = step * at as f64;
        let place = (t - 5.0) / 20.0;
        let own =
            if (0.0..=1.0).contains(&place) { (std::f64::consts::PI * place).sin() } else { 0.0 };
        format!("{t:.3},{:.4}\n", 50.0 * factor * own)
    };
    format!("t [ms],acc [{unit}]\n") + &(0..=count).map(row).collect::<String>()
}

struct Case {
    name: &'static str,
    record: String,
    /// What `signal`, `run --measured`, `fit` and a scene say: the exit code, and words of theirs.
    told: [(i32, &'static str); 4],
}

fn cases() -> Vec<Case> {
    let case = |name, record: &str, told| Case { name, record: record.to_owned(), told };
    let back = pulse(0.1, "g", 1.0).replace("\n20.000,", "\n2.000,");
    vec![
        case("empty", "", EMPTY),
        case("header alone", "t [ms],acc [g]\n", HEADER),
        case("one sample", "t [ms],acc [g]\n1.0,20.0\n", ONE),
        case("wrong unit", &pulse(0.1, "kN", 1.0), UNIT),
        case("no unit", &pulse(0.1, "g", 1.0).replace("acc [g]", "acc"), NO_UNIT),
        case("time running back", &back, BACK),
        case("all zero", &pulse(0.1, "g", 0.0), ZERO),
        case("not a number", &pulse(0.1, "g", 1.0).replace("\n20.000,", "\n20.000,NaN"), NAN),
    ]
}

const EMPTY: [(i32, &str); 4] = [
    (2, "no row of numbers"),
    (2, "no row of numbers"),
    (2, "no row of numbers"),
    (2, "no row of numbers"),
];
const HEADER: [(i32, &str); 4] = [
    (2, "there is no sample"),
    (2, "no row of numbers"),
    (2, "no row of numbers"),
    (2, "no row of numbers"),
];
const ONE: [(i32, &str); 4] = [
    (2, "there is one sample"),
    (2, "one row of numbers"),
    (2, "one row of numbers"),
    (0, "one point is a constant"),
];
const UNIT: [(i32, &str); 4] =
    [(0, "kN"), (2, "not an acceleration"), (2, "not an acceleration"), (2, "is a force (N)")];
const NO_UNIT: [(i32, &str); 4] = [
    (2, "without a unit"),
    (2, "has no unit"),
    (2, "has no unit"),
    (0, "does not say all its units"),
];
const BACK: [(i32, &str); 4] =
    [(2, "line 202"), (2, "line 202"), (2, "line 202"), (2, "own.csv:202")];
const ZERO: [(i32, &str); 4] = [
    (0, "nothing was measured"),
    (2, "other than zero"),
    (2, "zero throughout"),
    (0, "every value of the record is zero"),
];
const NAN: [(i32, &str); 4] =
    [(2, "line 202"), (2, "line 202"), (2, "line 202"), (2, "own.csv:202")];

/// The four ways in, for a record.
fn ways(folder: &TempDir, record: &str) -> [(i32, String); 4] {
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::write(folder.path().join("own.csv"), record).unwrap();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    let driven = "nodes.head = { mass = \"4 kg\", acceleration = { table = { file = \"own.csv\" } } }\n\
         measures.head = [\"hic15\"]\nrun.duration = \"40 ms\"\n";
    fs::write(folder.path().join("driven.toml"), driven).unwrap();
    let (csv, scene) = (at("own.csv"), at("scene.toml"));
    let beside = format!("{csv}:acc=head.acceleration");
    let each = [
        run(&["signal", &csv]),
        run(&["run", &scene, "--measured", &beside]),
        run(&["fit", &scene, "--vary", "K=10..1000 kN/m", "--to", &beside]),
        run(&["run", &at("driven.toml")]),
    ];
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    each.map(|own| (code(&own), words(out(&own) + &err(&own))))
}

#[test]
fn each_way_in_refuses_a_bad_record_or_says_what_is_odd() {
    let folder = TempDir::new().unwrap();
    for Case { name, record, told } in cases() {
        let words = ["signal", "run --measured", "fit", "a scene"];
        for ((way, (status, text)), (expected, word)) in
            words.into_iter().zip(ways(&folder, &record)).zip(told)
        {
            assert!(!text.contains("panicked"), "{name}, {way}: {text}");
            assert_eq!(status, expected, "{name}, {way}: {text}");
            assert!(text.contains(word), "{name}, {way}: no {word:?} in {text}");
        }
    }
}

#[test]
fn tests_of_two_rates_are_fitted_together_and_what_the_scene_cannot_do_is_told() {
    let folder = TempDir::new().unwrap();
    let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    fs::write(folder.path().join("scene.toml"), SCENE).unwrap();
    fs::write(folder.path().join("coarse.csv"), pulse(0.5, "g", 1.0)).unwrap();
    fs::write(folder.path().join("fine.csv"), pulse(0.05, "g", 1.0)).unwrap();
    fs::write(folder.path().join("high.csv"), pulse(0.1, "g", 100.0)).unwrap();
    let fit = |files: &[&str]| {
        let to = files
            .iter()
            .flat_map(|own| ["--to".to_owned(), format!("{}:acc=head.acceleration", at(own))]);
        let to: Vec<String> = to.collect();
        let scene = at("scene.toml");
        let words =
            ["fit", &scene, "--vary", "K=10..1000 kN/m", "--vary", "C=1..2000 N s/m", "--json"];
        let to = to.iter().map(String::as_str);
        run(&words.into_iter().chain(to).collect::<Vec<_>>())
    };
    let both = fit(&["coarse.csv", "fine.csv"]);
    assert_eq!(code(&both), 0, "{}", err(&both));
    let own: serde_json::Value = serde_json::from_slice(&both.stdout).unwrap();
    assert_eq!(own["tests"].as_array().unwrap().len(), 2);
    assert_eq!(own["tests"][1]["curve"]["time"].as_array().unwrap().len(), 801);
    // 5000 g for 20 ms of a mass at 2 m/s: no numbers within the bounds do that.
    let beyond = fit(&["high.csv"]);
    assert_eq!(code(&beyond), 0, "{}", err(&beyond));
    let said = err(&beyond).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("is missed by −97 %"), "{said}");
}
