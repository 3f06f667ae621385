//! Gravity.

use dashpot_dae::Waveform;
use dashpot_units::STANDARD_GRAVITY;

use super::{Effect, EffectKind};
use crate::{
    Influence, Network, NodeId, Situation, Start, choices, network::start_velocity, parameters,
};

parameters! {
    /// Uniform gravity along the axis, positive towards the support: every mass feels `m g`.
    ///
    /// | symbol | field          | unit | range |
    /// |--------|----------------|------|-------|
    /// | `g`    | `acceleration` | m/s² | finite; negative pulls away from the support |
    ///
    /// # Limits
    ///
    /// It is the same everywhere and at all times, and it acts along the axis only. Deformations are
    /// counted from unloaded. A weight that no spring carries to a fixed or moved node has no balance,
    /// and is refused with the start in equilibrium. Elements have no weight; the mass of
    /// [layers](crate::layers::Layers) has.
    ///
    /// # References
    ///
    /// `cgpm1901` in `docs/references.bib` for the standard value 9.80665 m/s²; group A of `thesis` for
    /// when it matters.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Gravity: "gravity", "every mass feels m g, positive towards the support" {
        /// gravitational acceleration g [m/s^2]
        pub acceleration as "value": f64 = Quantity(Dimension::ACCELERATION), default "1 g0";
        /// whether parts without start speed begin in balance or unloaded
        pub start: GravityStart = Choice(GravityStart::WORDS), default "equilibrium";
    }
    sample { acceleration: STANDARD_GRAVITY, start: GravityStart::Equilibrium }
}

choices! {
    /// How parts without start speed begin under gravity.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum GravityStart {
        /// In balance under their weight; deformations are counted from unloaded.
        Equilibrium = "equilibrium",
        /// Unloaded: they begin to sag at t = 0.
        Unloaded = "unloaded",
    }
}

impl Effect for Gravity {
    fn body_forces(&self, network: &Network) -> Vec<(NodeId, Waveform)> {
        network
            .nodes()
            .filter(|(_, node)| node.mass > 0.0)
            .map(|(id, node)| (id, Waveform::constant(node.mass * self.acceleration)))
            .collect()
    }

    fn starts_in_balance(&self) -> bool {
        self.start == GravityStart::Equilibrium
    }

    fn gravity(&self) -> Option<f64> {
        Some(self.acceleration)
    }

    fn influences(&self, situation: &Situation<'_>) -> Vec<Influence> {
        if situation.falls {
            return vec![Influence::new("its share of the fall", 1.0)];
        }
        let g = self.acceleration.abs();
        if let Some(impact) = &situation.impact {
            let length = if impact.thickness.is_some() { "δ" } else { "y" };
            let formula = format!("A = g {length}/V0²");
            let value = g * impact.length() / impact.speed.powi(2);
            return vec![Influence::new(formula, value)];
        }
        let network = situation.network;
        let drive = network
            .connections()
            .iter()
            .map(|connection| situation.drive_without_weight(connection));
        let drive = drive.fold(0.0, f64::max);
        let weight = network.nodes().map(|(_, node)| node.mass * g).sum::<f64>();
        if drive > 0.0 && drive.is_finite() {
            vec![Influence::new("Σ m g/F", weight / drive)]
        } else {
            vec![Influence::new("its share of what acts", 1.0)]
        }
    }

    fn leave(&self, network: &mut Network) {
        for at in 0..network.nodes.len() {
            let start = network.nodes[at].start;
            if matches!(start, Start::Drop(_)) {
                network.nodes[at].start = Start::Velocity(start_velocity(network, start));
            }
        }
    }
}

impl EffectKind for Gravity {
    fn would_be(_situation: &Situation<'_>) -> Vec<Self> {
        vec![Self { acceleration: STANDARD_GRAVITY, start: GravityStart::Equilibrium }]
    }
}
