//! Extremes of what a scene may hold.

use std::f64::consts::{PI, TAU};

use super::{
    case::Case,
    scene::{FORCES, Text, kelvin},
    table::judge,
};

#[test]
fn extremes() {
    judge("extremes", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> =
        [(1e-30, 1e-24), (1e30, 1e34), (1e-12, 1e12), (1e12, 1e-12), (1e-150, 1e150)]
            .map(sizes)
            .into();
    cases.extend([0.0, 1e-9, 1e-3].map(resonance));
    cases.extend([1e2, 1e3].map(fast_drive));
    cases.extend([sluggish(), nothing_happens(), loads_that_cancel(), late_pulse()]);
    cases.extend([jumps_in_a_table(), stops_at_a_level(), stops_at_the_top(), box_of_walls()]);
    cases.extend([1e9, 1e13].map(hard_contact));
    cases.push(two_speeds());
    cases
}

fn sizes((mass, stiffness): (f64, f64)) -> Case {
    let omega: f64 = f64::sqrt(stiffness / mass);
    let text = Text::head(mass, 1.0)
        .pad(&format!("spring = {stiffness:?}"))
        .measure("pad", FORCES)
        .lasting(10.0 / omega);
    Case::new(format!("{mass:e} kg on {stiffness:e} N/m"), "closed form", text, move |trial| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        trial.ends("head", sine / omega, cosine);
        trial.measure("pad.peak-force", stiffness / omega);
    })
}

/// A mass on a spring that is driven close to its own frequency.
fn resonance(beside: f64) -> Case {
    let frequency = 10.0 / TAU * (1.0 + beside);
    let text = Text::head(1.0, 0.0)
        .pad("spring = 100")
        .with(&format!("[loads]\nram = {{ on = \"head\", force = {{ sine = {{ amplitude = 1.0, frequency = {frequency:?} }} }} }}"))
        .lasting(20.0);
    let name = if beside > 0.0 {
        format!("driven at 1 + {beside:e} of its own frequency")
    } else {
        "driven at its own frequency".to_owned()
    };
    Case::new(name, "closed form", text, move |trial| {
        let (own, drive, end) = (10.0, TAU * frequency, 20.0);
        // (sin Ωt − (Ω/ω) sin ωt)/(ω² − Ω²), without the difference of equals.
        let (mean, half) = (0.5 * (own + drive), 0.5 * (drive - own));
        let ratio = if half == 0.0 { end } else { (half * end).sin() / half };
        let way = (own * (mean * end).cos() * ratio - (own * end).sin()) / -(own * 2.0 * mean);
        trial.measure_known("head.end-position", way, 1e-12);
        trial.holds("it swings up", way.abs() > 1e-3);
    })
}

/// A force of so many periods within a second, on a mass that swings slowly.
fn fast_drive(frequency: f64) -> Case {
    let amplitude = frequency;
    let text = Text::head(1.0, 0.0)
        .pad("spring = 100")
        .with(&format!("[loads]\nram = {{ on = \"head\", force = {{ sine = {{ amplitude = {amplitude:?}, frequency = {frequency:?} }} }} }}"))
        .lasting(1.0);
    Case::new(
        format!("a force of {frequency:e} Hz on a mass of 1.6 Hz"),
        "closed form",
        text,
        move |trial| {
            let drive = TAU * frequency;
            let gain = amplitude / (100.0 - drive * drive);
            // After whole periods of the force.
            let way = -gain * drive / 10.0 * 10.0_f64.sin();
            let speed = gain * drive * (1.0 - 10.0_f64.cos());
            let phase = 4e-16 * drive;
            trial.measure_known("head.end-position", way, (gain * phase).abs());
            trial.measure_known("head.end-velocity", speed, (gain * drive * phase).abs());
        },
    )
}

fn sluggish() -> Case {
    let text = Text::head(1.0, 1.0).pad(&kelvin(1.0, 2e6)).measure("pad", FORCES).lasting(4e6);
    Case::new("damping ratio of 10⁶", "closed form", text, |trial| {
        // Rates −C/m and −K/C, to parts of 10⁻¹² of themselves.
        let way = 5e-7 * (-2.0_f64).exp();
        trial.measure_known("head.end-position", way, 1e-11 * way);
        trial.measure_known("head.peak-displacement", 5e-7, 2e-17);
        trial.measure("pad.peak-force", 2e6);
    })
}

fn nothing_happens() -> Case {
    let text = Text::default()
        .node("head", "mass = 1")
        .pad(&kelvin(100.0, 1.0))
        .measure("head", super::scene::ENDS)
        .measure("pad", FORCES)
        .lasting(1.0);
    Case::new("nothing moves", "closed form", text, |trial| {
        trial.ends("head", 0.0, 0.0);
        trial.measure("pad.peak-force", 0.0);
        trial.measure("pad.impulse", 0.0);
    })
}

fn loads_that_cancel() -> Case {
    let loads = "[loads]\npush = { on = \"head\", force = { constant = 1e6 } }\n\
         pull = { on = \"head\", force = { constant = -999999.0 } }";
    let text = Text::head(1.0, 0.0).pad("spring = 100").with(loads).lasting(1.0);
    Case::new("forces of 10⁶ N that cancel but for 1 N", "closed form", text, |trial| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        trial.ends("head", 0.01 * (1.0 - cosine), 0.1 * sine);
    })
}

fn late_pulse() -> Case {
    let loads = "[loads]\nram = { on = \"head\", force = { half-sine = { peak = 1e3, duration = 1e-3, start = 1e5 } } }";
    let text = Text::head(1.0, 0.0)
        .pad(&kelvin(100.0, 1.0))
        .measure("pad", FORCES)
        .with(loads)
        .lasting(2e5);
    Case::new("a pulse of 10⁻³ s after 10⁵ s, in 2·10⁵ s", "momentum", text, |trial| {
        // The pulse gives 2/π N s; a pulse this short moves the peak by parts of (ωT)².
        let (impulse, zeta): (f64, f64) = (2.0 / PI, 0.05);
        let damped = 10.0 * (1.0 - zeta * zeta).sqrt();
        let top = (damped / 0.5).atan() / damped;
        let peak = impulse / 10.0 * (-0.5 * top).exp();
        trial.measure_known("head.peak-displacement", peak, 1e-3 * peak);
        trial.measure_known("pad.impulse", impulse, 1e-6);
    })
}

fn jumps_in_a_table() -> Case {
    let loads = "[loads]\nram = { on = \"head\", force = { table = [[0.0, 0.0], [0.3, 0.0], [0.3, 100.0], [0.7, 100.0], [0.7, -50.0], [2.0, -50.0]] } }";
    let text = Text::head(1.0, 0.0).pad("spring = 100").with(loads).lasting(1.0);
    Case::new("a table with equal times", "closed form", text, |trial| {
        let (first, second) = (7.0_f64, 3.0_f64);
        let way = (1.0 - first.cos()) - 1.5 * (1.0 - second.cos());
        trial.ends("head", way, 10.0 * first.sin() - 15.0 * second.sin());
    })
}

fn stops_at_a_level() -> Case {
    let text = Text::head(1.0, 1.0).pad("spring = 100").lasting(1.0)
        + "stop = [{ when = \"pad.deformation\", rises-above = 0.05 }]\n";
    Case::new("a run that ends at a level", "closed form", text, |trial| {
        let end = 0.5_f64.asin() / 10.0;
        trial.number("end of the run", trial.end(), end, end, Some(1e-12));
        trial.ends("head", 0.05, 0.75_f64.sqrt());
    })
}

/// The level is one rounding above the top of the swing.
fn stops_at_the_top() -> Case {
    let text = Text::head(1.0, 1.0).pad("spring = 100").lasting(1.0)
        + "stop = [{ when = \"pad.deformation\", rises-above = 0.1000001 }]\n";
    Case::new("a level that is just not reached", "closed form", text, |trial| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        trial.ends("head", 0.1 * sine, cosine);
    })
}

fn box_of_walls() -> Case {
    let text = Text::head(1.0, 1.0)
        .element("right", ["head", "ground"], "contact = { gap = 0.01, restitution = 1.0 }")
        .element("left", ["ground", "head"], "contact = { gap = 0.01, restitution = 1.0 }")
        .lasting(10.005);
    Case::new("500 elastic impacts between two walls", "closed form", text, |trial| {
        // A way of 10.005 m in a box of 0.02 m, from its middle: 500 walls, and 0.005 m from the middle.
        let impacts = trial.impacts("right") + trial.impacts("left");
        trial.holds(format!("{impacts} impacts"), impacts == 500);
        trial.ends("head", 0.005, 1.0);
        trial.energy_closes();
    })
}

/// Two masses that meet across a contact of so many N/m.
fn hard_contact(stiffness: f64) -> Case {
    let text = Text::head(1.0, 1.0)
        .node("body", "mass = 3")
        .element(
            "gap",
            ["head", "body"],
            &format!("series = [{{ contact = {{ gap = 0.1 }} }}, {{ spring = {stiffness:?} }}]"),
        )
        .measure("gap", FORCES)
        .lasting(1.0);
    Case::new(
        format!("impact across a contact of {stiffness:e} N/m"),
        "closed form",
        text,
        move |trial| {
            // Speeds −½ and ½; the contact lasts π √(μ/k), with μ = ¾ kg.
            let omega = f64::sqrt(stiffness / 0.75);
            let lasts = PI / omega;
            trial.measure("gap.peak-force", stiffness / omega);
            trial.measure("gap.impulse", 1.5);
            // At release both have moved by ¼ of the common way.
            let common = 0.25 * lasts;
            trial.ends("head", 0.1 + common - 0.5 * (0.9 - lasts), -0.5);
            trial.last("body.velocity", 0.5);
        },
    )
}

/// One part swings a million times faster than the other and is not damped.
fn two_speeds() -> Case {
    let text = Text::head(1.0, 1.0)
        .node("bell", "mass = 1, velocity = 1")
        .element("pad", ["head", "ground"], "spring = 1")
        .element("rod", ["bell", "ground"], "spring = 1e8")
        .measure("bell", super::scene::ENDS)
        .lasting(0.3);
    Case::new("parts of 1 rad/s and 10⁴ rad/s, undamped", "closed form", text, |trial| {
        trial.ends("head", 0.3_f64.sin(), 0.3_f64.cos());
        let (sine, cosine) = 3e3_f64.sin_cos();
        trial.measure_known("bell.end-position", 1e-4 * sine, 1e-15);
        trial.measure_known("bell.end-velocity", cosine, 1e-11);
    })
}
