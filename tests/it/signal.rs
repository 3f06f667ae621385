//! Measured channels: closed forms and a script as judges, files as people write them.

use std::{f64::consts::PI, fmt::Write as _, fs};

use dashpot::{
    signal::{Cfc, Channel, Measure, Padding, Settings},
    units::{Dimension, STANDARD_GRAVITY},
};
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run};

mod silent;

/// Folder with records from outside, which are no part of the project.
const DATA: &str = "DASHPOT_TEST_DATA";

/// The ringing pulse of the script.
fn ringing() -> Vec<f64> {
    let sample = |k: u32| {
        let k = f64::from(k);
        let pulse = if k < 100.0 { 200.0 * (PI * k / 100.0).sin() } else { 0.0 };
        pulse + 60.0 * (0.9 * k).sin() * (-k / 40.0).exp()
    };
    (0..256).map(sample).collect()
}

#[test]
fn filters_and_criterion_are_those_of_the_script() {
    let values = ringing();
    let mut counts = [0, 0];
    for line in include_str!("signal_reference.csv").lines().skip(2) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |at: usize| fields[at].parse::<f64>().unwrap();
        let (class, rate, expected) = (number(1), number(2), number(4));
        if fields[0] == "cfc" {
            let cfc = Cfc::new(class).unwrap();
            let filtered = cfc.filter(&values, rate, Padding::Zero).unwrap();
            let found = filtered[number(3) as usize];
            assert!((found - expected).abs() < 1e-8, "{line}: {found}");
            counts[0] += 1;
            continue;
        }
        let times = (0..values.len()).map(|at| at as f64 / rate).collect();
        let in_si = values.iter().map(|own| own * STANDARD_GRAVITY).collect();
        let channel = Channel::new("a", Dimension::ACCELERATION, times, in_si).unwrap();
        let found = Settings::default().analyse(channel).unwrap();
        let found = found.reading(Measure::Hic15).unwrap().value.unwrap();
        assert!((found - expected).abs() < 1e-7 * expected, "{line}: {found}");
        counts[1] += 1;
    }
    assert_eq!(counts, [128, 2]);
}

/// A half-sine of 200 g and 5 ms at 20 kHz from 10 ms on, as a logger writes it.
fn half_sine(separator: char, heading: &str, unit: f64) -> String {
    let mut text = format!("Drop 7{separator}{separator}\n\n{heading}\n");
    for at in 0..=800 {
        let time = f64::from(at) * 0.05;
        let place = (time - 10.0) / 5.0;
        let value = if (0.0..=1.0).contains(&place) { 200.0 * (PI * place).sin() } else { 0.0 };
        writeln!(text, "{time:.2}{separator}{:.9}", unit * value).unwrap();
    }
    if separator == ';' { text.replace('.', ",") } else { text }
}

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

fn write(folder: &TempDir, name: &str, text: &str) -> String {
    file(folder, name, text).to_str().unwrap().to_owned()
}

#[test]
fn every_dialect_says_the_same_of_a_half_sine() {
    let folder = TempDir::new().unwrap();
    let exact = 0.414_645_65 * 200.0_f64.powf(2.5) * 0.005;
    for (name, text) in [
        ("a.csv", half_sine(',', "t [ms],acc [g]", 1.0)),
        ("b.csv", half_sine(';', "t (ms);acc (m/s^2)", STANDARD_GRAVITY)),
        ("c.csv", half_sine('\t', "t\tacc\nms\tg", -1.0)),
    ] {
        let path = write(&folder, name, &text);
        let all = json(&["signal", &path, "--json"]);
        let own = &all["channels"][0];
        assert_eq!((own["name"].as_str(), own["unit"].as_str()), (Some("acc"), Some("m/s^2")));
        assert_eq!((own["samples"].as_u64(), &own["cfc"]), (Some(801), &Value::Null));
        assert!((number(&own["rate"]) - 20e3).abs() < 1e-6);
        let measures = &own["measures"];
        let hic = &measures["acc.hic15"];
        let (value, error) = (number(&hic["value"]), number(&hic["error"]));
        assert!((value - exact).abs() < error && error < 2e-3 * exact, "{name}: {hic}");
        // Samples alone miss 0.04 % at this rate.
        assert!((number(&hic["on_samples"]) / exact - 1.0).abs() < 6e-4, "{hic}");
        let peak = &measures["acc.peak"];
        assert!((number(&peak["value"]) / STANDARD_GRAVITY - 200.0).abs() < 0.01, "{peak}");
        assert!((number(&peak["time"]) - 0.0125).abs() < 1e-9);
        let polarity = if name == "c.csv" { "negative" } else { "positive" };
        assert_eq!(own["polarity"].as_str(), Some(polarity));
    }
}

#[test]
fn limits_are_judged_with_the_error_of_sampling() {
    let folder = TempDir::new().unwrap();
    let path = write(&folder, "drop.csv", &half_sine(',', "t [ms],acc [g]", 1.0));
    for (limit, verdict, status) in [
        ("acc.hic15<=1200", "pass", 0),
        ("acc.hic15<=1172.8", "undecided", 4),
        ("acc.hic15<=700", "fail", 4),
        ("acc.peak<=250 g", "pass", 0),
        ("acc.peak-acceleration=en-1078", "pass", 0),
        ("acc.clip-3ms<=100 g", "fail", 4),
    ] {
        let all = ["signal", &path, "--limit", limit, "--enforce", "--json"];
        let output = run(&all);
        assert_eq!(code(&output), status, "{limit}: {}", err(&output));
        let found: Value = serde_json::from_str(&out(&output)).unwrap();
        assert_eq!(found["limits"][0]["verdict"].as_str(), Some(verdict), "{limit}");
    }
    let output = run(&["signal", &path, "--limit", "head.hic15<=700"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("acc.hic15"), "{}", err(&output));
}

#[test]
fn bad_files_are_refused_with_place_and_help() {
    let folder = TempDir::new().unwrap();
    for (text, words) in [
        ("", "there is no row of numbers"),
        ("t [ms],acc [g]\n", "there is no sample"),
        ("t [ms],acc [g]\n0,1\n", "there is one sample"),
        ("t [ms],acc [g]\n0,1\n2,1\n1,3\n", "line 4, channel `acc`: the time 0.001 s"),
        ("t [ms],acc [g]\n0,1\n1,1\n1,3\n", "line 4, channel `acc`"),
        ("t [ms],acc [g]\n0,1\n1,NaN\n2,3\n", "line 3, column `acc`: `NaN` is not finite"),
        ("t [ms],acc [g]\n0,1\n1,\n2,3\n", "line 3"),
        ("t [kN],acc [g]\n0,1\n1,1\n", "no column has a unit of time"),
        ("t,acc\n0,1\n1,1\n", "--units \"s, g\""),
        ("t [ms],acc [V]\n0,1\n1,1\n", "no column is an acceleration or a force"),
        ("0,1\n1,1\n", "no column has a unit of time"),
    ] {
        let output = run(&["signal", &write(&folder, "bad.csv", text)]);
        let told = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(code(&output), 2, "{text}: {told}");
        assert!(told.contains(words) && told.contains("bad.csv"), "{text}: {told}");
    }
    let output = run(&["signal", folder.path().join("none.csv").to_str().unwrap()]);
    assert_eq!(code(&output), 2);
    let bare = write(&folder, "bare.csv", "0,1\n1,5\n2,1\n3,0\n");
    let read = json(&["signal", &bare, "--units", "ms,g", "--json"]);
    let peak = &read["channels"][0]["measures"]["2.peak"]["value"];
    assert!((number(peak) - 5.0 * STANDARD_GRAVITY).abs() < 1e-9, "{read}");
}

/// The codes of the warnings about a record.
fn warned(folder: &TempDir, samples: &[(f64, f64)]) -> Vec<String> {
    let mut text = "time [s],acc [g]\n".to_owned();
    for (time, value) in samples {
        writeln!(text, "{time:e},{value:e}").unwrap();
    }
    let all = json(&["signal", &write(folder, "record.csv", &text), "--json"]);
    let all = all["channels"][0]["warnings"].as_array().unwrap().clone();
    all.iter().map(|own| own["code"].as_str().unwrap().to_owned()).collect()
}

#[test]
fn every_defect_is_found_and_named_and_nothing_else() {
    let folder = TempDir::new().unwrap();
    let pulse = |time: f64| {
        let place = (time - 0.02) / 0.008;
        if (0.0..=1.0).contains(&place) { 150.0 * (PI * place).sin().powi(2) } else { 0.0 }
    };
    // A noise of 0.02 g without a random number.
    let noise = |at: usize| 0.02 * (f64::from((at * 7919 % 1009) as u32) / 504.5 - 1.0);
    let times: Vec<f64> = (0..1600).map(|at| f64::from(at) * 5e-5).collect();
    let clean: Vec<(f64, f64)> =
        times.iter().enumerate().map(|(at, time)| (*time, pulse(*time) + noise(at))).collect();
    let changed = |change: &dyn Fn(usize, f64, f64) -> f64| -> Vec<(f64, f64)> {
        clean.iter().enumerate().map(|(at, own)| (own.0, change(at, own.0, own.1))).collect()
    };
    assert!(warned(&folder, &clean).is_empty(), "{:?}", warned(&folder, &clean));
    let gap: Vec<_> =
        clean.iter().copied().filter(|own| !(0.0231..0.0236).contains(&own.0)).collect();
    let cut: Vec<_> = clean.iter().copied().filter(|own| own.0 > 0.0225).collect();
    let uneven: Vec<_> = clean
        .iter()
        .enumerate()
        .map(|(at, own)| (own.0 + if at % 2 == 0 { 1e-5 } else { 0.0 }, own.1))
        .collect();
    let few: Vec<_> = clean.iter().copied().step_by(20).collect();
    for (code, record) in [
        ("offset", changed(&|_, _, value| value + 1.5)),
        ("drift", changed(&|_, time, value| value + 60.0 * time)),
        ("clipped", changed(&|_, _, value| value.min(100.0))),
        ("clipped", changed(&|_, _, value| value.clamp(-100.0, 120.0))),
        (
            "held",
            changed(&|at, _, value| if (450..460).contains(&at) { clean[450].1 } else { value }),
        ),
        ("dropped-samples", gap),
        ("spikes", changed(&|at, _, value| if at == 470 { -80.0 } else { value })),
        ("uneven-steps", uneven),
        ("coarse", changed(&|_, _, value| (value / 4.0).round() * 4.0)),
        ("few-samples", few),
        ("cut", cut),
        ("odd-peak", changed(&|_, _, value| value / STANDARD_GRAVITY / 40.0)),
        ("flat", changed(&|_, _, _| 0.0)),
    ] {
        let found = warned(&folder, &record);
        assert!(found.iter().any(|own| own == code), "{code} is not among {found:?}");
        assert!(found.len() <= 2, "{code}: {found:?}");
    }
    let longer: Vec<_> = clean.iter().map(|own| (1000.0 * own.0, own.1)).collect();
    assert!(warned(&folder, &longer).contains(&"odd-length".to_owned()));
}

/// Central differences of a record of velocity, one-sided at its ends.
fn derivative(samples: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let slope = |one: usize, other: usize| {
        (samples[other].1 - samples[one].1) / (samples[other].0 - samples[one].0)
    };
    let last = samples.len() - 1;
    (0..=last).map(|at| (samples[at].0, slope(at.saturating_sub(1), (at + 1).min(last)))).collect()
}

#[test]
fn a_helmet_drop_has_the_figures_that_are_known_of_it() {
    let Some(data) = std::env::var_os(DATA) else {
        eprintln!("skipped: {DATA} names no folder");
        return;
    };
    let path = std::path::Path::new(&data).join("sibl-helmet-drop/helmet_crown_velocity_g_s.csv");
    let text = fs::read_to_string(path).unwrap();
    let rows = text.lines().map(|line| {
        let (time, velocity) = line.split_once(',').unwrap();
        (time.trim().parse().unwrap(), velocity.trim().parse().unwrap())
    });
    let mut record = "time [s],crown [g]\n".to_owned();
    for (time, value) in derivative(&rows.collect::<Vec<_>>()) {
        writeln!(record, "{time:e},{value:e}").unwrap();
    }
    let folder = TempDir::new().unwrap();
    let path = write(&folder, "crown.csv", &record);
    for (cfc, peak, hic) in [
        (None, 335.5, Some(1249.0)),
        (Some("1000"), 274.0, Some(1217.0)),
        (Some("600"), 264.4, Some(1207.0)),
        (Some("180"), 232.2, Some(961.0)),
        (Some("60"), 108.1, None),
    ] {
        let mut all = vec!["signal", &path, "--json"];
        if let Some(class) = cfc {
            all.extend(["--cfc", class]);
        }
        let own = json(&all)["channels"][0]["measures"].clone();
        let found = number(&own["crown.peak"]["value"]) / STANDARD_GRAVITY;
        assert!((found - peak).abs() < 0.06, "CFC {cfc:?}: {found} g");
        if let Some(hic) = hic {
            // The figures are those on samples, rounded; the best window ends between them.
            let found = &own["crown.hic15"];
            let (value, error) = (number(&found["value"]), number(&found["error"]));
            let on_samples = number(&found["on_samples"]);
            assert!((on_samples - hic).abs() < 0.5, "CFC {cfc:?}: {found}");
            assert!((0.0..=error).contains(&(value - on_samples)), "CFC {cfc:?}: {found}");
        }
    }
}

#[test]
fn what_is_written_is_read_again_and_says_the_same() {
    let folder = TempDir::new().unwrap();
    let path = write(&folder, "drop 7.csv", &half_sine(',', "t [ms],acc [g]", 1.0));
    let results = folder.path().join("results");
    let results = results.to_str().unwrap();
    let all = ["signal", &path, "--cfc", "600", "--offset", "auto", "--velocity", "5 m/s"];
    let first = json(&[&all[..], &["--mass", "4 kg", "--out", results, "--json"]].concat());
    for name in ["drop-7.csv", "measures.csv", "channel-1.svg", "report.html", "result.json"] {
        let text = fs::read_to_string(folder.path().join("results").join(name)).unwrap();
        assert!(!text.is_empty(), "{name}");
    }
    let kept = fs::read_to_string(folder.path().join("results/result.json")).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&kept).unwrap(), first);
    let written = folder.path().join("results/drop-7.csv");
    let again = json(&["signal", written.to_str().unwrap(), "--json"]);
    assert_eq!(again["channels"].as_array().unwrap().len(), 1, "{again}");
    for key in ["acc.peak", "acc.hic15", "acc.clip-3ms", "acc.velocity-change"] {
        let of = |all: &Value| number(&all["channels"][0]["measures"][key]["value"]);
        assert!((of(&first) / of(&again) - 1.0).abs() < 1e-12, "{key}");
    }
    // A filter takes and gives no momentum.
    let change = number(&first["channels"][0]["measures"]["acc.velocity-change"]["value"]);
    assert!(
        (change / (200.0 * STANDARD_GRAVITY * 0.005 * 2.0 / PI) - 1.0).abs() < 2e-3,
        "{change}"
    );
    let measures = &first["channels"][0]["measures"];
    let [taken, absorbed] = ["acc.energy-taken", "acc.energy-absorbed"].map(|own| &measures[own]);
    let end = 5.0 - change;
    let error = number(&taken["error"]);
    // It is what it brings along: the speed is stated at the touch, and at the deepest point there is none.
    assert!((number(&taken["value"]) - 50.0).abs() <= error + 1e-9 && error < 0.5, "{taken}");
    let lost = 0.5 * 4.0 * (25.0 - end * end);
    assert!((number(&absorbed["value"]) - lost).abs() < 1e-2 * lost, "{absorbed}, not {lost}");
}

#[test]
fn several_tests_have_a_mean_and_limits_on_it_are_judged_by_it() {
    let folder = TempDir::new().unwrap();
    let mut paths = Vec::new();
    for (name, height) in [("1.csv", 18e3), ("2.csv", 19e3), ("3.csv", 21.5e3)] {
        let mut text = "time [ms],force [N]\n".to_owned();
        for at in 0..=600 {
            let place = (f64::from(at) * 0.05 - 10.0) / 8.0;
            let value =
                if (0.0..=1.0).contains(&place) { height * (PI * place).sin() } else { 0.0 };
            writeln!(text, "{},{value}", f64::from(at) * 0.05).unwrap();
        }
        paths.push(write(&folder, name, &text));
    }
    let [one, two, three] = &paths[..] else { panic!() };
    let all = ["signal", one, two, three, "--limit", "force.peak=en-1621-1-level-2", "--json"];
    let found = json(&all);
    let peak = &found["repeats"][0]["measures"]["force.peak"];
    assert!((number(&peak["mean"]) - 19.5e3).abs() < 20.0, "{peak}");
    // Differences from the mean: −1.5, −0.5 and 2 kN.
    assert!((number(&peak["deviation"]) - (6.5e6_f64 / 2.0).sqrt()).abs() < 5.0, "{peak}");
    // 20 kN is for the mean of the tests; the third one alone exceeds it.
    let limits = found["limits"].as_array().unwrap();
    let of_mean: Vec<&Value> = limits.iter().filter(|own| own["of_mean"] == true).collect();
    assert_eq!(of_mean.len(), 1, "{found}");
    assert_eq!(of_mean[0]["verdict"].as_str(), Some("pass"), "{of_mean:?}");
    let text = out(&run(&["signal", one, two, three]));
    assert!(text.contains("force: 3 tests"), "{text}");
}

#[test]
fn a_test_in_iso_mme_is_read_from_its_folder() {
    let folder = TempDir::new().unwrap();
    let channels = folder.path().join("Channel");
    fs::create_dir(&channels).unwrap();
    write(&folder, "drop.mme", "Data format edition number :1.6\n");
    let mut text = "Name of the channel :Head X\nChannel code :11HEAD0000H3ACXC\nUnit :g\n\
         Sampling interval :0.00005\nTime of first sample :-0.01\nNumber of samples :801\n"
        .to_owned();
    for at in 0..=800 {
        let place = (f64::from(at) * 0.05 - 10.0) / 5.0;
        let value = if (0.0..=1.0).contains(&place) { 200.0 * (PI * place).sin() } else { 0.0 };
        writeln!(text, "{value:.9}").unwrap();
    }
    fs::write(channels.join("drop.001"), &text).unwrap();
    let csv = write(&folder, "drop.csv", &half_sine(',', "t [ms],acc [g]", 1.0));
    let of_csv = json(&["signal", &csv, "--json"])["channels"][0]["measures"].clone();
    for path in [folder.path().join("drop.mme"), folder.path().to_owned(), channels.clone()] {
        let found = json(&["signal", path.to_str().unwrap(), "--channel", "1", "--json"]);
        let measures = &found["channels"][0]["measures"];
        let (own, other) = (&measures["Head X.hic15"]["value"], &of_csv["acc.hic15"]["value"]);
        assert!((number(own) / number(other) - 1.0).abs() < 1e-9, "{own} and {other}");
        assert!(found["notes"][0].as_str().unwrap().contains("CFC 180"), "{found}");
    }
    fs::write(channels.join("drop.001"), text.replace(":801", ":800")).unwrap();
    let output = run(&["signal", folder.path().to_str().unwrap()]);
    let told = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(code(&output), 2);
    assert!(told.contains("drop.001, line 6: there are 801 samples"), "{told}");
}

/// The checksum of a zip, bit by bit.
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 * (sum & 1)))
    })
}

/// A zip of one file, stored or as one block of deflate that is not compressed.
fn zipped(name: &str, content: &[u8], is_deflate: bool) -> Vec<u8> {
    let length = u16::try_from(content.len()).unwrap();
    let mut packed = Vec::new();
    if is_deflate {
        packed.push(1);
        packed.extend(length.to_le_bytes());
        packed.extend((!length).to_le_bytes());
    }
    packed.extend(content);
    let method = if is_deflate { 8_u16 } else { 0 };
    let mut about = Vec::new();
    for own in [20, 0, method, 0, 0x21] {
        about.extend(own.to_le_bytes());
    }
    about.extend(checksum(content).to_le_bytes());
    for own in [packed.len(), content.len()] {
        about.extend(u32::try_from(own).unwrap().to_le_bytes());
    }
    about.extend(u16::try_from(name.len()).unwrap().to_le_bytes());
    about.extend([0, 0]);
    let mut zip = [b"PK\x03\x04", &about[..], name.as_bytes(), &packed].concat();
    let at = u32::try_from(zip.len()).unwrap();
    let central = [b"PK\x01\x02\x14\x00", &about[..], &[0; 14], name.as_bytes()].concat();
    let size = u32::try_from(central.len()).unwrap();
    zip.extend(central);
    zip.extend(b"PK\x05\x06\0\0\0\0\x01\0\x01\0");
    zip.extend(size.to_le_bytes());
    zip.extend(at.to_le_bytes());
    zip.extend([0, 0]);
    zip
}

#[test]
fn a_zip_of_a_test_is_read_and_a_damaged_one_refused() {
    let folder = TempDir::new().unwrap();
    let mut text = "Name of the channel:Head\nChannel code:11HEAD0000H3ACX0\nUnit:g\n\
         Sampling interval:0.001\nTime of first sample:0\n"
        .to_owned();
    for value in [0, 0, 40, 80, 40, 0, 0] {
        writeln!(text, "{value}").unwrap();
    }
    let path = folder.path().join("test.zip");
    for is_deflate in [false, true] {
        let zip = zipped("drop/Channel/drop.001", text.as_bytes(), is_deflate);
        fs::write(&path, &zip).unwrap();
        let found = json(&["signal", path.to_str().unwrap(), "--json"]);
        let peak = number(&found["channels"][0]["measures"]["Head.peak"]["value"]);
        assert!((peak / STANDARD_GRAVITY - 80.0).abs() < 1e-9, "{found}");
        let at = zip.windows(2).position(|own| own == b"80").unwrap();
        let damaged = [&zip[..at], b"90", &zip[at + 2..]].concat();
        for broken in [damaged, zip[..zip.len() / 2].to_vec(), Vec::new()] {
            fs::write(&path, broken).unwrap();
            let output = run(&["signal", path.to_str().unwrap()]);
            assert_eq!(code(&output), 2, "{}", out(&output));
            assert!(err(&output).contains("test.zip"), "{}", err(&output));
        }
    }
}
