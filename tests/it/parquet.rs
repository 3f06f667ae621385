//! Sweeps written as Parquet while they are solved: the numbers of the table, in parts that come to the same whole
//! after an interruption.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    fs::File,
    path::Path,
};
#[cfg(unix)]
use std::{
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::Field,
};
use tempfile::TempDir;

use crate::{
    cli::{code, err, file, json, out, run, said, text},
    shards::SOFT,
};

/// The headings and the cells of all rows of some files; blank where there is nothing.
fn rows(files: &[String]) -> (Vec<String>, Vec<Vec<String>>) {
    let (mut header, mut all) = (Vec::new(), Vec::new());
    for file in files {
        let reader = SerializedFileReader::new(File::open(file).unwrap()).unwrap();
        assert_eq!(reader.metadata().num_row_groups(), 1);
        for row in reader.get_row_iter(None).unwrap() {
            let row = row.unwrap();
            header = row.get_column_iter().map(|own| own.0.clone()).collect();
            let cell = |own: &Field| match own {
                Field::Double(value) => format!("{:016x}", value.to_bits()),
                Field::Str(word) => word.clone(),
                _ => String::new(),
            };
            all.push(row.get_column_iter().map(|own| cell(own.1)).collect());
        }
    }
    (header, all)
}

fn parquet_files(folder: &Path) -> Vec<String> {
    let all = fs::read_dir(folder).unwrap().map(|own| own.unwrap().path());
    let own = all.filter(|own| own.extension().is_some_and(|end| end == "parquet"));
    let mut own: Vec<String> = own.map(|own| text(&own).to_owned()).collect();
    own.sort();
    own
}

/// The table of the same sweep as CSV, its numbers by their bits.
fn of_csv(csv: &str, is_of_words: impl Fn(&str) -> bool) -> (Vec<String>, Vec<Vec<String>>) {
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let cell = |(name, own): (&String, &str)| match own {
        "" => String::new(),
        own if is_of_words(name) => own.to_owned(),
        own => format!("{:016x}", own.parse::<f64>().unwrap().to_bits()),
    };
    let rows = reader.records().map(|own| header.iter().zip(&own.unwrap()).map(cell).collect());
    let rows = rows.collect();
    (header, rows)
}

#[test]
fn the_numbers_are_those_of_the_table_to_the_bit() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "soft.toml", SOFT);
    let sweep = [
        "sweep",
        text(&scene),
        "--vary",
        "head.velocity=0.5..9 m/s,90",
        "--vary",
        "K=20,50,90 kN/m",
    ];
    let folder = room.path().join("points");
    let written = run(&[&sweep[..], &["--parquet", "--out", text(&folder)]].concat());
    assert_eq!(code(&written), 0, "{}", err(&written));
    let told = out(&written).split_whitespace().collect::<Vec<_>>().join(" ");
    let first =
        "warning `pulls` at 180 of 270 points, first at head.velocity = 0.5 m/s, K = 50 kN/m:";
    assert!(told.contains(first), "{told}");
    let (mut header, mut found) = rows(&parquet_files(&folder));
    let table = run(&[&sweep[..], &["--table", "never"]].concat());
    let is_limit = |name: &str| name.contains("<=");
    let (mut wanted_header, mut wanted) =
        of_csv(std::str::from_utf8(&table.stdout).unwrap(), |name| {
            name == "warnings" || is_limit(name)
        });
    assert_eq!(header.pop().as_deref(), Some("missing"));
    assert_eq!(header, wanted_header);
    // The table has the numbers of the warnings, the files their codes.
    let report = json(&[&sweep[..], &["--json"]].concat());
    let codes: Vec<&str> = report["warnings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|own| own["code"].as_str().unwrap())
        .collect();
    let told = |numbers: &str| {
        let codes = numbers.split_whitespace().map(|own| codes[own.parse::<usize>().unwrap() - 1]);
        codes.collect::<Vec<_>>().join("; ")
    };
    assert!(wanted_header.pop().is_some() && codes.len() > 1);
    let mut missing = vec![Vec::new(); found.len()];
    for gap in report["gaps"].as_array().unwrap() {
        let word = |key: &str| gap[key].as_str().unwrap();
        let point = usize::try_from(gap["point"].as_u64().unwrap()).unwrap();
        missing[point].push(format!("{}: {}", word("measure"), word("reason")));
    }
    assert!(missing.iter().any(|own| !own.is_empty()));
    for ((own, wanted), missing) in found.iter_mut().zip(&mut wanted).zip(&missing) {
        assert_eq!(own.pop(), Some(missing.join("; ")));
        let last = wanted.pop().unwrap();
        wanted.push(told(&last));
        assert_eq!(own, wanted);
    }
    assert_eq!(found.len(), 270);

    // What is known of all points is what the report says of them.
    let result: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.join("result.json")).unwrap()).unwrap();
    assert_eq!(result["points"], 270);
    assert_eq!(result["instantiated"], report["instantiated"]);
    let mut counts = BTreeMap::new();
    for own in report["limits"][0]["verdicts"].as_array().unwrap() {
        *counts.entry(own.as_str().unwrap()).or_insert(0) += 1;
    }
    for (word, count) in counts {
        assert_eq!(result["limits"][0]["points"][word], count, "{word}");
    }
    let values = report["measures"][0]["values"].as_array().unwrap();
    let values = values.iter().map(|own| own.as_f64().unwrap());
    assert_eq!(result["measures"][0]["highest"], values.fold(0.0, f64::max));
    let enforced = run(&[&sweep[..], &["--parquet", "--enforce", "--out", text(&folder)]].concat());
    assert_eq!(code(&enforced), 4, "{}", err(&enforced));
}

/// Both pads pull at the same points, which count once.
#[test]
fn a_point_with_two_warnings_of_a_kind_is_one_point() {
    let room = TempDir::new().unwrap();
    let pads = "pad = { between = [\"head\", \"ground\"], kelvin-voigt = { spring = \"60 kN/m\", dashpot = \"80 N s/m\" } }
side = { between = [\"head\", \"ground\"], kelvin-voigt = { spring = \"K\", dashpot = \"80 N s/m\" } }";
    let (before, rest) = SOFT.split_once("pad = ").unwrap();
    let (_, after) = rest.split_once('\n').unwrap();
    let scene = file(&room, "two.toml", &format!("{before}{pads}\n{after}"));
    let sweep =
        ["sweep", text(&scene), "--vary", "head.velocity=0.5..9 m/s,30", "--vary", "K=1,20 kN/m"];
    let report = json(&[&sweep[..], &["--json"]].concat());
    let pulling =
        report["warnings"].as_array().unwrap().iter().filter(|own| own["code"] == "pulls");
    let points: Vec<u64> = pulling
        .flat_map(|own| own["points"].as_array().unwrap())
        .map(|own| own.as_u64().unwrap())
        .collect();
    let once = points.iter().collect::<BTreeSet<_>>().len();
    assert!(0 < once && once < points.len(), "{points:?}");
    let folder = room.path().join("points");
    let written = run(&[&sweep[..], &["--parquet", "--out", text(&folder)]].concat());
    assert_eq!(code(&written), 0, "{}", err(&written));
    let result: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(folder.join("result.json")).unwrap()).unwrap();
    let told = result["warnings"].as_array().unwrap().iter().find(|own| own["code"] == "pulls");
    assert_eq!(told.unwrap()["points"], once);
}

/// Three files, of which the middle one is taken away: it is solved again, to the byte, and the others are not touched.
#[test]
fn what_is_missing_is_solved_again_and_all_else_is_left() {
    let room = TempDir::new().unwrap();
    let sweep = [
        "sweep",
        "--vary",
        "padding.maxwell.spring=5..80 MN/m,100",
        "--vary",
        "padding.kelvin.dashpot=1..16 kN s/m,100",
        "--measure",
        "padding.peak-force",
        "--estimate",
        "off",
        "--parquet",
    ];
    let folder = room.path().join("points");
    let whole = [&sweep[..], &["--out", text(&folder)]].concat();
    let written = run(&whole);
    assert_eq!(code(&written), 0, "{}", err(&written));
    let all = parquet_files(&folder);
    let bytes = || all.iter().map(|own| fs::read(own).unwrap()).collect::<Vec<_>>();
    let (before, times) =
        (bytes(), all.iter().map(|own| fs::metadata(own).unwrap().modified().unwrap()));
    let (times, result): (Vec<_>, _) =
        (times.collect(), fs::read(folder.join("result.json")).unwrap());
    assert_eq!(all.len(), 3);
    fs::remove_file(&all[1]).unwrap();
    let again = run(&whole);
    assert_eq!(code(&again), 0, "{}", err(&again));
    assert!(said(&again).contains("2 of 3 files are there, whole"), "{}", err(&again));
    assert!(bytes() == before && fs::read(folder.join("result.json")).unwrap() == result);
    assert_eq!(fs::metadata(&all[0]).unwrap().modified().unwrap(), times[0]);

    // Another sweep is refused, and whatever else would replace the points.
    let replacing = run(&["run", "--out", text(&folder)]);
    assert_eq!(code(&replacing), 2);
    assert!(said(&replacing).contains("points of another") && bytes() == before);
    let other = run(&[&sweep[..3], &["--parquet", "--out", text(&folder)]].concat());
    assert_eq!(code(&other), 2);
    assert!(said(&other).contains("points of another"), "{}", err(&other));
    let differing = "vary (there padding.maxwell.spring=5..80 MN/m,100; padding.kelvin.dashpot=1..16 kN s/m,100, here";
    assert!(said(&other).contains(differing), "{}", err(&other));
    let part = run(&[&sweep[..], &["--shard", "1/2", "--out", text(&folder)]].concat());
    assert_eq!(code(&part), 2);
    let differing = "or shard in it, which differs in shard (there all, here 1/2)";
    assert!(said(&part).contains(differing), "{}", err(&part));
    // A file that is broken is named, and nothing is written over it.
    fs::write(&all[2], &before[2][..5000]).unwrap();
    let broken = run(&whole);
    assert_eq!(code(&broken), 2);
    assert!(said(&broken).contains(&all[2]), "{}", err(&broken));
}

#[test]
fn the_files_of_shards_are_parts_of_the_whole() {
    let room = TempDir::new().unwrap();
    let sweep = ["sweep", "--vary", "head.velocity=5..10 m/s,300", "--parquet"];
    let points = |name: &str, more: &[&str]| {
        let folder = room.path().join(name);
        let solved = run(&[&sweep[..], more, &["--out", text(&folder)]].concat());
        assert_eq!(code(&solved), 0, "{}", err(&solved));
        rows(&parquet_files(&folder)).1
    };
    let whole = points("whole", &[]);
    assert_eq!(whole.len(), 300);
    assert!([points("1", &["--shard", "1/2"]), points("2", &["--shard", "2/2"])].concat() == whole);
}

/// An interrupt leaves the files that are whole, and tells how many points are in them.
#[cfg(unix)]
#[test]
fn an_interrupt_tells_what_is_kept() {
    let room = TempDir::new().unwrap();
    let folder = room.path().join("points");
    let mut child = Command::new(env!("CARGO_BIN_EXE_dashpot"))
        .args(["sweep", "--vary", "padding.maxwell.spring=5..80 MN/m,1000"])
        .args(["--vary", "padding.kelvin.dashpot=1..16 kN s/m,1000", "--estimate", "off"])
        .args(["--parquet", "--threads", "1", "--out", text(&folder)])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    while !folder.exists() || parquet_files(&folder).is_empty() {
        assert!(child.try_wait().unwrap().is_none());
        sleep(Duration::from_millis(5));
    }
    let pid = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
    let ended = child.wait_with_output().unwrap();
    assert_eq!(code(&ended), 1, "{}", err(&ended));
    let kept = rows(&parquet_files(&folder)).1.len();
    assert!((1..1_000_000).contains(&kept));
    let told = said(&ended);
    assert!(told.contains(&format!("interrupted: {kept} of 1000000 points are kept")), "{told}");
    assert!(told.contains("the same command goes on from there"), "{told}");
    assert!(!folder.join("result.json").exists());
}

#[test]
fn words_do_not_stand_under_headings_of_the_results() {
    let room = TempDir::new().unwrap();
    let table = file(&room, "designs.csv", "warnings,head.velocity [m/s]\na,5\nb,6\n");
    let folder = room.path().join("points");
    let out = ["--parquet", "--out", text(&folder)];
    let refused = run(&[&["sweep", "--points", text(&table)], &out[..]].concat());
    assert_eq!(code(&refused), 2, "{}", err(&refused));
    assert!(said(&refused).contains("a column `warnings` of their own"), "{}", err(&refused));
    assert!(!folder.exists());
}

/// A damaged summary is named, not the points beside it; without it the sweep goes on from them.
#[test]
fn a_damaged_summary_is_named_and_one_that_is_gone_is_written_again() {
    let room = TempDir::new().unwrap();
    let (scene, folder) = (file(&room, "soft.toml", SOFT), room.path().join("points"));
    let sweep = ["sweep", text(&scene), "--vary", "head.velocity=0.5..9 m/s,100", "--parquet"];
    let swept = || run(&[&sweep[..], &["--out", text(&folder)]].concat());
    assert_eq!(code(&swept()), 0);
    let result = folder.join("result.json");
    let whole = fs::read(&result).unwrap();
    fs::write(&result, &whole[1..]).unwrap();
    let refused = swept();
    assert_eq!(code(&refused), 2);
    assert!(said(&refused).contains("result.json"), "{}", err(&refused));
    assert!(!said(&refused).contains("points-00000001"), "{}", err(&refused));
    fs::remove_file(&result).unwrap();
    let again = swept();
    assert_eq!(code(&again), 0, "{}", err(&again));
    assert!(said(&again).contains("1 of 1 files are there, whole"), "{}", err(&again));
    assert_eq!(fs::read(&result).unwrap(), whole);
}
