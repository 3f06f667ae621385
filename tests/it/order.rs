//! The degree of det(s² M + s C + K), exactly, in arithmetic modulo a prime.
//!
//! Independent of the compiler: every constant that is not zero becomes a random residue, so the
//! degree is that of the generic network with the same graph. The probability that a random zero
//! lowers it is below 10⁻¹⁶ for the sizes here.

use crate::random_networks::{Dice, Recipe};

const PRIME: u128 = (1 << 61) - 1;

/// M, C and K of a network with residues for its constants.
pub(crate) struct Pencil {
    size: usize,
    /// Node, or pair of nodes (the size stands for the ground), and power of s.
    masses: Vec<usize>,
    elements: Vec<(usize, usize, u32)>,
}

impl Pencil {
    pub(crate) fn of(recipe: &Recipe) -> Self {
        Self {
            size: recipe.nodes.len(),
            masses: (0..recipe.nodes.len()).filter(|&at| recipe.nodes[at].0 > 0.0).collect(),
            elements: recipe
                .elements
                .iter()
                .map(|&(a, b, is_spring, _)| (a, b, u32::from(!is_spring)))
                .collect(),
        }
    }

    /// The degree, or `None` if the determinant vanishes for all s.
    pub(crate) fn degree(&self, dice: &mut Dice) -> Option<usize> {
        let mut residue = || u128::from(dice.next()) % (PRIME - 1) + 1;
        let masses: Vec<u128> = self.masses.iter().map(|_| residue()).collect();
        let constants: Vec<u128> = self.elements.iter().map(|_| residue()).collect();
        let points = 2 * self.size + 1;
        let values: Vec<u128> =
            (0..points).map(|s| self.determinant(s as u128 + 2, &masses, &constants)).collect();
        let divided = divided_differences(&values);
        (0..points).rev().find(|&order| divided[order] != 0)
    }

    fn determinant(&self, s: u128, masses: &[u128], constants: &[u128]) -> u128 {
        let n = self.size;
        let mut matrix = vec![vec![0u128; n]; n];
        for (&at, mass) in self.masses.iter().zip(masses) {
            matrix[at][at] = (matrix[at][at] + mass * (s * s % PRIME)) % PRIME;
        }
        for (&(a, b, power), constant) in self.elements.iter().zip(constants) {
            let value = if power == 1 { constant * s % PRIME } else { *constant };
            for (i, j) in [(a, b), (b, a)] {
                if i < n {
                    matrix[i][i] = (matrix[i][i] + value) % PRIME;
                    if j < n {
                        matrix[i][j] = (matrix[i][j] + PRIME - value) % PRIME;
                    }
                }
            }
        }
        eliminate(matrix)
    }
}

fn eliminate(mut matrix: Vec<Vec<u128>>) -> u128 {
    let n = matrix.len();
    let mut determinant = 1;
    for column in 0..n {
        let Some(pivot) = (column..n).find(|&row| matrix[row][column] != 0) else { return 0 };
        if pivot != column {
            matrix.swap(pivot, column);
            determinant = PRIME - determinant;
        }
        determinant = determinant * matrix[column][column] % PRIME;
        let inverse = power(matrix[column][column], PRIME - 2);
        for row in column + 1..n {
            let factor = matrix[row][column] * inverse % PRIME;
            for at in column..n {
                let change = factor * matrix[column][at] % PRIME;
                matrix[row][at] = (matrix[row][at] + PRIME - change) % PRIME;
            }
        }
    }
    determinant % PRIME
}

fn power(mut base: u128, mut exponent: u128) -> u128 {
    let mut result = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = result * base % PRIME;
        }
        base = base * base % PRIME;
        exponent >>= 1;
    }
    result
}

/// Newton's divided differences at the points 2, 3, 4, …; the last that is not zero has the
/// polynomial's degree as its order.
fn divided_differences(values: &[u128]) -> Vec<u128> {
    let mut table = values.to_vec();
    for order in 1..table.len() {
        let inverse = power(order as u128, PRIME - 2);
        for at in (order..table.len()).rev() {
            table[at] = (table[at] + PRIME - table[at - 1]) % PRIME * inverse % PRIME;
        }
    }
    table
}
