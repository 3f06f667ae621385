//! A pad that is known, seen through a filter.

use dashpot_numerics::Stream;
use dashpot_signal::{Cfc, Padding};

use super::{normal, *};

const MASS: f64 = 4.0;
const SPEED: f64 = 3.0;
/// Spring at rest, spring and dashpot of the branch: a pulse of 8.3 ms and 87 g.
const PAD: [f64; 3] = [350e3, 1.5e6, 800.0];
const STEP: f64 = 1e-5;
const RATE: f64 = 2e4;
/// Half a standard gravity.
const NOISE: f64 = 4.903;

/// The acceleration of a mass that strikes a Zener element and leaves it where the force falls to zero, by steps of
/// Runge and Kutta with cubics between them.
struct Struck {
    /// Value and slope.
    nodes: Vec<[f64; 2]>,
}

impl Struck {
    fn of([spring, branch, dashpot]: [f64; 3]) -> Self {
        let slopes =
            |[x, v, f]: [f64; 3]| [v, -(spring * x + f) / MASS, branch * v - branch / dashpot * f];
        let mut state = [0.0, SPEED, 0.0];
        let mut nodes = Vec::new();
        for _ in 0..6000 {
            let [x, v, f] = state;
            let rate = slopes(state);
            nodes.push([(spring * x + f) / MASS, (spring * v + rate[2]) / MASS]);
            if nodes.len() > 10 && spring * x + f <= 0.0 {
                break;
            }
            let at = |by: f64, rate: [f64; 3]| [0, 1, 2].map(|i| state[i] + by * STEP * rate[i]);
            let two = slopes(at(0.5, rate));
            let three = slopes(at(0.5, two));
            let four = slopes(at(1.0, three));
            state = [0, 1, 2].map(|i| {
                state[i] + STEP / 6.0 * (rate[i] + 2.0 * two[i] + 2.0 * three[i] + four[i])
            });
        }
        Self { nodes }
    }
}

impl Curve for Struck {
    fn value(&self, time: f64) -> f64 {
        let place = time / STEP;
        if place < 0.0 || place >= (self.nodes.len() - 1) as f64 {
            return 0.0;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a position among the nodes"
        )]
        let at = place as usize;
        let (part, [one, other]) = (place.fract(), [self.nodes[at], self.nodes[at + 1]]);
        let (square, cube) = (part * part, part * part * part);
        let value = one[0] * (2.0 * cube - 3.0 * square + 1.0)
            + STEP * one[1] * (cube - 2.0 * square + part)
            + other[0] * (3.0 * square - 2.0 * cube)
            + STEP * other[1] * (cube - square);
        value.max(0.0)
    }

    fn peak(&self) -> (f64, f64) {
        let all = self.nodes.iter().enumerate();
        let most = all.max_by(|one, other| one.1[0].total_cmp(&other.1[0])).unwrap();
        (STEP * most.0 as f64, most.1[0])
    }
}

fn class(class: f64) -> (Cfc, Padding) {
    (Cfc::new(class).unwrap(), Padding::Odd)
}

/// 60 ms of it at 20 kHz through a filter, by a clock and a zero that are off.
fn recorded(seed: u64, filter: (Cfc, Padding)) -> Test {
    let mut stream = Stream::new(seed);
    let truth = Struck::of(PAD);
    let late = 0.02 + 5e-5 * stream.share();
    let times: Vec<f64> = (0..1200).map(|at| f64::from(at) / RATE).collect();
    let samples = times.iter().map(|t| truth.value(t - late) + 7.0 + NOISE * normal(&mut stream));
    let samples: Vec<f64> = samples.collect();
    let passed = filter.0.filter(&samples, RATE, filter.1).unwrap();
    let rows = times.into_iter().zip(passed).collect();
    Test { rows, is_shifted: true, is_offset: true, filter: Some(filter), ..Test::default() }
}

fn fitted(test: &Test, is_robust: bool) -> NetworkFit {
    let model = |_: usize, own: &[f64]| -> Result<Box<dyn Curve>, String> {
        Ok(Box::new(Struck::of([own[0], own[1], own[2]])))
    };
    fitted_to(test, is_robust, &model)
}

fn fitted_to(test: &Test, is_robust: bool, model: &Model<'_>) -> NetworkFit {
    let numbers = PAD.map(|own| Number { low: own / 10.0, high: own * 10.0, start: own * 1.3 });
    let settings = NetworkSettings { starts: 1, seed: 1, is_robust, profile: Profile::WhereNeeded };
    fit(&numbers, std::slice::from_ref(test), settings, model).unwrap()
}

/// By what part each number is off.
fn off(own: &NetworkFit) -> Vec<f64> {
    own.numbers.iter().zip(PAD).map(|(own, truth)| own.value / truth - 1.0).collect()
}

#[test]
fn a_filter_in_the_model_gives_back_the_pad_that_is_lost_without_it() {
    let test = recorded(1, class(180.0));
    let with = fitted(&test, true);
    let without = fitted(&Test { filter: None, ..test.clone() }, false);
    println!("with the filter {:?}, without {:?}", off(&with), off(&without));
    for (own, truth) in with.numbers.iter().zip(PAD) {
        let [low, high] = own.ends.map(Option::unwrap);
        let deviation = (high / low).ln() / (2.0 * with.quantile);
        assert!((own.value / truth).ln().abs() < 2.5 * deviation, "{own:?}");
        assert!((own.value / truth - 1.0).abs() < 0.03, "{own:?}");
    }
    assert!((with.tests[0].noise / NOISE - 1.0).abs() < 0.25, "{}", with.tests[0].noise);
    let [spring, branch, _] = off(&without)[..] else { panic!() };
    assert!((-0.25..-0.15).contains(&spring), "{spring}");
    assert!((-0.5..-0.35).contains(&branch), "{branch}");
}

/// How many intervals of each number hold the truth, of so many tests.
fn covered(runs: u64, of: impl Fn(u64) -> NetworkFit) -> [u64; 3] {
    let mut covered = [0; 3];
    for seed in 0..runs {
        let own = of(seed);
        for (at, (own, truth)) in own.numbers.iter().zip(PAD).enumerate() {
            let [low, high] = own.ends.map(Option::unwrap);
            covered[at] += u64::from((low..=high).contains(&truth));
        }
    }
    covered
}

#[test]
fn intervals_behind_a_filter_cover_the_truth() {
    let all = covered(60, |seed| fitted(&recorded(1000 + seed, class(180.0)), true));
    // 93 % of 60, less two standard deviations.
    assert!(all.iter().all(|own| *own >= 52), "{all:?}");
}

/// `cargo test -p dashpot -p dashpot-fit --lib full_coverage -- --ignored --nocapture`
#[test]
#[ignore = "a minute: by hand"]
fn full_coverage() {
    let with = covered(500, |seed| fitted(&recorded(seed, class(180.0)), true));
    println!("with the covariance of the filter {with:?} of 500");
    assert!(with.iter().all(|own| *own >= 465), "{with:?}");
}

/// What the filter makes of it, as a curve: samples at the rate of the record, and cubics between.
struct Passed {
    samples: Vec<f64>,
    peak: (f64, f64),
}

/// Samples of it before time zero.
const BEFORE: usize = 400;

impl Passed {
    fn of(own: &Struck, (cfc, padding): (Cfc, Padding)) -> Self {
        let times = (0..1600).map(|at| (f64::from(at) - BEFORE as f64) / RATE);
        let samples: Vec<f64> = times.map(|t| own.value(t)).collect();
        Self { samples: cfc.filter(&samples, RATE, padding).unwrap(), peak: own.peak() }
    }
}

impl Curve for Passed {
    fn value(&self, time: f64) -> f64 {
        let place = (time * RATE + BEFORE as f64).clamp(1.0, 1500.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a position among the samples"
        )]
        let at = place as usize;
        let part = place.fract();
        let [before, here, next, far] =
            [-1, 0, 1, 2].map(|by: isize| self.samples[at.saturating_add_signed(by)]);
        // The cubic of Catmull and Rom.
        let [slope, bend] = [next - before, 2.0 * before - 5.0 * here + 4.0 * next - far];
        let turn = 3.0 * (here - next) + far - before;
        here + 0.5 * part * (slope + part * (bend + part * turn))
    }

    fn peak(&self) -> (f64, f64) {
        self.peak
    }
}

/// Filtered samples, each counted as one of its own, with the filter in the model.
#[test]
#[ignore = "a minute: by hand"]
fn coverage_of_white_intervals() {
    let mut covered = [0; 3];
    let filter = class(180.0);
    let model = |_: usize, own: &[f64]| -> Result<Box<dyn Curve>, String> {
        Ok(Box::new(Passed::of(&Struck::of([own[0], own[1], own[2]]), filter)))
    };
    for seed in 0..500 {
        let test = Test { filter: None, ..recorded(seed, filter) };
        let own = fitted_to(&test, false, &model);
        for (at, off) in off(&own).iter().enumerate() {
            let variance = own.determined[(at, at)] / own.correlation;
            covered[at] += u64::from(off.ln_1p().abs() < 1.96 * variance.sqrt());
        }
    }
    println!("as if samples were independent {covered:?} of 500");
    assert!(covered.iter().all(|own| *own < 250), "{covered:?}");
}
