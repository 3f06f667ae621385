//! No option of `signal` is ignored: each, on each kind of channel, changes what is said or is refused by name. And what
//! would take memory or time without end is refused before it is begun.

use std::{f64::consts::PI, fmt::Write as _, fs, time::Instant};

use tempfile::TempDir;

use crate::cli::{code, err, file, out, run};

/// A half-sine of 10 ms from 0 on, at 5 kHz, in each of some columns with its height; behind the first sample that is
/// more than zero uneven by a tenth of a step where that is wanted.
fn table(columns: &[(&str, f64)]) -> String {
    let names: Vec<&str> = columns.iter().map(|own| own.0).collect();
    let mut text = format!("t [ms],{}\n", names.join(","));
    for at in 0..=200 {
        let time = f64::from(at) * 0.2 - 10.0;
        let value = if (0.0..=10.0).contains(&time) { (0.1 * PI * time).sin() } else { 0.0 };
        let values = columns.iter().map(|own| format!("{:.7}", own.1 * value + 1e-3 * own.1));
        writeln!(text, "{time:.1},{}", values.collect::<Vec<_>>().join(",")).unwrap();
    }
    text
}

/// What an option does to a kind of file.
#[derive(Debug, PartialEq, Clone, Copy)]
enum Does {
    /// It changes what is said.
    Something,
    /// It is refused, by its name.
    Refused,
}

/// Kinds of files: an acceleration, a force, both, a force and a displacement, three axes, a velocity, a displacement, a
/// column without a unit.
const KINDS: [(&str, &[(&str, f64)]); 8] = [
    ("acceleration", &[("acc [g]", 100.0)]),
    ("force", &[("F [N]", 4000.0)]),
    ("both", &[("acc [g]", 100.0), ("F [N]", 4000.0)]),
    ("loop", &[("F [N]", 4000.0), ("x [mm]", 12.0)]),
    ("axes", &[("Head X [g]", 60.0), ("Head Z [g]", 80.0)]),
    ("velocity", &[("v [m/s]", 3.0)]),
    ("displacement", &[("x [mm]", 12.0)]),
    ("no-unit", &[("acc", 100.0)]),
];

/// The option, a base of others, the option with its value, and what it does to each kind of record.
type Row = (&'static str, Vec<&'static str>, Vec<&'static str>, [Does; 8]);

#[test]
fn every_option_does_something_or_is_refused_by_name() {
    use Does::{Refused as N, Something as Y};
    let folder = TempDir::new().unwrap();
    let with = |more: &[&'static str]| more.to_vec();
    let velocity = ["--velocity", "3.2 m/s"];
    let mass = ["--velocity", "3.2 m/s", "--mass", "4 kg"];
    // The options, the name of the one that is looked at, and what it does to each kind: acceleration, force, both, loop,
    // axes, velocity, displacement, no unit. A base of options stands beside where the option needs others.
    let rows: Vec<Row> = vec![
        ("--velocity", with(&[]), with(&velocity), [Y, N, Y, N, N, N, N, Y]),
        ("--velocity", with(&[]), with(&mass), [Y, Y, Y, Y, N, N, N, Y]),
        ("--mass", with(&velocity), with(&["--mass", "4 kg"]), [Y, Y, Y, Y, N, N, N, Y]),
        ("--mass", with(&[]), with(&["--mass", "4 kg"]), [N; 8]),
        ("--falls", with(&mass), with(&["--falls"]), [Y, Y, Y, Y, N, N, N, Y]),
        ("--falls", with(&[]), with(&["--falls"]), [N; 8]),
        ("--touch", with(&mass), with(&["--touch", "0.1 ms"]), [Y, Y, Y, Y, N, N, N, Y]),
        ("--touch", with(&[]), with(&["--touch", "0.1 ms"]), [N; 8]),
        ("--guided", with(&[]), with(&["--guided", "z"]), [N, N, N, N, Y, N, N, N]),
        ("--displacement", with(&[]), with(&["--displacement", "x"]), [N, N, N, Y, N, N, N, N]),
        ("--padding", with(&[]), with(&["--padding", "zero"]), [N; 8]),
        ("--padding", with(&["--cfc", "180"]), with(&["--padding", "zero"]), [Y; 8]),
        ("--cfc", with(&[]), with(&["--cfc", "180"]), [Y; 8]),
        ("--invert", with(&[]), with(&["--invert"]), [Y; 8]),
        ("--rate", with(&[]), with(&["--rate", "20 kHz"]), [Y; 8]),
        ("--from", with(&[]), with(&["--from", "4 ms"]), [Y; 8]),
        ("--to", with(&[]), with(&["--to", "4 ms"]), [Y; 8]),
        ("--offset", with(&[]), with(&["--offset", "auto"]), [Y; 8]),
        ("--offset", with(&[]), with(&["--offset", "1 g"]), [Y, N, N, N, Y, N, N, Y]),
        ("--offset", with(&[]), with(&["--offset", "1 N"]), [N, Y, N, Y, N, N, N, N]),
        ("--channel", with(&[]), with(&["--channel", "3"]), [N, N, Y, Y, Y, N, N, N]),
        ("--units", with(&[]), with(&["--units", "ms,m/s^2"]), [N, N, N, N, N, N, N, Y]),
        ("--units", with(&[]), with(&["--units", "s"]), [N; 8]),
        ("--units", with(&[]), with(&["--units", ",g,g,g"]), [N; 8]),
        ("--enforce", with(&[]), with(&["--enforce"]), [N; 8]),
        ("--limit", with(&[]), with(&["--limit", "nosuch.peak<=1 g"]), [N; 8]),
    ];
    for (at, (kind, columns)) in KINDS.iter().enumerate() {
        let path = file(&folder, &format!("{kind}.csv"), &table(columns));
        let path = path.to_str().unwrap().to_owned();
        let read = |options: &[&str]| {
            let output = run(&[&["signal", &path, "--json"], options].concat());
            (code(&output), out(&output), err(&output))
        };
        for (name, base, options, does) in &rows {
            // Without a unit nothing is read: `--units` says it beside what is looked at, unless that is itself one.
            let units: &[&str] =
                if *kind == "no-unit" && *name != "--units" { &["--units", "ms,g"] } else { &[] };
            let (_, before, _) = read(&[units, base].concat());
            let (status, found, told) = read(&[units, base, options].concat());
            match does[at] {
                Does::Refused => {
                    assert_eq!(status, 2, "{kind} {options:?}: {found}");
                    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
                    // What wants another option names that, and a name that is not there is said itself.
                    let others = ["--velocity", "--cfc", "`nosuch", "`3`", "`x`"];
                    let is_named =
                        told.contains(name) || others.iter().any(|own| told.contains(own));
                    assert!(is_named, "{kind} {options:?}: {told}");
                }
                Does::Something => {
                    assert_eq!(status, 0, "{kind} {options:?}: {told}");
                    // Only the verdicts of limits are guided; the only displacement is taken in any case.
                    let is_silent = ["--guided", "--displacement"].contains(name);
                    assert!(is_silent || before != found, "{kind} {options:?}");
                }
            }
        }
    }
}

#[test]
fn rates_classes_and_lengths_have_limits_that_come_before_the_work() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "drop.csv", &table(&[("acc [g]", 100.0)]));
    let path = path.to_str().unwrap();
    for (options, words) in [
        (["--rate", "1 THz"], "4.000e10 samples"),
        (["--rate", "1 GHz"], "4.000e7 samples"),
        (["--rate", "1e300 Hz"], "samples"),
        (["--cfc", "1e-9"], "1e7 are kept"),
        (["--cfc", "1e-300"], "1e7 are kept"),
    ] {
        let begun = Instant::now();
        let output = run(&[&["signal", path], &options[..]].concat());
        let told = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(code(&output), 2, "{options:?}: {told}");
        assert!(told.contains(words), "{options:?}: {told}");
        assert!(begun.elapsed().as_secs() < 5, "{options:?}");
    }
}

/// The checksum of a zip.
fn checksum(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 * (sum & 1)))
    })
}

/// A zip of so many entries of one content that is stored, all over one another or each for itself.
fn zip(content: &[u8], count: u16, is_over: bool) -> Vec<u8> {
    let length = u32::try_from(content.len()).unwrap();
    let (mut zip, mut central) = (Vec::new(), Vec::new());
    for at in 0..count {
        let name = format!("t/x.{at:03}");
        let mut about =
            [20_u16, 0, 0, 0, 0x21].iter().flat_map(|own| own.to_le_bytes()).collect::<Vec<u8>>();
        for own in [checksum(content), length, length] {
            about.extend(own.to_le_bytes());
        }
        about.extend([u8::try_from(name.len()).unwrap(), 0, 0, 0]);
        let start = if is_over { 0 } else { u32::try_from(zip.len()).unwrap() };
        if at == 0 || !is_over {
            zip.extend([b"PK\x03\x04", &about[..], name.as_bytes(), content].concat());
        }
        central.extend([b"PK\x01\x02\x14\x00", &about[..], &[0; 10]].concat());
        central.extend(start.to_le_bytes());
        central.extend(name.as_bytes());
    }
    let begin = u32::try_from(zip.len()).unwrap();
    let size = u32::try_from(central.len()).unwrap();
    zip.extend(central);
    zip.extend(b"PK\x05\x06\0\0\0\0");
    zip.extend([count.to_le_bytes(), count.to_le_bytes()].concat());
    zip.extend([size.to_le_bytes(), begin.to_le_bytes()].concat());
    zip.extend([0, 0]);
    zip
}

#[test]
fn entries_of_a_zip_that_lie_over_one_another_are_refused() {
    let folder = TempDir::new().unwrap();
    let mut text = "Name of the channel :H\nChannel code :11HEAD0000H3ACXA\nUnit :g\n\
         Sampling interval :0.0001\nTime of first sample :0\n"
        .to_owned();
    [0, 0, 40, 80, 40, 0, 0].iter().for_each(|own| writeln!(text, "{own}").unwrap());
    let path = folder.path().join("test.zip");
    fs::write(&path, zip(text.as_bytes(), 3, false)).unwrap();
    let output = run(&["signal", path.to_str().unwrap()]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    fs::write(&path, zip(text.as_bytes(), 3, true)).unwrap();
    let output = run(&["signal", path.to_str().unwrap()]);
    assert_eq!(code(&output), 2, "{}", out(&output));
    assert!(err(&output).contains("over another"), "{}", err(&output));
    // A test of more samples than the limit, in channels of 2.5 million each.
    let many = text.clone() + &"0\n".repeat(2_500_000);
    for at in 1..=5 {
        fs::write(folder.path().join(format!("many.{at:03}")), &many).unwrap();
    }
    let output = run(&["signal", folder.path().to_str().unwrap()]);
    assert_eq!(code(&output), 2, "{}", out(&output));
    assert!(err(&output).contains("10000000 samples"), "{}", err(&output));
}

#[cfg(target_os = "linux")]
#[test]
fn what_has_no_end_is_not_waited_for() {
    // A file without a length whose end never comes is there only for who may read it.
    let endless = "/proc/kmsg";
    if fs::File::open(endless).is_err() {
        eprintln!("skipped: {endless} cannot be read");
        return;
    }
    let folder = TempDir::new().unwrap();
    let scene = format!(
        "nodes.head = {{ mass = \"4 kg\", acceleration = {{ table = {{ file = \"{endless}\" }} }} }}\n\
         measures.head = [\"hic15\"]\nrun.duration = \"20 ms\"\n"
    );
    let scene = file(&folder, "scene.toml", &scene);
    for args in [
        vec!["signal", endless],
        vec!["run", scene.to_str().unwrap()],
        vec!["run", endless],
        vec!["run", "reference", "--measured", endless],
    ] {
        let output = run(&args);
        assert_eq!(code(&output), 2, "{args:?}: {}", out(&output));
    }
}

#[test]
fn what_is_written_wrongly_is_told_with_what_to_write() {
    let folder = TempDir::new().unwrap();
    let path = file(&folder, "a.csv", &table(&[("acc [g]", 100.0)]));
    let path = path.to_str().unwrap();
    let told = |args: &[&str]| {
        let output = run(&[&["signal", path], args].concat());
        (code(&output), err(&output).split_whitespace().collect::<Vec<_>>().join(" "))
    };
    let (status, text) = told(&["--offset", "yes"]);
    assert!(status == 2 && text.contains("neither `auto` nor a value"), "{text}");
    let (status, text) = told(&["--velocity", "-5.6 m/s"]);
    assert!(status == 2 && text.contains("whichever way the peak points"), "{text}");
    let (status, text) = told(&["--filter", "200 Hz"]);
    assert!(status == 2 && text.contains("write 60, 180, 600 or 1000"), "{text}");
}

/// A magnitude that was recorded is integrated as if all of it slowed the body down.
#[test]
fn what_no_impact_does_is_a_warning_wherever_it_is_told() {
    let folder = TempDir::new().unwrap();
    let mut text = "t [ms],|a| [g]\n".to_owned();
    for at in 0..800 {
        let time = 0.05 * f64::from(at) - 10.0;
        let own = if time > 0.0 { 80.0 * (0.6 * time).sin().abs() } else { 0.0 };
        writeln!(text, "{time:.2},{own:.6}").unwrap();
    }
    let path = file(&folder, "a.csv", &text);
    let (path, pages) = (path.to_str().unwrap(), folder.path().join("out"));
    let output = run(&[
        "signal",
        path,
        "--velocity",
        "4 m/s",
        "--mass",
        "5 kg",
        "--out",
        pages.to_str().unwrap(),
    ]);
    let text = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.starts_with("! ") && text.contains("which no impact does"), "{text}");
    let page = fs::read_to_string(pages.join("report.html")).unwrap();
    assert!(page.contains("which no impact does"));
    let result = fs::read_to_string(pages.join("result.json")).unwrap();
    assert!(result.contains("\"gains-energy\""));
    // The same beside a run.
    let scene = "[nodes]\nhead = { mass = \"5 kg\", velocity = \"4 m/s\" }\n[elements]\n\
                 pad = { between = [\"head\", \"ground\"], spring = \"60 kN/m\" }\n\
                 [effects]\nseparation.pad = {}\n[run]\nduration = \"40 ms\"\n";
    let scene = file(&folder, "pad.toml", scene);
    let measured = format!("{path}:head.acceleration");
    let args = ["run", scene.to_str().unwrap(), "--measured", &measured];
    let output = run(&args);
    assert!(out(&output).contains("which no impact"), "{}", out(&output));
    let own = crate::cli::json(&[&args[..], &["--json"]].concat());
    assert!(own.to_string().contains("gains-energy"), "{own}");
}

/// A limit in what its measure is not would be compared by its number in SI units.
#[test]
fn a_limit_of_another_dimension_is_refused_with_both() {
    let folder = TempDir::new().unwrap();
    let columns =
        [("acc [g]", 150.0), ("F [N]", 4e3), ("v [m/s]", 3.0), ("x [mm]", 12.0), ("p [kPa]", 90.0)];
    let path = file(&folder, "a.csv", &table(&columns));
    let path = path.to_str().unwrap();
    let judged = |limit: &str, more: &[&str]| {
        let channel = ["--channel", limit.split_once('.').unwrap().0];
        let args = ["signal", path, "--limit", limit, "--enforce"];
        let output = run(&[&args[..], &channel, more].concat());
        let told = format!("{}{}", out(&output), err(&output));
        (code(&output), told.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    for (limit, words) in [
        (
            "acc.peak<=250 kN",
            "`acc.peak` is an acceleration, in g or m/s^2, and `250 kN` is a force",
        ),
        ("acc.peak<=250 mm", "and `250 mm` is a length"),
        ("acc.peak<=250 kPa", "and `250 kPa` is a pressure"),
        ("acc.peak>=0.1 m/s", "and `0.1 m/s` is a velocity"),
        (
            "acc.peak=en-1621-1-level-1",
            "`en-1621-1-level-1` (EN 1621-1:2012, level 1) limits a force",
        ),
        ("F.peak<=900 g", "`F.peak` is a force, in N or kN, and `900 g` is an acceleration"),
        ("F.peak=en-1078", "`en-1078` (EN 1078:2012) limits an acceleration"),
        ("v.peak<=900 g", "`v.peak` is a velocity, in m/s, and"),
        ("x.peak<=900 g", "`x.peak` is a length, in m or mm, and"),
        ("p.peak<=900 g", "`p.peak` is a pressure, in Pa, and"),
        ("acc.hic15<=10 ms", "`hic15` is an index, which has no unit; `10 ms` has one"),
        ("acc.severity-index<=10 ms", "is an index"),
        ("acc.hic15=en-1078", "`en-1078` is a limit on `peak-acceleration`"),
        ("acc.peak<=en-1078", "`en-1078` is a standard: write `acc.peak=en-1078`"),
        ("acc.clip-3ms<=80 kN", "`80 kN` is a force"),
        ("acc.clip-3ms-at-once<=80 kN", "`80 kN` is a force"),
        ("acc.velocity-change<=80 kN", "`80 kN` is a force"),
        ("acc.contact-time<=80 kN", "`80 kN` is a force"),
        ("F.impulse<=80 kN", ""),
    ] {
        let (status, told) = judged(limit, &[]);
        assert!(status == 2 && told.contains(words), "{limit}: {status}, {told}");
    }
    let motion = ["--velocity", "3 m/s", "--mass", "5 kg"];
    for word in ["peak-displacement", "coefficient-of-restitution"] {
        let (status, told) = judged(&format!("acc.{word}<=80 kN"), &motion);
        assert!(status == 2 && told.contains("force"), "{word}: {status}, {told}");
    }
    for limit in ["acc.peak<=250 g", "acc.peak<=3 km/s^2", "acc.peak>=0", "F.peak<=5 kN"] {
        assert_eq!(judged(limit, &[]).0, 0, "{limit}");
    }
    for limit in ["F.peak=en-1621-1-level-1", "v.peak<=4 m/s", "x.peak<=2 cm", "p.peak<=100 kPa"] {
        let (status, told) = judged(limit, &[]);
        assert_eq!(status, 0, "{limit}: {told}");
    }
}
