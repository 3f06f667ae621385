//! Sliders beside and behind springs: what comes of them follows from forces, not from the order in
//! which they are written.

mod elastoplastic;

use self::elastoplastic::{Branch, Pad};
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
            .map(|_| Branch {
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
    let largest = places.iter().map(|own| own[1].abs()).fold(0.0, f64::max);
    places.iter().map(|own| (own[0] - own[1]).abs()).fold(0.0, f64::max) / largest
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
