//! Claims of random studies against single runs: an optimum that a run beats, a verdict that a run contradicts, a sample
//! whose draws lie elsewhere. Scenes that do not exist for some values are among them.

use std::fmt::Write as _;

use dashpot::{
    analysis::{Judgement, RunReport, Solve},
    scene::{ReadOptions, read},
};
use serde_json::Value;
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, out, run, text},
    random_networks::Dice,
};

const G0: f64 = 9.806_65;
/// Of fewer studies no share with a claim is asked for.
const FEW: usize = 50;
/// Values that decide differ by more than this.
const NEAR: f64 = 1e-3;

/// A scene with one number `X` between bounds, in SI units.
struct Case {
    text: String,
    unit: &'static str,
    bounds: [f64; 2],
}

impl Case {
    fn draw(dice: &mut Dice) -> Self {
        let [mass, speed] = [2.0 + 6.0 * dice.unit(), 2.0 + 3.0 * dice.unit()];
        let area = format!("{:.1} cm^2", 40.0 + 100.0 * dice.unit());
        let foam = "foam = { modulus = \"2 MPa\", plateau = \"0.12 MPa\", densification = \"0.03 MPa\", exponent = 2";
        let spring = 20.0 * dice.decades(1.0);
        // Those that exist for one value alone, and round bodies that fit only up to a radius, are fewer.
        let kind = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 4, 6, 7, 5, 2][dice.below(16)];
        let (unit, bounds, models, pad): (&str, [f64; 2], String, String) = match kind {
            0 => ("N/m", [5e3, 5e5], String::new(), "kelvin-voigt = { spring = \"X\", dashpot = \"60 N s/m\" }".to_owned()),
            1 => ("N s/m", [5.0, 2e3], String::new(), format!("kelvin-voigt = {{ spring = \"{spring} kN/m\", dashpot = \"X\" }}")),
            2 => ("m", [0.008, 0.08], format!("[materials]\nfoam = {{ {foam} }} }}\n"),
                  format!("material = \"foam\", thickness = \"X\", area = \"{area}\"")),
            3 => ("m", [0.008, 0.08],
                  format!("[models]\neps = {{ {foam}.0, thickness = \"30 mm\", area = \"{area}\" }} }}\n"),
                  "parallel = [{ model = \"eps\" }, { dashpot = \"20 N s/m\" }], thickness = \"X\"".to_owned()),
            4 => ("m", [0.01, 0.12],
                  "[materials]\nfoam = { table-spring = [[0, 0], [0.3, 60e3], [0.5, 160e3], [0.7, 600e3]] }\n".to_owned(),
                  format!("material = \"foam\", thickness = \"X\", area = \"{area}\"")),
            5 => ("m", [0.02, 0.2], format!("[materials]\nfoam = {{ {foam} }} }}\n"),
                  "material = \"foam\", thickness = \"40 mm\", pressed-by = { shape = \"sphere\", radius = \"X\", pad-radius = \"-110 mm\" }".to_owned()),
            6 => ("N/m", [5e3, 5e5], String::new(), "spring = \"X\"".to_owned()),
            _ => ("N/m", [5e3, 5e5], String::new(), "maxwell = { spring = \"X\", dashpot = \"900 N s/m\" }".to_owned()),
        };
        let stop = if kind == 6 { "stop.pad = { at = \"20 mm\" }\n" } else { "" };
        // Some runs are too short for the softest of them.
        let duration = if dice.below(8) == 0 { 30 } else { 120 };
        let start = (bounds[0] * bounds[1]).sqrt();
        let start = if kind == 3 { 0.03 } else { start };
        let text = format!(
            "[values]\nX = \"{start:e} {unit}\"\n{models}[nodes]\nhead = {{ mass = \"{mass:.3} kg\", velocity = \"{speed:.3} m/s\" }}\n\
             [elements]\npad = {{ between = [\"head\", \"ground\"], {pad} }}\n[effects]\nseparation.pad = {{}}\n{stop}\
             [run]\nduration = \"{duration} ms\"\n"
        );
        Self { text, unit, bounds }
    }

    fn at(&self, share: f64) -> f64 {
        self.bounds[0] * (self.bounds[1] / self.bounds[0]).powf(share)
    }

    fn run(&self, x: f64, limits: &str) -> Option<RunReport> {
        let value = format!("{x:e} {}", self.unit);
        solved(&(self.text.clone() + limits), &[("X".to_owned(), value)])
    }

    fn range(&self) -> String {
        format!("X={:e}..{:e} {}", self.bounds[0], self.bounds[1], self.unit)
    }
}

fn solved(text: &str, set: &[(String, String)]) -> Option<RunReport> {
    let options = ReadOptions { set, ..ReadOptions::default() };
    let scene = read(text, &options).ok()?.value;
    let settings = scene.settings("auto").ok()?;
    scene.network.solve_with(&settings).ok()
}

/// Whether all limits are kept for certain, by nothing that is pressed beyond what is known of it.
fn keeps(own: &RunReport) -> bool {
    own.judged().iter().all(|own| own.judgement == Judgement::Pass)
        && own.beyond_known().next().is_none()
}

fn value(own: &RunReport, key: &str) -> Option<f64> {
    own.measure(key)?.value
}

/// What studies of one command came to.
#[derive(Default)]
struct Tally {
    studies: usize,
    claims: usize,
    wrong: String,
}

impl Tally {
    fn wrong(&mut self, what: &str, case: &str, told: &str) {
        write!(self.wrong, "--- {what}\n{case}\n{told}\n").unwrap();
    }

    fn hold(&self, command: &str) {
        assert!(self.wrong.is_empty(), "{command}:\n{}", self.wrong);
        assert!(
            self.studies < FEW || 4 * self.claims >= 3 * self.studies,
            "{command}: {} of {}",
            self.claims,
            self.studies
        );
    }
}

fn object(arguments: &[&str]) -> Option<Value> {
    let output = run(&[arguments, &["--json"]].concat());
    assert!(matches!(code(&output), 0 | 1 | 2 | 4), "{arguments:?}: {}", err(&output));
    serde_json::from_slice(&output.stdout).ok()
}

fn limit(dice: &mut Dice) -> f64 {
    (15.0 * 20f64.powf(dice.unit())).round()
}

fn designs(count: usize, seed: u64) {
    let mut dice = Dice(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let case = Case::draw(&mut dice);
        let limits = format!("[limits]\nhead.peak-acceleration = \"{} g\"\n", limit(&mut dice));
        let key = ["X", "head.peak-acceleration"][dice.below(2)];
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "scene.toml", &(case.text.clone() + &limits));
        let of = ["design", text(&path), "--vary", &case.range(), "--least", key, "--sample", "40"];
        tally.studies += 1;
        let Some(own) = object(&of) else { continue };
        if own["claimed"] != true {
            continue;
        }
        tally.claims += 1;
        let told = format!("{} {}", own["parameters"], own["aim"]);
        let aim = own["aim"].as_f64();
        let best = own["feasible"].as_bool().unwrap().then(|| aim.unwrap());
        if let Some(x) = own["parameters"]["X"]["value"].as_f64().filter(|_| best.is_some())
            && !case.run(x, &limits).is_some_and(|own| keeps(&own))
        {
            tally.wrong("the best does not keep everything", &case.text, &told);
        }
        for _ in 0..30 {
            let x = case.at(dice.unit());
            let Some(run) = case.run(x, &limits).filter(keeps) else { continue };
            let of_run = if key == "X" { Some(x) } else { value(&run, key) };
            let beats = of_run.is_some_and(|own| best.is_none_or(|best| own < best * (1.0 - NEAR)));
            if beats {
                tally.wrong(&format!("{x:e} is better: {of_run:?}\n{limits}"), &case.text, &told);
                break;
            }
        }
    }
    tally.hold("design");
}

fn sweeps(count: usize, seed: u64) {
    let mut dice = Dice(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let case = Case::draw(&mut dice);
        let most = limit(&mut dice);
        let limits = format!(
            "[limits]\nhead.peak-acceleration = \"{most} g\"\npad.contact-time = \"80 ms\"\n"
        );
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "scene.toml", &(case.text.clone() + &limits));
        // Those that do not exist at an end are swept where they do.
        let ends = [0.0, 1.0].map(|share| case.run(case.at(share), &limits).is_some());
        let bounds = if ends == [true, true] { case.bounds } else { [0.029, 0.031] };
        let points = 9;
        let vary = format!("X={:e}..{:e} {},{points},log", bounds[0], bounds[1], case.unit);
        tally.studies += 1;
        let Some(own) = object(&["sweep", text(&path), "--vary", &vary]) else { continue };
        let verdict = |limit: usize, point: usize| {
            own["limits"][limit]["verdicts"][point].as_str().unwrap_or("none").to_owned()
        };
        let all: Vec<[String; 2]> =
            (0..points).map(|at| [verdict(0, at), verdict(1, at)]).collect();
        tally.claims +=
            usize::from(all.iter().flatten().any(|own| own != "undecided" && own != "none"));
        for (point, told) in all.iter().enumerate() {
            let x = bounds[0] * (bounds[1] / bounds[0]).powf(point as f64 / (points - 1) as f64);
            let single = case.run(x, &limits);
            for (limit, told) in told.iter().enumerate() {
                let judged = single.as_ref().map(|own| own.judged()[limit].judgement.word());
                let is_wrong = match &told[..] {
                    "pass" => judged != Some("pass"),
                    "fail" => judged != Some("fail"),
                    _ => false,
                };
                if is_wrong {
                    let what =
                        format!("point {point}, {x:e}, limit {limit}: {told}, alone {judged:?}");
                    tally.wrong(&what, &(case.text.clone() + &limits), &vary);
                }
            }
        }
    }
    tally.hold("sweep");
}

/// A platen on a cushion.
struct Drop {
    law: String,
    height: f64,
    area: f64,
}

impl Drop {
    fn draw(dice: &mut Dice) -> Self {
        let law = match dice.below(3) {
            0 => format!("parallel = [{{ spring = \"{} kPa\" }}, {{ dashpot = \"{} Pa s\" }}]", 100.0 * dice.decades(1.0), 200.0 * dice.unit()),
            1 => "foam = { modulus = \"1 MPa\", plateau = \"60 kPa\", densification = \"15 kPa\", exponent = 2 }".to_owned(),
            _ => "table-spring = [[0, 0], [0.3, 50e3], [0.5, 120e3], [0.7, 500e3]]".to_owned(),
        };
        Self { law, height: 0.2 + 0.7 * dice.unit(), area: 0.01 + 0.05 * dice.unit() }
    }

    fn text(&self, thickness: f64, stress: f64, limits: &str) -> String {
        let Self { law, height, area } = self;
        let mass = stress * area / G0;
        format!(
            "[materials]\nfoam = {{ {law} }}\n[nodes]\nparcel = {{ mass = {mass:e}, drop = \"{height:e} m\" }}\n[elements]\n\
             pad = {{ between = [\"parcel\", \"ground\"], material = \"foam\", thickness = \"{thickness:e} m\", area = \"{area:e} m^2\" }}\n\
             [effects]\ngravity = {{}}\nseparation.pad = {{}}\n{limits}[run]\nduration = \"{} ms\"\n",
            1e3 * ((2.0 * height / G0).sqrt() + 10.0 * thickness / (2.0 * G0 * height).sqrt())
        )
    }
}

fn cushions(count: usize, seed: u64) {
    let mut dice = Dice(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let own = Drop::draw(&mut dice);
        let most = limit(&mut dice);
        let limits = format!("[limits]\nparcel.peak-acceleration = \"{most} g\"\n");
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "scene.toml", &own.text(0.04, 3e3, ""));
        let g = format!("{most} g");
        let over = dice.below(2) == 0;
        let mut of = vec![
            "cushion",
            text(&path),
            "--thickness",
            "20..60 mm,3",
            "--stress",
            "1..12 kPa,8,log",
            "--limit",
            &g,
        ];
        of.extend(if over { &["--over", "2..6 kPa"][..] } else { &[] });
        tally.studies += 1;
        let output = run(&of);
        let shown = out(&output);
        let mut label = shown.lines().filter_map(|own| own.split_whitespace().next());
        let label = label.find(|own| ["PASS", "FAIL", "NONE", "thinnest"].contains(own));
        let Some(label) = label.map(str::to_owned) else { continue };
        tally.claims += 1;
        let object = object(&of).unwrap();
        let keeps = |thickness: f64, stress: f64| {
            solved(&own.text(thickness, stress, &limits), &[]).is_some_and(|own| keeps(&own))
        };
        let case = own.text(0.04, 3e3, &limits);
        let stress = |low: f64, high: f64, share: f64| low * (high / low).powf(share);
        match &*label {
            "PASS" => {
                for curve in object["curves"].as_array().unwrap() {
                    let [low, high] = ["low", "high"].map(|own| curve["passing"][own].as_f64());
                    let (Some(low), Some(high)) = (low, high) else { continue };
                    let thickness = curve["thickness"].as_f64().unwrap();
                    let at = (0..4).map(|_| stress(low, high, 0.02 + 0.96 * dice.unit()));
                    for at in at.collect::<Vec<_>>() {
                        if !keeps(thickness, at) {
                            tally.wrong(
                                &format!("{thickness} m at {at} Pa does not keep it"),
                                &case,
                                &shown,
                            );
                        }
                    }
                }
            }
            "FAIL" => {
                for _ in 0..8 {
                    let at = stress(1e3, 12e3, dice.unit());
                    let thickness = [0.02, 0.04, 0.06][dice.below(3)];
                    if keeps(thickness, at) {
                        tally.wrong(&format!("{thickness} m at {at} Pa keeps it"), &case, &shown);
                    }
                }
            }
            "NONE" => {
                if (0..7).all(|at| keeps(0.06, stress(2e3, 6e3, f64::from(at) / 6.0))) {
                    tally.wrong("60 mm keep it", &case, &shown);
                }
            }
            _ => {
                let least = object["thinnest"][0]["thickness"].as_f64().unwrap();
                let all = |thickness: f64| {
                    (0..13).all(|at| keeps(thickness, stress(2e3, 6e3, f64::from(at) / 12.0)))
                };
                if !all(least * (1.0 + 1e-5)) {
                    tally.wrong("the thinnest does not keep it", &case, &shown);
                }
                if least > 0.0201 && all(0.97 * least) {
                    tally.wrong("a thinner one keeps it", &case, &shown);
                }
            }
        }
    }
    tally.hold("cushion");
}

/// A number of the standard normal distribution.
fn normal(dice: &mut Dice) -> f64 {
    (-2.0 * (1.0 - dice.unit()).ln()).sqrt() * (std::f64::consts::TAU * dice.unit()).cos()
}

fn scatters(count: usize, seed: u64) {
    const DRAWS: usize = 60;
    let mut dice = Dice(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let case = Case::draw(&mut dice);
        let (mean, part) = (case.at(0.2 + 0.6 * dice.unit()), 0.02 + 0.1 * dice.unit());
        let limits = format!("[limits]\nhead.peak-acceleration = \"{} g\"\n", limit(&mut dice));
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "scene.toml", &(case.text.clone() + &limits));
        let set = format!("X={mean:e} ± {:e} {}", part * mean, case.unit);
        tally.studies += 1;
        let Some(own) = object(&["run", text(&path), "--set", &set, "--sample", "300"]) else {
            continue;
        };
        let own = &own["runs"][0];
        let (verdict, band) =
            (&own["limits"][0]["verdict"], &own["scatter"]["measures"]["head.peak-acceleration"]);
        let told = format!("{set} {} {band}", own["limits"][0]);
        tally.claims += usize::from(verdict != "undecided" || band["low"].is_number());
        let draws = (0..DRAWS).map(|_| mean * (1.0 + part * normal(&mut dice)));
        let runs: Vec<Option<RunReport>> =
            draws.collect::<Vec<_>>().into_iter().map(|x| case.run(x, &limits)).collect();
        let kept = runs.iter().flatten().filter(|own| keeps(own)).count() as f64 / DRAWS as f64;
        // Three standard deviations of a share of so many draws, and of the sample.
        if verdict == "pass" && kept < 0.95 - 3.0 * (0.95_f64 * 0.05 / DRAWS as f64).sqrt() - 0.01 {
            tally.wrong(&format!("passes, but {kept} of draws do"), &case.text, &told);
        }
        if verdict == "fail" && case.run(mean, &limits).is_some_and(|own| keeps(&own)) {
            tally.wrong("the run at the means passes", &case.text, &told);
        }
        let values: Vec<f64> =
            runs.iter().flatten().filter_map(|own| value(own, "head.peak-acceleration")).collect();
        if let (Some(low), Some(high)) = (band["low"].as_f64(), band["high"].as_f64())
            && values.len() > DRAWS / 2
        {
            let room = 1e-6 * high.abs();
            let outside =
                values.iter().filter(|own| **own < low - room || **own > high + room).count();
            let most = 0.05 + 3.0 * (0.05_f64 * 0.95 / values.len() as f64).sqrt() + 0.02;
            if outside as f64 > most * values.len() as f64 {
                tally.wrong(
                    &format!("{outside} of {} outside of the band", values.len()),
                    &case.text,
                    &told,
                );
            }
        }
    }
    tally.hold("scatter");
}

/// The force of a mass on a spring and a dashpot from touch until it falls through zero, sampled with noise.
fn record(dice: &mut Dice, [mass, speed, stiffness, damping]: [f64; 4]) -> String {
    let (decay, omega) = (0.5 * damping / mass, (stiffness / mass).sqrt());
    let damped = (omega * omega - decay * decay).sqrt();
    let step = 1e-4;
    let force = |time: f64| {
        let (sin, cos) = (damped * time).sin_cos();
        let amplitude = speed / damped * (-decay * time).exp();
        stiffness * amplitude * sin + damping * amplitude * (damped * cos - decay * sin)
    };
    let most = speed * (stiffness * mass).sqrt();
    let mut rows = "time (s),force (N)\n".to_owned();
    let mut is_over = false;
    for at in 0..400 {
        let time = f64::from(at) * step;
        is_over |= force(time) < 0.0;
        let clean = if is_over { 0.0 } else { force(time) };
        writeln!(rows, "{time:e},{:e}", clean + 0.01 * most * normal(dice)).unwrap();
    }
    rows
}

fn fits(count: usize, seed: u64) {
    let mut dice = Dice(seed);
    let mut tally = Tally::default();
    for _ in 0..count {
        let right = [
            3.0 + 3.0 * dice.unit(),
            3.0 + 2.0 * dice.unit(),
            60e3 * dice.decades(0.6),
            60.0 * dice.decades(0.6),
        ];
        let [mass, speed, stiffness, damping] = right;
        let scene = format!(
            "[values]\nK = \"{:e} N/m\"\nC = \"{:e} N s/m\"\n[nodes]\nhead = {{ mass = {mass:e}, velocity = {speed:e} }}\n[elements]\n\
             pad = {{ between = [\"head\", \"ground\"], kelvin-voigt = {{ spring = \"K\", dashpot = \"C\" }} }}\n[effects]\n\
             separation.pad = {{}}\n[run]\nduration = \"60 ms\"\n",
            1.3 * stiffness,
            0.8 * damping
        );
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "scene.toml", &scene);
        let rows = file(&folder, "drop.csv", &record(&mut dice, right));
        let to = format!("{}:force=pad.force", text(&rows));
        let vary = ["--vary", "K=10..400 kN/m", "--vary", "C=5..500 N s/m"];
        tally.studies += 1;
        let Some(own) = object(&[&["fit", text(&path), "--to", &to][..], &vary].concat()) else {
            continue;
        };
        for (name, right) in [("K", stiffness), ("C", damping)] {
            let own = &own["parameters"][name];
            if own["identified"] != true {
                continue;
            }
            tally.claims += usize::from(name == "K");
            let [value, low, high] = ["value", "low", "high"].map(|key| own[key].as_f64());
            let (Some(value), Some(low), Some(high)) = (value, low, high) else { continue };
            // Four times an interval of 95 % is eight standard deviations.
            if (value - right).abs() > 2.0 * (high - low) {
                tally.wrong(&format!("{name} is {right}"), &scene, &own.to_string());
            }
        }
    }
    tally.hold("fit");
}

#[test]
fn claims_of_some_studies_are_those_of_single_runs() {
    designs(6, 1);
    sweeps(6, 2);
    cushions(4, 3);
    scatters(4, 4);
    fits(2, 5);
}

/// So many studies of each command; `CLAIMS` says how many.
fn count() -> usize {
    std::env::var("CLAIMS").ok().and_then(|own| own.parse().ok()).unwrap_or(200)
}

#[test]
#[ignore = "some minutes: 200 studies and 6000 single runs"]
fn full_designs() {
    designs(count(), 11);
}

#[test]
#[ignore = "some minutes: 200 studies and 1800 single runs"]
fn full_sweeps() {
    sweeps(count(), 12);
}

#[test]
#[ignore = "some minutes: 200 studies and some 1500 single runs"]
fn full_cushions() {
    cushions(count(), 13);
}

#[test]
#[ignore = "some minutes: 200 studies and 12000 single runs"]
fn full_scatter() {
    scatters(count(), 14);
}

#[test]
#[ignore = "some minutes: 200 fits"]
fn full_fits() {
    fits(count(), 15);
}
