//! What a form does once what strikes it has been let go.

use dashpot_numerics::small::{apply_left, dot};

use super::{CurveRow, Instance, ParametricSystem, Weighed, tape::Pattern};

/// The face without mass that is left behind: its velocity is not followed any more, but found from the other
/// unknowns and slots.
///
/// It is that at which its dashpots and all else at it are in balance. Where springs alone hold it, it is that at which they
/// stay in balance: the mean of the velocities of their other ends, each weighed by the stiffness of its spring.
#[derive(Debug, Clone)]
pub(super) struct Parted<const N: usize> {
    /// The velocity of the face.
    pub(super) unknown: usize,
    /// What is zero.
    balance: [f64; N],
    /// The laws whose slopes have a part in it: their places, and by how much the rate of the force counts, over unknowns
    /// and slots.
    laws: Vec<(usize, [f64; N])>,
}

impl<const N: usize> Parted<N> {
    /// The velocity of the face, where the forces of the laws stand in their slots.
    pub(super) fn velocity(&self, curves: &[CurveRow<N>], z: &[f64; N]) -> f64 {
        let mut others = *z;
        others[self.unknown] = 0.0;
        let (mut own, mut rest) = (self.balance[self.unknown], dot(&self.balance, &others));
        for (at, row) in &self.laws {
            let CurveRow { law, deformation, .. } = &curves[*at];
            let stiffness = law.tangent(dot(deformation, z), 0.0).stiffness;
            own += stiffness * row[self.unknown];
            rest += stiffness * dot(row, &others);
        }
        -rest / own
    }
}

impl ParametricSystem {
    /// Whether what is left behind once what strikes has been let go can be followed: no law depends on the velocity of the
    /// face.
    pub fn parts(&self) -> bool {
        let needs_rate = |face: &Weighed| {
            let is_met = |rate: &Pattern| rate.terms.iter().any(|own| own.column == face.unknown);
            self.curves.iter().any(|own| own.has_rate && is_met(&own.rate))
        };
        let is_apart = self.weighed.iter().all(|own| own.base.is_none());
        self.opens && is_apart && self.face().is_some_and(|face| !needs_rate(face))
    }

    /// The body of what strikes, and of what it touches.
    fn face(&self) -> Option<&Weighed> {
        self.weighed.iter().find(|own| own.numbers[0] == self.mass)
    }

    /// The system of an instance once what strikes has been let go, with the same unknowns.
    pub fn parted<const N: usize>(&self, instance: &Instance<N>) -> Option<Instance<N>> {
        let face = self.face()?.unknown;
        let mut own = instance.clone();
        let mut balance: [f64; N] = std::array::from_fn(|at| own.matrix[at][face]);
        own.matrix.iter_mut().for_each(|column| column[face] = 0.0);
        if let Some(one) = self.one {
            balance[one] = 0.0;
        }
        let mut laws = Vec::new();
        if balance[face] == 0.0 {
            for (at, curve) in self.curves.iter().enumerate() {
                let pull = std::mem::take(&mut balance[self.unknowns + at]);
                if pull != 0.0 {
                    let rate: [f64; N] = curve.rate.at(&own.values);
                    laws.push((at, rate.map(|own| pull * self.time * own)));
                }
            }
            balance = apply_left(&balance, &own.matrix);
        }
        own.parted = Some(Parted { unknown: face, balance, laws });
        Some(own)
    }

    /// How many bodies with mass it has.
    pub fn masses(&self) -> usize {
        self.weighed.len()
    }

    /// The constant force \[N\] on what strikes, among the numbers of a network.
    pub fn constant_force(&self, numbers: &[f64]) -> f64 {
        self.face().map_or(0.0, |own| numbers[own.numbers[2]])
    }

    /// The kinetic energy \[J\] of its masses at the start.
    pub fn energy_at_start(&self, numbers: &[f64]) -> f64 {
        let energy = |own: &Weighed| {
            let [mass, speed, _] = own.numbers.map(|at| numbers[at]);
            0.5 * mass * speed * speed
        };
        self.weighed.iter().map(energy).sum()
    }

    /// What all springs and laws store \[J\] at most, as forces rise with deformations.
    pub fn stored_at_most<const N: usize>(
        &self,
        numbers: &[f64],
        instance: &Instance<N>,
        z: &[f64; N],
    ) -> f64 {
        let of_spring = |(number, deformation): &(usize, Pattern)| {
            let deformation = dot(&deformation.at(&instance.values), z);
            numbers[*number] * deformation * deformation
        };
        let of_law = |curve: &CurveRow<N>| {
            let deformation = dot(&curve.deformation, z);
            (curve.law.force(deformation, 0.0) * deformation).abs()
        };
        let laws = instance.curves.iter().map(of_law);
        self.springs.iter().map(of_spring).chain(laws).sum()
    }

    /// The speed \[m/s\] of what is struck at its face, over the unknowns and slots.
    pub fn speed_of_face<const N: usize>(&self, instance: &Instance<N>) -> [f64; N] {
        self.speed.at(&instance.values)
    }
}
