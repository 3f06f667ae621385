//! Scenes fitted to tests of all kinds at once: drops, curves without times, histories, oscillation; made of closed
//! forms.

use std::{f64::consts::TAU, fmt::Write as _};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// A Zener pad: its spring, and the spring and time of its branch.
const K: f64 = 30e3;
const K1: f64 = 60e3;
const TIME: f64 = 1.0 / 300.0;

const PAD: &str = "[values]\nK = \"60 kN/m\"\nK1 = \"60 kN/m\"\nC1 = \"400 N s/m\"\n[nodes]\n\
     head = { mass = \"4 kg\", velocity = \"2 m/s\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], zener = { spring = \"K\", maxwell = { spring = \"K1\", \
     dashpot = \"C1\" } } }\n[run]\nduration = \"60 ms\"\n";

const VARIED: [&str; 6] =
    ["--vary", "K=3..300 kN/m", "--vary", "K1=3..300 kN/m", "--vary", "C1=10..5000 N s/m"];

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap()
}

/// A part of ±1 that no model has.
fn noise(at: i32) -> f64 {
    let own = i64::from(at);
    ((own * own * 7919 + own * 10_729) % 201 - 100) as f64 / 100.0
}

fn grown(t: f64) -> f64 {
    if t > 0.0 { -(-t / TIME).exp_m1() } else { 0.0 }
}

/// Force over deformation at 0.5 m/s, to 12 mm and back, without times.
fn pressed() -> String {
    let mut rows = "way [mm],F [kN]\n".to_owned();
    let turn = 0.012 / 0.5;
    for at in 0..=120 {
        let t = turn * f64::from(at) / 60.0;
        let way = 0.5 * (turn - (t - turn).abs());
        let force = K * way + K1 * TIME * 0.5 * (grown(t) - 2.0 * grown(t - turn));
        writeln!(rows, "{},{:e}", 1e3 * way, 1e-3 * (force + 0.5 * noise(at))).unwrap();
    }
    rows
}

/// A deformation of 10 mm that is reached within 10 ms and held, and the force, by a clock that is 0.3 ms late.
fn held() -> String {
    let mut rows = "t [ms],way [mm],F [N]\n".to_owned();
    for at in 0..=120 {
        let t = 5e-4 * f64::from(at);
        let force = |t: f64| K * t.clamp(0.0, 0.01) + K1 * TIME * (grown(t) - grown(t - 0.01));
        let (way, force) = (t.min(0.01), force(t - 3e-4) + 0.5 * noise(at));
        writeln!(rows, "{},{},{force:e}", 1e3 * t, 1e3 * way).unwrap();
    }
    rows
}

/// A force of 300 N that is put on at once, and the deformation.
fn loaded() -> String {
    let mut rows = "t [ms],F [N],way [mm]\n".to_owned();
    let late = TIME * (K + K1) / K;
    for at in 0..=120 {
        let t = 5e-4 * f64::from(at);
        let way = 300.0 * (1.0 / K - K1 / (K * (K + K1)) * (-t / late).exp());
        writeln!(rows, "{},300,{:e}", 1e3 * t, 1e3 * (way + 2e-6 * noise(at))).unwrap();
    }
    rows
}

fn oscillation() -> String {
    let mut rows = "f [Hz],Ks [kN/m],Kl [kN/m]\n".to_owned();
    for at in 0..60 {
        let frequency = 10.0_f64.powf(0.05 * f64::from(at));
        let x = TAU * frequency * TIME;
        let whole = 1.0 + x * x;
        let own = [K + K1 * x * x / whole, K1 * x / whole];
        let own = own.map(|own| 1e-3 * own * (1.0 + 0.003 * noise(at)));
        writeln!(rows, "{frequency:e},{:e},{:e}", own[0], own[1]).unwrap();
    }
    rows
}

fn folder(files: &[(&str, &str)]) -> (TempDir, Vec<String>) {
    let folder = TempDir::new().unwrap();
    let paths = files.iter().map(|(name, own)| text(&file(&folder, name, own)).to_owned());
    let paths = paths.collect();
    (folder, paths)
}

fn words(told: &str) -> String {
    told.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The parameters hold what made the records, within this part.
fn is_found(answer: &Value, within: f64) {
    for (name, truth) in [("K", K), ("K1", K1), ("C1", K1 * TIME)] {
        let own = &answer["parameters"][name];
        assert!((number(&own["value"]) / truth - 1.0).abs() < within, "{name}: {own}");
        assert!(own["identified"].as_bool().unwrap(), "{name}: {own}");
    }
}

#[test]
fn each_kind_of_test_gives_back_the_pad_and_so_do_all_together() {
    let (_folder, paths) = folder(&[
        ("pad.toml", PAD),
        ("pressed.csv", &pressed()),
        ("held.csv", &held()),
        ("loaded.csv", &loaded()),
        ("dma.csv", &oscillation()),
    ]);
    let all = [
        (1, "F=pad,rate=0.5 m/s", &["pad.force"][..]),
        (2, "F=pad", &["pad.force"]),
        (3, "way=pad", &["pad.deformation"]),
        (4, "Ks,Kl=pad", &["pad.storage", "pad.loss"]),
    ];
    let to: Vec<String> = all.iter().map(|own| format!("{}:{}", paths[own.0], own.1)).collect();
    for (to, (_, _, outputs)) in to.iter().zip(all) {
        // A zero that is free takes what a force that is put on at once does at once.
        let is_free = outputs != ["pad.deformation"];
        let offset = if is_free { &[][..] } else { &["--offset", "off"] };
        let asked = [&["fit", &paths[0], "--to", to, "--json"], offset, &VARIED].concat();
        let answer = json(&asked);
        is_found(&answer, 0.02);
        let found: Vec<&str> = answer["tests"]
            .as_array()
            .unwrap()
            .iter()
            .map(|own| own["output"].as_str().unwrap())
            .collect();
        assert_eq!(found, outputs);
    }
    let mut asked = vec!["fit", &paths[0]];
    to.iter().for_each(|own| asked.extend(["--to", own]));
    asked.extend(VARIED);
    asked.push("--json");
    let answer = json(&asked);
    is_found(&answer, 0.01);
    let tests = answer["tests"].as_array().unwrap();
    assert_eq!(tests.len(), 5);
    assert!((number(&tests[1]["shift"]) - 3e-4).abs() < 2e-5, "{}", tests[1]["shift"]);
    // Moduli are told in parts of them, and of all tests how far they are off when they are left out.
    assert!(number(&tests[3]["rms"]) < 0.01 && tests[3]["unit"] == "1", "{}", tests[3]["rms"]);
    assert!(tests.iter().all(|own| number(&own["held_out"]).abs() < 0.02), "{answer}");
    assert!(number(&tests[3]["held_out_rms"]) < 0.02);
    asked.pop();
    let told = words(&out(&run(&asked)));
    assert!(told.contains("pad.storage") && told.contains("2 of 2 starts"), "{told}");
}

#[test]
fn a_law_that_is_not_linear_is_fitted_to_a_curve_and_has_no_modulus() {
    let scene = "[values]\nA = \"20 kN/m\"\n[nodes]\nhead = { mass = \"4 kg\", velocity = \"2 m/s\" }\n\
         [elements]\npad = { between = [\"head\", \"ground\"], cubic-spring = { stiffness = \"A\", \
         cubic = \"1e8 N/m^3\" } }\n[run]\nduration = \"60 ms\"\n";
    let mut rows = "way [mm],F [N]\n".to_owned();
    for at in 0..=80 {
        let way = 2.5e-4 * f64::from(40 - (at - 40i32).abs());
        let force = 12e3 * way + 4e8 * way.powi(3);
        writeln!(rows, "{},{:e}", 1e3 * way, force + 0.2 * noise(at)).unwrap();
    }
    let (_folder, paths) =
        folder(&[("pad.toml", scene), ("curve.csv", &rows), ("dma.csv", &oscillation())]);
    let to = format!("{}:F=pad,rate=10 mm/min", paths[1]);
    let varied = ["--vary", "A=1..100 kN/m", "--vary", "pad.cubic-spring.cubic=1e7..1e10 N/m^3"];
    let answer = json(&[&["fit", &paths[0], "--to", &to, "--json"][..], &varied].concat());
    let parameters = answer["parameters"].as_object().unwrap();
    for (own, truth) in parameters.values().zip([12e3, 4e8]) {
        assert!((number(&own["value"]) / truth - 1.0).abs() < 0.01, "{own}");
    }
    let to = format!("{}:Ks,Kl=pad", paths[2]);
    let told = run(&[&["fit", &paths[0], "--to", &to][..], &varied].concat());
    assert_eq!(code(&told), 2);
    let told = words(&err(&told));
    assert!(told.contains("`pad` has a cubic-spring, which has no storage"), "{told}");
}

#[test]
fn a_material_is_fitted_in_stress_and_strain_within_a_scene() {
    let scene = "[values]\nE = \"3 MPa\"\n[materials]\nfelt = { spring = \"E\" }\n[nodes]\n\
         head = { mass = \"4 kg\", velocity = \"2 m/s\" }\n[elements]\npad = { between = [\"head\", \
         \"ground\"], material = \"felt\", area = \"50 cm^2\", thickness = \"2 cm\" }\n\
         [run]\nduration = \"20 ms\"\n";
    let mut rows = "strain [%],stress [kPa]\n".to_owned();
    (0..40).for_each(|at| {
        let strain = 0.1 * f64::from(at);
        writeln!(rows, "{strain},{:e}", 20.0 * strain + 0.02 * noise(at)).unwrap();
    });
    let (_folder, paths) = folder(&[("pad.toml", scene), ("curve.csv", &rows)]);
    let to = format!("{}:stress=felt,rate=0.01 1/s", paths[1]);
    let asked = ["fit", &paths[0], "--to", &to, "--vary", "E=0.1..100 MPa", "--json"];
    let own = &json(&asked)["parameters"]["E"];
    assert!((number(&own["value"]) / 2e6 - 1.0).abs() < 0.01, "{own}");
    // Newtons are none of a material's, nor pascals those of a pad.
    let to = format!("{}:stress=pad,rate=0.01 1/s", paths[1]);
    let told = run(&["fit", &paths[0], "--to", &to, "--vary", "E=0.1..100 MPa"]);
    assert_eq!(code(&told), 2);
    assert!(words(&err(&told)).contains("`pad` is no material"), "{}", err(&told));
}

#[test]
fn what_a_test_of_a_model_alone_lacks_is_told() {
    let (_folder, paths) =
        folder(&[("pad.toml", PAD), ("pressed.csv", &pressed()), ("held.csv", &held())]);
    for (at, to, part) in [
        (1, "F=pad", "state how fast it was pressed"),
        (1, "F=pad,rate=10", "has no unit"),
        (1, "F=pad,rate=10 kg", "a velocity (m/s) is expected here"),
        (1, "F=pad,rate=-10 mm/s", "a rate is above zero"),
        (2, "F=pad,rate=10 mm/s", "it has times"),
        (2, "F=pad,cfc=180", "a class is that of a record of a run"),
        (2, "F=mount", "mount"),
        (1, "way=pad,rate=10 mm/s", "a force over a deformation"),
    ] {
        let to = format!("{}:{to}", paths[at]);
        let told = run(&["fit", &paths[0], "--to", &to, "--vary", "K=3..300 kN/m"]);
        assert_eq!(code(&told), 2, "{to}: {}", out(&told));
        let told = words(&err(&told));
        assert!(told.contains(part), "{to}: {told}");
    }
}

/// The force of 4 kg at 2 m/s on a spring of 30 kN/m and a dashpot of 150 N s/m in parallel, at 20 kHz: it jumps to
/// 300 N where the mass touches, 0.37 of a step before a sample.
#[test]
fn a_force_that_jumps_leaves_the_clock_open_between_two_samples() {
    let (mass, stiffness, damping, speed) = (4.0, 30e3, 150.0, 2.0);
    let rate: f64 = 0.5 * damping / mass;
    let omega = (stiffness / mass - rate * rate).sqrt();
    let mut rows = "t [ms],F [N]\n".to_owned();
    for at in 0..900 {
        let step = 5e-5;
        let t = step * f64::from(at) - (100.0 - 0.37) * step;
        let decayed = speed * (-rate * t).exp();
        let (way, own) = (
            decayed * (omega * t).sin() / omega,
            decayed * ((omega * t).cos() - rate / omega * (omega * t).sin()),
        );
        let force = if t < 0.0 { 0.0 } else { stiffness * way + damping * own };
        writeln!(rows, "{},{:e}", 1e3 * step * f64::from(at), force + 0.2 * noise(at)).unwrap();
    }
    let scene = "[values]\nK = \"60 kN/m\"\nC = \"50 N s/m\"\n[nodes]\n\
         head = { mass = \"4 kg\", velocity = \"2 m/s\" }\n[elements]\n\
         pad = { between = [\"head\", \"ground\"], parallel = [{ spring = \"K\" }, { dashpot = \"C\" }] }\n\
         [run]\nduration = \"60 ms\"\n";
    let (_folder, paths) = folder(&[("pad.toml", scene), ("drop.csv", &rows)]);
    let to = format!("{}:F=pad.force", paths[1]);
    let asked =
        ["fit", &paths[0], "--to", &to, "--vary", "K=3..300 kN/m", "--vary", "C=10..5000 N s/m"];
    let answer = json(&[&asked[..], &["--json"]].concat());
    for (name, truth) in [("K", stiffness), ("C", damping)] {
        let own = &answer["parameters"][name];
        assert!(number(&own["low"]) <= truth && truth <= number(&own["high"]), "{name}: {own}");
        assert!((number(&own["value"]) / truth - 1.0).abs() < 0.005, "{name}: {own}");
    }
    let test = &answer["tests"][0];
    assert!((number(&test["jump"]) / 300.0 - 1.0).abs() < 0.01, "{}", test["jump"]);
    assert!((number(&test["shift"]) - 99.63 * 5e-5).abs() < 3e-5, "{}", test["shift"]);
    let told = words(&out(&run(&asked)));
    assert!(told.contains("jumps by 300 N as the impact begins"), "{told}");
}

#[test]
fn a_form_is_chosen_by_what_it_makes_of_tests_that_were_left_out() {
    let (_folder, paths) =
        folder(&[("pad.toml", PAD), ("held.csv", &held()), ("pressed.csv", &pressed())]);
    let to = [format!("{}:F=pad", paths[1]), format!("{}:F=pad,rate=0.5 m/s", paths[2])];
    let among = "pad=spring,kelvin-voigt,maxwell,zener,prony";
    let written = format!("{}.toml", paths[0]);
    let asked =
        ["fit", &paths[0], "--to", &to[0], "--to", &to[1], "--among", among, "--starts", "1"];
    let answer = json(&[&asked[..], &["--json", "--out", &written]].concat());
    let own = &answer["among"];
    assert_eq!(own["by"], "held-out");
    let forms = own["forms"].as_array().unwrap();
    let verdicts: Vec<&str> = forms.iter().map(|own| own["verdict"].as_str().unwrap()).collect();
    assert_eq!(verdicts[..4], ["too-far", "too-far", "too-far", "chosen"], "{own}");
    assert_ne!(verdicts[4], "too-far", "{own}");
    let numbers: Vec<f64> = forms.iter().map(|own| number(&own["numbers"])).collect();
    assert_eq!(numbers, [1.0, 2.0, 2.0, 3.0, 5.0]);
    assert!(number(&forms[3]["held_out"]) < 0.01 && number(&forms[0]["held_out"]) > 0.05, "{own}");
    assert!(number(&forms[0]["information"]) > 100.0, "{own}");
    for (name, truth) in [("pad.k", K), ("pad.k1", K1), ("pad.c1", K1 * TIME)] {
        let own = &answer["parameters"][name];
        assert!((number(&own["value"]) / truth - 1.0).abs() < 0.01, "{name}: {own}");
    }
    // What is written is the scene with that form, and it is solved.
    let solved = json(&["run", &written, "--json"]);
    let peak = number(&solved["runs"][0]["measures"]["pad.peak-force"]["value"]);
    let told = number(&answer["measures"]["pad.peak-force"]["value"]);
    assert!((peak / told - 1.0).abs() < 1e-3, "{peak} {told}");
    // One test has no other: the error that is stated decides.
    let one = ["fit", &paths[0], "--to", &to[0], "--among", "zener,spring,prony", "--json"];
    let own = &json(&[&one[..], &["--error", "0.5%", "--starts", "1"]].concat())["among"];
    assert_eq!((&own["by"], &own["forms"][0]["verdict"]), (&"error".into(), &"chosen".into()));
    let told = run(&["fit", &paths[0], "--to", &to[0], "--among", "zener,foam"]);
    assert_eq!(code(&told), 2);
    assert!(words(&err(&told)).contains("there is no form `foam`"), "{}", err(&told));
}

#[test]
fn a_scene_says_how_it_is_fitted_and_the_command_stands_above_it() {
    let section = "[fit]\nto = [\"held.csv:F=pad\", \"pressed.csv:F=pad,rate=0.5 m/s\"]\n\
         vary = [\"K=3..300 kN/m\", \"K1=3..300 kN/m\", \"C1=10..5000 N s/m\"]\nprofile = true\n";
    let scene = format!("{PAD}{section}");
    let (folder, paths) =
        folder(&[("pad.toml", &scene), ("held.csv", &held()), ("pressed.csv", &pressed())]);
    let answer = json(&["fit", &paths[0], "--json"]);
    is_found(&answer, 0.01);
    assert_eq!(answer["tests"].as_array().unwrap().len(), 2);
    assert_eq!(answer["parameters"]["K"]["profiled"], true);
    let answer = json(&["fit", &paths[0], "--json", "--vary", "K=3..300 kN/m"]);
    assert_eq!(answer["parameters"].as_object().unwrap().len(), 1);
    // Other verbs leave the section alone, and a name that no option has is told.
    assert_eq!(code(&run(&["check", &paths[0]])), 0);
    let wrong = file(&folder, "wrong.toml", &scene.replace("profile", "profil"));
    let told = run(&["fit", text(&wrong)]);
    assert_eq!(code(&told), 2);
    assert!(words(&err(&told)).contains("`[fit]` has no such option"), "{}", err(&told));
    let bare = file(&folder, "bare.toml", PAD);
    for (more, part) in [(&["--vary", "K=1..9 kN/m"][..], "say to what is fitted"), (&[], "--to")] {
        let told = run(&[&["fit", text(&bare)][..], more].concat());
        assert_eq!(code(&told), 2);
        assert!(words(&err(&told)).contains(part), "{}", err(&told));
    }
    let to = format!("{}:F=pad", paths[1]);
    let told = run(&["fit", text(&bare), "--to", &to, "--cfc", "180"]);
    assert_eq!(code(&told), 2);
    assert!(words(&err(&told)).contains("it is for numbers of a scene"), "{}", err(&told));
}

#[test]
fn records_of_one_test_tell_their_noise_by_what_they_differ_by() {
    let shifted = |by: i32| {
        let rows = held();
        let mut lines = rows.lines();
        let head = lines.next().unwrap().to_owned() + "\n";
        lines.enumerate().fold(head, |text, (at, line)| {
            let (before, force) = line.rsplit_once(',').unwrap();
            let at = i32::try_from(at).unwrap();
            let force = force.parse::<f64>().unwrap() + 3.0 * noise(7 * at + 13 * by);
            text + &format!("{before},{force}\n")
        })
    };
    let files: Vec<String> = (1..4).map(shifted).collect();
    let (_folder, paths) = folder(&[
        ("pad.toml", PAD),
        ("a.csv", &files[0]),
        ("b.csv", &files[1]),
        ("c.csv", &files[2]),
        ("pressed.csv", &pressed()),
    ]);
    let mut asked = vec!["fit".to_owned(), paths[0].clone()];
    let tests = paths[1..4].iter().map(|own| format!("{own}:F=pad"));
    let tests = tests.chain([format!("{}:F=pad,rate=0.5 m/s", paths[4])]);
    tests.for_each(|own| asked.extend(["--to".to_owned(), own]));
    asked.extend(VARIED.map(str::to_owned));
    let mut asked: Vec<&str> = asked.iter().map(String::as_str).collect();
    asked.push("--json");
    let answer = json(&asked);
    is_found(&answer, 0.01);
    let scatter = &answer["tests"][1]["scatter"];
    // Even in ±3 N: 3/√3.
    assert!((number(&scatter["deviation"]) / 1.73 - 1.0).abs() < 0.2, "{scatter}");
    assert_eq!(scatter["records"], 3);
    assert!(answer["tests"][3]["scatter"].is_null());
    asked.pop();
    let told = words(&out(&run(&asked)));
    assert!(told.contains("3 records of `pad`"), "{told}");
}

#[test]
fn the_scatter_of_a_fit_makes_of_measures_what_its_covariance_does() {
    let (folder, paths) = folder(&[("pad.toml", PAD), ("pressed.csv", &pressed())]);
    let to = format!("{}:F=pad,rate=0.5 m/s", paths[1]);
    let (fitted, lines) = (folder.path().join("fitted.toml"), folder.path().join("plain.toml"));
    let asked = [&["fit", &paths[0], "--to", &to][..], &VARIED].concat();
    let answer = json(&[&asked[..], &["--scatter", "--out", text(&fitted), "--json"]].concat());
    let run_of = |path: &str| {
        json(&["run", path, "--sample", "2000", "--json"])["runs"][0]["scatter"].clone()
    };
    let deviation = |own: &Value, key: &str| number(&own["measures"][key]["deviation"]);
    let own = run_of(text(&fitted));
    // The same intervals, without what is known of the numbers together.
    let plain = std::fs::read_to_string(&fitted).unwrap();
    let mut plain = plain[..plain.find("\n# What the fit leaves open").unwrap()].to_owned();
    for (name, unit) in [("K", "N/m"), ("K1", "N/m"), ("C1", "N s/m")] {
        let [low, high, value] =
            ["low", "high", "value"].map(|key| number(&answer["parameters"][name][key]));
        let line =
            plain.lines().find(|own| own.starts_with(&format!("{name} = "))).unwrap().to_owned();
        let spread = (high - low) / 2.0 / 1.96;
        plain = plain.replacen(&line, &format!("{name} = \"{value} {unit} ± {spread} {unit}\""), 1);
    }
    std::fs::write(&lines, plain).unwrap();
    let alone = run_of(text(&lines));
    let mut most: f64 = 1.0;
    for key in ["pad.peak-force", "pad.peak-deformation", "head.peak-acceleration", "pad.energy"] {
        let [low, high] = ["low", "high"].map(|end| number(&answer["measures"][key][end]));
        // 1.96 standard deviations are half of the interval of so many rows, and 2000 designs tell one to 1.6 %.
        let known = (high - low) / 2.0 / 1.96;
        let [found, uncorrelated] = [&own, &alone].map(|own| deviation(own, key));
        println!("{key}: {found:e} {known:e}, of each by itself {uncorrelated:e}");
        assert!((found / known - 1.0).abs() < 0.06, "{key}: {found} {known}");
        most = most.max((uncorrelated / known).max(known / uncorrelated));
    }
    assert!(most > 1.3, "what is known together does not matter here: {most}");
    // A second section would be one too many, and what no test determines is not written.
    let twice = ["fit", text(&fitted), "--to", &to, "--scatter", "--vary", "K=3..300 kN/m"];
    let output = run(&twice);
    assert!(code(&output) == 2 && err(&output).contains("[scatter]"), "{}", err(&output));
}
