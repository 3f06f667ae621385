use super::*;

/// A piece that has a part of every sort.
const ALL: Piece = Piece {
    start: 0.5,
    value: -2.0,
    slope: 3.0,
    curvature: -5.0,
    jerk: 4.0,
    sine: 0.7,
    cosine: -1.1,
    omega: 6.0,
    sweep: 9.0,
};

fn waveform(pieces: &[Piece]) -> Waveform {
    Waveform::new(pieces.to_vec()).unwrap()
}

#[test]
fn a_pulse_has_its_area_however_long_the_run_is() {
    let half_sine = Piece { start: 0.5, sine: 3.0, omega: 100.0, ..Piece::default() };
    let rest = |start| Piece { start, ..Piece::default() };
    let pulse = waveform(&[rest(0.0), half_sine, rest(0.53)]);
    assert!((pulse.area_bound(1e6) - 3.0 * 0.03).abs() < 1e-12);
    assert!((pulse.area_bound(0.51) - 3.0 * 0.01).abs() < 1e-12);
    assert_eq!((pulse.area_bound(0.2), pulse.area_bound(0.0)), (0.0, 0.0));
    assert!((Waveform::constant(-2.0).area_bound(4.0) - 8.0).abs() < 1e-14);
}

#[test]
fn only_what_rises_and_falls_turns() {
    let at = |curvature: f64, jerk: f64| Piece { slope: 1.0, curvature, jerk, ..Piece::default() };
    assert!(!at(0.0, 0.0).turns(0.0, 10.0), "a line");
    assert!(at(-1.0, 0.0).turns(0.0, 1.5) && !at(-1.0, 0.0).turns(0.0, 0.9), "a parabola");
    // 1 − 3 s + 1.5 s²: falls between 0.42 and 1.58 only.
    assert!(at(-3.0, 3.0).turns(0.0, 2.0) && !at(-3.0, 3.0).turns(1.6, 9.0), "a cubic");
}

/// The derivative of `u` at `t` by differences of sixth order, and the error that is to be expected
/// of it for a function of size and rates up to `size`, `rate`⁷.
fn difference(u: impl Fn(f64) -> f64, t: f64, step: f64) -> f64 {
    let pair = |k: f64| u(t + k * step) - u(t - k * step);
    (45.0 * pair(1.0) - 9.0 * pair(2.0) + pair(3.0)) / (60.0 * step)
}

#[test]
fn each_derivative_is_the_rate_of_the_one_before() {
    let steady = Piece { sweep: 0.0, ..ALL };
    let polynomial = Piece { sine: 0.0, cosine: 0.0, ..ALL };
    let from_rest = Piece { omega: 0.0, ..ALL };
    for piece in [ALL, steady, polynomial, from_rest] {
        for order in 0..4_u32 {
            for k in 0..40 {
                let t = 0.1 * f64::from(k) - 1.0;
                let rate = piece.frequency(t).max(10.0);
                let size = 40.0 * rate.powi(order.cast_signed() + 1);
                let step = 1e-2 / rate;
                let found = difference(|t| piece.derivative(order, t), t, step);
                let expected = piece.derivative(order + 1, t);
                // The formula misses h⁶/140 of the seventh derivative, rounding is 2 ε of a value.
                let allowed = size * (1e-12 / 140.0 + 3.0 * f64::EPSILON / 1e-2);
                assert!((found - expected).abs() < allowed, "{order} at {t}: {found} {expected}");
            }
        }
    }
}

#[test]
fn a_swept_sine_has_its_closed_form() {
    let (t, w, k) = (1.3_f64, 6.0_f64, 9.0_f64);
    let piece = Piece { start: 0.0, sine: 2.0, omega: w, sweep: k, ..Piece::default() };
    let (phase, now) = (w * t + 0.5 * k * t * t, w + k * t);
    let (sin, cos) = phase.sin_cos();
    let expected = [
        2.0 * sin,
        2.0 * now * cos,
        2.0 * (k * cos - now * now * sin),
        -2.0 * (3.0 * k * now * sin + now * now * now * cos),
    ];
    for (order, expected) in (0..).zip(expected) {
        let found = piece.derivative(order, t);
        assert!((found - expected).abs() <= 1e-15 * 16.0 * now.powi(3), "{order}");
    }
    assert!((piece.frequency(t) - now).abs() < 1e-14);
}

#[test]
fn other_units_measure_the_same_function() {
    let (time, value) = (0.3, 7.0);
    let own = waveform(&[ALL]);
    let other = own.in_units(time, value);
    for order in 0..4_u32 {
        let unit = value / time.powi(order.cast_signed());
        for k in 0..20 {
            let t = 0.1 * f64::from(k);
            let expected = own.piece_at(t).derivative(order, t);
            let found = unit * other.piece_at(t / time).derivative(order, t / time);
            let size = 40.0 * own.piece_at(t).frequency(t).max(4.0).powi(order.cast_signed());
            assert!((found - expected).abs() < 1e-14 * size, "{order} at {t}");
        }
    }
}

#[test]
fn what_is_constant_is_known_by_its_parts() {
    let cubic = Piece { jerk: 1.0, ..Piece::default() };
    let parabola = Piece { curvature: 1.0, slope: 2.0, ..Piece::default() };
    let still = Piece { omega: 5.0, sweep: 3.0, value: 2.0, ..Piece::default() };
    let chirp = Piece { sine: 1.0, sweep: 1.0, ..Piece::default() };
    let orders = |piece: Piece| [0, 1, 2, 3].map(|order| piece.is_constant(order));
    assert_eq!(orders(cubic), [false, false, false, true]);
    assert_eq!(orders(parabola), [false, false, true, true]);
    assert_eq!(orders(still), [true; 4]);
    assert_eq!(orders(chirp), [false; 4]);
    assert!(chirp.is_swept() && !still.is_swept() && !cubic.is_swept());
    let cosine = Piece { cosine: 2.0, value: 1.0, ..Piece::default() };
    assert!(!cosine.is_wave() && cosine.is_constant(0));
    assert!((cosine.derivative(0, 7.0) - 3.0).abs() < 1e-15);
}

#[test]
fn a_bound_is_the_largest_value_of_polynomials_and_no_less_than_that_of_waves() {
    let cubic = Piece { slope: 3.0, jerk: -6.0, ..Piece::default() };
    // 3 s − s³ is 2 at s = 1, and −2 at s = 2.
    for (end, largest) in [(0.5, 1.375), (1.5, 2.0), (2.0, 2.0), (3.0, 18.0)] {
        assert!((waveform(&[cubic]).bound(end) - largest).abs() < 1e-14, "{end}");
    }
    let arch = Piece { slope: 1.0, curvature: -2.0, ..Piece::default() };
    assert!((waveform(&[arch]).bound(1.0) - 0.25).abs() < 1e-15);
    let late = Piece { start: 2.0, value: 50.0, ..Piece::default() };
    assert!((waveform(&[arch, late]).bound(1.0) - 0.25).abs() < 1e-15);
    assert!((waveform(&[arch, late]).bound(5.0) - 50.0).abs() < 1e-15);
    // The first piece holds before its start.
    let early = Piece { start: 3.0, slope: 1.0, ..Piece::default() };
    assert!((waveform(&[early]).bound(4.0) - 3.0).abs() < 1e-15);
    let all = waveform(&[ALL, Piece { start: 2.0, curvature: 3.0, slope: -8.0, ..ALL }]);
    let bound = all.bound(4.0);
    let most = (0..=4000).map(|k| all.value(1e-3 * f64::from(k)).abs()).fold(0.0, f64::max);
    assert!(bound >= most && bound < 1.5 * most, "{bound} for {most}");
}

#[test]
fn an_integral_is_continuous_and_has_the_function_as_its_rate() {
    let steady = Piece { start: -0.4, jerk: 0.0, sweep: 0.0, ..ALL };
    let force = waveform(&[
        Piece { start: -3.0, value: 9.0, ..Piece::default() },
        steady,
        Piece { start: 0.75, value: 1.5, slope: -2.0, ..Piece::default() },
        Piece { start: 1.5, ..Piece::default() },
    ]);
    let whole = force.integral().unwrap();
    assert!(whole.value(0.0).abs() < 1e-15);
    assert_eq!(whole.pieces().len(), 3);
    assert!(whole.jumps().next().is_none());
    for k in 0..200 {
        let t = 0.01 * f64::from(k) + 0.003;
        let [rate, value] = [whole.piece_at(t).derivative(1, t), force.value(t)];
        assert!((rate - value).abs() < 1e-14, "{t}: {rate} {value}");
    }
    // 1.5 s − s² over 0.75, from a state that the sine and the parabola leave.
    let rest = whole.value(1.5) - whole.value(0.75);
    assert!((rest - 0.5625).abs() < 1e-14);
    assert!((whole.value(9.0) - whole.value(1.5)).abs() < 1e-15);
}

#[test]
fn what_no_piece_can_hold_has_no_integral() {
    let chirp = Piece { sine: 1.0, omega: 1.0, sweep: 1.0, ..Piece::default() };
    assert_eq!(waveform(&[chirp]).integral(), None);
    let cubic = Piece { jerk: 1.0, ..Piece::default() };
    assert_eq!(waveform(&[cubic]).integral(), None);
    let parabola = waveform(&[Piece { curvature: 1.0, ..Piece::default() }]);
    assert_eq!(parabola.integral().unwrap(), waveform(&[cubic]));
    let huge = Piece { value: 1e300, ..Piece::default() };
    let later = Piece { start: 1e300, ..huge };
    assert_eq!(waveform(&[huge, later]).integral(), None);
}

#[test]
fn a_jump_is_told_from_rounding() {
    // A hundred thousand rows, each as long as the rounding of its time is not short against.
    let row = |k: i32| {
        let (start, step) = (1e-3 * f64::from(k), 1e-3 * f64::from(k + 1) - 1e-3 * f64::from(k));
        let value = |k: i32| f64::from(k % 7) - 3.0;
        Piece {
            start,
            value: value(k),
            slope: (value(k + 1) - value(k)) / step,
            ..Piece::default()
        }
    };
    let saw = waveform(&(0..100_000).map(row).collect::<Vec<_>>());
    for (time, value) in [(1.0, 1.0), (0.013, 3.7)] {
        let own = saw.in_units(time, value);
        assert!(own.jumps().next().is_none());
    }
    let step = waveform(&[
        Piece { slope: 1.0, curvature: -2.0, ..Piece::default() },
        Piece { start: 1.0, value: 1e-9, ..Piece::default() },
    ]);
    assert!(step.jumps().all(|(t, jump)| (t - 1.0).abs() < 1e-15 && (jump - 1e-9).abs() < 1e-15));
    assert_eq!(step.jumps().count(), 1);
    // Parts that cancel leave nothing but their rounding.
    let back = Piece { slope: 0.1, curvature: -0.2 / 0.7, ..Piece::default() };
    let rest = Piece { start: 0.7, ..Piece::default() };
    assert!(waveform(&[back, rest]).jumps().next().is_none());
}
