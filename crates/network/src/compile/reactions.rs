//! Forces in rigid links, from the balance of what hangs on one side.

use std::collections::{BTreeMap, HashSet};

use super::{
    Parts,
    acting::add_forces,
    bodies::Role,
    row::{Row, RowSum},
};
use crate::{Network, Support, elements::Law};

/// The force of each primitive that is a rigid link, by its number, if it is determined: the link must
/// be the only way between its sides, and one side must be free of supports.
pub(super) fn rigid_forces(network: &Network, parts: &Parts<'_>) -> BTreeMap<usize, Row> {
    let primitives = &parts.expansion.primitives;
    let mut forces = BTreeMap::new();
    let links: Vec<usize> =
        (0..primitives.len()).filter(|&at| primitives[at].law == Law::Rigid).collect();
    if links.is_empty() {
        return forces;
    }
    let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); parts.expansion.joints];
    for &link in &links {
        let [a, b] = primitives[link].ends;
        neighbours[a].push((b, link));
        neighbours[b].push((a, link));
    }
    for &link in &links {
        let [a, b] = primitives[link].ends;
        let first = side(&neighbours, a, link);
        if first.contains(&b) {
            continue;
        }
        let is_held = |side: &[usize]| {
            side.iter().any(|&joint| {
                network.nodes.get(joint).is_some_and(|node| node.support != Support::Free)
            })
        };
        if !is_held(&first) {
            forces.insert(link, balance(network, parts, &first, 1.0));
            continue;
        }
        let second = side(&neighbours, b, link);
        if !is_held(&second) {
            forces.insert(link, balance(network, parts, &second, -1.0));
        }
    }
    forces
}

fn side(neighbours: &[Vec<(usize, usize)>], from: usize, cut: usize) -> Vec<usize> {
    let mut reached = vec![from];
    let mut known = HashSet::from([from]);
    let mut at = 0;
    while at < reached.len() {
        for &(next, link) in &neighbours[reached[at]] {
            if link != cut && known.insert(next) {
                reached.push(next);
            }
        }
        at += 1;
    }
    reached
}

/// `sign` times the force that the rest must take from these joints: what acts on them less what
/// accelerates them.
fn balance(network: &Network, parts: &Parts<'_>, joints: &[usize], sign: f64) -> Row {
    let mut sum = RowSum::default();
    let own: HashSet<usize> = joints.iter().copied().collect();
    let body = parts.bodies.of_joint[joints[0]];
    add_forces(parts, joints, sign, &mut sum);
    for drive in parts.acting.drives(parts.drives, body) {
        if let Some(force) = drive.force.as_ref().filter(|_| own.contains(&drive.node)) {
            sum.add(sign, force);
        }
    }
    let mass: f64 =
        joints.iter().filter_map(|&joint| network.nodes.get(joint)).map(|node| node.mass).sum();
    match (parts.bodies.all[body].role, parts.places.acceleration_of(body)) {
        (Role::Mass(_), Some(acceleration)) => sum.add(-sign * mass, &acceleration),
        (Role::Prescribed(_), _) if mass > 0.0 => {
            let share = mass / parts.bodies.all[body].whole_mass;
            let own = parts.acting.drives(parts.drives, body);
            let given = own.filter(|own| own.force.is_none());
            given.for_each(|own| sum.add(-sign * share, &own.inertia));
        }
        _ => {}
    }
    sum.total()
}
