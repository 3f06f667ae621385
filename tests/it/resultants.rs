//! Axes of one location: closed forms of their resultant as judges, and limits that no axis alone keeps.

use std::{f64::consts::PI, fmt::Write as _, fs};

use dashpot::units::STANDARD_GRAVITY;
use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run};

/// HIC of a half-sine in parts of `A^2.5 T`: `docs/injury-measures.md`.
const HALF_SINE: f64 = 0.414_645_65;

/// A table of axes at 20 kHz from −10 ms on: a half-sine of this length \[ms\] times what each axis is of it at a place
/// from 0 to 1, in g.
fn axes(names: &[&str], length: f64, parts: &dyn Fn(f64) -> Vec<f64>) -> String {
    let mut text = format!("t [ms],{}\n", names.join(" [g],") + " [g]");
    for at in 0..800 {
        let time = f64::from(at) * 0.05 - 10.0;
        let place = time / length;
        let height = if (0.0..=1.0).contains(&place) { (PI * place).sin() } else { 0.0 };
        let values = parts(place).into_iter().map(|own| format!("{:e}", height * own));
        writeln!(text, "{time:.2},{}", values.collect::<Vec<_>>().join(",")).unwrap();
    }
    text
}

fn write(folder: &TempDir, name: &str, text: &str) -> String {
    file(folder, name, text).to_str().unwrap().to_owned()
}

fn number(own: &Value) -> f64 {
    own.as_f64().unwrap_or(f64::NAN)
}

/// The channel of a name.
fn channel<'v>(all: &'v Value, name: &str) -> &'v Value {
    let found = all["channels"].as_array().unwrap().iter().find(|own| own["name"] == name);
    found.unwrap_or_else(|| panic!("no channel {name}: {all}"))
}

/// Value and error of a measure of a channel.
fn measure(all: &Value, name: &str, word: &str) -> (f64, f64) {
    let own = &channel(all, name)["measures"][format!("{name}.{word}")];
    (number(&own["value"]), number(&own["error"]))
}

/// What is printed, in one line.
fn printed(args: &[&str]) -> String {
    out(&run(args)).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Limit, verdict and reason of each limit.
fn verdicts(all: &Value) -> Vec<(String, String, String)> {
    let text = |own: &Value| own.as_str().unwrap_or_default().to_owned();
    let of = |own: &Value| (text(&own["key"]), text(&own["verdict"]), text(&own["reason"]));
    all["limits"].as_array().unwrap().iter().map(of).collect()
}

fn judged(args: &[&str]) -> (i32, Vec<(String, String, String)>) {
    let output = run(&[args, &["--enforce", "--json"]].concat());
    let all = serde_json::from_str(&out(&output)).unwrap_or_else(|_| panic!("{}", err(&output)));
    (code(&output), verdicts(&all))
}

#[test]
fn a_head_fails_that_each_of_its_axes_would_pass() {
    let folder = TempDir::new().unwrap();
    // 100 and 240 g in phase are 260 g.
    let two = write(&folder, "two.csv", &axes(&["HeadX", "HeadZ"], 5.0, &|_| vec![100.0, 240.0]));
    let all = json(&["signal", &two, "--json"]);
    let (peak, error) = measure(&all, "Head resultant", "peak");
    assert!((peak / STANDARD_GRAVITY - 260.0).abs() < 1e-6 && error < 0.3 * STANDARD_GRAVITY);
    let axes_alone =
        ["signal", &two, "--limit", "HeadX.peak=en-1078", "--limit", "HeadZ.peak=en-1078"];
    let (status, found) = judged(&axes_alone);
    assert_eq!(status, 4, "{found:?}");
    assert!(found.iter().all(|own| own.1 == "undecided" && own.2 == "other-axes"), "{found:?}");
    // The place stands for its resultant, as the name of the resultant does.
    for key in ["Head.peak=en-1078", "Head resultant.peak<=250 g", "Head.peak-acceleration<=250 g"]
    {
        let (status, found) = judged(&["signal", &two, "--limit", key]);
        assert_eq!((status, &*found[0].1), (4, "fail"), "{key}: {found:?}");
    }
    // One axis that exceeds a limit has exceeded it, and one that was read alone keeps none.
    let (_, found) = judged(&["signal", &two, "--limit", "HeadZ.peak<=200 g"]);
    assert_eq!(found[0].1, "fail", "{found:?}");
    let (status, found) =
        judged(&["signal", &two, "--channel", "HeadZ", "--limit", "HeadZ.peak=en-1078"]);
    assert_eq!((status, &*found[0].2), (4, "other-axes"), "{found:?}");
    // Two of three axes keep none either, unless the rig lets the body move in their plane alone.
    let (_, found) = judged(&["signal", &two, "--limit", "Head.peak<=270 g"]);
    assert_eq!(found[0].2, "other-axes", "{found:?}");
    let (status, found) =
        judged(&["signal", &two, "--limit", "Head.peak<=270 g", "--guided", "xz"]);
    assert_eq!((status, &*found[0].1), (0, "pass"), "{found:?}");
    let (_, found) = judged(&["signal", &two, "--limit", "HeadX.peak=en-1078", "--guided", "z"]);
    assert_eq!(found[0].2, "other-axes", "{found:?}");
    for wrong in ["y", "xyz", "zz", "w", ""] {
        let output = run(&["signal", &two, "--guided", wrong]);
        assert_eq!(code(&output), 2, "{wrong}");
        assert!(err(&output).contains("--guided"), "{wrong}: {}", err(&output));
    }
}

#[test]
fn channels_of_unknown_relation_pass_no_limit_on_a_body_until_they_are_declared() {
    let folder = TempDir::new().unwrap();
    let heights = |_: f64| vec![100.0, 240.0];
    for names in [["acc1", "acc2"], ["head 1", "head 2"], ["left", "right"], ["", ""]] {
        let path = write(&folder, "two.csv", &axes(&names, 5.0, &heights));
        let keys = if names[0].is_empty() { ["2", "3"] } else { names };
        let limits = keys.map(|own| format!("{own}.peak=en-1078"));
        let limits = ["--limit", &limits[0], "--limit", &limits[1]];
        let (status, found) = judged(&[&["signal", &path][..], &limits].concat());
        assert_eq!(status, 4, "{names:?} {found:?}");
        assert!(found.iter().all(|own| own.1 == "undecided" && own.2 == "other-axes"), "{found:?}");
        // The other one is in the file, whether it is read or not.
        let alone = ["signal", &path, "--channel", keys[0], limits[0], limits[1]];
        assert_eq!(judged(&alone).1[0].1, "undecided");
        let text = printed(&[&["signal", &path][..], &limits].concat());
        assert!(text.contains("--channel") && text.contains("Head X"), "{text}");
        // Axes of one location form a resultant; bodies of their own are judged by themselves.
        let declared = |of: [&str; 2]| {
            let [one, other] = [0, 1].map(|at| format!("{}={}", keys[at], of[at]));
            [path.clone(), "--channel".to_owned(), one, "--channel".to_owned(), other]
        };
        let judged = |of: [&str; 2], limits: &[&str]| {
            let args = declared(of);
            let args = args.iter().map(String::as_str);
            let limits = limits.iter().flat_map(|own| ["--limit", own]);
            judged(&["signal"].into_iter().chain(args).chain(limits).collect::<Vec<_>>())
        };
        let (status, found) = judged(["Head X", "Head Z"], &["Head.peak=en-1078"]);
        assert_eq!((status, &*found[0].1), (4, "fail"), "{found:?}");
        let (status, found) = judged(["A", "B"], &["A.peak=en-1078", "B.peak<=250 g"]);
        assert_eq!(status, 0, "{found:?}");
        let (_, found) = judged(["A", "B"], &["A.peak<=90 g", "B.peak<=230 g"]);
        assert!(found.iter().all(|own| own.1 == "fail"), "{found:?}");
    }
    // What else is in the file is no axis of a body with three, nor is what is no acceleration.
    let names = ["Head X", "Head Y", "Head Z", "plate"];
    let path = write(&folder, "four.csv", &axes(&names, 5.0, &|_| vec![3.0, 4.0, 12.0, 9.0]));
    let (status, found) = judged(&["signal", &path, "--limit", "plate.peak<=10 g"]);
    assert_eq!(status, 0, "{found:?}");
    let text = axes(&["acc", "F"], 5.0, &heights).replace("F [g]", "F [N]");
    let path = write(&folder, "force.csv", &text);
    let (status, found) = judged(&["signal", &path, "--limit", "acc.peak=en-1078"]);
    assert_eq!(status, 0, "{found:?}");
}

#[test]
fn anatomical_axes_form_a_resultant() {
    let folder = TempDir::new().unwrap();
    for names in [
        ["Head A-P", "Head S-I"],
        ["Head AP", "Head SI"],
        ["Head L-R", "Head S/I"],
        ["Head_lat", "Head_vert"],
        ["Head fore-aft", "Head lateral"],
    ] {
        let path = write(&folder, "two.csv", &axes(&names, 5.0, &|_| vec![100.0, 240.0]));
        let all = json(&["signal", &path, "--json"]);
        let (peak, _) = measure(&all, "Head resultant", "peak");
        assert!((peak / STANDARD_GRAVITY - 260.0).abs() < 1e-6, "{names:?}");
        let limits = names.map(|own| format!("{own}.peak=en-1078"));
        let (status, found) =
            judged(&["signal", &path, "--limit", &limits[0], "--limit", &limits[1]]);
        assert!(status == 4 && found.iter().all(|own| own.1 == "undecided"), "{found:?}");
    }
}

#[test]
fn a_guided_rig_is_believed_as_far_as_its_other_axes_do_not_contradict() {
    let folder = TempDir::new().unwrap();
    let limit = ["--limit", "HeadX.peak=en-1078", "--guided", "x"];
    for (x, z, verdict) in
        [(100.0, 240.0, "undecided"), (240.0, 30.0, "pass"), (240.0, 80.0, "undecided")]
    {
        let path = write(&folder, "two.csv", &axes(&["HeadX", "HeadZ"], 5.0, &|_| vec![x, z]));
        let (status, found) = judged(&[&["signal", &path][..], &limit].concat());
        assert_eq!((status == 0, &*found[0].1), (verdict == "pass", verdict), "{x} {z} {found:?}");
        let text = printed(&[&["signal", &path][..], &limit].concat());
        let size = format!("with z it is {:.1} g", f64::hypot(x, z));
        assert!(verdict == "pass" || text.contains(&size), "{text}");
        // An axis of the file that is not read may contradict as well.
        let alone = [&["signal", &path, "--channel", "HeadX"][..], &limit].concat();
        let (status, found) = judged(&alone);
        assert_eq!((status, &*found[0].2), (4, "other-axes"), "{found:?}");
        assert!(printed(&alone).contains("`HeadZ` of the file"), "{}", printed(&alone));
    }
    // Nor does one pass beside axes with which it forms no resultant.
    let names = ["HeadX", "head x", "HeadZ"];
    let path = write(&folder, "twice.csv", &axes(&names, 5.0, &|_| vec![100.0, 100.0, 240.0]));
    let (status, found) = judged(&[&["signal", &path][..], &limit].concat());
    assert_eq!((status, &*found[0].2), (4, "other-axes"), "{found:?}");
    // The location stands for the only axis that is there, guided along it or not.
    let path = write(&folder, "one.csv", &axes(&["HeadX"], 5.0, &|_| vec![240.0]));
    let (status, found) =
        judged(&["signal", &path, "--limit", "Head.peak=en-1078", "--guided", "x"]);
    assert_eq!((status, &*found[0].1), (0, "pass"), "{found:?}");
    let (status, found) = judged(&["signal", &path, "--limit", "Head.peak=en-1078"]);
    assert_eq!((status, &*found[0].2), (4, "other-axes"), "{found:?}");
    assert!(
        printed(&["signal", &path, "--limit", "Head.peak<=250 g"]).contains("x alone is measured")
    );
}

#[test]
fn what_a_channel_of_the_same_body_contradicts_does_not_pass() {
    let folder = TempDir::new().unwrap();
    for (names, values, limit, verdict) in [
        // An axis is no larger than the resultant, which was recorded …
        (
            &["Head X", "Head resultant"][..],
            vec![150.0, 135.0],
            "Head resultant.peak<=140 g",
            "undecided",
        ),
        (&["Head X", "Head resultant"], vec![130.0, 135.0], "Head resultant.peak<=140 g", "pass"),
        // … and one of three axes is that which was recorded.
        (
            &["Head X", "Head Y", "Head Z", "Head res"],
            vec![150.0, 100.0, 50.0, 300.0],
            "Head.peak<=250 g",
            "undecided",
        ),
        (
            &["Head X", "Head Y", "Head Z", "Head res"],
            vec![150.0, 100.0, 50.0, 187.1],
            "Head.peak<=250 g",
            "pass",
        ),
    ] {
        let path = write(&folder, "own.csv", &axes(names, 5.0, &|_| values.clone()));
        let (status, found) = judged(&["signal", &path, "--limit", limit]);
        assert_eq!(
            (status == 0, &*found[0].1),
            (verdict == "pass", verdict),
            "{names:?} {found:?}"
        );
        let text = printed(&["signal", &path, "--limit", limit]);
        assert!(verdict == "pass" || text.contains("of the same body is"), "{text}");
    }
}

#[test]
fn whatever_is_undecided_says_why() {
    let folder = TempDir::new().unwrap();
    let two = write(&folder, "two.csv", &axes(&["HeadX", "HeadZ"], 5.0, &|_| vec![100.0, 240.0]));
    let three = ["Head X", "Head Y", "Head Z"];
    let three = write(&folder, "three.csv", &axes(&three, 5.0, &|_| vec![3.0, 4.0, 12.0]));
    let short = write(&folder, "short.csv", "t [ms],acc [g]\n0,0\n1,50\n2,0\n");
    let cut = write(&folder, "cut.csv", "t [ms],acc [g]\n0,50\n1,60\n2,30\n3,20\n4,10\n");
    for (path, limit, words) in [
        (&two, "Head.peak<=270 g", "x and z alone are measured"),
        (&two, "HeadX.peak<=270 g", "it is that of x alone, and the limit is one on the resultant"),
        (&three, "Head.peak<=13 g", "the limit is within the error"),
        (&short, "acc.clip-3ms<=50 g", "the record is too short"),
        (&cut, "acc.peak<=100 g", "begins or ends within the pulse"),
    ] {
        let text = printed(&["signal", path, "--limit", limit]);
        assert!(text.contains("UNDECIDED") && text.contains(words), "{limit}: {text}");
    }
    // A limit without a channel names what there is.
    let output = run(&["signal", &two, "--limit", "peak<=200 g"]);
    let told = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(code(&output), 2, "{told}");
    assert!(told.contains("measure `peak`") && told.contains("`Head resultant.peak`"), "{told}");
}

#[test]
fn a_resultant_has_the_measures_of_its_closed_form() {
    let folder = TempDir::new().unwrap();
    let names = ["Head ax", "Head ay", "Head az"];
    let root = 3.0_f64.sqrt();
    // In phase; and turning about an axis within the pulse, so that no axis is a half-sine.
    let turning = |place: f64| {
        let angle = 2.0 * place;
        vec![100.0 * root * angle.cos(), 100.0 * root * angle.sin(), 0.0]
    };
    let in_phase = |_: f64| vec![100.0; 3];
    for parts in [&in_phase as &dyn Fn(f64) -> Vec<f64>, &turning] {
        let path = write(&folder, "three.csv", &axes(&names, 12.0, parts));
        let all = json(&["signal", &path, "--json"]);
        let unit = (100.0 * root).powf(2.5) * 0.012;
        for (word, expected) in [
            ("peak", 100.0 * root * STANDARD_GRAVITY),
            ("hic15", HALF_SINE * unit),
            ("hic", HALF_SINE * unit),
            ("severity-index", 0.457_655_86 * unit),
            ("clip-3ms", 100.0 * root * STANDARD_GRAVITY * (PI * 4.5 / 12.0).sin()),
        ] {
            let (value, error) = measure(&all, "Head resultant", word);
            assert!(
                (value - expected).abs() <= error + 1e-9 * expected && error < 5e-3 * expected,
                "{word}: {value} ± {error}, not {expected}"
            );
        }
        let own = channel(&all, "Head resultant");
        assert_eq!(own["axes"], serde_json::json!(["x", "y", "z"]));
        assert_eq!(own["resultant_of"], serde_json::json!(names));
        assert!(own["measures"]["Head resultant.velocity-change"].is_null(), "{own}");
        let (status, found) = judged(&["signal", &path, "--limit", "Head.hic15<=700"]);
        assert_eq!((status, &*found[0].1), (4, "fail"), "{found:?}");
        // What keeps the limit with all three axes passes.
        let (status, found) = judged(&["signal", &path, "--limit", "Head.hic15<=2100"]);
        assert_eq!((status, &*found[0].1), (0, "pass"), "{found:?}");
    }
}

#[test]
fn a_resultant_does_not_depend_on_how_the_sensor_is_turned() {
    let folder = TempDir::new().unwrap();
    let vector = |place: f64| [150.0, 60.0 * (3.0 * place).sin(), 40.0 * (5.0 * place).cos()];
    let text = |turn: Option<[f64; 2]>| {
        axes(&["acc_x", "acc_y", "acc_z"], 8.0, &|place| {
            let [x, y, z] = vector(place);
            let Some([one, other]) = turn else { return vec![x, y, z] };
            let (x, y) = (x * one.cos() - y * one.sin(), x * one.sin() + y * one.cos());
            vec![x, y * other.cos() - z * other.sin(), y * other.sin() + z * other.cos()]
        })
    };
    let read = |turn| {
        let path = write(&folder, "turned.csv", &text(turn));
        // A filter is linear, so that turning and filtering may change places; offsets of zero are taken off.
        json(&["signal", &path, "--cfc", "600", "--offset", "auto", "--json"])
    };
    let first = read(None);
    for turn in [[0.7, 0.2], [2.0, 1.1], [-0.4, 3.0]] {
        let other = read(Some(turn));
        for word in ["peak", "hic15", "severity-index", "clip-3ms", "contact-time"] {
            let of = |all: &Value| measure(all, "acc resultant", word).0;
            assert!((of(&first) / of(&other) - 1.0).abs() < 1e-7, "{word}: {turn:?}");
        }
    }
}

#[test]
fn offsets_are_taken_off_the_axes_and_not_the_resultant() {
    let folder = TempDir::new().unwrap();
    let text = axes(&["HeadX", "HeadY", "HeadZ"], 5.0, &|_| vec![100.0, 0.0, 240.0]);
    let shifted: Vec<String> = text
        .lines()
        .enumerate()
        .map(|(at, line)| {
            let fields: Vec<&str> = line.split(',').collect();
            let moved = |own: usize, by: f64| fields[own].parse::<f64>().unwrap() + by;
            if at == 0 {
                line.to_owned()
            } else {
                format!("{},{},{},{}", fields[0], moved(1, 3.0), moved(2, -2.0), moved(3, 1.0))
            }
        })
        .collect();
    let path = write(&folder, "shifted.csv", &shifted.join("\n"));
    let all = json(&["signal", &path, "--offset", "auto", "--json"]);
    let peak = measure(&all, "Head resultant", "peak").0 / STANDARD_GRAVITY;
    assert!((peak - 260.0).abs() < 1e-6, "{peak}");
}

/// A channel of a test in ISO-MME: a half-sine of 5 ms at this rate \[kHz\], from −10 ms on.
fn mme(code: &str, height: f64, rate: f64) -> String {
    let mut text = format!(
        "Name of the channel :{code}\nChannel code :{code}\nUnit :g\nSampling interval :{}\n\
         Time of first sample :-0.01\n",
        1e-3 / rate
    );
    for at in 0..(40.0 * rate) as u32 {
        let place = (f64::from(at) / rate - 10.0) / 5.0;
        let value = if (0.0..=1.0).contains(&place) { height * (PI * place).sin() } else { 0.0 };
        writeln!(text, "{value:e}").unwrap();
    }
    text
}

#[test]
fn codes_of_iso_mme_tell_the_axes_whatever_their_rates_are() {
    let folder = TempDir::new().unwrap();
    let write = |all: &[(&str, f64, f64)]| {
        for (at, (code, height, rate)) in all.iter().enumerate() {
            let path = folder.path().join(format!("t.{:03}", at + 1));
            fs::write(path, mme(code, *height, *rate)).unwrap();
        }
        json(&["signal", folder.path().to_str().unwrap(), "--json"])
    };
    let all = write(&[
        ("11HEAD0000H3ACXA", 100.0, 20.0),
        ("11HEAD0000H3ACYA", 0.0, 20.0),
        ("11HEAD0000H3ACZA", 240.0, 10.0),
        ("11CHST0000H3ACZA", 50.0, 20.0),
    ]);
    let (peak, error) = measure(&all, "11HEAD0000H3ACRA", "peak");
    assert!((peak - 260.0 * STANDARD_GRAVITY).abs() <= error, "{peak} ± {error}");
    // The line through 10 kHz hides 1.3 times as much of 240 g as its step shows.
    assert!(error > 0.1 * STANDARD_GRAVITY && error < 2.0 * STANDARD_GRAVITY, "± {error}");
    let hic = HALF_SINE * 260.0_f64.powf(2.5) * 0.005;
    let (value, error) = measure(&all, "11HEAD0000H3ACRA", "hic15");
    assert!((value - hic).abs() <= error && error < 0.05 * hic, "{value} ± {error}, not {hic}");
    assert_eq!(all["channels"].as_array().unwrap().len(), 5, "the chest has one axis");
    // Their tables have the times of each.
    let results = folder.path().join("results");
    let args = ["signal", folder.path().to_str().unwrap(), "--out", results.to_str().unwrap()];
    assert_eq!(code(&run(&args)), 0);
    let tables: Vec<String> = fs::read_dir(&results)
        .unwrap()
        .map(|own| own.unwrap().file_name().into_string().unwrap())
        .filter(|own| own.strip_suffix(".csv").is_some_and(|own| own != "measures"))
        .collect();
    assert!(tables.len() > 1, "{tables:?}");
    for name in tables {
        let again = json(&["signal", results.join(&name).to_str().unwrap(), "--json"]);
        for own in again["channels"].as_array().unwrap() {
            let key = format!("{}.peak", own["name"].as_str().unwrap());
            let before = channel(&all, own["name"].as_str().unwrap());
            let [one, other] = [before, own].map(|own| number(&own["measures"][&key]["time"]));
            assert!((one - other).abs() < 1e-12, "{name}: {key} at {other} s, not at {one} s");
        }
    }
    // Of other classes no resultant is formed, and the axes say so.
    let all = write(&[
        ("11HEAD0000H3ACXA", 100.0, 20.0),
        ("11HEAD0000H3ACYA", 0.0, 20.0),
        ("11HEAD0000H3ACZC", 240.0, 20.0),
    ]);
    let own = channel(&all, "11HEAD0000H3ACZC");
    assert_eq!(own["warnings"][0]["code"].as_str(), Some("other-filter"), "{own}");
    let own = channel(&all, "11HEAD0000H3ACRA");
    assert_eq!(own["axes"], serde_json::json!(["x", "y"]));
}

#[test]
fn an_axis_of_two_channels_keeps_no_limit() {
    let folder = TempDir::new().unwrap();
    let two = |names: &[&str], heights: Vec<f64>| {
        let text = axes(names, 5.0, &|_| heights.clone());
        write(&folder, "two.csv", &text)
    };
    // 200 and 180 g of two sensors on one axis, and 170 g across: 263 or 248 g.
    let names = ["Head X", "Head Y", "Head X 2", "Head Z"];
    let path = two(&names, vec![200.0, 170.0, 180.0, 20.0]);
    let all = json(&["signal", &path, "--json"]);
    let found: Vec<&str> = all["channels"]
        .as_array()
        .unwrap()
        .iter()
        .map(|own| own["name"].as_str().unwrap())
        .collect();
    assert_eq!(found, names);
    for name in names {
        let own = channel(&all, name);
        assert_eq!(own["warnings"][0]["code"], "axis-twice", "{own}");
        assert_eq!(own["beside"].as_array().unwrap().len(), 3, "{own}");
        let (status, found) =
            judged(&["signal", &path, "--limit", &format!("{name}.peak=en-1078")]);
        assert_eq!(
            (status, &*found[0].1, &*found[0].2),
            (4, "undecided", "other-axes"),
            "{found:?}"
        );
    }
    // Alone as well, whichever way the number is written; what is named is judged.
    for name in ["Head X 2", "Head X2", "Head_X_2"] {
        let path = two(&["Head X", name], vec![300.0, 200.0]);
        let (_, found) = judged(&["signal", &path, "--limit", &format!("{name}.peak=en-1078")]);
        assert_eq!((&*found[0].1, &*found[0].2), ("undecided", "other-axes"), "{name}: {found:?}");
    }
    let named = ["Head X 2", "Head Y", "Head Z"].map(|own| ["--channel", own]).concat();
    let path = two(&names, vec![200.0, 170.0, 180.0, 20.0]);
    let own = [&["signal", &*path, "--limit", "Head.peak=en-1078"], &named[..]].concat();
    let (status, found) = judged(&own);
    assert_eq!((status, &*found[0].1), (0, "pass"), "{found:?}");
    // Two sensors of three axes each are two places.
    let six = ["A X 1", "A Y 1", "A Z 1", "A X 2", "A Y 2", "A Z 2"];
    let all = json(&["signal", &two(&six, vec![10.0, 20.0, 20.0, 20.0, 30.0, 60.0]), "--json"]);
    let peak = |name: &str| measure(&all, name, "peak").0 / STANDARD_GRAVITY;
    assert!((peak("A 1 resultant") - 30.0).abs() < 0.1, "{all}");
    assert!((peak("A 2 resultant") - 70.0).abs() < 0.1, "{all}");
}

#[test]
fn a_clipped_record_keeps_no_limit() {
    let folder = TempDir::new().unwrap();
    let text = axes(&["Kopf"], 5.0, &|_| vec![300.0]);
    let clipped: Vec<String> = text
        .lines()
        .map(|line| match line.split_once(',') {
            Some((time, value)) if value.parse::<f64>().is_ok_and(|own| own > 200.0) => {
                format!("{time},200")
            }
            _ => line.to_owned(),
        })
        .collect();
    let path = write(&folder, "clipped.csv", &clipped.join("\n"));
    let (status, found) = judged(&["signal", &path, "--limit", "Kopf.peak=en-1078"]);
    assert_eq!((status, &*found[0].1, &*found[0].2), (4, "undecided", "clipped"), "{found:?}");
    let (_, found) = judged(&["signal", &path, "--limit", "Kopf.peak<=150 g"]);
    assert_eq!(found[0].1, "fail", "{found:?}");
}
