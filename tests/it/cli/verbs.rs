//! The verbs that solve nothing.

use std::fs;

use dashpot::{
    analysis::measures::MEASURES,
    dae::methods::METHODS,
    network::{effects::EFFECTS, elements::ELEMENTS, waveforms::WAVEFORMS},
    rheology::FORMS,
    scene::templates,
};
use serde_json::Value;
use tempfile::TempDir;

use super::{SOFT, code, err, file, out, run, text};

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
