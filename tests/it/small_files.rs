//! Small files that stand for much: they take memory in proportion to what they stand for, or are refused
//! before any work.

use std::{
    fmt::Write,
    path::Path,
    process::{Command, Output},
    time::Instant,
};

use tempfile::TempDir;

use crate::cli::{code, err, file, json, out, run, text};

/// A pad of `count` to the power of `levels` equal parts, by models within models.
fn nested(levels: usize, count: usize, law: &str) -> String {
    let mut scene = "[nodes]\nhead = { mass = 5, velocity = 3 }\n[elements]\npad = { between = \
                     [\"head\", \"ground\"], model = \"m0\" }\n[run]\nduration = 0.06\n[models]\n"
        .to_owned();
    for at in 0..levels {
        let branches = vec![format!("{{ model = \"m{}\" }}", at + 1); count].join(", ");
        let _ = writeln!(scene, "m{at} = {{ parallel = [{branches}] }}");
    }
    let _ = writeln!(scene, "m{levels} = {{ {law} }}");
    scene
}

/// Runs the command with so much address space \[kB\], where the system limits that.
fn within(kilobytes: usize, verb: &str, scene: &Path) -> Output {
    let program = env!("CARGO_BIN_EXE_dashpot");
    let limited = format!("ulimit -v {kilobytes}; exec {program} {verb} {}", text(scene));
    Command::new("sh").args(["-c", &limited]).output().unwrap()
}

#[test]
#[cfg(unix)]
fn many_equal_parts_of_one_pad_take_little_memory() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "parts.toml", &nested(5, 10, "spring = 1e4"));
    let output = within(800_000, "run", &scene);
    assert_eq!(code(&output), 0, "{}", err(&output));
    // They are one spring of 10⁹ N/m: v √(k m).
    let peak = format!("{:.1} kN", 3.0 * (1e9_f64 * 5.0).sqrt() * 1e-3);
    assert!(out(&output).contains(&peak), "{peak}: {}", out(&output));
}

#[test]
fn parts_that_share_a_signal_have_the_numbers_of_one_part() {
    let folder = TempDir::new().unwrap();
    let law = "kelvin-voigt = { spring = 1e3, dashpot = 20 }";
    let many = file(&folder, "many.toml", &nested(2, 10, law));
    let law = "kelvin-voigt = { spring = 1e5, dashpot = 2e3 }";
    let one = file(&folder, "one.toml", &nested(0, 1, law));
    let [many, one] = [&many, &one].map(|scene| json(&["run", text(scene), "--json"]));
    let measures = |answer: &serde_json::Value| answer["runs"][0]["measures"].clone();
    let (many, one) = (measures(&many), measures(&one));
    for (key, expected) in one.as_object().unwrap() {
        let own = |of: &serde_json::Value, what: &str| of[what].as_f64().unwrap();
        let error = own(&many[key], "error") + own(expected, "error");
        let apart = (own(&many[key], "value") - own(expected, "value")).abs();
        assert!(apart <= error, "{key}: {apart} > {error}");
    }
}

#[test]
#[cfg(unix)]
fn models_nested_too_deeply_by_name_are_refused() {
    let folder = TempDir::new().unwrap();
    let mut scene = nested(0, 1, "parallel = [{ spring = 10 }, { model = \"m1\" }]");
    for at in 1..20_000 {
        let next = at + 1;
        let _ = writeln!(
            scene,
            "m{at} = {{ parallel = [{{ spring = 10 }}, {{ model = \"m{next}\" }}] }}"
        );
    }
    scene += "m20000 = { spring = 1e4 }\n";
    let output = within(800_000, "check", &file(&folder, "deep.toml", &scene));
    assert_eq!(code(&output), 2, "{}", err(&output));
    assert!(err(&output).contains("nested 128 levels deep already"), "{}", err(&output));
}

#[test]
fn segments_of_large_models_are_refused_before_they_are_cut() {
    let folder = TempDir::new().unwrap();
    let scene = nested(3, 10, "spring = 1e4").replace("[models]", "[materials]");
    let scene = scene.replace("{ model = ", "{ material = ");
    let layers =
        "layers = [{ material = \"m0\", thickness = 0.1, area = 0.01, density = 50 }], segments =";
    let with = |segments: usize| {
        let scene = scene.replace("model = \"m0\"", &format!("{layers} {segments}"));
        run(&["check", text(&file(&folder, "layers.toml", &scene))])
    };
    assert_eq!(code(&with(10)), 0, "{}", err(&with(10)));
    let output = with(9_999);
    assert_eq!(code(&output), 2);
    let said = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    // 10 000 models of 1111 parts of 2 kB each.
    let expected = "`segments` must be at most 3600: more would take over 8 GB of memory";
    assert!(said.contains(expected), "{said}");
}

#[test]
fn what_no_memory_could_hold_is_refused_before_it_is_expanded() {
    let folder = TempDir::new().unwrap();
    let scene = file(&folder, "parts.toml", &nested(8, 10, "spring = 1e4"));
    let started = Instant::now();
    let output = run(&["check", text(&scene)]);
    assert!(started.elapsed().as_secs() < 2);
    assert_eq!(code(&output), 2);
    let said = err(&output).split_whitespace().collect::<Vec<_>>().join(" ");
    // 1 + 10 + … + 10⁸, of 2 kB each.
    let expected =
        "model `m0` expands to 111111111 parts, about 222 GB of memory; the limit is 8 GB";
    assert!(said.contains(expected) && said.contains("parts.toml:4:1"), "{said}");
}
