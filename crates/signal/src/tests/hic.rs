use std::f64::consts::PI;

use dashpot_analysis::measures::{
    STANDARD_GRAVITY,
    hic_search::{Windows, optimum},
};
use dashpot_dae::{Panel, Signal};
use dashpot_numerics::{
    Stream,
    chebyshev::{Coefficients, Interpolation},
};
use dashpot_units::Dimension;

use crate::{Channel, Measure, Uncertainty, measures::Reader};

const CAPS: [(Measure, f64); 3] =
    [(Measure::Hic15, 0.015), (Measure::Hic36, 0.036), (Measure::Hic, f64::INFINITY)];

/// An impact of one to three bumps of either sign with a ringing upon it \[g0\], over 60 ms.
struct Impact {
    /// Height, place and half width \[s\] of each.
    bumps: Vec<[f64; 3]>,
    /// Height, circular frequency \[1/s\] and rate of decay \[1/s\].
    ringing: [f64; 3],
}

impl Impact {
    fn random(stream: &mut Stream) -> Self {
        let bumps = (0..=stream.below(3)).map(|_| {
            let sign = if stream.below(4) == 0 { -1.0 } else { 1.0 };
            let width = stream.between(1e-3, 8e-3);
            [sign * stream.between(20.0, 300.0), 0.02 + 0.02 * stream.share(), width]
        });
        let bumps = bumps.collect();
        let height = if stream.below(2) == 0 { 0.0 } else { stream.between(1.0, 100.0) };
        let ringing = [height, 2.0 * PI * stream.between(80.0, 400.0), stream.between(50.0, 400.0)];
        Self { bumps, ringing }
    }

    fn value(&self, time: f64) -> f64 {
        let bump = |own: &[f64; 3]| own[0] * (-((time - own[1]) / own[2]).powi(2)).exp();
        let [height, frequency, decay] = self.ringing;
        let late = time - 0.02;
        // It begins smoothly, as steeply as its own frequency lets it.
        let grown = 1.0 / (1.0 + (-late * frequency).exp());
        let ringing = height * grown * (-decay * late.max(-0.02)).exp() * (frequency * late).sin();
        self.bumps.iter().map(bump).sum::<f64>() + if height > 0.0 { ringing } else { 0.0 }
    }

    /// As dense output of a run has it.
    fn signal(&self) -> Signal {
        let interpolation = Interpolation::of_degree(15);
        let border = |at: u32| 0.06 * f64::from(at) / 60.0;
        let panels = (0..60).map(|at| {
            let (start, end) = (border(at), border(at + 1));
            let value = |x: &f64| self.value(0.5 * (start + end) + 0.5 * (end - start) * x);
            let values: Vec<f64> = interpolation.nodes().iter().map(value).collect();
            let mut coefficients = Coefficients::zeros(16);
            interpolation.coefficients(&values, &mut coefficients);
            Panel { start, end, coefficients }
        });
        Signal::new(panels.collect(), None, 1e-12)
    }

    /// As a recorder has it.
    fn channel(&self, rate: f64) -> Channel {
        let count = (0.06 * rate).floor();
        let (mut times, mut at) = (Vec::new(), 0.0);
        while at <= count {
            times.push(at / rate);
            at += 1.0;
        }
        let values = times.iter().map(|time| STANDARD_GRAVITY * self.value(*time)).collect();
        Channel::new("a", Dimension::ACCELERATION, times, values).unwrap()
    }
}

#[test]
fn a_scene_and_a_record_of_it_have_one_criterion_within_the_error_that_is_stated() {
    let mut stream = Stream::new(31);
    let mut errors = Vec::new();
    for at in 0..1000 {
        let impact = Impact::random(&mut stream);
        let signal = impact.signal();
        let rate = stream.between(5e3, 100e3);
        let channel = impact.channel(rate);
        let reader = Reader::new(&channel, Uncertainty::default(), None);
        let (measure, cap) = CAPS[at % CAPS.len()];
        let scene = optimum(&signal, (0.0, 0.06), cap);
        let record = reader.read(measure).unwrap();
        let value = record.value.unwrap();
        assert!(
            (scene.value - value).abs() <= record.error + scene.threshold,
            "{at}: {} of {}, {value} ± {} at {rate} Hz",
            measure.word(),
            scene.value,
            record.error
        );
        errors.push(record.error / scene.value);
    }
    errors.sort_by(f64::total_cmp);
    assert!(errors[errors.len() / 2] < 0.01, "{}", errors[errors.len() / 2]);
}

/// A record of few rough samples at uneven steps, of either sign.
fn rough(stream: &mut Stream) -> Channel {
    let count = 5 + stream.below(40);
    let (mut times, mut values, mut time) = (Vec::new(), Vec::new(), 0.0);
    for at in 0..count {
        time += 1e-3 * (0.2 + stream.share());
        times.push(time);
        let height = (PI * at as f64 / count as f64).sin() * 3.0 * stream.share();
        values.push(STANDARD_GRAVITY * (height + 2.0 * (stream.share() - 0.4)));
    }
    Channel::new("a", Dimension::ACCELERATION, times, values).unwrap()
}

#[test]
fn no_interval_of_a_fine_grid_is_better_and_those_of_samples_are_all_tried() {
    const PARTS: usize = 12;
    let mut stream = Stream::new(32);
    for at in 0..1000 {
        let channel = rough(&mut stream);
        let cap = if at % 3 == 0 { f64::INFINITY } else { stream.between(2e-3, 2e-2) };
        let found = optimum(&channel.signal(STANDARD_GRAVITY), channel.span(), cap);
        assert!(found.threshold <= 0.0, "{at}: {found:?}");
        let grid = |parts: usize| -> Vec<(f64, f64)> {
            let each = channel.times().windows(2).flat_map(|pair| {
                let step = (pair[1] - pair[0]) / parts as f64;
                (0..parts).map(move |part| pair[0] + part as f64 * step)
            });
            let times: Vec<f64> = each.chain(channel.times().last().copied()).collect();
            let mut area = 0.0;
            let mut all = vec![(times[0], 0.0)];
            for pair in times.windows(2) {
                let ends = channel.value(pair[0]) + channel.value(pair[1]);
                area += 0.5 * (pair[1] - pair[0]) * ends / STANDARD_GRAVITY;
                all.push((pair[1], area));
            }
            all
        };
        let best = |all: &[(f64, f64)]| {
            let mut best = 0.0_f64;
            for (at, from) in all.iter().enumerate() {
                for to in &all[at + 1..] {
                    let length = to.0 - from.0;
                    if length <= cap * (1.0 + 1e-9) {
                        best = best.max(length * ((to.1 - from.1).abs() / length).powf(2.5));
                    }
                }
            }
            best
        };
        let [fine, coarse] = [best(&grid(PARTS)), best(&grid(1))];
        assert!(found.value >= fine * (1.0 - 1e-8), "{at}: {found:?} and {fine}");
        // The ends of the best interval moved inwards to the grid lose no more area than this.
        let length = found.interval.1 - found.interval.0;
        let longest = channel.times().windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let step = longest / PARTS as f64;
        if length > 2.0 * step {
            let area = (found.value * length.powf(1.5)).powf(0.4);
            let lost = 2.0 * step * channel.largest().1 / STANDARD_GRAVITY;
            let least = (area - lost).max(0.0).powf(2.5) / length.powf(1.5);
            assert!(fine >= least, "{at}: {found:?}, {fine} and {least}");
        }
        let signal = channel.signal(STANDARD_GRAVITY);
        let windows = Windows::of(&signal, channel.span());
        let own = windows.optimum_between(cap, (channel.times(), found.interval)).value;
        assert!(own <= found.value * (1.0 + 1e-12), "{at}: {own} of samples, {found:?}");
        assert!((own - coarse).abs() <= 1e-9 * coarse, "{at}: {own} and {coarse}");
    }
}

#[test]
fn a_long_record_with_noise_has_its_criterion_to_the_last() {
    // 2 s at 50 kHz: a half-sine of 10 ms and noise of 2 % of it throughout.
    let mut stream = Stream::new(33);
    let rate = 5e4;
    let times: Vec<f64> = (0..100_000).map(|at| f64::from(at) / rate).collect();
    let value = |time: &f64| {
        let place = (time - 1.0) / 0.01;
        let pulse = if (0.0..1.0).contains(&place) { 100.0 * (PI * place).sin() } else { 0.0 };
        STANDARD_GRAVITY * (pulse + 4.0 * (stream.share() - 0.5))
    };
    let values = times.iter().map(value).collect();
    let channel = Channel::new("a", Dimension::ACCELERATION, times, values).unwrap();
    for cap in [0.015, 0.036, f64::INFINITY] {
        let found = optimum(&channel.signal(STANDARD_GRAVITY), channel.span(), cap);
        let exact = 0.414_645_65 * 100.0_f64.powf(2.5) * 0.01;
        assert!((found.value / exact - 1.0).abs() < 1e-2, "{found:?}, not {exact}");
        assert!(found.threshold <= 0.0, "{found:?}");
    }
}

#[test]
fn a_long_record_of_equal_pulses_has_that_of_one_and_of_all() {
    // 100 000 samples: 500 half-sines of 10 ms and 100 g, each as good as the next, every 20 ms.
    let rate = 1e4;
    let times: Vec<f64> = (0..100_000).map(|at| f64::from(at) / rate).collect();
    let value = |at: u32| {
        let place = f64::from(at % 200) / 100.0;
        if place < 1.0 { 100.0 * STANDARD_GRAVITY * (PI * place).sin() } else { 0.0 }
    };
    let values = (0..100_000).map(value).collect();
    let channel = Channel::new("a", Dimension::ACCELERATION, times, values).unwrap();
    let reader = Reader::new(&channel, Uncertainty::default(), None);
    let of = |measure| {
        let own = reader.read(measure).unwrap();
        (own.value.unwrap(), own.error, own.on_samples.unwrap())
    };
    for measure in [Measure::Hic15, Measure::Hic36] {
        let (value, error, samples) = of(measure);
        // Straight lines lie below the sine by up to (π/100)²/8 of it.
        let exact = 0.414_645_65 * 100.0_f64.powf(2.5) * 0.01;
        assert!((value / exact - 1.0).abs() < 1e-3 && error < 0.01 * value, "{value} ± {error}");
        assert!(samples <= value && samples > 0.999 * value, "{samples} and {value}");
    }
    // All of them: from a little within the first one to as much within the last.
    let (value, error, samples) = of(Measure::Hic);
    let within = |part: u32| {
        let lost = 0.01 * f64::from(part) / 2000.0;
        let area = 500.0 * 2.0 / PI - 2.0 / PI * (1.0 - (PI * lost / 0.01).cos());
        area.powf(2.5) / (9.99 - 2.0 * lost).powf(1.5)
    };
    let exact = (0..1000).map(within).fold(0.0, f64::max);
    assert!((value / exact - 1.0).abs() < 1e-3 && error < 0.01 * value, "{value}, not {exact}");
    assert!(samples <= value && samples > 0.999 * value, "{samples} and {value}");
}
