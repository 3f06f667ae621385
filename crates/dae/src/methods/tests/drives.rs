//! Driving functions that bend and sweep, stepped through.

use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::*;
use crate::{Input, LinearForm, Outputs, Piece, Unknown, UnknownKind, Waveform};

/// What the errors of steps at a tolerance may add up to within some ten cycles without damping.
fn global(name: &str, rtol: f64) -> f64 {
    20.0 * rtol.powf(least_slope(name))
}

/// `x'' = −x + u` from rest with the outputs `x`, `x'`, `u`, `u'` and `u''`.
fn oscillator(drive: &Waveform) -> System {
    let mut jacobian = CooMatrix::new(2, 2);
    jacobian.push(0, 1, 1.0);
    jacobian.push(1, 0, -1.0);
    let mut matrix = CooMatrix::new(2, 3);
    matrix.push(1, 0, 1.0);
    let unknown = |name: &str| Unknown {
        name: name.to_owned(),
        kind: UnknownKind::Differential,
        scale: 1.0,
        unit: "m",
    };
    let (mut outputs, none) = (Outputs::new(), LinearForm::zero());
    for at in 0..2 {
        outputs.push("", "m", 1.0, &LinearForm::term(at, 1.0), &none);
    }
    for at in 0..3 {
        outputs.push("", "m", 1.0, &none, &LinearForm::term(at, 1.0));
    }
    System {
        unknowns: vec![unknown("x"), unknown("v")],
        jacobian: CsrMatrix::from(&jacobian),
        input_matrix: CsrMatrix::from(&matrix),
        inputs: (0..3).map(|derivative| Input { waveform: 0, derivative }).collect(),
        waveforms: vec![drive.clone()],
        terms: Vec::new(),
        initial: vec![0.0, 0.0],
        outputs,
        time_scale: 1.0,
    }
}

#[test]
fn a_pulse_that_is_zero_at_both_ends_is_not_overlooked() {
    let (start, length) = (0.5, 1e-9);
    let rest = |start| Piece { start, ..Piece::default() };
    let omega = std::f64::consts::PI / length;
    let half_sine = Piece { start, sine: 0.5 * omega, omega, ..Piece::default() };
    // s (T − s), as a parabola, with the area 1.
    let steep = 6.0 / length.powi(2);
    let parabola =
        Piece { start, slope: steep, curvature: -2.0 * steep / length, ..Piece::default() };
    for pulse in [half_sine, parabola] {
        let pulse = Waveform::new(vec![rest(0.0), pulse, rest(start + length)]).unwrap();
        let system = oscillator(&pulse);
        for name in steppers() {
            let run = Run::to(2.0).with_rtol(1e-6);
            let solved = by_name(name).unwrap().integrate(&system, &run, &mut Silent).unwrap();
            let found = solved.signal(&system, 0).value(2.0);
            let expected = 1.5_f64.sin();
            assert!((found - expected).abs() < global(name, 1e-6), "{name}: {found} {expected}");
        }
    }
}

/// Duhamel's integral `∫₀ᵗ sin(t − τ) u(τ) dτ` at the ends of `count` equal parts of `[0, end]`,
/// each part by Gauss' rule of five points on ten panels.
fn duhamel(drive: &Waveform, end: f64, count: u32) -> Vec<f64> {
    let root = 2.0 * (10.0_f64 / 7.0).sqrt();
    let [inner, outer] = [(5.0 - root).sqrt() / 3.0, (5.0 + root).sqrt() / 3.0];
    let heavy = (322.0 + 13.0 * 70.0_f64.sqrt()) / 900.0;
    let light = (322.0 - 13.0 * 70.0_f64.sqrt()) / 900.0;
    let rule =
        [(-outer, light), (-inner, heavy), (0.0, 128.0 / 225.0), (inner, heavy), (outer, light)];
    let half = end / f64::from(count) / 20.0;
    // ∫ cos τ u and ∫ sin τ u, as far as they go.
    let mut sums = [0.0; 2];
    let mut responses = Vec::new();
    for part in 0..count * 10 {
        let middle = half * f64::from(2 * part + 1);
        for (place, weight) in rule {
            let at = middle + half * place;
            let force = half * weight * drive.value(at);
            sums[0] += force * at.cos();
            sums[1] += force * at.sin();
        }
        if part % 10 == 9 {
            let t = middle + half;
            responses.push(t.sin() * sums[0] - t.cos() * sums[1]);
        }
    }
    responses
}

/// From 0.1 to 4 rad/s within 40, through the resonance at 1, and on at 4 rad/s.
fn chirp() -> Waveform {
    let (omega, sweep, end) = (0.1, 3.9 / 40.0, 40.0);
    let swept = Piece { sine: 1.0, omega, sweep, ..Piece::default() };
    let (sin, cos) = ((omega + 0.5 * sweep * end) * end).sin_cos();
    let steady = Piece { start: end, sine: cos, cosine: sin, omega: 4.0, ..Piece::default() };
    Waveform::new(vec![swept, steady]).unwrap()
}

/// The largest error of a method in `x` and its signal, against `expected` at equal distances.
fn error(name: &str, system: &System, end: f64, rtol: f64, expected: &[f64]) -> f64 {
    let run = Run::to(end).with_rtol(rtol);
    let trajectory = by_name(name).unwrap().integrate(system, &run, &mut Silent).unwrap();
    let signal = trajectory.signal(system, 0);
    let step = end / f64::from(u32::try_from(expected.len()).unwrap());
    let off = |(at, value): (u32, &f64)| (signal.value(step * f64::from(at)) - value).abs();
    (1..).zip(expected).map(off).fold(0.0, f64::max)
}

#[test]
fn a_chirp_through_resonance_is_duhamels_integral() {
    let (drive, end, count) = (chirp(), 60.0, 600);
    let system = oscillator(&drive);
    let expected = duhamel(&drive, end, count);
    // The border at 40 is one of panels, and halving them changes nothing.
    let finer = duhamel(&drive, end, 2 * count);
    let change = expected.iter().zip(finer.iter().skip(1).step_by(2)).map(|(a, b)| (a - b).abs());
    assert!(change.fold(0.0, f64::max) < 1e-13);
    let largest = expected.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    assert!(largest > 4.0, "it passes through the resonance: {largest}");
    for name in steppers() {
        let errors = [1e-6, 1e-9].map(|rtol| error(name, &system, end, rtol, &expected));
        let slope = (errors[0] / errors[1]).log10() / 3.0;
        assert!(errors[1] < global(name, 1e-9) && slope > least_slope(name), "{name}: {errors:?}");
    }
}

#[test]
fn outputs_follow_a_chirp_itself_and_its_rates() {
    let drive = chirp();
    let system = oscillator(&drive);
    for name in steppers() {
        let trajectory = by_name(name).unwrap();
        let trajectory = trajectory.integrate(&system, &Run::to(60.0), &mut Silent).unwrap();
        for order in 0..3 {
            let signal = trajectory.signal(&system, 2 + usize::try_from(order).unwrap());
            for k in 0..6000 {
                let t = 0.01 * f64::from(k) + 0.0037;
                let expected = drive.piece_at(t).derivative(order, t);
                let found = signal.value(t);
                // Four roundings of a time up to 60, times the rate, which is 4 times larger for
                // each order.
                let allowed = 240.0 * f64::EPSILON * 4_f64.powi(order.cast_signed() + 1);
                assert!((found - expected).abs() < allowed, "{name} {order} at {t}");
            }
        }
    }
}

#[test]
fn parabolas_and_cubics_are_stepped_through_as_the_exact_method_follows_them() {
    let bent = Piece { value: 1.0, slope: -1.0, curvature: 0.5, jerk: -0.1, ..Piece::default() };
    let parabola = Piece { start: 5.0, curvature: 0.25, ..Piece::default() };
    let wave = Piece { start: 9.0, sine: 0.5, omega: 2.0, jerk: 0.02, ..Piece::default() };
    let drive = Waveform::new(vec![bent, parabola, wave]).unwrap();
    let system = oscillator(&drive);
    let (end, count) = (14.0, 140);
    let expected = duhamel(&drive, end, count);
    assert!(error("exact", &system, end, 1e-9, &expected) < 1e-12);
    for name in steppers() {
        let found = error(name, &system, end, 1e-9, &expected);
        assert!(found < global(name, 1e-9), "{name}: {found:e}");
    }
    let trajectory = by_name("bdf").unwrap();
    let trajectory = trajectory.integrate(&system, &Run::to(end), &mut Silent).unwrap();
    let signal = trajectory.signal(&system, 2);
    for k in 0..1400 {
        let t = 0.01 * f64::from(k) + 0.0037;
        assert!((signal.value(t) - drive.value(t)).abs() < 1e-13, "{t}");
    }
}
