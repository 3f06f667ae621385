//! A test that was repeated.

use dashpot_numerics::Stream;

use super::{normal, *};

/// Three drops with a force that has a part which no model of a Maxwell element has, by clocks of their own.
fn repeats(stream: &mut Stream, noise: f64) -> Vec<Test> {
    let one = |stream: &mut Stream| {
        let (truth, late) = (pulse(&TRUE), 3e-4 + 4e-4 * stream.share());
        let rows = (0..300).map(|at| {
            let time = 5e-5 * f64::from(at);
            let own = time - late;
            let beside = 60.0 * (2000.0 * own).sin() * f64::from(own > 0.0);
            (time, truth.value(own) + beside + noise * normal(stream))
        });
        let rows = rows.collect();
        let repeated = Some(7);
        Test { rows, is_shifted: true, is_offset: true, repeated, ..Test::default() }
    };
    (0..3).map(|_| one(stream)).collect()
}

#[test]
fn what_repeats_differ_by_is_noise_and_what_they_share_is_not() {
    let mut stream = Stream::new(5);
    for _ in 0..10 {
        let tests = repeats(&mut stream, 10.0);
        let own = fit(&numbers(), &tests, SETTINGS, &|_, own| Ok(pulse(own))).unwrap();
        for test in &own.tests {
            let scatter = test.scatter.unwrap();
            assert!((scatter.deviation / 10.0 - 1.0).abs() < 0.15, "{scatter:?}");
            assert!(scatter.records == 3 && scatter.correlation < 2.0, "{scatter:?}");
            // What is left of the model is more.
            assert!(test.rms > 2.0 * scatter.deviation, "{} {scatter:?}", test.rms);
            // No other test is there to tell of this one.
            assert!(test.held_out.is_none());
        }
    }
}
