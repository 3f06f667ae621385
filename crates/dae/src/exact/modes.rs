//! The modal form `Ā = X D X⁻¹`.

use nalgebra::DMatrix;

use super::{
    Augmented, Complex,
    block::Block,
    decoupling::{Clusters, Decoupling, invert_unit_triangle},
    schur::ComplexSchur,
};

/// `Ā X = X D` with block-diagonal `D`, to nearly twice the digits of a double where the size allows that.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Modes {
    /// `X`, rounded.
    pub(super) basis: DMatrix<Complex>,
    /// What rounding cut off `X`.
    pub(super) basis_low: DMatrix<Complex>,
    /// `X⁻¹`, approximately.
    pub(super) dual: DMatrix<Complex>,
    /// The blocks of `D`.
    pub(super) blocks: Vec<Block>,
    /// Pairs of blocks that are conjugate modes; the first one is evaluated, the second mirrors it.
    pub(super) pairs: Vec<(usize, usize)>,
    /// Entry by entry a bound of `X⁻¹ Ā X − D`: by how much the modes are still coupled.
    pub(super) defect: DMatrix<f64>,
    /// Entry by entry a bound of `1 − dual · X`: by how much the dual misses the inverse.
    pub(super) dual_defect: DMatrix<f64>,
}

impl Modes {
    /// The modes of a matrix of integrators in chains, which is triangular but for its order: its
    /// entries are kept as they are, and nothing is rounded.
    pub(super) fn of_chains(system: &Augmented, chains: &[Vec<usize>]) -> Self {
        let mut basis = DMatrix::zeros(system.size(), system.size());
        for (mode, state) in chains.concat().into_iter().enumerate() {
            basis[(state, mode)] = Complex::new(1.0, 0.0);
        }
        let dual = basis.transpose();
        let block = |chain: &Vec<usize>| {
            DMatrix::from_fn(chain.len(), chain.len(), |i, j| {
                Complex::new(system.matrix[(chain[i], chain[j])], 0.0)
            })
        };
        Self::graded(basis, dual, chains.iter().map(block), system.end())
    }

    /// The whole matrix as one block.
    pub(super) fn undivided(system: &Augmented) -> Self {
        let size = system.size();
        let one = DMatrix::identity(size, size);
        let matrix = system.matrix.map(|x| Complex::new(x, 0.0));
        let blocks = if size == 0 { Vec::new() } else { vec![Block::new(0, matrix)] };
        let defect = DMatrix::from_element(size, size, f64::INFINITY);
        Self { defect, ..Self::of(one.clone(), one, blocks) }
    }

    /// The modes of a Schur form whose clusters have been decoupled.
    pub(super) fn assemble(schur: &ComplexSchur, decoupling: &Decoupling, horizon: f64) -> Self {
        let basis = &schur.basis * &decoupling.transform;
        let dual = invert_unit_triangle(&decoupling.transform) * schur.basis.adjoint();
        let mut start = 0;
        let block = |&len: &usize| {
            start += len;
            schur.triangle.view((start - len, start - len), (len, len)).into_owned()
        };
        Self::graded(basis, dual, decoupling.sizes.iter().map(block), horizon)
    }

    /// The modes of these triangular blocks one after the other, in units in which their couplings act on
    /// the time scale of the run; see [`units`].
    fn graded(
        mut basis: DMatrix<Complex>,
        mut dual: DMatrix<Complex>,
        triangles: impl Iterator<Item = DMatrix<Complex>>,
        horizon: f64,
    ) -> Self {
        let mut start = 0;
        let block = |mut matrix: DMatrix<Complex>| {
            for (i, unit) in units(&matrix, horizon).into_iter().enumerate() {
                basis.column_mut(start + i).apply(|z| *z *= unit);
                dual.row_mut(start + i).apply(|z| *z /= unit);
                matrix.column_mut(i).apply(|z| *z *= unit);
                matrix.row_mut(i).apply(|z| *z /= unit);
            }
            let block = Block::new(start, matrix);
            start += block.len();
            block
        };
        let blocks = triangles.map(block).collect();
        Self::of(basis, dual, blocks)
    }

    /// Modes of which nothing is known to be wrong yet.
    fn of(basis: DMatrix<Complex>, dual: DMatrix<Complex>, blocks: Vec<Block>) -> Self {
        let size = basis.nrows();
        Self {
            basis,
            basis_low: DMatrix::zeros(size, size),
            dual,
            blocks,
            pairs: Vec::new(),
            defect: DMatrix::zeros(size, size),
            dual_defect: DMatrix::zeros(size, size),
        }
    }

    /// Number of modes.
    pub(super) fn len(&self) -> usize {
        self.dual.nrows()
    }

    /// Pairs single complex modes with their conjugates.
    pub(super) fn pair_conjugates(&mut self, clusters: &Clusters) {
        let label = |block: &Block| clusters.labels[block.start];
        for i in 0..self.blocks.len() {
            let block = &self.blocks[i];
            if block.len() > 1 || block.matrix[(0, 0)].im <= 0.0 {
                continue;
            }
            let conjugate = clusters.conjugate(label(block));
            let is_partner = |j: &usize| *j != i && label(&self.blocks[*j]) == conjugate;
            if let Some(j) = (0..self.blocks.len()).find(is_partner) {
                self.blocks[i].weight = 2.0;
                self.blocks[j].weight = 0.0;
                self.pairs.push((i, j));
            }
        }
        self.mirror();
    }

    /// Makes the second mode of each pair the exact conjugate of the first.
    pub(super) fn mirror(&mut self) {
        for &(i, j) in &self.pairs {
            self.blocks[j].matrix = self.blocks[i].matrix.conjugate();
            self.blocks[j].low = self.blocks[i].low.conjugate();
            let (from, to) = (self.blocks[i].start, self.blocks[j].start);
            for matrix in [&mut self.basis, &mut self.basis_low] {
                let column = matrix.column(from).conjugate();
                matrix.set_column(to, &column);
            }
            let row = self.dual.row(from).conjugate();
            self.dual.set_row(to, &row);
        }
    }
}

/// The states in an order in which each depends on later ones only, apart for each set of states that
/// have nothing to do with the others. `None` where a state acts back on itself.
pub(super) fn chains(matrix: &DMatrix<f64>) -> Option<Vec<Vec<usize>>> {
    let size = matrix.nrows();
    let mut waits: Vec<usize> =
        (0..size).map(|j| (0..size).filter(|&i| matrix[(i, j)] != 0.0).count()).collect();
    let mut set: Vec<usize> = (0..size).collect();
    let mut order: Vec<usize> = (0..size).filter(|&j| waits[j] == 0).collect();
    let mut at = 0;
    while let Some(&i) = order.get(at) {
        for j in (0..size).filter(|&j| matrix[(i, j)] != 0.0) {
            waits[j] -= 1;
            if waits[j] == 0 {
                order.push(j);
            }
            let (keep, drop) = (set[i].min(set[j]), set[i].max(set[j]));
            set.iter_mut().filter(|own| **own == drop).for_each(|own| *own = keep);
        }
        at += 1;
    }
    let all = |keep: usize| -> Vec<usize> {
        order.iter().copied().filter(|&state| set[state] == keep).collect()
    };
    let is_whole = order.len() == size;
    is_whole.then(|| (0..size).map(all).filter(|chain| !chain.is_empty()).collect())
}

/// Factors for a triangular block's basis, powers of two and as few as needed, after which its
/// couplings act on the time scale of the run: `|T_ij| u_j/u_i · horizon ≤ 1`.
fn units(triangle: &DMatrix<Complex>, horizon: f64) -> Vec<f64> {
    let mut exponents: Vec<f64> = Vec::with_capacity(triangle.nrows());
    for j in 0..triangle.nrows() {
        let wanted = |(i, exponent): (usize, &f64)| {
            exponent - (triangle[(i, j)].norm() * horizon).log2().ceil()
        };
        exponents.push(exponents.iter().enumerate().map(wanted).fold(0.0, f64::min).max(-600.0));
    }
    exponents.into_iter().map(f64::exp2).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrators_are_put_in_order_and_those_apart_are_told_apart() {
        // Two bodies in free flight, of which one is driven by a constant; unknowns in any order.
        let mut a = DMatrix::zeros(5, 5);
        (a[(0, 2)], a[(3, 1)], a[(1, 4)]) = (2.0, 3.0, -1.0);
        let found = chains(&a).unwrap();
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [2, 3]);
        for chain in &found {
            for (i, &row) in chain.iter().enumerate() {
                assert!((0..=i).all(|j| a[(row, chain[j])] == 0.0), "{found:?}");
            }
        }
        a[(4, 3)] = 1e-300;
        assert!(chains(&a).is_none(), "an oscillator");
    }
}
