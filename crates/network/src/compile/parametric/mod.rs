//! Networks of one form whose numbers differ: compiled once, and instantiated with the numbers of each.
//!
//! The form is taken from the same graph and the same choice of unknowns as in a compilation. What is
//! left to do for other numbers is to add up forces and to eliminate massless bodies in an order that
//! is known: star–mesh with positive numbers only, as in [`mesh`](super::mesh), but in single digits.
//!
//! What is not linear in the unknowns stands behind them in slots of their own: one holds the number 1 where
//! constant forces act, each law that is not linear has one for its force, and a face that springs alone hold one for
//! its speed. So everything else of the system stays linear.

mod assembled;
mod curve;
mod fingerprint;
mod first_phases;
mod instance;
mod reading;
mod released;

use std::collections::BTreeMap;

use self::{
    curve::Curve,
    fingerprint::{Fingerprint, fingerprint},
    first_phases::FirstPhases,
};
pub use self::{curve::CurveRow, instance::Instance};
use super::{
    bodies::{Bodies, Role},
    scales::{Drives, Scales},
    structure::Structure,
    unknowns::{self, Inputs},
};
use crate::{Network, NodeId};

/// A spring, a dashpot, or a law that is not linear, between two bodies.
#[derive(Debug, Clone)]
struct Part {
    ends: [usize; 2],
    /// Where its constant, or the first number of its law, stands among the numbers.
    number: usize,
    kind: PartKind,
    /// Its deformation over the unknowns; no other factors than 1 and −1.
    deformation: Vec<(usize, f64)>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PartKind {
    Spring,
    Dashpot,
    /// Its force stands in this slot.
    Curve(usize),
}

impl Part {
    fn is_dashpot(&self) -> bool {
        self.kind == PartKind::Dashpot
    }
}

/// A massless body whose velocity follows from the dashpots at it.
#[derive(Debug, Clone)]
struct Eliminated {
    body: usize,
    /// The bodies that it is linked with when its turn comes, and whether theirs is still to come.
    neighbours: Vec<(usize, bool)>,
}

/// An unknown that is a position, counted from that of another body, or from the ground.
#[derive(Debug, Clone, Copy)]
struct Placed {
    unknown: usize,
    body: usize,
    parent: Option<usize>,
}

/// A body with mass.
#[derive(Debug, Clone, Copy)]
struct Weighed {
    body: usize,
    /// Its velocity.
    unknown: usize,
    /// Where its mass, its start velocity and the constant force on it stand among the numbers.
    numbers: [usize; 3],
}

/// The form of a network of springs, dashpots, laws of the deformation and masses that one of them strikes,
/// as it is until what strikes is let go.
///
/// It covers networks that are at rest but for one impactor, which touches a single element: no loads, layers
/// or given motions, no place that springs alone hold but a face that has been let go, no other effects than constant forces on masses and
/// the opening of that element.
#[derive(Debug, Clone)]
pub struct ParametricSystem {
    fingerprint: Fingerprint,
    bodies: usize,
    parts: Vec<Part>,
    /// The laws that are not linear, in the order of their slots.
    curves: Vec<Curve>,
    eliminated: Vec<Eliminated>,
    placed: Vec<Placed>,
    weighed: Vec<Weighed>,
    /// SI value of the dimensionless value 1 of each unknown and slot.
    scales: Vec<f64>,
    /// Number of unknowns.
    unknowns: usize,
    /// The slot of the number 1, where constant forces act.
    one: Option<usize>,
    /// The slot of the speed of the face, where springs alone hold it.
    sprung: Option<usize>,
    /// Whether what strikes is let go for good where the force falls to zero.
    opens: bool,
    time: f64,
    /// Number of the element that the impactor touches.
    element: usize,
    impactor: NodeId,
    /// The body of the impactor, and of what it touches.
    face: usize,
    /// Where the mass of the impactor's body stands among the numbers.
    mass: usize,
    /// Parts whose forces add up to that of the element.
    force: Vec<usize>,
    /// The element's deformation over the unknowns.
    deformation: Vec<(usize, f64)>,
    numbers: usize,
}

impl ParametricSystem {
    /// The form of a network for runs of about `duration` \[s\]; `None` where it is of another kind, or
    /// cannot be compiled.
    pub fn of(network: &Network, duration: f64) -> Option<Self> {
        let first = FirstPhases::of(network)?;
        let bodies = Bodies::of(&first.network, &first.expansion).ok()?;
        let fingerprint = fingerprint(&first)?;
        let structure = Structure::of(&first.network, &first.expansion, &bodies, duration).ok()?;
        if (0..structure.clusters.len()).any(|cluster| structure.is_algebraic(cluster)) {
            return None;
        }
        let mut inputs = Inputs::default();
        let scales = Scales::of(&bodies, &structure, &Drives::default(), duration, false).ok()?;
        let places = unknowns::choose(
            &first.network,
            &first.expansion,
            &bodies,
            &structure,
            &scales,
            &BTreeMap::new(),
            &mut inputs,
        );
        Self::assembled(&first, fingerprint, &bodies, &structure, &scales, &places)
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
        if fingerprint(&first)? != self.fingerprint || first.forces.is_empty() != self.one.is_none()
        {
            return None;
        }
        self.numbers_of(&first, &Bodies::of(&first.network, &first.expansion).ok()?)
    }

    fn numbers_of(&self, first: &FirstPhases<'_>, bodies: &Bodies) -> Option<Vec<f64>> {
        let mut numbers = Vec::with_capacity(self.numbers);
        let mut curves = self.curves.iter();
        for primitive in &first.expansion.primitives {
            let [a, b] = primitive.ends.map(|joint| bodies.of_joint[joint]);
            if a == b {
                continue;
            }
            if primitive.is_nonlinear() {
                curves.next()?.read(primitive, &mut numbers)?;
            } else {
                let [stiffness, damping] = primitive.slopes();
                numbers.push(stiffness + damping);
            }
        }
        for own in &self.weighed {
            let body = &bodies.all[own.body];
            let Role::Mass(mass) = body.role else { return None };
            let own = |node: &NodeId| bodies.of_joint[node.0] == own.body;
            let force = first.forces.iter().filter(|force| own(&force.0)).map(|force| force.1);
            numbers.extend([mass, body.velocity, force.sum()]);
        }
        let is_usable = numbers.iter().all(|number| number.is_finite());
        (is_usable && numbers.len() == self.numbers).then_some(numbers)
    }
}
