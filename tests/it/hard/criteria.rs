//! Injury criteria of given signals: closed forms with the height A in g and the length T in s.
//!
//! A force on a massless plate goes through a dashpot into the head unaltered, so that the head reads
//! the force over its mass.

use dashpot::analysis::measures::STANDARD_GRAVITY as G0;

use super::{case::Case, scene::Text, table::judge};

/// Relative error allowed: the constants have all digits of a double.
const PRINTED: f64 = 1e-9;

/// Head injury criterion and severity index of a pulse of the height 1 and the length 1: where the
/// edge of the window is 0.6 of its mean; `Γ(7/4)/(√π Γ(9/4))`, `16/(15 π)` and `2/7`.
const HALF_SINE: (f64, f64) = (0.414_645_649_541_511_5, 0.457_655_858_101_087_9);
const HAVERSINE: (f64, f64) = (0.302_938_854_957_896_6, 0.339_530_545_262_710_05);
const TRIANGLE: (f64, f64) = (0.246_400_657_355_252_65, 2.0 / 7.0);

#[test]
fn criteria() {
    judge("criteria", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let (height, length) = (80.0, 0.012);
    let mut cases = vec![
        signal("half-sine", &half_sine(height, length), height, length, HALF_SINE),
        signal("haversine", &haversine(height, length), height, length, HAVERSINE),
        signal("triangle", &triangle(height, length), height, length, TRIANGLE),
        signal("two samples (a ramp)", &ramp(height, length), height, length, TRIANGLE),
        signal("rectangle, a plateau", &rectangle(height, length), height, length, (1.0, 1.0)),
        signal("half-sine, all negative", &half_sine(-height, length), height, length, HALF_SINE),
        signal("no signal", &rectangle(0.0, length), 0.0, length, (1.0, 1.0)),
    ];
    cases.extend([struck_spring(), two_peaks(), capped()]);
    cases.extend([too_large(), infinite()]);
    cases
}

fn half_sine(height: f64, length: f64) -> String {
    format!("half-sine = {{ peak = {:?}, duration = {length:?}, start = 0.002 }}", height * G0)
}

fn haversine(height: f64, length: f64) -> String {
    format!("haversine = {{ peak = {:?}, duration = {length:?}, start = 0.002 }}", height * G0)
}

fn triangle(height: f64, length: f64) -> String {
    let (top, end) = (0.002 + 0.5 * length, 0.002 + length);
    format!(
        "table = [[0.0, 0.0], [0.002, 0.0], [{top:?}, {:?}], [{end:?}, 0.0], [1.0, 0.0]]",
        height * G0
    )
}

fn ramp(height: f64, length: f64) -> String {
    format!("table = [[0.0, 0.0], [{length:?}, {:?}], [{length:?}, 0.0], [1.0, 0.0]]", height * G0)
}

fn rectangle(height: f64, length: f64) -> String {
    format!(
        "trapezoid = {{ peak = {:?}, rise = 0.0, hold = {length:?}, fall = 0.0, start = 0.002 }}",
        height * G0
    )
}

const MEASURES: &str = "[{ kind = \"hic\", window = \"run\" }, { kind = \"severity-index\", window = \"run\" }, \
     { kind = \"peak-acceleration\", window = \"run\" }]";

fn scene(force: &str) -> String {
    Text::default()
        .node("head", "mass = 1")
        .node("plate", "")
        .element("pad", ["plate", "head"], "dashpot = 10")
        .measure("head", MEASURES)
        .with(&format!("[loads]\nram = {{ on = \"plate\", force = {{ {force} }} }}"))
        .lasting(0.02)
}

fn signal(name: &str, force: &str, height: f64, length: f64, known: (f64, f64)) -> Case {
    Case::new(name, "closed form", scene(force), move |trial| {
        let unit = height.powf(2.5) * length;
        trial.measure_known("head.hic", known.0 * unit, PRINTED * unit);
        trial.measure_known("head.severity-index", known.1 * unit, PRINTED * unit);
        trial.measure("head.peak-acceleration", height * G0);
    })
}

/// The half-sine of an impact on a spring from which the head parts.
fn struck_spring() -> Case {
    let text = Text::default()
        .node("head", "mass = 4, velocity = 5")
        .element("pad", ["head", "ground"], "spring = 40e3")
        .measure("head", MEASURES)
        .with("[effects]\nseparation.pad = { at = \"head\" }")
        .lasting(0.1);
    Case::new("head that strikes a spring and parts", "closed form", text, |trial| {
        let (height, length) = (500.0 / G0, std::f64::consts::PI / 100.0);
        let unit = height.powf(2.5) * length;
        trial.measure_known("head.hic", HALF_SINE.0 * unit, PRINTED * unit);
        trial.measure_known("head.severity-index", HALF_SINE.1 * unit, PRINTED * unit);
    })
}

/// Two plateaus of 4 ms with 2 ms between them: one window holds both, and is worth more than one.
fn two_peaks() -> Case {
    let height = 60.0 * G0;
    let force = format!(
        "table = [[0.0, {height:?}], [0.004, {height:?}], [0.004, 0.0], [0.006, 0.0], \
         [0.006, {height:?}], [0.01, {height:?}], [0.01, 0.0], [1.0, 0.0]]"
    );
    Case::new("two peaks in one window", "closed form", scene(&force), |trial| {
        let unit = 60.0_f64.powf(2.5);
        let both = 0.01 * 0.8_f64.powf(2.5) * unit;
        trial.measure_known("head.hic", both, PRINTED * both);
        trial.measure_known("head.severity-index", 0.008 * unit, PRINTED * unit);
    })
}

/// A half-sine of 40 ms: the windows of 15 and 36 ms are shorter than the best one of 26.8 ms, and
/// longer.
fn capped() -> Case {
    let (height, length) = (80.0, 0.04);
    let text = Text::default()
        .node("head", "mass = 1")
        .node("plate", "")
        .element("pad", ["plate", "head"], "dashpot = 10")
        .measure(
            "head",
            "[{ kind = \"hic15\", window = \"run\" }, { kind = \"hic36\", window = \"run\" }, \
             { kind = \"clip-3ms\", window = \"run\" }]",
        )
        .with(&format!(
            "[loads]\nramp = {{ on = \"plate\", force = {{ {} }} }}",
            half_sine(height, length)
        ))
        .lasting(0.05);
    Case::new("windows that end at their cap and before", "closed form", text, move |trial| {
        let unit = height.powf(2.5) * length;
        let half = 0.5 * std::f64::consts::PI * 0.015 / length;
        let capped = 0.015 * (height * half.sin() / half).powf(2.5);
        trial.measure_known("head.hic15", capped, PRINTED * capped);
        trial.measure_known("head.hic36", HALF_SINE.0 * unit, PRINTED * unit);
        let clip = height * G0 * (0.5 * std::f64::consts::PI * 0.003 / length).cos();
        trial.measure_known("head.clip-3ms", clip, PRINTED * clip);
    })
}

fn too_large() -> Case {
    Case::new(
        "a^2.5 beyond the largest double",
        "said in words",
        scene(&half_sine(1e130, 0.012)),
        |trial| {
            trial.measure("head.peak-acceleration", 1e130 * G0);
            for key in ["head.hic", "head.severity-index"] {
                let own = trial.report.measure(key).unwrap();
                trial.holds(format!("{own:?}"), own.value.is_none() && !own.notes.is_empty());
            }
        },
    )
}

fn infinite() -> Case {
    let text = Text::default()
        .node("head", "mass = 4, velocity = 5")
        .element("pad", ["head", "ground"], "contact = { gap = 0.01, restitution = 0.5 }")
        .measure("head", MEASURES)
        .lasting(0.1);
    Case::new("jump of the velocity on a rigid stop", "said in words", text, |trial| {
        for key in ["head.hic", "head.severity-index", "head.peak-acceleration"] {
            let own = trial.report.measure(key).unwrap();
            let says = own.note().is_some_and(|note| note.contains("infinite"));
            trial.holds(format!("{own:?}"), own.value.is_none() && says);
        }
    })
}
