//! Deformations, forces and velocities, and from them the rate of every unknown.

use dashpot_dae::UnknownKind;
use dashpot_numerics::DoubleDouble;

use super::{
    bodies::{Bodies, Role},
    dashpots::DashpotBalance,
    expand::Primitive,
    row::{Combination, Row, RowSum, Rows, Scalar},
    scales::Scales,
    springs::SpringBalance,
    structure::{Numbers, Structure},
    unknowns::{Inputs, Places},
};
use crate::elements::Law;

/// All that moves and pushes, in SI units.
#[derive(Debug, Clone, Default)]
pub(super) struct Motion<T = DoubleDouble> {
    /// Position of each body.
    pub(super) position: Rows<T>,
    /// Velocity of each body, where it does not depend on the rate of a kept algebraic unknown.
    pub(super) velocity: Rows<T>,
    /// Deformation of each primitive that takes part.
    pub(super) deformation: Rows<T>,
    /// Deformation rate of each primitive that takes part.
    pub(super) rate: Rows<T>,
    /// Force of each primitive that takes part.
    pub(super) force: Rows<T>,
}

/// Up to this many massless bodies in all, every balance is eliminated.
const SMALL: usize = 200;
/// Beyond, only places with at most this many links, and clusters of this many bodies, are.
const MOST_LINKS: usize = 16;

/// What the rows are built from.
pub(super) struct Given<'a, T> {
    pub(super) numbers: Numbers<'a, T>,
    pub(super) primitives: &'a [Primitive],
    /// The nonlinear force of each primitive, besides a linear spring's and dashpot's \[N\]; it is among the loads.
    pub(super) nonlinear: &'a Rows<T>,
    pub(super) bodies: &'a Bodies,
    pub(super) structure: &'a Structure,
    pub(super) scales: &'a Scales,
    /// Name of a body.
    pub(super) names: &'a dyn Fn(usize) -> String,
}

/// Builds all rows and completes those of the unknowns; `loads` are the forces on the bodies from outside \[N\].
pub(super) fn build<T: Scalar>(
    given: &Given<'_, T>,
    loads: Vec<RowSum<T>>,
    inputs: &mut Inputs,
    places: &mut Places<T>,
) -> Motion<T> {
    let Given { ref numbers, nonlinear, bodies, structure, scales, names, .. } = *given;
    let massless = structure.cluster_of.iter().flatten().count();
    let most = if massless <= SMALL { usize::MAX } else { MOST_LINKS };
    let mut motion = Motion {
        position: Rows::default(),
        velocity: known_velocities(bodies, places, inputs),
        deformation: Rows::default(),
        rate: Rows::default(),
        force: nonlinear.clone(),
    };

    let springs = SpringBalance::solve(structure, numbers, &loads, most, places, inputs, |body| {
        (names(body), scales.length[body])
    });
    for body in 0..bodies.all.len() {
        motion.position.set(body, &springs.position(places, body));
    }
    let mut net = loads;
    for spring in &structure.springs {
        let deformation =
            springs.difference(places, spring.ends).plus(1.0, &inputs.constant(spring.offset));
        let force = deformation.times((numbers.slope)(spring));
        push_apart(&mut net, spring.ends, &force);
        motion.deformation.set(spring.primitive, &deformation);
        add_to(&mut motion.force, spring.primitive, force);
    }

    let known = (net.as_slice(), &motion.velocity);
    let dashpots = DashpotBalance::solve(structure, numbers, known, most, places, |body| {
        (names(body), scales.velocity[body])
    });
    cluster_velocities(structure, &dashpots, &mut motion);
    for dashpot in &structure.dashpots {
        let [a, b] = dashpot.ends;
        let rate = dashpots
            .rate(dashpot.ends)
            .unwrap_or_else(|| motion.velocity.row(a).plus(-1.0, &motion.velocity.row(b)));
        let force = rate.times((numbers.slope)(dashpot));
        push_apart(&mut net, dashpot.ends, &force);
        let deformation =
            springs.difference(places, dashpot.ends).plus(1.0, &inputs.constant(dashpot.offset));
        motion.deformation.set(dashpot.primitive, &deformation);
        motion.rate.set(dashpot.primitive, &rate);
        add_to(&mut motion.force, dashpot.primitive, force);
    }
    unknown_rates(given, &net, &dashpots, &motion.velocity, places);
    derived_rates(structure, inputs, places, &mut motion);
    without_slopes(given, &springs, inputs, places, &mut motion);
    motion
}

fn add_to<T: Scalar>(sums: &mut Rows<T>, at: usize, row: Row<T>) {
    let sum = match sums.get(at) {
        Some(sum) => sum.plus(1.0, &row),
        None => row,
    };
    sums.set(at, &sum);
}

/// How primitives without a slope are deformed: constant forces and laws that are not linear.
fn without_slopes<T: Scalar>(
    given: &Given<'_, T>,
    springs: &SpringBalance<'_, T>,
    inputs: &mut Inputs,
    places: &Places<T>,
    motion: &mut Motion<T>,
) {
    for (at, primitive) in given.primitives.iter().enumerate() {
        if motion.deformation.has(at) {
            continue;
        }
        let ends = primitive.ends.map(|joint| given.bodies.of_joint[joint]);
        let [a, b] = primitive.ends.map(|joint| given.bodies.offset[joint]);
        let offset = inputs.constant(a - b);
        let is_pressed = (a - b).abs() > 0.0 || primitive.element.push() != 0.0;
        if ends[0] == ends[1] && is_pressed && primitive.law != Law::Rigid {
            // Held at a deformation, it pushes all the same.
            let [stiffness, _] = primitive.slopes();
            let force = if primitive.is_nonlinear() || primitive.element.push() != 0.0 {
                inputs.constant(primitive.element.force(a - b, 0.0))
            } else {
                offset.times(stiffness)
            };
            motion.deformation.set(at, &offset);
            motion.rate.set(at, &Row::default());
            motion.force.set(at, &force);
            continue;
        }
        if !given.nonlinear.has(at) {
            continue;
        }
        motion.deformation.set(at, &springs.difference(places, ends).plus(1.0, &offset));
        if let [Some(a), Some(b)] = ends.map(|end| motion.velocity.get(end)) {
            motion.rate.set(at, &a.plus(-1.0, &b));
        }
    }
}

fn push_apart<T: Scalar>(net: &mut [RowSum<T>], [a, b]: [usize; 2], force: &Row<T>) {
    net[a].add(-1.0, force);
    net[b].add(1.0, force);
}

fn known_velocities<T: Scalar>(
    bodies: &Bodies,
    places: &Places<T>,
    inputs: &mut Inputs,
) -> Rows<T> {
    let mut velocities = Rows::default();
    for (at, body) in bodies.all.iter().enumerate() {
        let known = match body.role {
            Role::Fixed => Some(Row::default()),
            Role::Prescribed(_) => Some(inputs.rate(&places.position.row(at))),
            Role::Mass(_) => places.velocity_of(at),
            Role::Massless => None,
        };
        if let Some(row) = known {
            velocities.set(at, &row);
        }
    }
    velocities
}

/// Velocities of the bodies that dashpots tie to an anchor.
fn cluster_velocities<T: Scalar>(
    structure: &Structure,
    dashpots: &DashpotBalance<'_, T>,
    motion: &mut Motion<T>,
) {
    for (at, cluster) in structure.clusters.iter().enumerate() {
        if structure.is_algebraic(at) {
            continue;
        }
        let anchor = (cluster.anchors.len() == 1).then(|| cluster.anchors.first()).flatten();
        for &body in &cluster.bodies {
            let own = dashpots.velocity(body);
            let velocity = match anchor {
                Some(&anchor) => motion.velocity.get(anchor).map(|base| base.plus(1.0, own)),
                None => Some(own.clone()),
            };
            if let Some(velocity) = velocity {
                motion.velocity.set(body, &velocity);
            }
        }
    }
}

/// Completes the rates of positions and velocities.
fn unknown_rates<T: Scalar>(
    Given { numbers, bodies, structure, .. }: &Given<'_, T>,
    net: &[RowSum<T>],
    dashpots: &DashpotBalance<'_, T>,
    velocity: &Rows<T>,
    places: &mut Places<T>,
) {
    let of = |body: usize| velocity.row(body);
    let acceleration = |body: usize| match bodies.all[body].role {
        Role::Mass(mass) => net[body].total().times(T::ONE / (numbers.mass)(body, mass)),
        _ => Row::default(),
    };
    for at in 0..bodies.all.len() {
        if let Some(unknown) = places.unknown[at] {
            let cluster = structure.cluster_of[at];
            let anchors = cluster.map(|cluster| &structure.clusters[cluster].anchors);
            let rate = match (places.parent[at], anchors) {
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
            places.rows.set(unknown, &rate);
        }
        if let Some(unknown) = places.velocity[at] {
            let base = places.velocity_base[at].map(acceleration);
            let own = acceleration(at);
            let rate = base.map_or_else(|| own.clone(), |base| own.plus(-1.0, &base));
            places.rows.set(unknown, &rate);
        }
    }
}

/// Rates of what follows from balances of springs, by differentiation.
fn derived_rates<T: Scalar>(
    structure: &Structure,
    inputs: &mut Inputs,
    places: &Places<T>,
    motion: &mut Motion<T>,
) {
    let mut rate_of = |row: &Row<T>| {
        let mut sum = RowSum::default();
        for &(unknown, coefficient) in row.unknowns.terms() {
            if places.drafts[unknown].kind == UnknownKind::Algebraic {
                return None;
            }
            sum.add(coefficient, &places.rows.row(unknown));
        }
        sum.add(1.0, &inputs.rate(row));
        Some(sum.total())
    };
    for spring in &structure.springs {
        let at = spring.primitive;
        if !motion.rate.has(at)
            && let Some(rate) = motion.deformation.get(at).as_ref().and_then(&mut rate_of)
        {
            motion.rate.set(at, &rate);
        }
    }
    for (body, cluster) in structure.cluster_of.iter().enumerate() {
        if cluster.is_some()
            && !motion.velocity.has(body)
            && let Some(rate) = rate_of(&motion.position.row(body))
        {
            motion.velocity.set(body, &rate);
        }
    }
}
