use std::f64::consts::PI;

use super::*;
use crate::measures::tests::panels;

fn signal(end: f64, count: u32, function: impl Fn(f64) -> f64) -> Signal {
    Signal::new(panels(end, count, function), Some(0.0), 1e-15)
}

fn level(signal: &Signal, duration: f64, counted: Counted) -> f64 {
    Exceedance::new(signal, (signal.start(), signal.end())).level(duration, counted).value
}

fn close(found: f64, exact: f64) {
    assert!((found - exact).abs() <= 1e-13 * exact.abs().max(1.0), "{found} is not {exact}");
}

#[test]
fn half_sine_is_exceeded_around_its_middle() {
    for sign in [1.0, -1.0] {
        for panels in [1, 2, 7] {
            let pulse = signal(2.0, panels, |t| sign * 5.0 * (PI * t / 2.0).sin());
            for duration in [0.1, 1.0, 1.9] {
                let exact = 5.0 * (PI * duration / 4.0).cos();
                close(level(&pulse, duration, Counted::Together), exact);
                close(level(&pulse, duration, Counted::AtOnce), exact);
            }
        }
    }
}

#[test]
fn times_of_several_peaks_count_together_or_apart() {
    // One arch up, one down, the second one as high: |sin| over two half periods.
    let wave = signal(2.0, 4, |t| 3.0 * (PI * t).sin());
    let at_once = |duration: f64| 3.0 * (0.5 * PI * duration).cos();
    close(level(&wave, 0.6, Counted::AtOnce), at_once(0.6));
    close(level(&wave, 0.6, Counted::Together), at_once(0.3));
    // No arch alone lasts so long; both do.
    close(level(&wave, 1.2, Counted::Together), at_once(0.6));
    close(level(&wave, 1.2, Counted::AtOnce), 0.0);
}

#[test]
fn plateau_is_reached_for_as_long_as_it_lasts() {
    let piece = |start, end, value| Panel::constant(start, end, value);
    let panels = vec![piece(0.0, 1.0, 2.0), piece(1.0, 2.0, -4.0), piece(2.0, 3.0, 1.0)];
    let steps = Signal::new(panels, Some(0.0), 0.0);
    close(level(&steps, 1.0, Counted::Together), 4.0);
    close(level(&steps, 1.0 + 1e-9, Counted::Together), 2.0);
    close(level(&steps, 2.0, Counted::AtOnce), 2.0);
    close(level(&steps, 3.0, Counted::AtOnce), 1.0);
    close(level(&steps, 3.1, Counted::AtOnce), 0.0);
}

#[test]
fn level_at_the_end_of_the_window_is_told() {
    let ramp = signal(1.0, 1, |t| 2.0 * t);
    let found = Exceedance::new(&ramp, (0.0, 1.0)).level(0.25, Counted::AtOnce);
    close(found.value, 1.5);
    assert!(found.reaches_end);
    close(found.slope, 2.0);
    let inside = Exceedance::new(&ramp, (0.0, 0.0)).level(0.25, Counted::AtOnce);
    assert!(inside.value.abs() < f64::MIN_POSITIVE && !inside.reaches_end);
}
