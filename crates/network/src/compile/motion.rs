//! Deformations, forces and velocities, and from them the rate of every unknown.

use dashpot_dae::UnknownKind;
use dashpot_twofold::Twofold;

use super::{
    bodies::{Bodies, Role},
    dashpots::DashpotBalance,
    expand::Primitive,
    row::{Combination, Row, RowSum},
    scales::Scales,
    springs::SpringBalance,
    structure::Structure,
    unknowns::{Inputs, Places},
};
use crate::elements::Law;

/// All that moves and pushes, in SI units.
#[derive(Debug, Clone, Default)]
pub(super) struct Motion {
    /// Position of each body.
    pub(super) position: Vec<Row>,
    /// Velocity of each body, where it does not depend on the rate of a kept algebraic unknown.
    pub(super) velocity: Vec<Option<Row>>,
    /// Deformation of each primitive that takes part.
    pub(super) deformation: Vec<Option<Row>>,
    /// Deformation rate of each primitive that takes part.
    pub(super) rate: Vec<Option<Row>>,
    /// Force of each primitive that takes part.
    pub(super) force: Vec<Option<Row>>,
}

/// Up to this many massless bodies in all, every balance is eliminated.
const SMALL: usize = 200;
/// Beyond, only places with at most this many links, and clusters of this many bodies, are.
const MOST_LINKS: usize = 16;

/// What the rows are built from.
pub(super) struct Given<'a> {
    pub(super) primitives: &'a [Primitive],
    /// What each primitive pushes with besides a linear spring's and dashpot's force \[N\]; it is
    /// among the loads.
    pub(super) pushes: &'a [Option<Row>],
    pub(super) bodies: &'a Bodies,
    pub(super) structure: &'a Structure,
    pub(super) scales: &'a Scales,
    /// Force on each body from outside \[N\].
    pub(super) loads: &'a [Row],
    /// Name of a body.
    pub(super) names: &'a dyn Fn(usize) -> String,
}

/// Builds all rows and completes the drafts of the unknowns.
pub(super) fn build(given: &Given<'_>, inputs: &mut Inputs, places: &mut Places) -> Motion {
    let Given { primitives, pushes, bodies, structure, scales, loads, names } = *given;
    let massless = structure.cluster_of.iter().flatten().count();
    let most = if massless <= SMALL { usize::MAX } else { MOST_LINKS };
    let mut motion = Motion {
        position: Vec::new(),
        velocity: known_velocities(bodies, places, inputs),
        deformation: vec![None; primitives.len()],
        rate: vec![None; primitives.len()],
        force: pushes.to_vec(),
    };

    let springs = SpringBalance::solve(structure, loads, most, places, inputs, |body| {
        (names(body), scales.length[body])
    });
    motion.position = (0..bodies.all.len()).map(|body| springs.position(places, body)).collect();
    let mut net: Vec<RowSum> = loads.iter().map(RowSum::from).collect();
    for spring in &structure.springs {
        let deformation =
            springs.difference(places, spring.ends).plus(1.0, &inputs.constant(spring.offset));
        let force = deformation.times(spring.constant);
        push_apart(&mut net, spring.ends, &force);
        motion.deformation[spring.primitive] = Some(deformation);
        add_to(&mut motion.force[spring.primitive], force);
    }

    let dashpots = DashpotBalance::solve(structure, &net, &motion.velocity, most, places, |body| {
        (names(body), scales.velocity[body])
    });
    cluster_velocities(structure, &dashpots, &mut motion);
    for dashpot in &structure.dashpots {
        let [a, b] = dashpot.ends;
        let rate = dashpots.rate(dashpot.ends).unwrap_or_else(|| {
            let velocity = |body: usize| motion.velocity[body].clone().unwrap_or_default();
            velocity(a).plus(-1.0, &velocity(b))
        });
        let force = rate.times(dashpot.constant);
        push_apart(&mut net, dashpot.ends, &force);
        motion.deformation[dashpot.primitive] = Some(
            springs.difference(places, dashpot.ends).plus(1.0, &inputs.constant(dashpot.offset)),
        );
        motion.rate[dashpot.primitive] = Some(rate);
        add_to(&mut motion.force[dashpot.primitive], force);
    }
    unknown_rates(bodies, &net, &dashpots, structure, &motion.velocity, places);
    derived_rates(structure, inputs, places, &mut motion);
    pushed(given, &springs, inputs, places, &mut motion);
    motion
}

fn add_to(sum: &mut Option<Row>, row: Row) {
    *sum = Some(match sum.take() {
        Some(sum) => sum.plus(1.0, &row),
        None => row,
    });
}

/// How what only pushes is deformed.
fn pushed(
    given: &Given<'_>,
    springs: &SpringBalance<'_>,
    inputs: &mut Inputs,
    places: &Places,
    motion: &mut Motion,
) {
    for (at, primitive) in given.primitives.iter().enumerate() {
        if motion.deformation[at].is_some() {
            continue;
        }
        let ends = primitive.ends.map(|joint| given.bodies.of_joint[joint]);
        let [a, b] = primitive.ends.map(|joint| given.bodies.offset[joint]);
        let offset = inputs.constant(a - b);
        if ends[0] == ends[1] && (a - b).abs() > 0.0 && primitive.law != Law::Rigid {
            // Held at a deformation, it pushes all the same.
            let [stiffness, _] = primitive.slopes();
            let force = if primitive.is_nonlinear() {
                inputs.constant(primitive.element.force(a - b, 0.0))
            } else {
                offset.times(stiffness)
            };
            motion.deformation[at] = Some(offset);
            motion.rate[at] = Some(Row::default());
            motion.force[at] = Some(force);
            continue;
        }
        if given.pushes[at].is_none() {
            continue;
        }
        motion.deformation[at] = Some(springs.difference(places, ends).plus(1.0, &offset));
        motion.rate[at] = match ends.map(|end| motion.velocity[end].as_ref()) {
            [Some(a), Some(b)] => Some(a.plus(-1.0, b)),
            _ => None,
        };
    }
}

fn push_apart(net: &mut [RowSum], [a, b]: [usize; 2], force: &Row) {
    net[a].add(-1.0, force);
    net[b].add(1.0, force);
}

fn known_velocities(bodies: &Bodies, places: &Places, inputs: &mut Inputs) -> Vec<Option<Row>> {
    let of = |(at, role): (usize, Role)| match role {
        Role::Fixed => Some(Row::default()),
        Role::Prescribed(_) => Some(inputs.rate(&places.position[at])),
        Role::Mass(_) => places.velocity_of(at),
        Role::Massless => None,
    };
    bodies.all.iter().map(|body| body.role).enumerate().map(of).collect()
}

/// Velocities of the bodies that dashpots tie to an anchor.
fn cluster_velocities(structure: &Structure, dashpots: &DashpotBalance<'_>, motion: &mut Motion) {
    for (at, cluster) in structure.clusters.iter().enumerate() {
        if structure.is_algebraic(at) {
            continue;
        }
        let anchor = (cluster.anchors.len() == 1).then(|| cluster.anchors.first()).flatten();
        for &body in &cluster.bodies {
            let own = dashpots.velocity(body);
            motion.velocity[body] = match anchor {
                Some(&anchor) => motion.velocity[anchor].as_ref().map(|base| base.plus(1.0, own)),
                None => Some(own.clone()),
            };
        }
    }
}

/// Completes the rates of positions and velocities.
fn unknown_rates(
    bodies: &Bodies,
    net: &[RowSum],
    dashpots: &DashpotBalance<'_>,
    structure: &Structure,
    velocity: &[Option<Row>],
    places: &mut Places,
) {
    let of = |body: usize| velocity[body].clone().unwrap_or_default();
    let acceleration = |body: usize| match bodies.all[body].role {
        Role::Mass(mass) => net[body].total().times(Twofold::ONE / mass),
        _ => Row::default(),
    };
    for at in 0..bodies.all.len() {
        if let Some(unknown) = places.unknown[at] {
            let cluster = structure.cluster_of[at];
            let anchors = cluster.map(|cluster| &structure.clusters[cluster].anchors);
            places.drafts[unknown].row = match (places.parent[at], anchors) {
                (None, _) => of(at),
                (Some(parent), Some(_)) if structure.cluster_of[parent] == cluster => {
                    dashpots.difference(at, parent)
                }
                (Some(parent), Some(anchors))
                    if anchors.len() == 1 && anchors.contains(&parent) =>
                {
                    dashpots.velocity(at).clone()
                }
                (Some(parent), _) => of(at).plus(-1.0, &of(parent)),
            };
        }
        if let Some(unknown) = places.velocity[at] {
            let base = places.pace[at].map(acceleration);
            let own = acceleration(at);
            places.drafts[unknown].row =
                base.map_or_else(|| own.clone(), |base| own.plus(-1.0, &base));
        }
    }
}

/// Rates of what follows from balances of springs, by differentiation.
fn derived_rates(structure: &Structure, inputs: &mut Inputs, places: &Places, motion: &mut Motion) {
    let mut rate_of = |row: &Row| {
        let mut sum = RowSum::default();
        for &(unknown, coefficient) in row.unknowns.terms() {
            let draft = &places.drafts[unknown];
            if draft.kind == UnknownKind::Algebraic {
                return None;
            }
            sum.add(coefficient, &draft.row);
        }
        sum.add(1.0, &inputs.rate(row));
        Some(sum.total())
    };
    for spring in &structure.springs {
        if motion.rate[spring.primitive].is_none() {
            motion.rate[spring.primitive] =
                motion.deformation[spring.primitive].as_ref().and_then(&mut rate_of);
        }
    }
    for (body, cluster) in structure.cluster_of.iter().enumerate() {
        if cluster.is_some() && motion.velocity[body].is_none() {
            motion.velocity[body] = rate_of(&motion.position[body]);
        }
    }
}
