//! Driven motion: every kind of waveform against its closed form.

use super::Scene;
use crate::{Input, Piece, Waveform};

const PI: f64 = std::f64::consts::PI;

fn waveform(pieces: &[Piece]) -> Waveform {
    Waveform::new(pieces.to_vec()).unwrap()
}

fn free_mass(drive: Waveform) -> Scene {
    Scene::new(&[&[0.0, 1.0], &[0.0, 0.0]], &[0.0, 0.0]).driven(1, 1.0, 0, drive)
}

fn oscillator(drive: Waveform) -> Scene {
    Scene::new(&[&[0.0, 1.0], &[-1.0, 0.0]], &[0.0, 0.0]).driven(1, 1.0, 0, drive)
}

#[test]
fn a_fall_under_gravity() {
    let g = 9.80665;
    free_mass(Waveform::constant(g)).solve(100.0).judge(0, 1e-9, |t| 0.5 * g * t * t);
}

#[test]
fn a_ramp_on_a_free_mass_is_a_cubic() {
    let ramp = waveform(&[Piece { slope: 6.0, ..Piece::default() }]);
    free_mass(ramp).solve(10.0).judge(0, 1e-10, |t| t * t * t);
}

#[test]
fn a_pulse_is_followed_while_it_lasts_only() {
    // 10⁻⁹ of the run: as many radians as nobody would follow if it lasted.
    let (start, length) = (0.5, 1e-9);
    let half_sine = Piece { start, sine: 1.0, omega: PI / length, ..Piece::default() };
    let rest = |start| Piece { start, ..Piece::default() };
    let pulse = waveform(&[rest(0.0), half_sine, rest(start + length)]);
    let solved = oscillator(pulse).solve(20.0);
    let signal = solved.signal(0);
    assert!(signal.panels.len() < 100, "{} panels", signal.panels.len());
    // The impulse 2 T/π, in the middle of the pulse.
    let impulse = 2.0 / PI * length;
    for t in [1.0, 3.3, 20.0] {
        let expected = impulse * (t - start - 0.5 * length).sin();
        let (found, bound) = (signal.value(t), signal.error.unwrap());
        assert!((found - expected).abs() <= bound + 1e-15 * impulse, "{t}: {found} {bound:e}");
        assert!(bound < 1e-12 * impulse, "{bound:e}");
    }
    assert_eq!(signal.value(0.4), 0.0);
}

#[test]
fn resonance_grows_as_it_must() {
    let sine = waveform(&[Piece { sine: 1.0, omega: 1.0, ..Piece::default() }]);
    oscillator(sine).solve(200.0).judge(0, 1e-11, |t| 0.5 * (t.sin() - t * t.cos()));
}

#[test]
fn near_resonance_beats() {
    let w = 1.0 + 1e-7;
    let sine = waveform(&[Piece { sine: 1.0, omega: w, ..Piece::default() }]);
    // (sin ωt − ω sin t)/(1 − ω²), as the beat it is.
    let eps = w - 1.0;
    oscillator(sine).solve(50.0).judge(0, 1e-12, |t| {
        let beat = 2.0 * (0.5 * (w + 1.0) * t).cos() * (0.5 * eps * t).sin();
        (beat - eps * t.sin()) / (-eps * (1.0 + w))
    });
}

#[test]
fn a_constant_force_stretches_a_spring() {
    oscillator(Waveform::constant(2.0)).solve(20.0).judge(0, 1e-13, |t| 2.0 * (1.0 - t.cos()));
}

#[test]
fn a_ramp_with_a_stop() {
    let drive = waveform(&[
        Piece { slope: 0.5, ..Piece::default() },
        Piece { start: 2.0, value: 1.0, ..Piece::default() },
    ]);
    let ramp = |t: f64| if t < 0.0 { 0.0 } else { 0.5 * (t - t.sin()) };
    oscillator(drive).solve(20.0).judge(0, 1e-13, |t| ramp(t) - ramp(t - 2.0));
}

#[test]
fn a_half_sine_pulse() {
    let omega = 3.0;
    let end = PI / omega;
    let drive = waveform(&[
        Piece::default(),
        Piece { start: 1.0, sine: 1.0, omega, ..Piece::default() },
        Piece { start: 1.0 + end, ..Piece::default() },
    ]);
    let wave = |t: f64| {
        if t < 0.0 { 0.0 } else { ((omega * t).sin() - omega * t.sin()) / (1.0 - omega * omega) }
    };
    oscillator(drive).solve(20.0).judge(0, 1e-13, |t| wave(t - 1.0) + wave(t - 1.0 - end));
}

#[test]
fn a_table_with_a_jump() {
    let drive = waveform(&[
        Piece { value: 1.0, slope: -0.25, ..Piece::default() },
        Piece { start: 1.0, value: 0.75, slope: 0.5, ..Piece::default() },
        Piece { start: 2.5, value: -2.0, ..Piece::default() },
    ]);
    let ramp = |t: f64| if t < 0.0 { 0.0 } else { t - t.sin() };
    let step = |t: f64| if t < 0.0 { 0.0 } else { 1.0 - t.cos() };
    oscillator(drive).solve(30.0).judge(0, 2e-13, |t| {
        step(t) - 0.25 * ramp(t) + 0.75 * ramp(t - 1.0) - 0.5 * ramp(t - 2.5) - 3.5 * step(t - 2.5)
    });
}

#[test]
fn a_table_of_a_thousand_rows_loses_nothing() {
    // A saw on a free mass: v(t) is the integral, exactly periodic.
    let pieces: Vec<Piece> = (0..1000)
        .map(|k| {
            let (start, up) = (f64::from(k), k % 2 == 0);
            let (value, slope) = if up { (-1.0, 2.0) } else { (1.0, -2.0) };
            Piece { start, value, slope, ..Piece::default() }
        })
        .collect();
    let saw = |t: f64| {
        let (whole, s) = (t.floor(), t - t.floor());
        let sign = if whole % 2.0 == 0.0 { 1.0 } else { -1.0 };
        sign * (s * s - s)
    };
    let solved = free_mass(waveform(&pieces)).solve(1000.0);
    let velocity = solved.signal(1);
    let error = velocity.error.unwrap();
    assert!(error < 1e-10, "{error:e}");
    for k in 0..1000 {
        let t = 0.9973 * f64::from(k);
        assert!((velocity.value(t) - saw(t)).abs() <= error, "{t}");
    }
}

#[test]
fn rates_of_a_drive_reach_equations_and_outputs() {
    // ẏ = u̇ follows u; the outputs are u, u̇ and ü.
    let omega = 7.0;
    let piece =
        Piece { value: 2.0, slope: 0.5, sine: 1.0, cosine: -0.5, omega, ..Piece::default() };
    let input = |derivative| Some(Input { waveform: 0, derivative });
    let solved = Scene::new(&[&[0.0]], &[1.5])
        .driven(0, 1.0, 1, waveform(&[piece]))
        .reporting(&[0.0], input(0))
        .reporting(&[0.0], input(1))
        .reporting(&[0.0], input(2))
        .solve(10.0);
    solved.judge(0, 1e-12, |t| piece.derivative(0, t));
    solved.judge(1, 1e-12, |t| piece.derivative(0, t));
    solved.judge(2, 1e-12, |t| piece.derivative(1, t));
    solved.judge(3, 1e-11, |t| piece.derivative(2, t));
}

#[test]
fn two_drives_of_one_frequency_stay_apart() {
    let cosine = waveform(&[Piece { cosine: 1.0, omega: 2.0, ..Piece::default() }]);
    let sine = waveform(&[Piece { sine: 1.0, omega: 2.0, ..Piece::default() }]);
    let solved = Scene::new(&[&[0.0, 0.0], &[0.0, 0.0]], &[0.0, -0.5])
        .driven(0, 1.0, 0, cosine)
        .driven(1, 1.0, 0, sine)
        .solve(10.0);
    solved.judge(0, 1e-13, |t| 0.5 * (2.0 * t).sin());
    solved.judge(1, 1e-13, |t| -0.5 * (2.0 * t).cos());
}

/// `1 − cos t`, `t − sin t` … : what a force `tⁿ/n!` from `t = 0` on does to an oscillator at rest, by
/// its series where its terms cancel.
fn power_response(n: u32, t: f64) -> f64 {
    if t <= 0.0 {
        return 0.0;
    }
    if t < 1.0 {
        let mut term = (1..=n + 2).fold(1.0, |term, k| term * t / f64::from(k));
        let mut sum = 0.0;
        for k in 0..12 {
            sum += term;
            let order = f64::from(n + 3 + 2 * k);
            term *= -t * t / (order * (order + 1.0));
        }
        return sum;
    }
    match n {
        0 => 1.0 - t.cos(),
        1 => t - t.sin(),
        2 => 0.5 * t * t - 1.0 + t.cos(),
        _ => t * t * t / 6.0 - t + t.sin(),
    }
}

#[test]
fn parabolas_and_cubics_are_followed() {
    let piece = Piece { value: 1.0, slope: -2.0, curvature: 3.0, jerk: -0.5, ..Piece::default() };
    oscillator(waveform(&[piece])).solve(20.0).judge(0, 2e-11, |t| {
        power_response(0, t) - 2.0 * power_response(1, t) + 3.0 * power_response(2, t)
            - 0.5 * power_response(3, t)
    });
    let cubic = waveform(&[Piece { jerk: 120.0, ..Piece::default() }]);
    free_mass(cubic).solve(10.0).judge(0, 1e-8, |t| t.powi(5));
}

#[test]
fn the_rates_of_a_cubic_reach_equations_and_outputs() {
    let piece = Piece { value: 2.0, slope: 0.5, curvature: -1.0, jerk: 3.0, ..Piece::default() };
    let input = |derivative| Some(Input { waveform: 0, derivative });
    let drive = || waveform(&[piece]);
    for order in 1..4 {
        // Only the derivatives from this order on are in use.
        let begin = piece.derivative(order - 1, 0.0);
        let solved = Scene::new(&[&[0.0]], &[begin])
            .driven(0, 1.0, order, drive())
            .reporting(&[0.0], input(order))
            .solve(4.0);
        solved.judge(0, 1e-12, |t| piece.derivative(order - 1, t));
        solved.judge(1, 1e-12, |t| piece.derivative(order, t));
    }
}

#[test]
fn a_haversine_pulse() {
    let (omega, start) = (5.0, 1.0);
    let end = 2.0 * PI / omega;
    let drive = waveform(&[
        Piece::default(),
        Piece { start, value: 0.5, cosine: -0.5, omega, ..Piece::default() },
        Piece { start: start + end, ..Piece::default() },
    ]);
    let wave = |t: f64| {
        let cosine = (t.cos() - (omega * t).cos()) / (omega * omega - 1.0);
        if t < 0.0 { 0.0 } else { 0.5 * (1.0 - t.cos() - cosine) }
    };
    oscillator(drive).solve(20.0).judge(0, 1e-13, |t| wave(t - start) - wave(t - start - end));
}

#[test]
fn a_pulse_of_acceleration_on_the_base() {
    // x'' = −(x − u) with u'' a half-sine: the deformation y = x − u obeys y'' = −y − u''.
    let omega = 3.0;
    let end = PI / omega;
    let pulse = waveform(&[
        Piece { sine: 1.0, omega, ..Piece::default() },
        Piece { start: end, ..Piece::default() },
    ]);
    let base = pulse.integral().and_then(|velocity| velocity.integral()).unwrap();
    assert!((base.value(end + 4.0) - (end + 4.0 * 2.0) / omega).abs() < 1e-14);
    let wave = |t: f64| {
        if t < 0.0 { 0.0 } else { ((omega * t).sin() - omega * t.sin()) / (1.0 - omega * omega) }
    };
    let solved = Scene::new(&[&[0.0, 1.0], &[-1.0, 0.0]], &[0.0, 0.0])
        .driven(1, 1.0, 0, base.clone())
        .reporting(&[-1.0, 0.0], Some(Input { waveform: 1, derivative: 0 }));
    let mut solved = solved;
    solved.waveforms.push(base);
    solved.solve(20.0).judge(2, 1e-12, |t| wave(t) + wave(t - end));
}

#[test]
fn a_chirp_is_declined_where_it_drives_something_within_the_run() {
    use crate::{Method, Run, Silent, SolveError, methods::Exact};
    let drive = waveform(&[
        Piece::default(),
        Piece { start: 2.0, sine: 1.0, omega: 1.0, sweep: 0.5, ..Piece::default() },
    ]);
    let system = oscillator(drive).system();
    let error = Exact.integrate(&system, &Run::to(3.0), &mut Silent).unwrap_err();
    let SolveError::NotApplicable { reason, .. } = error else { panic!("{error}") };
    assert!(reason.contains("chirp"), "{reason}");
    let quiet = Exact.integrate(&system, &Run::to(2.0), &mut Silent).unwrap();
    assert!(quiet.signal(&system, 0).bound() == 0.0);
}

#[test]
fn rates_have_their_closed_forms_within_their_bounds() {
    // x′ = −a x + sin ω t; told of y = x + sin ω t, of whose rate the jump of the drive at 2 s is no part.
    let (a, omega, until) = (3.0, 7.0, 2.0);
    let sine = Piece { sine: 1.0, omega, ..Piece::default() };
    let drive = waveform(&[sine, Piece { start: until, ..Piece::default() }]);
    let solved = Scene::new(&[&[-a]], &[1.0])
        .driven(0, 1.0, 0, drive)
        .reporting(&[1.0], Some(Input { waveform: 0, derivative: 0 }))
        .solve(5.0);
    let rate = solved.trajectory.dense.rate(&solved.system, 1);
    let bound = rate.error.unwrap();
    assert!(bound < 1e-12, "{bound:e}");
    let size = a * a + omega * omega;
    let forced = |t: f64| (a * (omega * t).sin() - omega * (omega * t).cos()) / size;
    let free = 1.0 + omega / size;
    for k in 0..500_u32 {
        let t = 0.01 * f64::from(k);
        let x = |t: f64| free * (-a * t).exp() + forced(t);
        let expected = if t < until {
            (omega * t).sin() - a * x(t) + omega * (omega * t).cos()
        } else {
            -a * x(until) * (-a * (t - until)).exp()
        };
        let off = (rate.value(t) - expected).abs();
        assert!(off <= bound, "{t}: {off:e} off, bound {bound:e}");
    }
}
