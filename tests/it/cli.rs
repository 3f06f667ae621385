//! The command as its users meet it: exit codes, both streams, and files.

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

use dashpot::{
    analysis::measures::MEASURES,
    dae::methods::METHODS,
    network::{effects::EFFECTS, elements::ELEMENTS, waveforms::WAVEFORMS},
    rheology::FORMS,
    scene::templates,
};
use serde_json::Value;
use tempfile::TempDir;

/// A pad that is far too soft.
const SOFT: &str = r#"
[values]
K = "50 kN/m"
[nodes]
head = { mass = "5 kg", velocity = "6 m/s" }
[elements]
pad = { between = ["head", "ground"], kelvin-voigt = { spring = "K", dashpot = "80 N s/m" }, thickness = "3 cm" }
[run]
duration = "40 ms"
"#;

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    command.args(arguments).env_remove("NO_COLOR");
    command
}

pub(crate) fn run(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

pub(crate) fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub(crate) fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What is said on standard error, without its line breaks.
pub(crate) fn said(output: &Output) -> String {
    err(output).split_whitespace().collect::<Vec<_>>().join(" ")
}

pub(crate) fn json(arguments: &[&str]) -> Value {
    let output = run(arguments);
    assert_eq!(code(&output), 0, "{}", err(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

pub(crate) fn file(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    path
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

pub(crate) fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

#[test]
fn run_without_a_scene_gives_the_verdict_on_the_reference_impact() {
    let output = run(&["run"]);
    let verdict = out(&output);
    assert_eq!(code(&output), 0);
    assert!(verdict.starts_with("! from 7.43 ms the padding is in tension: separation is off\n"));
    for fact in
        ["38.36 kN", "391.2 g (3836 m/s²)", "88 % of 20 mm, 2.46 mm left", "477.2 J of 500 J"]
    {
        assert!(verdict.contains(fact), "{fact}:\n{verdict}");
    }
    assert_eq!(
        err(&output),
        "warning: from 7.43 ms the padding is in tension: separation is off\n"
    );
    assert!(verdict.lines().all(|line| line.chars().count() <= 80), "{verdict}");
    assert!(!verdict.contains('\u{1b}'));
}

#[test]
#[cfg(unix)]
fn where_both_streams_are_one_a_warning_is_read_once() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("both");
    let both = fs::File::create(&path).unwrap();
    let mut run = command(&["run"]);
    run.stdout(both.try_clone().unwrap()).stderr(both);
    assert!(run.status().unwrap().success());
    let read = fs::read_to_string(&path).unwrap();
    assert_eq!(read.matches("the padding is in tension: separation is off").count(), 1, "{read}");
}

#[test]
fn the_verdict_names_the_longest_interval_of_a_head_injury_criterion() {
    let folder = TempDir::new().unwrap();
    let asked = "[measures]\nhead = [\"hic15\", \"hic36\", { kind = \"hic\", cap = \"5 ms\" }]\n";
    let path = file(&folder, "scene.toml", &(SOFT.to_owned() + asked));
    let verdict = out(&run(&["run", text(&path)]));
    let words = verdict.split_whitespace().collect::<Vec<_>>().join(" ");
    let indices = &words[words.find("indices").unwrap()..];
    for name in ["HIC15 of head ", "HIC36 of head ", " (from "] {
        assert!(indices.contains(name), "{name}: {verdict}");
    }
    let only = "[measures]\nhead = [{ kind = \"hic\", cap = \"5 ms\" }]\n";
    let path = file(&folder, "other.toml", &(SOFT.to_owned() + only));
    let verdict = out(&run(&["run", text(&path)]));
    assert!(verdict.contains("HIC up to 5 ms of head "), "{verdict}");
    let path = file(&folder, "third.toml", &(SOFT.to_owned() + "[measures]\nhead = [\"hic\"]\n"));
    let verdict = out(&run(&["run", text(&path)]));
    assert!(verdict.contains("HIC without a cap of head "), "{verdict}");
}

#[test]
fn the_verdict_leaves_out_of_its_bound_what_is_not_as_good() {
    let path = "tests/corpus/networks/stop-that-pulls.toml";
    let output = run(&["run", path, "--method", "esdirk34"]);
    let words = out(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    let wrong = &words[words.find("num. error").unwrap()..];
    assert!(wrong.contains("`e0.stop.energy` is zero within"), "{wrong}");
    assert!(wrong.contains("every other figure within"), "{wrong}");
}

#[test]
fn json_has_one_shape_and_si_values() {
    let answer = json(&["run", "--json"]);
    for key in ["scene", "runs", "difference", "settings", "failed"] {
        assert!(answer.get(key).is_some(), "{key}");
    }
    assert_eq!(answer["scene"]["file"], "reference.toml");
    let runs = answer["runs"].as_array().unwrap();
    let names: Vec<&str> =
        runs.iter().map(|run| run["solver"]["method"].as_str().unwrap()).collect();
    assert_eq!(names, ["exact", "bdf"]);
    for run in runs {
        for key in [
            "method",
            "why",
            "rtol",
            "accepted",
            "rejected",
            "rhs_calls",
            "jacobian_calls",
            "factorizations",
            "solves_for_error",
        ] {
            assert!(run["solver"].get(key).is_some(), "{key}");
        }
        assert_eq!(keys(&run["system"]), ["algebraic", "effects", "modes", "states"]);
        for key in ["work-in", "kinetic", "stored", "dissipated", "closure"] {
            assert!(run["energy"].get(key).is_some(), "{key}");
        }
        assert_eq!(keys(&run["events"][0]), ["code", "error", "time", "what"]);
        assert!(run["warnings"][0].as_str().unwrap().contains("in tension"));
        let peak = &run["measures"]["padding.peak-force"];
        assert_eq!(keys(peak), ["error", "time", "unit", "value", "window"]);
        let off = (peak["value"].as_f64().unwrap() - 38_359.411_601_331).abs();
        assert!(off <= peak["error"].as_f64().unwrap() + 1e-8, "{peak}");
        assert_eq!(run["measures"]["head.severity-index"]["exponent"], 2.5);
        assert!(run["measures"]["padding.contact-time"]["window"].is_null());
    }
    assert!(answer["difference"]["padding.peak-force"].as_f64().unwrap() < 1e-3);
}

#[test]
fn one_method_leaves_no_difference_and_off_means_no_errors() {
    let answer = json(&["run", "--json", "--method", "bdf", "--estimate", "off", "--rtol", "1e-5"]);
    assert!(keys(&answer["difference"]).is_empty());
    let run = &answer["runs"][0];
    assert_eq!(run["solver"]["solves_for_error"], 0);
    assert!(run["measures"]["padding.peak-force"]["error"].is_null());
    assert_eq!(answer["settings"]["rtol"], 1e-5);
}

#[test]
fn accuracy_is_taken_in_percent_and_reached() {
    let answer = json(&["run", "--json", "--method", "bdf", "--accuracy", "0.001%"]);
    for (key, measure) in answer["runs"][0]["measures"].as_object().unwrap() {
        let (value, error) = (measure["value"].as_f64(), measure["error"].as_f64());
        // One speed over another: it has the size 1.
        let is_ratio = key.ends_with("coefficient-of-restitution");
        let size = if is_ratio { 1.0 } else { value.unwrap().abs() };
        assert!(error.unwrap() <= 1.01e-5 * size, "{key}: {measure}");
    }
}

#[test]
fn values_are_set_from_outside() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "soft.toml", SOFT);
    let peak = |arguments: &[&str]| {
        let answer = json(&[&["run", text(&scene), "--json"], arguments].concat());
        answer["runs"][0]["measures"]["pad.peak-deformation"]["value"].as_f64().unwrap()
    };
    assert!(peak(&["--set", "K=200 kN/m"]) < 0.6 * peak(&[]));
    let output = run(&["run", text(&scene), "--set", "K=200 kN/m"]);
    assert!(out(&output).contains("\nwith K = 200 kN/m\n"), "{}", out(&output));
    let output = run(&["run", text(&scene), "--set", "Q=1 N/m"]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("there is no value named `Q`"));
}

#[test]
fn saved_scene_repeats_the_run() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "soft.toml", SOFT);
    let results = folder.path().join("results");
    let asked = ["--set", "K=200 kN/m", "--method", "exact, bdf", "--accuracy", "0.01%"];
    let first =
        json(&[&["run", text(&scene), "--json", "--out", text(&results)], &asked[..]].concat());
    let saved = results.join("scene-as-run.toml");
    let again = json(&["run", text(&saved), "--json"]);
    for (first, again) in
        first["runs"].as_array().unwrap().iter().zip(again["runs"].as_array().unwrap())
    {
        assert_eq!(first["solver"]["method"], again["solver"]["method"]);
        assert_eq!(first["measures"], again["measures"]);
    }
    assert_eq!(again["runs"].as_array().unwrap().len(), 2);
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    assert!(page.contains("with K = 200 kN/m") && page.contains("# as run with"));
    assert!(!page.contains('`'));
}

#[test]
fn pad_that_never_meets_an_impactor_is_warned_of_when_it_pulls() {
    let folder = TempDir::new().unwrap();
    let scene = "[nodes]\ngoods = { mass = \"12 kg\" }\nbed = { motion = { sine = { amplitude = \"3 mm\", \
        frequency = \"8 Hz\" } } }\n[elements]\ncushion = { between = [\"goods\", \"bed\"], kelvin-voigt = \
        { spring = \"30 kN/m\", dashpot = \"150 N s/m\" }, thickness = \"50 mm\" }\n[effects]\n\
        gravity = true\n[run]\nduration = \"2 s\"\n";
    let scene = file(&folder, "truck.toml", scene);
    let output = run(&["run", text(&scene)]);
    let verdict = out(&output);
    assert!(
        verdict.starts_with("! from 105 ms the cushion is in tension: separation is off\n"),
        "{verdict}"
    );
    assert!(verdict.contains("goods.peak-acceleration") && !verdict.contains("contact-time"));
    assert!(
        verdict
            .lines()
            .any(|line| line.starts_with("  peak g ") && line.ends_with("on goods at 1.93 s"))
    );
    let shown = out(&run(&["explain", text(&scene)]));
    assert!(shown.contains("sine of 3 mm at 8 Hz"), "{shown}");
}

#[test]
fn run_that_stops_says_so() {
    let folder = TempDir::new().unwrap();
    let scene = SOFT.to_owned() + "stop = [{ when = \"pad.force\", falls-below = \"0 N\" }]\n";
    let scene = file(&folder, "stop.toml", &scene);
    let answer = json(&["run", text(&scene), "--json"]);
    let events = answer["runs"][0]["events"].as_array().unwrap();
    assert!(events.iter().any(|event| event["what"] == "pad.force fell below 0 N"), "{events:?}");
    let verdict = out(&run(&["run", text(&scene)]));
    assert!(verdict.contains("  stopped          at "), "{verdict}");
    assert!(!verdict.contains("tension"), "{verdict}");
}

#[test]
fn pad_that_is_never_pressed_says_why_there_is_nothing_to_report() {
    let folder = TempDir::new().unwrap();
    let scene = SOFT.replace("[\"head\", \"ground\"]", "[\"ground\", \"head\"]");
    let verdict = out(&run(&["run", text(&file(&folder, "away.toml", &scene))]));
    assert!(verdict.contains("the pad is never pressed: it pulls from the start"), "{verdict}");
}

#[test]
fn many_methods_stand_below_each_other_with_their_errors() {
    let methods = "exact,bdf,tr-bdf2,esdirk34,tsit45";
    let shown = out(&run(&["run", "--method", methods]));
    assert!(shown.lines().all(|line| line.chars().count() <= 80), "{shown}");
    let of_peak = shown.lines().filter(|line| line.starts_with("  padding.peak-force "));
    assert_eq!(of_peak.map(|line| line.matches('±').count()).sum::<usize>(), 5);
    let measures =
        "[measures]\npad = [{ kind = \"peak-force\", window = \"run\" }, \"peak-force\"]\n";
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "two.toml", &(SOFT.to_owned() + measures));
    let shown = out(&run(&["run", text(&scene)]));
    assert!(shown.contains("pad.peak-force (impact)"), "{shown}");
    assert!(shown.contains("pad.peak-force-2 (run)"), "{shown}");
}

#[test]
fn what_vanishes_is_a_plain_zero() {
    let folder = TempDir::new().unwrap();
    let law = "kelvin-voigt = { spring = \"K\", dashpot = \"80 N s/m\" }";
    let scene = SOFT.replace(law, "spring = \"K\"");
    let shown = out(&run(&["run", text(&file(&folder, "spring.toml", &scene))]));
    assert!(shown.contains("pad absorbs 0 J of 90 J\n"), "{shown}");
    let row = shown.lines().find(|line| line.starts_with("  pad.energy ")).unwrap();
    let words: Vec<&str> = row.split_whitespace().collect();
    assert!(words[1] == "0" && words[2].starts_with('±') && words[3] == "J", "{row}");
}

#[test]
fn larger_force_elsewhere_is_told() {
    let verdict = out(&run(&["run"]));
    assert!(verdict.contains("  elsewhere        47.9 kN in mount at 3.51 ms\n"), "{verdict}");
}

#[test]
fn work_put_in_is_told_beside_the_energy_of_the_impact() {
    let verdict = out(&run(&["run", "reference-gravity"]));
    let line = verdict.lines().find(|line| line.starts_with("  energy ")).unwrap();
    assert!(line.contains("of 500 J and ") && line.contains(" put in ("), "{line}");
}

#[test]
fn pad_that_bottoms_out_says_so_first() {
    let folder = TempDir::new().unwrap();
    let output = run(&["run", text(&file(&folder, "soft.toml", SOFT))]);
    assert_eq!(code(&output), 0);
    let verdict = out(&output);
    assert!(verdict.lines().take(3).any(|line| line.contains("23.2 mm more than its")));
    assert!(verdict.contains(": 177 % of 30 mm, 23.2 mm MORE than"), "{verdict}");
}

#[test]
fn folder_of_results_holds_every_form_and_is_never_foreign() {
    let folder = TempDir::new().unwrap();
    let results = folder.path().join("results");
    for _ in 0..2 {
        let output = run(&["run", "--out", text(&results)]);
        assert_eq!(code(&output), 0, "{}", err(&output));
        assert!(out(&output).contains("report.html"));
    }
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    for figure in ["force-time", "deformation-time", "force-deformation", "energy-time", "network"]
    {
        assert!(read(&format!("{figure}.svg")).starts_with("<svg"), "{figure}");
    }
    assert!(read("report.html").contains("38.36 kN"));
    assert_eq!(read("scene-as-run.toml"), dashpot::scene::reference());
    let answer: Value = serde_json::from_str(&read("result.json")).unwrap();
    assert_eq!(answer["runs"].as_array().unwrap().len(), 2);
    let table = read("exact.csv");
    let mut lines = table.lines();
    let header = lines.next().unwrap();
    assert!(header.starts_with("time [s],") && header.contains("padding.force [N]"), "{header}");
    assert_eq!(lines.count(), 501);
    assert!(results.join("bdf.csv").exists());

    let foreign = folder.path().join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("exact.csv"), "mine").unwrap();
    let output = run(&["run", "--out", text(&foreign)]);
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("exact.csv` exists already"));
    assert_eq!(fs::read_to_string(foreign.join("exact.csv")).unwrap(), "mine");
}

#[test]
fn check_counts_what_is_valid_and_points_at_what_is_not() {
    let output = run(&["check", "reference"]);
    assert_eq!(
        (code(&output), out(&output).as_str()),
        (0, "ok: 2 nodes, 2 elements, 6 unknowns, linear\n")
    );

    let folder = TempDir::new().unwrap();
    let wrong = SOFT.replace("80 N s/m", "80 N").replace("thickness", "thicknes");
    let wrong = file(&folder, "wrong.toml", &wrong);
    let output = run(&["check", "reference-stiff", text(&wrong)]);
    assert_eq!(code(&output), 2);
    assert!(out(&output).contains("reference-stiff: ok") && out(&output).contains("not valid"));
    let errors = err(&output);
    for part in ["wrong.toml:7:", "a damping (N s/m) is expected here", "did you mean `thickness`?"]
    {
        assert!(errors.contains(part), "{part}:\n{errors}");
    }
}

#[test]
fn check_finds_what_no_method_could_do() {
    let folder = TempDir::new().unwrap();
    let scene = SOFT.to_owned() + "[accuracy]\npad.hic15 = 0.1\n";
    assert_eq!(code(&run(&["check", text(&file(&folder, "a.toml", &scene))])), 2);
    let scene = SOFT.to_owned() + "[accuracy]\npad.peak-rate = 0.1\n";
    let output = run(&["check", text(&file(&folder, "b.toml", &scene))]);
    assert_eq!(code(&output), 2);
    assert!(
        err(&output).contains("`pad.peak-rate` is not among the measures that are reported"),
        "{}",
        err(&output)
    );
}

#[test]
fn explain_draws_and_names_all_that_was_built() {
    let folder = TempDir::new().unwrap();
    let drawing = folder.path().join("network.svg");
    let output = run(&["explain", "reference-gravity", "--verbose", "--out", text(folder.path())]);
    assert_eq!(code(&output), 0);
    let shown = out(&output);
    for part in [
        "head",
        "20 MN/m",
        "padding.maxwell.dashpot",
        "velocity of panel",
        "gravity              on",
        "would choose `exact`",
        "head.severity-index",
    ] {
        assert!(shown.contains(part), "{part}:\n{shown}");
    }
    assert!(fs::read_to_string(drawing).unwrap().starts_with("<svg"));
}

#[test]
fn explain_begins_with_what_is_written_in_its_units() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "soft.toml", &SOFT.replace("50 kN/m", "0.05 MN/m"));
    let shown = |more: &[&str]| out(&run(&[&["explain", text(&scene)][..], more].concat()));
    let plain = shown(&[]);
    let parts =
        ["As it is written", "0.05 MN/m", "What it becomes", "50 kN/m", "Effects", "Solving"];
    let places = parts.map(|part| plain.find(part).unwrap_or_else(|| panic!("{part}:\n{plain}")));
    assert!(places.is_sorted(), "{places:?}\n{plain}");
    assert!(shown(&["--set", "K=40 N/mm"]).contains("40 N/mm"));
    for hidden in ["guards ", "velocity of ", "modes ", "algebraic  "] {
        assert!(
            !plain.replace("`--verbose` adds the modes, guards", "").contains(hidden),
            "{plain}"
        );
    }
    let verbose = shown(&["--verbose"]);
    for part in ["guards", "modes", "Unknowns with their units"] {
        assert!(verbose.contains(part), "{part}:\n{verbose}");
    }
}

#[test]
fn list_has_every_registered_kind() {
    let mut words: Vec<&str> = ELEMENTS.iter().map(|own| own.word).collect();
    words.extend(FORMS.iter().map(|own| own.word));
    words.extend(WAVEFORMS.iter().map(|own| own.word));
    words.extend(EFFECTS.iter().map(|own| own.word));
    words.extend(MEASURES.iter().map(|own| own.word));
    words.extend(METHODS.iter().map(|own| own.name));
    words.extend(templates().iter().map(|shipped| shipped.name));
    let list = out(&run(&["list"]));
    for word in words {
        let begins = |line: &str| {
            let first = line.strip_prefix("  ").and_then(|line| line.split(' ').next());
            first.is_some_and(|first| first.trim_end_matches('*') == word)
        };
        assert!(list.lines().any(begins), "{word}");
    }
    assert!(!out(&run(&["list", "methods"])).contains("spring"));
    let one = out(&run(&["list", "kelvin"]));
    assert!(one.contains("also called kelvin") && !one.contains("maxwell"), "{one}");
    assert!(out(&run(&["list", "contact-time"])).contains("contact-time*"));
    assert_eq!(code(&run(&["list", "nothing"])), 2);
}

#[test]
fn new_scenes_run_and_are_not_overwritten() {
    let folder = TempDir::new().unwrap();
    for shipped in templates() {
        let path = folder.path().join(format!("{}.toml", shipped.name));
        let arguments = ["new", shipped.name, "--out", text(&path)];
        assert_eq!(code(&run(&arguments)), 0);
        let again = run(&arguments);
        assert_eq!(code(&again), 2);
        assert!(err(&again).contains("--force"));
        assert_eq!(code(&run(&[&arguments[..], &["--force"]].concat())), 0);
        let output = run(&["run", text(&path)]);
        assert_eq!(code(&output), 0, "{}", err(&output));
    }
    assert_eq!(out(&run(&["new", "chain"])), dashpot::scene::template("chain").unwrap());
}

#[test]
fn schema_and_completions_are_printed() {
    let schema: Value = serde_json::from_slice(&run(&["schema"]).stdout).unwrap();
    assert!(schema["properties"]["elements"].is_object());
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(out(&run(&["completions", shell])).contains("explain"), "{shell}");
    }
}

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
    let cases: [(&[&str], &str); 11] = [
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
            "such as \"1 mm\" or \"0.5 g\"",
        ),
        (&["fly"], "unrecognized subcommand"),
    ];
    for (arguments, part) in cases {
        let output = run(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(err(&output).contains(part), "{arguments:?}: {}", err(&output));
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

#[test]
fn colours_come_when_they_are_asked_for() {
    assert!(out(&run(&["run", "--color", "always"])).contains('\u{1b}'));
    assert!(!out(&run(&["run", "--color", "never"])).contains('\u{1b}'));
}

#[test]
fn plot_is_drawn_when_it_is_asked_for() {
    let plotted = out(&run(&["run", "--plot", "always"]));
    assert!(plotted.contains("force (kN)"));
    assert!(plotted.lines().all(|line| line.chars().count() <= 80), "{plotted}");
    assert!(!out(&run(&["run"])).contains("force (kN)"));
}

#[test]
fn reader_that_goes_away_is_no_error() {
    let mut child =
        command(&["schema"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), err(&output).as_str()), (0, ""));
}
