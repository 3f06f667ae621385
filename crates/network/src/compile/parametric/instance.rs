//! The system of one network of a form.

use dashpot_numerics::small::Square;

use super::{Eliminated, ParametricSystem};

/// The system of one network: `ż = A z` in dimensionless time, padded with zeros to `N` unknowns.
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
    net: Vec<[f64; N]>,
    velocity: Vec<[f64; N]>,
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
        let mut deformation = [0.0; N];
        self.deformation.iter().for_each(|&(at, sign)| deformation[at] = sign * self.scales[at]);
        Some(Instance {
            matrix: [[0.0; N]; N],
            start: [0.0; N],
            force: [0.0; N],
            deformation,
            net: vec![[0.0; N]; self.bodies],
            velocity: vec![[0.0; N]; self.bodies],
            conductance: vec![0.0; self.bodies * self.bodies],
            weights: vec![0.0; links],
        })
    }

    /// Writes the system with these [`numbers`](Self::numbers) into a instance. Nothing is allocated.
    ///
    /// # Panics
    ///
    /// When the instance or the numbers are those of another form.
    pub fn fill<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) {
        self.add_springs(numbers, instance);
        self.solve_dashpots(instance);
        self.add_dashpots(numbers, instance);
        for own in &self.placed {
            let mut row = instance.velocity[own.body];
            if let Some(parent) = own.parent {
                subtract(&mut row, &instance.velocity[parent]);
            }
            self.set_row(instance, own.unknown, 1.0, &row);
        }
        for own in &self.weighed {
            let [mass, velocity] = own.numbers.map(|at| numbers[at]);
            let row = instance.net[own.body];
            self.set_row(instance, own.unknown, mass.recip(), &row);
            instance.start[own.unknown] = velocity / self.scales[own.unknown];
        }
        let mut force = [0.0; N];
        for &at in &self.force {
            let part = &self.parts[at];
            let constant = numbers[part.number];
            if part.is_dashpot {
                let [a, b] = part.ends;
                add(&mut force, constant, &instance.velocity[a]);
                add(&mut force, -constant, &instance.velocity[b]);
            } else {
                part.deformation.iter().for_each(|&(at, sign)| force[at] += constant * sign);
            }
        }
        for ((own, value), scale) in instance.force.iter_mut().zip(force).zip(&self.scales) {
            *own = value * scale;
        }
    }

    fn add_springs<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) {
        instance.net.fill([0.0; N]);
        instance.conductance.fill(0.0);
        instance.velocity.fill([0.0; N]);
        for own in &self.weighed {
            instance.velocity[own.body][own.unknown] = 1.0;
        }
        for part in &self.parts {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            if part.is_dashpot {
                instance.conductance[a * self.bodies + b] += constant;
                instance.conductance[b * self.bodies + a] += constant;
            } else {
                for &(at, sign) in &part.deformation {
                    instance.net[a][at] -= constant * sign;
                    instance.net[b][at] += constant * sign;
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
        for part in self.parts.iter().filter(|part| part.is_dashpot) {
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
