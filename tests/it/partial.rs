//! What is left out of runs, and what `explain` says about effects, as users meet it.

use std::{fs, path::Path};

use dashpot::network::effects::EFFECTS;
use tempfile::TempDir;

use crate::{
    cli::{code, err, json, out, run, said},
    scenes::scene_path,
};

const GRAVITY: &str = "reference-gravity";

fn wide(text: &str) -> Option<&str> {
    text.lines().find(|line| line.chars().count() > 80)
}

/// The section of a text from a heading to the next one.
fn section<'t>(text: &'t str, heading: &str) -> &'t str {
    let start = text.find(&format!("\n{heading}\n")).unwrap() + 1;
    let next = text[start..].find("\n\nSolving\n").unwrap();
    &text[start..start + next]
}

#[test]
fn gravity_is_put_back_at_half_a_percent_and_left_out_at_one() {
    let full = json(&["run", GRAVITY, "--json", "--method", "exact"]);
    let bare = json(&["run", "--json", "--method", "exact"]);
    assert!(full["runs"][0]["partial"].is_null() && full["settings"]["neglect_below"].is_null());
    let at =
        |bound: &str| json(&["run", GRAVITY, "--json", "--method", "exact", "--neglect", bound]);
    let value = |answer: &serde_json::Value, key: &str| {
        answer["runs"][0]["measures"][key]["value"].as_f64().unwrap()
    };
    let kept = at("0.5%");
    let partial = &kept["runs"][0]["partial"];
    assert_eq!(partial["left_out"].as_array().unwrap().len(), 0);
    assert_eq!(partial["put_back"][0]["effect"], "gravity");
    assert_eq!(partial["put_back"][0]["moves"]["measure"], "padding.contact-time");
    assert_eq!(kept["runs"][0]["measures"], full["runs"][0]["measures"]);

    let left = at("1%");
    let partial = &left["runs"][0]["partial"];
    assert_eq!(partial["left_out"][0]["effect"], "gravity");
    assert_eq!(left["settings"]["neglect_below"], 0.01);
    assert!(left["runs"][0]["system"]["effects"].as_array().unwrap().is_empty());
    for (key, moved) in partial["moved"].as_object().unwrap() {
        let (with, without) = (value(&full, key), value(&bare, key));
        assert_eq!(value(&left, key).to_bits(), without.to_bits(), "{key}");
        // Sizes of these measures are their values; the small remainder of two speeds counts as a twentieth of 1.
        let is_ratio = key.ends_with("coefficient-of-restitution");
        let least = if is_ratio { 0.05 } else { 0.0 };
        let size = with.abs().max(without.abs()).max(least);
        let expected = (with - without).abs() / size;
        assert!((moved.as_f64().unwrap() - expected).abs() <= 1e-12, "{key}: {moved}");
    }
}

#[test]
fn the_text_and_the_page_say_what_was_left_out() {
    let folder = TempDir::new().unwrap();
    let results = folder.path().join("results");
    let results = results.to_str().unwrap();
    let output = run(&["run", GRAVITY, "--neglect", "1%", "--out", results]);
    assert_eq!(code(&output), 0, "{}", err(&output));
    let text = out(&output);
    assert_eq!(wide(&text), None, "{text}");
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = words(&text);
    for part in [
        "left out gravity (A = g δ/V0² = 0.0020): `padding.contact-time` moves by",
        "0.77 %, the most of all; checked by 1 further run in",
        "every figure within 0.8 % (a bound of `exact` and what was left out)",
    ] {
        assert!(said.contains(part), "{part}: {text}");
    }
    let read = |name: &str| fs::read_to_string(Path::new(results).join(name)).unwrap();
    assert!(read("report.html").contains("left out: gravity"), "no page says it");
    assert!(
        read("scene-as-run.toml").contains("neglect-below = 0.01"),
        "{}",
        read("scene-as-run.toml")
    );
    let text = out(&run(&["run", GRAVITY, "--neglect", "0.5%"]));
    let says = "without it `padding.contact-time` moves by 0.77 %, more than 0.50 %";
    assert!(words(&text).contains(says), "{text}");
    assert!(!out(&run(&["run", GRAVITY])).contains("left out"));
}

#[test]
fn explain_has_a_row_for_each_effect_on_or_off() {
    for scene in ["reference", GRAVITY] {
        let text = out(&run(&["explain", scene, "--verbose"]));
        assert_eq!(wide(&text), None, "{text}");
        let section = section(&text, "Effects");
        for word in EFFECTS.iter().map(|own| own.word) {
            let row = section.lines().find(|line| line.trim_start().starts_with(word));
            let row = row.unwrap_or_else(|| panic!("{word} in {section}"));
            let state = row.split_whitespace().nth(1).unwrap();
            let is_on = word == "gravity" && scene == GRAVITY;
            assert_eq!(state, if is_on { "on" } else { "off" }, "{row}");
        }
        assert!(section.contains("g δ/V0² = 0.0020"), "{section}");
    }
}

#[test]
fn explain_says_what_is_dropped_and_what_is_put_back() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    let state = |bound: &str| {
        let text = fs::read_to_string(scene_path(GRAVITY)).unwrap();
        fs::write(&path, format!("{text}[accuracy]\nneglect-below = \"{bound}\"\n")).unwrap();
        let text = out(&run(&["explain", path.to_str().unwrap()]));
        let rows = section(&text, "Effects").to_owned();
        let row = rows.lines().find(|line| line.trim_start().starts_with("gravity")).unwrap();
        row.trim_start().to_owned()
    };
    assert!(state("1 %").starts_with("gravity              dropped "), "{}", state("1 %"));
    assert!(state("0.5 %").starts_with("gravity              put back"), "{}", state("0.5 %"));
    assert!(state("0.1 %").starts_with("gravity              on "), "{}", state("0.1 %"));
}

#[test]
fn explain_counts_what_compiling_with_and_without_gives() {
    // The support is a mass with a place and a speed; without it two unknowns go.
    let text = out(&run(&["explain", "reference", "--verbose"]));
    let rows = section(&text, "Effects");
    let row = |word: &str| {
        let row = rows.lines().find(|line| line.trim_start().starts_with(word)).unwrap();
        row.split_whitespace().map(str::to_owned).collect::<Vec<_>>()
    };
    let support = row("compliance of panel");
    assert_eq!(support[3..5], ["on", "2"], "{rows}");
    // A contact has two phases, and one guard that ends the first of them.
    assert_eq!(row("stop.padding")[1..4], ["off", "0", "×2"], "{rows}");
    assert_eq!(row("stop.padding")[5], "1", "{rows}");
    // Weights of head and panel enter the equations of both.
    assert_eq!(row("gravity")[1..5], ["off", "0", "–", "2"], "{rows}");
}

#[test]
fn parts_that_switch_show_their_phases() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("scene.toml");
    let text = fs::read_to_string(scene_path("reference")).unwrap();
    fs::write(&path, format!("{text}[effects]\nseparation.padding = true\n")).unwrap();
    let text = out(&run(&["explain", path.to_str().unwrap()]));
    let part = text.lines().find(|line| line.contains("open / closed")).unwrap();
    let words: Vec<&str> = part.split_whitespace().collect();
    assert_eq!(words, ["contact", "padding.contact", "open", "/", "closed"], "{text}");
}

#[test]
fn a_bound_that_is_no_share_is_refused() {
    for (bound, told) in [
        ("0", "more than 0 and at most 20%"),
        ("5 mm", "0.1%"),
        ("1", "a bare 1 is 100%; write \"1%\""),
        ("0.1", "a bare 0.1 is 10%; write \"0.1%\" or \"10%\""),
        ("0.5", "write \"0.5%\""),
        ("21%", "at most 20%"),
    ] {
        for option in ["--neglect", "--accuracy"] {
            let output = run(&["run", option, bound]);
            assert_eq!(code(&output), 2);
            let shown = said(&output);
            assert!(shown.contains(told), "{shown}");
        }
    }
}
