//! What is odd in scenes that can be read.

use super::read_text;

/// The warnings on a scene with these entries in its tables.
fn warnings(nodes: &str, elements: &str, rest: &str) -> String {
    let text = format!("{rest}\n[nodes]\n{nodes}\n[elements]\n{elements}\n");
    read_text(&text).unwrap_or_else(|errors| panic!("{errors}")).warnings.render(false)
}

const HEAD: &str = "head = { mass = \"1 kg\", velocity = \"1 m/s\" }";
const PAD: &str = "pad = { between = [\"head\", \"ground\"], spring = \"1 kN/m\" }";
const RUN: &str = "[run]\nduration = \"50 ms\"\n";

#[track_caller]
fn has(shown: &str, parts: &[&str]) {
    for part in parts {
        assert!(shown.contains(part), "no {part:?} in\n{shown}");
    }
}

#[test]
fn a_sound_scene_has_no_warnings() {
    assert_eq!(warnings(HEAD, PAD, RUN), "");
    for shipped in crate::templates().iter().chain(crate::references()) {
        let read = read_text(shipped.text).unwrap();
        assert!(read.warnings.is_empty(), "{}: {}", shipped.name, read.warnings);
    }
}

#[test]
fn bare_numbers_that_cannot_be_meant_are_told() {
    let thick = |value: &str| {
        warnings(HEAD, &PAD.replace("spring", &format!("thickness = {value}, spring")), RUN)
    };
    let shown = thick("40");
    has(&shown, &["warning: `thickness` is 40 m: did you mean mm?", "^^"]);
    has(&shown, &["help: a bare number is in m; write it with its unit: \"40 mm\""]);
    has(&thick("0.000004"), &["`thickness` is 0.000004 m, which is very little"]);
    assert_eq!(thick("\"40 m\"") + &thick("0.04") + &thick("1"), "");
    let shown = warnings("head = { mass = 250000, velocity = 1 }", PAD, RUN);
    has(&shown, &["`mass` is 250000 kg: did you mean g?"]);
    let shown = warnings(HEAD, PAD, "[run]\nduration = 20\n");
    has(&shown, &["`duration` is 20 s: did you mean ms?", "\"20 ms\""]);
    assert_eq!(warnings(HEAD, PAD, "[run]\nduration = \"20 s\"\n"), "");
    let named = format!("[values]\nT = 20\n{}", RUN.replace("50 ms", "T"));
    has(&warnings(HEAD, PAD, &named), &["did you mean ms?"]);
}

#[test]
fn points_without_influence_are_told() {
    let load = |table: &str| {
        let load = format!("{RUN}[loads.f]\non = \"head\"\nforce = {{ table = {table} }}\n");
        warnings(HEAD, PAD, &load)
    };
    let shown = load("[[0, 1], [5, 1], [8, 0]]");
    has(&shown, &["warning: 2 of 3 points lie after the end of the run at 50 ms", "[[0, 1]"]);
    has(&load("[[0, 1], [5, 1]]"), &["1 of 2 points lies after the end of the run at 50 ms"]);
    has(&load("[[0, \"5 N\"]]"), &["warning: a table with one point is a constant for ever"]);
    assert_eq!(load("[[0, 1], [\"50 ms\", 0]]"), "");
    let base = format!("{HEAD}\nbase.motion.table = [[\"60 ms\", 0]]");
    let pads = format!("{PAD}\nback = {{ between = [\"head\", \"base\"], spring = 1 }}");
    let shown = warnings(&base, &pads, RUN);
    has(&shown, &["1 of 1 points lies after", "a table with one point"]);
}

#[test]
fn a_scene_in_which_nothing_moves_is_told() {
    let still = "warning: nothing moves: no node has `velocity` or `drop`, there is no load and \
                 no motion";
    let head = "head = { mass = \"1 kg\" }";
    has(&warnings(head, PAD, RUN), &[still]);
    has(&warnings(head, PAD, &format!("{RUN}[effects]\ngravity = {{}}\n")), &[still]);
    let falls = format!("{RUN}[effects]\ngravity = {{ start = \"unloaded\" }}\n");
    assert_eq!(warnings(head, PAD, &falls), "");
    let load = format!("{RUN}[loads.f]\non = \"head\"\nforce = {{ constant = 1 }}\n");
    assert_eq!(warnings(head, PAD, &load), "");
}

#[test]
fn what_nothing_uses_is_told() {
    let values = format!("[values]\nK = \"1 kN/m\"\nL = \"K\"\nC = 1\n{RUN}");
    let shown = warnings(HEAD, &PAD.replace("1 kN/m", "L"), &values);
    has(&shown, &["warning: nothing uses the value `C`", "scene.toml:4:1"]);
    has(&shown, &["help: write \"C\" where it is meant, or remove it"]);
    assert_eq!(shown.matches("warning").count(), 1, "{shown}");
    let shown = warnings(&format!("{HEAD}\nlonely = {{ mass = 1 }}"), PAD, RUN);
    has(&shown, &["warning: no element touches `lonely`"]);
}

#[test]
fn an_impactor_that_leaves_is_told() {
    let away = HEAD.replace("1 m/s", "-1 m/s");
    let shown = warnings(&away, PAD, RUN);
    has(&shown, &["warning: `head` moves away from the support: positive is towards it"]);
    has(&shown, &["^^^^^^^^"]);
    let turned = PAD.replace("\"head\", \"ground\"", "\"ground\", \"head\"");
    assert!(!warnings(&away, &turned, RUN).contains("moves away"));
}

#[test]
fn a_reversed_pair_is_written_out() {
    let nodes = format!("{HEAD}\npanel = {{ mass = 1 }}");
    let elements = "pad = { between = [\"panel\", \"head\"], spring = 1 }\n\
                    mount = { between = [\"panel\", \"ground\"], spring = 1 }";
    let shown = warnings(&nodes, elements, RUN);
    has(&shown, &["`pad` looks reversed", "help: write [\"head\", \"panel\"]"]);
}
