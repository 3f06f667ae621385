//! What a form does once what strikes it has been let go.

use dashpot_numerics::small::dot;

use super::{Curve, CurveRow, Instance, ParametricSystem, PartKind, reading::order};

impl ParametricSystem {
    /// The same form with the same unknowns once what strikes has been let go: a face without mass is left,
    /// which nothing pushes. The speed of what strikes is not followed any more; that of a face which springs alone
    /// hold has a slot of its own, the last one. `None` where a law depends on the rate of the face.
    pub fn released(&self) -> Option<Self> {
        let face = self.face;
        let has_dashpot =
            self.parts.iter().any(|part| part.is_dashpot() && part.ends.contains(&face));
        let mut waits = vec![false; self.bodies];
        self.eliminated.iter().for_each(|own| waits[own.body] = true);
        waits[face] = has_dashpot;
        let weighed = self.weighed.iter().filter(|own| own.body != face).copied().collect();
        let mut own = Self { eliminated: order(waits, &self.parts), weighed, ..self.clone() };
        if !has_dashpot {
            own.sprung = Some(own.scales.len());
            own.scales.push(1.0);
        }
        let is_linked = own.eliminated.iter().all(|own| !own.neighbours.is_empty());
        let needs_rate =
            |curve: &Curve| curve.has_rate && own.parts[curve.part].ends.contains(&face);
        let is_covered = is_linked && own.is_explicit() && !own.curves.iter().any(needs_rate);
        (self.opens && is_covered).then_some(own)
    }

    /// How many bodies with mass it has.
    pub fn masses(&self) -> usize {
        self.weighed.len()
    }

    /// The constant force \[N\] on what strikes, among the numbers of a network.
    pub fn constant_force(&self, numbers: &[f64]) -> f64 {
        let own = self.weighed.iter().find(|own| own.numbers[0] == self.mass);
        own.map_or(0.0, |own| numbers[own.numbers[2]])
    }

    /// The kinetic energy \[J\] of its masses at the start.
    pub fn energy_at_start<const N: usize>(&self, numbers: &[f64], instance: &Instance<N>) -> f64 {
        let energy = |weighed: &super::Weighed| {
            let speed = dot(&self.speed_of(weighed.body, instance), &instance.start);
            0.5 * numbers[weighed.numbers[0]] * speed * speed
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
        let springs = self.parts.iter().filter(|part| part.kind == PartKind::Spring);
        let of_spring = |part: &super::Part| {
            let deformation = dot(&self.in_metres(&part.deformation), z);
            numbers[part.number] * deformation * deformation
        };
        let of_law = |curve: &CurveRow<N>| {
            let deformation = dot(&curve.deformation, z);
            (curve.law.force(deformation, 0.0) * deformation).abs()
        };
        let laws = instance.curves.iter().map(of_law);
        springs.map(of_spring).chain(laws).sum()
    }

    /// The speed \[m/s\] of what is struck at its face, over the unknowns and slots.
    pub fn speed_of_face<const N: usize>(&self, instance: &Instance<N>) -> [f64; N] {
        self.speed_of(self.face, instance)
    }

    fn speed_of<const N: usize>(&self, body: usize, instance: &Instance<N>) -> [f64; N] {
        let row = &instance.velocity[body];
        std::array::from_fn(|at| row[at] * self.scales.get(at).copied().unwrap_or(0.0))
    }
}
