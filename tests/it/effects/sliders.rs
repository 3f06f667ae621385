//! Sliders beside and behind springs: what comes of them follows from forces, not from the order in
//! which they are written.

mod branches;
mod elastoplastic;

use self::{
    branches::{Body, Branch},
    elastoplastic::{Jenkins, Pad},
};
use super::trial::{ALL, run};
use crate::random_networks::Dice;

/// A random pad that comes to rest between its sliders.
fn pad(dice: &mut Dice, branches: usize) -> Pad {
    let mut between = |low: f64, high: f64| low * (high / low).powf(dice.unit());
    let mass = between(0.5, 5.0);
    let stiffness = between(1e3, 5e4);
    let velocity = between(0.3, 4.0);
    let force = velocity * (stiffness * mass).sqrt();
    Pad {
        mass,
        velocity,
        stiffness,
        damping: 0.05 * between(0.1, 1.0) * (stiffness * mass).sqrt(),
        guard: force * between(0.05, 0.5),
        branches: (0..branches)
            .map(|_| Jenkins {
                stiffness: stiffness * between(0.3, 5.0),
                force: force * between(0.05, 0.6),
            })
            .collect(),
    }
}

/// All orders of so many things.
fn orders(count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let longer = |own: Vec<usize>| {
        (0..count).map(move |at| {
            let mut own = own.clone();
            own.insert(at, count - 1);
            own
        })
    };
    orders(count - 1).into_iter().flat_map(longer).collect()
}

/// The largest difference of places from those of the motion itself, in parts of the largest.
fn difference(pad: &Pad, order: &[usize], method: &str) -> f64 {
    let motion = pad.motion();
    let duration = 1.3 * motion.rest();
    let report = run(&pad.scene(order, duration), method);
    let output = report.assembly.output("head.position").expect("a place");
    let solution = report.solution();
    let found = solution.signal(output);
    let times = (1..40).map(|at| duration * f64::from(at) / 40.0);
    let places: Vec<[f64; 2]> = times.map(|time| [found.value(time), motion.place(time)]).collect();
    let largest = places.iter().map(|place| place[1].abs()).fold(0.0, f64::max);
    places.iter().map(|place| (place[0] - place[1]).abs()).fold(0.0, f64::max) / largest
}

#[test]
fn a_pad_of_sliders_moves_alike_in_every_order_of_its_parts() {
    let mut dice = Dice(16);
    for (scenes, branches, every) in [(60, 1, 1), (20, 2, 13)] {
        for nth in 0..scenes {
            let pad = pad(&mut dice, branches);
            for order in orders(3 + branches).iter().step_by(every) {
                let error = difference(&pad, order, "exact");
                assert!(error < 1e-10, "{nth}: {error:e} in {order:?} of {pad:?}");
            }
        }
    }
}

#[test]
fn a_pad_of_sliders_moves_alike_by_every_method() {
    let mut dice = Dice(17);
    for nth in 0..8 {
        let pad = pad(&mut dice, 1 + nth % 2);
        let order: Vec<usize> = (0..3 + pad.branches.len()).rev().collect();
        for method in ALL {
            let error = difference(&pad, &order, method);
            assert!(error < 1e-3, "{nth}: {error:e} by {method} of {pad:?}");
        }
    }
}

fn cubic(y: f64) -> f64 {
    1e3 * y + 1e6 * y.powi(3)
}

fn power(y: f64) -> f64 {
    40.0 * (y.abs() / 0.02).powf(1.5).copysign(y)
}

/// A spring of 3 kN/m and one that stiffens, in a row.
fn row(y: f64) -> f64 {
    let inner = branches::zero(|inner| cubic(inner) - 3e3 * (y - inner));
    cubic(inner)
}

const CUBIC: &str = "{ cubic-spring = { stiffness = 1000.0, cubic = 1e6 } }";

fn branch(text: &'static str, law: fn(f64) -> f64, beside: f64, slider: f64) -> Branch {
    Branch { text, law, beside, slider }
}

/// Masses of 1 kg on 1 kN/m with what is beside the spring.
fn bodies() -> Vec<(&'static str, Body)> {
    let power_text = "{ power-spring = { force = 40.0, at = 0.02, exponent = 1.5 } }";
    let row_text = "{ spring = 3000.0 }, { cubic-spring = { stiffness = 1000.0, cubic = 1e6 } }";
    let all = [
        ("cubic", 0.0, vec![branch(CUBIC, cubic, 0.0, 5.0)]),
        ("cubic and a guard", 5.0, vec![branch(CUBIC, cubic, 0.0, 5.0)]),
        ("power", 1.0, vec![branch(power_text, power, 0.0, 8.0)]),
        ("two", 2.0, vec![branch(CUBIC, cubic, 0.0, 5.0), branch(power_text, power, 0.0, 9.0)]),
        ("beside", 2.0, vec![branch(CUBIC, cubic, 500.0, 5.0)]),
        ("row", 2.0, vec![branch(row_text, row, 0.0, 5.0)]),
    ];
    let body = |guard: f64, branches: Vec<Branch>| Body {
        mass: 1.0,
        velocity: 1.0,
        stiffness: 1e3,
        guard,
        branches,
    };
    all.map(|(name, guard, branches)| (name, body(guard, branches))).into_iter().collect()
}

#[test]
fn laws_that_are_not_linear_slip_behind_sliders() {
    const COUNT: usize = 30;
    for (name, body) in bodies() {
        let duration = 0.3;
        let places = body.places(duration, COUNT);
        let largest = places.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        for method in ["auto", "bdf", "esdirk34", "tr-bdf2"] {
            let report = run(&body.scene(duration), method);
            let output = report.assembly.output("head.position").expect("a place");
            let solution = report.solution();
            let found = solution.signal(output);
            let per_tolerance = if report.solver.method == "tr-bdf2" { 1e4 } else { 1e3 };
            let near = per_tolerance * report.solver.rtol.expect("a tolerance");
            for (at, place) in places.iter().enumerate() {
                let time = duration * (at + 1) as f64 / COUNT as f64;
                let error = (found.value(time) - place).abs() / largest;
                assert!(error <= near, "{name} by {method} at {time}: {error:e} > {near:e}");
            }
            let closure = report.energy.closure().abs();
            assert!(closure < 1e-3, "{name} by {method}: {closure:e}");
        }
    }
}

/// A guard of 200 N beside a slider of 300 N behind a spring: at the turn the springs push with 773 N.
#[test]
fn a_guard_lets_go_of_what_pushes_harder_than_it_can_hold() {
    let pad = Pad {
        mass: 4.0,
        velocity: 3.0,
        stiffness: 20e3,
        damping: 30.0,
        guard: 200.0,
        branches: vec![Jenkins { stiffness: 47e3, force: 300.0 }],
    };
    for order in orders(4) {
        for method in ALL {
            let report = run(&pad.scene(&order, 0.2), method);
            let solution = report.solution();
            let signal = |name: &str| solution.signal(report.assembly.output(name).expect(name));
            let rest = signal("head.position").value(0.2);
            let near = if *method == "exact" { 1e-7 } else { 2e-5 };
            assert!((rest - 6.4887e-3).abs() < near, "{rest} by {method} in {order:?}");
            let push = pad.stiffness * rest + signal("pad.series.spring.force").value(0.2);
            let held = signal("pad.friction.force").value(0.2);
            assert!(
                push.abs() <= pad.guard && (push + held).abs() < 1e-3 * pad.guard,
                "{push} {held}"
            );
        }
    }
}

/// A panel on a guard and on a law that stiffens behind a slider, in a run that did not end. Judge: three
/// methods.
#[test]
fn a_panel_on_a_guard_and_a_law_behind_a_slider_comes_to_its_end() {
    let text = "
        [nodes]
        head = { mass = 0.5737, velocity = 5.599 }
        panel = { mass = 4.702, velocity = -2.233 }
        [elements]
        pad = { between = [\"head\", \"panel\"], parallel = [{ power-spring = { force = 846.0, at = 0.007085, exponent = 3.0 } }, { dashpot = 115.0 }] }
        mount = { between = [\"panel\", \"ground\"], parallel = [{ spring = 501940.0 }, { dashpot = 37.41 }, { friction = 623.7 }, { series = [{ cubic-spring = { stiffness = 71640.0, cubic = 7136000000.0 } }, { friction = 401.8 }] }] }
        [loads.push]
        on = \"panel\"
        force = { half-sine = { peak = 1313.0, duration = 0.002192, start = 0.001206 } }
        [run]
        duration = 0.005877
        ";
    let ends = |method: &str| {
        let report = run(text, method);
        let solution = report.solution();
        ["head.position", "panel.position"]
            .map(|name| solution.signal(report.assembly.output(name).expect(name)).value(0.005_877))
    };
    let first = ends("auto");
    for method in ["esdirk34", "tr-bdf2"] {
        for (one, two) in first.into_iter().zip(ends(method)) {
            assert!((one - two).abs() < 1e-5, "{method}: {one} {two}");
        }
    }
}
