//! Where input comes from, and what is said of wrong one.

use std::{fs, io::Write, process::Stdio};

use tempfile::TempDir;

use super::{SOFT, code, command, err, file, out, run, text};

#[test]
fn scenes_come_from_standard_input_and_models_from_files_beside_the_scene() {
    let mut child =
        command(&["check", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(SOFT.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(out(&output), "ok: 1 node, 1 element, 2 unknowns, linear\n");

    let folder = TempDir::new().unwrap();
    file(
        &folder,
        "pads.toml",
        "[models.foam]\nmaxwell = { spring = \"1 MN/m\", dashpot = \"1 kN s/m\" }\n",
    );
    let law = "kelvin-voigt = { spring = \"K\", dashpot = \"80 N s/m\" }";
    let scene =
        SOFT.replace(law, "model = \"pads.toml:foam\"").replace("[values]\nK = \"50 kN/m\"\n", "");
    let scene = file(&folder, "scene.toml", &scene);
    let output = run(&["check", text(&scene)]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    fs::remove_file(folder.path().join("pads.toml")).unwrap();
    let output = run(&["check", text(&scene)]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("pads.toml` cannot be read: there is no such file"));
}

#[test]
fn wrong_input_ends_with_two_and_says_what_to_do() {
    let cases: [(&[&str], &str); 13] = [
        (&["run", "none.toml"], "`none.toml` cannot be read: there is no such file"),
        (&["run", "src"], "it is a folder"),
        (&["run", "--method", "euler"], "possible values"),
        (&["run", "--accuracy", "5 mm"], "0.1%"),
        (&["run", "--rtol", "1"], "`rtol` must be from 1e-13"),
        (&["run", "--set", "K"], "K=25 MN/m"),
        (&["run", "none.toml", "--set", "K=80", "kN/m"], "quote what belongs together"),
        (&["run", "--set", "K=80", "kN/m"], "\"K=25 kN/m\""),
        (&["groups", "reference", "--lab", "drop=2 cm"], "`speed` is that at the end of the drop"),
        (
            &["vibrate", "reference", "--drive", "ground", "--at", "9 Hz", "--amplitude", "0.7 kg"],
            "an acceleration, such as \"0.5 g\", is taken as well",
        ),
        (
            &["vibrate", "reference", "--drive", "ground", "--at", "9 Hz", "--amplitude", "-1 mm"],
            "it must be positive",
        ),
        (&["vibrate", "reference", "--from", "-1 Hz"], "it must be positive"),
        (&["fly"], "unrecognized subcommand"),
    ];
    for (arguments, part) in cases {
        let output = run(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        let said = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(part), "{arguments:?}: {}", err(&output));
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
    assert_eq!(code(&run(&["--version"])), 0);
    assert_eq!(code(&run(&["run", "--help"])), 0);
}

#[test]
fn place_that_cannot_be_written_ends_with_two_before_anything_is_solved() {
    let folder = TempDir::new().unwrap();
    let blocked = file(&folder, "blocked", "a file, not a folder");
    for (place, part) in [
        (blocked.clone(), "blocked` is a file; `--out` wants a folder"),
        (blocked.join("below"), "a file stands in the way of a folder"),
    ] {
        let output = run(&["run", "--out", text(&place)]);
        assert_eq!(code(&output), 2);
        assert!(output.stdout.is_empty());
        let told = err(&output).replace("\n  ", " ");
        assert!(told.contains(part) && !told.contains("os error"));
    }
}

#[test]
fn name_that_is_nearly_right_is_offered() {
    let folder = TempDir::new().unwrap();
    file(&folder, "soft.toml", SOFT);
    for (name, meant) in [
        ("soft", "soft.toml"),
        ("reference.toml", "reference"),
        ("reference-stif", "reference-stiff"),
    ] {
        let output = command(&["run", name]).current_dir(folder.path()).output().unwrap();
        assert_eq!(code(&output), 2);
        assert!(err(&output).contains(&format!("did you mean `{meant}`?")), "{}", err(&output));
    }
}
