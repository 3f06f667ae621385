//! Forces in rigid links, from the balance of what hangs on one side.

use std::collections::BTreeMap;

use super::{
    bodies::Role,
    parts::Parts,
    row::{Combination, Row, RowSum},
    sides::{Sides, Sum},
};
use crate::{Network, Support, elements::Law};

/// What acts on joints of one body from outside of it, and what they weigh.
#[derive(Debug, Clone, Default)]
struct Share {
    /// Forces of springs, dashpots and drives \[N\].
    force: Row,
    /// Sum of the masses \[kg\].
    mass: f64,
    /// Whether any of the joints has a support.
    is_held: bool,
}

impl Sum for Share {
    fn plus(&self, other: &Self) -> Self {
        Self {
            force: self.force.plus(1.0, &other.force),
            mass: self.mass + other.mass,
            is_held: self.is_held || other.is_held,
        }
    }
}

/// The force of each primitive that is a rigid link, by its number, if it is determined: the link must
/// be the only way between its sides, and one side must be free of supports.
pub(super) fn rigid_forces(network: &Network, parts: &Parts<'_>) -> BTreeMap<usize, Row> {
    let primitives = parts.expansion.primitives.iter().enumerate();
    let links: Vec<(usize, [usize; 2])> = primitives
        .filter(|(_, own)| own.law == Law::Rigid)
        .map(|(at, own)| (at, own.ends))
        .collect();
    if links.is_empty() {
        return BTreeMap::new();
    }
    let ends: Vec<[usize; 2]> = links.iter().map(|link| link.1).collect();
    let sides = Sides::of(&ends, |joint| share(network, parts, joint));
    let force = |(at, &(link, [joint, _])): (usize, &(usize, [usize; 2]))| {
        let [first, second] = sides.of_link(at)?;
        let body = parts.bodies.of_joint[joint];
        let free = [(first, 1.0), (second, -1.0)].into_iter().find(|(side, _)| !side.is_held);
        free.map(|(side, sign)| (link, balance(parts, body, side, sign)))
    };
    links.iter().enumerate().filter_map(force).collect()
}

/// What acts on a joint.
fn share(network: &Network, parts: &Parts<'_>, joint: usize) -> Share {
    let mut force = RowSum::default();
    parts.add_forces(&[joint], 1.0, &mut force);
    let drives = parts.incidence.drives_at(parts.drives, joint);
    drives.filter_map(|drive| drive.force.as_ref()).for_each(|own| force.add(1.0, own));
    let node = network.nodes.get(joint);
    Share {
        force: force.total(),
        mass: node.map_or(0.0, |node| node.mass),
        is_held: node.is_some_and(|node| node.support != Support::Free),
    }
}

/// `sign` times the force that the rest must take from a share of a body: what acts on it less what accelerates it.
fn balance(parts: &Parts<'_>, body: usize, share: &Share, sign: f64) -> Row {
    let mut sum = RowSum::default();
    sum.add(sign, &share.force);
    match (parts.bodies.all[body].role, parts.places.acceleration_of(body)) {
        (Role::Mass(_), Some(acceleration)) => sum.add(-sign * share.mass, &acceleration),
        (Role::Prescribed(_), _) if share.mass > 0.0 => {
            let part = share.mass / parts.bodies.all[body].whole_mass;
            let own = parts.incidence.drives(parts.drives, body);
            let given = own.filter(|own| own.force.is_none());
            given.for_each(|own| sum.add(-sign * part, &own.inertia));
        }
        _ => {}
    }
    sum.total()
}
