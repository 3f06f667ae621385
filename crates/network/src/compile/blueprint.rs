//! Networks of one form whose numbers differ: compiled once, and stamped with the numbers of each.
//!
//! The form is taken from the same graph and the same choice of unknowns as in a compilation. What is
//! left to do for other numbers is to add up forces and to eliminate massless bodies in an order that
//! is known: star–mesh with positive numbers only, as in [`mesh`](super::mesh), but in single digits.

use std::collections::BTreeMap;

use dashpot_dae::small::Square;

use super::{
    bodies::{Bodies, Role},
    expand::{Expansion, Shape},
    row::Combination,
    scales::{Drives, Scales},
    structure::Structure,
    unknowns::{self, Inputs, Places},
    validate,
};
use crate::{Network, NodeId, Support, elements::Law};

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

/// What tells the form of one network from that of another.
#[derive(Debug, Clone, PartialEq)]
struct Fingerprint {
    parts: Vec<([usize; 2], u8)>,
    roles: Vec<u8>,
    of_joint: Vec<usize>,
    names: Vec<String>,
}

/// The form of a network of springs, dashpots and masses that one of them strikes.
///
/// It covers networks that are linear and at rest but for one impactor, which touches a single
/// element: no loads, effects, layers or given motions, and no place that springs alone hold.
#[derive(Debug, Clone)]
pub struct Blueprint {
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

/// The system of one network: `ż = A z` in dimensionless time, padded with zeros to `N` unknowns.
#[derive(Debug, Clone)]
pub struct Stamp<const N: usize> {
    /// `A` by its columns.
    pub matrix: Square<N>,
    /// The unknowns at the start.
    pub start: [f64; N],
    /// Force \[N\] of the element that is struck, over the unknowns.
    pub force: [f64; N],
    /// Its deformation \[m\] over the unknowns.
    pub deformation: [f64; N],
    net: Vec<[f64; N]>,
    velocity: Vec<[f64; N]>,
    conductance: Vec<f64>,
    weights: Vec<f64>,
}

impl Blueprint {
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
        let is_usable = numbers.iter().all(|own| own.is_finite());
        (is_usable && numbers.len() == self.numbers).then_some(numbers)
    }

    /// Room for systems of this form; `None` where they have more than `N` unknowns.
    pub fn stamp<const N: usize>(&self) -> Option<Stamp<N>> {
        if self.states() > N {
            return None;
        }
        let links = self.eliminated.iter().map(|own| own.neighbours.len()).sum();
        let mut deformation = [0.0; N];
        self.deformation.iter().for_each(|&(at, sign)| deformation[at] = sign * self.scales[at]);
        Some(Stamp {
            matrix: [[0.0; N]; N],
            start: [0.0; N],
            force: [0.0; N],
            deformation,
            net: vec![[0.0; N]; self.bodies],
            velocity: vec![[0.0; N]; self.bodies],
            conductance: vec![0.0; self.bodies * self.bodies],
            weights: vec![0.0; links],
        })
    }

    /// Writes the system with these [`numbers`](Self::numbers) into a stamp. Nothing is allocated.
    ///
    /// # Panics
    ///
    /// When the stamp or the numbers are those of another form.
    pub fn fill<const N: usize>(&self, numbers: &[f64], stamp: &mut Stamp<N>) {
        self.add_springs(numbers, stamp);
        self.solve_dashpots(stamp);
        self.add_dashpots(numbers, stamp);
        for own in &self.placed {
            let mut row = stamp.velocity[own.body];
            if let Some(parent) = own.parent {
                subtract(&mut row, &stamp.velocity[parent]);
            }
            self.set_row(stamp, own.unknown, 1.0, &row);
        }
        for own in &self.weighed {
            let [mass, velocity] = own.numbers.map(|at| numbers[at]);
            let row = stamp.net[own.body];
            self.set_row(stamp, own.unknown, mass.recip(), &row);
            stamp.start[own.unknown] = velocity / self.scales[own.unknown];
        }
        let mut force = [0.0; N];
        for &at in &self.force {
            let part = &self.parts[at];
            let constant = numbers[part.number];
            if part.is_dashpot {
                let [a, b] = part.ends;
                add(&mut force, constant, &stamp.velocity[a]);
                add(&mut force, -constant, &stamp.velocity[b]);
            } else {
                part.deformation.iter().for_each(|&(at, sign)| force[at] += constant * sign);
            }
        }
        for ((own, value), scale) in stamp.force.iter_mut().zip(force).zip(&self.scales) {
            *own = value * scale;
        }
    }

    fn add_springs<const N: usize>(&self, numbers: &[f64], stamp: &mut Stamp<N>) {
        stamp.net.fill([0.0; N]);
        stamp.conductance.fill(0.0);
        stamp.velocity.fill([0.0; N]);
        for own in &self.weighed {
            stamp.velocity[own.body][own.unknown] = 1.0;
        }
        for part in &self.parts {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            if part.is_dashpot {
                stamp.conductance[a * self.bodies + b] += constant;
                stamp.conductance[b * self.bodies + a] += constant;
            } else {
                for &(at, sign) in &part.deformation {
                    stamp.net[a][at] -= constant * sign;
                    stamp.net[b][at] += constant * sign;
                }
            }
        }
    }

    /// The velocities of the massless bodies.
    fn solve_dashpots<const N: usize>(&self, stamp: &mut Stamp<N>) {
        let count = self.bodies;
        let mut first = 0;
        for Eliminated { body, neighbours } in &self.eliminated {
            let star = body * count;
            let total: f64 = neighbours.iter().map(|own| stamp.conductance[star + own.0]).sum();
            let load = stamp.net[*body];
            for (at, &(other, waits)) in neighbours.iter().enumerate() {
                let weight = stamp.conductance[star + other] / total;
                stamp.weights[first + at] = weight;
                if waits {
                    add(&mut stamp.net[other], weight, &load);
                }
                for &(next, _) in &neighbours[at + 1..] {
                    let link = weight * stamp.conductance[star + next];
                    stamp.conductance[other * count + next] += link;
                    stamp.conductance[next * count + other] += link;
                }
            }
            first += neighbours.len();
            add(&mut stamp.velocity[*body], total.recip(), &load);
        }
        for Eliminated { body, neighbours } in self.eliminated.iter().rev() {
            first -= neighbours.len();
            let mut sum = stamp.velocity[*body];
            for (at, &(other, _)) in neighbours.iter().enumerate() {
                add(&mut sum, stamp.weights[first + at], &stamp.velocity[other]);
            }
            stamp.velocity[*body] = sum;
        }
    }

    /// What the dashpots do to the masses.
    fn add_dashpots<const N: usize>(&self, numbers: &[f64], stamp: &mut Stamp<N>) {
        for part in self.parts.iter().filter(|part| part.is_dashpot) {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            let mut rate = stamp.velocity[a];
            subtract(&mut rate, &stamp.velocity[b]);
            add(&mut stamp.net[a], -constant, &rate);
            add(&mut stamp.net[b], constant, &rate);
        }
    }

    fn set_row<const N: usize>(
        &self,
        stamp: &mut Stamp<N>,
        unknown: usize,
        factor: f64,
        row: &[f64; N],
    ) {
        let factor = factor * self.time / self.scales[unknown];
        let columns = stamp.matrix.iter_mut().zip(row).zip(&self.scales);
        columns.for_each(|((column, value), scale)| column[unknown] = value * scale * factor);
    }
}

/// What is alone in a list.
fn only<T>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.next().is_none().then_some(first)
}

#[inline]
fn add<const N: usize>(sum: &mut [f64; N], factor: f64, row: &[f64; N]) {
    sum.iter_mut().zip(row).for_each(|(own, other)| *own += factor * other);
}

#[inline]
fn subtract<const N: usize>(sum: &mut [f64; N], row: &[f64; N]) {
    sum.iter_mut().zip(row).for_each(|(own, other)| *own -= other);
}

/// The form of a network; `None` where it has anything but springs, dashpots and rigid links between
/// free and fixed nodes, or is not valid.
fn fingerprint(network: &Network, expansion: &Expansion) -> Option<Fingerprint> {
    let is_plain = network.connections.iter().all(|own| own.layers.is_none());
    if !is_plain || !validate::faults(network, expansion).is_empty() {
        return None;
    }
    let word = |law: Law| match law {
        Law::Spring(constant) if constant > 0.0 => Some(0),
        Law::Dashpot(constant) if constant > 0.0 => Some(1),
        Law::Rigid => Some(2),
        _ => None,
    };
    let parts = expansion.primitives.iter().map(|own| Some((own.ends, word(own.law)?)));
    let roles = network.nodes.iter().map(|node| match node.support {
        Support::Free => Some(u8::from(node.mass > 0.0) + 2 * u8::from(node.is_impactor())),
        Support::Fixed => Some(4),
        Support::Prescribed(_) => None,
    });
    Some(Fingerprint {
        parts: parts.collect::<Option<_>>()?,
        roles: roles.collect::<Option<_>>()?,
        of_joint: network.connections.iter().flat_map(|own| own.between.map(|end| end.0)).collect(),
        names: network.connections.iter().map(|own| own.name.clone()).collect(),
    })
}

/// The difference of the places of two bodies over the unknowns; `None` where it is not one of whole
/// positions.
fn difference(places: &Places, [a, b]: [usize; 2]) -> Option<Vec<(usize, f64)>> {
    let row = places.position[a].plus(-1.0, &places.position[b]);
    if !row.inputs.is_zero() {
        return None;
    }
    Some(row.unknowns.terms().iter().map(|&(at, factor)| (at, factor.high())).collect())
}

/// Parts whose forces add up to that of a connection: of a series the member of the fewest parts,
/// springs before dashpots.
fn force_parts(
    shapes: &[Shape],
    number_of: &[Option<usize>],
    parts: &[Part],
) -> Option<Vec<usize>> {
    let mut found: Vec<Option<Vec<usize>>> = vec![None; shapes.len()];
    for (at, shape) in shapes.iter().enumerate().rev() {
        found[at] = match shape {
            Shape::Leaf(primitive) => number_of[*primitive].map(|part| vec![part]),
            Shape::Parallel(children) => {
                let all: Option<Vec<&Vec<usize>>> =
                    children.iter().map(|&child| found[child].as_ref()).collect();
                all.map(|all| all.into_iter().flatten().copied().collect())
            }
            Shape::Series(children) => {
                let known = children.iter().filter_map(|&child| found[child].clone());
                known.min_by_key(|own| {
                    let dashpots = own.iter().filter(|&&part| parts[part].is_dashpot).count();
                    (dashpots, own.len())
                })
            }
            Shape::Row(_) => None,
        };
    }
    found.into_iter().next().flatten()
}

/// The order in which massless bodies are eliminated: the one with the fewest links first.
fn order(bodies: usize, structure: &Structure, parts: &[Part]) -> Vec<Eliminated> {
    let mut links = vec![vec![false; bodies]; bodies];
    for part in parts.iter().filter(|part| part.is_dashpot) {
        let [a, b] = part.ends;
        (links[a][b], links[b][a]) = (true, true);
    }
    let mut waits: Vec<bool> = (0..bodies).map(|at| structure.cluster_of[at].is_some()).collect();
    let mut order = Vec::new();
    while let Some(body) = (0..bodies)
        .filter(|&at| waits[at])
        .min_by_key(|&at| links[at].iter().filter(|own| **own).count())
    {
        waits[body] = false;
        let star: Vec<usize> = (0..bodies).filter(|&other| links[body][other]).collect();
        for &a in &star {
            links[a][body] = false;
            for &b in star.iter().filter(|&&b| b != a) {
                links[a][b] = true;
            }
        }
        let neighbours = star.into_iter().map(|other| (other, waits[other])).collect();
        order.push(Eliminated { body, neighbours });
    }
    order
}
