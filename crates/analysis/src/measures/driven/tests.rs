use std::f64::consts::PI;

use dashpot_network::{
    dashpot,
    elements::{CubicSpring, Rigid},
    parameters::Kind as _,
    part, spring,
};
use dashpot_rheology::Tree;

use super::*;
use crate::measures::tests::panels;

fn signal(end: f64, count: u32, function: impl Fn(f64) -> f64) -> Signal {
    Signal::new(panels(end, count, function), Some(1e-12), 1e-15)
}

fn agrees(found: &Signal, exact: impl Fn(f64) -> f64, size: f64) {
    for at in 0..=200 {
        let t = found.end() * f64::from(at) / 200.0;
        let (found, exact) = (found.value(t), exact(t));
        assert!((found - exact).abs() <= 1e-12 * size, "at {t}: {found} is not {exact}");
    }
}

#[test]
fn undamped_mass_under_a_step_swings_to_twice_its_rest() {
    let (omega, height) = (30.0, 50.0);
    let step = Signal::new(vec![Panel::constant(0.0, 0.5, height)], Some(0.0), 0.0);
    let oscillator = Oscillator::of(&spring(2.0 * omega * omega), 2.0).unwrap();
    let found = oscillator.deformation(&step, &[], (0.0, 0.5)).unwrap();
    let rest = height / (omega * omega);
    agrees(&found, |t| rest * (1.0 - (omega * t).cos()), rest);
    let largest = found.absolute_maximum((0.0, 0.5));
    assert!((largest.value / rest - 2.0).abs() < 1e-12);
    assert!((largest.time - PI / omega).abs() < 1e-6);
}

#[test]
fn damped_mass_under_a_half_sine_has_its_closed_form() {
    // y″ + 2ζω y′ + ω² y = A sin(pt): the steady part and what makes the start that of rest.
    let (omega, ratio, height, length) = (52.9, 0.224, 200.0, 0.04);
    let p = PI / length;
    let pulse = signal(length, 6, |t| height * (p * t).sin());
    let found = Oscillator::new(omega, ratio).deformation(&pulse, &[], (0.0, length)).unwrap();
    let (gap, loss) = (omega * omega - p * p, 2.0 * ratio * omega * p);
    let size = height / (gap * gap + loss * loss);
    let (sine, cosine) = (size * gap, -size * loss);
    let damped = omega * (1.0 - ratio * ratio).sqrt();
    let (start, speed) = (-cosine, -sine * p);
    let free = |t: f64| {
        let decay = (-ratio * omega * t).exp();
        let swing = (speed + ratio * omega * start) / damped;
        decay * (start * (damped * t).cos() + swing * (damped * t).sin())
    };
    agrees(&found, |t| sine * (p * t).sin() + cosine * (p * t).cos() + free(t), size * 4e3);
}

#[test]
fn mass_on_a_maxwell_element_has_its_closed_form() {
    // y″ = a − f, f′ = k y′ − r f: under a step f″ + r f′ + k f = k a, and y = (f + r ∫f)/k.
    let (k, rate, height) = (4000.0, 40.0, 100.0);
    let step = Signal::new(vec![Panel::constant(0.0, 0.2, height)], Some(0.0), 0.0);
    let maxwell = Tree::series([spring(k), dashpot(k / rate)]);
    let found = Oscillator::of(&maxwell, 1.0).unwrap().deformation(&step, &[], (0.0, 0.2)).unwrap();
    let half = 0.5 * rate;
    let omega = (k - half * half).sqrt();
    let decay = |t: f64| (-half * t).exp();
    let force =
        |t: f64| height * (1.0 - decay(t) * ((omega * t).cos() + half / omega * (omega * t).sin()));
    // The momentum: y′ = height t − ∫f, and f′ = k y′ − r f gives ∫f from the rest.
    let speed = |t: f64| {
        let rise = height * decay(t) * (k / omega) * (omega * t).sin();
        (rise + rate * force(t)) / k
    };
    let impulse = |t: f64| height * t - speed(t);
    agrees(&found, |t| (force(t) + rate * impulse(t)) / k, 0.1);
}

#[test]
fn a_jump_of_speed_is_an_impulse() {
    let still = Signal::new(vec![Panel::constant(0.0, 0.3, 0.0)], Some(0.0), 0.0);
    let omega = 40.0;
    let found =
        Oscillator::new(omega, 0.0).deformation(&still, &[(0.1, -2.0)], (0.0, 0.3)).unwrap();
    let exact = |t: f64| if t < 0.1 { 0.0 } else { -2.0 / omega * (omega * (t - 0.1)).sin() };
    agrees(&found, exact, 2.0 / omega);
}

#[test]
fn stiff_models_are_followed_or_refused() {
    // A relaxation time of 10 µs beside a run of 0.2 s.
    let stiff = Tree::parallel([spring(900.0), Tree::series([spring(1e4), dashpot(0.1)])]);
    let step = Signal::new(vec![Panel::constant(0.0, 0.2, 9.0)], Some(0.0), 0.0);
    let oscillator = Oscillator::of(&stiff, 1.0).unwrap();
    let found = oscillator.deformation(&step, &[], (0.0, 0.2)).unwrap();
    // The fast element is a dashpot of 0.1 N s/m, but for its spring.
    let damping: f64 = 0.05;
    let omega = (900.0 - damping * damping).sqrt();
    let slow = |t: f64| {
        let swing = (omega * t).cos() + damping / omega * (omega * t).sin();
        0.01 * (1.0 - (-damping * t).exp() * swing)
    };
    for at in 0..=20 {
        let t = 0.01 * f64::from(at);
        assert!((found.value(t) - slow(t)).abs() < 1e-2 * 0.01, "at {t}");
    }
    assert!(oscillator.deformation(&step, &[], (0.0, 1e4)).is_none());
}

#[test]
fn what_cannot_deform_or_is_not_linear_carries_no_mass() {
    assert_eq!(Oscillator::of(&part(Rigid), 1.0), None);
    let cubic = CubicSpring::sample();
    assert_eq!(Oscillator::of(&part(cubic), 1.0), None);
}
