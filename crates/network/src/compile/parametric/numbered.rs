//! The numbers of a network, and what tells its form from that of another.

use std::{
    collections::BTreeMap,
    mem::{Discriminant, discriminant},
};

use super::{curve::each_number, first_phases::FirstPhases};
use crate::{
    Support,
    compile::{
        bodies::{Bodies, Role},
        validate,
    },
    elements::Law,
    network::Connection,
    parameters::Value,
};

/// What tells the form of one network from that of another.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fingerprint {
    parts: Vec<([usize; 2], Discriminant<Law>)>,
    /// Kinds and values of laws that are not linear, with zeros in place of their numbers.
    laws: Vec<(&'static str, Vec<Value>)>,
    roles: Vec<u8>,
    pub(super) has_forces: bool,
    of_joint: Vec<usize>,
    names: Vec<String>,
}

/// The numbers of a network, and where they stand.
pub(super) struct Numbered {
    pub(super) fingerprint: Fingerprint,
    /// Constants of springs \[N/m\] and dashpots \[N s/m\], numbers of other laws, and for each mass this \[kg\], its start
    /// velocity \[m/s\] and the constant force on it \[N\].
    pub(super) values: Vec<f64>,
    /// The first one of each primitive.
    pub(super) of_primitive: Vec<usize>,
    /// The first one of each body with mass.
    pub(super) of_body: BTreeMap<usize, usize>,
}

impl Numbered {
    /// `None` where a network has anything but springs, dashpots, other laws and rigid links between free and fixed nodes, is
    /// not valid, or has numbers out of range.
    pub(super) fn of(first: &FirstPhases<'_>, bodies: &Bodies) -> Option<Self> {
        let FirstPhases { network, expansion, forces, .. } = first;
        let is_plain = network.connections.iter().all(|connection| connection.layers.is_none());
        let is_displaced = network.nodes.iter().any(|node| node.position != 0.0);
        if !is_plain || is_displaced || !validate::faults(network, expansion).is_empty() {
            return None;
        }
        let (mut parts, mut laws, mut values) = (Vec::new(), Vec::new(), Vec::new());
        let (mut of_primitive, mut of_body) = (Vec::new(), BTreeMap::new());
        for (at, primitive) in expansion.primitives.iter().enumerate() {
            of_primitive.push(values.len());
            match first.law(at)? {
                Law::Spring(constant) | Law::Dashpot(constant) if constant > 0.0 => {
                    values.push(constant);
                }
                Law::Rigid => {}
                Law::Nonlinear { .. } => {
                    let mut own = primitive.element.values();
                    each_number(&mut own, |number| values.push(std::mem::take(number)));
                    laws.push((primitive.element.kind(), own));
                }
                _ => return None,
            }
            parts.push((primitive.ends, discriminant(&primitive.law)));
        }
        for (at, body) in bodies.all.iter().enumerate() {
            let Role::Mass(mass) = body.role else { continue };
            of_body.insert(at, values.len());
            let own = forces.iter().filter(|force| bodies.of_joint[force.0.0] == at);
            values.extend([mass, body.velocity, own.map(|force| force.1).sum()]);
        }
        let roles = network.nodes.iter().map(|node| match node.support {
            Support::Free => Some(u8::from(node.mass > 0.0) + 2 * u8::from(node.is_impactor())),
            Support::Fixed => Some(4),
            Support::Prescribed(_) => None,
        });
        let ends = |connection: &Connection| connection.between.map(|end| end.0);
        let fingerprint = Fingerprint {
            parts,
            laws,
            roles: roles.collect::<Option<_>>()?,
            has_forces: !forces.is_empty(),
            of_joint: network.connections.iter().flat_map(ends).collect(),
            names: network.connections.iter().map(|own| own.name.clone()).collect(),
        };
        let is_usable = values.iter().all(|value| value.is_finite());
        is_usable.then_some(Self { fingerprint, values, of_primitive, of_body })
    }
}
