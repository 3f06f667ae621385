//! The system of one network of a form.

use dashpot_numerics::small::Square;

use super::{
    Eliminated, ParametricSystem, PartKind,
    curve::{CurveRow, Sprung},
};

/// The system of one network: `ż = A z` in dimensionless time, padded with zeros to `N` unknowns. Behind the
/// unknowns stands the number 1 where constant forces act, the force of each law that is not linear, and the speed of a
/// face that springs alone hold.
#[derive(Debug, Clone)]
pub struct Instance<const N: usize> {
    /// `A` by its columns.
    pub matrix: Square<N>,
    /// The unknowns at the start.
    pub start: [f64; N],
    /// Force \[N\] of the element that is struck, over the unknowns.
    pub force: [f64; N],
    /// Its deformation \[m\] over the unknowns.
    pub deformation: [f64; N],
    /// The laws that are not linear.
    pub curves: Vec<CurveRow<N>>,
    /// A face that springs alone hold.
    pub(super) sprung: Option<Sprung<N>>,
    net: Vec<[f64; N]>,
    pub(super) velocity: Vec<[f64; N]>,
    conductance: Vec<f64>,
    weights: Vec<f64>,
}

impl ParametricSystem {
    /// Room for systems of this form; `None` where they have more than `N` unknowns.
    pub fn instance<const N: usize>(&self) -> Option<Instance<N>> {
        if self.states() > N {
            return None;
        }
        let links = self.eliminated.iter().map(|own| own.neighbours.len()).sum();
        let mut start = [0.0; N];
        if let Some(one) = self.one {
            start[one] = 1.0;
        }
        Some(Instance {
            matrix: [[0.0; N]; N],
            start,
            force: [0.0; N],
            deformation: self.in_metres(&self.deformation),
            curves: Vec::with_capacity(self.curves.len()),
            sprung: None,
            net: vec![[0.0; N]; self.bodies],
            velocity: vec![[0.0; N]; self.bodies],
            conductance: vec![0.0; self.bodies * self.bodies],
            weights: vec![0.0; links],
        })
    }

    /// Writes the system with these [`numbers`](Self::numbers) into an instance; false where a law has none
    /// with them. Nothing is allocated but laws whose numbers differ from those before.
    ///
    /// # Panics
    ///
    /// When the instance or the numbers are those of another form.
    pub fn fill<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) -> bool {
        self.add_forces(numbers, instance);
        self.solve_dashpots(instance);
        if let Some(slot) = self.sprung {
            instance.velocity[self.face][slot] = 1.0;
        }
        self.add_dashpots(numbers, instance);
        for own in &self.placed {
            let mut row = instance.velocity[own.body];
            if let Some(parent) = own.parent {
                subtract(&mut row, &instance.velocity[parent]);
            }
            self.set_row(instance, own.unknown, 1.0, &row);
        }
        for own in &self.weighed {
            let [mass, velocity, _] = own.numbers.map(|at| numbers[at]);
            let row = instance.net[own.body];
            self.set_row(instance, own.unknown, mass.recip(), &row);
            instance.start[own.unknown] = velocity / self.scales[own.unknown];
        }
        let mut force = [0.0; N];
        for &at in &self.force {
            let part = &self.parts[at];
            let constant = numbers[part.number];
            match part.kind {
                PartKind::Dashpot => {
                    let [a, b] = part.ends;
                    add(&mut force, constant, &instance.velocity[a]);
                    add(&mut force, -constant, &instance.velocity[b]);
                }
                PartKind::Spring => {
                    part.deformation.iter().for_each(|&(at, sign)| force[at] += constant * sign);
                }
                PartKind::Curve(slot) => force[slot] += 1.0,
            }
        }
        for ((own, value), scale) in instance.force.iter_mut().zip(force).zip(&self.scales) {
            *own = value * scale;
        }
        instance.sprung = self.sprung.map(|slot| self.sprung_row(slot, numbers, instance));
        self.add_curves(numbers, instance)
    }

    /// What the speed of a face follows from that springs alone hold, and that is found in a slot.
    fn sprung_row<const N: usize>(
        &self,
        slot: usize,
        numbers: &[f64],
        instance: &Instance<N>,
    ) -> Sprung<N> {
        let mut own = Sprung { slot, stiffness: 0.0, pull: [0.0; N], curves: Vec::new() };
        for part in self.parts.iter().filter(|part| part.ends.contains(&self.face)) {
            let [a, b] = part.ends;
            let other = if a == self.face { b } else { a };
            let mut speed = instance.velocity[other];
            speed.iter_mut().zip(&self.scales).for_each(|(own, scale)| *own *= scale);
            if let PartKind::Curve(slot) = part.kind {
                own.curves.push((slot, speed));
            } else {
                own.stiffness += numbers[part.number];
                add(&mut own.pull, numbers[part.number], &speed);
            }
        }
        own
    }

    /// Whether no law depends on a rate to which a law contributes, so that forces follow one from the other.
    pub(super) fn is_explicit(&self) -> bool {
        self.curves.iter().filter(|curve| curve.has_rate).all(|curve| {
            let is_moving = |body: &usize| !self.eliminated.iter().any(|own| own.body == *body);
            self.parts[curve.part].ends.iter().all(is_moving)
        })
    }

    /// Writes the laws that are not linear.
    fn add_curves<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) -> bool {
        for (at, curve) in self.curves.iter().enumerate() {
            let part = &self.parts[curve.part];
            let own = &numbers[part.number..][..curve.numbers()];
            let is_same = |row: &CurveRow<N>| row.numbers == own;
            let mut rate = [0.0; N];
            if curve.has_rate {
                let [a, b] = part.ends;
                add(&mut rate, 1.0, &instance.velocity[a]);
                add(&mut rate, -1.0, &instance.velocity[b]);
                rate.iter_mut().zip(&self.scales).for_each(|(own, scale)| *own *= scale);
            }
            if let Some(row) = instance.curves.get_mut(at).filter(|row| is_same(row)) {
                row.rate = rate;
                continue;
            }
            let (PartKind::Curve(slot), Some(law)) = (part.kind, curve.law(own)) else {
                instance.curves.clear();
                return false;
            };
            let deformation = self.in_metres(&part.deformation);
            let row = CurveRow { law, slot, deformation, rate, numbers: own.to_vec() };
            match instance.curves.get_mut(at) {
                Some(known) => *known = row,
                None => instance.curves.push(row),
            }
        }
        true
    }

    /// Differences of places over the unknowns \[m\].
    pub(super) fn in_metres<const N: usize>(&self, terms: &[(usize, f64)]) -> [f64; N] {
        let mut row = [0.0; N];
        terms.iter().for_each(|&(at, sign)| row[at] = sign * self.scales[at]);
        row
    }

    /// What acts on the bodies but for the dashpots.
    fn add_forces<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) {
        instance.net.fill([0.0; N]);
        instance.conductance.fill(0.0);
        instance.velocity.fill([0.0; N]);
        for own in &self.weighed {
            instance.velocity[own.body][own.unknown] = 1.0;
            if let Some(one) = self.one {
                instance.net[own.body][one] += numbers[own.numbers[2]];
            }
        }
        for part in &self.parts {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            match part.kind {
                PartKind::Dashpot => {
                    instance.conductance[a * self.bodies + b] += constant;
                    instance.conductance[b * self.bodies + a] += constant;
                }
                PartKind::Spring => {
                    for &(at, sign) in &part.deformation {
                        instance.net[a][at] -= constant * sign;
                        instance.net[b][at] += constant * sign;
                    }
                }
                PartKind::Curve(slot) => {
                    instance.net[a][slot] -= 1.0;
                    instance.net[b][slot] += 1.0;
                }
            }
        }
    }

    /// The velocities of the massless bodies.
    fn solve_dashpots<const N: usize>(&self, instance: &mut Instance<N>) {
        let count = self.bodies;
        let mut first = 0;
        for Eliminated { body, neighbours } in &self.eliminated {
            let star = body * count;
            let total: f64 =
                neighbours.iter().map(|neighbour| instance.conductance[star + neighbour.0]).sum();
            let load = instance.net[*body];
            for (at, &(other, waits)) in neighbours.iter().enumerate() {
                let weight = instance.conductance[star + other] / total;
                instance.weights[first + at] = weight;
                if waits {
                    add(&mut instance.net[other], weight, &load);
                }
                for &(next, _) in &neighbours[at + 1..] {
                    let link = weight * instance.conductance[star + next];
                    instance.conductance[other * count + next] += link;
                    instance.conductance[next * count + other] += link;
                }
            }
            first += neighbours.len();
            add(&mut instance.velocity[*body], total.recip(), &load);
        }
        for Eliminated { body, neighbours } in self.eliminated.iter().rev() {
            first -= neighbours.len();
            let mut sum = instance.velocity[*body];
            for (at, &(other, _)) in neighbours.iter().enumerate() {
                add(&mut sum, instance.weights[first + at], &instance.velocity[other]);
            }
            instance.velocity[*body] = sum;
        }
    }

    /// What the dashpots do to the masses.
    fn add_dashpots<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) {
        for part in self.parts.iter().filter(|part| part.is_dashpot()) {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            let mut rate = instance.velocity[a];
            subtract(&mut rate, &instance.velocity[b]);
            add(&mut instance.net[a], -constant, &rate);
            add(&mut instance.net[b], constant, &rate);
        }
    }

    fn set_row<const N: usize>(
        &self,
        instance: &mut Instance<N>,
        unknown: usize,
        factor: f64,
        row: &[f64; N],
    ) {
        let factor = factor * self.time / self.scales[unknown];
        let columns = instance.matrix.iter_mut().zip(row).zip(&self.scales);
        columns.for_each(|((column, value), scale)| column[unknown] = value * scale * factor);
    }
}

#[inline]
fn add<const N: usize>(sum: &mut [f64; N], factor: f64, row: &[f64; N]) {
    sum.iter_mut().zip(row).for_each(|(own, other)| *own += factor * other);
}

#[inline]
fn subtract<const N: usize>(sum: &mut [f64; N], row: &[f64; N]) {
    sum.iter_mut().zip(row).for_each(|(own, other)| *own -= other);
}
