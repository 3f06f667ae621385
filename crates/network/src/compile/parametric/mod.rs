//! Networks of one form whose numbers differ: compiled once, and instantiated with the numbers of each.
//!
//! The form is taken from the same graph and the same choice of unknowns as in a compilation. What is
//! left to do for other numbers is to add up forces and to eliminate massless bodies in an order that
//! is known: star–mesh with positive numbers only, as in [`mesh`](super::mesh), but in single digits.
//!
//! What is not linear in the unknowns stands behind them in slots of their own: one holds the number 1 where
//! constant forces act, and each law that is not linear has one for its force. So everything else of the
//! system stays linear.

mod curve;
mod fingerprint;
mod first_phases;
mod instance;
mod reading;

use std::collections::BTreeMap;

use self::{
    curve::Curve,
    fingerprint::{Fingerprint, fingerprint},
    first_phases::FirstPhases,
    reading::{difference, force_parts, order},
};
pub use self::{curve::CurveRow, instance::Instance};
use super::{
    bodies::{Bodies, Role},
    scales::{Drives, Scales},
    structure::Structure,
    unknowns::{self, Inputs, Places},
};
use crate::{Network, NodeId, elements::Law};

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

/// What a part is.
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
/// or given motions, no place that springs alone hold, no other effects than constant forces on masses and
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
    /// Whether what strikes is let go for good where the force falls to zero.
    opens: bool,
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
        let first = FirstPhases::of(network)?;
        let fingerprint = fingerprint(&first)?;
        let bodies = Bodies::of(&first.network, &first.expansion).ok()?;
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

    fn assembled(
        first: &FirstPhases<'_>,
        fingerprint: Fingerprint,
        bodies: &Bodies,
        structure: &Structure,
        scales: &Scales,
        places: &Places,
    ) -> Option<Self> {
        let FirstPhases { network, expansion, forces, .. } = first;
        let unknowns = places.drafts.len();
        let one = (!forces.is_empty()).then_some(unknowns);
        let mut slots = unknowns + usize::from(one.is_some());
        let mut number_of = vec![None; expansion.primitives.len()];
        let (mut parts, mut curves, mut numbers) = (Vec::new(), Vec::new(), 0);
        for (at, primitive) in expansion.primitives.iter().enumerate() {
            let ends = primitive.ends.map(|joint| bodies.of_joint[joint]);
            if ends[0] == ends[1] {
                continue;
            }
            number_of[at] = Some(parts.len());
            let number = numbers;
            let kind = match primitive.law {
                Law::Dashpot(_) => PartKind::Dashpot,
                Law::Nonlinear { .. } => {
                    let curve = Curve::of(primitive, parts.len())?;
                    numbers += curve.numbers();
                    curves.push(curve);
                    slots += 1;
                    PartKind::Curve(slots - 1)
                }
                _ => PartKind::Spring,
            };
            numbers += usize::from(!matches!(kind, PartKind::Curve(_)));
            parts.push(Part { ends, number, kind, deformation: difference(places, ends)? });
        }
        let (mut placed, mut weighed) = (Vec::new(), Vec::new());
        for (body, own) in bodies.all.iter().enumerate() {
            if let Some(unknown) = places.unknown[body] {
                placed.push(Placed { unknown, body, parent: places.parent[body] });
            }
            if places.velocity_base[body].is_some() {
                return None;
            }
            if let Some(unknown) = places.velocity[body] {
                weighed.push(Weighed {
                    body,
                    unknown,
                    numbers: [numbers, numbers + 1, numbers + 2],
                });
                numbers += 3;
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
        // Others would sag, or be in balance.
        let acts_on_one = weighed.len() == 1
            && forces.iter().all(|force| match bodies.all[bodies.of_joint[force.0.0]].role {
                Role::Mass(_) | Role::Fixed => true,
                Role::Massless | Role::Prescribed(_) => false,
            });
        if !forces.is_empty() && !acts_on_one {
            return None;
        }
        let impactor = only(network.nodes().filter(|(_, node)| node.is_impactor()))?.0;
        let struck = bodies.of_joint[impactor.0];
        let mass = weighed.iter().find(|own| own.body == struck)?.numbers[0];
        let body_of = |end: NodeId| bodies.of_joint[end.0];
        let touches = |at: &usize| {
            let [a, b] = network.connections[*at].between.map(body_of);
            a != b && (a == struck || b == struck)
        };
        let element = only((0..network.connections.len()).filter(touches))?;
        let connection = &network.connections[element];
        let ends = connection.between.map(body_of);
        if ends[0] != struck || connection.never_pulls(0) || !first.opens_at(bodies, struck) {
            return None;
        }
        let force = force_parts(&expansion.shapes[element], &number_of, &parts)?;
        let of_unknowns = places.drafts.iter().map(|draft| draft.scale / scales.lift);
        let own = Self {
            fingerprint,
            bodies: bodies.all.len(),
            eliminated: order(bodies.all.len(), structure, &parts),
            placed,
            weighed,
            scales: of_unknowns.chain(std::iter::repeat_n(1.0, slots - unknowns)).collect(),
            unknowns,
            one,
            opens: first.opens(),
            time: scales.time,
            element,
            impactor,
            mass,
            force,
            deformation: difference(places, ends)?,
            parts,
            curves,
            numbers,
        };
        own.is_explicit().then_some(own)
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
        let bodies = Bodies::of(&first.network, &first.expansion).ok()?;
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

/// What is alone in a list.
fn only<T>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.next().is_none().then_some(first)
}
