//! Stiffness and spectra.

use super::{
    case::Case,
    reference::reference,
    scene::{FORCES, Text, branches, kelvin, zener},
    table::judge,
};

const SCRIPT: &str = "script";

#[test]
fn stiffness_and_spectra() {
    judge("stiffness", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![series_of_very_unequal_springs(), step_on_times_far_apart()];
    cases.extend(times_nearly_equal());
    cases.extend(["1e-2", "1e-6", "1e-10", "1e-14"].map(struck_times_nearly_equal));
    cases.extend([0.0, 1e-8, -1e-8].map(critical));
    cases.push(triple_root());
    cases.push(many_decades());
    cases.extend(unequal_masses());
    cases.push(heavily_damped_support());
    cases.extend(["1e-1", "1e-4", "1e-7", "1e-10"].map(stiff_pad));
    cases
}

fn series_of_very_unequal_springs() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("middle", "mass = 0")
        .element("stiff", ["head", "middle"], "spring = 1e12")
        .element("soft", ["middle", "ground"], "spring = 1")
        .measure("soft", FORCES)
        .lasting(1000.0);
    Case::new("springs of 1 and 10¹² N/m in series", "closed form", text, |trial| {
        let omega = 1.0 / (1.0_f64 + 1e-12).sqrt();
        let (sine, cosine) = (omega * 1000.0).sin_cos();
        trial.ends("head", sine / omega, cosine);
        trial.measure("head.peak-displacement", 1.0 / omega);
        trial.measure("stiff.peak-force", omega);
        trial.measure("soft.peak-force", omega);
    })
}

fn step_on_times_far_apart() -> Case {
    let text = Text::default()
        .node("plate", "motion = { constant = 1e-3 }")
        .element("pad", ["plate", "ground"], &branches(0.0, &[(5.0, 5e-9), (2.0, 2e3)]))
        .measure("pad", FORCES)
        .lasting(1000.0);
    Case::new("Maxwell branches of 10⁻⁹ and 10³ s under a step", "closed form", text, |trial| {
        trial.measure("pad.peak-force", 7e-3);
        trial.measure("pad.impulse", -1e-3 * 2e3 * (-1.0_f64).exp_m1() + 5e-12);
        for time in [1e-9, 3e-9, 1.0, 1000.0_f64] {
            let force = 5e-3 * (-time / 1e-9).exp() + 2e-3 * (-time / 1e3).exp();
            trial.output("pad.force", time, force);
        }
    })
}

/// Step and creep of branches whose times are this far apart; equal if it is zero.
fn times_nearly_equal() -> Vec<Case> {
    let mut cases = Vec::new();
    for gap in [1e-2, 1e-6, 1e-10, 1e-14, 0.0] {
        let text = Text::default()
            .node("plate", "motion = { constant = 1e-3 }")
            .element("pad", ["plate", "ground"], &branches(0.0, &[(1.0, 1.0), (1.0, 1.0 + gap)]))
            .measure("pad", FORCES)
            .lasting(5.0);
        let are_apart = if gap > 0.0 { format!("{gap:e} apart") } else { "equal".to_owned() };
        let name = format!("relaxation times {are_apart}, under a step");
        cases.push(Case::new(name, "closed form", text, move |trial| {
            let force = |t: f64| 1e-3 * ((-t).exp() + (-t / (1.0 + gap)).exp());
            trial.measure("pad.peak-force", 2e-3);
            let impulse =
                -1e-3 * ((-5.0_f64).exp_m1() + (1.0 + gap) * (-5.0 / (1.0 + gap)).exp_m1());
            trial.measure("pad.impulse", impulse);
            trial.output("pad.force", 1.0, force(1.0));
            trial.last("pad.force", force(5.0));
        }));
        let chain =
            format!("series = [{{ {} }}, {{ {} }}]", kelvin(1.0, 1.0), kelvin(1.0, 1.0 + gap));
        let text = Text::default()
            .node("plate", "")
            .element("pad", ["plate", "ground"], &chain)
            .measure("pad", FORCES)
            .with("[loads]\nram = { on = \"plate\", force = { constant = 1.0 } }")
            .lasting(5.0);
        let name = format!("retardation times {are_apart}, under a load");
        cases.push(Case::new(name, "closed form", text, move |trial| {
            let way = |t: f64| -((-t).exp_m1() + (-t / (1.0 + gap)).exp_m1());
            trial.measure("pad.end-deformation", way(5.0));
            trial.measure("pad.impulse", 5.0);
            trial.output("pad.deformation", 1.0, way(1.0));
        }));
    }
    cases
}

fn struck_times_nearly_equal(gap: &'static str) -> Case {
    let damping = 1.0 + gap.parse::<f64>().unwrap();
    let text = Text::head(1.0, 1.0).pad(&branches(0.5, &[(1.0, 1.0), (1.0, damping)])).lasting(3.0);
    Case::new(format!("struck pad with relaxation times {gap} apart"), SCRIPT, text, move |trial| {
        let get = |quantity| reference(&format!("times-apart-{gap}"), quantity);
        trial.ends("head", get("position"), get("velocity"));
    })
}

fn critical(offset: f64) -> Case {
    let (stiffness, speed, end) = (100.0, 2.0, 1.0);
    let zeta = 1.0 + offset;
    let text = Text::head(1.0, speed).pad(&kelvin(stiffness, 20.0 * zeta)).lasting(end);
    Case::new(format!("damping ratio 1 + {offset:e}"), "closed form", text, move |trial| {
        // ζ² − 1 = δ (2 + δ); the sign tells sinh from sin.
        let square: f64 = 100.0 * offset * (2.0 + offset);
        let root = square.abs().sqrt();
        let shape = |t: f64| match square {
            square if square > 0.0 => ((root * t).sinh() / root, (root * t).cosh()),
            square if square < 0.0 => ((root * t).sin() / root, (root * t).cos()),
            _ => (t, 1.0),
        };
        let decay = (-10.0 * zeta * end).exp();
        let (sine, cosine) = shape(end);
        trial.ends("head", speed * decay * sine, speed * decay * (cosine - 10.0 * zeta * sine));
        if offset == 0.0 {
            trial.measure("head.peak-displacement", speed / 10.0 / 1.0_f64.exp());
        }
    })
}

fn triple_root() -> Case {
    let text = Text::head(1.0, 1.0).pad(&zener(1.0 / 3.0, 8.0 / 3.0, 8.0 / 9.0)).lasting(8.0);
    Case::new("triple root on a Zener element", "closed form", text, |trial| {
        trial.ends("head", (8.0 + 64.0) * (-8.0_f64).exp(), (1.0 + 8.0 - 64.0) * (-8.0_f64).exp());
        let top = 0.5 * (1.0 + 5.0_f64.sqrt());
        trial.measure("head.peak-displacement", (top + top * top) * (-top).exp());
    })
}

fn many_decades() -> Case {
    let arms: Vec<(f64, f64)> = (-6..=6).map(|power| (1.0, 10.0_f64.powi(power))).collect();
    let text = Text::head(1.0, 1.0)
        .pad(&branches(0.0, &arms))
        .measure("pad", "[{ kind = \"impulse\", window = \"run\" }]")
        .lasting(1e6);
    Case::new("13 decades of relaxation times over 10⁶ s", SCRIPT, text, |trial| {
        for time in ["1", "1e3", "1e6"] {
            let of = format!("decades-{time}");
            trial.output("head.position", time.parse().unwrap(), reference(&of, "position"));
            trial.output("head.velocity", time.parse().unwrap(), reference(&of, "velocity"));
        }
        trial.measure("head.end-position", reference("decades-1e6", "position"));
        trial.measure("pad.impulse", 1.0 - reference("decades-1e6", "velocity"));
    })
}

fn unequal_masses() -> [Case; 2] {
    let free = Text::head(1.0, 1.0)
        .node("anvil", "mass = 1e12")
        .element("pad", ["head", "anvil"], "spring = 100")
        .measure("pad", FORCES)
        .measure("anvil", "[{ kind = \"end-velocity\", window = \"run\" }]")
        .lasting(2.0);
    let free =
        Case::new("1 kg on a spring to a free mass of 10¹² kg", "closed form", free, |trial| {
            let (light, heavy, k, end) = (1.0, 1e12, 100.0, 2.0);
            let all: f64 = light + heavy;
            let omega = f64::sqrt(k * all / heavy);
            let (sine, cosine) = (omega * end).sin_cos();
            let way = sine / omega;
            trial.ends(
                "head",
                light / all * end + heavy / all * way,
                (light + heavy * cosine) / all,
            );
            trial.measure("anvil.end-velocity", light / all * (1.0 - cosine));
            trial.measure("pad.peak-force", k / omega);
        });
    let speck = Text::head(1.0, 1.0)
        .node("speck", "mass = 1e-12")
        .element("pad", ["head", "ground"], "spring = 100")
        .element("hair", ["head", "speck"], &kelvin(1e-9, 1e-10))
        .measure("hair", FORCES)
        .lasting(2.0);
    let speck = Case::new("1 kg that carries 10⁻¹² kg", "limit", speck, |trial| {
        let (sine, cosine) = 20.0_f64.sin_cos();
        // The speck adds its mass at most: a part of 10⁻¹² to the motion, over 20 rad.
        trial.measure_known("head.end-position", 0.1 * sine, 1e-11);
        trial.measure_known("head.end-velocity", cosine, 1e-10);
    });
    [free, speck]
}

fn heavily_damped_support() -> Case {
    let pad = "series = [{ spring = 20e6 }, { dashpot = 6e3 }, { kelvin-voigt = { spring = 20e6, dashpot = 4e3 } }]";
    let text = Text::head(10.0, 10.0)
        .node("panel", "mass = 100")
        .element("padding", ["head", "panel"], pad)
        .element("mount", ["panel", "ground"], &kelvin(50e6, 10e6))
        .lasting(0.02);
    Case::new("the thesis' support of 10 MN s/m", "printed digits", text, |trial| {
        let half = |digits: i32| 0.5 * 10.0_f64.powi(-digits);
        trial.measure_known("padding.peak-force", 39_091.473_661, half(6));
        trial.measure_known("padding.peak-deformation", 16.961_880_656e-3, half(12));
        trial.measure_known("padding.contact-time", 5.822_143_3e-3, half(12));
    })
}

fn stiff_pad(fastest: &'static str) -> Case {
    let mut arms = vec![(1.0, fastest.parse().unwrap())];
    arms.extend([0.2, 0.5, 1.0, 2.0, 3.0, 5.0, 10.0].map(|damping| (1.0, damping)));
    let text = Text::head(1.0, 1.0).pad(&branches(1.0, &arms)).lasting(100.0);
    let power = fastest.parse::<f64>().unwrap().log10().round();
    let name = format!("mass on an 8-mode pad, ‖A‖T = 1e{}", 2.0 - power);
    Case::new(name, SCRIPT, text, move |trial| {
        for time in ["1", "100"] {
            let of = format!("pad-{fastest}-{time}");
            trial.output("head.position", time.parse().unwrap(), reference(&of, "position"));
            trial.output("head.velocity", time.parse().unwrap(), reference(&of, "velocity"));
        }
        trial.measure("head.end-position", reference(&format!("pad-{fastest}-100"), "position"));
    })
}
