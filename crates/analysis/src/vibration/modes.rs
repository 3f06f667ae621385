//! Free oscillations: frequency, damping and shape.

use std::f64::consts::TAU;

use nalgebra::Complex;
use serde::Serialize;

use super::{Swing, Vibration, observed::Observed};

/// Distance from a pole at which the response is looked at, in parts of its size.
const NEAR: f64 = 1e-5;
/// Another distance tells the error.
const FARTHER: f64 = 4.0;
/// Where the next pole is within so many distances, the two shapes are mixed.
const APART: f64 = 1e3;

/// A free oscillation of the network with what drives it at rest.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mode {
    /// Its frequency \[Hz\] with its damping: `|Im s|/2π` of the pole s.
    pub frequency: f64,
    /// Damping ratio `ζ = −Re s/|s|` \[1\], from 0 to 1.
    pub damping_ratio: f64,
    /// The displacement of each mass relative to the largest, whose amplitude is 1 and phase 0; `None` where the drive
    /// does not excite the mode, or where its pole cannot be told from another one.
    pub shape: Option<Vec<Displacement>>,
}

/// What a mass does in a mode.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Displacement {
    /// The node.
    pub node: String,
    /// Its part of the oscillation \[1\].
    pub swing: Swing,
}

impl Vibration {
    /// The modes that oscillate, by rising frequency; none where the network has too many unknowns for its poles.
    ///
    /// The response near a pole is the mode's shape over the distance from it, plus what all else does. The difference
    /// of the responses on both sides is twice that shape, and a second difference tells its error.
    pub fn modes(&self) -> Vec<Mode> {
        let poles = self.poles().unwrap_or_default();
        let at = |own: &(f64, f64)| Complex::new(-own.1, own.0);
        let masses = self.masses();
        let mut modes: Vec<Mode> = poles
            .iter()
            .enumerate()
            .filter(|(_, own)| own.0 > 0.0)
            .map(|(place, own)| {
                let pole = at(own);
                let others = poles.iter().enumerate().filter(|other| other.0 != place);
                let is_alone = others
                    .flat_map(|(_, other)| [at(other), at(other).conj()])
                    .all(|other| (other - pole).norm() > APART * NEAR * pole.norm());
                Mode {
                    frequency: own.0 / TAU,
                    damping_ratio: own.1 / pole.norm(),
                    shape: is_alone.then(|| self.shape(pole, &masses)).flatten(),
                }
            })
            .collect();
        modes.sort_by(|one, other| one.frequency.total_cmp(&other.frequency));
        modes
    }

    /// The displacements of the masses that can move, one of each body.
    pub(super) fn masses(&self) -> Vec<Observed> {
        let nodes = &self.assembly.nodes;
        let is_first = |at: usize| {
            let alike =
                |other: usize| nodes[other].body == nodes[at].body && nodes[other].mass > 0.0;
            !(0..at).any(alike)
        };
        let is_seen = |at: usize| nodes[at].mass > 0.0 && !self.is_held(at) && is_first(at);
        let seen = self.ids().filter(|id| is_seen(id.index()));
        seen.map(|id| Observed::motion(&self.assembly, id, 0)).collect()
    }

    fn shape(&self, pole: Complex<f64>, masses: &[Observed]) -> Option<Vec<Displacement>> {
        let near = self.residues(pole, masses, NEAR)?;
        let farther = self.residues(pole, masses, FARTHER * NEAR)?;
        let size = |at: usize| near[at].norm();
        let at = (0..near.len()).max_by(|one, other| size(*one).total_cmp(&size(*other)))?;
        let most = |all: &[Complex<f64>]| all.iter().map(|own| own.norm()).fold(0.0, f64::max);
        // What the pole brings falls with the distance, all else rises.
        if most(&near) <= most(&farther) {
            return None;
        }
        let [one, other] = [near[at], farther[at]];
        let displacement =
            |((mass, near), farther): ((&Observed, &Complex<f64>), &Complex<f64>)| {
                let (value, again) = (near / one, farther / other);
                Displacement {
                    node: mass.name.clone(),
                    swing: Swing::of(value, (value - again).norm()),
                }
            };
        Some(masses.iter().zip(&near).zip(&farther).map(displacement).collect())
    }

    /// What each mass moves by on one side of a pole more than on the other, at this distance in parts of its size.
    fn residues(
        &self,
        pole: Complex<f64>,
        masses: &[Observed],
        distance: f64,
    ) -> Option<Vec<Complex<f64>>> {
        let step = distance * pole.norm();
        let [before, after] = [pole - step, pole + step].map(|rate| {
            let harmonic = self.at(rate)?;
            let found = masses.iter().map(|mass| Some(mass.at(&harmonic, rate)?.value));
            found.collect::<Option<Vec<Complex<f64>>>>()
        });
        Some(before?.into_iter().zip(after?).map(|(before, after)| after - before).collect())
    }
}
