use std::f64::consts::{PI, TAU};

use dashpot_analysis::measures::STANDARD_GRAVITY;
use dashpot_units::Dimension;

use super::*;

mod clipping;
mod hic;

/// A pulse over its own length and height: shape, HIC in parts of `A^2.5 T`, integral, severity index.
struct Pulse {
    name: &'static str,
    shape: fn(f64) -> f64,
    hic: f64,
    mean: f64,
    severity: f64,
    /// Whether a rate of 20 kHz is to tell its criterion within 0.05 %.
    is_smooth: bool,
}

/// The constants of `docs/injury-measures.md`: those of the half-sine and of its square by their integrals, of the triangle
/// `(3/7) (5/7)^{5/2} (4/3)`, of the rectangle 1.
const PULSES: [Pulse; 4] = [
    Pulse {
        name: "half-sine",
        shape: |x| (PI * x).sin(),
        hic: 0.414_645_65,
        mean: 2.0 / PI,
        severity: 0.457_655_86,
        is_smooth: true,
    },
    Pulse {
        name: "haversine",
        shape: |x| (PI * x).sin().powi(2),
        hic: 0.302_939,
        mean: 0.5,
        // (1/π) B(3, 1/2) = 16/(15 π).
        severity: 16.0 / (15.0 * PI),
        is_smooth: true,
    },
    Pulse {
        name: "triangle",
        shape: |x| 1.0 - (2.0 * x - 1.0).abs(),
        hic: 0.246_401,
        mean: 0.5,
        severity: 2.0 / 7.0,
        is_smooth: true,
    },
    Pulse { name: "square", shape: |_| 1.0, hic: 1.0, mean: 1.0, severity: 1.0, is_smooth: false },
];

/// Height \[m/s²\] and length \[s\] of the pulses.
const HEIGHT: f64 = 200.0 * STANDARD_GRAVITY;
const LENGTH: f64 = 0.005;

/// A pulse at this rate that begins so many steps behind a sample, 10 ms after the record.
fn sampled(pulse: &Pulse, rate: f64, shift: f64, offset: f64) -> Channel {
    let begin = 0.01 + shift / rate;
    let mut samples = (Vec::new(), Vec::new());
    let mut at = 0.0;
    while at <= 0.03 * rate {
        let time: f64 = at / rate;
        let place = (time - begin) / LENGTH;
        let inside = (0.0..1.0).contains(&place);
        samples.0.push(time);
        samples.1.push(offset + if inside { HEIGHT * (pulse.shape)(place) } else { 0.0 });
        at += 1.0;
    }
    Channel::new(pulse.name, Dimension::ACCELERATION, samples.0, samples.1).unwrap()
}

/// Value and error of a measure.
fn read(analysis: &Analysis, measure: Measure) -> (f64, f64) {
    let reading = analysis.reading(measure).unwrap();
    (reading.value.unwrap(), reading.error)
}

/// Whether a truth is what a measure says of it: a pulse with a flat top may be clipped, so that it is a bound.
fn holds(analysis: &Analysis, measure: Measure, truth: f64, rounding: f64) -> bool {
    let reading = analysis.reading(measure).unwrap();
    let above = reading.value.unwrap() - truth;
    match reading.truth {
        Truth::Within => above.abs() <= reading.error + rounding,
        Truth::AtLeast => above <= rounding,
        Truth::AtMost => -above <= rounding,
    }
}

#[test]
fn closed_forms_are_within_the_errors_that_are_stated() {
    let unit = 200.0_f64.powf(2.5) * LENGTH;
    for pulse in &PULSES {
        for rate in [5e3, 10e3, 20e3, 100e3] {
            for shift in [0.0, 0.1, 0.25, 0.5, 0.73, 0.95] {
                let found = Settings::default().analyse(sampled(pulse, rate, shift, 0.0)).unwrap();
                let rest = (1.0 - 0.003 / LENGTH) / 2.0;
                let clip = match pulse.name {
                    "triangle" => HEIGHT * 2.0 * rest,
                    _ => HEIGHT * (pulse.shape)(rest),
                };
                for (measure, expected) in [
                    (Measure::Peak, HEIGHT),
                    (Measure::Hic15, pulse.hic * unit),
                    (Measure::Hic36, pulse.hic * unit),
                    (Measure::Hic, pulse.hic * unit),
                    (Measure::SeverityIndex, pulse.severity * unit),
                    (Measure::VelocityChange, pulse.mean * HEIGHT * LENGTH),
                    (Measure::Clip3ms, clip),
                    (Measure::Clip3msAtOnce, clip),
                ] {
                    let (value, error) = read(&found, measure);
                    assert!(
                        holds(&found, measure, expected, 2e-6 * expected),
                        "{} of {} at {rate} Hz, {shift}: {value} ± {error}, not {expected}",
                        measure.word(),
                        pulse.name
                    );
                }
                if pulse.is_smooth && rate >= 20e3 {
                    let (value, error) = read(&found, Measure::Hic15);
                    let exact = pulse.hic * unit;
                    assert!((value - exact).abs() < 5e-4 * exact, "{}: {value}", pulse.name);
                    assert!(error < 5e-3 * exact, "{}: ± {error} of {exact}", pulse.name);
                }
            }
        }
    }
}

#[test]
fn an_offset_that_is_found_is_taken_off_within_its_error() {
    for pulse in &PULSES {
        for rate in [10e3, 100e3] {
            let offset = 3.0 * STANDARD_GRAVITY;
            let settings = Settings { offset: Removal::Found, ..Settings::default() };
            let found = settings.analyse(sampled(pulse, rate, 0.4, offset)).unwrap();
            let rest = found.offset.unwrap();
            assert!((rest.value - offset).abs() <= rest.error + 1e-12, "{}: {rest:?}", pulse.name);
            assert!(rest.window.1 < 0.0101, "{}: {rest:?}", pulse.name);
            let (value, error) = read(&found, Measure::VelocityChange);
            let exact = pulse.mean * HEIGHT * LENGTH;
            let name = pulse.name;
            let holds = holds(&found, Measure::VelocityChange, exact, 1e-9);
            assert!(holds, "{name}: {value} ± {error}");
            if found.reading(Measure::VelocityChange).unwrap().truth != Truth::Within {
                continue;
            }
            // What is not taken off moves the change of velocity by its product with the time.
            let left = Settings::default().analyse(sampled(pulse, rate, 0.4, offset)).unwrap();
            let (moved, _) = read(&left, Measure::VelocityChange);
            assert!((moved - value - offset * 0.03).abs() < 1e-9 + rest.error * 0.03);
        }
    }
}

#[test]
fn coarse_samples_are_wrong_by_no_more_than_is_stated() {
    let step = 0.5 * STANDARD_GRAVITY;
    let pulse = &PULSES[1];
    let coarse = sampled(pulse, 100e3, 0.3, 0.0).map(|own| (own / step).floor() * step);
    assert!((coarse.resolution() - step).abs() < 1e-9);
    let found = Settings::default().analyse(coarse).unwrap();
    let (value, error) = read(&found, Measure::VelocityChange);
    assert!((value - 0.5 * HEIGHT * LENGTH).abs() <= error, "{value} ± {error}");
}

#[test]
fn both_passes_have_the_gain_of_the_formula() {
    for class in Cfc::STANDARD {
        let cfc = Cfc::new(class).unwrap();
        for rate in [10e3, 20e3, 100e3] {
            for frequency in [0.3 * class, class, cfc.design_frequency(), 3.0 * class] {
                // A whole number of periods, far from both ends.
                let sine = |at: u32| (TAU * frequency * f64::from(at) / rate).sin();
                let count = 60_000;
                let values: Vec<f64> = (0..count).map(sine).collect();
                let filtered = cfc.filter(&values, rate, Padding::Odd).unwrap();
                let inner = 20_000..40_000;
                // The least-squares amplitude; a filter without phase has no part of the cosine.
                let [mut product, mut square, mut across] = [0.0; 3];
                for at in inner {
                    let cosine = (TAU * frequency * at as f64 / rate).cos();
                    product += values[at] * filtered[at];
                    square += values[at] * values[at];
                    across += cosine * (filtered[at] - values[at] * cfc.gain(frequency, rate));
                }
                let (gain, expected) = (product / square, cfc.gain(frequency, rate));
                assert!((gain - expected).abs() < 1e-6, "CFC {class}, {frequency} Hz: {gain}");
                assert!((across / square).abs() < 1e-6, "CFC {class}, {frequency} Hz: {across}");
            }
        }
    }
}

#[test]
fn gains_are_those_of_the_standard() {
    let cfc = Cfc::new(1000.0).unwrap();
    let decibels = |frequency, rate| 20.0 * cfc.gain(frequency, rate).log10();
    assert!((decibels(2077.5, 20e3) + 6.0206).abs() < 1e-4);
    assert!((decibels(1000.0, 20e3) + 0.45).abs() < 0.05);
    assert!((decibels(1000.0, 10e3) + 0.28).abs() < 0.01);
    assert!(cfc.gain(10e3, 20e3) <= 0.0);
    assert!(matches!(cfc.filter(&[0.0; 9], 4000.0, Padding::Odd), Err(CfcFault::TooSlow { .. })));
    // Times in the wrong unit ask for an endless run-in.
    assert!(matches!(cfc.filter(&[0.0; 9], 1e13, Padding::Odd), Err(CfcFault::TooFast { .. })));
    assert_eq!(Cfc::new(0.0), Err(CfcFault::NoClass));
}

#[test]
fn every_padding_keeps_what_it_says() {
    let cfc = Cfc::new(180.0).unwrap();
    let ramp: Vec<f64> = (0..200).map(|at| 50.0 + f64::from(at)).collect();
    for padding in Padding::ALL {
        let filtered = cfc.filter(&ramp, 20e3, padding).unwrap();
        assert_eq!(filtered.len(), ramp.len());
        // A symmetrical filter keeps a line, far from the ends with every padding.
        let inner = (filtered[100] - 150.0).abs();
        assert!(inner < if padding == Padding::Odd { 1e-6 } else { 0.5 }, "{padding:?}: {inner}");
        let ends = (filtered[0] - 50.0).abs();
        match padding {
            Padding::Odd => assert!(ends < 1e-3, "{ends}"),
            Padding::Zero => assert!(ends > 10.0, "{ends}"),
            _ => assert!(ends < 40.0, "{padding:?}: {ends}"),
        }
    }
}

#[test]
fn what_is_no_signal_is_refused() {
    let new = |times: &[f64], values: &[f64]| {
        Channel::new("a", Dimension::FORCE, times.to_vec(), values.to_vec()).unwrap_err()
    };
    assert_eq!(new(&[], &[]), ChannelFault::TooFew { count: 0 });
    assert_eq!(new(&[0.0], &[1.0]), ChannelFault::TooFew { count: 1 });
    assert_eq!(new(&[0.0, 1.0], &[1.0]), ChannelFault::Uneven { times: 2, values: 1 });
    assert_eq!(new(&[0.0, 1.0], &[1.0, f64::NAN]), ChannelFault::NotFinite { at: 1 });
    let back = new(&[0.0, 2.0, 1.0], &[0.0; 3]);
    assert_eq!(back, ChannelFault::TimeBack { at: 2, time: 1.0, before: 2.0 });
    assert_eq!(back.sample(), Some(2));
}

#[test]
fn uneven_steps_are_read_and_not_filtered() {
    let whole = sampled(&PULSES[0], 20e3, 0.0, 0.0);
    // Every seventh sample is missing.
    let kept = |at: &usize| at % 7 != 3;
    let pick = |all: &[f64]| (0..all.len()).filter(kept).map(|at| all[at]).collect::<Vec<_>>();
    let times = pick(whole.times());
    let thinned = Channel::new("a", Dimension::ACCELERATION, times, pick(whole.values())).unwrap();
    assert!(!thinned.steps().are_even && thinned.steps().gaps > 80);
    let found = Settings::default().analyse(thinned.clone()).unwrap();
    let (value, error) = read(&found, Measure::Hic15);
    let exact = PULSES[0].hic * 200.0_f64.powf(2.5) * LENGTH;
    assert!((value - exact).abs() <= error, "{value} ± {error}");
    let filtered = Settings { cfc: Cfc::new(600.0).ok(), ..Settings::default() };
    let refused = filtered.analyse(thinned.clone());
    assert!(matches!(refused, Err(SettingsFault::UnevenSteps { .. })));
    let resampled = Settings { rate: Some(20e3), ..filtered }.analyse(thinned).unwrap();
    assert!(resampled.channel.steps().are_even);
}

#[test]
fn a_bounce_on_a_spring_has_its_closed_form() {
    // m x'' = −K x: the acceleration is V ω sin ωt, the displacement (V/ω) sin ωt, and it comes back with V.
    let (velocity, omega, mass): (f64, f64, f64) = (5.0, PI / 0.008, 4.5);
    let pulse = |time: f64| {
        let inside = (0.0..0.008).contains(&time);
        if inside { velocity * omega * (omega * time).sin() } else { 0.0 }
    };
    for sign in [1.0, -1.0] {
        for (rate, offset) in [(10e3, 0.0), (20e3, 4.0)] {
            let times: Vec<f64> = (0..600).map(|at| f64::from(at) / rate).collect();
            let values = times.iter().map(|time| sign * pulse(time - 0.010_03) + offset).collect();
            let channel = Channel::new("a", Dimension::ACCELERATION, times, values).unwrap();
            let approach = Approach { velocity, mass: Some(mass), gravity: 0.0, touch: None };
            let settings = Settings {
                offset: Removal::Found,
                approach: Some(approach),
                ..Settings::default()
            };
            let found = settings.analyse(channel).unwrap();
            let energy = 0.5 * mass * velocity * velocity;
            for (measure, expected) in [
                (Measure::Displacement, velocity / omega),
                (Measure::ReboundVelocity, velocity),
                (Measure::Restitution, 1.0),
                (Measure::EnergyTaken, energy),
                (Measure::EnergyReturned, energy),
                (Measure::EnergyAbsorbed, 0.0),
            ] {
                let (value, error) = read(&found, measure);
                assert!(
                    (value - expected).abs() <= error + 1e-9 * expected,
                    "{}: {value} ± {error}, not {expected}",
                    measure.word()
                );
                assert!(error < 0.02 * energy.max(expected), "{}: ± {error}", measure.word());
            }
        }
    }
}

#[test]
fn the_work_of_a_force_is_the_area_of_its_loop() {
    // A force K x + C x' over a half-sine of displacement: ∮ F dx until the deepest point is K X²/2 + C π ω X²/4.
    let (stiffness, damping, depth, omega) = (2e5, 40.0, 0.012, PI / 0.01);
    let times: Vec<f64> = (0..=400).map(|at| f64::from(at) * 5e-5).collect();
    let place = |time: &f64| omega * (time - 0.005).clamp(0.0, 0.01);
    let x: Vec<f64> = times.iter().map(|own| depth * place(own).sin() + 0.3).collect();
    let inside = |time: &f64| (0.005..=0.015).contains(time);
    let force = |time: &f64| {
        let rate = depth * omega * place(time).cos();
        if inside(time) { stiffness * depth * place(time).sin() + damping * rate } else { 0.0 }
    };
    let f: Vec<f64> = times.iter().map(force).collect();
    let force = Channel::new("f", Dimension::FORCE, times.clone(), f).unwrap();
    let x = Channel::new("x", Dimension::LENGTH, times, x).unwrap();
    let mut own = Settings::default().analyse(force).unwrap();
    own.add_work(&Settings::default().analyse(x).unwrap()).unwrap();
    let stored = 0.5 * stiffness * depth * depth;
    let lost = damping * PI * omega * depth * depth / 4.0;
    for (measure, expected) in [
        (Measure::Displacement, depth),
        (Measure::EnergyTaken, stored + lost),
        (Measure::EnergyReturned, stored - lost),
    ] {
        let (value, error) = read(&own, measure);
        // The impact is over where the damper begins to pull, with the last part of its work to come.
        let rest = if measure == Measure::EnergyReturned { 5e-3 } else { 1e-3 };
        assert!(
            (value - expected).abs() <= error + rest * expected,
            "{}: {value} ± {error}, not {expected}",
            measure.word()
        );
    }
}

#[test]
fn several_tests_have_mean_and_scatter() {
    let heights = [0.95, 1.0, 1.05];
    let tests = heights.map(|own| {
        let channel = sampled(&PULSES[0], 20e3, 0.3, 0.0).map(|value| own * value);
        Settings::default().analyse(channel).unwrap()
    });
    let tests: Vec<&Analysis> = tests.iter().collect();
    let peak = Repeated::of(&tests).into_iter().find(|own| own.measure == Measure::Peak).unwrap();
    assert_eq!(peak.tests, 3);
    assert!((peak.mean / HEIGHT - 1.0).abs() < 1e-3);
    assert!((peak.deviation / HEIGHT - 0.05).abs() < 1e-4, "{peak:?}");
    assert!((peak.repeatability() / peak.deviation - 2.8).abs() < 1e-12);
    let band = Band::of(&tests).unwrap();
    let largest = band.mean.iter().copied().fold(0.0, f64::max);
    assert!((largest / HEIGHT - 1.0).abs() < 1e-3, "{largest}");
    assert!(Band::of(&tests[..1]).is_none() && Repeated::of(&tests[..1]).is_empty());
}
