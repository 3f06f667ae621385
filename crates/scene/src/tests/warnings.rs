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
    has(&thick("0.000004"), &["`thickness` is 4e-6 m, which is very little"]);
    assert_eq!(thick("\"40 m\"") + &thick("0.04") + &thick("1"), "");
    let shown = warnings("head = { mass = 250000, velocity = 1 }", PAD, RUN);
    has(&shown, &["`mass` is 250000 kg: did you mean g?"]);
    let shown = warnings(HEAD, PAD, "[run]\nduration = 20\n");
    has(&shown, &["`run.duration` is 20 s: did you mean ms?", "\"20 ms\""]);
    assert_eq!(warnings(HEAD, PAD, "[run]\nduration = \"20 s\"\n"), "");
    let named = format!("[values]\nT = 20\n{}", RUN.replace("50 ms", "T"));
    has(&warnings(HEAD, PAD, &named), &["did you mean ms?"]);
}

#[test]
fn limits_without_a_unit_are_told_in_that_of_the_field() {
    let limit = |own: &str| warnings(HEAD, PAD, &format!("{RUN}[limits]\n{own}\n"));
    let shown = limit("head.peak-acceleration = { max = 250 }");
    // 250/9.80665
    has(&shown, &["warning: `250` has no unit: it is read as 250 m/s^2 = 25.49 g", "^^^"]);
    has(&shown, &["help: write \"250 g\" or \"250 m/s^2\""]);
    has(&limit("pad.peak-force = 20"), &["20 N = 0.02 kN", "\"20 kN\" or \"20 N\""]);
    has(&limit("pad.contact-time = { min = 5 }"), &["5 s = 5000 ms"]);
    has(&limit("pad.energy = 50"), &["read as 50 J", "write \"50 J\""]);
    let named = format!("{RUN}[limits]\npad.peak-force = \"most\"\n[values]\nmost = 20\n");
    has(
        &warnings(HEAD, PAD, &named),
        &["`20` has no unit: it is read as 20 N = 0.02 kN", "most = 20"],
    );
    // Indices are plain numbers, and zero is the same in all units.
    for own in ["head.hic15 = 700", "head.severity-index = 1500", "pad.end-force = { min = 0 }"] {
        assert_eq!(limit(own), "", "{own}");
    }
    assert_eq!(limit("head.peak-acceleration = [\"250 g\", { min = \"1 m/s^2\" }]"), "");
}

#[test]
fn what_is_set_without_a_unit_is_refused_where_the_scene_has_another_than_that_of_si() {
    let text = "[values]\nK = \"4 kN/m\"\nC = \"40 N s/m\"\n[nodes]\nhead = { mass = 5, velocity = \"1 m/s\" }\n\
                [elements.pad]\nbetween = [\"head\", \"ground\"]\nthickness = \"30 mm\"\nkelvin-voigt = { spring = \"K\", \
                dashpot = \"C\" }\n[run]\nduration = \"50 ms\"\n";
    let set = |name: &str, value: &str| {
        let set = [(name.to_owned(), value.to_owned())];
        let read = crate::read(text, &crate::ReadOptions { set: &set, ..Default::default() });
        read.map_or_else(|errors| errors.render(false), |_| "read".to_owned())
    };
    for (name, value, scene) in [
        ("K", "5", "a bare number is in N/m, and the scene says 4 kN/m"),
        ("pad.spring", "5", "a bare number is in N/m, and the scene says 4 kN/m"),
        ("pad.thickness", "30", "a bare number is in m, and the scene says 30 mm"),
    ] {
        let shown = set(name, value);
        has(&shown, &[&format!("error: `{name}={value}` has no unit: {scene}"), "help: write \""]);
        has(&shown, &[&format!("{name}={value} {}", scene.rsplit_once(' ').unwrap().1)]);
    }
    // What counts in SI units in the scene may be set in them, and zero is the same in all.
    for (name, value) in [
        ("K", "5 kN/m"),
        ("pad.thickness", "3 cm"),
        ("C", "50"),
        ("head.mass", "4"),
        ("head.velocity", "2"),
        ("K", "0"),
    ] {
        assert_eq!(set(name, value), "read", "{name}={value}");
    }
}

#[test]
fn bare_numbers_are_looked_at_wherever_a_kind_has_a_parameter() {
    let load = |force: &str| {
        let load = format!("{RUN}[loads.f]\non = \"head\"\nforce = {{ {force} }}\n");
        warnings(HEAD, PAD, &load)
    };
    let pulse = load("half-sine = { peak = 100, duration = 6 }");
    has(&pulse, &["`duration` is 6 s: did you mean ms?", "write it with its unit: \"6 ms\""]);
    assert_eq!(load("half-sine = { peak = 100, duration = \"6 s\" }"), "");
    let measured = |own: &str| warnings(HEAD, PAD, &format!("{RUN}[measures]\nhead = {{ {own} }}"));
    has(&measured("kind = \"hic\", cap = 15"), &["`cap` is 15 s: did you mean ms?"]);
    has(&measured("kind = \"clip\", duration = 3"), &["`duration` is 3 s: did you mean ms?"]);
    let shown = measured("kind = \"peak-acceleration\", window = [0, 15]");
    has(&shown, &["`15` is 15 s: did you mean ms?"]);
    let pad = |law: &str| warnings(HEAD, &PAD.replace("spring = \"1 kN/m\"", law), RUN);
    // Of a table only the largest value is told.
    let shown = pad("table-spring = [[0, 0], [2, 300], [4, 800]]");
    has(&shown, &["`4` is 4 m: did you mean mm?"]);
    assert_eq!(shown.matches("warning").count(), 1, "{shown}");
    assert_eq!(pad("table-spring = [[0, 0], [0.002, 300], [0.004, 800]]"), "");
    let shown = pad("prony = { terms = [[\"5\", \"60 kN/m\"], [\"1 ms\", \"1 kN/m\"]] }");
    has(&shown, &["`5` is 5 s: did you mean ms?"]);
    let gravity = |own: &str| warnings(HEAD, PAD, &format!("{RUN}[effects]\ngravity = {own}\n"));
    has(&gravity("{ value = 981 }"), &["`value` is 981 m/s^2: did you mean cm/s^2?"]);
    assert_eq!(gravity("{ value = 9.81 }") + &gravity("{ value = \"100 g0\" }"), "");
}

#[test]
fn a_small_letter_in_place_of_a_capital_one_is_told() {
    let pad = |law: &str| warnings(HEAD, &PAD.replace("spring = \"1 kN/m\"", law), RUN);
    let shown = pad("spring = \"20 mN/m\"");
    has(&shown, &["\"20 mN/m\" has a small `m`, for milli: did you mean MN/m?", "\"20 MN/m\""]);
    let foam = |modulus: &str| {
        pad(&format!(
            "foam = {{ modulus = \"{modulus}\", plateau = \"10 kPa\", densification = \"1 kPa\", \
             exponent = 3 }}, thickness = \"2 cm\", area = \"1 dm^2\""
        ))
    };
    has(&foam("0.6 mPa"), &["\"0.6 mPa\" has a small `m`", "did you mean MPa?"]);
    assert_eq!(foam("0.6 MPa") + &foam("600 kPa") + &pad("spring = \"0.02 N/m\""), "");
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
    let still = "warning: nothing moves: no node has `velocity`, `drop` or `position`, there is no load \
                 and no motion";
    let head = "head = { mass = \"1 kg\" }";
    assert_eq!(warnings("head = { mass = \"1 kg\", position = \"1 mm\" }", PAD, RUN), "");
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
fn a_pad_behind_the_impactor_is_not_reversed() {
    let pads = |speed: &str| {
        let head = HEAD.replace("1 m/s", speed);
        let back = "back = { between = [\"ground\", \"head\"], spring = 1 }";
        warnings(&head, &format!("{PAD}\n{back}"), RUN)
    };
    assert_eq!(pads("1 m/s") + &pads("-1 m/s"), "");
    let back = PAD.replace("\"head\", \"ground\"", "\"ground\", \"head\"");
    assert_eq!(warnings(&HEAD.replace("1 m/s", "-1 m/s"), &back, RUN), "");
    has(&warnings(HEAD, &back, RUN), &["`pad` looks reversed"]);
}

/// The warnings on a scene that is driven at the node `base`, with a file beside it.
fn driven(driven: &str, csv: &str) -> String {
    let text = format!(
        "[nodes]\nhead = {{ mass = 1 }}\nbase = {driven}\n[elements]\n\
         pad = {{ between = [\"head\", \"base\"], spring = 1 }}\n[run]\nduration = \"0.5 s\"\n"
    );
    let loader = |_: &str| Ok(csv.into());
    let options = crate::ReadOptions { loader: Some(&loader), ..crate::ReadOptions::default() };
    crate::read(&text, &options).unwrap().warnings.render(false)
}

#[test]
fn a_support_that_drifts_away_is_told_with_its_way() {
    let sine = |more: &str| {
        let sine = format!("{{ sine = {{ amplitude = 20, frequency = \"10 Hz\"{more} }} }}");
        driven(&format!("{{ acceleration = {sine} }}"), "")
    };
    // The mean velocity is A/ω = 0.3183 m/s, over 5 whole periods.
    let shown = sine("");
    has(&shown, &["`base` drift away: 159.155 mm in 500 ms, at 318 mm/s in the mean"]);
    has(&shown, &["`phase = \"90 deg\"`", "`motion`"]);
    assert_eq!(sine(", phase = \"90 deg\""), "");
    let table = |points: &str| driven(&format!("{{ acceleration = {{ table = {points} }} }}"), "");
    // 10 mm in the first 0.1 s, then 0.1 m/s.
    let shown = table("[[0, 3], [0.05, 3], [0.05, -1], [0.1, -1], [0.1, 0]]");
    has(&shown, &["`base` drift away: 50.000 mm in 500 ms", "take its mean off the record"]);
    assert_eq!(table("[[0, 1], [0.05, 1], [0.05, -1], [0.1, -1], [0.1, 0]]"), "");
    // A car that is braked goes on on purpose.
    let braked = "{ velocity = 9, acceleration = { table = [[0, -3], [0.4, -30], [0.5, 1]] } }";
    assert_eq!(driven(braked, ""), "");
    // A shock leaves the table with a speed on purpose.
    assert_eq!(table("[[0, 0], [0.005, 400], [0.01, 0]]"), "");
    assert_eq!(driven("{ motion = { sine = { amplitude = 1, frequency = 10 } } }", ""), "");
}

#[test]
fn a_pulse_that_does_not_end_at_zero_is_told_with_what_holds() {
    let rows = |last: &str| format!("time [ms],a [m/s^2]\n0,0\n10,30\n20,{last}\n");
    let pulse = |last: &str| driven("{ acceleration = { table = \"a.csv\" } }", &rows(last));
    let shown = pulse("2");
    has(&shown, &["`base` ends at 20 ms with 2 m/s^2", "held to the end of the run at 500 ms"]);
    has(&shown, &["help: write `outside = \"zero\"` for zero there"]);
    assert_eq!(pulse("0") + &pulse("0.001"), "");
    let push = |last: &str| {
        let load = "[loads]\nf = { on = \"head\", force = { table = \"f.csv\" } }\n";
        let text = format!("{RUN}{load}[nodes]\n{HEAD}\n[elements]\n{PAD}\n");
        let csv = format!("time [ms],f [N]\n0,0\n10,30\n20,{last}\n");
        let loader = |_: &str| Ok(csv.clone().into());
        let options = crate::ReadOptions { loader: Some(&loader), ..crate::ReadOptions::default() };
        crate::read(&text, &options).unwrap().warnings.render(false)
    };
    has(&push("-3"), &["the table of the load `f` ends at 20 ms with -3 N, which is held"]);
    assert_eq!(push("0"), "");
}

#[test]
fn a_stop_below_the_padding_is_told() {
    let stop = |at: &str| {
        let pad = PAD.replace("spring", "thickness = \"25 mm\", spring");
        let effects = format!("{RUN}[effects]\nstop.pad = {{ at = \"{at}\" }}\n");
        warnings(HEAD, &pad, &effects)
    };
    has(&stop("30 mm"), &["the stop of `pad` at 30 mm lies deeper than its thickness of 25 mm"]);
    has(&stop("30 mm"), &["^^^^^^^", "leave it out for the thickness"]);
    assert_eq!(stop("25 mm") + &stop("20 mm"), "");
}

#[test]
fn a_drop_without_gravity_is_noted() {
    let notes = |rest: &str| {
        let head = HEAD.replace("velocity = \"1 m/s\"", "drop = \"1.5 m\"");
        let text = format!("{RUN}{rest}[nodes]\n{head}\n[elements]\n{PAD}\n");
        read_text(&text).unwrap().value.notes
    };
    let told = notes("");
    assert_eq!((told.len(), told[0].subject.as_str()), (1, "node `head`"));
    has(&told[0].what.to_string(), &["dropped from 1.5 m with gravity off", "weighs nothing"]);
    assert!(notes("[effects]\ngravity = {}\n").is_empty());
}

#[test]
fn weight_away_from_the_support_is_noted() {
    let notes = |value: &str| {
        let text = format!(
            "{RUN}[effects]\ngravity = {{ value = \"{value}\" }}\n[nodes]\n{HEAD}\n[elements]\n{PAD}\n"
        );
        read_text(&text).unwrap().value.notes
    };
    let told = notes("-1 g0");
    assert_eq!((told.len(), told[0].subject.as_str()), (1, "gravity"));
    has(
        &told[0].what.to_string(),
        &["-9.807 m/s^2 pulls away from the support; positive is towards it"],
    );
    assert!(notes("1 g0").is_empty());
}

#[test]
fn a_reversed_pair_is_written_out() {
    let nodes = format!("{HEAD}\npanel = {{ mass = 1 }}");
    let elements = "pad = { between = [\"panel\", \"head\"], spring = 1 }\n\
                    mount = { between = [\"panel\", \"ground\"], spring = 1 }";
    let shown = warnings(&nodes, elements, RUN);
    has(&shown, &["`pad` looks reversed", "help: write [\"head\", \"panel\"]"]);
}

#[test]
fn long_messages_are_wrapped_and_long_lines_are_cut_around_the_place() {
    let nodes = format!("{HEAD}\npanel = {{ mass = 1 }}");
    let elements = "pad = { between = [\"panel\", \"head\"], spring = 1 }";
    let text = format!("{RUN}\n[nodes]\n{nodes}\n[elements]\n{elements}\n");
    let warnings = read_text(&text).unwrap().warnings;
    let shown = warnings.render_within(false, 40);
    assert!(shown.lines().all(|line| line.chars().count() <= 40), "{shown}");
    has(&shown, &["...een = [\"panel\", \"head\"], sprin..."]);
    let words = |text: &str| {
        let plain = text.lines().filter(|line| !line.contains(" | "));
        plain.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ")
    };
    let whole = warnings.render(false);
    has(&whole, &["\n8 | pad = { between = [\"panel\", \"head\"], spring = 1 }\n"]);
    assert_eq!(words(&shown), words(&whole));
}
