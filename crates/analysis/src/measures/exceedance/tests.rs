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

/// Points of a line through random heights of either sign, at uneven steps.
fn rough(stream: &mut dashpot_numerics::Stream) -> Vec<(f64, f64)> {
    let mut time = 0.0;
    let mut point = |_| {
        time += 0.2 + stream.share();
        // Often as high as others, so that stretches are as long as each other.
        let height = (4.0 * stream.share()).round() + 1e-3 * stream.share();
        (time, if stream.below(4) == 0 { -height } else { height })
    };
    (0..24).map(&mut point).collect()
}

#[test]
fn no_window_of_a_grid_stays_above_a_higher_level() {
    let mut stream = dashpot_numerics::Stream::new(41);
    for at in 0..1000 {
        let points = rough(&mut stream);
        let line = |pair: &[(f64, f64)]| Panel {
            start: pair[0].0,
            end: pair[1].0,
            coefficients: [0.5 * (pair[0].1 + pair[1].1), 0.5 * (pair[1].1 - pair[0].1)].into(),
        };
        let signal = Signal::new(points.windows(2).map(line).collect(), Some(0.0), 0.0);
        let duration = 0.1 + 3.0 * stream.share();
        // Of the magnitude of a line, the time at or above a level.
        let time_above = |pair: &[(f64, f64)], level: f64| -> f64 {
            let [(from, first), (to, last)] = [pair[0], pair[1]];
            let parts = 2000_u32;
            let is_above = |part: &u32| {
                let share = (f64::from(*part) + 0.5) / f64::from(parts);
                (first + share * (last - first)).abs() >= level
            };
            let count = (0..parts).filter(is_above).count();
            (to - from) * count as f64 / f64::from(parts)
        };
        let together = level(&signal, duration, Counted::Together);
        let sum = |level: f64| points.windows(2).map(|pair| time_above(pair, level)).sum::<f64>();
        let grid = 24.0 * 1.2 / 2000.0;
        assert!(sum(together - 0.02) >= duration - grid, "{at}: {together}");
        assert!(sum(together + 0.02) <= duration + grid, "{at}: {together}");
        // The largest of the least magnitudes over windows.
        let at_once = level(&signal, duration, Counted::AtOnce);
        let (start, end) = (signal.start(), signal.end());
        let mut best = 0.0_f64;
        let steps = 400_u32;
        for step in 0..=steps {
            let from = start + (end - duration - start) * f64::from(step) / f64::from(steps);
            let to = from + duration;
            let inside = points.iter().filter(|point| point.0 > from && point.0 < to);
            let ends = [from, to].map(|time| (time, signal.value(time)));
            let all: Vec<(f64, f64)> =
                [ends[0]].into_iter().chain(inside.copied()).chain([ends[1]]).collect();
            let crosses = all.windows(2).any(|pair| pair[0].1 * pair[1].1 < 0.0);
            let least = all.iter().map(|point| point.1.abs()).fold(f64::INFINITY, f64::min);
            best = best.max(if crosses { 0.0 } else { least });
        }
        assert!(at_once >= best - 1e-12, "{at}: {at_once} and {best}");
        // A line rises by no more than 8 in 0.2.
        let step = (end - duration - start) / f64::from(steps);
        assert!(at_once <= best + 50.0 * step, "{at}: {at_once} and {best}");
    }
}
