//! Pads so long that waves travel in them.

use super::{Solved, changed, close, solved};

const MODULUS: f64 = 3e9;
const DENSITY: f64 = 1150.0;
const LENGTH: f64 = 0.6;
const AREA: f64 = 3e-4;
const MASS: f64 = 0.3;
const SPEED: f64 = 2.0;
const TIP: f64 = 6e6;

/// How far the force on the bar is from the closed form until the echo is back, relative to the
/// largest.
///
/// The bar answers the tip like a dashpot of its impedance Z, so the hammer strikes a Maxwell
/// element: `F″ + (k/Z) F′ + (k/m) F = 0`, `F(0) = 0`, `F′(0) = k V`.
fn distance(solved: &Solved) -> f64 {
    let wave = f64::sqrt(MODULUS / DENSITY);
    let impedance = DENSITY * wave * AREA;
    let half = 0.5 * TIP / impedance;
    let root = f64::sqrt(half * half - TIP / MASS);
    let expected = |t: f64| TIP * SPEED / root * (-half * t).exp() * f64::sinh(root * t);
    let force = solved.signal("tip.force");
    let times = (0..=400).map(|at| 2.0 * 0.9 * LENGTH / wave * f64::from(at) / 400.0);
    let (mut apart, mut largest) = (0.0_f64, 0.0_f64);
    for t in times {
        apart = apart.max((force.value(t) - expected(t)).abs());
        largest = largest.max(expected(t));
    }
    assert!(largest < impedance * SPEED, "a wave of the speed V has the force Z V");
    apart / largest
}

#[test]
fn a_blow_on_a_bar_is_braked_by_its_impedance_until_the_echo_is_back() {
    let fine = distance(&solved("polymer-bar"));
    let coarse =
        distance(&changed("polymer-bar", |text| text.replace("segments = 24", "segments = 12")));
    // The wave's own frequency is near k/Z; segments make it (ω Δt)²/24 late and let it ring.
    assert!(fine < 0.02 && fine < 0.5 * coarse, "{coarse} {fine}");
}

#[test]
fn a_blow_on_a_bar_arrives_after_its_length_over_the_speed_of_waves() {
    let solved = solved("polymer-bar");
    let arrival = LENGTH / f64::sqrt(MODULUS / DENSITY);
    let (near, far) = (solved.signal("tip.force"), solved.signal("cell.force"));
    // The held end doubles the force. Fronts are where the force first has half of its height.
    let height = near.maximum((0.0, arrival)).value;
    let front = |signal: &dashpot::dae::Signal, level: f64| {
        signal.first_crossing(level, (0.0, 2.0 * arrival), Some(true)).unwrap().time
    };
    let travelled = front(&far, height) - front(&near, 0.5 * height);
    close("arrival, L/c", travelled, arrival, 0.02 * arrival);
    assert!(far.absolute_maximum((0.0, 0.7 * arrival)).value < 0.02 * height, "it comes too early");
}
