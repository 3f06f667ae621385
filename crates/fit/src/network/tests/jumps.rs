//! Forces that jump as a dashpot is struck.

use dashpot_numerics::Stream;

use super::{normal, *};

const SPEED: f64 = 2.5;
const STEP: f64 = 5e-5;
/// Spring and dashpot in parallel: it jumps to 1.25 kN, and to 2.4 kN at most.
const PAD: [f64; 2] = [150e3, 500.0];

/// The force of a mass that strikes a spring and a dashpot in parallel and leaves them where it falls to zero:
/// `m ẍ + c ẋ + k x = 0`, `x(0) = 0`, `ẋ(0) = v`.
struct Kelvin([f64; 2]);

impl Curve for Kelvin {
    fn value(&self, time: f64) -> f64 {
        if time < 0.0 {
            return 0.0;
        }
        let [spring, dashpot] = self.0;
        let rate = 0.5 * dashpot / MASS;
        let omega = (spring / MASS - rate * rate).sqrt();
        let force = |time: f64| {
            let (sine, cosine) = (omega * time).sin_cos();
            let decayed = SPEED * (-rate * time).exp();
            let (way, speed) = (decayed * sine / omega, decayed * (cosine - rate / omega * sine));
            spring * way + dashpot * speed
        };
        // It leaves once, and does not come back.
        let left = (std::f64::consts::PI - 2.0 * (rate / omega).atan()) / omega;
        if time > left { 0.0 } else { force(time).max(0.0) }
    }

    fn peak(&self) -> (f64, f64) {
        let times = (0..2000).map(|at| 1e-5 * f64::from(at));
        let values = times.map(|t| (t, self.value(t)));
        values.fold((0.0, 0.0), |most, own| if own.1 > most.1 { own } else { most })
    }
}

fn kelvin(own: &[f64]) -> Box<dyn Curve> {
    Box::new(Kelvin([own[0], own[1]]))
}

/// Its force at 20 kHz for 30 ms, by a clock that is anywhere in its step, and 5 N high, with noise.
fn struck(stream: &mut Stream, noise: f64) -> (Test, f64) {
    let late = 3e-3 + STEP * stream.share();
    let rows = (0..600).map(|at| {
        let time = STEP * f64::from(at);
        (time, Kelvin(PAD).value(time - late) + 5.0 + noise * normal(stream))
    });
    let rows = rows.collect();
    (Test { rows, is_shifted: true, is_offset: true, ..Test::default() }, late)
}

fn fitted(tests: &[Test]) -> NetworkFit {
    let number = |own: f64| Number { low: own / 9.0, high: own * 9.0, start: own * 1.5 };
    let settings = NetworkSettings { starts: 1, ..SETTINGS };
    fit(&PAD.map(number), tests, settings, &|_, own| Ok(kelvin(own))).unwrap()
}

/// How many intervals of each number hold the truth, and how far the numbers are off in the mean of squares.
fn covered(noise: f64, tests: usize) -> ([usize; 2], [f64; 2]) {
    let (mut covered, mut off, mut stream) = ([0; 2], [0.0; 2], Stream::new(7));
    for _ in 0..RUNS {
        let all: Vec<Test> = (0..tests).map(|_| struck(&mut stream, noise).0).collect();
        for (at, own) in fitted(&all).numbers.iter().enumerate() {
            let [low, high] = own.ends.map(Option::unwrap);
            covered[at] += usize::from((low..=high).contains(&PAD[at]));
            off[at] += (own.value / PAD[at]).ln().powi(2);
        }
    }
    (covered, off.map(|own| (own / RUNS as f64).sqrt()))
}

const RUNS: usize = 200;

#[test]
fn intervals_hold_the_truth_though_a_blow_falls_anywhere_between_two_samples() {
    for (noise, tests) in [(1.0, 1), (60.0, 1), (5.0, 3)] {
        let (covered, off) = covered(noise, tests);
        println!("noise of {noise} N, {tests} tests: {covered:?} of {RUNS} hold, off by {off:?}");
        // 95 % of 200 is 190 with a standard deviation of 3.
        assert!(covered.iter().all(|own| *own >= 183), "{noise} {tests}: {covered:?}");
    }
}

#[test]
fn the_clock_lies_between_the_two_samples_of_the_jump() {
    let mut stream = Stream::new(3);
    for _ in 0..20 {
        let (test, late) = struck(&mut stream, 5.0);
        let own = fitted(&[test]);
        assert!((own.tests[0].shift - late).abs() <= STEP, "{late}: {}", own.tests[0].shift);
        let jump = own.tests[0].jump.unwrap();
        assert!((jump / (PAD[1] * SPEED) - 1.0).abs() < 0.05, "{jump}");
    }
}

/// A force that is met twice.
struct Twice(Kelvin);

const AGAIN: f64 = 0.018;

impl Curve for Twice {
    fn value(&self, time: f64) -> f64 {
        self.0.value(time) + 0.5 * self.0.value(time - AGAIN)
    }

    fn peak(&self) -> (f64, f64) {
        self.0.peak()
    }
}

#[test]
fn a_second_touch_that_jumps_is_told_with_its_time() {
    let mut stream = Stream::new(9);
    let (once, _) = struck(&mut stream, 1.0);
    assert_eq!(fitted(&[once]).tests[0].later_jump, None);
    let late = 3.02e-3;
    let truth = Twice(Kelvin(PAD));
    let rows = (0..600).map(|at| STEP * f64::from(at));
    let rows = rows.map(|time| (time, truth.value(time - late) + 5.0 + normal(&mut stream)));
    let test = Test { rows: rows.collect(), is_shifted: true, is_offset: true, ..Test::default() };
    let number = |own: f64| Number { low: own / 9.0, high: own * 9.0, start: own * 1.5 };
    let settings = NetworkSettings { starts: 1, ..SETTINGS };
    let model = |_: usize, own: &[f64]| -> Result<Box<dyn Curve>, String> {
        Ok(Box::new(Twice(Kelvin([own[0], own[1]]))))
    };
    let own = fit(&PAD.map(number), std::slice::from_ref(&test), settings, &model).unwrap();
    let later = own.tests[0].later_jump.unwrap();
    assert!((later.time - late - AGAIN).abs() < STEP, "{later:?}");
    // Half of `c v`.
    assert!((later.height / (0.5 * PAD[1] * SPEED) - 1.0).abs() < 0.05, "{later:?}");
    let known = Test { is_shifted: false, ..test };
    assert_eq!(
        fit(&PAD.map(number), &[known], settings, &model).unwrap().tests[0].later_jump,
        None
    );
}
