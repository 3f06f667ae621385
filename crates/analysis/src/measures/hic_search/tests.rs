use std::f64::consts::PI;

use dashpot_dae::Panel;

use super::*;
use crate::measures::tests::panels;

mod near_equal;

fn signal(end: f64, count: u32, function: impl Fn(f64) -> f64) -> Signal {
    Signal::new(panels(end, count, function), None, 1e-14)
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}

#[test]
fn half_sine_has_its_closed_form() {
    for panels in [1, 3, 16] {
        let pulse = signal(2.0, panels, |t| 5.0 * (PI * t / 2.0).sin());
        let found = optimum(&pulse, (0.0, 2.0), 1e9);
        let unit = 5.0_f64.powf(2.5) * 2.0;
        close(found.value / unit, 0.414_645_65, 1e-8);
        close((found.interval.1 - found.interval.0) / 2.0, 0.670_229_7, 1e-7);
        assert!(found.threshold <= 0.0);
    }
}

#[test]
fn haversine_has_its_closed_form() {
    let pulse = signal(1.0, 4, |t| (PI * t).sin().powi(2));
    let found = optimum(&pulse, (0.0, 1.0), 1e9);
    close(found.value, 0.302_939, 1e-6);
    close(found.interval.1 - found.interval.0, 0.507_59, 1e-5);
}

#[test]
fn triangle_has_its_closed_form() {
    let pulse = signal(1.0, 2, |t| 1.0 - (2.0 * t - 1.0).abs());
    let found = optimum(&pulse, (0.0, 1.0), 1e9);
    close(found.value, 0.246_401, 1e-6);
    close(found.interval.1 - found.interval.0, 4.0 / 7.0, 1e-7);
}

#[test]
fn rectangle_is_its_own_interval() {
    let piece = |start, end, value| Panel::constant(start, end, value);
    let panels = vec![piece(0.0, 1.0, 0.0), piece(1.0, 2.0, -4.0), piece(2.0, 3.0, 0.0)];
    let pulse = Signal::new(panels, None, 0.0);
    let found = optimum(&pulse, (0.0, 3.0), 1e9);
    close(found.value, 32.0, 1e-12);
    assert_eq!(found.interval, (1.0, 2.0));
    let capped = optimum(&pulse, (0.0, 3.0), 0.5);
    close(capped.value, 16.0, 1e-12);
}

#[test]
fn zero_signal_has_none() {
    let found =
        optimum(&Signal::new(vec![Panel::constant(0.0, 1.0, 0.0)], None, 0.0), (0.0, 1.0), 1e9);
    close(found.value, 0.0, 0.0);
    let empty = optimum(&signal(1.0, 1, |_| 1.0), (0.5, 0.5), 1e9);
    close(empty.value, 0.0, 0.0);
}

#[test]
fn capped_interval_has_equal_ends() {
    let pulse = signal(2.0, 5, |t| t * t * (2.0 - t));
    let found = optimum(&pulse, (0.0, 2.0), 0.3);
    let (from, to) = found.interval;
    close(to - from, 0.3, 1e-15);
    close(pulse.value(from), pulse.value(to), 1e-6);
}

#[test]
fn best_of_many_peaks_is_found() {
    // Two pulses, the later one better; a grid over all intervals is the judge.
    let function = |t: f64| (8.0 * t).sin().powi(2) * (1.0 + 0.3 * t) + 0.2 * (31.0 * t).cos();
    let pulse = signal(1.5, 24, function);
    for cap in [0.05, 0.2, 0.7, 10.0] {
        let found = optimum(&pulse, (0.0, 1.5), cap);
        let steps = 600_u32;
        let area = Area::new(&pulse, (0.0, 1.5)).in_sense(Sense::Along(1.0));
        let mut best = 0.0_f64;
        for i in 0..steps {
            for j in i + 1..=steps {
                let (from, to) =
                    (1.5 * f64::from(i) / f64::from(steps), 1.5 * f64::from(j) / f64::from(steps));
                if to - from <= cap {
                    best = best.max(criterion(area.between(from, to), to - from));
                }
            }
        }
        assert!(found.value >= best * (1.0 - 1e-12), "{} < {best}", found.value);
        assert!(found.value <= best * 1.01, "{} > {best}", found.value);
        assert!(found.interval.1 - found.interval.0 <= cap * (1.0 + 1e-12));
        assert!(found.threshold <= 0.0, "cap {cap}: {}", found.threshold);
    }
}

fn steps(pieces: &[(f64, f64)]) -> Signal {
    let mut start = 0.0;
    let panel = |&(length, height): &(f64, f64)| {
        let panel = Panel::constant(start, start + length, height);
        start += length;
        panel
    };
    Signal::new(pieces.iter().map(panel).collect(), None, 0.0)
}

#[test]
fn caps_beyond_a_pulse_do_not_matter() {
    let pulse = steps(&[(1.0, 3.0), (1.0, 0.0)]);
    for cap in [1.0, 1.5, 2.0, 1e6] {
        let found = optimum(&pulse, (0.0, 2.0), cap);
        close(found.value, 3.0_f64.powf(2.5), 1e-13 * found.value);
        assert_eq!(found.interval, (0.0, 1.0));
    }
}

#[test]
fn windows_span_two_peaks_where_that_is_worth_it() {
    // Two plateaus of 0.5 s with a gap between them: together they have the mean 1/(1 + gap).
    let both = |gap: f64| (1.0 + gap).powf(-1.5);
    let near = steps(&[(0.5, 1.0), (0.25, 0.0), (0.5, 1.0), (0.75, 0.0)]);
    let found = optimum(&near, (0.0, 2.0), 1e6);
    close(found.value, both(0.25), 1e-13);
    assert_eq!(found.interval, (0.0, 1.25));
    assert_eq!(optimum_of_magnitude(&near, (0.0, 2.0), 1e6), None);
    // A plateau of the other sign takes from the mean, and adds to that of the magnitude.
    let turned = steps(&[(0.5, -1.0), (0.25, 0.0), (0.5, 1.0), (0.75, 0.0)]);
    close(optimum(&turned, (0.0, 2.0), 1e6).value, 0.5, 1e-13);
    close(optimum_of_magnitude(&turned, (0.0, 2.0), 1e6).unwrap().value, both(0.25), 1e-13);
    // A window of 1 s has 0.75 s of it loaded, which is worth less than one plateau.
    close(optimum(&near, (0.0, 2.0), 1.0).value, 0.5, 1e-13);
    let far = steps(&[(0.5, 1.0), (1.0, 0.0), (0.5, 1.0)]);
    close(optimum(&far, (0.0, 2.0), 1e6).value, 0.5, 1e-13);
    // Where both are worth the same, either will do: (1 + gap)^-1.5 = 0.5.
    let even = 4.0_f64.cbrt() - 1.0;
    let found = optimum(&steps(&[(0.5, 1.0), (even, 0.0), (0.5, 1.0)]), (0.0, 1.0 + even), 1e6);
    close(found.value, 0.5, 1e-13);
}

#[test]
fn a_pulse_in_thousands_of_pieces_has_the_interval_that_it_has_in_one() {
    // A half-sine of 3000 straight lines with a rounding step between any two, so that each is a knot.
    let sides = 3000_u32;
    let panels = (0..sides).map(|at| {
        let [start, end] = [at, at + 1].map(|at| f64::from(at) / f64::from(sides));
        let [from, to] = [start, end].map(|t| (PI * t).sin() * (1.0 + 1e-9 * f64::from(at % 2)));
        Panel { start, end, coefficients: [0.5 * (from + to), 0.5 * (to - from)].into() }
    });
    let found = optimum(&Signal::new(panels.collect(), None, 0.0), (0.0, 1.0), 1e6);
    // Straight lines lie below the sine by up to (π/n)²/8 of it.
    close(found.value, 0.414_645_65, 1e-6);
    close(found.interval.1 - found.interval.0, 0.670_229_7, 1e-3);
    assert!(found.threshold < 1e-6, "{}", found.threshold);
}

#[test]
fn the_level_of_a_single_hump_and_the_search_through_all_intervals_agree() {
    // Half sines, bells, and humps that lean, cut at their feet or not, with caps that hold and that do not.
    type Hump = (&'static str, fn(f64) -> f64);
    let humps: [Hump; 7] = [
        ("half sine", |t| (PI * t).sin()),
        ("leaning", |t| t * (1.0 - t) * (-3.0 * t).exp()),
        ("bell", |t| (-20.0 * (t - 0.4).powi(2)).exp()),
        ("upon a step", |t| 0.5 + (PI * t).sin()),
        ("falling", |t| (-2.0 * t).exp()),
        ("rising", |t| t * (3.0 - t)),
        ("steep at first", |t| (1.0 - t) * (1.0 + t) + 0.3 * (2.0 * t).sin()),
    ];
    for (name, hump) in humps {
        let pulse = signal(1.0, 7, hump);
        for cap in [1e9, 0.9, 0.5, 0.2, 0.03] {
            let area = Area::new(&pulse, (0.0, 1.0));
            let own = hump::optimum(&area, cap).unwrap();
            let all = searched(&area, (0.0, 1.0), cap);
            assert!(
                (own.value / all.value - 1.0).abs() < 1e-12,
                "{name} up to {cap}: {own:?} and {all:?}"
            );
            let length = |own: Optimum| own.interval.1 - own.interval.0;
            close(length(own), length(all), 1e-6);
            let top = pulse.maximum((0.0, 1.0)).time;
            let known = optimum_of_hump(&pulse, (0.0, 1.0), top, cap);
            close(known.value / own.value, 1.0, 1e-12);
        }
    }
}

#[test]
fn a_ramp_that_ends_with_a_jump_is_its_own_interval_in_part() {
    // Rounding after the jump is no hump. Of a ramp T long up to A, the best begins at 3/7 of it.
    let ramp = Panel { start: 0.0, end: 1.0, coefficients: [0.5, 0.5].into() };
    for after in [0.0, 1e-17, -1e-17] {
        let rest = Panel::constant(1.0, 2.0, after);
        let found = optimum(&Signal::new(vec![ramp.clone(), rest], None, 0.0), (0.0, 2.0), 1e9);
        close(found.value, 4.0 / 7.0 * (5.0_f64 / 7.0).powf(2.5), 1e-12);
        close(found.interval.0, 3.0 / 7.0, 1e-6);
    }
}

#[test]
fn two_humps_are_none() {
    let pulse = signal(1.0, 7, |t| (2.0 * PI * t).sin().powi(2) + 0.1 * t);
    assert_eq!(hump::optimum(&Area::new(&pulse, (0.0, 1.0)), 1e9), None);
}

#[test]
fn a_swing_back_takes_from_the_mean_whichever_way_the_signal_points() {
    // A grid over all intervals is the judge: of a ringing that dies away, and of it turned about.
    let ringing = |t: f64| (-1.5 * t).exp() * ((9.0 * t).sin() + 0.4 * (41.0 * t).sin());
    for sign in [1.0, -1.0] {
        let pulse = signal(3.0, 60, |t| sign * ringing(t));
        for cap in [0.1, 0.4, 2.0] {
            let found = optimum(&pulse, (0.0, 3.0), cap);
            let area = Area::new(&pulse, (0.0, 3.0)).in_sense(Sense::Along(1.0));
            let steps = 900_u32;
            let at = |step: u32| 3.0 * f64::from(step) / f64::from(steps);
            let all = (0..steps).flat_map(|i| (i + 1..=steps).map(move |j| (at(i), at(j))));
            let all = all.filter(|own| own.1 - own.0 <= cap);
            let value =
                |own: (f64, f64)| criterion(area.between(own.0, own.1).abs(), own.1 - own.0);
            let best = all.map(value).fold(0.0, f64::max);
            assert!(found.value >= best * (1.0 - 1e-12), "{} < {best}", found.value);
            assert!(found.value <= best * 1.01, "{} > {best}", found.value);
            assert!(found.threshold <= 0.0, "cap {cap}: {}", found.threshold);
            let magnitude = optimum_of_magnitude(&pulse, (0.0, 3.0), cap).unwrap();
            assert!(magnitude.value >= found.value * (1.0 - 1e-12));
        }
    }
}
