//! Where parts without start speed stand in balance under the forces of the effects.

use std::collections::BTreeMap;

use super::{
    bodies::{Bodies, Groups, Role, joint_name},
    expand::Expansion,
    mesh::Mesh,
    structure::Structure,
};
use crate::{Network, NetworkError};

/// Displacement of each body \[m\] at the start, counted from unloaded.
///
/// Springs carry `weights` \[N\] (one for each body); dashpots carry nothing, and keep the place
/// of what only they hold. `given` is the displacement of bodies whose motion is prescribed.
///
/// # Errors
///
/// [`NetworkError::NoBalance`] for each part that would sink.
pub(super) fn positions(
    network: &Network,
    expansion: &Expansion,
    bodies: &Bodies,
    structure: &Structure,
    weights: &[f64],
    given: &[f64],
) -> Result<Vec<f64>, Vec<NetworkError>> {
    let count = bodies.all.len();
    let is_given = |body: usize| matches!(bodies.all[body].role, Role::Fixed | Role::Prescribed(_));
    let mut groups = Groups::new(count);
    let mut mesh = Mesh::<f64>::new(count);
    for spring in &structure.springs {
        groups.join(spring.ends[0], spring.ends[1]);
        mesh.link(spring.ends[0], spring.ends[1], spring.constant, &spring.offset);
    }
    let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for body in 0..count {
        mesh.load(body, 1.0, &weights[body]);
        members.entry(groups.of(body)).or_default().push(body);
    }
    let mut errors = Vec::new();
    let mut free = Vec::new();
    let mut values = given.to_vec();
    let mut is_placed = vec![false; count];
    for group in members.values() {
        let is_anchored = group.iter().any(|&body| is_given(body));
        if is_anchored {
            free.extend(group.iter().copied().filter(|&body| !is_given(body)));
            group.iter().for_each(|&body| is_placed[body] = true);
        } else if group.iter().any(|&body| weights[body] != 0.0) {
            let sinking = group
                .iter()
                .filter(|&&body| weights[body] != 0.0)
                .map(|&body| joint_name(network, expansion, bodies.all[body].joints[0]));
            errors.push(NetworkError::NoBalance { nodes: sinking.collect() });
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let solution = mesh.eliminate(&free, usize::MAX).solve(values.clone());
    for &body in &free {
        values[body] = *solution.value(body);
    }
    place_by_dashpots(structure, &mut groups, &members, &mut values, &mut is_placed);
    Ok(values)
}

/// Puts groups that no spring anchors where their dashpots are undeformed.
fn place_by_dashpots(
    structure: &Structure,
    groups: &mut Groups,
    members: &BTreeMap<usize, Vec<usize>>,
    values: &mut [f64],
    is_placed: &mut [bool],
) {
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); values.len()];
    for dashpot in &structure.dashpots {
        neighbours[dashpot.ends[0]].push(dashpot.ends[1]);
        neighbours[dashpot.ends[1]].push(dashpot.ends[0]);
    }
    let mut reached: Vec<usize> = (0..values.len()).filter(|&body| is_placed[body]).collect();
    while let Some(body) = reached.pop() {
        for &next in &neighbours[body] {
            if is_placed[next] {
                continue;
            }
            let group = groups.of(next);
            for &member in &members[&group] {
                values[member] = values[body];
                is_placed[member] = true;
                reached.push(member);
            }
        }
    }
}
