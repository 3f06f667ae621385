//! Moduli, answers to a history and impacts, which share numbers.

use dashpot_numerics::Stream;

use super::{normal, *};

/// Moduli of a Maxwell element over the angular frequency: storage or loss.
struct Modulus([f64; 2], bool);

impl Curve for Modulus {
    fn value(&self, omega: f64) -> f64 {
        let [stiffness, damping] = self.0;
        let x = omega * damping / stiffness;
        let own = stiffness * x / (1.0 + x * x);
        if self.1 { own } else { own * x }
    }

    fn peak(&self) -> (f64, f64) {
        (0.0, 0.0)
    }
}

/// Its force under a deformation that grows at 0.1 m/s for 20 ms and stays.
struct Held([f64; 2]);

impl Curve for Held {
    fn value(&self, time: f64) -> f64 {
        let [stiffness, damping] = self.0;
        let own = damping / stiffness;
        let grown = |t: f64| if t > 0.0 { -(-t / own).exp_m1() } else { 0.0 };
        0.1 * damping * (grown(time) - grown(time - 0.02))
    }

    fn peak(&self) -> (f64, f64) {
        (0.02, self.value(0.02))
    }
}

fn model(test: usize, own: &[f64]) -> Box<dyn Curve> {
    let own = [own[0], own[1]];
    match test {
        0 => Box::new(Modulus(own, false)),
        1 => Box::new(Modulus(own, true)),
        2 => Box::new(Held(own)),
        _ => pulse(&own),
    }
}

fn tests(stream: &mut Stream) -> Vec<Test> {
    let modulus = |is_loss: bool, stream: &mut Stream| {
        let omegas = (0..40).map(|at| 10.0_f64.powf(0.5 + 0.1 * f64::from(at)));
        let rows = omegas.map(|omega| {
            (omega, Modulus(TRUE, is_loss).value(omega) * (0.02 * normal(stream)).exp())
        });
        Test { rows: rows.collect(), kind: Kind::Modulus, ..Test::default() }
    };
    let [storage, loss] = [modulus(false, stream), modulus(true, stream)];
    let rows = (0..200).map(|at| {
        let time = 1e-3 * f64::from(at);
        (time, Held(TRUE).value(time - 4e-4) + 2.0 + normal(stream))
    });
    let rows = rows.collect();
    let kind = Kind::Answer;
    let held = Test { rows, kind, is_shifted: true, is_offset: true, ..Test::default() };
    let gain = Some(0.05);
    vec![storage, Test { gain, ..loss }, held, test(stream.below(1_000_000) as u64, 20.0)]
}

#[test]
fn tests_of_all_kinds_share_numbers_and_intervals_cover_them() {
    let (mut covered, runs, mut stream) = ([0; 2], 200, Stream::new(11));
    for _ in 0..runs {
        let settings = NetworkSettings { starts: 1, ..SETTINGS };
        let own =
            fit(&numbers(), &tests(&mut stream), settings, &|at, own| Ok(model(at, own))).unwrap();
        for (at, found) in own.numbers.iter().enumerate() {
            let [low, high] = found.ends.map(Option::unwrap);
            covered[at] += i32::from((low..=high).contains(&TRUE[at]));
        }
        let late = own.tests[2].shift;
        assert!((late - 4e-4).abs() < 1e-4, "{late}");
        assert!((own.tests[0].rms / 0.02 - 1.0).abs() < 0.5, "{}", own.tests[0].rms);
        let held_out = own.tests[0].held_out.unwrap();
        assert!(held_out.rms < 0.04 && held_out.peak.abs() < 0.1, "{held_out:?}");
    }
    assert!(covered.iter().all(|own| *own >= 181), "{covered:?} of {runs}");
}
