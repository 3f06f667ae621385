//! What a record does not tell is said: a zero that nothing at rest tells, a body that does not stop, a second impact; and
//! what noise makes of its ends is not.

use std::{f64::consts::PI, fmt::Write as _};

use dashpot::units::STANDARD_GRAVITY;
use serde_json::Value;
use tempfile::TempDir;

use super::{number, write};
use crate::cli::{code, err, json, out, run};

/// Height \[g\] and length \[ms\] of the pulses.
const HEIGHT: f64 = 150.0;
const LENGTH: f64 = 6.003;

fn half_sine(time: f64) -> f64 {
    if (0.0..=LENGTH).contains(&time) { (PI * time / LENGTH).sin() } else { 0.0 }
}

/// A record at 20 kHz from one time to another \[ms\].
fn record((from, to): (f64, f64), value: &mut dyn FnMut(f64) -> f64) -> String {
    let mut text = "t [ms],acc [g]\n".to_owned();
    let mut at = 0.0;
    while from + 0.05 * at <= to {
        let time = from + 0.05 * at;
        writeln!(text, "{time:.2},{:.6}", value(time)).unwrap();
        at += 1.0;
    }
    text
}

/// A number that is about as normal as the sum of twelve even ones.
fn normal(state: &mut u64) -> f64 {
    let mut even = || {
        *state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 33) as f64 / (1_u64 << 31) as f64
    };
    (0..12).map(|_| even()).sum::<f64>() - 6.0
}

/// Codes and texts of the warnings about the only channel.
fn warnings(all: &Value) -> Vec<(String, String)> {
    let all = all["channels"][0]["warnings"].as_array().unwrap().iter();
    let text = |own: &Value| own.as_str().unwrap().to_owned();
    all.map(|own| (text(&own["code"]), text(&own["text"]))).collect()
}

fn has(all: &Value, code: &str) -> bool {
    warnings(all).iter().any(|own| own.0 == code)
}

fn measure<'v>(all: &'v Value, word: &str) -> &'v Value {
    &all["channels"][0]["measures"][format!("acc.{word}")]
}

#[test]
fn a_zero_that_only_the_rest_behind_tells_is_in_the_bars() {
    let folder = TempDir::new().unwrap();
    let touched = |off: f64| record((0.0, 40.0), &mut |time| HEIGHT * half_sine(time) - off);
    let path = write(&folder, "off.csv", &touched(3.0));
    let all = json(&["signal", &path, "--json"]);
    let (code_of, text) = &warnings(&all)[0];
    assert_eq!(code_of, "unknown-zero");
    assert!(text.contains("--offset \"-3") && text.contains("record some ms before"), "{text}");
    let [height, length] = [HEIGHT * STANDARD_GRAVITY, 1e-3 * LENGTH];
    for (word, truth) in [
        ("hic15", 0.414_645_65 * HEIGHT.powf(2.5) * length),
        ("severity-index", 0.457_655_86 * HEIGHT.powf(2.5) * length),
        ("peak", height),
        ("velocity-change", 2.0 / PI * height * length),
        ("clip-3ms", height * (0.5 * PI * (1.0 - 0.003 / length)).sin()),
        ("contact-time", length * (1.0 - 2.0 / PI * 0.05_f64.asin())),
    ] {
        let [value, error] = ["value", "error"].map(|own| number(&measure(&all, word)[own]));
        assert!((value - truth).abs() <= error, "{word}: {value} ± {error}, not {truth}");
    }
    let output = run(&["signal", &path, "--limit", "acc.hic15<=680", "--enforce"]);
    assert_eq!(code(&output), 4, "{}", out(&output));
    // Said, it is taken off; and where zero is read behind the pulse, nothing is said and bars stay tight.
    let all = json(&["signal", &path, "--offset", "-3 g", "--json"]);
    assert!(warnings(&all).is_empty(), "{:?}", warnings(&all));
    let all = json(&["signal", &write(&folder, "zero.csv", &touched(0.0)), "--json"]);
    assert!(!has(&all, "unknown-zero") && number(&measure(&all, "hic15")["error"]) < 2.0);
}

#[test]
fn a_body_that_does_not_stop_has_no_restitution() {
    let folder = TempDir::new().unwrap();
    let text = record((-10.0, 30.0), &mut |time| HEIGHT * half_sine(time));
    let path = write(&folder, "fast.csv", &text);
    let args = ["signal", &path, "--mass", "5 kg", "--velocity"];
    let all = json(&[&args[..], &["8 m/s", "--json"]].concat());
    let text = &warnings(&all).into_iter().find(|own| own.0 == "does-not-stop").unwrap().1;
    let [height, length] = [HEIGHT * STANDARD_GRAVITY, 1e-3 * LENGTH];
    let left = 8.0 - 2.0 / PI * height * length;
    assert!(text.contains(&format!("moves in at {left:.2} m/s when the pulse")), "{text}");
    let depth = measure(&all, "peak-displacement");
    assert_eq!(depth["bound"].as_str(), Some("at-least"));
    let at_end = 8.0 * length - height * length * length / PI;
    assert!(number(&depth["value"]) <= at_end && number(&depth["value"]) > 0.95 * at_end);
    assert_eq!(measure(&all, "energy-taken")["bound"].as_str(), Some("at-least"));
    for word in
        ["rebound-velocity", "coefficient-of-restitution", "energy-returned", "energy-absorbed"]
    {
        let own = measure(&all, word);
        assert!(own["value"].is_null(), "{word}: {own}");
        assert_eq!(own["note_code"].as_str(), Some("does-not-stop"), "{word}");
    }
    let limit = ["8 m/s", "--enforce", "--limit", "acc.coefficient-of-restitution<=0.5"];
    let output = run(&[&args[..], &limit].concat());
    assert_eq!(code(&output), 4);
    assert!(out(&output).contains("the body does not stop"), "{}", out(&output));
    // One that just stops, and one that comes back.
    for velocity in [8.0 - left, 4.0] {
        let velocity = format!("{velocity} m/s");
        let all = json(&[&args[..], &[&velocity, "--json"]].concat());
        assert!(!has(&all, "does-not-stop"), "{velocity}");
    }
}

#[test]
fn rest_is_before_the_first_of_two_impacts_and_the_second_one_is_told() {
    let folder = TempDir::new().unwrap();
    for (first, second, told) in [(150.0, 220.0, "of 150 g"), (220.0, 150.0, "of 150 g at 23")] {
        let text = record((-10.0, 40.0), &mut |time| {
            first * half_sine(time) + second * half_sine(time - 20.0) + 2.0
        });
        let path = write(&folder, "two.csv", &text);
        let output = run(&["signal", &path, "--offset", "auto", "--json"]);
        assert_eq!(code(&output), 0, "{}", err(&output));
        let all: Value = serde_json::from_str(&out(&output)).unwrap();
        let removed = number(&all["channels"][0]["removed"]);
        assert!((removed - 2.0 * STANDARD_GRAVITY).abs() < 1e-9, "{removed}");
        let found = warnings(&all);
        assert!(found.len() == 1 && found[0].0 == "second-impact", "{found:?}");
        assert!(found[0].1.contains(told), "{}", found[0].1);
    }
    // A small one before, a body that rings on its pad, and noise are none.
    for (is_one, value) in [
        (true, (|time| 25.0 * half_sine(time + 20.0) + 150.0 * half_sine(time)) as fn(f64) -> f64),
        (false, |time| if time < 0.0 { 0.0 } else { 100.0 * (-0.1 * time).exp() * time.sin() }),
        (false, |time| 12.0 * half_sine(time + 20.0) + 150.0 * half_sine(time)),
    ] {
        let path = write(&folder, "one.csv", &record((-40.0, 60.0), &mut |time| value(time)));
        let all = json(&["signal", &path, "--json"]);
        assert_eq!(has(&all, "second-impact"), is_one, "{:?}", warnings(&all));
        assert!(all["channels"][0]["offset"].is_object());
    }
}

#[test]
fn noise_at_the_ends_of_a_record_is_no_pulse_that_is_smeared() {
    let folder = TempDir::new().unwrap();
    let smeared = |span: (f64, f64), noise: f64, mut seed: u64| {
        let mut value = |time| HEIGHT * half_sine(time) + noise * normal(&mut seed);
        let path = write(&folder, "noisy.csv", &record(span, &mut value));
        let options = if span.0 < 0.0 { &["--offset", "auto"][..] } else { &[] };
        let args = [&["signal", &path, "--cfc", "1000", "--json"], options].concat();
        has(&json(&args), "smeared-beyond")
    };
    let all = (1..=40).filter(|seed| smeared((-30.0, 60.0), 0.4, 7919 * seed)).count();
    assert_eq!(all, 0, "of 40 records");
    for noise in [0.0, 0.4] {
        assert!(smeared((0.0, 60.0), noise, 1) && smeared((-30.0, 6.0), noise, 1), "{noise}");
    }
}

#[test]
fn a_rest_beneath_noise_tells_the_zero() {
    // Noise of 4 and 5 % of the peak, before a filter that leaves a tenth of it, on 20 ms of rest.
    let folder = TempDir::new().unwrap();
    for (seed, noise) in [(1, 0.04), (2, 0.05), (3, 0.04), (4, 0.05)] {
        let mut state = seed;
        let text = record((-20.0, 30.0), &mut |time| {
            HEIGHT * (half_sine(time) + noise * normal(&mut state)) - 5.0
        });
        let path = write(&folder, "noisy.csv", &text);
        let all = json(&["signal", &path, "--cfc", "180", "--json"]);
        assert!(has(&all, "offset"), "{all}");
        let all = json(&["signal", &path, "--cfc", "180", "--offset", "auto", "--json"]);
        let removed = number(&all["channels"][0]["removed"]) / STANDARD_GRAVITY;
        assert!((removed + 5.0).abs() < 4.0 * noise * HEIGHT / 20.0, "{removed} g");
    }
}

#[test]
fn a_zero_that_both_ends_are_off_from_is_in_the_bars() {
    // A millisecond at each end is too short for a rest.
    let folder = TempDir::new().unwrap();
    let truth = 0.414_645_65 * HEIGHT.powf(2.5) * 1e-3 * LENGTH;
    for off in [2.0, -3.0] {
        let mut state = 7;
        let text = record((-1.0, LENGTH + 1.0), &mut |time| {
            HEIGHT * half_sine(time) - off + 0.1 * normal(&mut state)
        });
        let path = write(&folder, "short.csv", &text);
        let all = json(&["signal", &path, "--json"]);
        assert!(has(&all, "unknown-zero"), "{all}");
        let own = measure(&all, "hic15");
        let (value, error) = (number(&own["value"]), number(&own["error"]));
        assert!((value - truth).abs() <= error && error < 0.1 * truth, "{value} ± {error}");
    }
    // What begins and ends with its pulse reads nothing there, and is as it was.
    let text = record((0.0, LENGTH), &mut |time| HEIGHT * half_sine(time));
    let all = json(&["signal", &write(&folder, "cut.csv", &text), "--json"]);
    assert!(!has(&all, "unknown-zero"), "{all}");
}

/// What a first-order high-pass of this time constant \[ms\] has taken off by a time \[ms\]: the integral of the pulse, each
/// part of which has decayed since, per time constant.
fn taken_off(time: f64, constant: f64) -> f64 {
    let rate = PI / LENGTH;
    let (inside, behind) = (time.clamp(0.0, LENGTH), (time - LENGTH).max(0.0));
    let forced = (rate * inside).sin() / constant - rate * (rate * inside).cos();
    let held = (forced + rate * (-inside / constant).exp()) / (constant.powi(-2) + rate * rate);
    held * (-behind / constant).exp() / constant
}

#[test]
fn a_sag_as_behind_a_high_pass_is_in_the_bars() {
    let folder = TempDir::new().unwrap();
    let truth = 0.414_645_65 * HEIGHT.powf(2.5) * 1e-3 * LENGTH;
    let mut state = 7;
    for constant in [100.0, 300.0, 1000.0] {
        let text = record((-40.0, 250.0), &mut |time| {
            HEIGHT * (half_sine(time) - taken_off(time, constant)) + 0.05 * normal(&mut state)
        });
        let path = write(&folder, "sag.csv", &text);
        let all = json(&["signal", &path, "--json"]);
        assert!(has(&all, "sag"), "{constant} ms: {:?}", warnings(&all));
        let [value, error] = ["value", "error"].map(|own| number(&measure(&all, "hic15")[own]));
        assert!((value - truth).abs() <= error, "{constant} ms: {value} ± {error}, not {truth}");
        let output = run(&["signal", &path, "--limit", &format!("acc.hic15<={}", truth - 1.0)]);
        assert!(!out(&output).contains("PASS"), "{constant} ms: {}", out(&output));
    }
    // A body that flies back freely, and one that lies still.
    for after in [-1.0, 0.0] {
        let text = record((-40.0, 250.0), &mut |time| {
            HEIGHT * half_sine(time)
                + if time > LENGTH { after } else { 0.0 }
                + 0.05 * normal(&mut state)
        });
        let all = json(&["signal", &write(&folder, "free.csv", &text), "--json"]);
        assert!(!has(&all, "sag"), "{after} g: {:?}", warnings(&all));
    }
}
