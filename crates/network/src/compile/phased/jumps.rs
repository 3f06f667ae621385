//! Motions that jump, and the contacts that would jump with them.

use super::is_contact;
use crate::{
    Network, NetworkError, NetworkErrors, Support,
    compile::{bodies::Bodies, expand::Expansion, structure::jumps},
};

/// Refuses motions that jump where contacts jump with them: what a jump passes through cannot be
/// told. Bodies with mass stay where they are at that instant, so that contacts beyond them do not
/// notice.
pub(super) fn through_contacts(
    network: &Network,
    expansion: &Expansion,
    (parts, apart): (&[usize], &Bodies),
    duration: f64,
) -> Result<(), NetworkErrors> {
    let contacts: Vec<[usize; 2]> = parts
        .iter()
        .map(|&at| &expansion.primitives[at])
        .filter(|own| own.origin.phases().is_some_and(is_contact))
        .map(|own| own.ends.map(|joint| apart.of_joint[joint]))
        .collect();
    let jumping = network.nodes.iter().enumerate().filter_map(|(at, node)| match &node.support {
        Support::Prescribed(motion) if !contacts.is_empty() => {
            let mut times = jumps(network, motion, duration).into_iter();
            // Where it begins away from zero, the state begins there as well.
            let time = times.find(|&time| time > 0.0)?;
            let moved = moved_at_once(expansion, apart, apart.of_joint[at]);
            let is_moved = contacts.iter().flatten().any(|&end| moved[end]);
            is_moved.then(|| NetworkError::StepThroughContact { node: node.name.clone(), time })
        }
        _ => None,
    });
    let errors: Vec<NetworkError> = jumping.collect();
    if errors.is_empty() { Ok(()) } else { Err(NetworkErrors(errors)) }
}

/// The bodies whose place may jump with that of `body`: those without mass that it is joined to.
fn moved_at_once(expansion: &Expansion, apart: &Bodies, body: usize) -> Vec<bool> {
    let mut moved = vec![false; apart.all.len()];
    let mut neighbours = vec![Vec::new(); apart.all.len()];
    for primitive in &expansion.primitives {
        let [a, b] = primitive.ends.map(|joint| apart.of_joint[joint]);
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    moved[body] = true;
    let mut pending = vec![body];
    while let Some(own) = pending.pop() {
        for &next in &neighbours[own] {
            if !moved[next] && apart.all[next].is_massless() {
                moved[next] = true;
                pending.push(next);
            }
        }
    }
    moved
}
