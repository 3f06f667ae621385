//! The scales of what happens to a network.

use std::f64::consts::TAU;

use super::{Connection, Network, NodeId};
use crate::model::{Model, depth, stiffness::Stiffness};

/// Rounds after which a frequency is settled: each at least halves the distance in decades.
const ROUNDS: usize = 64;

/// A network, how long it is looked at, and the scales of what happens to it.
#[derive(Debug, Clone)]
pub struct Situation<'n> {
    /// The network.
    pub network: &'n Network,
    /// Length of the run \[s\].
    pub duration: f64,
    /// The scales of the impact, where there is one on something that resists.
    pub impact: Option<ImpactScales>,
    /// The largest force of all loads together \[N\].
    pub load: f64,
    /// The largest force of all body forces of effects together \[N\].
    pub weight: f64,
    /// The largest displacement of all given motions together \[m\].
    pub motion: f64,
    /// Whether something falls before it touches.
    pub falls: bool,
}

/// The scales of an impact: that of the impactor with the largest energy.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactScales {
    /// The impactor.
    pub node: NodeId,
    /// Its mass `m1` \[kg\], > 0.
    pub mass: f64,
    /// Its speed `V0` \[m/s\], > 0.
    pub speed: f64,
    /// Positions of the connections that it strikes.
    pub struck: Vec<usize>,
    /// Stiffness `K` \[N/m\] of those at the frequency `√(K/m1)`.
    pub stiffness: f64,
    /// Thickness `δ` \[m\] of the thinnest of them that has one.
    pub thickness: Option<f64>,
}

impl ImpactScales {
    /// The time `√(m1/K)` \[s\].
    pub fn time(&self) -> f64 {
        (self.mass / self.stiffness).sqrt()
    }

    /// The force `V0 √(K m1)` \[N\].
    pub fn force(&self) -> f64 {
        self.speed * (self.stiffness * self.mass).sqrt()
    }

    /// The length `δ` \[m\], or without a thickness the depth `V0 √(m1/K)`.
    pub fn length(&self) -> f64 {
        self.thickness.unwrap_or_else(|| self.speed * self.time())
    }

    /// The time `J` \[s\]: [`length`](Self::length) over speed.
    pub fn passage(&self) -> f64 {
        self.length() / self.speed
    }
}

impl<'n> Situation<'n> {
    /// The depth \[m\] to which a connection is pressed in at most, as far as scales tell: `V0 √(m1/K)` by an impact,
    /// at which its spring would hold all of the energy (of a law that is not linear, the depth at which it has taken
    /// that up), `F/K` by forces, and the given motions. `None` where nothing acts on it, or nothing resists.
    pub fn depth(&self, connection: &Connection) -> Option<f64> {
        let struck = self.impact.as_ref().and_then(|impact| {
            let energy = 0.5 * impact.mass * impact.speed * impact.speed;
            if let Some(depth) = depth::at_energy(&connection.model, energy) {
                return Some(depth);
            }
            let omega = frequency(&[&connection.model], impact.mass)?;
            Some(impact.speed / omega)
        });
        let stiffness = self.stiffness(connection);
        let force = self.load + self.weight;
        let pressed = if force > 0.0 { force / stiffness } else { 0.0 };
        let depth = struck.unwrap_or(0.0) + pressed + self.motion;
        (depth > 0.0 && depth.is_finite()).then_some(depth)
    }

    /// The largest force \[N\] that loads and given motions make in a connection, as far as scales tell.
    pub fn drive_without_weight(&self, connection: &Connection) -> f64 {
        let pressed =
            if self.motion > 0.0 { self.stiffness(connection) * self.motion } else { 0.0 };
        self.load + pressed
    }

    /// The connections that the impactor strikes.
    pub fn struck(&self) -> impl Iterator<Item = &'n Connection> {
        let struck = self.impact.iter().flat_map(|own| &own.struck);
        struck.filter_map(|&at| self.network.connections.get(at))
    }

    /// Stiffness \[N/m\] of a connection at the frequency of one period in the run.
    fn stiffness(&self, connection: &Connection) -> f64 {
        Stiffness::of(&connection.model, TAU / self.duration).size()
    }
}

/// The frequency `√(K/mass)` \[rad/s\] on these models side by side, with their stiffness there.
pub(crate) fn frequency(models: &[&Model], mass: f64) -> Option<f64> {
    let mut omega = 1.0;
    for _ in 0..ROUNDS {
        let sizes = models.iter().map(|model| Stiffness::of(model, omega).size());
        omega = (sizes.sum::<f64>() / mass).sqrt();
        if !omega.is_normal() {
            return None;
        }
    }
    Some(omega)
}
