//! Random impacts: the methods against the exact solution.

use dashpot_network::{
    Model, Network, Node,
    elements::{Dashpot, Spring},
    part,
};

use super::super::*;
use crate::{
    MeasureWish, Solve,
    measures::{EndVelocity, Hic},
};

/// A reproducible stream of numbers (splitmix64).
struct Stream(u64);

impl Stream {
    #[expect(clippy::cast_precision_loss, reason = "53 bits fit")]
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / 2.0_f64.powi(53)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.share())
    }
}

fn model(stream: &mut Stream, depth: u32, stiffness: f64, damping: f64) -> Model {
    if depth == 0 || stream.share() < 0.3 {
        let factor = stream.between(1e-2, 1e2);
        return if stream.share() < 0.5 {
            part(Spring { stiffness: factor * stiffness })
        } else {
            part(Dashpot { damping: factor * damping })
        };
    }
    let count = if stream.share() < 0.5 { 2 } else { 3 };
    let branches: Vec<Model> =
        (0..count).map(|_| model(stream, depth - 1, stiffness, damping)).collect();
    if stream.share() < 0.5 { Model::series(branches) } else { Model::parallel(branches) }
}

/// A mass on a random pad, on a random support or on the ground, and a duration.
fn impact(stream: &mut Stream) -> (Network, f64) {
    let mut network = Network::new();
    let (mass, stiffness) = (stream.between(1e-2, 1e3), stream.between(1e2, 1e8));
    let omega = (stiffness / mass).sqrt();
    let damping = stiffness / omega;
    let velocity = stream.between(0.1, 100.0);
    let head = network.add_node(Node::mass("head", mass).moving(velocity));
    let mut behind = network.ground();
    if stream.share() < 0.6 {
        behind = network.add_node(Node::mass("panel", mass * stream.between(0.1, 100.0)));
        let mount = Model::parallel([
            part(Spring { stiffness: stiffness * stream.between(1e-2, 1e2) }),
            part(Dashpot { damping: damping * stream.between(1e-2, 10.0) }),
        ]);
        let ground = network.ground();
        network.connect("mount", behind, ground, mount);
    }
    network.connect("pad", head, behind, model(stream, 3, stiffness, damping));
    (network, stream.between(1.0, 30.0) / omega)
}

/// Shares of each error in its bar, for all measures of `count` impacts.
fn shares(seed: u64, count: usize, method: &str) -> Vec<f64> {
    let mut stream = Stream(seed);
    let mut shares = Vec::new();
    for _ in 0..count {
        let (network, duration) = impact(&mut stream);
        let mut settings = SolveSettings::lasting(duration);
        settings.measures.push(MeasureWish::new("head", EndVelocity::default()));
        settings.measures.push(MeasureWish::new("head", Hic::default()));
        let exact = network.solve_with(&settings.clone().by_name("exact").unwrap()).unwrap();
        let other = network.solve_with(&settings.by_name(method).unwrap()).unwrap();
        for measure in &other.measures {
            let judge = exact.measure(&measure.key).unwrap();
            let (found, value) = match (measure.value, judge.value) {
                (Some(found), Some(value)) => (found, value),
                (None, None) => continue,
                _ => {
                    let is_said = measure.error.is_some_and(f64::is_infinite);
                    shares.push(if is_said { 0.0 } else { f64::INFINITY });
                    continue;
                }
            };
            let beyond = (found - value).abs() - judge.error.unwrap();
            let share = beyond.max(0.0) / measure.error.unwrap();
            assert!(share < 10.0, "{share} bars: {measure:?}\nagainst {judge:?}\nof {network:?}");
            shares.push(share);
        }
    }
    shares
}

#[test]
fn bars_hold_in_99_of_100_random_impacts() {
    for (method, count) in [("bdf", 150), ("tr-bdf2", 40), ("esdirk34", 40)] {
        let shares = shares(2024, count, method);
        let outside = shares.iter().filter(|&&share| share > 1.0).count();
        assert!(100 * outside <= shares.len(), "{method}: {outside} of {}", shares.len());
    }
}
