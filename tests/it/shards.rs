//! Sweeps in shards: what `merge` makes of them is the sweep, byte by byte.

use std::{collections::BTreeMap, fs, path::Path};

use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, said, text};

/// A pad that slow drops leave whole, and fast ones press through.
pub(crate) const SOFT: &str = r#"
[values]
K = "50 kN/m"
[nodes]
head = { mass = "5 kg", velocity = "6 m/s" }
[elements]
pad = { between = ["head", "ground"], kelvin-voigt = { spring = "K", dashpot = "80 N s/m" }, thickness = "3 cm" }
[run]
duration = "40 ms"
[limits]
head.peak-acceleration = "120 g"
"#;

/// The files of a folder, but those of its writer.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let all = fs::read_dir(folder).unwrap().map(|own| own.unwrap().path());
    let all = all.map(|own| (own.file_name().unwrap().to_str().unwrap().to_owned(), own));
    let own = all.filter(|own| !own.0.starts_with(".dashpot"));
    own.map(|(name, path)| (name, fs::read(path).unwrap())).collect()
}

/// Solves so many shards of a sweep, the last one first, and returns their folders.
fn shards(sweep: &[&str], of: usize, room: &Path) -> Vec<String> {
    let one = |number: usize| {
        let folder = text(&room.join(format!("{number}-of-{of}"))).to_owned();
        let place = format!("{number}/{of}");
        let arguments = [sweep, &["--shard", &place, "--out", &folder]].concat();
        let solved = run(&arguments);
        assert_eq!(code(&solved), 0, "{}", err(&solved));
        folder
    };
    (1..=of).rev().map(one).collect()
}

fn merge(folders: &[String], options: &[&str]) -> std::process::Output {
    let folders: Vec<&str> = folders.iter().map(String::as_str).collect();
    run(&[&["merge"], &folders[..], options].concat())
}

/// The sweep as a whole, and put together from so many shards.
fn is_the_same(sweep: &[&str], counts: &[usize]) {
    let room = TempDir::new().unwrap();
    let whole = room.path().join("whole");
    let solved = run(&[sweep, &["--out", text(&whole)]].concat());
    assert_eq!(code(&solved), 0, "{}", err(&solved));
    let whole = files(&whole);
    assert!(whole.contains_key("sweep.csv") && whole.contains_key("report.html"));
    let in_json = run(&[sweep, &["--json"]].concat());
    for &of in counts {
        let folders = shards(sweep, of, room.path());
        let together = room.path().join(format!("together-{of}"));
        let merged = merge(&folders, &["--out", text(&together)]);
        assert_eq!(code(&merged), 0, "{}", err(&merged));
        let together = files(&together);
        assert!(whole.keys().eq(together.keys()), "{of}: {:?}", together.keys());
        for (name, own) in &whole {
            assert!(own == &together[name], "{name} of {of} shards");
        }
        assert!(in_json.stdout == merge(&folders, &["--json"]).stdout, "{of}");
    }
}

#[test]
fn of_a_linear_scene_shards_are_the_sweep() {
    let sweep = ["sweep", "--vary", "head.velocity=5..10 m/s,25", "--vary", "head.mass=3..8 kg,20"];
    is_the_same(&sweep, &[1, 2, 7]);
}

#[test]
fn of_a_foam_that_parts_shards_are_the_sweep() {
    let sweep = ["sweep", "scenes/instrument-drop.toml", "--vary", "instrument.mass=1..4 kg,200"];
    is_the_same(&sweep, &[2, 7]);
}

#[test]
fn of_full_runs_with_gaps_and_what_may_be_left_out_shards_are_the_sweep() {
    let sweep = ["sweep", "scenes/thesis-stop.toml", "--vary", "head.velocity=1..12 m/s,70"];
    is_the_same(&sweep, &[2]);
    let sweep = ["sweep", "scenes/padding-mass.toml", "--vary", "head.velocity=1..6 m/s,70"];
    is_the_same(&[&sweep[..], &["--neglect", "1%"]].concat(), &[2]);
}

#[test]
fn warnings_that_begin_within_a_shard_are_told_as_of_the_sweep() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "soft.toml", SOFT);
    let sweep = ["sweep", text(&scene), "--vary", "head.velocity=0.5..9 m/s,300"];
    is_the_same(&sweep, &[7, 100]);
    let report = json(&[&sweep[..], &["--json"]].concat());
    let warnings = report["warnings"].as_array().unwrap();
    let first = |own: &serde_json::Value| own["points"][0].as_u64().unwrap();
    assert!(warnings.iter().any(|own| first(own) > 64), "{warnings:?}");
    let folders = shards(&sweep, 3, room.path());
    let enforced = merge(&folders, &["--enforce"]);
    assert_eq!(code(&enforced), 4, "{}", err(&enforced));
    assert_eq!(out(&enforced), out(&run(&sweep)));
}

#[test]
fn a_shard_that_is_whole_is_left_and_others_are_refused_by_name() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "soft.toml", SOFT);
    let sweep = ["sweep", text(&scene), "--vary", "head.velocity=0.5..9 m/s,300"];
    let folders = shards(&sweep, 3, room.path());
    let before = files(Path::new(&folders[2]));
    let again = run(&[&sweep[..], &["--shard", "1/3", "--out", &folders[2]]].concat());
    assert_eq!(code(&again), 0, "{}", err(&again));
    assert!(said(&again).contains("nothing is solved"), "{}", err(&again));
    assert_eq!(files(Path::new(&folders[2])), before);

    // Another one there.
    let other = run(&[&sweep[..], &["--shard", "2/3", "--out", &folders[2]]].concat());
    assert_eq!(code(&other), 2);
    assert!(said(&other).contains("1-of-3`: there are points of another"), "{}", err(&other));

    // One that is gone, one that is there twice, and one of another sweep.
    let gone = merge(&folders[..2], &[]);
    assert_eq!(code(&gone), 2);
    assert!(said(&gone).contains("1 shard of 3 is missing: 1"), "{}", err(&gone));
    let twice = merge(&[&folders[..], &folders[..1]].concat(), &[]);
    assert!(said(&twice).contains("3-of-3`: its shard is there twice"), "{}", err(&twice));
    let apart = ["sweep", text(&scene), "--vary", "head.velocity=0.5..9 m/s,301"];
    let apart = shards(&apart, 1, room.path());
    let foreign = merge(&[&folders[..], &apart[..]].concat(), &[]);
    assert!(said(&foreign).contains("1-of-1`: its shard is of another sweep"), "{}", err(&foreign));
    let none = merge(&[text(room.path()).to_owned()], &[]);
    assert_eq!(code(&none), 2);
    assert!(said(&none).contains("there is no shard of a sweep in it"), "{}", err(&none));

    // Broken values are refused, and not written over unless they are removed.
    let values = Path::new(&folders[0]).join("values.f64");
    let mut bytes = fs::read(&values).unwrap();
    bytes[9] ^= 1;
    fs::write(&values, bytes).unwrap();
    let broken = merge(&folders, &[]);
    assert_eq!(code(&broken), 2);
    assert!(
        said(&broken).contains("3-of-3`: `values.f64` of its shard is not"),
        "{}",
        err(&broken)
    );
    fs::remove_dir_all(&folders[0]).unwrap();
    let solved = run(&[&sweep[..], &["--shard", "3/3", "--out", &folders[0]]].concat());
    assert_eq!(code(&solved), 0, "{}", err(&solved));
    assert_eq!(out(&merge(&folders, &[])), out(&run(&sweep)));

    // Another scene by now.
    fs::write(&scene, SOFT.replace("3 cm", "4 cm")).unwrap();
    let changed = merge(&folders, &[]);
    assert_eq!(code(&changed), 2);
    assert!(said(&changed).contains("has changed since its shard was solved"), "{}", err(&changed));
}

#[test]
fn places_that_are_none_are_refused() {
    let sweep = ["sweep", "--vary", "head.velocity=5..10 m/s,25", "--out", "nowhere", "--shard"];
    for (place, reason) in
        [("0/3", "counted from 1"), ("4/3", "such as 3/10"), ("a", "such as 3/10")]
    {
        let refused = run(&[&sweep[..], &[place]].concat());
        assert_eq!(code(&refused), 2);
        assert!(said(&refused).contains(reason), "{place}: {}", err(&refused));
    }
    let nowhere = run(&["sweep", "--vary", "head.velocity=5..10 m/s,25", "--shard", "1/3"]);
    assert_eq!(code(&nowhere), 2);
    assert!(said(&nowhere).contains("--out"), "{}", err(&nowhere));
}

/// Each flipped bit of the result of a shard is seen before anything of it is believed.
#[test]
fn a_result_of_a_shard_that_is_not_as_it_was_written_is_refused() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "soft.toml", SOFT);
    let sweep = ["sweep", text(&scene), "--vary", "head.velocity=0.5..9 m/s,130"];
    let folders = shards(&sweep, 2, room.path());
    let result = Path::new(&folders[0]).join("result.json");
    let whole = fs::read(&result).unwrap();
    let expected = out(&merge(&folders, &["--json"]));
    let refused = |bytes: &[u8], what: &str| {
        fs::write(&result, bytes).unwrap();
        let merged = merge(&folders, &["--json"]);
        assert_eq!((code(&merged), out(&merged).as_str()), (2, ""), "{what}: {}", err(&merged));
        let named = said(&merged).contains("2-of-2`: `result.json` of its shard is not as it was");
        assert!(named || said(&merged).contains("no shard of a sweep"), "{what}: {}", err(&merged));
    };
    for at in (0..whole.len()).step_by(whole.len() / 60) {
        let mut bytes = whole.clone();
        bytes[at] ^= 1 << (at % 7);
        refused(&bytes, &format!("bit {} of byte {at}", at % 7));
    }
    let text = String::from_utf8(whole.clone()).unwrap();
    for (from, to) in [
        (
            "\"gaps\": []",
            "\"gaps\": [{\"point\":100,\"column\":1000000000,\"reason\":\"x\",\"is_infinite\":false}]",
        ),
        ("\"end\": 130", "\"end\": 10000000000"),
        ("\"of\": 2", "\"of\": 4000000000"),
    ] {
        assert!(text.contains(from), "{from}");
        refused(text.replace(from, to).as_bytes(), from);
    }
    fs::write(&result, &whole).unwrap();
    assert_eq!(out(&merge(&folders, &["--json"])), expected);
}

/// What may be left out takes time to find out; how much does not stand in what is compared.
#[test]
fn what_is_left_out_is_told_without_a_clock() {
    let room = TempDir::new().unwrap();
    let sweep =
        ["sweep", "reference-gravity", "--vary", "head.velocity=12..16 m/s,9", "--neglect", "1%"];
    let folder = room.path().join("out");
    let swept = run(&[&sweep[..], &["--out", text(&folder)]].concat());
    let page = fs::read_to_string(folder.join("report.html")).unwrap();
    for text in [said(&swept), out(&swept).split_whitespace().collect::<Vec<_>>().join(" "), page] {
        let told = text.find("left out everywhere: gravity").map(|at| &text[at..]);
        let told = told.and_then(|own| own.split(['<', '\n']).next()).unwrap_or_default();
        assert!(!told.contains("takes about"), "{told}");
    }
    is_the_same(&sweep, &[1]);
}
