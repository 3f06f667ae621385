//! Tests in ISO-MME as functions of time in a scene.

use std::{fmt::Write as _, fs};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, json, run};

const GRAVITY: f64 = 9.806_65;

/// 5 ms of 200 g, 10 ms late, at 20 kHz.
fn values() -> Vec<f64> {
    let row = |at: i32| {
        let place = (5e-5 * f64::from(at) - 0.01) / 5e-3;
        if (0.0..=1.0).contains(&place) {
            200.0 * (std::f64::consts::PI * place).sin()
        } else {
            0.0
        }
    };
    (0..600).map(row).collect()
}

fn channel(name: &str, code: &str, unit: &str, values: &[f64]) -> String {
    let mut text = format!(
        "Name of the channel :{name}\nChannel code :{code}\nUnit :{unit}\nTime of first sample :0\n\
         Sampling interval :0.00005\nNumber of samples :{}\n",
        values.len()
    );
    values.iter().for_each(|own| writeln!(text, "{own:.6}").unwrap());
    text
}

fn folder(within: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    let channels = folder.path().join(within);
    fs::create_dir_all(&channels).unwrap();
    let acceleration: Vec<f64> = values().iter().map(|own| own * GRAVITY).collect();
    let half: Vec<f64> = acceleration.iter().map(|own| 0.5 * own).collect();
    let force: Vec<f64> = values().iter().map(|own| own * 10.0).collect();
    fs::write(folder.path().join("drop.mme"), "Data format edition number :1.6\n").unwrap();
    for (number, text) in [
        ("001", channel("Head X", "11HEAD0000H3ACXA", "m/sec2", &acceleration)),
        ("002", channel("Chest X", "11CHST0000H3ACXC", "m/sec2", &half)),
        ("003", channel("Anvil", "11ANVL0000H3FOXA", "N", &force)),
    ] {
        fs::write(channels.join(format!("drop.{number}")), text).unwrap();
    }
    let mut csv = "t [s],acc [g]\n".to_owned();
    for (at, own) in values().iter().enumerate() {
        writeln!(csv, "{:.5},{own:.9}", 5e-5 * at as f64).unwrap();
    }
    fs::write(folder.path().join("drop.csv"), csv).unwrap();
    folder
}

fn scene(folder: &TempDir, table: &str) -> String {
    let path = folder.path().join("scene.toml");
    let text = format!(
        "nodes.head = {{ mass = \"5 kg\", acceleration = {{ table = {{ {table} }} }} }}\n\
         measures.head = [\"hic15\", \"peak-acceleration\"]\nrun.duration = \"30 ms\"\n"
    );
    fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

fn hic(folder: &TempDir, table: &str) -> f64 {
    let found: Value = json(&["run", &scene(folder, table), "--json"]);
    found["runs"][0]["measures"]["head.hic15"]["value"].as_f64().unwrap()
}

#[test]
fn a_channel_drives_a_node_as_the_same_record_in_a_table_does() {
    for within in ["", "Channel"] {
        let folder = folder(within);
        for treatment in ["", ", cfc = 180", ", offset = \"auto\", shift = \"-2 ms\""] {
            let of_csv = hic(&folder, &format!("file = \"drop.csv\"{treatment}"));
            for name in ["11HEAD0000H3ACXA", "head x"] {
                let of_test =
                    hic(&folder, &format!("file = \"drop.mme\", channel = \"{name}\"{treatment}"));
                assert!(
                    (of_test / of_csv - 1.0).abs() < 1e-6,
                    "{name}{treatment}: {of_test}, not {of_csv}"
                );
            }
        }
        let half = hic(&folder, "file = \"drop.mme\", channel = \"Chest X\"");
        let whole = hic(&folder, "file = \"drop.mme\", channel = \"Head X\"");
        assert!((half / whole * 2.0_f64.powf(2.5) - 1.0).abs() < 1e-6, "{half}, {whole}");
        let doubled = hic(&folder, "file = \"drop.mme\", channel = \"Chest X\", scale = 2");
        assert!((doubled / whole - 1.0).abs() < 1e-6, "{doubled}, {whole}");
    }
    // HIC15 of a half-sine is 0.41464565 A^2.5 T; lines between samples lie a little lower.
    let found = hic(&folder(""), "file = \"drop.mme\", channel = \"Head X\"");
    let exact = 0.414_645_65 * 200.0_f64.powf(2.5) * 5e-3;
    assert!((found / exact - 1.0).abs() < 5e-4, "{found}, not {exact}");
}

#[test]
fn the_only_channel_that_fits_needs_no_name_and_the_files_are_told() {
    let folder = folder("");
    let text = "[nodes]\nhead = { mass = \"2 kg\" }\n[elements]\n\
         tie = { between = [\"head\", \"ground\"], spring = \"0.01 N/m\" }\n[loads.blow]\non = \"head\"\n\
         force = { table = { file = \"drop.mme\", outside = \"zero\" } }\n\
         [measures]\nhead = [\"end-velocity\"]\n[run]\nduration = \"30 ms\"\n";
    let path = folder.path().join("load.toml");
    fs::write(&path, text).unwrap();
    let found = json(&["run", path.to_str().unwrap(), "--json"]);
    let speed = found["runs"][0]["measures"]["head.end-velocity"]["value"].as_f64().unwrap();
    let impulse: f64 = values().iter().map(|own| own * 10.0 * 5e-5).sum();
    assert!((speed * 2.0 / impulse - 1.0).abs() < 1e-4, "{speed}, {impulse}");
    let files = found["scene"]["files"].to_string();
    assert!(files.contains("drop.mme") && files.contains("drop.003"), "{files}");
}

#[test]
fn what_is_no_test_or_no_channel_of_it_is_refused() {
    let folder = folder("");
    let told = |table: &str| {
        let output = run(&["run", &scene(&folder, table)]);
        assert_eq!(code(&output), 2, "{table}: {}", err(&output));
        err(&output).split_whitespace().collect::<Vec<_>>().join(" ")
    };
    for (table, words) in [
        ("file = \"drop.mme\"", "2 of its channels measure what is driven here"),
        ("file = \"drop.mme\", channel = \"Hed X\"", "11HEAD0000H3ACXA"),
        ("file = \"drop.mme\", channel = \"Anvil\"", "is in N, where m/s^2 is wanted"),
        ("file = \"drop.csv\", channel = \"acc\"", "`channel` is one of a test in ISO-MME"),
        ("file = \"none.mme\"", "none.mme"),
    ] {
        let found = told(table);
        assert!(found.contains(words), "{table}: no {words:?} in {found}");
    }
    let broken =
        channel("Head X", "11HEAD0000H3ACXA", "m/sec2", &[1.0, 2.0]).replace("2.000000", "two");
    fs::write(folder.path().join("drop.001"), broken).unwrap();
    let found = told("file = \"drop.mme\", channel = \"Head X\"");
    assert!(
        found.contains("drop.001") && found.contains("line 8") && found.contains("`two`"),
        "{found}"
    );
    fs::remove_file(folder.path().join("drop.001")).unwrap();
    assert!(told("file = \"drop.mme\"").contains("it has no channel"));
}
