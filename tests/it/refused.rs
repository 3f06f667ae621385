//! What the command refuses by name: options that do nothing, results beyond any memory, numbers without a unit; and what
//! an interrupt leaves.

use std::{
    fs::{self, File},
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant, SystemTime},
};

use tempfile::TempDir;

use crate::{
    cli::{code, err, file, out, run, said, text},
    scenes::scene_paths,
};

const PAD: &str = r#"[values]
K = "60 kN/m"
[nodes]
head = { mass = "5 kg", velocity = "2 m/s" }
[elements]
pad = { between = ["head", "ground"], kelvin-voigt = { spring = "K", dashpot = "80 N s/m" }, thickness = "30 mm", area = "50 cm^2" }
[run]
duration = "20 ms"
"#;

#[test]
fn options_that_do_nothing_are_refused_by_name() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "pad.toml", PAD);
    let scene = text(&scene);
    let vary = "K=50,60 kN/m";
    let drop = ["cushion", scene, "--heights", "30 cm", "--stress", "2,4 kPa"];
    let cushion = |more: &[&'static str]| [&drop[..], more].concat();
    for (arguments, option) in [
        (vec!["run", scene, "--seed", "5"], "--seed"),
        (vec!["run", scene, "--sample=5"], "--sample"),
        (vec!["run", scene, "--curves"], "--curves"),
        (vec!["run", scene, "--plot", "always", "--json"], "--plot"),
        (vec!["run", scene, "--method", "exact", "--rtol", "1e-6"], "--rtol"),
        (vec!["run", scene, "--variant", "K=80 kN/m", "--at", "5 ms"], "--at"),
        (vec!["sweep", scene, "--vary", vary, "--table", "always", "--json"], "--table"),
        (
            vec!["sweep", scene, "--gradient", "K", "--limit", "head.peak-acceleration<=5 g"],
            "--limit",
        ),
        (vec!["groups", "--within", "0.1"], "--within"),
        (vec!["groups", "--out", "nowhere.toml"], "--out"),
        (vec!["groups", "reference", "reference-stiff", "--out", "nowhere.toml"], "--out"),
        (vec!["vibrate", scene, "--drive", "ground", "--plot", "always", "--json"], "--plot"),
        (vec!["rheometer", "reference:padding", "--plot", "always", "--json"], "--plot"),
        (cushion(&["--seed", "5"]), "--seed"),
        (cushion(&["--scatter", "5"]), "--scatter"),
        (cushion(&["--robust", "90%"]), "--robust"),
    ] {
        let output = run(&arguments);
        assert_eq!((code(&output), out(&output).as_str()), (2, ""), "{arguments:?}");
        assert!(said(&output).contains(option), "{arguments:?}: {}", err(&output));
    }
}

#[test]
fn what_is_set_twice_is_refused() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "pad.toml", PAD);
    let scene = text(&scene);
    let twice = ["--set", "K=50 kN/m", "--set", "K=60 kN/m"];
    let variants = ["--variant", "thick: K=50 kN/m", "--variant", "thick: K=60 kN/m"];
    let with = ["--with", "hold=5 ms", "--with", "hold=6 ms"];
    for (arguments, name) in [
        ([&["run", scene][..], &twice].concat(), "`K`"),
        ([&["explain", scene][..], &twice].concat(), "`K`"),
        ([&["design", scene, "--solve-for", "pad.thickness"][..], &twice].concat(), "`K`"),
        ([&["run", scene][..], &variants].concat(), "`thick`"),
        (vec!["run", scene, "--variant", "thick: K=5 kN/m, K=6 kN/m"], "`K`"),
        ([&["rheometer", "reference:padding", "--test", "creep"][..], &with].concat(), "`hold`"),
    ] {
        let output = run(&arguments);
        assert_eq!((code(&output), out(&output).as_str()), (2, ""), "{arguments:?}");
        let said = said(&output);
        assert!(said.contains(name) && said.contains("twice"), "{arguments:?}: {said}");
    }
    // The value of a variant stands above that of the command.
    assert_eq!(code(&run(&["run", scene, "--set", "K=50 kN/m", "--variant", "K=60 kN/m"])), 0);
}

/// A folder is refused for files that would be written over, not for others that the verb might have written.
#[test]
fn a_file_of_someone_else_that_a_study_does_not_write_is_no_obstacle() {
    let room = TempDir::new().unwrap();
    let test = |file: &str, test: &str| {
        let folder = room.path().join(format!("{file}-{test}"));
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join(file), "mine").unwrap();
        let folder = text(&folder);
        let output = run(&["rheometer", "reference:padding", "--test", test, "--out", folder]);
        (code(&output), fs::read_to_string(format!("{folder}/{file}")).unwrap())
    };
    assert_eq!(test("creep.csv", "relaxation"), (0, "mine".to_owned()));
    assert_eq!(test("creep.csv", "creep"), (2, "mine".to_owned()));
}

#[test]
fn an_option_does_not_take_the_next_one_for_its_value() {
    let shaken = ["vibrate", "reference", "--drive"];
    for arguments in [
        [&shaken[..], &["--json"]].concat(),
        [&shaken[..], &["ground", "--of", "--json"]].concat(),
        [&shaken[..], &["ground", "--points", "-5"]].concat(),
        vec!["compare", "reference:padding", "reference:mount", "--impact", "--json"],
        vec!["rheometer", "reference:padding", "--with", "--json"],
    ] {
        let output = run(&arguments);
        assert_eq!((code(&output), out(&output).as_str()), (2, ""), "{arguments:?}");
        let said = said(&output);
        assert!(
            said.contains("a value is required") || said.contains("unexpected argument"),
            "{arguments:?}: {said}"
        );
    }
    // A quantity may be negative, and is refused for what it is.
    let output = run(&[&shaken[..], &["ground", "--from", "-1 Hz"]].concat());
    assert!(said(&output).contains("positive"), "{}", err(&output));
}

/// What is a path of the system need be no text.
#[cfg(target_os = "linux")]
#[test]
fn a_study_takes_a_scene_whose_name_is_no_text() {
    use std::{ffi::OsStr, os::unix::ffi::OsStrExt as _};
    let room = TempDir::new().unwrap();
    let scene = room.path().join(OsStr::from_bytes(b"pad-\xff.toml"));
    fs::write(&scene, PAD).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    let output = command.arg("vibrate").arg(&scene).args(["--drive", "ground"]).output().unwrap();
    assert_eq!(code(&output), 0, "{}", err(&output));
}

#[test]
fn options_that_do_something_are_taken() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "pad.toml", &PAD.replace("\"60 kN/m\"", "\"60 ± 3 kN/m\""));
    let scene = text(&scene);
    for arguments in [
        vec!["run", scene, "--sample", "64", "--seed", "5"],
        vec!["run", scene, "--sample", "64", "--curves", "--json"],
        vec!["run", scene, "--sample", "64", "--method", "bdf", "--rtol", "1e-6"],
        vec!["run", scene, "--sample", "64", "--variant", "K=80 kN/m", "--at", "5 ms", "--json"],
    ] {
        let output = run(&arguments);
        assert_eq!(code(&output), 0, "{arguments:?}: {}", err(&output));
    }
}

/// Each is refused before the work, with the memory that it takes and what to ask for instead.
#[test]
fn what_takes_too_much_memory_is_refused_with_the_figure() {
    let room = TempDir::new().unwrap();
    let many = PAD.replace("[run]", "[run]\nsamples = 10000000");
    let (scene, many) = (file(&room, "pad.toml", PAD), file(&room, "many.toml", &many));
    let (scene, many) = (text(&scene), text(&many));
    let vary = ["--vary", "K=50..60 kN/m,10000", "--vary", "head.mass=4..5 kg,1000"];
    let sweep = [&["sweep", scene], &vary[..], &["--measure", "pad.peak-force"]].concat();
    for (arguments, told) in [
        (vec!["run", many, "--json", "--curves"], "piece by piece"),
        (sweep, "--parquet --out DIR"),
        (vec!["sweep", scene, "--vary", "K=5,6 kN/m", "--threads", "100000"], "from 1 to 1024"),
        (vec!["cushion", scene, "--threads", "100000"], "from 1 to 1024"),
        (vec!["run", scene, "--sample", "10000000"], "from 1 to 1000000"),
    ] {
        let begun = Instant::now();
        let output = run(&arguments);
        assert_eq!((code(&output), out(&output).as_str()), (2, ""), "{arguments:?}");
        assert!(said(&output).contains(told), "{arguments:?}: {}", err(&output));
        assert!(begun.elapsed() < Duration::from_secs(10), "{arguments:?}");
    }
}

#[test]
fn numbers_without_a_unit_give_a_warning_each_and_an_error_where_that_is_asked_for() {
    let room = TempDir::new().unwrap();
    let bare =
        PAD.replace("\"60 kN/m\"", "60e3").replace("\"5 kg\"", "5").replace("\"20 ms\"", "0.02");
    let (scene, bare) = (file(&room, "pad.toml", PAD), file(&room, "bare.toml", &bare));
    let (scene, bare) = (text(&scene), text(&bare));
    for verb in [
        vec!["run", bare],
        vec!["check", bare],
        vec!["explain", bare],
        vec!["sweep", bare, "--vary", "head.velocity=1..2 m/s,3"],
    ] {
        let output = run(&verb);
        assert_eq!(code(&output), 0, "{verb:?}: {}", err(&output));
        assert_eq!(said(&output).matches("has no unit").count(), 3, "{verb:?}: {}", err(&output));
        for part in [
            "`5` has no unit: it is read as 5 kg",
            "`60e3` has no unit: it is read as 60000 N/m",
            "`0.02` has no unit: it is read as 0.02 s = 20 ms",
        ] {
            assert!(said(&output).contains(part), "{verb:?}: {}", err(&output));
        }
        let strict = run(&[&verb[..], &["--strict"]].concat());
        assert_eq!((code(&strict), out(&strict).as_str()), (2, ""), "{verb:?}");
        assert_eq!(said(&strict).matches("error: ").count(), 3, "{}", err(&strict));
    }
    let output = run(&["run", scene, "--strict"]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(!said(&output).contains("no unit"), "{}", err(&output));
    // Pure numbers have none, and zero is zero in all units.
    let zero = PAD.replace("\"80 N s/m\"", "0").replace("duration", "samples = 11\nduration");
    let zero = file(&room, "zero.toml", &zero);
    assert_eq!(code(&run(&["check", text(&zero), "--strict"])), 0);
}

/// Each number is told of once, at the place where it is written.
#[test]
fn a_number_without_a_unit_is_pointed_at_where_it_is_written() {
    let room = TempDir::new().unwrap();
    let scene = |name: &str, from: &str, to: &str| {
        assert!(PAD.contains(from), "{from}");
        text(&file(&room, name, &PAD.replace(from, to))).to_owned()
    };
    // Under [values], not where its name stands.
    let named = scene("named.toml", "\"60 kN/m\"", "60e3");
    let shown = err(&run(&["check", &named]));
    assert!(shown.contains("K = 60e3") && !shown.contains("spring = "), "{shown}");
    // What is odd says so, and nothing else.
    let thick = scene("thick.toml", "duration = \"20 ms\"", "duration = 20");
    for (strict, level) in [(&[][..], "warning"), (&["--strict"][..], "error")] {
        let output = run(&[&["check", &thick][..], strict].concat());
        let shown = said(&output);
        assert!(
            shown.contains(&format!("{level}: `run.duration` is 20 s: did you mean ms?")),
            "{shown}"
        );
        assert_eq!(shown.matches(&format!("{level}: ")).count(), 1, "{shown}");
        assert_eq!(shown.matches("help: ").count(), 1, "{shown}");
    }
    // A limit is told of once, with the units of the field.
    let limited = scene("limited.toml", "[run]", "[limits]\nhead.peak-acceleration = 250\n[run]");
    let shown = said(&run(&["check", &limited]));
    assert_eq!(shown.matches("help: ").count(), 1, "{shown}");
    assert!(shown.contains("250 m/s^2 = 25.49 g"), "{shown}");
    // A file of numbers is held to the same, with advice that changes no number.
    fs::write(room.path().join("curve.csv"), "0,0\n0.04,6000\n").unwrap();
    let law = "kelvin-voigt = { spring = \"K\", dashpot = \"80 N s/m\" }";
    let tabled = scene("tabled.toml", law, "table-spring = \"curve.csv\"");
    let strict = run(&["check", &tabled, "--strict"]);
    assert_eq!(code(&strict), 2, "{}", err(&strict));
    assert!(said(&strict).contains("deformation [m], force [N]"), "{}", err(&strict));
    // Of many the first ones are shown, and where the others are.
    let rows: Vec<String> = (0..30).map(|at| format!("[{at}e-3, {at}]")).collect();
    let listed = format!("table-spring = [{}]", rows.join(", "));
    let listed = scene("listed.toml", law, &listed);
    let shown = said(&run(&["check", &listed]));
    assert!(shown.contains("and 55 warnings of the same kind, in lines"), "{shown}");
    // What a program wrote says that it is in SI.
    let own =
        format!("{}#:units SI\n", PAD.replace("\"60 kN/m\"", "60e3").replace("\"5 kg\"", "5"));
    let output = run(&["check", text(&file(&room, "own.toml", &own)), "--strict"]);
    assert_eq!((code(&output), said(&output).contains("no unit")), (0, false), "{}", err(&output));
}

#[test]
fn slips_of_the_command_line_are_told_with_what_to_write() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "pad.toml", PAD);
    let (scene, folder) = (text(&scene), text(room.path()));
    let nowhere = room.path().join("none/pad.toml");
    let missing = format!("there is no folder `{}`", text(nowhere.parent().unwrap()));
    let convert = ["convert", "reference:padding", "--to", "generalized-maxwell", "--out"];
    for (arguments, advice) in [
        (vec!["rnu", scene], "did you mean `run`?"),
        (vec![scene], "` solves a scene"),
        (vec!["run", scene, "--otu", "x"], "did you mean `--out`?"),
        (vec!["sweep", scene], "for example `dashpot sweep "),
        (
            vec!["compare", scene],
            "for example `dashpot compare pads.toml:burgers pads.toml:two-maxwell`",
        ),
        (vec!["run", folder], "name a file in it"),
        (vec!["new", "pad.toml"], "`--out FILE.toml` says which file is written"),
        (vec!["list", "maxwel"], "did you mean `maxwell`?"),
        // Its first words are nearer than another number.
        (vec!["run", scene, "--limit", "head.hic15=fmvss-208"], "did you mean `fmvss-208-hic15`?"),
        (vec!["cushion", scene, "--stress", "1..10"], "\"1..10 kPa\" or \"1..10 Pa\""),
        // A number of the scene is bounded where it is varied.
        (
            vec!["design", scene, "--vary", "K=1..9 kN/m", "--limit", "pad.thickness<=30 mm"],
            "--vary",
        ),
        ([&convert[..], &[text(&nowhere)]].concat(), &missing),
    ] {
        let output = run(&arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(said(&output).contains(advice), "{arguments:?}: {}", err(&output));
    }
}

#[test]
fn shipped_scenes_have_units_throughout() {
    for scene in scene_paths() {
        let output = run(&["check", text(&scene), "--strict"]);
        assert_eq!(code(&output), 0, "{}: {}", scene.display(), err(&output));
    }
    for scene in ["reference", "reference-stiff", "reference-gravity"] {
        assert_eq!(code(&run(&["check", scene, "--strict"])), 0, "{scene}");
    }
}

#[cfg(unix)]
#[test]
fn standard_input_is_offered_where_it_is_taken() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "pad.toml", PAD);
    let table = PAD.replace("spring = \"K\"", "table-spring = \"/dev/null\"");
    let table = file(&room, "table.toml", &table);
    for (arguments, is_taken) in [
        (vec!["run", "/dev/null"], true),
        (vec!["sweep", text(&scene), "--points", "/dev/null"], true),
        (vec!["run", text(&table)], false),
    ] {
        let output = run(&arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        let told = said(&output);
        assert_eq!(told.contains("standard input is `-`"), is_taken, "{arguments:?}: {told}");
    }
}

/// A long run that is broken off says so, and its folder is gone with its lock.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_that_is_not_whole() {
    let room = TempDir::new().unwrap();
    let long = "[nodes]\nparcel = { mass = \"12 kg\" }\n\
        bed = { motion = { sine = { amplitude = \"5 mm\", frequency = \"9 Hz\", phase = \"180 deg\" } } }\n\
        [elements]\ncushion = { between = [\"parcel\", \"bed\"], kelvin-voigt = { spring = \"120 kN/m\", dashpot = \"480 N s/m\" } }\n\
        [effects]\ngravity = { value = \"1 g0\" }\nseparation.cushion = { at = \"parcel\" }\n[run]\nduration = \"100000 s\"\n";
    let scene = file(&room, "long.toml", long);
    let folder = room.path().join("results");
    let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    let command = command.args(["run", text(&scene), "--out", text(&folder)]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while !folder.join(".dashpot-lock").exists() && begun.elapsed() < Duration::from_secs(60) {
        sleep(Duration::from_millis(20));
    }
    sleep(Duration::from_millis(300));
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(killed.success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", err(&output));
    assert!(
        said(&output).contains("interrupted: nothing of this call is kept"),
        "{}",
        err(&output)
    );
    assert!(!folder.exists());
}

/// What a killed process left beside the place of a text goes with the next one.
#[test]
fn a_part_that_was_left_is_removed() {
    let room = TempDir::new().unwrap();
    let left = room.path().join(".dashpot-0123456789abcdef-0.part");
    let (new, foreign) =
        (room.path().join(".dashpot-fedcba9876543210-0.part"), room.path().join("a.part"));
    for own in [&left, &new, &foreign] {
        fs::write(own, "half").unwrap();
    }
    let old = SystemTime::now() - Duration::from_secs(600);
    for own in [&left, &foreign] {
        File::options().write(true).open(own).unwrap().set_modified(old).unwrap();
    }
    assert_eq!(code(&run(&["man", "--out", text(room.path())])), 0);
    assert!(!left.exists() && new.exists() && foreign.exists());
}

#[test]
fn a_range_without_a_unit_is_told_and_strictly_refused() {
    let room = TempDir::new().unwrap();
    let scene = file(&room, "pad.toml", PAD);
    let sweep = ["sweep", text(&scene), "--vary", "head.mass=1..2,2"];
    let shown = run(&sweep);
    assert_eq!(
        (code(&shown), said(&shown).matches("has no unit").count()),
        (0, 1),
        "{}",
        err(&shown)
    );
    for verb in
        [&sweep[..], &["design", text(&scene), "--vary", "head.mass=1..2", "--least", "head.mass"]]
    {
        let strict = run(&[verb, &["--strict"]].concat());
        assert_eq!((code(&strict), out(&strict).as_str()), (2, ""), "{}", err(&strict));
        assert!(said(&strict).contains("has no unit: a bare number is in kg"), "{}", err(&strict));
    }
}
