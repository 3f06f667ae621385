//! Balances of linked bodies, by star–mesh elimination in twice the digits of a double.

use dashpot_numerics::DoubleDouble;

use super::circuit::{Ends, Link};

/// Conductances between bodies and to what is held. The matrix of the balances has the sums on its
/// diagonal; these are never formed by subtraction.
#[derive(Debug, Clone)]
pub(super) struct Links {
    between: Vec<Vec<DoubleDouble>>,
    ground: Vec<DoubleDouble>,
}

/// The triangular factor `L` of the matrix of balances, `L Lᵀ`.
#[derive(Debug, Clone)]
pub(super) struct Factor {
    /// Row `i` has the entries of the columns `0..=i`. A diagonal entry is zero where a part is
    /// held by nothing; that column is empty.
    rows: Vec<Vec<DoubleDouble>>,
}

impl Links {
    pub(super) fn new(bodies: usize) -> Self {
        let zero = DoubleDouble::ZERO;
        Self { between: vec![vec![zero; bodies]; bodies], ground: vec![zero; bodies] }
    }

    pub(super) fn of<'a>(bodies: usize, links: impl IntoIterator<Item = &'a Link>) -> Self {
        let mut all = Self::new(bodies);
        links.into_iter().for_each(|link| all.add(link.ends, link.constant));
        all
    }

    pub(super) fn add(&mut self, ends: Ends, conductance: DoubleDouble) {
        match ends {
            [Some(p), Some(q)] if p != q => {
                self.between[p][q] += conductance;
                self.between[q][p] += conductance;
            }
            [Some(p), None] | [None, Some(p)] => self.ground[p] += conductance,
            _ => {}
        }
    }

    /// Eliminates the bodies in their order.
    pub(super) fn factor(mut self) -> Factor {
        let count = self.ground.len();
        let zero = DoubleDouble::ZERO;
        let mut rows: Vec<Vec<DoubleDouble>> = (0..count).map(|row| vec![zero; row + 1]).collect();
        for at in 0..count {
            let sum = (at + 1..count).fold(self.ground[at], |sum, j| sum + self.between[at][j]);
            if sum <= 0.0 {
                continue;
            }
            let root = sum.sqrt();
            rows[at][at] = root;
            let linked: Vec<usize> =
                (at + 1..count).filter(|&j| self.between[at][j] > 0.0).collect();
            for &i in &linked {
                let share = self.between[at][i] / sum;
                rows[i][at] = -(self.between[at][i] / root);
                let held = share * self.ground[at];
                self.ground[i] += held;
                for &j in &linked {
                    if j != i {
                        let link = share * self.between[at][j];
                        self.between[i][j] += link;
                    }
                }
            }
        }
        Factor { rows }
    }
}

impl Factor {
    /// Solves `L z = b` in place; entries of what nothing holds become zero.
    pub(super) fn solve_lower(&self, b: &mut [DoubleDouble]) {
        for i in 0..b.len() {
            let pivot = self.rows[i][i];
            b[i] = if pivot > 0.0 {
                let known = self.rows[i][..i].iter().zip(&b[..i]);
                known.fold(b[i], |rest, (l, z)| rest - *l * *z) / pivot
            } else {
                DoubleDouble::ZERO
            };
        }
    }

    /// Solves `Lᵀ x = z` in place; what nothing holds stays where it is.
    pub(super) fn solve_upper(&self, z: &mut [DoubleDouble]) {
        for i in (0..z.len()).rev() {
            let pivot = self.rows[i][i];
            let rest = (i + 1..z.len()).fold(z[i], |rest, j| rest - self.rows[j][i] * z[j]);
            z[i] = if pivot > 0.0 { rest / pivot } else { DoubleDouble::ZERO };
        }
    }

    /// The columns of `L` that are not empty.
    pub(super) fn columns(&self) -> Vec<Vec<DoubleDouble>> {
        let count = self.rows.len();
        let column = |at: usize| {
            (0..count).map(|i| if i < at { DoubleDouble::ZERO } else { self.rows[i][at] }).collect()
        };
        (0..count).filter(|&at| self.rows[at][at] > 0.0).map(column).collect()
    }
}

/// The unit pair of forces as a vector.
pub(super) fn pair(bodies: usize, forces: Ends) -> Vec<DoubleDouble> {
    let mut vector = vec![DoubleDouble::ZERO; bodies];
    for (end, sign) in forces.into_iter().zip([1.0, -1.0]) {
        if let Some(body) = end {
            vector[body] = vector[body] + sign;
        }
    }
    vector
}

/// Inner product.
pub(super) fn dot(a: &[DoubleDouble], b: &[DoubleDouble]) -> DoubleDouble {
    a.iter().zip(b).fold(DoubleDouble::ZERO, |sum, (a, b)| sum + *a * *b)
}
