//! The fit of a scene finds the lowest minimum, its intervals hold the truth, and where it did not converge it claims
//! nothing. The whole campaign is `fit_reference.py`.

use std::fmt::Write as _;

use dashpot::numerics::Stream;
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, file, json, out, run, text};

/// Mass \[kg\], speed \[m/s\], spring \[N/m\], dashpot \[N s/m\] and rate of the recorder \[Hz\].
const MASS: f64 = 4.0;
const SPEED: f64 = 2.0;
const TRUTH: [f64; 2] = [30e3, 100.0];
const RATE: f64 = 20e3;

const SCENE: &str = "[values]\nK = \"60 kN/m\"\nC = \"150 N s/m\"\n[nodes]\nhead = { mass = \"4 kg\", velocity = \"2 m/s\" }\n\
     [elements]\npad = { between = [\"head\", \"ground\"], kelvin-voigt = { spring = \"K\", dashpot = \"C\" } }\n\
     [effects]\nseparation.pad = {}\n[run]\nduration = \"60 ms\"\n";

fn normal(stream: &mut Stream) -> f64 {
    let (one, other) = (1.0 - stream.share(), stream.share());
    (-2.0 * one.ln()).sqrt() * (std::f64::consts::TAU * other).cos()
}

/// The deceleration of a mass that meets the pad about so much later, until the pad would pull, in closed form:
/// `m ẍ + c ẋ + k x = 0`; with white noise \[m/s²\].
fn record(stream: &mut Stream, before: f64, noise: f64) -> String {
    let [spring, dashpot] = TRUTH;
    let rate = 0.5 * dashpot / MASS;
    let omega = (spring / MASS - rate * rate).sqrt();
    let release = (std::f64::consts::PI - 2.0 * (rate / omega).atan()) / omega;
    let late = before + stream.share() / RATE;
    let mut rows = "t [s],acc [m/s^2]\n".to_owned();
    let count = ((2.0 * before + release + 4e-3) * RATE) as usize;
    for at in 0..count {
        let time = at as f64 / RATE;
        let (sine, cosine) = (omega * (time - late)).sin_cos();
        let decayed = SPEED * (-rate * (time - late)).exp();
        let (way, speed) = (decayed * sine / omega, decayed * (cosine - rate / omega * sine));
        let is_touched = (0.0..=release).contains(&(time - late));
        let push = if is_touched { (spring * way + dashpot * speed) / MASS } else { 0.0 };
        writeln!(rows, "{time:.6},{:.5}", push + noise * normal(stream)).unwrap();
    }
    rows
}

fn fitted(rows: &str) -> Value {
    let folder = TempDir::new().unwrap();
    let (scene, record) = (file(&folder, "pad.toml", SCENE), file(&folder, "drop.csv", rows));
    let to = format!("{}:acc=head.acceleration", text(&record));
    let varied = ["--vary", "K=5..500 kN/m", "--vary", "C=10..5000 N s/m", "--json"];
    json(&[&["fit", text(&scene), "--to", &to][..], &varied].concat())
}

#[test]
fn a_pad_whose_force_jumps_is_found_from_twice_its_stiffness_however_long_the_record_rests() {
    let (mut stream, mut held) = (Stream::new(11), [0; 2]);
    let befores = [4e-3, 1e-3, 20e-3].into_iter().cycle();
    for before in befores.take(45) {
        let answer = fitted(&record(&mut stream, before, 1.0));
        assert_eq!(answer["converged"], true, "{before}");
        let rms = answer["tests"][0]["rms"].as_f64().unwrap();
        assert!(rms < 1.2, "{before}: {rms}");
        for (at, name) in ["K", "C"].into_iter().enumerate() {
            let own = &answer["parameters"][name];
            assert_eq!(own["identified"], true, "{own}");
            let [low, high] = ["low", "high"].map(|end| own[end].as_f64().unwrap());
            held[at] += i32::from((low..=high).contains(&TRUTH[at]));
            assert!((own["value"].as_f64().unwrap() / TRUTH[at] - 1.0).abs() < 0.05, "{own}");
        }
    }
    // 95 % of 45 is 42.75 with a standard deviation of 1.5.
    assert!(held.iter().all(|own| *own >= 39), "{held:?} of 45 hold the truth");
}

#[test]
fn what_did_not_converge_or_ended_on_a_bound_has_no_interval_and_is_not_identified() {
    let rows = record(&mut Stream::new(3), 4e-3, 1.0);
    let folder = TempDir::new().unwrap();
    let (scene, record) = (file(&folder, "pad.toml", SCENE), file(&folder, "drop.csv", &rows));
    let to = format!("{}:acc=head.acceleration", text(&record));
    let varied = ["--vary", "K=5..20 kN/m", "--vary", "C=10..5000 N s/m", "--starts", "1"];
    let asked = [&["fit", text(&scene), "--to", &to][..], &varied].concat();
    let bound = json(&[&asked[..], &["--json"]].concat());
    let parameters = &bound["parameters"];
    assert_eq!(parameters["K"]["on_bound"], true);
    assert!(parameters["K"]["low"].is_null() && parameters["K"]["high"].is_null(), "{parameters}");
    assert_eq!([&parameters["K"]["identified"], &parameters["C"]["identified"]], [false, false]);
    let told = run(&asked);
    assert_eq!(code(&told), 0);
    let words = out(&told).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("it has no interval"), "{words}");
    // Nor has anything a band that follows from such numbers.
    let (_, measures) = words.split_once("The fitted scene").unwrap();
    assert!(measures.contains("a number is on its bound") && !measures.contains('±'), "{words}");
    let own = &bound["measures"]["pad.peak-force"];
    assert!(own["value"].is_f64() && own["low"].is_null() && own["high"].is_null(), "{own}");
    assert_eq!([&own["no_band"], &own["curved"]], [&Value::from("on-bound"), &false.into()]);
    let band = bound["tests"][0]["curve"]["band"].as_array().unwrap();
    assert!(!band.is_empty() && band.iter().all(Value::is_null));
    let scatter = run(&[&asked[..], &["--scatter"]].concat());
    let words = out(&scatter).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("no scatter is written: a number is on its bound"), "{words}");
}

#[test]
fn an_exact_record_tells_of_no_rounding() {
    let rows = record(&mut Stream::new(5), 4e-3, 0.0);
    let folder = TempDir::new().unwrap();
    let (scene, record) = (file(&folder, "pad.toml", SCENE), file(&folder, "drop.csv", &rows));
    let to = format!("{}:acc=head.acceleration", text(&record));
    let varied = ["--vary", "K=5..500 kN/m", "--vary", "C=10..5000 N s/m"];
    let told = run(&[&["fit", text(&scene), "--to", &to][..], &varied].concat());
    let words = out(&told).split_whitespace().collect::<Vec<_>>().join(" ");
    for word in ["curved", "far off", "what is left is", "±"] {
        assert!(!words.contains(word), "{word}: {words}");
    }
    // Indices are plain numbers and accelerations in g, as in runs; a band is less than what runs are solved to.
    let (_, measures) = words.split_once("head.peak-acceleration").unwrap();
    assert!(
        measures.contains(" g < ") && measures.contains("head.severity-index 14.36 < "),
        "{words}"
    );
}

/// A third of a step before the touch and no rest: its rows alone tell the noise.
#[test]
fn what_is_left_where_no_noise_is_known_is_judged_by_how_its_rows_follow_each_other() {
    let mut stream = Stream::new(8);
    let right = fitted(&record(&mut stream, 0.2e-3, 1.0));
    let test = |own: &Value| own["tests"][0].clone();
    assert!(test(&right)["noise_at_rest"].is_null() && test(&right)["structured"] == false);
    assert_eq!(right["parameters"]["K"]["identified"], true);
    // Bounds that do not hold the truth leave much that is no noise.
    let folder = TempDir::new().unwrap();
    let scene =
        SCENE.replace("kelvin-voigt = { spring = \"K\", dashpot = \"C\" }", "spring = \"K\"");
    let scene = file(&folder, "pad.toml", &scene.replace("C = \"150 N s/m\"\n", ""));
    let record = file(&folder, "drop.csv", &record(&mut stream, 0.2e-3, 1.0));
    let to = format!("{}:acc=head.acceleration", text(&record));
    let own = json(&["fit", text(&scene), "--to", &to, "--vary", "K=5..500 kN/m", "--json"]);
    assert_eq!([&test(&own)["structured"], &test(&own)["missed"]], [true, true], "{own}");
    assert_eq!(own["parameters"]["K"]["identified"], false);
    assert_eq!(own["measures"]["pad.peak-force"]["no_band"], "missed");
}

/// The deceleration of 5 kg that meet a spring of 60 kN/m beside a Maxwell element of 200 kN/m and 400 N s/m at 4 m/s, so many
/// tenths of a millisecond after the record begins, in g, with 0.4 g of noise.
fn on_three_numbers(stream: &mut Stream, rest: u32) -> String {
    let (mass, spring, branch, dashpot, step) = (5.0, 60e3, 200e3, 400.0, 1e-6);
    let (mut way, mut speed, mut relaxing) = (0.0, 4.0, 0.0);
    let mut rows = "time [ms],acc [g]\n".to_owned();
    for at in 0..500_u32 {
        let push = if at < rest { 0.0 } else { f64::max(spring * way + relaxing, 0.0) };
        let reading = push / mass / 9.80665 + 0.4 * normal(stream);
        writeln!(rows, "{:.1},{reading:.4}", 0.1 * f64::from(at)).unwrap();
        for _ in 0..if at < rest { 0 } else { 100 } {
            let push = f64::max(spring * way + relaxing, 0.0);
            speed -= step * push / mass;
            way += step * speed;
            relaxing += step * (branch * speed - branch / dashpot * relaxing);
        }
    }
    rows
}

/// The clock of a model that cannot follow the rise slides into it: what is left there is no noise before the impact.
#[test]
fn a_model_that_begins_too_late_takes_no_rise_for_noise() {
    let folder = TempDir::new().unwrap();
    let scene = SCENE.replace("4 kg", "5 kg").replace("2 m/s", "4 m/s");
    let scene = file(&folder, "kelvin.toml", &scene);
    for rest in [100, 20] {
        let record = on_three_numbers(&mut Stream::new(5), rest);
        let to = format!("{}:acc=head.acceleration", text(&file(&folder, "drop.csv", &record)));
        let varied = ["--vary", "K=5..500 kN/m", "--vary", "C=1..5000 N s/m", "--json"];
        let fit = json(&[&["fit", text(&scene), "--to", &to][..], &varied].concat());
        let noise = fit["tests"][0]["noise_at_rest"].as_f64().unwrap() / 9.80665;
        assert!((noise / 0.4 - 1.0).abs() < 0.5, "{noise} g");
        for name in ["K", "C"] {
            assert_eq!(fit["parameters"][name]["identified"].as_bool(), Some(false), "{fit}");
        }
    }
}

/// A drop with gravity, which the scene has not: the fitted zero makes up for it, against 360 rows that tell another one.
#[test]
fn a_zero_that_makes_up_for_a_wrong_model_is_no_noise() {
    let ([spring, dashpot], gravity, zero) = ([45e3, 220.0], 9.80665, 0.4 * 9.80665);
    let rate = 0.5 * dashpot / MASS;
    let omega = f64::sqrt(spring / MASS - rate * rate);
    let (mut stream, mut rows) = (Stream::new(3), "t [s],acc [m/s^2]\n".to_owned());
    let rest = MASS * gravity / spring;
    let mut is_left = false;
    for at in 0..1200 {
        let time = f64::from(at - 360) / RATE - 1.3e-5;
        let (sine, cosine) = (omega * time).sin_cos();
        let decayed = (-rate * time).exp();
        let turned = (SPEED - rate * rest) / omega;
        let way = rest + decayed * (turned * sine - rest * cosine);
        let speed = decayed
            * ((omega * turned + rate * rest) * cosine + (omega * rest - rate * turned) * sine);
        let push = (spring * way + dashpot * speed) / MASS;
        is_left |= time > 0.0 && push < 0.0;
        let push = if time < 0.0 || is_left { 0.0 } else { push };
        writeln!(rows, "{time:.7},{:.5}", zero + push + 0.2 * normal(&mut stream)).unwrap();
    }
    let fit = fitted(&rows);
    let noise = fit["tests"][0]["noise_at_rest"].as_f64().unwrap();
    assert!((noise / 0.2 - 1.0).abs() < 0.3, "{noise} m/s²");
    for name in ["K", "C"] {
        assert_eq!(fit["parameters"][name]["identified"].as_bool(), Some(false), "{fit}");
    }
}

#[test]
fn rows_that_read_nothing_contradict_a_zero_of_a_model_that_begins_before_them() {
    let mut rows = "t [s],acc [m/s^2]\n".to_owned();
    for at in 0..240 {
        let time = f64::from(at - 40) / RATE;
        let push = -100.0 - 100.0 * (std::f64::consts::PI * time / 20e-3).sin();
        writeln!(rows, "{time:.6},{:.4}", if time < 0.0 { 0.0 } else { push }).unwrap();
    }
    let fit = fitted(&rows);
    let test = &fit["tests"][0];
    assert!(test["shift"].as_f64().unwrap() < -2e-3, "{test}");
    assert_eq!(test["other_zero"]["rows"], 40, "{test}");
    assert_eq!(test["other_zero"]["median"].as_f64(), Some(0.0), "{test}");
}

#[test]
fn rows_of_a_record_that_begins_with_the_impact_contradict_no_zero() {
    // With a weak dashpot the force rises evenly: no row is at rest, and none far from the first one for a millisecond.
    let (spring, dashpot) = (TRUTH[0], 12.0);
    let rate = 0.5 * dashpot / MASS;
    let omega = (spring / MASS - rate * rate).sqrt();
    let mut stream = Stream::new(5);
    for _ in 0..12 {
        let (mut rows, mut is_left) = ("t [s],acc [m/s^2]\n".to_owned(), false);
        for at in 0..1200 {
            let time = f64::from(at) / RATE;
            let (sine, cosine) = (omega * time).sin_cos();
            let decayed = SPEED * (-rate * time).exp();
            let (way, speed) = (decayed * sine / omega, decayed * (cosine - rate / omega * sine));
            let push = (spring * way + dashpot * speed) / MASS;
            is_left |= push < 0.0;
            let push = if is_left { 0.0 } else { push };
            writeln!(rows, "{time:.6},{:.5}", push + 1.7 * normal(&mut stream)).unwrap();
        }
        let fit = fitted(&rows);
        assert!(fit["tests"][0]["other_zero"].is_null(), "{}", fit["tests"][0]);
        assert_eq!(fit["parameters"]["K"]["identified"], true, "{}", fit["parameters"]);
    }
}
