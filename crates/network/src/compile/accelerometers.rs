//! What accelerometers on nodes read.

use std::collections::BTreeMap;

use super::{
    bodies::Role,
    parts::Parts,
    row::{Row, RowSum},
};
use crate::{Network, Support};

/// Accelerometers on the nodes of a network; what is the same all over a body is found once.
#[derive(Debug, Default)]
pub(super) struct Accelerometers {
    /// By the number of each body of several joints that has been asked for.
    bodies: BTreeMap<usize, Shared>,
}

/// What all nodes of a body share.
#[derive(Debug, Clone, Default)]
struct Shared {
    /// The forces that an accelerometer feels \[N\].
    contact: Row,
    /// The sum of the body forces \[N\].
    weight: Row,
    /// Mass times given acceleration \[N\].
    inertia: Row,
    /// How many of the nodes have mass.
    heavy: usize,
}

impl Accelerometers {
    /// What an accelerometer on the node reads: its acceleration less the body force per mass. `None` on a node
    /// without mass, and on one that is fixed.
    pub(super) fn row(&mut self, network: &Network, parts: &Parts<'_>, node: usize) -> Option<Row> {
        let mass = network.nodes[node].mass;
        if mass <= 0.0 || network.nodes[node].support == Support::Fixed {
            return None;
        }
        let body = parts.bodies.of_joint[node];
        let is_known = match parts.bodies.all[body].role {
            Role::Mass(_) | Role::Prescribed(_) => true,
            Role::Fixed => parts.expansion.switches,
            Role::Massless => false,
        };
        if !is_known {
            return None;
        }
        if parts.bodies.all[body].joints.len() == 1 {
            return Some(Shared::of(network, parts, body).row(parts, (node, mass)));
        }
        let shared = self.bodies.entry(body).or_insert_with(|| Shared::of(network, parts, body));
        Some(shared.row(parts, (node, mass)))
    }
}

impl Shared {
    fn of(network: &Network, parts: &Parts<'_>, body: usize) -> Self {
        let (mut weight, mut inertia) = (RowSum::default(), RowSum::default());
        for drive in parts.incidence.drives(parts.drives, body) {
            match &drive.force {
                Some(force) if drive.is_body_force => weight.add(1.0, force),
                Some(_) => {}
                None => inertia.add(1.0, &drive.inertia),
            }
        }
        let is_free = matches!(parts.bodies.all[body].role, Role::Mass(_));
        let nodes = parts.bodies.all[body].joints.iter().filter_map(|&at| network.nodes.get(at));
        Self {
            contact: if is_free { parts.contact_force(body) } else { Row::default() },
            weight: weight.total(),
            inertia: inertia.total(),
            heavy: nodes.filter(|node| node.mass > 0.0).count(),
        }
    }

    /// On a node whose motion is given, or that a closed contact holds to such a body, the acceleration is that of
    /// the body.
    fn row(&self, parts: &Parts<'_>, (node, mass): (usize, f64)) -> Row {
        let body = &parts.bodies.all[parts.bodies.of_joint[node]];
        let mut sum = RowSum::default();
        if let Role::Mass(total) = body.role {
            sum.add(1.0 / total, &self.contact);
            if self.heavy == 1 {
                return sum.total();
            }
            sum.add(1.0 / total, &self.weight);
        } else if body.whole_mass > 0.0 {
            sum.add(1.0 / body.whole_mass, &self.inertia);
        }
        let own = parts.incidence.drives_at(parts.drives, node).filter(|own| own.is_body_force);
        own.filter_map(|own| own.force.as_ref()).for_each(|force| sum.add(-1.0 / mass, force));
        sum.total()
    }
}
