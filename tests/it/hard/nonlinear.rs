//! Laws that are not linear.

use dashpot::network::elements::{Element, Foam, TableSpring};

use super::{
    case::Case,
    scene::{FORCES, Text},
    table::judge,
};

const PARTS: &str = "[effects]\nseparation.pad = { at = \"head\" }\n";
/// ∫ ds/√(1 − s⁴) from 0 to 1.
const LEMNISCATE: f64 = 1.311_028_777_146_059_9;

#[test]
fn laws_that_are_not_linear() {
    judge("nonlinear", cases());
}

pub(super) fn cases() -> Vec<Case> {
    let mut cases = vec![pure_cube(), cubes_in_series(), root_dashpot(), squared_dashpot()];
    cases.extend([squared_dashpot_behind_a_spring(), kinked_table(), wall()]);
    cases.extend([1.0, 10.0].map(densification));
    cases.extend([hysteresis(), tiny_cube(), hunt_crossley_at_rest()]);
    cases
}

fn pure_cube() -> Case {
    let text = Text::head(1.0, 1.0)
        .pad("cubic-spring = { stiffness = 0.0, cubic = 1.0 }")
        .measure("pad", FORCES)
        .lasting(half_period());
    Case::new("F = x³, zero stiffness at rest", "closed form", text, |trial| {
        let deepest = 2.0_f64.powf(0.25);
        trial.measure("head.peak-displacement", deepest);
        trial.measure("pad.peak-force", deepest.powi(3));
        trial.ends("head", 0.0, -1.0);
        trial.energy_closes();
    })
}

/// Of m = 1, k3 = 1, v0 = 1: 2 ∫ dx/√(1 − x⁴/2) from 0 to 2^(1/4).
fn half_period() -> f64 {
    2.0 * 2.0_f64.powf(0.25) * LEMNISCATE
}

fn cubes_in_series() -> Case {
    let cube = "{ cubic-spring = { stiffness = 0.0, cubic = 8.0 } }";
    let text = Text::head(1.0, 1.0)
        .pad(&format!("series = [{cube}, {cube}]"))
        .measure("pad", FORCES)
        .lasting(half_period());
    Case::new("two F = 8 x³ in series, massless between", "closed form", text, |trial| {
        trial.measure("head.peak-displacement", 2.0_f64.powf(0.25));
        trial.ends("head", 0.0, -1.0);
        trial.energy_closes();
    })
}

fn root_dashpot() -> Case {
    let text = Text::head(1.0, 1.0)
        .pad("power-dashpot = { force = 1.0, at = 1.0, exponent = 0.5 }")
        .lasting(3.0);
    Case::new("F = √|v|, which stops the mass at t = 2 s", "closed form", text, |trial| {
        trial.ends("head", 2.0 / 3.0, 0.0);
        trial.output("head.velocity", 1.0, 0.25);
        trial.output("head.position", 1.0, 2.0 / 3.0 * (1.0 - 0.125));
        trial.energy_closes();
    })
}

fn squared_dashpot() -> Case {
    let text = Text::default()
        .node("plate", "")
        .element(
            "pad",
            ["plate", "ground"],
            "power-dashpot = { force = 4.0, at = 1.0, exponent = 2.0 }",
        )
        .measure("pad", FORCES)
        .with("[loads]\nram = { on = \"plate\", force = { ramp = { height = 9.0, rise = 1.0 } } }")
        .lasting(1.0);
    Case::new(
        "v² dashpot at a massless node under a ramp from zero",
        "closed form",
        text,
        |trial| {
            trial.measure("pad.end-deformation", 2.0 / 3.0 * 1.5);
            trial.last("pad.force", 9.0);
        },
    )
}

fn squared_dashpot_behind_a_spring() -> Case {
    // t = (2 c/k) (−w − u ln(1 − w/u)) for the rate w of the dashpot, with c = 1, k = 10, u = 1.
    let end = 0.2 * (-0.5 - 0.5_f64.ln());
    let text = Text::default()
        .node("driver", "motion = { ramp = { height = 1.0, rise = 1.0 } }")
        .element(
            "pad",
            ["driver", "ground"],
            "series = [{ spring = 10 }, { power-dashpot = { force = 1.0, at = 1.0, exponent = 2.0 } }]",
        )
        .measure("pad", FORCES)
        .lasting(end);
    Case::new("v² dashpot behind a spring, driven from rest", "closed form", text, move |trial| {
        trial.measure("pad.peak-force", 0.25);
        trial.last("pad.force", 0.25);
        trial.measure("pad.end-deformation", end);
    })
}

/// The deformation at which an element has taken up an energy.
fn depth(element: &dyn Element, energy: f64, mut high: f64) -> f64 {
    let mut low = 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if element.stored(middle) < energy { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// A head of 1 kg at 1 m/s on a curve of points, which gives all back.
fn tabulated(name: &'static str, points: &[(f64, f64)], duration: f64) -> Case {
    let law = TableSpring::new(points.to_vec()).unwrap();
    let deepest = depth(&law, 0.5, points[points.len() - 1].0);
    let force = law.force(deepest, 0.0);
    let points: Vec<String> =
        points.iter().map(|(y, force)| format!("[{y:?}, {force:?}]")).collect();
    let text = Text::head(1.0, 1.0)
        .pad(&format!("table-spring = [{}]", points.join(", ")))
        .measure("pad", FORCES)
        .with(PARTS)
        .lasting(duration);
    Case::new(name, "energy", text, move |trial| {
        trial.measure("pad.peak-deformation", deepest);
        trial.measure("pad.peak-force", force);
        trial.measure("head.end-velocity", -1.0);
        trial.energy_closes();
    })
}

fn kinked_table() -> Case {
    let points = [(-1e-2, -1.0), (0.0, 0.0), (1e-3, 1.0), (2e-3, 1001.0), (1e-2, 9001.0)];
    tabulated("table with a kink", &points, 0.02)
}

fn wall() -> Case {
    let points = [(-1e-2, -10.0), (0.0, 0.0), (1e-2, 10.0), (1.1e-2, 1e6)];
    tabulated("wall of 10⁶ times the stiffness before it", &points, 0.04)
}

/// A block of foam, struck so fast that it densifies.
fn densification(speed: f64) -> Case {
    let law = Foam {
        modulus: 1e6,
        plateau: 1e4,
        densification: 1e4,
        exponent: 3.0,
        thickness: 0.05,
        area: 0.01,
    };
    let deepest = depth(&law, 0.5 * speed * speed, 0.05);
    let force = law.force(deepest, 0.0);
    let text = Text::head(1.0, speed)
        .pad("foam = { modulus = 1e6, plateau = 1e4, densification = 1e4, exponent = 3.0, thickness = 0.05, area = 0.01 }")
        .measure("pad", FORCES)
        .with(PARTS)
        .lasting(0.2 / speed);
    Case::new(format!("foam struck at {speed} m/s"), "energy", text, move |trial| {
        trial.measure("pad.peak-deformation", deepest);
        trial.measure("pad.peak-force", force);
        trial.measure("head.end-velocity", -speed);
        trial.energy_closes();
    })
}

fn hysteresis() -> Case {
    let text = Text::head(1.0, 1.0)
        .pad("hysteretic-foam = { modulus = 1e6, plateau = 1e4, densification = 1e4, exponent = 3.0, thickness = 0.05, area = 0.01, set = 0.3, unloading-exponent = 2.0 }")
        .measure("pad", FORCES)
        .lasting(0.1);
    Case::new("foam that keeps a set", "energy", text, |trial| {
        let law = Foam {
            modulus: 1e6,
            plateau: 1e4,
            densification: 1e4,
            exponent: 3.0,
            thickness: 0.05,
            area: 0.01,
        };
        let deepest = depth(&law, 0.5, 0.05);
        trial.measure("pad.peak-deformation", deepest);
        trial.measure("pad.peak-force", law.force(deepest, 0.0));
        let impulse =
            trial.report.measure("pad.impulse").and_then(|own| own.value).unwrap_or(f64::NAN);
        let speed = trial.signal("head.velocity").value(trial.end());
        trial.number("momentum", impulse, 1.0 - speed, impulse, Some(1e-3 * impulse));
        trial.energy_closes();
    })
}

/// The cube beside a spring, so small that it hardly matters.
fn tiny_cube() -> Case {
    let text = Text::head(1.0, 1.0)
        .pad("cubic-spring = { stiffness = 100.0, cubic = 1e-12 }")
        .measure("pad", FORCES)
        .lasting(1.0);
    Case::new("cube of 10⁻¹² beside a spring", "limit", text, |trial| {
        let (sine, cosine) = 10.0_f64.sin_cos();
        trial.ends("head", 0.1 * sine, cosine);
        trial.measure("pad.peak-force", 10.0);
    })
}

fn hunt_crossley_at_rest() -> Case {
    let text = Text::head(2.0, 0.0)
        .pad("hunt-crossley = { force = 100.0, at = 1e-3, dissipation = 0.5, exponent = 1.5 }")
        .measure("pad", FORCES)
        .with("[effects]\ngravity = { value = 9.80665, start = \"unloaded\" }\n")
        .lasting(20.0);
    Case::new(
        "weight that settles on a contact of no stiffness at touch",
        "balance",
        text,
        |trial| {
            let weight = 2.0 * 9.806_65;
            trial.measure("pad.end-deformation", 1e-3 * (weight / 100.0_f64).powf(2.0 / 3.0));
            trial.measure("pad.impulse", weight * 20.0);
            trial.last("pad.force", weight);
        },
    )
}
