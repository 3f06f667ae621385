use dashpot_numerics::chebyshev::{Coefficients, Interpolation};

use super::*;

fn guard(level: f64, direction: Direction, stops: bool) -> Guard {
    Guard {
        name: "a guard".to_owned(),
        output: 0,
        level,
        direction,
        stops,
        begins: None,
        rate_of: None,
    }
}

/// The polynomial or smooth function on these panels.
fn signal(f: impl Fn(f64) -> f64, borders: &[f64]) -> Signal {
    let interpolation = Interpolation::of_degree(6);
    let panel = |pair: &[f64]| {
        let time = |node: f64| pair[0] + 0.5 * (node + 1.0) * (pair[1] - pair[0]);
        let values: Vec<f64> = interpolation.nodes().iter().map(|&node| f(time(node))).collect();
        let mut coefficients = Coefficients::zeros(values.len());
        interpolation.coefficients(&values, &mut coefficients);
        Panel { start: pair[0], end: pair[1], coefficients }
    };
    Signal::new(borders.windows(2).map(panel).collect(), None, 1e-14)
}

fn noises(signals: &[Signal]) -> Vec<f64> {
    signals.iter().map(|signal| signal.noise).collect()
}

/// Feeds the signals panel by panel.
fn step_by_step(guards: &[Guard], signals: &[Signal]) -> (Vec<Event>, Option<Stop>) {
    let mut watch = Watch::new(guards);
    for at in 0..signals[0].panels.len() {
        let part =
            |signal: &Signal| Signal::new(vec![signal.panels[at].clone()], None, signal.noise);
        let parts: Vec<Signal> = signals.iter().map(part).collect();
        if watch.feed(guards, &parts, &noises(&parts)).is_some() {
            break;
        }
    }
    let stop = watch.stop();
    (watch.into_events(), stop)
}

/// Looks at the signals both as a whole and panel by panel, which must agree.
fn look(guards: &[Guard], signals: &[Signal]) -> (Vec<Event>, Option<Stop>) {
    let whole = scan(guards, signals);
    let parts = step_by_step(guards, signals);
    assert_eq!(whole.0.len(), parts.0.len(), "{whole:?} {parts:?}");
    for (a, b) in whole.0.iter().zip(&parts.0) {
        assert_eq!((a.guard, a.rising), (b.guard, b.rising));
        assert!((a.time - b.time).abs() < 1e-13, "{a:?} {b:?}");
    }
    assert_eq!(whole.1.map(|stop| stop.guard), parts.1.map(|stop| stop.guard));
    whole
}

fn times(events: &[Event]) -> Vec<f64> {
    events.iter().map(|event| (event.time * 1e9).round() * 1e-9).collect()
}

#[test]
fn two_crossings_within_one_step_are_two_events() {
    let parabola = signal(|t| (t - 1.0) * (t - 1.01), &[0.0, 3.0]);
    let (events, stop) =
        look(&[guard(0.0, Direction::Either, false)], std::slice::from_ref(&parabola));
    assert_eq!(times(&events), [1.0, 1.01]);
    assert!(!events[0].rising && events[1].rising);
    assert_eq!(stop, None);
    let (rising, _) =
        look(&[guard(0.0, Direction::Rising, false)], std::slice::from_ref(&parabola));
    assert_eq!(times(&rising), [1.01]);
    let (falling, _) =
        look(&[guard(0.0, Direction::Falling, false)], std::slice::from_ref(&parabola));
    assert_eq!(times(&falling), [1.0]);
}

#[test]
fn a_start_on_the_level_arms_the_guard_by_the_first_derivative() {
    for offset in [0.0, 1e-17, -1e-17] {
        for power in [1, 2, 3] {
            // Leaves the level upwards like t, t², t³ and comes back down at 2.
            let arc = signal(|t| offset + t.powi(power) * (2.0 - t), &[0.0, 0.5, 1.5, 3.0]);
            let (events, _) = look(&[guard(0.0, Direction::Either, false)], &[arc]);
            assert_eq!(times(&events), [2.0], "{offset} {power}");
            assert!(!events[0].rising);
        }
    }
}

#[test]
fn a_crossing_at_the_border_of_two_steps_is_one_event() {
    let line = signal(|t| 1.0 - t, &[0.0, 1.0, 2.0]);
    let (events, _) = look(&[guard(0.0, Direction::Either, false)], &[line]);
    assert_eq!(times(&events), [1.0]);
}

#[test]
fn a_touch_and_a_decay_are_no_events() {
    let touch = signal(|t| (t - 1.0) * (t - 1.0), &[0.0, 1.0, 2.0]);
    assert!(look(&[guard(0.0, Direction::Either, true)], &[touch]).0.is_empty());
    let borders: Vec<f64> = (0..=20).map(|k| 2.0 * f64::from(k)).collect();
    let decay = signal(|t| (-t).exp(), &borders);
    assert!(step_by_step(&[guard(0.0, Direction::Either, true)], &[decay]).0.is_empty());
}

#[test]
fn a_long_rest_on_the_level_is_left_as_it_is_left() {
    // Down to the level at 1, at rest on it until 4, then on in the direction of `after`.
    let borders: Vec<f64> = (0..=12).map(|k| 0.5 * f64::from(k)).collect();
    let path =
        |after: f64| move |t: f64| if t < 1.0 { 1.0 - t } else { after * (t - 4.0).max(0.0) };
    let (through, _) =
        look(&[guard(0.0, Direction::Either, true)], &[signal(path(-1.0), &borders)]);
    assert_eq!(times(&through), [4.0]);
    let (back, _) = look(&[guard(0.0, Direction::Either, true)], &[signal(path(1.0), &borders)]);
    assert!(back.is_empty());
}

#[test]
fn a_jump_from_one_step_to_the_next_is_an_event() {
    let mut jump = signal(|t| 1.0 + t, &[0.0, 1.0, 2.0]);
    jump.panels[1].coefficients[0] -= 5.0;
    let (events, stop) = look(&[guard(0.0, Direction::Falling, true)], &[jump]);
    assert_eq!(times(&events), [1.0]);
    assert_eq!(stop.map(|stop| stop.guard), Some(0));
}

#[test]
fn guards_at_one_instant_are_all_told_and_the_first_that_stops_ends_the_run() {
    let guards = [
        guard(0.5, Direction::Either, false),
        guard(0.0, Direction::Either, false),
        guard(0.0, Direction::Either, true),
        guard(0.0, Direction::Either, true),
        guard(0.0, Direction::Rising, true),
        guard(-0.5, Direction::Either, true),
    ];
    // Equal zeros of unequal functions, each with its own rounding.
    let line = |factor: f64| signal(move |t| factor * (0.7 - t), &[0.0, 0.3, 1.1, 2.0]);
    let signals =
        [line(1.0), line(1.0 / 3.0), line(3.0_f64.sqrt()), line(0.1), line(1.0), line(1.0)];
    let (events, stop) = look(&guards, &signals);
    let found: Vec<usize> = events.iter().map(|event| event.guard).collect();
    assert_eq!(found, [0, 1, 2, 3]);
    let stop = stop.unwrap();
    assert_eq!(stop.guard, 2);
    assert!((stop.time - 0.7).abs() < 1e-13);
    assert!(events.iter().all(|event| event.time <= stop.time));
}

#[test]
fn nothing_is_told_after_a_stop() {
    let guards = [guard(0.0, Direction::Either, true)];
    let wave = signal(|t| t.sin() - 0.5, &[0.0, 2.0, 4.0, 6.0, 8.0]);
    let mut watch = Watch::new(&guards);
    let first = watch.feed(&guards, std::slice::from_ref(&wave), &[wave.noise]);
    assert_eq!(watch.feed(&guards, std::slice::from_ref(&wave), &[wave.noise]), first);
    assert_eq!(watch.into_events().len(), 1);
}

#[test]
fn without_guards_there_is_nothing_to_do() {
    assert!(Watch::new(&[]).is_idle());
    assert_eq!(scan(&[], &[]), (Vec::new(), None));
}

#[test]
fn a_bend_of_the_first_step_over_a_level_that_is_left_is_no_event() {
    // It leaves zero downwards with its second derivative; the first step bends it up by 1e-5 first.
    let bent = signal(|t| 1e-2 * t * (0.004 - t), &[0.0, 0.1, 1.0]);
    let known = Guard { begins: Some(false), ..guard(0.0, Direction::Rising, true) };
    let alone = std::slice::from_ref(&bent);
    assert!(look(std::slice::from_ref(&known), alone).0.is_empty());

    // It comes back in truth, later.
    let back = signal(|t| 1e-2 * t * (0.004 - t) + 0.1 * t.powi(4), &[0.0, 0.1, 0.5, 1.0]);
    let (events, stop) = look(std::slice::from_ref(&known), std::slice::from_ref(&back));
    assert_eq!(events.len(), 1);
    let time = stop.unwrap().time;
    assert!((1e-2 * (0.004 - time) + 0.1 * time.powi(3)).abs() < 1e-12, "{time}");

    // A way out from which it does not come back within the step is an event.
    let out = signal(|t| 1e-2 * t * (0.4 - t), &[0.0, 0.1, 1.0]);
    let (events, _) = look(&[known], std::slice::from_ref(&out));
    assert_eq!(times(&events), [0.0]);
}

#[test]
fn crossings_are_at_one_instant_by_rounding_and_not_by_the_error_of_a_method() {
    let guards = [guard(0.0, Direction::Either, true), guard(1e-9, Direction::Either, true)];
    let line = signal(|t| t - 1.0, &[0.0, 3.0]);
    let signals = [line.clone(), line].map(|own| Signal { noise: 1e-6, ..own });
    let met = |rounding: f64| {
        let mut watch = Watch::new(&guards);
        watch.feed(&guards, &signals, &[rounding; 2]);
        watch.into_events().len()
    };
    assert_eq!((met(1e-14), met(1e-6)), (1, 2));
}
