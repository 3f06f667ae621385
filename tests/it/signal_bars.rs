//! What `signal` says of motion and noise: closed forms as judges, each within its error bar, over many noisy repeats.

use std::{f64::consts::PI, fmt::Write as _};

use dashpot::{
    signal::{Analysis, Approach, Cfc, Channel, Measure, Removal, Settings, Truth},
    units::{Dimension, STANDARD_GRAVITY},
};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, run};

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

/// Value and error of a measure of the first channel.
fn measure(all: &Value, word: &str) -> (f64, f64) {
    let own = &all["channels"][0];
    let own = &own["measures"][format!("{}.{word}", own["name"].as_str().unwrap())];
    (number(&own["value"]), number(&own["error"]))
}

fn write(folder: &TempDir, text: &str) -> String {
    file(folder, "record.csv", text).to_str().unwrap().to_owned()
}

/// Speed of a body on which a half-sine of acceleration acts, and where it turns: `v = V − A (1 − cos ωt)/ω`,
/// `x = V t − A (t − sin(ωt)/ω)/ω`.
struct HalfSine {
    height: f64,
    length: f64,
    velocity: f64,
}

impl HalfSine {
    fn omega(&self) -> f64 {
        PI / self.length
    }

    fn depth(&self) -> f64 {
        let omega = self.omega();
        let turn = (1.0 - self.velocity * omega / self.height).acos() / omega;
        self.velocity * turn - self.height / omega * (turn - (omega * turn).sin() / omega)
    }

    fn rebound(&self) -> f64 {
        2.0 * self.height / self.omega() - self.velocity
    }

    fn value(&self, time: f64) -> f64 {
        let inside = (0.0..=self.length).contains(&time);
        if inside { self.height * (self.omega() * time).sin() } else { 0.0 }
    }
}

/// 100 g and 10 ms at 3.2 m/s, at 5 kHz.
const DROP: HalfSine = HalfSine { height: 100.0 * STANDARD_GRAVITY, length: 0.01, velocity: 3.2 };

/// A table of it from so long before it on \[ms\], with an offset \[g\].
fn table(before: f64, offset: f64, column: &str, unit: f64) -> String {
    let mut text = format!("t [ms],{column}\n");
    for at in 0..=((before + 20.0) * 5.0) as u32 {
        let time = f64::from(at) / 5.0 - before;
        let value = DROP.value(1e-3 * time) + offset * STANDARD_GRAVITY;
        writeln!(text, "{time:.1},{:.6}", value / unit).unwrap();
    }
    text
}

#[test]
fn a_motion_starts_at_contact_however_long_the_record_is_before() {
    let folder = TempDir::new().unwrap();
    for (before, offset) in [(0.0, 0.0), (10.0, 0.0), (10.0, 0.5), (200.0, 0.5), (200.0, -1.0)] {
        let path = write(&folder, &table(before, offset, "a [g]", STANDARD_GRAVITY));
        for auto in [false, true] {
            if auto && before == 0.0 {
                continue;
            }
            let mut args = vec!["signal", &path, "--velocity", "3.2 m/s", "--json"];
            args.extend(if auto { &["--offset", "auto"][..] } else { &[] });
            let all = json(&args);
            for (word, expected) in [
                ("peak-displacement", DROP.depth()),
                ("rebound-velocity", DROP.rebound()),
                ("coefficient-of-restitution", DROP.rebound() / 3.2),
            ] {
                let (value, error) = measure(&all, word);
                assert!(
                    (value - expected).abs() <= error && error < 0.2 * expected,
                    "{before} ms before, {offset} g, {auto}: {word} {value} ± {error}, not {expected}"
                );
            }
        }
    }
    // The error of an offset that stays is part of the bars of all that is read.
    let path = write(&folder, &table(10.0, 0.5, "a [g]", STANDARD_GRAVITY));
    let all = json(&["signal", &path, "--json"]);
    for (word, expected) in
        [("peak", DROP.height), ("velocity-change", 2.0 * DROP.height / DROP.omega())]
    {
        let (value, error) = measure(&all, word);
        assert!((value - expected).abs() <= error * (1.0 + 1e-9), "{word}: {value} ± {error}");
    }
}

#[test]
fn a_touch_that_is_stated_is_taken_and_one_outside_of_the_record_refused() {
    let folder = TempDir::new().unwrap();
    let path = write(&folder, &table(10.0, 0.0, "a [g]", STANDARD_GRAVITY));
    let at =
        |touch: &str| json(&["signal", &path, "--velocity", "3.2 m/s", "--touch", touch, "--json"]);
    let (depth, error) = measure(&at("0 ms"), "peak-displacement");
    assert!((depth - DROP.depth()).abs() <= error && error < 0.02 * depth, "{depth} ± {error}");
    // 10 ms of free flight before are 32 mm.
    let (further, error) = measure(&at("-10 ms"), "peak-displacement");
    assert!((further - DROP.depth() - 0.032).abs() <= error + 1e-9, "{further} ± {error}");
    for wrong in ["-10.1 ms", "21 ms"] {
        let output = run(&["signal", &path, "--velocity", "3.2 m/s", "--touch", wrong]);
        assert_eq!(code(&output), 2, "{wrong}: {}", err(&output));
    }
}

#[test]
fn a_force_over_the_mass_is_the_acceleration_of_a_free_striker() {
    let folder = TempDir::new().unwrap();
    let force = write(&folder, &table(10.0, 0.0, "F [N]", 1.0 / 4.5));
    let motion = ["--velocity", "3.2 m/s", "--mass", "4.5 kg", "--json"];
    let of_force = json(&[&["signal", &force][..], &motion].concat());
    let acceleration = write(&folder, &table(10.0, 0.0, "a [m/s^2]", 1.0));
    let of_it = json(&[&["signal", &acceleration][..], &motion].concat());
    for word in ["peak-displacement", "rebound-velocity", "energy-taken", "energy-absorbed"] {
        let [(one, error), (other, _)] = [&of_force, &of_it].map(|own| measure(own, word));
        assert!(
            (one - other).abs() < 1e-6 * one.abs() + 1e-9 && error >= 0.0,
            "{word}: {one} {other}"
        );
    }
    let (taken, error) = measure(&of_force, "energy-taken");
    assert!((taken - 0.5 * 4.5 * 3.2 * 3.2).abs() <= error + 1e-9, "{taken} ± {error}");
}

#[test]
fn a_contact_ends_before_its_swing_back() {
    let folder = TempDir::new().unwrap();
    // A triangle of 100 g and 0.8 ms, and one of −75 g and 0.8 ms behind it: exactly, and in samples of which none lies
    // within 5 % of the peak where it swings back.
    for (count, step, first, widest) in [(401, 0.01, -1.0, 0.02e-3), (41, 0.1, -0.95, 0.08e-3)] {
        let mut text = "t [ms],a [g]\n".to_owned();
        for at in 0..count {
            let time = f64::from(at) * step + first;
            let triangle = |start: f64| (1.0 - ((time - start) / 0.4 - 1.0).abs()).max(0.0);
            let value = 100.0 * triangle(0.0) - 75.0 * triangle(0.8);
            writeln!(text, "{time:.2},{value:.6}").unwrap();
        }
        let all = json(&["signal", &write(&folder, &text), "--json"]);
        let (value, error) = measure(&all, "contact-time");
        let is_right = (value - 0.76e-3).abs() <= error && error < widest;
        assert!(is_right, "{step} ms: {value} ± {error}");
    }
}

/// What each measure of the drop is.
fn closed_forms() -> [(Measure, f64); 14] {
    let unit = 100.0_f64.powf(2.5) * DROP.length;
    let half = |share: f64| DROP.height * (PI * (0.5 - 0.5 * share)).sin();
    let of_energy = |speed: f64| 0.5 * 4.5 * speed * speed;
    [
        (Measure::Peak, DROP.height),
        (Measure::ContactTime, DROP.length * (1.0 - 2.0 * 0.05_f64.asin() / PI)),
        (Measure::VelocityChange, 2.0 * DROP.height / DROP.omega()),
        (Measure::Hic15, 0.414_645_65 * unit),
        (Measure::Hic36, 0.414_645_65 * unit),
        (Measure::SeverityIndex, 0.457_655_86 * unit),
        (Measure::Clip3ms, half(0.3)),
        (Measure::Clip3msAtOnce, half(0.3)),
        (Measure::Displacement, DROP.depth()),
        (Measure::ReboundVelocity, DROP.rebound()),
        (Measure::Restitution, DROP.rebound() / DROP.velocity),
        (Measure::EnergyTaken, of_energy(DROP.velocity)),
        (Measure::EnergyReturned, of_energy(DROP.rebound())),
        (Measure::EnergyAbsorbed, of_energy(DROP.velocity) - of_energy(DROP.rebound())),
    ]
}

#[test]
fn a_clipped_record_bounds_what_depends_on_what_is_missing() {
    for (sign, range) in [(1.0, 95.0), (1.0, 70.0), (-1.0, 70.0), (1.0, 40.0)] {
        let level = range * STANDARD_GRAVITY;
        let times: Vec<f64> = (0..=800).map(|at| 5e-5 * f64::from(at) - 0.01).collect();
        let values = times.iter().map(|time| sign * DROP.value(*time).min(level)).collect();
        let channel = Channel::new("a", Dimension::ACCELERATION, times, values).unwrap();
        let approach =
            Approach { velocity: DROP.velocity, mass: Some(4.5), gravity: 0.0, touch: None };
        let settings = Settings { approach: Some(approach), ..Settings::default() };
        let own = settings.analyse(channel).unwrap();
        for (measure, truth) in closed_forms() {
            let signed = if measure == Measure::VelocityChange { sign } else { 1.0 };
            let truth = signed * truth;
            let reading = own.reading(measure).unwrap();
            let word = measure.word();
            let rounding = 1e-9 * truth.abs();
            // What a clip at 3 ms exceeds is below the range, or is not; all energy is taken where the body turns.
            let depends = match measure {
                Measure::Clip3ms | Measure::Clip3msAtOnce => range < 89.0,
                Measure::EnergyTaken => false,
                _ => true,
            };
            assert_eq!(reading.truth != Truth::Within, depends, "{word} {range}");
            let Ok(value) = reading.value else { panic!("{word} {range}: {reading:?}") };
            let holds = match reading.truth {
                Truth::Within => (value - truth).abs() <= reading.error + rounding,
                Truth::AtLeast => value <= truth + rounding,
                Truth::AtMost => value >= truth - rounding,
            };
            assert!(holds, "{word} {range}: {reading:?}, not {truth}");
        }
        // The peak is what the sensor showed at least, and no more is known.
        let peak = own.reading(Measure::Peak).unwrap();
        assert!((peak.value.unwrap() / level - 1.0).abs() < 1e-9, "{peak:?}");
    }
}

#[test]
fn bounds_are_told_wherever_a_number_is() {
    let folder = TempDir::new().unwrap();
    // Axis z ends at 120.2 g; a resultant of what is left of it is no more than a bound either.
    let mut text = "t [ms],Head X [g],Head Y [g],Head Z [g]\n".to_owned();
    for at in 0..800 {
        let time = f64::from(at) * 0.05 - 10.0;
        let own = DROP.value(1e-3 * time) / DROP.height;
        let (x, y, z) = (40.0 * own, 30.0 * own, (200.0 * own).min(120.2));
        writeln!(text, "{time:.2},{x},{y},{z}").unwrap();
    }
    let path = write(&folder, &text);
    let results = folder.path().join("out");
    let results = results.to_str().unwrap();
    let args = ["signal", &path, "--out", results, "--limit", "Head.peak<=250 g"];
    let output = run(&args);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = words(&text);
    assert!(said.contains("Head resultant: its axis z is clipped at 120 g"), "{said}");
    assert!(said.contains("peak 120.2 at least g"), "{said}");
    let all = json(&["signal", &path, "--json", "--limit", "Head.peak<=250 g"]);
    let of = |name: &str, word: &str| {
        let all = all["channels"].as_array().unwrap().iter().find(|own| own["name"] == name);
        all.unwrap()["measures"][format!("{name}.{word}")].clone()
    };
    for (name, word, bound) in [
        ("Head X", "peak", None),
        ("Head Z", "peak", Some("at-least")),
        ("Head Z", "hic15", Some("at-least")),
        ("Head Z", "contact-time", Some("at-most")),
        ("Head resultant", "peak", Some("at-least")),
        ("Head resultant", "hic15", Some("at-least")),
        ("Head resultant", "severity-index", Some("at-least")),
    ] {
        let own = of(name, word);
        assert_eq!(own["bound"].as_str(), bound, "{name} {word}: {own}");
        assert_eq!(own["error"].is_null(), bound.is_some(), "{name} {word}: {own}");
    }
    let peak = number(&of("Head resultant", "peak")["value"]) / STANDARD_GRAVITY;
    // 40 and 30 g beside 120.2 g where z leaves its range: the largest of what is left.
    assert!(peak <= (50.0_f64.powi(2) + 120.2_f64.powi(2)).sqrt() + 1e-6 && peak > 120.2, "{peak}");
    let verdict = &all["limits"][0];
    assert_eq!(
        (verdict["verdict"].as_str(), verdict["reason"].as_str()),
        (Some("undecided"), Some("clipped"))
    );
    assert!(verdict["error"].is_null() && verdict["margin"].is_null(), "{verdict}");
    let table = std::fs::read_to_string(format!("{results}/measures.csv")).unwrap();
    let row = table.lines().find(|own| own.contains("Head Z.peak")).unwrap();
    assert!(row.ends_with("at-least") && row.contains(",,"), "{row}");
    let page = std::fs::read_to_string(format!("{results}/report.html")).unwrap();
    assert!(page.contains("at least") && page.contains("its axis z is clipped"));
}

/// A pulse that ends in a jump (MIL-STD-810, terminal-peak sawtooth), wherever its samples lie: how far it rises behind
/// the last one before the jump is not known.
#[test]
fn a_peak_beside_a_jump_has_an_error() {
    let folder = TempDir::new().unwrap();
    for phase in 0..10 {
        for scale in [100.0, -60.0] {
            let mut text = "t [ms],a [g]\n".to_owned();
            for at in 0..40 {
                let time = f64::from(at) - 10.0 + 0.1 * f64::from(phase);
                let value = if (0.0..=11.0).contains(&time) { scale * time / 11.0 } else { 0.0 };
                writeln!(text, "{at},{value:.6}").unwrap();
            }
            let all = json(&["signal", &write(&folder, &text), "--json"]);
            let (value, error) = measure(&all, "peak");
            let off = (value.abs() - scale.abs() * STANDARD_GRAVITY).abs();
            let step = scale.abs() * STANDARD_GRAVITY / 11.0;
            assert!(off <= error && error < 1.6 * step, "{phase} {scale}: {value} ± {error}");
        }
    }
}

/// Numbers that scatter as a normal one does: sums of twelve evenly distributed ones.
struct Random(u64);

impl Random {
    fn even(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.even()).sum::<f64>() - 6.0
    }
}

/// What is done with the record of a pulse.
#[derive(Debug, Clone, Copy)]
struct Record {
    /// The time that it holds before the pulse \[s\].
    before: f64,
    /// Sampling rate \[Hz\].
    rate: f64,
    /// Noise in parts of the peak, and how much of each sample's goes on in the next.
    noise: (f64, f64),
    cfc: Option<f64>,
    offset: f64,
}

impl Record {
    fn analysis(&self, seed: Option<u64>) -> Analysis {
        let mut random = Random(seed.unwrap_or_default());
        let (amplitude, share) = self.noise;
        let fresh = amplitude * DROP.height * (1.0 - share * share).sqrt();
        let (mut noise, mut at) = (0.0, 0.0);
        let (mut times, mut values) = (Vec::new(), Vec::new());
        while at <= (self.before + 0.03) * self.rate {
            let time = at / self.rate - self.before;
            noise = share * noise + fresh * random.normal();
            let noise = if seed.is_some() { noise } else { 0.0 };
            times.push(time);
            // The pulse begins between samples.
            values.push(DROP.value(time - 0.37 / self.rate) + noise + self.offset);
            at += 1.0;
        }
        let channel = Channel::new("a", Dimension::ACCELERATION, times, values).unwrap();
        let settings = Settings {
            offset: if self.offset == 0.0 { Removal::Nothing } else { Removal::Found },
            cfc: self.cfc.and_then(|own| Cfc::new(own).ok()),
            approach: Some(Approach {
                velocity: DROP.velocity,
                mass: Some(4.5),
                gravity: 0.0,
                touch: None,
            }),
            ..Settings::default()
        };
        settings.analyse(channel).unwrap()
    }
}

/// What a measure is in truth: of a filtered record what its filter makes of the pulse alone, at ten times the rate.
fn truths(record: &Record) -> Vec<(Measure, f64)> {
    // Those of differences are bounded by those of what they are made of.
    let is_plain =
        |own: &(Measure, f64)| !matches!(own.0, Measure::Restitution | Measure::EnergyAbsorbed);
    let closed: Vec<(Measure, f64)> = closed_forms().into_iter().filter(is_plain).collect();
    if record.cfc.is_none() {
        return closed;
    }
    // Nothing happens before it, whether the record tells that or begins with the pulse.
    let before = record.before.max(0.01);
    let fine = Record { rate: 10.0 * record.rate, offset: 0.0, before, ..*record }.analysis(None);
    // What becomes of the motion is told by where the contact begins, which a filter blurs.
    let of_pulse = |own: &&(Measure, f64)| !matches!(own.0, Measure::Displacement);
    let value = |own: &(Measure, f64)| (own.0, fine.reading(own.0).unwrap().value.unwrap());
    closed.iter().filter(of_pulse).map(value).collect()
}

/// How often the truth is within the error, of all measures, and the worst of them.
fn coverage(record: &Record, repeats: u64) -> Vec<(Measure, f64)> {
    let truths = truths(record);
    let mut inside = vec![0.0; truths.len()];
    for repeat in 0..repeats {
        let own = record.analysis(Some(7919 * (repeat + 1)));
        for (at, (measure, truth)) in truths.iter().enumerate() {
            let reading = own.reading(*measure).unwrap();
            let off = (reading.value.unwrap() - truth).abs();
            let rounding = 1e-12 * truth.abs();
            inside[at] += f64::from(u8::from(off <= reading.error * (1.0 + 1e-9) + rounding));
        }
    }
    let share = |(own, inside): (&(Measure, f64), f64)| (own.0, inside / repeats as f64);
    truths.iter().zip(inside).map(share).collect()
}

fn records() -> Vec<Record> {
    let mut all = Vec::new();
    for (rate, cfc) in [(20e3, None), (5e3, None), (20e3, Some(600.0)), (20e3, Some(180.0))] {
        for noise in [(1e-4, 0.0), (2e-3, 0.0), (2e-2, 0.0), (5e-3, 0.8)] {
            for (before, offset) in [(0.01, 0.0), (0.1, 5.0), (0.0, 0.0)] {
                if before > 0.0 || noise.1 == 0.0 {
                    all.push(Record { before, rate, noise, cfc, offset });
                }
            }
        }
    }
    all
}

/// Bars are those of one case in twenty. Of so many repeats no measure may be outside more often than that and chance.
#[expect(clippy::print_stdout, reason = "the log of the campaign")]
fn bars_hold(all: &[Record], repeats: u64) {
    let least = 0.95 - 2.6 * (0.95 * 0.05 / repeats as f64).sqrt();
    let (mut worst, mut smallest) = (Vec::new(), 1.0_f64);
    for record in all {
        for (measure, share) in coverage(record, repeats) {
            smallest = smallest.min(share);
            if share < least {
                worst.push(format!("{}: {share:.3} of {record:?}", measure.word()));
            }
        }
    }
    println!("smallest coverage of a measure: {smallest:.4}");
    assert!(worst.is_empty(), "below {least:.3}:\n{}", worst.join("\n"));
}

#[test]
fn bars_hold_the_truth_of_noisy_records() {
    let all = records();
    let some: Vec<Record> = all.iter().copied().skip(1).step_by(5).collect();
    bars_hold(&some, 40);
}

#[test]
#[ignore = "44 kinds of records with 400 repeats each take some minutes"]
fn bars_hold_the_truth_of_every_kind_of_noisy_record() {
    bars_hold(&records(), 400);
}

#[test]
fn bars_are_no_larger_than_noise_makes_them() {
    // Of 20 kHz with a noise of 0.2 %: what a line hides is below 0.1 %, a peak is off by four deviations at most.
    let own = Record { before: 0.01, rate: 20e3, noise: (2e-3, 0.0), cfc: None, offset: 0.0 };
    let own = own.analysis(Some(5));
    for (measure, most) in [
        (Measure::Peak, 0.02),
        (Measure::Hic15, 0.02),
        (Measure::SeverityIndex, 0.02),
        (Measure::Clip3ms, 0.02),
        (Measure::Displacement, 0.06),
    ] {
        let reading = own.reading(measure).unwrap();
        let relative = reading.error / reading.value.unwrap();
        assert!(relative < most, "{}: {relative}", measure.word());
    }
}
