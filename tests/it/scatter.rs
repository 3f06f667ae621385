//! Numbers with scatter: bands, and probabilities whose exact values are known.

use std::fs;

use dashpot::scene::{ReadOptions, ScatteredNumber, read};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run};

/// Mean and standard deviation of the stiffness \[N/m\].
const STIFFNESS: (f64, f64) = (25e3, 2.5e3);
/// Quantiles of the normal distribution: Abramowitz and Stegun, table 26.1.
const QUANTILES: [(f64, f64); 3] =
    [(0.5, 0.0), (0.841_344_746_068_543, 1.0), (0.975, 1.959_963_984_540_054)];

/// 4 kg at 5 m/s on a spring: the peak force is V √(K m).
fn peak(stiffness: f64) -> f64 {
    5.0 * (stiffness * 4.0).sqrt()
}

/// The peak force below which that of all designs with a stiffness of less than so many standard deviations from its
/// mean lies.
fn peak_at(deviations: f64) -> f64 {
    peak(STIFFNESS.0 + deviations * STIFFNESS.1)
}

fn scene(stiffness: &str, limits: &str) -> String {
    format!(
        "[values]\nK = \"{stiffness}\"\n[nodes]\nhead = {{ mass = \"4 kg\", velocity = \"5 m/s\" }}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], spring = \"K\" }}\n\
         [limits]\n{limits}\n[run]\nduration = \"100 ms\"\n"
    )
}

fn written(stiffness: &str, limits: &str) -> (TempDir, String) {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", &scene(stiffness, limits));
    let path = path.to_str().unwrap().to_owned();
    (folder, path)
}

fn of_run(path: &str, more: &[&str]) -> Value {
    json(&[&["run", path, "--json"], more].concat())["runs"][0].clone()
}

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

#[test]
fn a_limit_at_a_quantile_is_kept_with_its_probability() {
    for (share, deviations) in QUANTILES {
        let limit = format!("pad.peak-force = \"{} N\"", peak_at(deviations));
        let (_folder, path) = written("25 ± 2.5 kN/m", &limit);
        for count in ["100", "2000"] {
            let own = of_run(&path, &["--sample", count])["scatter"]["limits"][0].clone();
            // One design lies in each part of equal probability.
            let width = 1.0 / count.parse::<f64>().unwrap();
            let found = number(&own["probability"]);
            assert!((found - share).abs() <= width, "{found} of {share}: {own}");
            let [low, high] = [0, 1].map(|end| number(&own["range"][end]));
            assert!(low < share && share < high, "{own}");
        }
    }
}

#[test]
fn bands_are_the_quantiles_of_the_closed_form() {
    let (_folder, path) = written("25 kN/m ± 10 %", "");
    let run = of_run(&path, &["--sample", "4000"]);
    assert!((number(&run["measures"]["pad.peak-force"]["value"]) - peak(25e3)).abs() < 1e-9);
    let scatter = &run["scatter"];
    assert_eq!((&scatter["designs"], &scatter["unsolved"]), (&4000.into(), &0.into()));
    let source = &scatter["sources"][0];
    assert_eq!((&source["name"], &source["text"]), (&"K".into(), &"25 ± 2.5 kN/m".into()));
    assert!((number(&source["deviation"]) - 2500.0).abs() < 1e-9 && source["cut_below"].is_null());
    let band = &scatter["measures"]["pad.peak-force"];
    // The density of the outermost parts is lowest: a place within one of them moves the value by less than this.
    for (end, deviations) in [("low", -1.959_963_984_540_054), ("high", 1.959_963_984_540_054)] {
        let (found, right) = (number(&band[end]), peak_at(deviations));
        assert!((found / right - 1.0).abs() < 5e-4, "{end}: {found} {right}");
    }
    // With K = μ (1 + s z): the mean of √(1 + s z) is 1 − s²/8 − 15 s⁴/128 …, that of its square is 1.
    let s = 0.1_f64;
    let mean = 1.0 - s.powi(2) / 8.0 - 15.0 * s.powi(4) / 128.0;
    let deviation = (1.0 - mean * mean).sqrt();
    assert!((number(&band["mean"]) / peak(25e3) / mean - 1.0).abs() < 1e-5, "{band}");
    assert!((number(&band["deviation"]) / peak(25e3) / deviation - 1.0).abs() < 2e-3, "{band}");
}

#[test]
fn a_limit_on_the_mean_of_tests_is_judged_on_the_mean_of_the_sample() {
    // The mean of the peak forces is below the force of the mean: between both the verdicts differ.
    let s = 0.2_f64;
    let mean = peak(25e3) * (1.0 - s.powi(2) / 8.0 - 15.0 * s.powi(4) / 128.0);
    let limit = 0.5 * (mean + peak(25e3));
    let both = format!(
        "pad.peak-force = [{{ max = \"{limit} N\", mean = true }}, {{ max = \"{limit} N\" }}]"
    );
    let (_folder, path) = written("25 kN/m ± 20 %", &both);
    let more = ["--sample", "5000"];
    let found = of_run(&path, &more);
    let [of_mean, single] = [0, 1].map(|at| found["limits"][at].clone());
    assert_eq!((&of_mean["verdict"], &single["verdict"]), (&"pass".into(), &"fail".into()));
    let (value, error) = (number(&of_mean["value"]), number(&of_mean["error"]));
    assert!((value - mean).abs() < error + 1e-3 * mean && error > 0.0, "{of_mean}");
    assert!((number(&of_mean["margin"]) - (limit - value) / limit).abs() < 1e-12);
    let text = out(&run(&[&["run", &path], &more[..]].concat()));
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        text.contains("PASS pad.peak-force") && text.contains("judged by the mean of the sample")
    );
    assert!(
        text.contains("probability of a single design to pass")
            && text.contains("probability to pass")
    );
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_one_other_designs() {
    let (_folder, path) = written("25 +- 2.5 kN/m", "pad.peak-force = \"1.6 kN\"");
    let bytes = |seed: &str| out(&run(&["run", &path, "--json", "--sample", "60", "--seed", seed]));
    assert_eq!(bytes("1"), bytes("1"));
    assert_ne!(bytes("1"), bytes("2"));
}

#[test]
fn what_a_key_does_not_allow_is_cut_off_and_told() {
    let mass = ["--set", "head.mass=4 ± 2.4 kg", "--sample", "1000"];
    let (_folder, path) = written("25 kN/m", "pad.peak-force = \"2 kN\"");
    let found = of_run(&path, &mass);
    let source = &found["scatter"]["sources"][0];
    assert_eq!(source["cut_below"], 0.0, "{source}");
    // The normal distribution below −4/2.4 standard deviations.
    assert!((number(&source["beyond"]) - 0.047_790_352_27).abs() < 1e-9, "{source}");
    assert_eq!(found["scatter"]["unsolved"], 0);
    // 2 kN is the force of 6.4 kg, one standard deviation above the mean.
    let share = (0.841_344_746_068_543 - 0.047_790_352_27) / (1.0 - 0.047_790_352_27);
    let probability = number(&found["scatter"]["limits"][0]["probability"]);
    assert!((probability - share).abs() <= 1e-3, "{probability} {share}");
    let text = out(&run(&[&["run", &path], &mass[..]].concat()));
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let told = "head.mass is cut off below 0 kg, which the scene does not allow: 4.8 % of its distribution";
    assert!(text.contains(told), "{text}");
}

#[test]
fn a_scene_without_scatter_does_no_more_than_before() {
    let limit = "pad.peak-force = \"1.6 kN\"";
    let (_folder, plain) = written("25 kN/m", limit);
    let (_other, constant) = written("25 ± 0 kN/m", limit);
    let (_third, scattered) = written("25 ± 2 kN/m", limit);
    let runs = [&plain, &constant, &scattered].map(|path| of_run(path, &[]));
    assert!(runs[..2].iter().all(|run| run.get("scatter").is_none()));
    assert!(runs[2].get("scatter").is_some());
    for run in &runs[1..] {
        // The run itself is that of the mean: the same solutions, the same work.
        assert_eq!((&run["solver"], &run["measures"]), (&runs[0]["solver"], &runs[0]["measures"]));
    }
    assert_eq!(ScatteredNumber::all(&scene("25 kN/m", limit), None).unwrap(), []);
}

#[test]
fn other_verbs_take_the_mean_and_say_so() {
    let (folder, path) = written("25 ± 2.5 kN/m", "pad.peak-force = \"1.6 kN\"");
    let words = |arguments: &[&str]| {
        let output = run(arguments);
        assert!(code(&output) <= 1, "{arguments:?}: {}", err(&output));
        let both = format!("{} {}", out(&output), err(&output));
        both.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let mean = "K: the mean of 25 ± 2.5 kN/m stands for it here";
    let sweep = words(&["sweep", &path, "--vary", "head.velocity=1..5 m/s,3"]);
    assert!(sweep.contains(mean), "{sweep}");
    let varied = words(&["sweep", &path, "--vary", "K=20..30 kN/m,3"]);
    assert!(!varied.contains("the mean of"), "{varied}");
    let model = format!("{path}:pad");
    for own in [vec!["convert", &model, "--to", "generalized-kelvin"], vec!["rheometer", &model]] {
        let text = words(&own);
        assert!(text.contains(mean), "{own:?}: {text}");
    }
    let text = words(&["compare", &model, &model]);
    assert!(text.contains(mean), "{text}");
    let text = words(&["explain", &path]);
    assert!(text.contains("K mean 25 kN/m standard deviation 2.5 kN/m"), "{text}");
    assert!(words(&["check", &path]).contains("ok:"));
    // A value that is set takes the place of both mean and scatter; one with scatter brings its own.
    let set = of_run(&path, &["--set", "K=30 kN/m"]);
    assert!(set.get("scatter").is_none(), "{set}");
    assert!((number(&set["measures"]["pad.peak-force"]["value"]) - peak(30e3)).abs() < 1e-9);
    let own = of_run(&path, &["--set", "K=30 ± 1 kN/m", "--sample", "20"]);
    assert_eq!(own["scatter"]["sources"][0]["text"], "30 ± 1 kN/m");
    let mass = of_run(&path, &["--set", "head.mass=4 kg ± 5 %", "--sample", "20"]);
    assert_eq!(mass["scatter"]["sources"].as_array().unwrap().len(), 2);
    let results = folder.path().join("results");
    run(&["run", &path, "--sample", "20", "--out", results.to_str().unwrap()]);
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains("probability to pass") && page.contains("97.5 %"));
}

#[test]
fn designs_side_by_side_have_their_probabilities() {
    let (_folder, path) = written("25 ± 2.5 kN/m", "pad.peak-force = \"1.6 kN\"");
    let text = out(&run(&["run", &path, "--variant", "K=22 ± 1 kN/m", "--sample", "50"]));
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(text.matches("probability to pass").count(), 2, "{text}");
}

#[test]
fn a_scene_that_can_be_instantiated_is_compiled_once() {
    let spring = ["--set", "padding.maxwell.spring=20 ± 2 MN/m", "--sample", "200"];
    let own = json(&[&["run", "--json"], &spring[..]].concat())["runs"][0]["scatter"].clone();
    assert_eq!((&own["instantiated"], &own["designs"]), (&200.into(), &200.into()));
    // The same designs by a method that solves each by itself.
    let other = json(&[&["run", "--json", "--method", "bdf"], &spring[..]].concat());
    let band = |own: &Value, end: &str| number(&own["measures"]["padding.peak-force"][end]);
    for end in ["mean", "deviation", "low", "high"] {
        let [one, two] = [&own, &other["runs"][0]["scatter"]].map(|own| band(own, end));
        assert!((one / two - 1.0).abs() < 5e-3, "{end}: {one} {two}");
    }
}

#[test]
fn a_scene_that_is_not_linear_is_sampled_too() {
    // A power law F = a y² stops 4 kg at 5 m/s where a y³/3 = 50 J: the peak is (150 a^½)^⅔.
    let text =
        scene("2 MN/m^2 ± 10 %", "").replace("spring = \"K\"", "formula = \"K * y * abs(y)\"");
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", &text);
    let peak = |a: f64| (150.0 * a.sqrt()).powf(2.0 / 3.0);
    let limit = format!("pad.peak-force<={} N", peak(2e6 * 1.1));
    let own = of_run(path.to_str().unwrap(), &["--limit", &limit, "--sample", "50"]);
    let found = number(&own["scatter"]["limits"][0]["probability"]);
    assert!((found - 0.841_344_746).abs() <= 0.02, "{found}");
    assert_eq!(own["scatter"]["instantiated"], 0);
}

#[test]
fn faults_point_at_the_number() {
    let told = |from: &str, to: &str| {
        let text = scene("25 ± 2.5 kN/m", "pad.peak-force = \"1.6 kN\"").replace(from, to);
        read(&text, &ReadOptions::default()).unwrap_err().render(false)
    };
    for (from, to, message) in [
        ("25 ± 2.5 kN/m", "25 kN/m ± 2.5", "the standard deviation `2.5` has no unit"),
        ("25 ± 2.5 kN/m", "25 kN/m ± 2 kg", "do not measure the same"),
        ("25 ± 2.5 kN/m", "25 ± -2 kN/m", "the standard deviation `-2 kN/m` is negative"),
        ("25 ± 2.5 kN/m", "2 * 5 ± 1", "`2 * 5` is computed, and has no scatter"),
        ("100 ms", "100 ± 2 ms", "a number under [run] has no scatter"),
        ("1.6 kN", "1.6 ± 0.1 kN", "a number under [limits] has no scatter"),
        ("25 ± 2.5 kN/m", "25 ± 2.5 kg", "is a mass (kg); a stiffness (N/m) is expected here"),
    ] {
        let rendered = told(from, to);
        assert!(rendered.contains(message), "{to}: {rendered}");
        assert_eq!(rendered.matches("error").count(), 1, "{to}: {rendered}");
    }
}

/// The numbers of a row of a table, and its words.
fn row(text: &str, key: &str) -> Vec<f64> {
    let mut rows = text.lines().filter(|line| line.trim_start().starts_with(key));
    let row = rows.find(|line| line.contains(" to ")).unwrap();
    row.split_whitespace().filter_map(|word| word.parse().ok()).collect()
}

#[test]
fn designs_side_by_side_have_their_ranges_and_probabilities() {
    let limit = format!("pad.peak-force = \"{} N\"", peak_at(1.0));
    let (_folder, path) = written("25 ± 2.5 kN/m", &limit);
    let output = run(&["run", &path, "--variant", "K=30.25 ± 3.025 kN/m", "--sample", "2000"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = out(&output);
    // The second spring is 1.21 times as stiff, mean and deviation: all forces are 1.1 times as large.
    let quantile = 1.959_963_984_540_054;
    let known = [-quantile, quantile].map(|deviations| 1e-3 * peak_at(deviations));
    let known = [known[0], known[1], 1.1 * known[0], 1.1 * known[1]];
    let found = row(&text, "pad.peak-force");
    assert_eq!(found.len(), 4, "{text}");
    for (found, known) in found.into_iter().zip(known) {
        // The outermost fortieth of 2000 values holds 50: the quantile is known to some parts of a thousand.
        assert!((found - known).abs() < 5e-3 * known, "{found} is not {known}");
    }
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    // One standard deviation above the mean: fewer than 95 % keep it.
    assert!(words.contains("K=25 ± 2.5 kN/m: UNDECIDED, 1581 N, margin 4.7 %,"), "{words}");
    assert!(
        words.contains("has to be 95.0 % or more") && words.contains("to pass 84.1 %"),
        "{words}"
    );
    assert_eq!(words.matches("2000 designs (Latin hypercube, seed 1)").count(), 2, "{words}");
}

#[test]
fn a_probability_passes_where_its_whole_range_does() {
    // 96 % and 98 % of 500 designs: their ranges begin at 93.9 % and 96.4 %.
    for (deviations, verdict) in [(1.750_686, "UNDECIDED"), (2.053_749, "PASS")] {
        let (_folder, path) =
            written("25 ± 2.5 kN/m", &format!("pad.peak-force = \"{} N\"", peak_at(deviations)));
        let text = out(&run(&["run", &path, "--sample", "500"]));
        assert!(text.contains(verdict), "{text}");
    }
}

#[test]
fn scatter_of_what_the_scene_does_not_use_is_not_drawn() {
    let (_folder, path) = written("25 ± 2.5 kN/m", "");
    let scattered = of_run(&path, &["--sample", "50"])["scatter"].clone();
    let unused = "[materials]\nfoam = { spring = \"1 ± 0.2 MPa\" }\n[models]\nother = { spring = \"3 ± 1 kN/m\" }\n";
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "scene.toml", &(unused.to_owned() + &scene("25 ± 2.5 kN/m", "")));
    let with_unused = of_run(path.to_str().unwrap(), &["--sample", "50"])["scatter"].clone();
    assert_eq!(with_unused, scattered);
}

/// A spring that is a product, of which more is known than of its factors, and the same factors without what is known of
/// them together.
const PRODUCT: f64 = 0.05;
const FACTORS: f64 = 0.3;

fn product(together: &str, further: &str) -> String {
    scene("25 kN/m", "pad.peak-force = \"1.5 kN\"")
        .replace("spring = \"K\"", "spring = \"K * part\"")
        .replace("[nodes]", "part = 1.0\n[nodes]")
        + &format!("[scatter]\ntogether = [{together}]\n{further}")
}

fn together() -> String {
    format!("{{ K = {FACTORS}, part = -{FACTORS} }}, {{ K = {PRODUCT} }}")
}

fn apart() -> String {
    format!("{{ K = {FACTORS} }}, {{ part = {FACTORS} }}, {{ K = {PRODUCT} }}")
}

/// The standard deviation of the logarithm of the peak force, half of that of the product.
const OF_FORCE: [f64; 2] = [0.5 * PRODUCT, 0.213_600_093_632_938_3];

#[test]
fn what_is_known_of_a_product_is_not_lost_where_its_factors_scatter_together() {
    for (text_of, s) in [(together(), OF_FORCE[0]), (apart(), OF_FORCE[1])] {
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "product.toml", &product(&text_of, ""));
        let own = of_run(path.to_str().unwrap(), &["--sample", "2000"])["scatter"].clone();
        assert!(own["sources"].as_array().unwrap().iter().all(|own| own["together"] == true));
        let band = &own["measures"]["pad.peak-force"];
        // The moments of a lognormal distribution around what the means give.
        let mean = peak(STIFFNESS.0) * (0.5 * s * s).exp();
        let deviation = mean * (s * s).exp_m1().sqrt();
        let [found, spread] = ["mean", "deviation"].map(|key| number(&band[key]));
        println!("{text_of}: {found} {mean}, {spread} {deviation}");
        assert!((found / mean - 1.0).abs() < 0.25 * s / 2000_f64.sqrt() * 4.0, "{found} {mean}");
        assert!((spread / deviation - 1.0).abs() < 0.03, "{spread} {deviation}");
    }
}

#[test]
fn what_is_set_keeps_its_part_of_what_scatters_together() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "product.toml", &product(&together(), ""));
    let own = of_run(path.to_str().unwrap(), &["--set", "K=50 kN/m", "--sample", "400"]);
    let band = &own["scatter"]["measures"]["pad.peak-force"];
    let known = peak(50e3);
    assert!((number(&own["measures"]["pad.peak-force"]["value"]) / known - 1.0).abs() < 1e-9);
    assert!((number(&band["mean"]) / known - 1.0).abs() < 2e-3, "{band}");
    assert!((number(&band["deviation"]) / known / OF_FORCE[0] - 1.0).abs() < 0.1, "{band}");
}

#[test]
fn a_design_bears_what_scatters_together_and_no_more() {
    // The stiffest spring of which 485 of 500 stay below the limit, which shows 95 %: 1.8808 standard deviations below it.
    let section = "[design]\nvary = \"K=1..100 kN/m\"\nleast = \"pad.peak-deformation\"\nrobust = \"95%\"\n\
                   scatter = 500\nsample = 40\n";
    for (text_of, s) in [(together(), OF_FORCE[0]), (apart(), OF_FORCE[1])] {
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "product.toml", &product(&text_of, section));
        let own = json(&["design", path.to_str().unwrap(), "--json"]);
        let found = number(&own["parameters"]["K"]["value"]);
        let known = (1500.0_f64 / 5.0).powi(2) / 4.0 * (-2.0 * 1.880_793_608 * s).exp();
        println!("{text_of}: {found} {known} {}", own["robust"]);
        // The sample tells the quantile to some parts of 500 designs.
        assert!((found / known - 1.0).abs() < 0.5 * s + 1e-3, "{found} {known}");
        assert!(own["feasible"] == true && number(&own["robust"]["kept"]) >= 485.0);
    }
}

#[test]
fn what_is_wrong_with_numbers_that_scatter_together_is_told() {
    for (text_of, told) in [
        ("{ E = 0.1 }", "no number `E`"),
        ("{ K = \"3 mm\" }", "a part of itself"),
        ("{ K = 5 }", "−100 to 100 %"),
    ] {
        let folder = TempDir::new().unwrap();
        let path = file(&folder, "product.toml", &product(text_of, ""));
        let output = run(&["run", path.to_str().unwrap()]);
        assert!(code(&output) == 2 && err(&output).contains(told), "{text_of}: {}", err(&output));
    }
}
