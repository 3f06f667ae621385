//! Which states of a matrix act on which.

use nalgebra::DMatrix;

/// Which states act on which, directly or through others: one row of bits for each state.
pub(super) struct Components {
    words: usize,
    bits: Vec<u64>,
}

impl Components {
    /// Those of the leading `n × n` block of a matrix.
    pub(super) fn of(a: &DMatrix<f64>, n: usize) -> Self {
        let words = n.div_ceil(64);
        let mut bits = vec![0; n * words];
        for (j, column) in a.column_iter().take(n).enumerate() {
            for (i, _) in column.iter().take(n).enumerate().filter(|(_, entry)| **entry != 0.0) {
                bits[i * words + j / 64] |= 1 << (j % 64);
            }
        }
        let mut components = Self { words, bits };
        for via in 0..n {
            for i in 0..n {
                if components.reaches(i, via) {
                    for word in 0..words {
                        components.bits[i * words + word] |= components.bits[via * words + word];
                    }
                }
            }
        }
        components
    }

    fn reaches(&self, i: usize, j: usize) -> bool {
        self.bits[i * self.words + j / 64] >> (j % 64) & 1 == 1
    }

    /// Whether both states act on each other.
    pub(super) fn together(&self, i: usize, j: usize) -> bool {
        self.reaches(i, j) && self.reaches(j, i)
    }

    /// The states in an order in which each acts on earlier ones, and those that act on it and on which it
    /// acts, only: those groups.
    pub(super) fn order(&self, n: usize) -> Vec<Vec<usize>> {
        let known = |i: usize| (0..n).filter(|&j| j == i || self.reaches(i, j)).count();
        let first = |i: usize| (0..i).find(|&j| self.together(i, j)).unwrap_or(i);
        let mut order: Vec<(usize, usize, usize)> =
            (0..n).map(|i| (usize::MAX - known(i), first(i), i)).collect();
        order.sort_unstable();
        let groups = order.chunk_by(|one, other| one.1 == other.1);
        groups.map(|group| group.iter().map(|own| own.2).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_acts_one_way_is_put_in_order() {
        // An oscillator (1, 3) that pulls another one along (0, 4), and an integral of the latter (2).
        let mut a = DMatrix::zeros(5, 5);
        for (i, j) in [(1, 3), (3, 1), (0, 4), (4, 0), (4, 3), (2, 0)] {
            a[(i, j)] = 1e-300;
        }
        let components = Components::of(&a, 5);
        assert_eq!(components.order(5), [vec![2], vec![0, 4], vec![1, 3]]);
        assert!(components.together(1, 3) && !components.together(0, 3));
    }
}
