//! The system of one network of a form.

use dashpot_numerics::small::Square;

use super::{ParametricSystem, curve::CurveRow, parted::Parted};

/// The system of one network: `ż = A z` in dimensionless time, padded with zeros to `N` unknowns. Behind the
/// unknowns stand the force of each law that is not linear, and the number 1 where constant forces act.
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
    /// What is left once what strikes has been let go.
    pub(super) parted: Option<Parted<N>>,
    /// The values of the [tape](super::tape).
    pub(super) values: Vec<f64>,
}

impl ParametricSystem {
    /// Room for systems of this form; `None` where they have more than `N` unknowns.
    pub fn instance<const N: usize>(&self) -> Option<Instance<N>> {
        if self.states() > N {
            return None;
        }
        let mut start = [0.0; N];
        if let Some(one) = self.one {
            start[one] = 1.0;
        }
        Some(Instance {
            matrix: [[0.0; N]; N],
            start,
            force: [0.0; N],
            deformation: [0.0; N],
            curves: Vec::with_capacity(self.curves.len()),
            parted: None,
            values: self.tape.values(),
        })
    }

    /// Writes the system with these [`numbers`](Self::numbers) into an instance; false where a law has none
    /// with them. Nothing is allocated but laws whose numbers differ from those before.
    ///
    /// # Panics
    ///
    /// When the instance or the numbers are those of another form.
    pub fn fill<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) -> bool {
        let Instance { matrix, start, force, deformation, values, .. } = instance;
        self.tape.run(numbers, values);
        for (row, rate) in self.rates.iter().enumerate() {
            for term in &rate.terms {
                matrix[term.column][row] = term.at(values);
            }
        }
        for own in &self.weighed {
            let speed = numbers[own.numbers[1]] - own.base.map_or(0.0, |base| numbers[base]);
            start[own.unknown] = speed / self.scales[own.unknown];
        }
        *force = self.force.at(values);
        *deformation = self.deformation.at(values);
        self.add_curves(numbers, instance)
    }

    /// Writes the laws that are not linear.
    fn add_curves<const N: usize>(&self, numbers: &[f64], instance: &mut Instance<N>) -> bool {
        for (at, curve) in self.curves.iter().enumerate() {
            let own = &numbers[curve.numbers.clone()];
            let deformation = curve.deformation.at(&instance.values);
            let rate = if curve.has_rate { curve.rate.at(&instance.values) } else { [0.0; N] };
            let is_same = |row: &CurveRow<N>| row.numbers == own;
            if let Some(row) = instance.curves.get_mut(at).filter(|row| is_same(row)) {
                (row.deformation, row.rate) = (deformation, rate);
                continue;
            }
            let Some(law) = curve.law(own) else {
                instance.curves.clear();
                return false;
            };
            let slot = self.unknowns + at;
            let row = CurveRow { law, slot, deformation, rate, numbers: own.to_vec() };
            match instance.curves.get_mut(at) {
                Some(known) => *known = row,
                None => instance.curves.push(row),
            }
        }
        true
    }
}
