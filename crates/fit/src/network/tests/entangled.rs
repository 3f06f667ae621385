//! Random networks of which some numbers cannot be told apart: the structure knows them, and a fit of all numbers
//! gives what can be told.

use dashpot_network::{Model, Network, Node, dashpot, linear_model, spring};
use dashpot_numerics::Stream;
use dashpot_rheology::LinearModel;

use super::{normal, *};
use crate::structure::undetermined;

/// How springs and dashpots stand together.
#[derive(Debug)]
enum Shape {
    Spring,
    Dashpot,
    Series(Vec<Shape>),
    Parallel(Vec<Shape>),
}

impl Shape {
    fn random(stream: &mut Stream, depth: usize) -> Self {
        if depth == 0 || stream.share() < 0.25 {
            return if stream.share() < 0.6 { Self::Spring } else { Self::Dashpot };
        }
        let parts = (0..2 + stream.below(2)).map(|_| Self::random(stream, depth - 1)).collect();
        if stream.share() < 0.5 { Self::Series(parts) } else { Self::Parallel(parts) }
    }

    /// Constants that can be told from 0.5 s: 50 to 200 kN/m, and times of 10 to 100 ms beside them.
    fn constants(&self, stream: &mut Stream, all: &mut Vec<f64>) {
        let between =
            |stream: &mut Stream, low: f64, high: f64| low * (high / low).powf(stream.share());
        match self {
            Self::Spring => all.push(between(stream, 5e4, 2e5)),
            Self::Dashpot => all.push(1e5 * between(stream, 0.01, 0.1)),
            Self::Series(parts) | Self::Parallel(parts) => {
                parts.iter().for_each(|own| own.constants(stream, all));
            }
        }
    }

    fn model(&self, values: &mut impl Iterator<Item = f64>) -> Model {
        let mut join = |parts: &[Self], with: fn(Model, Model) -> Model| {
            let all: Vec<Model> = parts.iter().map(|own| own.model(&mut *values)).collect();
            all.into_iter().reduce(with).unwrap()
        };
        match self {
            Self::Series(parts) => join(parts, |one, other| one + other),
            Self::Parallel(parts) => join(parts, |one, other| one | other),
            Self::Spring => spring(values.next().unwrap()),
            Self::Dashpot => dashpot(values.next().unwrap()),
        }
    }

    fn of(&self, values: &[f64]) -> Model {
        self.model(&mut values.iter().copied())
    }

    fn network(&self, values: &[f64]) -> Network {
        let mut network = Network::new();
        let head = network.add_node(Node::mass("head", 4.0).moving(3.0));
        network.connect("pad", head, network.ground(), self.of(values));
        network
    }
}

/// The deformation under 1 kN.
struct Creep(LinearModel);

impl Curve for Creep {
    fn value(&self, time: f64) -> f64 {
        if time < 0.0 { 0.0 } else { 1e3 * self.0.creep(time) }
    }

    fn peak(&self) -> (f64, f64) {
        (0.5, self.value(0.5))
    }
}

fn creep(shape: &Shape, values: &[f64]) -> Box<dyn Curve> {
    Box::new(Creep(linear_model(&shape.of(values))))
}

/// Creep over 0.5 s, with noise of 10⁻⁴ of the largest deformation.
fn crept(shape: &Shape, truth: &[f64], stream: &mut Stream) -> Test {
    let curve = creep(shape, truth);
    let noise = 1e-4 * curve.peak().1;
    let times = (0..400).map(|at| 0.5 / 399.0 * f64::from(at));
    let rows = times.map(|t| (t, curve.value(t) + noise * normal(stream))).collect();
    Test { rows, noise: Some(noise), ..Test::default() }
}

#[test]
fn what_the_structure_calls_one_constant_is_found_as_one() {
    let (mut groups, mut right) = (0, 0);
    for seed in 0..250 {
        let mut stream = Stream::new(seed);
        let shape = Shape::random(&mut stream, 3);
        let mut truth = Vec::new();
        shape.constants(&mut stream, &mut truth);
        if !(2..=6).contains(&truth.len()) {
            continue;
        }
        let test = crept(&shape, &truth, &mut stream);
        let mut start = |own: &f64| own * 2_f64.powf(2.0 * stream.share() - 1.0);
        let numbers: Vec<Number> = truth
            .iter()
            .map(|own| Number { low: own / 1e3, high: own * 1e3, start: start(own) })
            .collect();
        let settings =
            NetworkSettings { starts: 4, seed, is_robust: false, profile: Profile::WhereNeeded };
        let model = |_: usize, own: &[f64]| Ok(creep(&shape, own));
        let own = fit(&numbers, &[test], settings, &model).unwrap();
        let values: Vec<f64> = own.numbers.iter().map(|own| own.value).collect();
        let (base, at_truth) = (shape.network(&values), shape.network(&truth));
        let moved: Vec<Network> = (0..values.len())
            .map(|at| {
                let mut moved = values.clone();
                moved[at] *= 1.001;
                shape.network(&moved)
            })
            .collect();
        for group in undetermined(&base, &moved) {
            let (found, wanted) = (group.constants(&base), group.constants(&at_truth));
            for (at, (found, wanted)) in found.iter().zip(&wanted).enumerate() {
                let by =
                    |moved: &Network| (group.constants(moved)[at] / found).ln() / 1e-3_f64.ln_1p();
                let gradient: Vec<f64> = moved.iter().map(by).collect();
                groups += 1;
                // Four and a half standard deviations.
                let Some(factor) = own.interval_of(&gradient) else { continue };
                let off = (found / wanted).ln().abs();
                assert!(
                    off <= 2.3 * factor.ln() + 1e-6,
                    "{seed} {shape:?} {found} {wanted} {factor}"
                );
                right += usize::from(off < 0.05);
            }
        }
    }
    println!("{right} of {groups} constants within 5 %");
    assert!(groups >= 30 && 10 * right >= 9 * groups, "{right} of {groups}");
}
