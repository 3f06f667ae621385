//! Records that end at the range of a sensor, and smooth ones that only look like it.

use dashpot_numerics::Stream;

use super::*;

/// A half-sine of 150 g and 10 ms from 10 ms on, recorded at this rate \[kHz\], each sample as a recorder makes it.
fn recorded(rate: f64, shift: f64, mut recorder: impl FnMut(f64) -> f64) -> Channel {
    let times: Vec<f64> = (0..u32::MAX)
        .map(|at| f64::from(at) / (1e3 * rate))
        .take_while(|own| *own < 0.04)
        .collect();
    let value = |time: &f64| {
        let place = (time - 0.01) / 0.01 - shift / (10.0 * rate);
        if (0.0..1.0).contains(&place) { 150.0 * (PI * place).sin() } else { 0.0 }
    };
    let values = times.iter().map(|time| recorder(value(time)) * STANDARD_GRAVITY).collect();
    Channel::new("a", Dimension::ACCELERATION, times, values).unwrap()
}

fn is_clipped(channel: Channel) -> bool {
    let own = Settings::default().analyse(channel).unwrap();
    let is_bound = own.reading(Measure::Peak).unwrap().truth == Truth::AtLeast;
    assert_eq!(is_bound, !own.clipped.is_empty());
    is_bound
}

#[test]
fn noise_on_the_end_of_a_range_hides_no_clipping() {
    let mut stream = Stream::new(1);
    for rate in [10.0, 20.0, 50.0] {
        for level in [145.0, 120.0, 60.0, -120.0_f64] {
            for at in 0..10 {
                let noisy = |own: f64| {
                    let clipped = own.min(level.abs()).copysign(own * level);
                    clipped + 0.2 * (2.0 * stream.share() - 1.0)
                };
                let own = recorded(rate, 0.1 * f64::from(at), noisy);
                assert!(is_clipped(own), "{rate} kHz, {level} g");
            }
        }
    }
}

#[test]
fn a_smooth_pulse_is_not_clipped_however_it_is_written() {
    let mut stream = Stream::new(2);
    for rate in [1.0, 2.0, 5.0, 10.0, 50.0] {
        for step in [0.01, 0.1, 0.5, 2.0] {
            for noise in [0.0, 0.2, 1.0] {
                for at in 0..10 {
                    let written = |own: f64| {
                        let noisy = own + noise * (2.0 * stream.share() - 1.0);
                        (noisy / step).round() * step
                    };
                    let own = recorded(rate, 0.1 * f64::from(at), written);
                    assert!(!is_clipped(own), "{rate} kHz, steps of {step} g, noise of {noise} g");
                }
            }
        }
    }
    // As flat as the fourth power.
    let mut share = || 0.2 * (2.0 * stream.share() - 1.0);
    let flat = recorded(20.0, 0.0, |own| {
        let place = (own / 150.0).min(1.0).asin() / PI * 2.0 - 1.0;
        if own > 0.0 { 150.0 * (1.0 - place.powi(4)) + share() } else { share() }
    });
    assert!(!is_clipped(flat));
}
