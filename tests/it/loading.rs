//! The command puts models that are not linear on the rheometer, and measured loops beside them.

use std::{fmt::Write as _, fs, process::Command};

use serde_json::Value;

const MODELS: &str = "[models]
power = { power-spring = { force = \"2 kN\", at = \"8 mm\", exponent = 2 } }
rate = { rate-spring = { force = \"1 kN\", at = \"10 mm\", gain = 0.1, reference-rate = \"10 mm/s\" } }
";

fn json(folder: &std::path::Path, words: &[&str]) -> Value {
    let mut dashpot = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    let output = dashpot.args(["rheometer", "--json"]).args(words).current_dir(folder).output();
    let output = output.unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The value of a figure of a test, with its error.
fn figure(test: &Value, name: &str) -> (f64, f64) {
    let figures = test["figures"].as_array().unwrap();
    let own = figures.iter().find(|own| own["name"] == name).unwrap();
    (own["computed"].as_f64().unwrap(), own["error"].as_f64().unwrap())
}

#[test]
fn rates_stand_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("models.toml"), MODELS).unwrap();
    let rates = [0.001, 0.1];
    let words = ["models.toml:rate", "--test", "load-unload", "--with", "deformation=10 mm"];
    let own = json(folder.path(), &[&words[..], &["--with", "rate=1 mm/s,100 mm/s"]].concat());
    let tests = own["tests"].as_array().unwrap();
    assert_eq!(tests.len(), 2);
    assert_eq!(tests[1]["variant"], "rate 100 mm/s");
    for (test, rate) in tests.iter().zip(rates) {
        // The law of loading less that of unloading: 5 J a ln(1 + v/v_r).
        let lost = 5.0 * 0.1 * (1.0_f64 + rate / 0.01).ln();
        let (found, error) = figure(test, "energy lost");
        assert!((found - lost).abs() <= error + 1e-13, "{found} for {lost}, {error:e} stated");
    }
}

#[test]
fn a_known_deviation_of_a_measured_loop_is_found() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("models.toml"), MODELS).unwrap();
    // A tenth above the law out, and on half of that back.
    let mut text = "Machine 7\nWeg [mm];Kraft [kN]\n".to_owned();
    let rows = (0..=40).map(|at| (at, 1.1)).chain((0..40).rev().map(|at| (at, 0.55)));
    for (at, factor) in rows {
        let y = 0.25 * f64::from(at);
        let _ = writeln!(text, "{y};{}", factor * 2.0 * (y / 8.0).powi(2));
    }
    fs::write(folder.path().join("pad.csv"), text).unwrap();
    let words = ["models.toml:power", "--test", "load-unload", "--measured", "pad.csv"];
    let own = json(folder.path(), &words);
    let found = &own["tests"][0]["measured"];
    let value = |name: &str| found[name].as_f64().unwrap();
    assert!((value("peak_relative") - (1.0 / 1.1 - 1.0)).abs() < 1e-9, "{found}");
    assert_eq!(found["rows"], 81);
    // The model returns all; the measured loop is the trapezoidal sum of its rows.
    assert!(value("model_area").abs() < 1e-6, "{found}");
    let out: Vec<f64> =
        (0..=40).map(|at| 1.1 * 2e3 * (0.25 * f64::from(at) / 8.0).powi(2)).collect();
    let area: f64 = out.windows(2).map(|pair| 0.5 * 0.25e-3 * (pair[0] + pair[1])).sum();
    // The first row back is joined to the peak, which is twice as high as the way back there.
    let at_turn = 0.5 * 0.25e-3 * 0.5 * out[40];
    let lost = 0.5 * area - at_turn;
    assert!((value("measured_area") - lost).abs() < 1e-12, "{found}");
    assert!(
        own["tests"][0]["settings"][0]["value"] == 0.01,
        "it turns where the measured one does"
    );

    json(folder.path(), &[&words[..], &["--out", "results"]].concat());
    let page = fs::read_to_string(folder.path().join("results/report.html")).unwrap();
    assert!(page.contains("Beside the measured loop") && page.contains("−9.1 %"), "{page}");

    fs::write(folder.path().join("bare.csv"), "a;b\n1;2\n2;3\n").unwrap();
    let mut dashpot = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    let words = ["rheometer", "models.toml:power", "--measured", "bare.csv"];
    let output = dashpot.args(words).current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("bare.csv") && said.contains("deformation"), "{said}");
}

#[test]
fn parameters_of_tests_and_times_have_units() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[models.rubber]\npower-spring = { force = 100, at = 0.01, exponent = 2 }\n";
    fs::write(folder.path().join("models.toml"), text).unwrap();
    let said = |words: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_dashpot"))
            .args(words)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8(output.stderr).unwrap();
        said.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let of_test = ["rheometer", "models.toml:rubber", "--test", "load-unload", "--with"];
    let bare = said(&[&of_test[..], &["deformation=10"]].concat());
    assert!(
        bare.contains("`deformation`: `10` has no unit: write \"10 mm\" or \"10 m\""),
        "{bare}"
    );
    let of_others = ["rheometer", "models.toml:rubber", "--test", "creep", "--with", "hold=5 ms"];
    let helped = said(&of_others);
    let tests = "`hold` is a parameter of `--test creep-recovery,load-hold-unload`";
    assert!(helped.contains(tests), "{helped}");
    let misspelt = said(&[&of_test[..], &["retrun-rate=1 mm/s"]].concat());
    assert!(misspelt.contains("did you mean `return-rate`?"), "{misspelt}");
    let bare = said(&["run", "reference", "--at", "5"]);
    assert!(bare.contains("`5` has no unit: write \"5 ms\" or \"5 s\""), "{bare}");
}

#[test]
fn twenty_rates_stand_in_parts_that_fit_a_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let text = "[models.rubber]\npower-spring = { force = 100, at = 0.01, exponent = 2 }\n";
    fs::write(folder.path().join("models.toml"), text).unwrap();
    let rates: Vec<String> = (1..=20).map(|rate| format!("{rate} mm/s")).collect();
    let output = Command::new(env!("CARGO_BIN_EXE_dashpot"))
        .args(["rheometer", "models.toml:rubber", "--test", "load-unload", "--with"])
        .arg(format!("rate={}", rates.join(",")))
        .current_dir(folder.path())
        .output()
        .unwrap();
    let shown = String::from_utf8(output.stdout).unwrap();
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    // 1 mm on 100 N (y/1 cm)², in every column of every part.
    let peaks: Vec<&str> = shown.lines().filter(|line| line.contains("  peak force ")).collect();
    let values = peaks.iter().map(|line| line.matches(" 1.00000 N").count()).sum::<usize>();
    assert!(peaks.len() > 1 && values == 20, "{shown}");
    assert_eq!(shown.matches("network by ").count(), 1, "{shown}");
}

/// Its force jumps at the very instant at which a pad that remembers has come to rest.
#[test]
fn a_force_that_is_taken_from_a_pad_at_rest_lets_it_back_on_its_other_curve() {
    let folder = tempfile::tempdir().unwrap();
    let pad = "[models]\npad = { parallel = [{ hysteretic-table = { loading = [[\"0 mm\", \"0 N\"], [\"10 mm\", \"1 kN\"]], \
               unloading = [[\"5 mm\", \"0 N\"], [\"10 mm\", \"1 kN\"]] } }, { dashpot = \"10 kN s/m\" }] }\n";
    fs::write(folder.path().join("pad.toml"), pad).unwrap();
    let with = ["force=800 N", "hold=5 s", "end=5.05 s"].map(|own| ["--with", own]).concat();
    let words = [&["pad.toml:pad", "--test", "creep-recovery"][..], &with].concat();
    let test = &json(folder.path(), &words)["tests"][0];
    let figures = test["figures"].as_array().unwrap();
    // It has come to 8 mm; then c y' = −2 k (y − 4 mm), for c/(2 k) = 50 ms.
    let (held, left) = (8e-3, 4e-3 + 4e-3 * (-1.0_f64).exp());
    for (name, truth) in [("deformation just after", held), ("deformation at the end", left)] {
        let own = figures.iter().find(|own| own["name"] == name).unwrap();
        let own = own["computed"].as_f64().unwrap();
        assert!((own / truth - 1.0).abs() < 1e-8, "{name}: {own}, {truth}");
    }
}
