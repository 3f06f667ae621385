//! Effects and elements at the values at which they do nothing: the result is that without them.

use dashpot::{
    analysis::{RunError, RunReport, Solve, SolveSettings},
    dae::SolveError,
    network::{
        effects::EFFECTS,
        elements::ELEMENTS,
        parameters::{Dimension, Formula, ParameterKind, Value},
        shifts::SHIFTS,
        waveforms::WAVEFORMS,
    },
    scene::write_kind,
};

use super::trial::{run, scene};

/// A head on a pad, with lines in its sections.
fn text(effects: &str, elements: &str, nodes: &str) -> String {
    format!(
        "[nodes]\nhead = {{ mass = 5, velocity = 4 }}\n{nodes}\n\
         [elements]\npad = {{ between = [\"head\", \"ground\"], parallel = [{{ spring = 2e5 }}, {{ dashpot = 600 }}] }}\n\
         {elements}\n{effects}\n[run]\nduration = 0.008\n"
    )
}

/// The largest difference of the outputs that two runs have in common, in parts of the largest value
/// of their unit.
fn difference(one: &RunReport, two: &RunReport) -> f64 {
    let (first, second) = (one.solution(), two.solution());
    let outputs = &one.assembly.system.outputs;
    let scale = |unit: &str| {
        let own = outputs.iter().enumerate().filter(|(_, own)| own.unit == unit);
        own.map(|(at, _)| first.signal(at).bound()).fold(0.0, f64::max)
    };
    let mut worst = 0.0_f64;
    let mut common = 0;
    for (at, output) in outputs.iter().enumerate() {
        let Some(other) = two.assembly.output(&output.name.to_string()) else { continue };
        common += 1;
        let (a, b) = (first.signal(at), second.signal(other));
        let size = scale(output.unit);
        for step in 0..=200 {
            let time = one.trajectory.t_end * f64::from(step) / 200.0;
            let gap = (a.value(time) - b.value(time)).abs();
            if gap > 0.0 {
                worst = worst.max(gap / size);
            }
        }
    }
    assert!(common >= 6, "{common} outputs in common");
    worst
}

/// Holds a run against one in which something is off or linear: to rounding by `exact`, and where that
/// does not apply within 1000 `rtol` by `bdf`.
fn same(what: &str, neutral: &str, off: &str) {
    let own = scene(neutral);
    match own.network.solve_with(&own.settings("exact").unwrap()) {
        Ok(report) => {
            let gap = difference(&run(off, "exact"), &report);
            assert!(gap <= 1e-12, "{what} makes a difference of {gap:e}");
        }
        Err(RunError::Solve(SolveError::NotApplicable { .. })) => {
            let tight = |text: &str| {
                let read = scene(text);
                let settings = SolveSettings { rtol: Some(1e-9), ..read.settings("bdf").unwrap() };
                read.network.solve_with(&settings).unwrap()
            };
            let gap = difference(&tight(off), &tight(neutral));
            assert!(gap <= 1e3 * 1e-9, "{what} makes a difference of {gap:e}");
        }
        Err(error) => panic!("{what}: {error}\n{neutral}"),
    }
}

/// The lines that switch an effect on at its neutral values.
fn neutral_effect(kind: &str) -> &'static [&'static str] {
    match kind {
        "gravity" => &["gravity = { value = 0 }", "gravity = { value = 0, start = \"unloaded\" }"],
        // Within 8 ms the pad is not let go.
        "separation" => &["separation.pad = {}", "separation.pad = { at = \"ground\" }"],
        "face" => &["face.pad = { mass = 0 }", "face.pad = { mass = 0 }\nseparation.pad = true"],
        "stop" => &[
            "stop.pad = { at = 1 }",
            "stop.pad = { at = 1, stiffness = 1e9, damping = 1e3 }",
            "stop.pad = { at = 0, stiffness = 0 }",
        ],
        kind => panic!("what is the neutral value of `{kind}`?"),
    }
}

#[test]
fn every_effect_at_its_neutral_value_gives_the_result_of_the_effect_off() {
    let mut count = 0;
    for kind in EFFECTS {
        for lines in neutral_effect(kind.word) {
            let neutral = text(&format!("[effects]\n{lines}"), "", "");
            same(lines, &neutral, &text("", "", ""));
            count += 1;
        }
    }
    assert!(count > 4);
}

/// Elements that are nothing, or a spring of 1e4 N/m or a dashpot of 100 N s/m: their law, and that of
/// what they are.
fn neutral_element(kind: &str) -> (&'static str, &'static str) {
    let spring = "spring = 1e4";
    match kind {
        "spring" => ("spring = 0", ""),
        "dashpot" => ("dashpot = 0", ""),
        "rigid" => ("rigid = true", ""),
        "contact" => ("contact = { gap = 1, restitution = 0.5 }", ""),
        "friction" => ("friction = { friction = 0, static-to-kinetic = 1.5 }", ""),
        "piecewise-spring" => ("piecewise-spring = [[-1, -1e4], [0, 0], [1, 1e4]]", spring),
        "preloaded-spring" => ("preloaded-spring = { stiffness = 1e4, preload = 0 }", spring),
        "power-spring" => ("power-spring = { force = 100, at = 0.01, exponent = 1 }", spring),
        "cubic-spring" => ("cubic-spring = { stiffness = 1e4, cubic = 0 }", spring),
        "stiffening-spring" => ("stiffening-spring = { stiffness = 1e4, limit = 1e6 }", spring),
        "table-spring" => ("table-spring = [[-1, -1e4], [0, 0], [1, 1e4]]", spring),
        "formula" => ("formula = \"10 kN/m * y\"", spring),
        "foam" => (
            "foam = { modulus = 1e6, plateau = 1e20, densification = 0, exponent = 3, thickness = 1, area = 0.01 }",
            spring,
        ),
        // In tension it is slack.
        "hysteretic-foam" => (
            "hysteretic-foam = { modulus = 1e6, plateau = 1e5, densification = 1e4, exponent = 3, thickness = 1, area = 0.01, set = 0.1, unloading-exponent = 2 }",
            "",
        ),
        "hysteretic-table" => (
            "hysteretic-table = { loading = [[0, 0], [1, 1e4]], unloading = [[0.1, 0], [1, 1e4]] }",
            "",
        ),
        "rate-spring" => (
            "rate-spring = { force = 100, at = 0.01, exponent = 1, gain = 0, reference-rate = 0.1 }",
            spring,
        ),
        "power-dashpot" => {
            ("power-dashpot = { force = 100, at = 1, exponent = 1 }", "dashpot = 100")
        }
        "hunt-crossley" => {
            ("hunt-crossley = { force = 100, at = 0.01, dissipation = 0.2, gap = 1 }", "")
        }
        "bumper" => {
            ("bumper = { force = 100, at = 0.01, restitution = 0.5, speed = 1, gap = 1 }", "")
        }
        "foundation" => {
            ("foundation = { law = { spring = 1e4 }, shape = \"flat\", diameter = 0.1 }", spring)
        }
        kind => panic!("what is the neutral value of `{kind}`?"),
    }
}

#[test]
fn every_element_at_its_neutral_value_is_nothing_or_its_linear_relative() {
    assert!(ELEMENTS.len() > 10);
    for kind in ELEMENTS {
        let (law, linear) = neutral_element(kind.word);
        let ends = match kind.word {
            "rigid" => "\"head\", \"tip\"",
            "hysteretic-foam" | "hysteretic-table" => "\"ground\", \"head\"",
            _ => "\"head\", \"ground\"",
        };
        let element = |law: &str| {
            let line = format!("extra = {{ between = [{ends}], {law} }}");
            if law.is_empty() { String::new() } else { line }
        };
        let nodes = if kind.word == "rigid" { "tip = {}" } else { "" };
        same(kind.word, &text("", &element(law), nodes), &text("", &element(linear), ""));
    }
}

/// The lines of a shift at which no time is multiplied.
fn neutral_shift(kind: &str) -> &'static [&'static str] {
    match kind {
        "wlf" => &["wlf = { temperature = \"40 degC\", reference = \"40 degC\" }"],
        "arrhenius" => &[
            "arrhenius = { temperature = \"40 degC\", reference = \"40 degC\", energy = \"80 kJ/mol\" }",
        ],
        kind => panic!("what is the neutral value of `{kind}`?"),
    }
}

#[test]
fn every_shift_at_its_reference_is_none() {
    let mut count = 0;
    for kind in SHIFTS {
        let off = text("", "", "");
        for line in neutral_shift(kind.word) {
            let law = "{ dashpot = 600 }] }";
            let shifted =
                off.replace(law, &format!("{{ dashpot = 600 }}], shift = {{ {line} }} }}"));
            assert_ne!(shifted, off);
            same(line, &shifted, &off);
            count += 1;
        }
    }
    assert!(count > 1);
}

#[test]
fn a_load_of_zero_and_a_motion_of_zero_are_none() {
    assert!(WAVEFORMS.len() > 5);
    for kind in WAVEFORMS {
        let none = |(value, kind): (Value, ParameterKind)| match (value, kind) {
            (Value::Number(_), ParameterKind::Amplitude) => Value::Number(0.0),
            (Value::Table(points), ParameterKind::TimeTable) => {
                Value::Table(points.into_iter().map(|(time, _)| (time, 0.0)).collect())
            }
            (Value::Formula(_), _) => Formula::parse("0", &|_| false).map(Value::Formula).unwrap(),
            (value, _) => value,
        };
        let kinds = kind.parameters.iter().map(|parameter| parameter.kind);
        let values: Vec<Value> = (kind.sample)().into_iter().zip(kinds).map(none).collect();
        assert_ne!(values, (kind.sample)(), "{} has no size", kind.word);
        let line = |driven| write_kind(kind.word, kind.parameters, &values, driven);
        let off = text("", "", "");
        let push = format!(
            "[loads]\npush = {{ on = \"head\", force = {{ {} }} }}",
            line(Dimension::FORCE)
        );
        same(kind.word, &text(&push, "", ""), &off);
        let motion =
            format!("floor = {{ motion = {{ {} }} }}\n[elements]", line(Dimension::LENGTH));
        let moved = off.replace("\"ground\"", "\"floor\"").replace("[elements]", &motion);
        same(kind.word, &moved, &off);
    }
}
