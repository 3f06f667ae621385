//! Static creep: how far a cushion is pressed in by a weight that stays on it.
//!
//! The force is put on at once and stays; the answer of the cushion's law is in closed form where it is linear, `σ J(t)`
//! with its creep compliance, and a solution in steps elsewhere. A model creeps as long as it has a branch that is slow
//! enough: beyond its slowest retardation time it stands still, and a real foam does not.

use dashpot_analysis::rheometer::{Answer, Drive, Specimen};
use dashpot_network::Network;

use super::{NoCushion, Platen};

/// Tolerances of two solutions, the difference of which is the error of the better one.
const TOLERANCES: [f64; 2] = [1e-6, 1e-8];
/// Of a law that is not linear the slowest time is that after which a part `e^−N` of the creep is left …
const LEFT: f64 = 1e-2;
/// … counted from this part of the longest time.
const FIRST: f64 = 1e-9;
/// Halvings of the ratio of two times.
const HALVINGS: usize = 60;

dashpot_units::words! {
    /// Whether a compression is one that the model knows.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Trust, pub fn word(self) {
        /// It is within the times of the model.
        Within = "within",
        /// The model has no branch so slow: the cushion stands still in it, a real one creeps on.
        BeyondTimes = "beyond-times",
        /// The cushion is pressed by more than its thickness.
        PressedThrough = "pressed-through",
    }
}

/// The compression under a weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Creep {
    /// The static stress \[Pa\].
    pub stress: f64,
    /// After each time \[s\] the compression in parts of the thickness, its error, and whether the model knows it.
    pub crept: Vec<(f64, f64, f64, Trust)>,
    /// The slowest retardation time of the model \[s\]; none where it does not creep.
    pub slowest: Option<f64>,
}

impl Creep {
    /// Under a static stress \[Pa\], after times \[s\] that rise, of the pad in a network with the thickness of the scene.
    pub(super) fn of(
        network: &Network,
        platen: &Platen,
        stress: f64,
        times: &[f64],
    ) -> Result<Self, NoCushion> {
        let no_creep = |reason: String| NoCushion::NoCreep { pad: platen.pad.clone(), reason };
        let pad = network.connections().iter().find(|own| own.name == platen.pad);
        let pad = pad.ok_or_else(|| no_creep("it is not in the scene".to_owned()))?;
        let (force, end) = (stress * platen.area, times.iter().copied().fold(0.0, f64::max));
        let answers = TOLERANCES.map(|tolerance| {
            Answer::to(&pad.model, Drive::Force, &[(0.0, force), (end, force)], (tolerance, true))
        });
        let [Ok(coarse), Ok(fine)] = answers else {
            let why = answers.into_iter().find_map(Result::err).map(|own| own.to_string());
            return Err(no_creep(why.unwrap_or_default()));
        };
        let specimen = Specimen::new(&pad.model).map_err(|error| no_creep(error.to_string()))?;
        let slowest = match specimen.linear() {
            Some(_) => specimen.retardation_times().last().copied(),
            None => slowest(&fine, end),
        };
        let crept = times.iter().map(|&time| {
            let strain = fine.value(time) / platen.thickness;
            let error = (strain - coarse.value(time) / platen.thickness).abs();
            let trust = match slowest {
                _ if strain >= 1.0 => Trust::PressedThrough,
                Some(slowest) if time <= slowest => Trust::Within,
                _ => Trust::BeyondTimes,
            };
            (time, strain, error, trust)
        });
        Ok(Self { stress, crept: crept.collect(), slowest })
    }
}

/// The slowest time of a creep that has been solved: after `τ ln 100` one percent of it is left.
fn slowest(answer: &Answer, end: f64) -> Option<f64> {
    let [first, last] = [FIRST * end, end].map(|own| answer.value(own));
    let left = |time: f64| (last - answer.value(time)) / (last - first);
    let is_creep = last - first > LEFT * LEFT * last;
    if !is_creep {
        return None;
    }
    let (mut low, mut high) = ((FIRST * end).ln(), end.ln());
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        *(if left(middle.exp()) > LEFT { &mut low } else { &mut high }) = middle;
    }
    Some(high.exp() / -LEFT.ln())
}

#[cfg(test)]
mod tests {
    use dashpot_network::{Model, Node, dashpot, spring};

    use super::*;

    fn crept(model: Model, stress: f64, times: &[f64]) -> Creep {
        let mut network = Network::new();
        let platen = network.add_node(Node::mass("platen", 8.0).dropped(0.6));
        let ground = network.ground();
        let pad = network.connect("pad", platen, ground, model);
        (pad.thickness, pad.area) = (Some(0.05), Some(0.04));
        let platen = Platen::of(&network, None, None).unwrap();
        Creep::of(&network, &platen, stress, times).unwrap()
    }

    #[test]
    fn the_creep_of_a_zener_cushion_is_its_compliance() {
        let (k, k1, c1) = (8e4, 1.2e5, 6e6);
        let times = [1.0, 60.0, 3600.0, 86_400.0];
        let own = crept(spring(k) | (spring(k1) + dashpot(c1)), 2e3, &times);
        // J(t) = 1/k − k1/(k (k + k1)) e^(−t/λ), λ = c1 (1/k + 1/k1).
        let delay = c1 * (1.0 / k + 1.0 / k1);
        assert!((own.slowest.unwrap() / delay - 1.0).abs() < 1e-9);
        for (time, strain, error, trust) in own.crept {
            let compliance = 1.0 / k - k1 / (k * (k + k1)) * (-time / delay).exp();
            let right = 2e3 * 0.04 * compliance / 0.05;
            assert!((strain / right - 1.0).abs() < 1e-9 + error, "{time}: {strain} {right}");
            let known = if time > delay { Trust::BeyondTimes } else { Trust::Within };
            assert_eq!(trust, known, "{time}");
        }
    }

    #[test]
    fn what_does_not_creep_says_so_and_what_flows_is_pressed_through() {
        let own = crept(spring(8e4), 2e3, &[60.0]);
        assert_eq!((own.slowest, own.crept[0].3), (None, Trust::BeyondTimes));
        assert!((own.crept[0].1 - 2e3 * 0.04 / 8e4 / 0.05).abs() < 1e-12);
        let own = crept(spring(8e4) + dashpot(1e5), 2e3, &[1.0, 3600.0]);
        assert_eq!(own.crept[1].3, Trust::PressedThrough);
    }
}
