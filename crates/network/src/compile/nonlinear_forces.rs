//! Forces besides those of linear springs and dashpots: constant ones, and what laws that are not
//! linear differ by from the spring and dashpot that stand for them.
//!
//! Such a difference is an algebraic unknown `φ` that acts on both ends like a load, with the balance `0 = f(y, ẏ) − k
//! y − c ẏ − φ`. So the structure of a network is found as if it were linear, and the block of the algebraic unknowns
//! is regular wherever the slopes of the laws themselves determine the network.
//!
//! A law of the rate that is flat or steep at rest ([`Element::reflected`](crate::Element::reflected)) has
//! the balance `0 = r(F + c ẏ) − φ` instead, which says the same: `φ` is `F − c ẏ`.

use dashpot_dae::UnknownKind;

use super::{
    bodies::Bodies,
    expand::{Expansion, Primitive},
    motion::Motion,
    row::{Combination, Row, RowSum, Rows, Scalar},
    scales::{Scales, power_of_two},
    structure::Structure,
    unknowns::{Draft, Inputs, Law, Places},
};

/// Adds the unknowns `φ` to `places` and all nonlinear forces to `loads`; returns that of each primitive that has one.
pub(super) fn add<T: Scalar>(
    expansion: &Expansion,
    bodies: &Bodies,
    structure: &Structure,
    scales: &Scales,
    inputs: &mut Inputs,
    places: &mut Places<T>,
    loads: &mut [RowSum<T>],
) -> Rows<T> {
    let mut nonlinear = Rows::default();
    for (at, primitive) in expansion.primitives.iter().enumerate() {
        let ends = primitive.ends.map(|joint| bodies.of_joint[joint]);
        if ends[0] == ends[1] || !(structure.held[ends[0]] || structure.held[ends[1]]) {
            continue;
        }
        let push = if primitive.is_nonlinear() {
            let unknown = Row::unknown(places.drafts.len());
            places.drafts.push(draft(at, primitive, ends, scales));
            unknown
        } else if primitive.push != 0.0 {
            inputs.constant(primitive.push)
        } else {
            continue;
        };
        for (end, sign) in ends.into_iter().zip([-1.0, 1.0]) {
            loads[end].add(sign, &push);
        }
        nonlinear.set(at, &push);
    }
    nonlinear
}

fn draft(at: usize, primitive: &Primitive, ends: [usize; 2], scales: &Scales) -> Draft {
    let [stiffness, damping] = primitive.slopes();
    let smaller = |of: &[f64]| ends.iter().map(|&end| of[end]).fold(f64::INFINITY, f64::min);
    let force = (stiffness * smaller(&scales.length)).max(damping * smaller(&scales.velocity));
    Draft {
        name: format!("force of {} beyond its linear part", primitive.name),
        kind: UnknownKind::Algebraic,
        unit: "N",
        scale: power_of_two(if force > 0.0 && force.is_finite() { force } else { 1.0 }),
        initial: 0.0,
        law: Some(Law::Force(at)),
    }
}

/// Completes the balances of the unknowns `φ`, but for the laws themselves.
pub(super) fn complete(expansion: &Expansion, motion: &Motion, places: &mut Places) {
    for (unknown, draft) in places.drafts.iter().enumerate() {
        let Some(Law::Force(at)) = draft.law else { continue };
        let [stiffness, damping] = expansion.primitives[at].slopes();
        let mut row = Row::unknown(unknown).times(-1.0);
        if expansion.primitives[at].is_reflected() {
            places.rows.set(unknown, &row);
            continue;
        }
        if let Some(deformation) = motion.deformation.get(at) {
            row = row.plus(-stiffness, &deformation);
        }
        if let Some(rate) = motion.rate.get(at).filter(|_| damping > 0.0) {
            row = row.plus(-damping, &rate);
        }
        places.rows.set(unknown, &row);
    }
}
