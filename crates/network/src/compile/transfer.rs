//! What leads from one phase of a network to another: the state, whatever the unknowns are.
//!
//! The state is the deformation of every primitive, the place of every joint, and the velocity of
//! every joint that has mass or a given motion. Each phase knows how to read it off its own unknowns,
//! and what its own unknowns are in terms of it.

use dashpot_dae::{LinearForm, System, UnknownKind};

use super::{
    bodies::Role,
    parts::Parts,
    row::{Combination, Row},
    unknowns::Inputs,
};

/// The state of a network, SI.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct State {
    /// Deformation of each primitive \[m\].
    pub(super) deformation: Vec<f64>,
    /// Place of each joint \[m\].
    pub(super) position: Vec<f64>,
    /// Velocity of each joint \[m/s\]; of no meaning for one that has neither mass nor a given motion.
    pub(super) velocity: Vec<f64>,
}

/// A quantity in SI units over the dimensionless unknowns and inputs.
#[derive(Debug, Clone)]
struct Reading {
    unknowns: LinearForm,
    inputs: LinearForm,
}

/// What an unknown is in terms of the state.
#[derive(Debug, Clone)]
enum Origin {
    /// The velocity of a joint.
    Velocity(usize),
    /// The velocity of one joint less that of another.
    Slip([usize; 2]),
    /// The place of a body, that of a joint less its offset.
    Place(usize, f64),
    /// The place of one joint less that of another, less a difference of offsets.
    Between([usize; 2], f64),
    /// The deformation of a primitive times a sign.
    Along(usize, f64),
    /// It follows from a balance.
    Balance,
}

/// The way between the unknowns of a phase and the state.
#[derive(Debug, Clone, Default)]
pub(super) struct Transfer {
    deformation: Vec<Reading>,
    position: Vec<Reading>,
    velocity: Vec<Option<Reading>>,
    origins: Vec<Origin>,
    scales: Vec<f64>,
    /// The springs at places that follow from balances, where there are sliders.
    balanced: Vec<usize>,
}

impl Transfer {
    pub(super) fn of(parts: &Parts<'_>, inputs: &Inputs, system: &System, duration: f64) -> Self {
        let columns: Vec<f64> = system.unknowns.iter().map(|unknown| unknown.scale).collect();
        let input_columns = inputs.columns(system.time_scale, duration);
        let reading = |row: &Row| Reading {
            unknowns: row.unknowns.scaled(&columns),
            inputs: row.inputs.scaled(&input_columns),
        };
        let place = |joint: usize| {
            let body = parts.bodies.of_joint[joint];
            parts.motion.position.row(body).plus(1.0, &parts.offsets.row(joint))
        };
        let primitives = &parts.expansion.primitives;
        let deformation =
            primitives.iter().enumerate().map(|(at, own)| match parts.motion.deformation.get(at) {
                Some(row) => reading(&row),
                None => reading(&place(own.ends[0]).plus(-1.0, &place(own.ends[1]))),
            });
        let joints = 0..parts.expansion.joints;
        let velocity = joints.clone().map(|joint| {
            let body = parts.bodies.of_joint[joint];
            let moves = parts.bodies.all[body].role != Role::Massless;
            parts.motion.velocity.get(body).filter(|_| moves).as_ref().map(reading)
        });
        Self {
            deformation: deformation.collect(),
            position: joints.map(|joint| reading(&place(joint))).collect(),
            velocity: velocity.collect(),
            origins: origins(parts, system),
            scales: columns,
            balanced: balanced(parts),
        }
    }

    /// The springs at places that follow from balances.
    pub(super) fn balanced(&self) -> &[usize] {
        &self.balanced
    }

    /// The deformation \[m\] of a primitive where the unknowns are `y` and the inputs `w`.
    pub(super) fn deformation(&self, primitive: usize, y: &[f64], w: &[f64]) -> f64 {
        let own = &self.deformation[primitive];
        own.unknowns.at(y) + own.inputs.at(w)
    }

    /// The state where the unknowns are `y` and the inputs `w`; velocities that the phase does not
    /// know stay as they were.
    pub(super) fn read(&self, y: &[f64], w: &[f64], before: &State) -> State {
        let at = |reading: &Reading| reading.unknowns.at(y) + reading.inputs.at(w);
        let velocities = self.velocity.iter().zip(&before.velocity);
        State {
            deformation: self.deformation.iter().map(at).collect(),
            position: self.position.iter().map(at).collect(),
            velocity: velocities.map(|(own, &old)| own.as_ref().map_or(old, at)).collect(),
        }
    }

    /// The unknowns in this state; those that follow from balances are left at zero.
    pub(super) fn unknowns(&self, state: &State) -> Vec<f64> {
        let value = |origin: &Origin| match *origin {
            Origin::Velocity(joint) => state.velocity[joint],
            Origin::Slip([a, b]) => state.velocity[a] - state.velocity[b],
            Origin::Place(joint, offset) => state.position[joint] - offset,
            Origin::Between([a, b], offset) => state.position[a] - state.position[b] - offset,
            Origin::Along(primitive, sign) => sign * state.deformation[primitive],
            Origin::Balance => 0.0,
        };
        self.origins.iter().zip(&self.scales).map(|(origin, scale)| value(origin) / scale).collect()
    }
}

fn balanced(parts: &Parts<'_>) -> Vec<usize> {
    let primitives = parts.expansion.primitives.iter();
    let mut sliders = primitives.filter_map(|primitive| primitive.origin.phases()?.capacity());
    if sliders.next().is_none() {
        return Vec::new();
    }
    let follows = |body: usize| parts.structure.algebraic_cluster(body).is_some();
    let springs = parts.structure.springs.iter();
    springs
        .filter(|spring| spring.ends.into_iter().any(follows))
        .map(|spring| spring.primitive)
        .collect()
}

fn origins(parts: &Parts<'_>, system: &System) -> Vec<Origin> {
    let mut origins = vec![Origin::Balance; system.len()];
    let offset = |joint: usize| parts.bodies.offset[joint];
    let massive = |body: usize| {
        let joints = &parts.bodies.all[body].joints;
        let found = joints.iter().find(|&&joint| parts.masses[joint] > 0.0);
        *found.unwrap_or(&joints[0])
    };
    for (at, body) in parts.bodies.all.iter().enumerate() {
        let first = body.joints[0];
        if let Some(unknown) = parts.places.velocity[at] {
            origins[unknown] = match parts.places.velocity_base[at] {
                None => Origin::Velocity(massive(at)),
                Some(other) => Origin::Slip([massive(at), massive(other)]),
            };
        }
        let Some(unknown) = parts.places.unknown[at] else { continue };
        origins[unknown] = match parts.places.parent[at] {
            None => Origin::Place(first, offset(first)),
            Some(parent) => {
                let other = parts.bodies.all[parent].joints[0];
                let between = Origin::Between([first, other], offset(first) - offset(other));
                let along = parts.places.along[at];
                along.map_or(between, |along| Origin::Along(along.primitive, along.sign))
            }
        };
    }
    for (origin, unknown) in origins.iter_mut().zip(&system.unknowns) {
        if unknown.kind == UnknownKind::Algebraic {
            *origin = Origin::Balance;
        }
    }
    origins
}
