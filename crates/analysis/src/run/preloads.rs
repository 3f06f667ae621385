//! Preloads that nothing holds as a run begins.

use dashpot_network::{NodeOutputs, PrimitiveOutputs, elements::Law};

use crate::{
    Solution, Warning,
    energy::roles::is_elastic,
    impact::contacts::{self, Members},
};

/// Part of a preload that may be left unbalanced: rounding, and the errors of a start in balance.
const BALANCED: f64 = 1e-3;

/// Preloaded elements whose force moves what they lie between from the start, although nothing there does so.
///
/// Where a contact, a stop or a slider is at one of their ends it is for that to hold them.
pub(super) fn loose(solution: &Solution<'_>) -> Vec<Warning> {
    let assembly = solution.assembly();
    let preloaded = |part: &PrimitiveOutputs| {
        let own = part.element.as_ref();
        (own.law() == Law::Phased && is_elastic(own)).then(|| own.force(0.0, 0.0))
    };
    let mut found = Vec::new();
    if assembly.switching.is_none() || solution.trajectory().digest().is_some() {
        return found;
    }
    let members = Members::of(assembly);
    for connection in &assembly.connections {
        let parts = assembly.primitives.get(connection.primitives.clone()).unwrap_or_default();
        let push: f64 = parts.iter().filter_map(preloaded).sum();
        if push == 0.0 || connection.force.is_none_or(|force| !solution.keeps(force)) {
            continue;
        }
        let bodies = contacts::between(assembly, connection);
        let is_loose = |body: usize| {
            let left = unbalanced(solution, &members, body, (&connection.name, push));
            left.is_some_and(|left| left.abs() > BALANCED * push.abs())
        };
        let moved = bodies.into_iter().filter(|&body| is_loose(body));
        let moved = moved.filter_map(|body| members.nodes(assembly, body).next());
        if let Some(node) = moved.map(|node| node.name.clone()).next() {
            let element = connection.name.clone();
            found.push(Warning::LoosePreload { element, preload: push, node });
        }
    }
    found
}

/// Whether a node moves as a run begins: an impactor, or a support that is driven.
fn moves(solution: &Solution<'_>, node: &NodeOutputs) -> bool {
    let driven = node.velocity.filter(|&own| !node.free && solution.keeps(own));
    node.is_impactor() || driven.is_some_and(|own| solution.signal(own).value(0.0) != 0.0)
}

/// The force \[N\] that begins to move a body as a run begins, but for what moves there already; `None` of a body that
/// does not follow its forces, and where something switches that may hold it.
fn unbalanced(
    solution: &Solution<'_>,
    members: &Members,
    body: usize,
    (element, push): (&str, f64),
) -> Option<f64> {
    let assembly = solution.assembly();
    let node = members.nodes(assembly, body).find(|node| node.free && node.mass > 0.0)?;
    let velocity = solution.signal(node.velocity.filter(|&own| solution.keeps(own))?);
    let mut left = members.mass(body) * velocity.slope(0.0);
    for (connection, sign) in members.connections(assembly, body) {
        let parts = assembly.primitives.get(connection.primitives.clone()).unwrap_or_default();
        let switches = |part: &PrimitiveOutputs| {
            part.element.law() == Law::Phased && !is_elastic(&*part.element)
        };
        if parts.iter().any(switches) {
            return None;
        }
        let force =
            solution.signal(connection.force.filter(|&own| solution.keeps(own))?).value(0.0);
        if connection.between.iter().any(|end| moves(solution, &assembly.nodes[end.index()])) {
            let held_back = if connection.name == element { push } else { 0.0 };
            left -= sign * (force - held_back);
        }
    }
    Some(left)
}
