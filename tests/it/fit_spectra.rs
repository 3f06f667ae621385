//! Spectra hold nothing beyond what their rows determine, and floors are lower bounds, by closed forms and by
//! `fit_floor_reference.py`.

use std::{fmt::Write as _, fs};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

fn relaxing(spring: f64, branches: &[(f64, f64)], t: f64) -> f64 {
    spring + branches.iter().map(|(time, own)| own * (-t / time).exp()).sum::<f64>()
}

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap()
}

/// Deviates between −1 and 1 that repeat.
fn shaken(at: u32) -> f64 {
    let own = f64::from(at.wrapping_mul(2_654_435_761) ^ (at << 7)) / f64::from(u32::MAX);
    2.0 * (own * 977.0).fract() - 1.0
}

struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    fn with(&self, name: &str, own: &str) -> String {
        text(&file(&self.0, name, own)).to_owned()
    }

    /// Exit code and all words of a fit.
    fn told(to: &str, rest: &[&str]) -> (i32, String) {
        let found = run(&[&["fit", "--to", to], rest].concat());
        let text = out(&found) + &err(&found);
        (code(&found), text.split_whitespace().collect::<Vec<_>>().join(" "))
    }

    fn fitted(to: &str, rest: &[&str]) -> Value {
        json(&[&["fit", "--to", to, "--json"], rest].concat())
    }
}

/// A solid of 200 kPa, 150 kPa at 50 ms and 100 kPa at 0.8 s, with 0.2 % of noise, from 13.9 ms on; the first row a
/// part too high.
fn late(too_high: f64) -> String {
    let mut rows = "Time [s],G [kPa]\n".to_owned();
    for at in 0..44_u32 {
        let t = 13.9e-3 * 10.0_f64.powf(f64::from(at) / 12.0);
        let noise = 1.0 + 0.002 * shaken(at) + if at == 0 { too_high } else { 0.0 };
        let modulus = relaxing(200.0, &[(0.05, 150.0), (0.8, 100.0)], t) * noise;
        writeln!(rows, "{t:.6},{modulus:.4}").unwrap();
    }
    rows
}

#[test]
fn a_first_row_that_is_off_makes_no_branch_and_is_reported() {
    let folder = Folder::new();
    let to = format!("{}:G=gel", folder.with("late.csv", &late(0.05)));
    let own = Folder::fitted(&to, &[]);
    let branches = own["branches"].as_array().unwrap();
    assert_eq!(branches.len(), 2, "{own}");
    for (branch, (time, strength)) in branches.iter().zip([(0.05, 150e3), (0.8, 100e3)]) {
        assert!((number(&branch["time"]) / time - 1.0).abs() < 0.05, "{branch}");
        assert!((number(&branch["strength"]) / strength - 1.0).abs() < 0.05, "{branch}");
    }
    assert!((number(&own["spring"]) / 200e3 - 1.0).abs() < 0.01, "{own}");
    let outliers = own["tests"][0]["outliers"].as_array().unwrap();
    assert!(outliers.len() == 1 && outliers[0]["line"] == 2, "{own}");
    assert!((number(&outliers[0]["off"]) - 0.05).abs() < 0.01, "{own}");
    let (status, words) = Folder::told(&to, &[]);
    assert!(status == 0 && words.starts_with("! "), "{words}");
    assert!(words.contains("line 2 is ") && words.contains("% above"), "{words}");
    // Counted with the others, it is a row of which no branch may make more than e times what it shows.
    let own = Folder::fitted(&to, &["--robust", "off"]);
    let all = own["branches"].as_array().unwrap().iter();
    assert!(all.clone().all(|own| number(&own["time"]) > 13.8e-3), "{own}");
    assert!(all.map(|own| number(&own["strength"])).sum::<f64>() < 400e3, "{own}");
    let (_, words) = Folder::told(&to, &["--robust", "off"]);
    assert!(!words.contains("within 1.0 % of every row"), "{words}");
    // Without an outlier nothing is left out, and every row is met.
    let to = format!("{}:G=gel", folder.with("good.csv", &late(0.0)));
    let (_, words) = Folder::told(&to, &[]);
    assert!(words.contains("within 1.0 % of every row") && !words.contains("line 2 is"), "{words}");
}

#[test]
fn a_gel_is_a_solid_where_that_is_known() {
    // 300 s of a branch of 2000 s beside one that is seen: whether it rests, the rows do not tell.
    let folder = Folder::new();
    let mut rows = "t [s],G [kPa]\n".to_owned();
    for at in 0..60_u32 {
        let t = 0.1 * 3000.0_f64.powf(f64::from(at) / 59.0);
        let modulus = relaxing(0.0, &[(3.0, 20.0), (2000.0, 50.0)], t);
        writeln!(rows, "{t:.6},{modulus:.6}").unwrap();
    }
    let to = format!("{}:G=gel", folder.with("gel.csv", &rows));
    let own = Folder::fitted(&to, &[]);
    let equilibrium = &own["parameters"]["equilibrium"];
    assert!(number(&equilibrium["low"]) < 1e3 && equilibrium["identified"] == false, "{own}");
    assert_eq!(own["tests"][0]["outliers"].as_array().unwrap().len(), 0, "{own}");
    let own = Folder::fitted(&to, &["--solid"]);
    let branches = own["branches"].as_array().unwrap();
    assert!(number(&own["spring"]) > 30e3, "{own}");
    assert!(branches.iter().all(|own| number(&own["time"]) <= 60.0 * (1.0 + 1e-9)), "{own}");
    let written = folder.0.path().join("gel.toml");
    let (status, words) = Folder::told(&to, &["--solid", "--out", text(&written)]);
    assert_eq!(status, 0, "{words}");
    let tested = run(&["rheometer", &format!("{}:gel", text(&written)), "--test", "relaxation"]);
    assert!(out(&tested).contains("a solid"), "{}", out(&tested));
    // What flows within the record is told to be a liquid, and is none by order.
    let mut rows = "t [s],G [kPa]\n".to_owned();
    for at in 0..60_u32 {
        let t = 0.1 * 300.0_f64.powf(f64::from(at) / 59.0);
        writeln!(rows, "{t:.6},{:.9e}", relaxing(0.0, &[(3.0, 20.0)], t)).unwrap();
    }
    let to = format!("{}:G=gel", folder.with("melt.csv", &rows));
    let (status, words) = Folder::told(&to, &[]);
    assert!(status == 0 && words.contains("`--solid`"), "{words}");
    let (status, words) = Folder::told(&to, &["--solid"]);
    assert!(status == 2 && words.contains("no solid"), "{words}");
}

#[test]
fn rows_of_several_temperatures_are_no_curve() {
    let folder = Folder::new();
    let rows = |step: f64| {
        let mut rows = "f [Hz],E' [MPa],E'' [MPa],Temperature [°C]\n".to_owned();
        for at in 0..30_u32 {
            let (part, x) = (f64::from(at / 10), 10.0_f64.powf(f64::from(at % 10) / 3.0 - 1.0));
            let (storage, loss) = (1.0 + x * x / (1.0 + x * x), x / (1.0 + x * x));
            writeln!(rows, "{x:.6},{storage:.6},{loss:.6},{:.2}", 20.0 + step * part).unwrap();
        }
        rows
    };
    let to = |name: &str, own: &str| format!("{}:E',E''=gel", folder.with(name, own));
    let (status, words) = Folder::told(&to("three.csv", &rows(20.0)), &[]);
    assert_eq!(status, 2, "{words}");
    assert!(words.contains("from 20.0 to 60.0 °C in column `Temperature`"), "{words}");
    let bare = rows(20.0).replace("Temperature [°C]", "Temp.");
    assert_eq!(Folder::told(&to("bare.csv", &bare), &[]).0, 2);
    let (status, words) = Folder::told(&to("one.csv", &rows(0.3)), &[]);
    assert_eq!(status, 0, "{words}");
}

/// A gel of 2, 3 and 1 megapascals, at 0.1 s and 1 s, over the angular frequency.
fn oscillating(heading: &str) -> String {
    let mut rows = format!("{heading},Storage Modulus [Pa],Loss Modulus [Pa]\n");
    for at in 0..25_u32 {
        let omega = 0.05 * 10.0_f64.powf(f64::from(at) / 6.0);
        let (mut storage, mut loss) = (2e6, 0.0);
        for (time, modulus) in [(0.1, 3e6), (1.0, 1e6)] {
            let x = omega * time;
            storage += modulus * x * x / (1.0 + x * x);
            loss += modulus * x / (1.0 + x * x);
        }
        writeln!(rows, "{omega:.6},{storage:.1},{loss:.1}").unwrap();
    }
    rows
}

#[test]
fn angular_frequencies_are_those_whatever_their_unit_is_called() {
    let folder = Folder::new();
    let to =
        |text: &str| format!("{}:Storage Modulus,Loss Modulus=gel", folder.with("sweep.csv", text));
    for heading in [
        "Angular Frequency [rad/s]",
        "Angular Frequency [1/s]",
        "Angular Frequency [s-1]",
        "angular frequency (s^-1)",
        "Ang. frequency (rad/sec)",
        "ω [1/s]",
        "w [rad/s]",
    ] {
        let own = Folder::fitted(&to(&oscillating(heading)), &[]);
        let branches = own["branches"].as_array().unwrap();
        assert_eq!(branches.len(), 2, "{heading}: {own}");
        for (branch, (time, strength)) in branches.iter().zip([(0.1, 3e6), (1.0, 1e6)]) {
            assert!((number(&branch["time"]) / time - 1.0).abs() < 1e-3, "{heading}: {branch}");
            assert!((number(&branch["strength"]) / strength - 1.0).abs() < 1e-3, "{heading}");
        }
    }
    // What may be either is asked about, with both readings.
    for heading in ["Frequency [1/s]", "f [s^-1]", "Angular frequency [Hz]"] {
        let (status, words) = Folder::told(&to(&oscillating(heading)), &[]);
        assert_eq!(status, 2, "{heading}: {words}");
        assert!(words.contains("[Hz]` or `") && words.contains("[rad/s]`"), "{heading}: {words}");
    }
    // Each column says its unit.
    let bare = oscillating("f [Hz]").replace("Loss Modulus [Pa]", "Loss Modulus");
    let (status, words) = Folder::told(&to(&bare), &[]);
    assert!(status == 2 && words.contains("column `Loss Modulus` has no unit"), "{words}");
    let unread = oscillating("f [furlong]");
    let (status, words) = Folder::told(&to(&unread), &[]);
    assert!(status == 2 && words.contains("furlong"), "{words}");
}

#[test]
fn what_does_not_apply_to_a_fit_is_rejected_by_name() {
    let folder = Folder::new();
    let to = format!("{}:G=gel", folder.with("late.csv", &late(0.0)));
    for (option, value) in [
        ("--set", "nosuch=1"),
        ("--offset", "off"),
        ("--starts", "5"),
        ("--seed", "1"),
        ("--padding", "odd"),
        ("--gain", "1%"),
        ("--cfc", "180"),
        ("--noise", "1 kPa"),
        ("--shift", "off"),
    ] {
        let (status, words) = Folder::told(&to, &[option, value]);
        assert!(status == 2 && words.contains(option), "{option}: {status} {words}");
    }
    let sweep = folder.with("sweep.csv", &oscillating("f [Hz]"));
    let sweep = format!("{sweep}:Storage Modulus,Loss Modulus=gel");
    let (status, words) = Folder::told(&sweep, &["--until", "1 s"]);
    assert!(status == 2 && words.contains("--until"), "{words}");
    for setting in ["until=1 s", "foo=3", "cfc=180", "noise=3 kPa", "gain=1%"] {
        let (status, words) = Folder::told(&format!("{to},{setting}"), &[]);
        let name = setting.split('=').next().unwrap();
        assert!(status == 2 && words.contains(&format!("`{name}`")), "{setting}: {words}");
    }
    let scene = folder.with(
        "pad.toml",
        "[values]\nK = \"90 kN/m\"\n[nodes]\nhead = { mass = \"4 kg\", velocity = \"3 m/s\" }\n[elements]\n\
         pad = { between = [\"head\", \"ground\"], spring = \"K\" }\n[run]\nduration = \"30 ms\"\n",
    );
    let mut drop = "t [ms],force [kN]\n".to_owned();
    for at in 0..300 {
        let (t, omega) = (1e-4 * f64::from(at), 150.0);
        writeln!(drop, "{},{:.6}", 1e3 * t, 1.8 * (omega * t).sin()).unwrap();
    }
    let to = format!("{}:force=pad.force", folder.with("drop.csv", &drop));
    for (option, value) in [("--error", "2%"), ("--padding", "even"), ("--solid", "")] {
        let rest = [scene.as_str(), "--vary", "K=10..1000 kN/m", option, value];
        let rest = if value.is_empty() { &rest[..4] } else { &rest[..] };
        let (status, words) = Folder::told(&to, rest);
        assert!(status == 2 && words.contains(option), "{option}: {words}");
    }
}

/// The records of the reference: file, what is fitted, what the nearest network leaves.
fn references(folder: &Folder) -> Vec<(String, String, f64)> {
    let text = fs::read_to_string("tests/it/fit_floor_reference.csv").unwrap();
    let mut all: Vec<(String, f64, String)> = Vec::new();
    for line in text.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let (kind, nearest) = (fields[0].to_owned(), fields[1].parse().unwrap());
        if all.last().is_none_or(|own| own.0 != kind) {
            let heading = match fields[0].split('-').next() {
                Some("relaxation") => "t [s],G [Pa]\n",
                Some("creep") => "t [s],J [1/Pa]\n",
                _ => "f [Hz],E' [Pa],E'' [Pa]\n",
            };
            all.push((kind, nearest, heading.to_owned()));
        }
        let rows = &mut all.last_mut().unwrap().2;
        writeln!(rows, "{}", fields[2..].join(",").trim_end_matches(',')).unwrap();
    }
    let to = |kind: &str| match kind.split('-').next() {
        Some("relaxation") => "G",
        Some("creep") => "J",
        _ => "E',E''",
    };
    let each = all.into_iter().map(|(kind, nearest, rows)| {
        let path = folder.with(&format!("{kind}.csv"), &rows);
        (format!("{path}:{}=felt", to(&kind)), kind, nearest)
    });
    each.collect()
}

#[test]
fn the_floor_lies_below_what_another_program_reaches_and_close_to_it() {
    let folder = Folder::new();
    let all = references(&folder);
    assert_eq!(all.len(), 9);
    let mut parts = Vec::new();
    for (to, kind, nearest) in all {
        let own = Folder::fitted(&to, &[]);
        let part = number(&own["floor"]) / nearest;
        assert!(
            part <= 1.0 + 1e-9 && number(&own["rms"]) >= nearest * (1.0 - 1e-9),
            "{kind}: {part}"
        );
        parts.push(part);
    }
    parts.sort_by(f64::total_cmp);
    assert!(parts[4] > 0.99, "{parts:?}");
}
