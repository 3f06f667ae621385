#![expect(clippy::float_cmp, reason = "what is exact is asserted as exact")]

use std::f64::consts::PI;

use dashpot_numerics::chebyshev::{Coefficients, Interpolation};

use super::*;

const EVERYWHERE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

fn panel(start: f64, end: f64, degree: usize, f: impl Fn(f64) -> f64) -> Panel {
    let interpolation = Interpolation::of_degree(degree);
    let mut panel = Panel { start, end, coefficients: Coefficients::zeros(degree + 1) };
    let values: Vec<f64> = interpolation.nodes().iter().map(|&x| f(panel.time(x))).collect();
    interpolation.coefficients(&values, &mut panel.coefficients);
    panel
}

/// A signal that interpolates `f` between neighbouring borders.
fn signal(borders: &[f64], degree: usize, f: impl Fn(f64) -> f64) -> Signal {
    let panels = borders.windows(2).map(|pair| panel(pair[0], pair[1], degree, &f)).collect();
    Signal::new(panels, None, 0.0)
}

/// Borders from 0 to `end` whose distances change from panel to panel.
fn uneven(end: f64, longest: f64) -> Vec<f64> {
    let mut borders = vec![0.0];
    let mut t = 0.0;
    for k in 0_u32.. {
        t += longest * (0.2 + 0.8 * f64::from(k).sin().abs());
        borders.push(t.min(end));
        if t >= end {
            break;
        }
    }
    borders
}

struct Numbers(u64);

impl Numbers {
    /// A number in `[−1, 1]` (Knuth's MMIX constants).
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        f64::from((self.0 >> 32) as u32) / f64::from(u32::MAX / 2) - 1.0
    }

    fn signal(&mut self, panels: usize, degree: usize) -> Signal {
        let mut start = 0.0;
        let mut make = || {
            let end = start + 1e-3 + self.next().abs();
            let coefficients = (0..=degree).map(|_| self.next()).collect();
            let panel = Panel { start, end, coefficients };
            start = end;
            panel
        };
        Signal::new((0..panels).map(|_| make()).collect(), None, 1e-14)
    }
}

#[test]
fn empty_signal_is_zero() {
    let signal = Signal::new(Vec::new(), None, 0.0);
    assert_eq!(signal.value(1.0), 0.0);
    assert_eq!(signal.integral(EVERYWHERE), 0.0);
    assert!(signal.crossings(0.0, EVERYWHERE).is_empty());
    assert_eq!(signal.extrema(EVERYWHERE).len(), 1);
}

#[test]
fn values_are_from_the_right_but_at_the_end() {
    let steps = Signal::new(
        vec![Panel::constant(0.0, 1.0, 1.0), Panel::constant(1.0, 2.0, 2.0)],
        None,
        0.0,
    );
    assert_eq!(steps.sample(&[-1.0, 0.0, 0.5, 1.0, 2.0, 3.0]), [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    assert_eq!(
        (steps.left_value(1.0), steps.left_value(0.0), steps.left_value(9.0)),
        (1.0, 1.0, 2.0)
    );
    assert_eq!((steps.start(), steps.end(), steps.panel_at(1.0)), (0.0, 2.0, 1));
}

#[test]
fn no_zero_of_the_sine_is_missed() {
    for (degree, longest, accuracy) in [(16, 2.0, 1e-14), (12, 1.0, 1e-14), (5, 0.05, 1e-11)] {
        let sine = signal(&uneven(50.0, longest), degree, f64::sin);
        let found = sine.crossings(0.0, (0.0, 50.0));
        assert_eq!(found.len(), 15, "degree {degree}");
        for (k, crossing) in (1_u32..).zip(&found) {
            assert!((crossing.time - f64::from(k) * PI).abs() < accuracy * 50.0);
            assert_eq!(crossing.rising, Some(k % 2 == 0));
            assert!((crossing.slope.abs() - 1.0).abs() < 1e-7);
        }
        let first = sine.first_crossing(0.0, (0.0, 50.0), Some(true));
        assert!((first.unwrap().time - 2.0 * PI).abs() < accuracy * 50.0);
        assert_eq!(sine.first_crossing(0.0, (0.0, 50.0), None), found.first().copied());
    }
}

#[test]
fn zeros_at_borders_are_found_once() {
    let borders: Vec<f64> = (0..=10_u32).map(|k| f64::from(k) * PI).collect();
    let sine = signal(&borders, 18, f64::sin);
    let found = sine.crossings(0.0, EVERYWHERE);
    assert_eq!(found.len(), 9, "{found:?}");
    for (k, crossing) in (1_u32..).zip(&found) {
        assert!((crossing.time - f64::from(k) * PI).abs() < 1e-13);
        assert_eq!(crossing.rising, Some(k % 2 == 0));
    }
    // A border a little before or after the zero, and jumps of the noise's size.
    for shift in [-1e-13, -1e-16, 0.0, 1e-16, 1e-13] {
        for jump in [-1e-12, 0.0, 1e-12] {
            let mut line = signal(&[0.0, 1.0 + shift, 2.0], 1, |t| t - 1.0);
            line.noise = 1e-11;
            line.panels[1].coefficients[0] += jump;
            let found = line.crossings(0.0, EVERYWHERE);
            assert_eq!(found.len(), 1, "{shift} {jump} {found:?}");
            assert!((found[0].time - 1.0).abs() < 2e-12 && found[0].rising == Some(true));
        }
    }
}

#[test]
fn touches_are_told_from_passages() {
    for borders in [&[0.0, 3.0][..], &[0.0, 1.0, 3.0], &[0.0, 0.7, 1.1, 3.0]] {
        let double = signal(borders, 4, |t| (t - 1.0) * (t - 1.0) * (t + 1.0));
        let found = double.crossings(0.0, EVERYWHERE);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].rising, None);
        assert!((found[0].time - 1.0).abs() < 1e-7 && found[0].slope.abs() < 1e-6);
        assert!(double.first_crossing(0.0, EVERYWHERE, Some(true)).is_none());

        let triple = signal(borders, 4, |t| (t - 1.0).powi(3));
        let found = triple.crossings(0.0, EVERYWHERE);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].time - 1.0).abs() < 1e-4 && found[0].rising == Some(true));
    }
    let close = signal(&[0.0, 3.0], 2, |t| (t - 1.0) * (t - 1.0) - 1e-10);
    assert_eq!(close.crossings(0.0, EVERYWHERE).len(), 2);
}

#[test]
fn known_zeros_of_a_polynomial_are_found() {
    let zeros = [0.1, 0.100_001, 0.5, 0.73, 0.999];
    let product = |t: f64| zeros.iter().map(|zero| t - zero).product::<f64>();
    let polynomial = signal(&[0.0, 1.0], 5, product);
    let found = polynomial.crossings(0.0, EVERYWHERE);
    assert_eq!(found.len(), zeros.len());
    for (crossing, zero) in found.iter().zip(zeros) {
        let accuracy = 1e-16 / crossing.slope.abs() + 1e-15;
        assert!((crossing.time - zero).abs() < accuracy, "{crossing:?} {zero}");
    }
}

#[test]
fn jumps_through_the_level_count() {
    let steps: Vec<Panel> = [1.0, -1.0, -1.0, 2.0, 0.0, 0.0, -3.0, 0.0, -1.0]
        .iter()
        .zip(0_u32..)
        .map(|(&value, k)| Panel::constant(f64::from(k), f64::from(k + 1), value))
        .collect();
    let steps = Signal::new(steps, None, 1e-12);
    let found = steps.crossings(0.0, EVERYWHERE);
    let found: Vec<_> = found.iter().map(|crossing| (crossing.time, crossing.rising)).collect();
    assert_eq!(found, [(1.0, Some(false)), (3.0, Some(true)), (6.0, Some(false))]);
    // A jump at the border of two windows belongs to the first one.
    assert_eq!(steps.crossings(0.0, (0.0, 1.0)).len(), 1);
    assert_eq!(steps.crossings(0.0, (1.0, 2.0)).len(), 0);
}

#[test]
fn beginning_resting_and_ending_on_the_level_is_no_crossing() {
    let ramp = signal(&[0.0, 1.0, 2.0], 2, |t| t * (2.0 - t));
    assert!(ramp.crossings(0.0, EVERYWHERE).is_empty());
    assert!(ramp.crossings(1.0, (0.0, 1.0)).is_empty());
    assert_eq!(ramp.crossings(1.0, EVERYWHERE)[0].rising, None);
    let mut stop = vec![panel(0.0, 1.0, 2, |t| (1.0 - t) * (1.0 - t))];
    stop.push(Panel::constant(1.0, 2.0, 1e-17));
    stop.push(Panel::constant(2.0, 3.0, -1e-17));
    assert!(Signal::new(stop.clone(), None, 1e-15).crossings(0.0, EVERYWHERE).is_empty());
    let mut back = stop.clone();
    back.push(panel(3.0, 4.0, 1, |t| t - 3.0));
    assert!(Signal::new(back, None, 1e-15).crossings(0.0, EVERYWHERE).is_empty());
    stop.push(panel(3.0, 4.0, 1, |t| 3.0 - t));
    let through = Signal::new(stop, None, 1e-15).crossings(0.0, EVERYWHERE);
    assert_eq!((through.len(), through[0].time, through[0].rising), (1, 3.0, Some(false)));
}

#[test]
fn departure_is_decided_by_the_first_derivative_that_counts() {
    let noisy = |f: fn(f64) -> f64| {
        let mut signal = signal(&[0.0, 1.0, 2.0], 6, f);
        signal.noise = 1e-13;
        signal
    };
    assert_eq!(noisy(|t| 1e-15 + t).departure(0.0, 0.0), Some(true));
    assert_eq!(noisy(|t| 1e-14 - t * t).departure(0.0, 0.0), Some(false));
    assert_eq!(noisy(|t| t.powi(3)).departure(0.0, 0.0), Some(true));
    assert_eq!(noisy(|t| (t - 1.0).powi(4) - 1e-15).departure(0.0, 1.0), Some(true));
    assert_eq!(noisy(|t| (1.0 - t).powi(3)).departure(0.0, 1.0), Some(false));
    assert_eq!(noisy(|t| (1.0 - t).powi(3)).departure(0.0, 0.0), Some(true));
    assert_eq!(noisy(|_| 1e-15).departure(0.0, 0.0), None);
    assert_eq!(noisy(|t| t).departure(1.0, 0.0), Some(false));
    let mut late = vec![Panel::constant(0.0, 1.0, 0.0)];
    late.push(panel(1.0, 2.0, 2, |t| -(t - 1.0) * (t - 1.0)));
    assert_eq!(Signal::new(late, None, 0.0).departure(0.0, 0.0), Some(false));
}

#[test]
fn a_narrow_peak_is_found() {
    let width = 1e-4;
    let mut borders: Vec<f64> = (0..=10_u32).map(f64::from).collect();
    borders.extend((0..=40_u32).map(|k| 3.3 + width * (f64::from(k) / 2.0 - 10.0)));
    borders.sort_by(f64::total_cmp);
    let peak = |t: f64| (-((t - 3.3) / width).powi(2)).exp() + 1e-3 * t;
    let signal = signal(&borders, 14, peak);
    let top = signal.maximum(EVERYWHERE);
    assert!((top.time - 3.3).abs() < 1e-3 * width && (top.value - 1.0033).abs() < 1e-9);
    assert_eq!(signal.crossings(0.5, EVERYWHERE).len(), 2);
    assert!(signal.minimum((1.0, 9.0)).time == 1.0);
}

#[test]
fn the_global_maximum_jumps_between_nearly_equal_peaks() {
    // Two equal peaks, tilted a little to one side or the other.
    for (tilt, place) in [(1e-12, 3.0 * PI / 2.0), (-1e-12, PI / 2.0)] {
        let signal = signal(&uneven(2.0 * PI, 0.3), 14, |t| t.sin().powi(2) + tilt * t);
        let top = signal.maximum(EVERYWHERE);
        assert!((top.time - place).abs() < 1e-6, "{top:?}");
        assert!((top.value - 1.0 - tilt * place).abs() < 1e-14);
    }
}

#[test]
fn of_maxima_that_are_equal_but_for_rounding_the_first_counts() {
    let above = 1.0 + 4.0 * f64::EPSILON;
    let plateau = |t: f64| if t < 2.0 { 1.0 } else { above };
    let held = Signal::new(
        vec![panel(0.0, 1.0, 1, |t| t), panel(1.0, 2.0, 1, plateau), panel(2.0, 3.0, 0, |_| above)],
        None,
        0.0,
    );
    assert_eq!(held.maximum(EVERYWHERE), Extremum { time: 1.0, value: above });
    let wave = signal(&uneven(40.0, 0.7), 16, f64::sin);
    assert!((wave.maximum(EVERYWHERE).time - 0.5 * PI).abs() < 1e-6);
    assert!((wave.minimum(EVERYWHERE).time - 1.5 * PI).abs() < 1e-6);
}

#[test]
fn extrema_at_jumps_ends_and_ties_count() {
    let saw = signal(&[0.0, 1.0, 2.0, 3.0], 1, |t| t);
    let mut saw = saw;
    for (panel, k) in saw.panels.iter_mut().zip(0_u32..) {
        panel.coefficients[0] -= f64::from(k);
    }
    assert_eq!(saw.maximum(EVERYWHERE), Extremum { time: 1.0, value: 1.0 });
    assert_eq!(saw.minimum((0.5, 3.0)), Extremum { time: 1.0, value: 0.0 });
    assert_eq!(saw.maximum((1.0, 1.0)), Extremum { time: 1.0, value: 0.0 });
    assert_eq!(saw.maximum((7.0, 9.0)), Extremum { time: 3.0, value: 1.0 });
    let flipped = saw.scaled(-2.0);
    assert_eq!(flipped.absolute_maximum(EVERYWHERE), Extremum { time: 1.0, value: 2.0 });
    let turns: Vec<f64> = saw.extrema(EVERYWHERE).iter().map(|turn| turn.value).collect();
    assert_eq!(turns, [0.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
}

#[test]
fn local_extrema_of_the_sine_are_found_once() {
    let sine = signal(&uneven(50.0, 1.5), 14, f64::sin);
    let turns = sine.extrema((0.0, 50.0));
    assert_eq!(turns.len(), 18);
    for (k, turn) in (0_u32..).zip(&turns[1..17]) {
        assert!((turn.time - PI * (f64::from(k) + 0.5)).abs() < 1e-7);
        assert!((turn.value.abs() - 1.0).abs() < 1e-14);
    }
    assert_eq!((turns[0].time, turns[17].time), (0.0, 50.0));
}

#[test]
fn integrals_agree_with_closed_forms() {
    let sine = signal(&uneven(50.0, 1.0), 14, f64::sin);
    let area = sine.integral((0.3, 47.1));
    assert!((area - (0.3_f64.cos() - 47.1_f64.cos())).abs() < 1e-13);
    let square = sine.integral_of_product(&sine, (0.0, 50.0));
    assert!((square - (25.0 - 100.0_f64.sin() / 4.0)).abs() < 1e-12);
    let slope = sine.derivative();
    let work = sine.integral_of_product(&slope, (0.0, 50.0));
    assert!((work - 0.5 * 50.0_f64.sin().powi(2)).abs() < 1e-11);
    let sum = sine.plus(&signal(&uneven(50.0, 0.7), 14, f64::cos), 2.0);
    assert!(
        (sum.integral(EVERYWHERE) - (1.0 - 50.0_f64.cos() + 2.0 * 50.0_f64.sin())).abs() < 1e-12
    );
    assert!((sum.value(17.0) - (17.0_f64.sin() + 2.0 * 17.0_f64.cos())).abs() < 1e-13);
    assert!((1.0..1.5).contains(&sine.bound()));
}

#[test]
fn powers_are_integrated_through_their_zeros() {
    // ∫ |sin|^2.5 over a period = 2 B(7/4, 1/2).
    let exact = 2.875_536_563_365_421_6;
    for (degree, longest) in [(16, 1.0), (12, 0.4)] {
        let sine = signal(&uneven(2.0 * PI, longest), degree, f64::sin);
        let severity = sine.integral_of(EVERYWHERE, &[0.0], |a| a.abs().powf(2.5));
        assert!((severity / exact - 1.0).abs() < 1e-13, "{severity}");
    }
    let ramp = signal(&[0.0, 0.3, 2.0], 1, |t| t - 1.0);
    let half = ramp.integral_of(EVERYWHERE, &[0.0], |s| s.abs().sqrt());
    assert!((half - 4.0 / 3.0).abs() < 1e-13);
    let over = ramp.integral_of(EVERYWHERE, &[0.5], |s| (s - 0.5).max(0.0));
    assert!((over - 0.125).abs() < 1e-15);
    let sine = signal(&uneven(9.5 * PI, 2.0), 16, f64::sin);
    assert!((sine.absolute_integral(EVERYWHERE) - 19.0).abs() < 1e-13);
    assert!((19.0..1.4 * 19.0).contains(&sine.area_bound(EVERYWHERE)));
    let cubed = ramp.integral_of((0.0, 1.5), &[], |s| s * s * s);
    assert!((cubed - (0.0625 - 1.0) / 4.0).abs() < 1e-15);
}

#[test]
fn zero_length_and_outside_windows_are_empty() {
    let sine = signal(&uneven(5.0, 1.0), 12, f64::sin);
    for window in [(2.0, 2.0), (6.0, 7.0), (3.0, 2.0), (-2.0, -1.0)] {
        assert_eq!(sine.integral(window), 0.0);
        assert_eq!(sine.absolute_integral(window), 0.0);
        assert_eq!(sine.area_bound(window), 0.0);
        assert_eq!(sine.integral_of_product(&sine, window), 0.0);
        assert!(sine.crossings(0.0, window).is_empty());
        assert!(sine.maximum(window).value.is_finite());
        assert!(sine.extrema(window).len() <= 1);
    }
    let point = Signal::new(vec![panel(1.0, 1.0, 3, f64::sin)], None, 0.0);
    assert!((point.maximum(EVERYWHERE).value - 1.0_f64.sin()).abs() < 1e-15);
    assert_eq!(point.derivative().value(1.0), 0.0);
    assert_eq!(point.plus(&point, 1.0).value(1.0), 2.0 * point.value(1.0));
}

#[test]
fn slopes_of_panels_that_are_too_short_to_have_one_are_those_beside_them() {
    // A motion of 12 m/s that turns, with panels of a few roundings of the time where it does not stop.
    let motion = |t: f64| 0.03 + 12.0 * (t - 3e-3) - 2e3 * (t - 3e-3).powi(2);
    let mut borders = vec![0.0, 1e-3, 3e-3];
    let mut at = 3e-3_f64;
    for length in [1.0, 1.0, 3.0, 40.0, 1e3, 1e5] {
        at += length * f64::EPSILON * 4e-3;
        borders.push(at);
    }
    borders.extend([4e-3, 6e-3]);
    for degree in 1..6 {
        let signal = signal(&borders, degree.max(2), motion);
        let slope = signal.derivative();
        for t in [0.0, 5e-4, 3e-3, borders[3], borders[4], borders[5], at, 5e-3] {
            let expected = 12.0 - 4e3 * (t - 3e-3);
            assert!((slope.value(t) - expected).abs() < 0.02, "{degree}: {t}: {}", slope.value(t));
        }
        assert!((slope.maximum(EVERYWHERE).value - 24.0).abs() < 1e-9, "{degree}");
    }
    // A rest is known however long, and so is what moves late.
    let late = signal(&[0.0, 1e9, 1e9 + 1e-5, 1e9 + 2e-3], 2, |t| (t - 1e9).max(0.0));
    let slope = late.derivative();
    assert_eq!(slope.value(5e8), 0.0);
    assert!((slope.value(1e9 + 1e-3) - 1.0).abs() < 0.02, "{}", slope.value(1e9 + 1e-3));
}

#[test]
fn a_step_of_a_few_roundings_of_the_time_has_no_slope_of_its_own() {
    // 12 m/s in steps of 3, 30, … roundings of the time, taken for one more or less than they are.
    let ulp = 0.03_f64.next_up() - 0.03;
    for more in [-1.0, 1.0] {
        let mut borders = vec![0.0, 0.01, 0.03];
        let mut values = vec![0.0, 0.12, 0.36];
        let (mut at, mut value) = (0.03, 0.36);
        for length in [3.0, 30.0, 300.0, 3e5] {
            at += (length + more) * ulp;
            value += 12.0 * length * ulp;
            borders.push(at);
            values.push(value);
        }
        borders.push(0.04);
        values.push(value + 12.0 * (0.04 - at));
        let pairs = borders.windows(2).zip(values.windows(2));
        let line = |(time, value): (&[f64], &[f64])| Panel {
            start: time[0],
            end: time[1],
            coefficients: [0.5 * (value[0] + value[1]), 0.5 * (value[1] - value[0])].into(),
        };
        let slope = Signal::new(pairs.map(line).collect(), None, 0.0).derivative();
        for extreme in [slope.maximum(EVERYWHERE), slope.minimum(EVERYWHERE)] {
            assert!((extreme.value - 12.0).abs() < 1e-3, "{more}: {extreme:?}");
        }
    }
    // What roundings do not account for stays, however late.
    let borders = [0.0, 1.0, 1e9, 1e9 + 1e-5, 1e9 + 2e-5, 1e9 + 3e-5, 1e9 + 1e-3];
    let late = signal(&borders, 2, |t| 1e3 * (t - 1e9 - 2e-5).abs().min(1e-5));
    let slope = late.derivative();
    assert!((slope.value(1e9 + 2.5e-5) - 1e3).abs() < 50.0, "{}", slope.value(1e9 + 2.5e-5));
}

#[test]
fn denormal_panels_do_no_harm() {
    let borders = [0.0, 5e-324, 1e-320, 1e-300, 1e-15, 0.5, 0.5, 2.0];
    let line = signal(&borders, 3, |t| t - 1.0);
    assert_eq!(line.crossings(0.0, EVERYWHERE).len(), 1);
    assert!((line.integral(EVERYWHERE)).abs() < 1e-15);
    assert!((line.absolute_integral(EVERYWHERE) - 1.0).abs() < 1e-14);
    assert_eq!(line.maximum(EVERYWHERE), Extremum { time: 2.0, value: line.value(2.0) });
    let slope = line.derivative();
    assert!(slope.panels.iter().all(|panel| panel.coefficients.iter().all(|c| c.is_finite())));
    assert!((slope.value(1.0) - 1.0).abs() < 1e-14);
    assert!((line.plus(&line, -1.0).bound()).abs() < 1e-15);
}

#[test]
fn random_signals_keep_their_promises() {
    let mut numbers = Numbers(7);
    for round in 0..300 {
        let signal = numbers.signal(1 + round % 5, round % 20);
        let span = signal.end() - signal.start();
        let from = signal.start() + span * 0.3 * numbers.next().abs();
        let to = signal.end() - span * 0.3 * numbers.next().abs();
        let times: Vec<f64> =
            (0..=4000_u32).map(|i| from + (to - from) * f64::from(i) / 4000.0).collect();
        let values = signal.sample(&times);
        let level = 0.5 * numbers.next();
        let found = signal.crossings(level, (from, to));

        let changes = values.windows(2).filter(|v| (v[0] < level) != (v[1] < level)).count();
        let passages = found.iter().filter(|crossing| crossing.rising.is_some()).count();
        assert!(
            passages >= changes && (passages - changes).is_multiple_of(2),
            "{round}: {found:?}"
        );
        assert!(found.windows(2).all(|pair| pair[0].time <= pair[1].time));
        // Passages go up and down in turn, beginning from the side of the start.
        let mut above = signal.value(from) > level;
        for crossing in found.iter().filter(|crossing| crossing.rising.is_some()) {
            above = !above;
            assert_eq!(crossing.rising, Some(above));
            let (left, right) = (signal.left_value(crossing.time), signal.value(crossing.time));
            let accuracy = 1e-12 + 4e-15 * crossing.slope.abs();
            let near = |value: f64| (value - level).abs() < accuracy;
            assert!(near(left) || near(right) || (left < level) != (right < level));
        }

        let (top, bottom) = (signal.maximum((from, to)), signal.minimum((from, to)));
        let rounding = 1e-13;
        assert!(values.iter().all(|&v| v <= top.value + rounding && v >= bottom.value - rounding));
        let turns = signal.extrema((from, to));
        let most = turns.iter().map(|turn| turn.value).fold(f64::NEG_INFINITY, f64::max);
        assert!((most - top.value).abs() < rounding);
        assert_eq!(
            signal.absolute_maximum((from, to)).value,
            top.value.abs().max(bottom.value.abs())
        );
        assert!(turns.windows(2).all(|pair| pair[0].time <= pair[1].time));

        let area = signal.integral((from, to));
        let pieces =
            signal.integral((from, 0.5 * (from + to))) + signal.integral((0.5 * (from + to), to));
        assert!((area - pieces).abs() < 1e-13 * span * 20.0);
        let by_rule = signal.integral_of((from, to), &[], |s| s);
        assert!((area - by_rule).abs() < 1e-12 * span);
        let both_sides = signal.integral_of((from, to), &[0.0], f64::abs);
        assert!((signal.absolute_integral((from, to)) - both_sides).abs() < 1e-12 * span);
        assert!(signal.area_bound((from, to)) >= both_sides - 1e-12 * span);
        let square = signal.integral_of((from, to), &[0.0], |s| s * s);
        let product = signal.integral_of_product(&signal, (from, to));
        assert!((square - product).abs() < 1e-12 * product, "{square} {product}");
    }
}

#[test]
fn integrands_made_of_noise_do_not_cost_more() {
    let mut numbers = Numbers(11);
    let mut noisy = numbers.signal(2000, 12);
    for panel in &mut noisy.panels {
        panel.coefficients.iter_mut().for_each(|c| *c *= 1e-16);
        panel.coefficients[0] += 1.0;
    }
    let over = noisy.integral_of(EVERYWHERE, &[1.0], |s| (s - 1.0).max(0.0).sqrt());
    assert!((0.0..1e-7 * noisy.end()).contains(&over));
    // An undeclared jump costs accuracy, not time without end.
    let ramp = signal(&[0.0, 1.0], 1, |t| t);
    let step = ramp.integral_of(EVERYWHERE, &[], |s| if s > 0.3 { 1.0 } else { 0.0 });
    assert!((step - 0.7).abs() < 1e-9);
}

#[test]
fn jumps_between_steps_within_the_noise_make_no_crossings() {
    let mut numbers = Numbers(13);
    let mut rough = signal(&uneven(50.0, 0.02), 3, f64::sin);
    for panel in &mut rough.panels {
        panel.coefficients[0] += 1e-9 * numbers.next();
    }
    rough.noise = 3e-9;
    let found = rough.crossings(0.0, EVERYWHERE);
    assert_eq!(found.len(), 15);
    assert_eq!(rough.extrema(EVERYWHERE).len(), 18);
    for (k, crossing) in (1_u32..).zip(&found) {
        assert!((crossing.time - f64::from(k) * PI).abs() < 5e-9);
        assert_eq!(crossing.rising, Some(k % 2 == 0));
    }
}

#[test]
fn long_runs_are_searched_panel_by_panel() {
    let borders: Vec<f64> = (0..=200_000_u32).map(|k| f64::from(k) * 5e-4).collect();
    let wave = |t: f64| t.sin() * (-0.01 * t).exp();
    let run = signal(&borders, 5, wave);
    assert_eq!(run.crossings(0.0, EVERYWHERE).len(), 31);
    assert_eq!(run.extrema(EVERYWHERE).len(), 34);
    let top = run.maximum(EVERYWHERE);
    // The slope of the wave is zero where tan t = 100.
    assert!((top.time - 100.0_f64.atan()).abs() < 1e-8);
    assert!((top.value - wave(100.0_f64.atan())).abs() < 1e-14);
    let rotated = |t: f64| (-0.01 * t).exp() * (t.cos() + 0.01 * t.sin()) / 1.0001;
    assert!((run.integral(EVERYWHERE) - rotated(0.0) + rotated(100.0)).abs() < 1e-13);
}
