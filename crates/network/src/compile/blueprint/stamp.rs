//! The system of one network of a form.

use dashpot_numerics::small::Square;

use super::{Blueprint, Eliminated};

/// The system of one network: `ż = A z` in dimensionless time, padded with zeros to `N` unknowns.
#[derive(Debug, Clone)]
pub struct Stamp<const N: usize> {
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

impl Blueprint {
    /// Room for systems of this form; `None` where they have more than `N` unknowns.
    pub fn stamp<const N: usize>(&self) -> Option<Stamp<N>> {
        if self.states() > N {
            return None;
        }
        let links = self.eliminated.iter().map(|own| own.neighbours.len()).sum();
        let mut deformation = [0.0; N];
        self.deformation.iter().for_each(|&(at, sign)| deformation[at] = sign * self.scales[at]);
        Some(Stamp {
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

    /// Writes the system with these [`numbers`](Self::numbers) into a stamp. Nothing is allocated.
    ///
    /// # Panics
    ///
    /// When the stamp or the numbers are those of another form.
    pub fn fill<const N: usize>(&self, numbers: &[f64], stamp: &mut Stamp<N>) {
        self.add_springs(numbers, stamp);
        self.solve_dashpots(stamp);
        self.add_dashpots(numbers, stamp);
        for own in &self.placed {
            let mut row = stamp.velocity[own.body];
            if let Some(parent) = own.parent {
                subtract(&mut row, &stamp.velocity[parent]);
            }
            self.set_row(stamp, own.unknown, 1.0, &row);
        }
        for own in &self.weighed {
            let [mass, velocity] = own.numbers.map(|at| numbers[at]);
            let row = stamp.net[own.body];
            self.set_row(stamp, own.unknown, mass.recip(), &row);
            stamp.start[own.unknown] = velocity / self.scales[own.unknown];
        }
        let mut force = [0.0; N];
        for &at in &self.force {
            let part = &self.parts[at];
            let constant = numbers[part.number];
            if part.is_dashpot {
                let [a, b] = part.ends;
                add(&mut force, constant, &stamp.velocity[a]);
                add(&mut force, -constant, &stamp.velocity[b]);
            } else {
                part.deformation.iter().for_each(|&(at, sign)| force[at] += constant * sign);
            }
        }
        for ((own, value), scale) in stamp.force.iter_mut().zip(force).zip(&self.scales) {
            *own = value * scale;
        }
    }

    fn add_springs<const N: usize>(&self, numbers: &[f64], stamp: &mut Stamp<N>) {
        stamp.net.fill([0.0; N]);
        stamp.conductance.fill(0.0);
        stamp.velocity.fill([0.0; N]);
        for own in &self.weighed {
            stamp.velocity[own.body][own.unknown] = 1.0;
        }
        for part in &self.parts {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            if part.is_dashpot {
                stamp.conductance[a * self.bodies + b] += constant;
                stamp.conductance[b * self.bodies + a] += constant;
            } else {
                for &(at, sign) in &part.deformation {
                    stamp.net[a][at] -= constant * sign;
                    stamp.net[b][at] += constant * sign;
                }
            }
        }
    }

    /// The velocities of the massless bodies.
    fn solve_dashpots<const N: usize>(&self, stamp: &mut Stamp<N>) {
        let count = self.bodies;
        let mut first = 0;
        for Eliminated { body, neighbours } in &self.eliminated {
            let star = body * count;
            let total: f64 = neighbours.iter().map(|own| stamp.conductance[star + own.0]).sum();
            let load = stamp.net[*body];
            for (at, &(other, waits)) in neighbours.iter().enumerate() {
                let weight = stamp.conductance[star + other] / total;
                stamp.weights[first + at] = weight;
                if waits {
                    add(&mut stamp.net[other], weight, &load);
                }
                for &(next, _) in &neighbours[at + 1..] {
                    let link = weight * stamp.conductance[star + next];
                    stamp.conductance[other * count + next] += link;
                    stamp.conductance[next * count + other] += link;
                }
            }
            first += neighbours.len();
            add(&mut stamp.velocity[*body], total.recip(), &load);
        }
        for Eliminated { body, neighbours } in self.eliminated.iter().rev() {
            first -= neighbours.len();
            let mut sum = stamp.velocity[*body];
            for (at, &(other, _)) in neighbours.iter().enumerate() {
                add(&mut sum, stamp.weights[first + at], &stamp.velocity[other]);
            }
            stamp.velocity[*body] = sum;
        }
    }

    /// What the dashpots do to the masses.
    fn add_dashpots<const N: usize>(&self, numbers: &[f64], stamp: &mut Stamp<N>) {
        for part in self.parts.iter().filter(|part| part.is_dashpot) {
            let (constant, [a, b]) = (numbers[part.number], part.ends);
            let mut rate = stamp.velocity[a];
            subtract(&mut rate, &stamp.velocity[b]);
            add(&mut stamp.net[a], -constant, &rate);
            add(&mut stamp.net[b], constant, &rate);
        }
    }

    fn set_row<const N: usize>(
        &self,
        stamp: &mut Stamp<N>,
        unknown: usize,
        factor: f64,
        row: &[f64; N],
    ) {
        let factor = factor * self.time / self.scales[unknown];
        let columns = stamp.matrix.iter_mut().zip(row).zip(&self.scales);
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
