//! Networks of one form whose numbers differ: compiled once, and instantiated with the numbers of each.
//!
//! The form is taken from the same graph and the same choice of unknowns as in a compilation. What is
//! left to do for other numbers is to add up forces and to eliminate massless bodies in an order that
//! is known: star–mesh with positive numbers only, as in [`mesh`](super::mesh), but in single digits.

mod fingerprint;
mod instance;
mod reading;

use std::collections::BTreeMap;

pub use self::instance::Instance;
use self::{
    fingerprint::{Fingerprint, fingerprint},
    reading::{difference, force_parts, order},
};
use super::{
    bodies::{Bodies, Role},
    expand::Expansion,
    scales::{Drives, Scales},
    structure::Structure,
    unknowns::{self, Inputs, Places},
};
use crate::{Network, NodeId, elements::Law};

/// A spring or dashpot between two bodies.
#[derive(Debug, Clone)]
struct Part {
    ends: [usize; 2],
    /// Where its constant stands among the numbers.
    number: usize,
    is_dashpot: bool,
    /// Its deformation over the unknowns; no other factors than 1 and −1.
    deformation: Vec<(usize, f64)>,
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
    /// Where its mass and its start velocity stand among the numbers.
    numbers: [usize; 2],
}

/// The form of a network of springs, dashpots and masses that one of them strikes.
///
/// It covers networks that are linear and at rest but for one impactor, which touches a single
/// element: no loads, effects, layers or given motions, and no place that springs alone hold.
#[derive(Debug, Clone)]
pub struct ParametricSystem {
    fingerprint: Fingerprint,
    bodies: usize,
    parts: Vec<Part>,
    eliminated: Vec<Eliminated>,
    placed: Vec<Placed>,
    weighed: Vec<Weighed>,
    /// SI value of the dimensionless value 1 of each unknown.
    scales: Vec<f64>,
    time: f64,
    /// Number of the element that the impactor touches.
    element: usize,
    impactor: NodeId,
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
        if !network.loads.is_empty() || !network.effects.is_empty() {
            return None;
        }
        let expansion = Expansion::of(network);
        let fingerprint = fingerprint(network, &expansion)?;
        let bodies = Bodies::of(network, &expansion).ok()?;
        let structure = Structure::of(network, &expansion, &bodies, duration).ok()?;
        if (0..structure.clusters.len()).any(|cluster| structure.is_algebraic(cluster)) {
            return None;
        }
        let mut inputs = Inputs::default();
        let scales = Scales::of(&bodies, &structure, &Drives::default(), duration, false).ok()?;
        let places = unknowns::choose(
            network,
            &expansion,
            &bodies,
            &structure,
            &scales,
            &BTreeMap::new(),
            &mut inputs,
        );
        Self::assembled(network, &expansion, fingerprint, &bodies, &structure, &scales, &places)
    }

    fn assembled(
        network: &Network,
        expansion: &Expansion,
        fingerprint: Fingerprint,
        bodies: &Bodies,
        structure: &Structure,
        scales: &Scales,
        places: &Places,
    ) -> Option<Self> {
        let primitives = expansion.primitives.iter().enumerate();
        let mut number_of = vec![None; expansion.primitives.len()];
        let mut parts = Vec::new();
        for (at, primitive) in primitives {
            let ends = primitive.ends.map(|joint| bodies.of_joint[joint]);
            if ends[0] == ends[1] {
                continue;
            }
            number_of[at] = Some(parts.len());
            parts.push(Part {
                ends,
                number: parts.len(),
                is_dashpot: matches!(primitive.law, Law::Dashpot(_)),
                deformation: difference(places, ends)?,
            });
        }
        let (mut placed, mut weighed, mut numbers) = (Vec::new(), Vec::new(), parts.len());
        for (body, own) in bodies.all.iter().enumerate() {
            if let Some(unknown) = places.unknown[body] {
                placed.push(Placed { unknown, body, parent: places.parent[body] });
            }
            if places.velocity_base[body].is_some() {
                return None;
            }
            if let Some(unknown) = places.velocity[body] {
                weighed.push(Weighed { body, unknown, numbers: [numbers, numbers + 1] });
                numbers += 2;
            }
            let is_known = match own.role {
                Role::Fixed => places.unknown[body].is_none(),
                Role::Mass(_) | Role::Massless => places.unknown[body].is_some(),
                Role::Prescribed(_) => false,
            };
            if !is_known {
                return None;
            }
        }
        let impactor = only(network.nodes().filter(|(_, node)| node.is_impactor()))?.0;
        let struck = bodies.of_joint[impactor.0];
        let mass = weighed.iter().find(|own| own.body == struck)?.numbers[0];
        let touches = |at: usize| {
            network.connections[at].between.iter().any(|end| bodies.of_joint[end.0] == struck)
        };
        let element = only((0..network.connections.len()).filter(|&at| touches(at)))?;
        let connection = &network.connections[element];
        let ends = connection.between.map(|end| bodies.of_joint[end.0]);
        if ends[0] != struck || ends[0] == ends[1] || connection.never_pulls(0) {
            return None;
        }
        let force = force_parts(&expansion.shapes[element], &number_of, &parts)?;
        Some(Self {
            fingerprint,
            bodies: bodies.all.len(),
            eliminated: order(bodies.all.len(), structure, &parts),
            placed,
            weighed,
            scales: places.drafts.iter().map(|draft| draft.scale / scales.lift).collect(),
            time: scales.time,
            element,
            impactor,
            mass,
            force,
            deformation: difference(places, ends)?,
            parts,
            numbers,
        })
    }

    /// Number of unknowns.
    pub fn states(&self) -> usize {
        self.scales.len()
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

    /// The numbers of a network: constants of its springs \[N/m\] and dashpots \[N s/m\], masses \[kg\]
    /// and start velocities \[m/s\]. `None` where it is of another form, or one of them is out of range.
    pub fn numbers(&self, network: &Network) -> Option<Vec<f64>> {
        if !network.loads.is_empty() || !network.effects.is_empty() {
            return None;
        }
        let expansion = Expansion::of(network);
        if fingerprint(network, &expansion)? != self.fingerprint {
            return None;
        }
        let bodies = Bodies::of(network, &expansion).ok()?;
        let mut numbers = Vec::with_capacity(self.numbers);
        for primitive in &expansion.primitives {
            let [a, b] = primitive.ends.map(|joint| bodies.of_joint[joint]);
            if a != b {
                let [stiffness, damping] = primitive.slopes();
                numbers.push(stiffness + damping);
            }
        }
        for own in &self.weighed {
            let body = &bodies.all[own.body];
            let Role::Mass(mass) = body.role else { return None };
            numbers.extend([mass, body.velocity]);
        }
        let is_usable = numbers.iter().all(|number| number.is_finite());
        (is_usable && numbers.len() == self.numbers).then_some(numbers)
    }
}

/// What is alone in a list.
fn only<T>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.next().is_none().then_some(first)
}
