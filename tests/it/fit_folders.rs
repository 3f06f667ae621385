//! What `fit` writes into a folder, and what it does when it is interrupted.

use std::{fmt::Write as _, fs, process::Command};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, out, run};

const PAD: &str = "title = \"A pad\"\n[values]\nK = \"50 kN/m\"  # a guess\nC = \"100 N s/m\"\n\
     [nodes]\nhead = { mass = \"4 kg\", velocity = \"2 m/s\" }\n[elements]\n\
     pad = { between = [\"head\", \"ground\"], maxwell = { spring = \"K\", dashpot = \"C\" } }\n\
     [effects]\nseparation.pad = { at = \"head\" }\n[run]\nduration = \"30 ms\"\n";

/// Force of a Maxwell pad of 200 kN/m and 1.5 kN s/m under 4 kg at 2 m/s, with a hum of 5 N.
fn force(t: f64) -> f64 {
    let rate = 0.5 * 200e3 / 1500.0;
    let root = f64::sqrt(200e3 / 4.0 - rate * rate);
    let end = std::f64::consts::PI / root;
    let own = if (0.0..end).contains(&t) {
        2.0 * 200e3 / root * (-rate * t).exp() * (root * t).sin()
    } else {
        0.0
    };
    own + 5.0 * (9e3 * t).sin()
}

/// At 20 kHz, or so many times that.
fn record(times: u32) -> String {
    let mut text = "t [ms],force [N]\n".to_owned();
    for at in 0..600 * times {
        let t = 5e-5 * f64::from(at) / f64::from(times);
        writeln!(text, "{:.5},{:.3}", 1e3 * t, force(t - 2e-3)).unwrap();
    }
    text
}

fn at(folder: &TempDir, name: &str) -> String {
    folder.path().join(name).to_str().unwrap().to_owned()
}

fn written(folder: &TempDir, name: &str, text: &str) -> String {
    fs::write(folder.path().join(name), text).unwrap();
    at(folder, name)
}

/// The columns of a CSV file by their headings.
fn columns(path: &str) -> Vec<(String, Vec<f64>)> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let heads = lines.next().unwrap().split(',');
    let mut all: Vec<(String, Vec<f64>)> = heads.map(|own| (own.to_owned(), Vec::new())).collect();
    for line in lines {
        for (own, cell) in all.iter_mut().zip(line.split(',')) {
            own.1.push(cell.parse().unwrap_or(f64::NAN));
        }
    }
    all
}

#[test]
fn a_folder_has_the_scene_the_rows_the_figures_and_one_page() {
    let folder = TempDir::new().unwrap();
    let (scene, csv) =
        (written(&folder, "pad.toml", PAD), written(&folder, "drop.csv", &record(1)));
    let (to, dir) = (format!("{csv}:force=pad.force"), at(&folder, "found"));
    let words =
        ["fit", &scene, "--vary", "K=10..1000 kN/m", "--vary", "C=50..5000 N s/m", "--to", &to];
    let output = run(&[&words[..], &["--out", &dir]].concat());
    assert_eq!(code(&output), 0, "{}", err(&output));
    let file = |name: &str| fs::read_to_string(format!("{dir}/{name}")).unwrap();
    let result: Value = serde_json::from_str(&file("result.json")).unwrap();
    assert_eq!(result["stopped"], false);
    let found = result["parameters"]["K"]["value"].as_f64().unwrap();
    assert!((found / 200e3 - 1.0).abs() < 0.01, "{found}");
    let text = file("fitted.toml");
    assert!(text.contains("# a guess") && text.contains("# fitted to"), "{text}");
    assert_eq!(code(&run(&["check", &format!("{dir}/fitted.toml")])), 0);
    // The rows are those of the result, and the model is within some noise of the force without the hum.
    let columns = columns(&format!("{dir}/record-1.csv"));
    let names: Vec<&str> = columns.iter().map(|own| own.0.as_str()).collect();
    assert_eq!(names, ["time [s]", "measured [N]", "fitted [N]", "half of the band [N]"]);
    let curve = &result["tests"][0]["curve"];
    for (column, key) in columns.iter().zip(["time", "measured", "model", "band"]) {
        let own: Vec<f64> = serde_json::from_value(curve[key].clone()).unwrap();
        assert_eq!(column.1.len(), own.len(), "{key}");
        let is_same = |(one, other): (&f64, &f64)| (one - other).abs() <= 1e-12 * one.abs();
        assert!(column.1.iter().zip(&own).all(is_same), "{key}");
    }
    let largest = columns[2]
        .1
        .iter()
        .zip(&columns[0].1)
        .map(|(own, t)| (own - force(t - 2e-3) + 5.0 * (9e3 * (t - 2e-3)).sin()).abs());
    assert!(largest.fold(0.0, f64::max) < 10.0);
    let (svg, page) = (file("record-1.svg"), file("report.html"));
    for word in ["95 % band", "fitted", "measured", "left (", "force (kN)"] {
        assert!(svg.contains(word), "{word}");
    }
    for word in [
        "A pad",
        "identified",
        "K=10..1000 kN/m",
        "peak off by",
        "The fitted scene",
        "fitted to",
        "<svg",
    ] {
        assert!(page.contains(word), "{word}");
    }
    // The network is drawn with what was found.
    assert!(page.contains("200") && !page.contains("50 kN/m</text>"));
    // A file is written as before.
    let toml = at(&folder, "own.toml");
    assert_eq!(code(&run(&[&words[..], &["--out", &toml]].concat())), 0);
    assert_eq!(fs::read_to_string(toml).unwrap(), text);
}

#[test]
fn a_model_has_its_records_with_branches_and_the_nearest_network() {
    let folder = TempDir::new().unwrap();
    let mut text = "f [Hz],E' [MPa],E'' [MPa]\n".to_owned();
    for at in 0..25 {
        let f = 10_f64.powf(-1.0 + f64::from(at) / 8.0);
        let x = std::f64::consts::TAU * f * 0.01;
        writeln!(
            text,
            "{f:e},{:e},{:e}",
            2.0 + 3.0 * x * x / (1.0 + x * x),
            3.0 * x / (1.0 + x * x)
        )
        .unwrap();
    }
    let csv = written(&folder, "dma.csv", &text);
    let dir = at(&folder, "gel");
    let output = run(&["fit", "--to", &format!("{csv}:E',E''=gel"), "--out", &dir]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let columns = columns(&format!("{dir}/record-1.csv"));
    assert_eq!(columns.len(), 7, "{columns:?}");
    for (measured, others) in [(1, [2, 3]), (4, [5, 6])] {
        for other in others {
            for (one, two) in columns[measured].1.iter().zip(&columns[other].1) {
                assert!((one / two - 1.0).abs() < 1e-3, "{}: {one} {two}", columns[other].0);
            }
        }
    }
    let svg = fs::read_to_string(format!("{dir}/record-1.svg")).unwrap();
    for word in ["storage, fitted", "loss, fitted", "nearest network", "branches", "left (%)"] {
        assert!(svg.contains(word), "{word}");
    }
    let page = fs::read_to_string(format!("{dir}/report.html")).unwrap();
    assert!(page.contains("equilibrium modulus") && page.contains("[materials.gel"), "{page}");
    assert_eq!(code(&run(&["rheometer", &format!("{dir}/fitted.toml:gel"), "--test", "sweep"])), 0);
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_fit_with_the_best_so_far() {
    use std::{process::Stdio, thread::sleep, time::Duration};

    let folder = TempDir::new().unwrap();
    let (scene, csv) =
        (written(&folder, "pad.toml", PAD), written(&folder, "drop.csv", &record(200)));
    let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    let toml = at(&folder, "best.toml");
    command.args(["fit", &scene, "--vary", "K=10..1000 kN/m", "--vary", "C=50..5000 N s/m"]);
    command.args(["--to", &format!("{csv}:force=pad.force"), "--starts", "1000", "--out", &toml]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    sleep(Duration::from_secs(3));
    let sent = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 1, "{}", err(&output));
    let text = out(&output) + &err(&output);
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(words.contains("not finished: the search was interrupted"), "{text}");
    assert!(words.contains("Numbers") && words.contains("K "), "{text}");
    assert!(fs::read_to_string(toml).unwrap().starts_with("# not finished: fitted to"));
}

#[test]
fn a_folder_that_is_missing_is_named() {
    let folder = TempDir::new().unwrap();
    let (scene, csv) =
        (written(&folder, "pad.toml", PAD), written(&folder, "drop.csv", &record(1)));
    let (to, missing) = (format!("{csv}:force=pad.force"), at(&folder, "none/deep/f.toml"));
    let done = run(&["fit", &scene, "--to", &to, "--vary", "C=10..20000 N s/m", "--out", &missing]);
    let words = err(&done).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(code(&done) == 2 && words.contains("there is no folder `"), "{words}");
    assert!(!words.contains("no such file"), "{words}");
}
