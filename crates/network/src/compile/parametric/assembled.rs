//! How the form of a network comes about.

use std::iter::repeat_n;

use super::{
    Curve, ParametricSystem, Part, PartKind, Placed, Weighed,
    fingerprint::Fingerprint,
    first_phases::FirstPhases,
    reading::{difference, force_parts, order},
};
use crate::{
    NodeId,
    compile::{
        bodies::{Bodies, Role},
        scales::Scales,
        structure::Structure,
        unknowns::Places,
    },
    elements::Law,
};

impl ParametricSystem {
    /// The form of a network with its places; `None` where it is of another kind.
    pub(super) fn assembled(
        first: &FirstPhases<'_>,
        fingerprint: Fingerprint,
        bodies: &Bodies,
        structure: &Structure,
        scales: &Scales,
        places: &Places,
    ) -> Option<Self> {
        let unknowns = places.drafts.len();
        let one = (!first.forces.is_empty()).then_some(unknowns);
        let own = Parts::of(first, bodies, places, unknowns + usize::from(one.is_some()))?;
        let (placed, weighed, numbers) = moving(bodies, places, own.numbers)?;
        if one.is_some() && !(weighed.len() == 1 && first.forces_act_on_masses(bodies)) {
            return None;
        }
        let struck = Struck::of(first, bodies)?;
        let mass = weighed.iter().find(|own| own.body == struck.body)?.numbers[0];
        let shape = &first.expansion.shapes[struck.element];
        let of_unknowns = places.drafts.iter().map(|draft| draft.scale / scales.lift);
        let own = Self {
            fingerprint,
            bodies: bodies.all.len(),
            eliminated: order(
                (0..bodies.all.len()).map(|at| structure.cluster_of[at].is_some()).collect(),
                &own.all,
            ),
            placed,
            weighed,
            scales: of_unknowns.chain(repeat_n(1.0, own.slots - unknowns)).collect(),
            unknowns,
            one,
            sprung: None,
            opens: first.opens(),
            time: scales.time,
            element: struck.element,
            impactor: struck.impactor,
            face: struck.body,
            mass,
            force: force_parts(shape, &own.part_of, &own.all)?,
            deformation: difference(places, struck.ends)?,
            parts: own.all,
            curves: own.curves,
            numbers,
        };
        own.is_explicit().then_some(own)
    }
}

/// The parts of a form, their laws, and how many numbers and slots there are up to here.
struct Parts {
    all: Vec<Part>,
    /// The part that each primitive has become.
    part_of: Vec<Option<usize>>,
    curves: Vec<Curve>,
    numbers: usize,
    slots: usize,
}

impl Parts {
    /// The primitives between different bodies, with `slots` taken before.
    fn of(first: &FirstPhases<'_>, bodies: &Bodies, places: &Places, slots: usize) -> Option<Self> {
        let primitives = &first.expansion.primitives;
        let part_of = vec![None; primitives.len()];
        let mut own = Self { all: Vec::new(), part_of, curves: Vec::new(), numbers: 0, slots };
        for (at, primitive) in primitives.iter().enumerate() {
            let ends = primitive.ends.map(|joint| bodies.of_joint[joint]);
            if ends[0] == ends[1] {
                continue;
            }
            let part = own.all.len();
            own.part_of[at] = Some(part);
            let (kind, numbers) = match primitive.law {
                Law::Dashpot(_) => (PartKind::Dashpot, 1),
                Law::Nonlinear { .. } => {
                    let curve = Curve::of(primitive, part)?;
                    let numbers = curve.numbers();
                    own.curves.push(curve);
                    own.slots += 1;
                    (PartKind::Curve(own.slots - 1), numbers)
                }
                _ => (PartKind::Spring, 1),
            };
            let deformation = difference(places, ends)?;
            let number = own.numbers;
            own.all.push(Part { ends, number, kind, deformation });
            own.numbers += numbers;
        }
        Some(own)
    }
}

/// The bodies with an unknown position, those with mass, and how many numbers there are with theirs; `None`
/// where one moves otherwise.
fn moving(
    bodies: &Bodies,
    places: &Places,
    mut numbers: usize,
) -> Option<(Vec<Placed>, Vec<Weighed>, usize)> {
    let (mut placed, mut weighed) = (Vec::new(), Vec::new());
    for (body, own) in bodies.all.iter().enumerate() {
        let position = places.unknown[body];
        let is_known = match own.role {
            Role::Fixed => position.is_none(),
            Role::Mass(_) | Role::Massless => position.is_some(),
            Role::Prescribed(_) => false,
        };
        if !is_known || places.velocity_base[body].is_some() {
            return None;
        }
        if let Some(unknown) = position {
            placed.push(Placed { unknown, body, parent: places.parent[body] });
        }
        if let Some(unknown) = places.velocity[body] {
            weighed.push(Weighed { body, unknown, numbers: [numbers, numbers + 1, numbers + 2] });
            numbers += 3;
        }
    }
    Some((placed, weighed, numbers))
}

/// What strikes, and the element that it strikes.
struct Struck {
    impactor: NodeId,
    /// The body of the impactor.
    body: usize,
    element: usize,
    /// The bodies between which the element stands.
    ends: [usize; 2],
}

impl Struck {
    /// `None` where there are several, or the element opens otherwise than by letting go what strikes.
    fn of(first: &FirstPhases<'_>, bodies: &Bodies) -> Option<Self> {
        let network = &first.network;
        let impactor = only(network.nodes().filter(|(_, node)| node.is_impactor()))?.0;
        let body = bodies.of_joint[impactor.0];
        let ends_of =
            |element: usize| network.connections[element].between.map(|end| bodies.of_joint[end.0]);
        let touches = |&element: &usize| {
            let ends = ends_of(element);
            ends[0] != ends[1] && ends.contains(&body)
        };
        let element = only((0..network.connections.len()).filter(touches))?;
        let ends = ends_of(element);
        let never_pulls = network.connections[element].never_pulls(0);
        let is_covered = ends[0] == body && !never_pulls && first.opens_at(bodies, body);
        is_covered.then_some(Self { impactor, body, element, ends })
    }
}

/// What is alone in a list.
fn only<T>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.next().is_none().then_some(first)
}
