//! Which quantities are unknowns, and the place of every body in terms of them.

use std::collections::{BTreeMap, HashMap};

use dashpot_dae::{Input, UnknownKind, Waveform};
use dashpot_numerics::DoubleDouble;

use super::{
    bodies::{Bodies, Role, joint_name},
    expand::Expansion,
    row::{Combination, Row, RowSum, Rows, Scalar},
    scales::{Scales, power_of_two},
    structure::{Edge, Structure},
    tree,
};
use crate::Network;

/// An unknown in the making.
#[derive(Debug, Clone)]
pub(super) struct Draft {
    pub(super) name: String,
    pub(super) kind: UnknownKind,
    pub(super) unit: &'static str,
    /// SI value of the dimensionless value 1.
    pub(super) scale: f64,
    /// SI value at the start.
    pub(super) initial: f64,
    /// What stands in the row that is not linear.
    pub(super) law: Option<Law>,
}

/// What is not linear in the balance of an unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Law {
    /// The force of the primitive of this number.
    Force(usize),
    /// The rate of that force.
    ForceRate(usize),
}

/// The inputs that rows speak of, numbered as they are asked for.
#[derive(Debug, Clone, Default)]
pub(super) struct Inputs {
    pub(super) waveforms: Vec<Waveform>,
    pub(super) entries: Vec<Input>,
    numbers: HashMap<Input, usize>,
    /// The waveform that is 1 at all times, where one is asked for.
    one: Option<usize>,
}

impl Inputs {
    pub(super) fn waveform(&mut self, waveform: Waveform) -> usize {
        self.waveforms.push(waveform);
        self.waveforms.len() - 1
    }

    pub(super) fn row<T: Scalar>(&mut self, waveform: usize, derivative: u32) -> Row<T> {
        Row::input(self.number(Input { waveform, derivative }))
    }

    fn number(&mut self, input: Input) -> usize {
        *self.numbers.entry(input).or_insert_with(|| {
            self.entries.push(input);
            self.entries.len() - 1
        })
    }

    /// SI value of the dimensionless value 1 of each waveform in a run of `duration` \[s\].
    pub(super) fn heights(&self, duration: f64) -> Vec<f64> {
        let height = |waveform: &Waveform| {
            power_of_two(Some(waveform.bound(duration)).filter(|&h| h > 0.0).unwrap_or(1.0))
        };
        self.waveforms.iter().map(height).collect()
    }

    /// SI value of the dimensionless value 1 of each entry, with `time` \[s\] as the unit of time.
    pub(super) fn columns(&self, time: f64, duration: f64) -> Vec<f64> {
        let heights = self.heights(duration);
        let column =
            |input: &Input| heights[input.waveform] / time.powi(input.derivative.cast_signed());
        self.entries.iter().map(column).collect()
    }

    pub(super) fn constant<T: Scalar>(&mut self, value: f64) -> Row<T> {
        if value == 0.0 {
            return Row::default();
        }
        let one = match self.one {
            Some(one) => one,
            None => *self.one.insert({
                self.waveforms.push(Waveform::constant(1.0));
                self.waveforms.len() - 1
            }),
        };
        self.row(one, 0).times(value)
    }

    /// The rate of a combination of inputs.
    pub(super) fn rate<T: Scalar>(&mut self, row: &Row<T>) -> Row<T> {
        let mut rate = Row::default();
        for &(at, coefficient) in row.inputs.terms() {
            let Input { waveform, derivative } = self.entries[at];
            let is_constant =
                self.waveforms[waveform].pieces().iter().all(|piece| piece.is_constant(derivative));
            if !is_constant {
                rate = rate.plus(coefficient, &self.row(waveform, derivative + 1));
            }
        }
        rate
    }
}

/// A part between a body and its parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Along {
    /// Number of the primitive.
    pub(super) primitive: usize,
    /// By which its deformation gives the body's position unknown: 1, or −1 where it runs from the parent to the body.
    pub(super) sign: f64,
    /// The position unknown where both bodies are at one place \[m\].
    pub(super) offset: f64,
}

/// The part between each body and its parent that determines the unknown best, where one is there: the
/// stiffest spring, or else the strongest dashpot.
fn along(structure: &Structure, parents: &[Option<usize>]) -> Vec<Option<Along>> {
    let mut found: Vec<Option<Along>> = vec![None; parents.len()];
    for edges in [&structure.springs, &structure.dashpots] {
        let mut strongest: HashMap<usize, &Edge> = HashMap::new();
        for edge in edges {
            let [a, b] = edge.ends;
            for (body, other) in [(a, b), (b, a)] {
                let is_open = parents[body] == Some(other) && found[body].is_none();
                if is_open && strongest.get(&body).is_none_or(|own| edge.constant > own.constant) {
                    strongest.insert(body, edge);
                }
            }
        }
        for (body, edge) in strongest {
            let sign = if edge.ends[0] == body { 1.0 } else { -1.0 };
            let (primitive, offset) = (edge.primitive, sign * edge.offset);
            found[body] = Some(Along { primitive, sign, offset });
        }
    }
    found
}

/// Where every body is, as far as it is not algebraic.
#[derive(Debug, Clone, Default)]
pub(super) struct Places<T = DoubleDouble> {
    pub(super) drafts: Vec<Draft>,
    /// Rate of each differential unknown, balance of each algebraic one; SI.
    pub(super) rows: Rows<T>,
    /// Position unknown of each body that has one.
    pub(super) unknown: Vec<Option<usize>>,
    /// Velocity unknown of each mass.
    pub(super) velocity: Vec<Option<usize>>,
    /// The mass that a mass's velocity unknown is counted from.
    pub(super) velocity_base: Vec<Option<usize>>,
    /// The body that a body's position unknown is counted from.
    pub(super) parent: Vec<Option<usize>>,
    /// The part whose deformation a body's position unknown is, where one is between it and its parent.
    pub(super) along: Vec<Option<Along>>,
    /// Position of each body; of bodies in algebraic clusters relative to the cluster.
    pub(super) position: Rows<T>,
}

/// Chooses the unknowns that have a rate.
///
/// Masses have position and velocity, which where dashpots of different strength hold a mass is
/// counted from another mass ([`structure`](super::structure)). So that forces do not come from small differences of large
/// numbers, deformations along a [`tree`] of springs and dashpots stand for positions in small
/// networks, each the very deformation of its part, whatever rigid links are held at; massless bodies that dashpots tie to one anchor are else counted from that anchor, and
/// those of an algebraic cluster from its first body.
pub(super) fn choose<T: Scalar>(
    network: &Network,
    expansion: &Expansion,
    bodies: &Bodies,
    structure: &Structure,
    scales: &Scales,
    motions: &BTreeMap<usize, Row<T>>,
    inputs: &mut Inputs,
) -> Places<T> {
    let count = bodies.all.len();
    let mut places = Places {
        unknown: vec![None; count],
        velocity: vec![None; count],
        velocity_base: structure.velocity_base.clone(),
        parent: tree::parents(bodies, structure, scales.time),
        along: Vec::new(),
        position: Rows::default(),
        drafts: Vec::new(),
        rows: Rows::default(),
    };
    let name = |body: usize| joint_name(network, expansion, bodies.all[body].joints[0]);
    for cluster in 0..structure.clusters.len() {
        let members = &structure.clusters[cluster].bodies;
        let anchors = &structure.clusters[cluster].anchors;
        let reference = match anchors.len() {
            0 => members.first().copied(),
            1 => anchors.first().copied(),
            _ => None,
        };
        for &body in members {
            let reference = reference.filter(|&reference| reference != body);
            places.parent[body] = places.parent[body].or(reference);
        }
    }
    places.along = along(structure, &places.parent);
    for body in 0..count {
        let is_reference = structure
            .algebraic_cluster(body)
            .is_some_and(|cluster| structure.clusters[cluster].bodies[0] == body);
        let is_moved = match bodies.all[body].role {
            Role::Mass(_) => true,
            Role::Massless => structure.cluster_of[body].is_some() && !is_reference,
            Role::Fixed | Role::Prescribed(_) => false,
        };
        if !is_moved {
            places.along[body] = None;
            continue;
        }
        let relative = places.parent[body]
            .map_or(String::new(), |parent| format!(" relative to {}", name(parent)));
        places.unknown[body] = Some(places.drafts.len());
        places.drafts.push(Draft {
            name: format!("position of {}{relative}", name(body)),
            kind: UnknownKind::Differential,
            unit: "m",
            scale: scales.length[body],
            initial: 0.0,
            law: None,
        });
        if let Role::Mass(_) = bodies.all[body].role {
            let velocity_base = places.velocity_base[body];
            let relative = velocity_base
                .map_or(String::new(), |other| format!(" relative to {}", name(other)));
            let base = velocity_base.map_or(0.0, |other| bodies.all[other].velocity);
            places.velocity[body] = Some(places.drafts.len());
            places.drafts.push(Draft {
                name: format!("velocity of {}{relative}", name(body)),
                kind: UnknownKind::Differential,
                unit: "m/s",
                scale: scales.velocity[body],
                initial: bodies.all[body].velocity - base,
                law: None,
            });
        }
    }
    places.add_up(motions, inputs);
    places
}

impl<T: Scalar> Places<T> {
    pub(super) fn velocity_of(&self, mass: usize) -> Option<Row<T>> {
        let mut sum = Row::unknown(self.velocity[mass]?);
        let mut at = mass;
        while let Some(other) = self.velocity_base[at] {
            sum = sum.plus(1.0, &Row::unknown(self.velocity[other]?));
            at = other;
        }
        Some(sum)
    }

    /// The acceleration of a mass, once the rows are complete.
    pub(super) fn acceleration_of(&self, mass: usize) -> Option<Row<T>> {
        let velocity = self.velocity_of(mass)?;
        let mut sum = RowSum::default();
        for &(unknown, factor) in velocity.unknowns.terms() {
            sum.add(factor, &self.rows.row(unknown));
        }
        Some(sum.total())
    }

    /// Adds the unknowns up along the chain of parents.
    fn add_up(&mut self, motions: &BTreeMap<usize, Row<T>>, inputs: &mut Inputs) {
        let mut is_done = vec![false; self.parent.len()];
        for body in 0..self.parent.len() {
            let mut chain = vec![body];
            while let Some(parent) = self.parent[chain[chain.len() - 1]]
                && !is_done[parent]
            {
                chain.push(parent);
            }
            for &body in chain.iter().rev() {
                let own = self.unknown[body].map_or_else(Row::default, Row::unknown);
                let given = motions.get(&body).cloned().unwrap_or_default();
                let base = self.parent[body].map(|parent| self.position.row(parent));
                let offset = self.along[body].map_or(0.0, |along| along.offset);
                let position = own
                    .plus(1.0, &given)
                    .plus(1.0, &base.unwrap_or_default())
                    .plus(-1.0, &inputs.constant(offset));
                self.position.set(body, &position);
                is_done[body] = true;
            }
        }
    }
}
