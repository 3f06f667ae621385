//! What the command reads and writes as files: one writer for a folder, results that are whole or
//! marked as not, nothing of others overwritten or removed, and texts that are safe where they go.

use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use tempfile::TempDir;

use crate::cli::{code, err, file, out, run, text};

/// An impact with a name for its pad and a title.
fn scene(pad: &str, title: &str) -> String {
    format!(
        "title = {title:?}\n[nodes]\nhead = {{ mass = 5, velocity = 3 }}\n[elements]\n\"{pad}\" = {{ \
         between = [\"head\", \"ground\"], kelvin-voigt = {{ spring = 1e5, dashpot = 100 }}, thickness \
         = 0.1 }}\n[run]\nduration = 0.05\nmethods = [\"exact\"]\n"
    )
}

/// What is said on standard error, on one line.
fn said(output: &std::process::Output) -> String {
    err(output).split_whitespace().collect::<Vec<_>>().join(" ")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap().map(|own| own.unwrap().file_name());
    entries.map(|entry| entry.into_string().unwrap()).collect()
}

#[test]
fn files_of_others_stay_as_they_are_whatever_lists_them() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "scene.toml", &scene("pad", ""));
    let own = |name: &str| file(&folder, name, "mine");
    let kept = ["precious.csv", ".dashpot-probe"].map(own);
    for list in ["precious.csv\n", "dashpot results 1\n4-0 precious.csv\n"] {
        fs::write(folder.path().join(".dashpot-files"), list).unwrap();
        let output = run(&["run", text(&scene), "--out", text(folder.path())]);
        assert!([0, 2].contains(&code(&output)), "{}", err(&output));
        for path in &kept {
            assert_eq!(fs::read_to_string(path).unwrap(), "mine", "{}", path.display());
        }
    }
    // Nor is a listed name enough to overwrite what is there.
    let results = folder.path().join("results");
    fs::create_dir(&results).unwrap();
    fs::write(results.join("exact.csv"), "mine").unwrap();
    fs::write(results.join(".dashpot-files"), "dashpot results 1\n4-0 exact.csv\n").unwrap();
    let output = run(&["run", text(&scene), "--out", text(&results)]);
    assert_eq!(code(&output), 2, "{}", err(&output));
    assert!(said(&output).contains("exact.csv` exists already"), "{}", err(&output));
    assert_eq!(fs::read_to_string(results.join("exact.csv")).unwrap(), "mine");
}

#[test]
#[cfg(unix)]
fn nothing_is_written_through_links() {
    use std::os::unix::fs::symlink;
    let home = TempDir::new().unwrap();
    let scene = file(&home, "scene.toml", &scene("pad", ""));
    let victim = file(&home, "victim", "mine");
    let nowhere = home.path().join("nowhere");
    for (name, is_refused) in [
        (".dashpot-probe", false),
        (".dashpot-files", true),
        (".dashpot-lock", true),
        ("report.html", true),
        ("exact.csv", true),
        ("result.json", true),
    ] {
        for target in [&victim, &nowhere] {
            let folder = TempDir::new().unwrap();
            symlink(target, folder.path().join(name)).unwrap();
            let output = run(&["run", text(&scene), "--out", text(folder.path())]);
            assert_eq!(code(&output), if is_refused { 2 } else { 0 }, "{name}: {}", err(&output));
            assert_eq!(fs::read_to_string(&victim).unwrap(), "mine", "{name}");
            assert!(!nowhere.exists(), "{name}");
        }
    }
    for target in [&victim, &nowhere] {
        let link = home.path().join("new.toml");
        symlink(target, &link).unwrap();
        let drawn = ["explain", text(&scene), "--out", text(&link)];
        for arguments in [&["new", "--force", "--out", text(&link)][..], &drawn] {
            let output = run(arguments);
            assert_eq!(code(&output), 2, "{}", err(&output));
            assert_eq!(fs::read_to_string(&victim).unwrap(), "mine");
            assert!(!nowhere.exists());
        }
        fs::remove_file(&link).unwrap();
    }
}

#[test]
fn a_drawing_takes_the_place_of_drawings_only() {
    let folder = TempDir::new().unwrap();
    let notes = file(&folder, "notes.txt", "mine");
    let explain = |path: &Path| run(&["explain", "--out", text(path)]);
    assert_eq!(code(&explain(&notes)), 2);
    assert_eq!(fs::read_to_string(&notes).unwrap(), "mine");
    let drawing = folder.path().join("pad.svg");
    for _ in 0..2 {
        assert_eq!(code(&explain(&drawing)), 0);
    }
}

#[test]
fn two_runs_with_one_folder_never_mix() {
    let folder = TempDir::new().unwrap();
    let slow = scene("pad", "") + "samples = 20000\n";
    let (one, other) = (slow.clone(), slow.replace("velocity = 3", "velocity = 4"));
    let scenes = [("one.toml", one), ("other.toml", other)];
    let scenes = scenes.map(|(name, text)| file(&folder, name, &text));
    let alone = scenes.each_ref().map(|scene| {
        let path = folder.path().join("alone");
        assert_eq!(code(&run(&["run", text(scene), "--out", text(&path)])), 0);
        fs::read(path.join("exact.csv")).unwrap()
    });
    let results = folder.path().join("results");
    for _ in 0..3 {
        let both = scenes.each_ref().map(|scene| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
            command.args(["run", text(scene), "--out", text(&results)]);
            command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
        });
        let both = both.map(|both| both.wait_with_output().unwrap());
        let done = [0, 1].map(|at: usize| code(&both[at]) == 0);
        assert!(done.contains(&true));
        for output in both.iter().filter(|own| code(own) != 0) {
            assert_eq!(code(output), 1, "{}", err(output));
            assert!(said(output).contains("another run is writing to"), "{}", err(output));
        }
        let table = fs::read(results.join("exact.csv")).unwrap();
        assert!((0..2).any(|at| done[at] && table == alone[at]));
    }
}

#[test]
fn a_run_that_is_killed_leaves_no_result_that_is_not_whole() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "scene.toml", &(scene("pad", "") + "samples = 20000\n"));
    let results = folder.path().join("results");
    let arguments = ["run", text(&scene), "--out", text(&results)];
    let started = Instant::now();
    assert_eq!(code(&run(&arguments)), 0);
    let whole = started.elapsed();
    let table = fs::read(results.join("exact.csv")).unwrap();
    let trials = 12;
    for trial in 0..trials {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
        command.args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        sleep(whole * trial / trials + Duration::from_millis(1));
        child.kill().unwrap();
        child.wait().unwrap();
        if results.join("result.json").exists() {
            assert!(fs::read(results.join("exact.csv")).unwrap() == table, "{trial}");
        }
    }
    let output = run(&arguments);
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(names(&results).iter().all(|name| !name.contains(".part")), "{:?}", names(&results));
}

#[test]
#[cfg(unix)]
fn pipes_and_devices_are_no_files_to_read() {
    let folder = TempDir::new().unwrap();
    let pipe = folder.path().join("pipe");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let driven = "[nodes]\nhead = { mass = 5 }\n[elements]\npad = { between = [\"head\", \"ground\"], \
                  spring = 1e5 }\n[loads.blow]\non = \"head\"\nforce = { table = \"pipe\" }\n[run]\n\
                  duration = 0.05\n";
    let table = file(&folder, "table.toml", driven);
    let law = "kelvin-voigt = { spring = 1e5, dashpot = 100 }";
    let model = scene("pad", "").replace(law, "model = \"pipe:foam\"");
    let model = file(&folder, "model.toml", &model);
    for path in [pipe.as_path(), Path::new("/dev/zero"), &table, &model] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
        command.args(["check", text(path)]).stdout(Stdio::null()).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let started = Instant::now();
        while child.try_wait().unwrap().is_none() && started.elapsed() < Duration::from_secs(20) {
            sleep(Duration::from_millis(10));
        }
        // Nothing to do where it is gone already.
        child.kill().unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", path.display());
        assert!(said(&output).contains("it is no regular file"), "{}", err(&output));
    }
}

#[test]
fn control_characters_of_others_never_reach_a_terminal() {
    let folder = TempDir::new().unwrap();
    let sequence = "\u{1b}]0;pwn\u{7}\u{9b}31mgrün\u{202e}\u{200b}\u{2028}\u{feff}";
    let toml = scene("pad", "TITLE")
        .replace("TITLE", "\\u001b]0;pwn\\u0007\\u009b31mgrün\u{202e}\u{200b}");
    let good = file(&folder, "good.toml", &toml);
    let odd =
        file(&folder, "odd\u{1b}[31m.toml", &toml.replace("mass = 5", "mass = \"\\u001b[2J\""));
    let named = file(&folder, "named.toml", &scene("a\u{200b}b", ""));
    let results = folder.path().join("results");
    let missing = format!("{sequence}.toml");
    for arguments in [
        &["run", text(&good)][..],
        &["run", text(&good), "--json"],
        &["run", text(&good), "--out", text(&results)],
        &["explain", text(&good)],
        &["check", text(&odd)],
        &["run", &missing],
        &["run", "--set", sequence],
        &["run", sequence, "--unknown", sequence],
        &["sweep", text(&good), "--vary", sequence],
        &["rheometer", sequence],
        &["convert", &missing, "--to", "zener"],
        &["check", text(&named)],
        &["groups", text(&good)],
    ] {
        let output = run(arguments);
        for stream in [out(&output), err(&output)] {
            let hidden = ['\u{202e}', '\u{200b}', '\u{2028}', '\u{feff}'];
            let is_control = |own: char| own.is_control() && own != '\n' || hidden.contains(&own);
            // In JSON they are escaped by its own rules, or ordinary characters.
            let is_raw =
                |own: char| is_control(own) && !(arguments.contains(&"--json") && own > '\u{7f}');
            assert!(!stream.contains(is_raw), "{arguments:?}: {stream:?}");
        }
    }
    let shown = out(&run(&["run", text(&good), "--color", "always"]));
    assert!(shown.contains("\\u001b]0;pwn\\u0007\\u009b31mgrün\\u202e\\u200b"), "{shown}");
    assert!(shown.contains("\u{1b}[1m") && !shown.contains("\u{1b}]"), "{shown}");
}

#[test]
fn names_in_tables_are_no_formulas_and_read_back() {
    let folder = TempDir::new().unwrap();
    for (at, pad) in ["=1+1", "-pad", "+pad", "@pad", "a;=1"].into_iter().enumerate() {
        let source = file(&folder, "scene.toml", &scene(pad, ""));
        let results = folder.path().join(format!("results-{at}"));
        assert_eq!(code(&run(&["run", text(&source), "--out", text(&results)])), 0);
        let table = fs::read_to_string(results.join("exact.csv")).unwrap();
        let peak = format!("--measure={pad}.peak-force");
        for name in ["exact.csv", "events.csv"] {
            let mut cells = csv::Reader::from_path(results.join(name)).unwrap();
            for row in cells.records().map(Result::unwrap) {
                let is_live = |own: &&str| {
                    own.starts_with(['=', '+', '-', '@']) && own.parse::<f64>().is_err()
                };
                assert_eq!(row.iter().find(is_live), None, "{name} of {pad}");
            }
        }
        let vary = format!("--vary={pad}.spring=1e5,2e5 N/m");
        let swept = out(&run(&["sweep", text(&source), &vary, &peak]));
        for header in [table.lines().next().unwrap(), swept.lines().next().unwrap()] {
            let bare = header.replace('"', "");
            let is_live = |cell: &str| cell.starts_with(['=', '+', '-', '@']);
            assert!(!bare.split(',').any(is_live), "{header}");
            // Nor where a sheet takes semicolons for separators.
            let mut outside = header.split('"').step_by(2);
            assert!(!outside.any(|part| part.contains(';')), "{header}");
        }
        let driven = format!(
            "[nodes]\nhead = {{ mass = 5 }}\n[elements]\npad = {{ between = [\"head\", \"ground\"], \
             spring = 1e5 }}\n[loads.blow]\non = \"head\"\nforce = {{ table = {{ file = \
             \"results-{at}/exact.csv\", columns = [\"time\", \"{pad}.force\"] }} }}\n[run]\nduration = \
             0.05\n"
        );
        let output = run(&["check", text(&file(&folder, "driven.toml", &driven))]);
        assert_eq!(code(&output), 0, "{pad}: {}", err(&output));
    }
}

#[test]
fn names_with_characters_that_are_not_to_be_seen_are_refused() {
    let folder = TempDir::new().unwrap();
    for own in ["a\u{200b}b", "a\u{202e}b", "a\u{2028}b", "a\u{e0041}b"] {
        let output = run(&["check", text(&file(&folder, "scene.toml", &scene(own, "")))]);
        assert_eq!(code(&output), 2, "{own:?}");
        assert!(said(&output).contains("characters that are not to be seen"), "{}", err(&output));
    }
}

#[test]
fn folders_of_earlier_versions_are_refused_and_it_is_told_what_to_do() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "scene.toml", &scene("pad", ""));
    let results = folder.path().join("results");
    fs::create_dir(&results).unwrap();
    for (name, content) in [(".dashpot-files", "exact.csv\nresult.json\n"), ("exact.csv", "old")] {
        fs::write(results.join(name), content).unwrap();
    }
    let arguments = ["run", text(&scene), "--out", text(&results)];
    let output = run(&arguments);
    assert_eq!(code(&output), 2);
    assert!(said(&output).contains("move this file and the results beside it away"), "{output:?}");
    assert_eq!(fs::read_to_string(results.join("exact.csv")).unwrap(), "old");
    fs::rename(&results, folder.path().join("old")).unwrap();
    assert_eq!(code(&run(&arguments)), 0);
}

#[test]
fn results_stay_in_their_folder_whatever_the_names() {
    let folder = TempDir::new().unwrap();
    let pad = format!("{}/pad", folder.path().display());
    let pad = pad.replace('.', "-");
    let source = file(&folder, "scene.toml", &scene(&pad, ""));
    let results = folder.path().join("results");
    let measure = format!("{pad}.peak-force");
    let output = run(&[
        "sweep",
        text(&source),
        "--vary",
        "head.velocity=2..3 m/s,3",
        "--measure",
        &measure,
        "--out",
        text(&results),
    ]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(names(&results).iter().any(|name| name.ends_with("%2Fpad.peak-force.svg")));
    assert_eq!(names(folder.path()).len(), 2, "{:?}", names(folder.path()));
}
