//! Free motion with known solutions, the defective ones among them.

use super::Scene;

fn oscillator(omega2: f64, damping: f64) -> Scene {
    Scene::new(&[&[0.0, 1.0], &[-omega2, -damping]], &[0.0, 1.0])
}

#[test]
fn critical_damping_exactly() {
    let solved = oscillator(1.0, 2.0).solve(40.0);
    solved.judge(0, 2e-14, |t| t * (-t).exp());
    solved.judge(1, 2e-14, |t| (1.0 - t) * (-t).exp());
}

#[test]
fn critical_damping_nearly() {
    for zeta in [1.0 - 1e-8, 1.0 + 1e-8, 1.0 - 1e-4, 1.0 + 1e-4, 1.0 + 1e-2] {
        let solved = oscillator(1.0, 2.0 * zeta).solve(30.0);
        // ζ² − 1 of the rounded damping, without cancellation.
        let excess = (0.5 * (2.0 * zeta) - 1.0) * (0.5 * (2.0 * zeta) + 1.0);
        let root = excess.abs().sqrt();
        solved.judge(0, 1e-13, |t| {
            let shape = if excess < 0.0 { (root * t).sin() } else { (root * t).sinh() };
            (-zeta * t).exp() * shape / root
        });
    }
}

#[test]
fn a_triple_root_on_a_zener_element() {
    // 1 kg on K0 = 1/3 ∥ (K1 = 8/3, C1 = 8/9): states x, v, stretch of the Maxwell dashpot.
    let (k0, k1, c1) = (1.0 / 3.0, 8.0 / 3.0, 8.0 / 9.0);
    let rows: [&[f64]; 3] = [&[0.0, 1.0, 0.0], &[-k0 - k1, 0.0, k1], &[k1 / c1, 0.0, -k1 / c1]];
    let solved = Scene::new(&rows, &[0.0, 1.0, 0.0]).solve(40.0);
    solved.judge(0, 3e-14, |t| (t + t * t) * (-t).exp());
}

#[test]
fn free_rigid_motion() {
    let solved = Scene::new(&[&[0.0, 1.0], &[0.0, 0.0]], &[2.0, -3.0]).solve(1e3);
    solved.judge(0, 1e-10, |t| 2.0 - 3.0 * t);
    solved.judge(1, 1e-13, |_| -3.0);
    assert_eq!(solved.signal(0).panels.len(), 1);
}

#[test]
fn two_coupled_masses_that_fly_away() {
    // Centre of mass: x = t/2; relative motion: sin(√2 t)/√2.
    let rows: [&[f64]; 4] = [
        &[0.0, 0.0, 1.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0],
        &[-1.0, 1.0, 0.0, 0.0],
        &[1.0, -1.0, 0.0, 0.0],
    ];
    let solved = Scene::new(&rows, &[0.0, 0.0, 1.0, 0.0]).solve(1e3);
    let w = 2_f64.sqrt();
    solved.judge(0, 2e-11, |t| 0.5 * t + 0.5 * (w * t).sin() / w);
}

#[test]
fn an_undamped_oscillator_over_a_thousand_periods() {
    let end = 1000.0 * std::f64::consts::TAU;
    let solved = oscillator(1.0, 0.0).solve(end);
    let signal = solved.signal(0);
    // A time is rounded to ε t, and so is the phase.
    assert!(signal.error.unwrap() < 2e-12, "{:e}", signal.error.unwrap());
    for k in 0..1000 {
        let t = end * f64::from(k) / 997.0;
        if t <= end {
            assert!((signal.value(t) - t.sin()).abs() < signal.error.unwrap());
        }
    }
    let last = solved.samples(&(0..=500).map(|k| end * f64::from(k) / 500.0).collect::<Vec<_>>());
    assert!(last[2 * 500].abs() < 1e-10, "the propagator keeps the phase: {:e}", last[1000]);
    assert_eq!(signal.crossings(0.0, (1.0, end - 1.0)).len(), 1999);
}

#[test]
fn growth_is_followed_and_overflow_is_an_error() {
    use crate::{Method, Run, Silent, SolveError, methods::Exact};
    let growing = Scene::new(&[&[1.0]], &[1.0]);
    growing.solve(100.0).judge(0, 1e-12 * 100_f64.exp(), f64::exp);
    let system = growing.system();
    let lost = Exact.integrate(&system, &Run::to(1000.0), &mut Silent).unwrap_err();
    assert!(matches!(lost, SolveError::NotFinite { .. }), "{lost}");
}

#[test]
fn a_run_of_no_length_keeps_its_start() {
    let solved = oscillator(4.0, 0.1).solve(0.0);
    let signal = solved.signal(1);
    assert_eq!((signal.panels.len(), signal.value(0.0)), (1, 1.0));
    assert_eq!(solved.samples(&[0.0]), [0.0, 1.0]);
}

#[test]
fn no_unknowns_at_all_are_no_trouble() {
    let solved = Scene::new(&[], &[]).reporting(&[], None).solve(1.0);
    assert_eq!(solved.signal(0).value(0.5), 0.0);
    assert!(solved.samples(&[0.0, 0.5, 1.0]).is_empty());
}
