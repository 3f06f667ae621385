//! Networks of one form whose numbers differ: compiled once, and instantiated with the numbers of each.
//!
//! The rows are [assembled](super::assemble) as those of any network, once, of numbers that are [traced](traced); what was
//! done with them is a [`Tape`], which does it again with the numbers of each network, in single digits. The graph, the choice of
//! unknowns, their scales and the order of elimination are those of the first network.
//!
//! What is not linear in the unknowns stands behind them in slots of their own: each law that is not linear has one for its
//! whole force, and one holds the number 1 where constant forces act. So everything else of the system stays linear.

mod assembled;
mod curve;
mod first_phases;
mod instance;
mod numbered;
mod parted;
mod tape;
#[cfg(test)]
mod tests;
mod traced;

use self::{
    curve::Curve,
    first_phases::FirstPhases,
    numbered::{Fingerprint, Numbered},
    tape::{Pattern, Tape},
};
pub use self::{curve::CurveRow, instance::Instance};
use super::{
    assemble::Graph,
    bodies::Bodies,
    scales::{Drives, Scales},
    structure::Structure,
};
use crate::{Network, NodeId};

/// A body with mass.
#[derive(Debug, Clone)]
struct Weighed {
    /// Its velocity.
    unknown: usize,
    /// Where the start velocity of the body stands that this is counted from.
    base: Option<usize>,
    /// Where its mass, its start velocity and the constant force on it stand among the numbers.
    numbers: [usize; 3],
}

/// The form of a network of springs, dashpots, laws of the deformation and masses that one of them strikes,
/// as it is until what strikes is let go.
///
/// It covers networks that are at rest but for one impactor, which touches a single element: no loads, layers
/// or given motions, no law at a place that has to be found with its force, no other effects than constant forces on masses and
/// the opening of that element.
#[derive(Debug, Clone)]
pub struct ParametricSystem {
    fingerprint: Fingerprint,
    tape: Tape,
    /// The rates of the unknowns.
    rates: Vec<Pattern>,
    /// The laws that are not linear, in the order of their slots.
    curves: Vec<Curve>,
    /// Where the constant of each spring stands among the numbers, and its deformation \[m\].
    springs: Vec<(usize, Pattern)>,
    weighed: Vec<Weighed>,
    /// SI value of the dimensionless value 1 of each unknown and slot.
    scales: Vec<f64>,
    /// Number of unknowns.
    unknowns: usize,
    /// The slot of the number 1, where constant forces act.
    one: Option<usize>,
    /// Whether what strikes is let go for good where the force falls to zero.
    opens: bool,
    time: f64,
    /// Number of the element that the impactor touches.
    element: usize,
    impactor: NodeId,
    /// Where the mass of the impactor's body stands among the numbers.
    mass: usize,
    /// The force of the element \[N\].
    force: Pattern,
    /// Its deformation \[m\].
    deformation: Pattern,
    /// The velocity of the impactor's body \[m/s\].
    speed: Pattern,
}

impl ParametricSystem {
    /// The form of a network for runs of about `duration` \[s\]; `None` where it is of another kind, or
    /// cannot be compiled.
    pub fn of(network: &Network, duration: f64) -> Option<Self> {
        let first = FirstPhases::of(network)?;
        let bodies = Bodies::of(&first.network, &first.expansion).ok()?;
        let numbered = Numbered::of(&first, &bodies)?;
        let FirstPhases { network, expansion, .. } = &first;
        let structure = Structure::of(network, expansion, &bodies, duration).ok()?;
        let scales = Scales::of(&bodies, &structure, &Drives::default(), duration, false).ok()?;
        let graph = Graph { network, expansion, bodies, structure, scales };
        Self::assembled(&first, numbered, &graph)
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Number of unknowns and slots.
    pub fn states(&self) -> usize {
        self.scales.len()
    }

    /// Whether all of its laws are linear.
    pub fn is_linear(&self) -> bool {
        self.curves.is_empty()
    }

    /// Whether what strikes is let go where the force falls to zero; otherwise it is glued to the element.
    pub fn opens(&self) -> bool {
        self.opens
    }

    /// Seconds in one unit of dimensionless time \[s\].
    pub fn time_scale(&self) -> f64 {
        self.time
    }

    /// Position among the connections of the element that the impactor touches.
    pub fn element(&self) -> usize {
        self.element
    }

    /// The impactor.
    pub fn impactor(&self) -> NodeId {
        self.impactor
    }

    /// Mass \[kg\] of the impactor and all that moves with it, among the numbers of a network.
    pub fn impactor_mass(&self, numbers: &[f64]) -> f64 {
        numbers[self.mass]
    }

    /// The numbers of a network: constants of its springs \[N/m\] and dashpots \[N s/m\], the numbers of
    /// its other laws, masses \[kg\], start velocities \[m/s\] and constant forces \[N\]. `None` where it is
    /// of another form, or one of them is out of range.
    pub fn numbers(&self, network: &Network) -> Option<Vec<f64>> {
        let first = FirstPhases::of(network)?;
        let bodies = Bodies::of(&first.network, &first.expansion).ok()?;
        let own = Numbered::of(&first, &bodies)?;
        (own.fingerprint == self.fingerprint).then_some(own.values)
    }
}
