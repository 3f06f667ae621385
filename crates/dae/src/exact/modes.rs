//! The modal form `Ā = X D X⁻¹`.

use nalgebra::DMatrix;

use super::{
    Augmented, Complex,
    block::Block,
    clusters::Clusters,
    decoupling::{Caution, Decoupling, decouple, invert_unit_triangle},
    refinement,
    schur::ComplexSchur,
};

/// `Ā X = X D` with block-diagonal `D`, to nearly twice the digits of a double where the size
/// allows that.
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
    /// The modes of an augmented system over its run.
    ///
    /// Eigenvalues that the refinement finds to be alike are joined, and the rest begun anew. Where
    /// the eigenvalue iteration fails, the whole matrix is taken as one block: slower, and without
    /// an error bound, but with the right values.
    pub(super) fn new(system: &Augmented, caution: Caution) -> Self {
        if let Some(chains) = chains(&system.matrix) {
            return Self::of_chains(system, &chains);
        }
        let Some(mut schur) = augmented_schur(system) else { return Self::undivided(system) };
        let mut clusters = Clusters::single(&schur);
        loop {
            let decoupling = decouple(&mut schur, &mut clusters, system.end(), caution);
            let mut modes = Self::assemble(&schur, &decoupling, system.end());
            modes.pair_conjugates(&clusters);
            let alike = refinement::refine(&system.matrix, &mut modes);
            if alike.is_empty() {
                let known = modes.defect.iter().all(|d| d.is_finite());
                return if known { modes } else { Self::undivided(system) };
            }
            clusters.join(&alike);
        }
    }

    /// The modes of a matrix of integrators in chains, which is triangular but for its order: its
    /// entries are kept as they are, and nothing is rounded.
    fn of_chains(system: &Augmented, chains: &[Vec<usize>]) -> Self {
        let size = system.size();
        let mut basis = DMatrix::zeros(size, size);
        let mut dual = DMatrix::zeros(size, size);
        let mut blocks = Vec::with_capacity(chains.len());
        let mut start = 0;
        for chain in chains {
            let mut matrix = DMatrix::from_fn(chain.len(), chain.len(), |i, j| {
                Complex::new(system.matrix[(chain[i], chain[j])], 0.0)
            });
            for (i, unit) in graded(&matrix, system.end()).into_iter().enumerate() {
                basis[(chain[i], start + i)] = Complex::new(unit, 0.0);
                dual[(start + i, chain[i])] = Complex::new(unit.recip(), 0.0);
                matrix.column_mut(i).apply(|z| *z *= unit);
                matrix.row_mut(i).apply(|z| *z /= unit);
            }
            blocks.push(Block::new(start, matrix));
            start += chain.len();
        }
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

    /// The whole matrix as one block.
    pub(super) fn undivided(system: &Augmented) -> Self {
        let size = system.size();
        let matrix = system.matrix.map(|x| Complex::new(x, 0.0));
        let defect = DMatrix::from_element(size, size, f64::INFINITY);
        Self {
            basis: DMatrix::identity(size, size),
            basis_low: DMatrix::zeros(size, size),
            dual: DMatrix::identity(size, size),
            blocks: if size == 0 { Vec::new() } else { vec![Block::new(0, matrix)] },
            pairs: Vec::new(),
            defect,
            dual_defect: DMatrix::zeros(size, size),
        }
    }

    fn assemble(schur: &ComplexSchur, decoupling: &Decoupling, horizon: f64) -> Self {
        let size = schur.triangle.nrows();
        let mut basis = &schur.basis * &decoupling.transform;
        let mut dual = invert_unit_triangle(&decoupling.transform) * schur.basis.adjoint();
        let mut blocks = Vec::with_capacity(decoupling.sizes.len());
        let mut start = 0;
        for &len in &decoupling.sizes {
            let mut matrix = schur.triangle.view((start, start), (len, len)).into_owned();
            for (i, unit) in graded(&matrix, horizon).into_iter().enumerate() {
                basis.column_mut(start + i).apply(|z| *z *= unit);
                dual.row_mut(start + i).apply(|z| *z /= unit);
                matrix.column_mut(i).apply(|z| *z *= unit);
                matrix.row_mut(i).apply(|z| *z /= unit);
            }
            blocks.push(Block::new(start, matrix));
            start += len;
        }
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
    fn pair_conjugates(&mut self, clusters: &Clusters) {
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
fn chains(matrix: &DMatrix<f64>) -> Option<Vec<Vec<usize>>> {
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
fn graded(triangle: &DMatrix<Complex>, horizon: f64) -> Vec<f64> {
    let mut exponents: Vec<f64> = Vec::with_capacity(triangle.nrows());
    for j in 0..triangle.nrows() {
        let wanted = |(i, exponent): (usize, &f64)| {
            exponent - (triangle[(i, j)].norm() * horizon).log2().ceil()
        };
        exponents.push(exponents.iter().enumerate().map(wanted).fold(0.0, f64::min).max(-600.0));
    }
    exponents.into_iter().map(f64::exp2).collect()
}

/// The Schur form of `[A B; 0 G]`: that of `A` by iteration, that of the generators by hand, so
/// that their eigenvalues `0` and `±iω` are exact.
fn augmented_schur(system: &Augmented) -> Option<ComplexSchur> {
    let (states, size) = (system.states, system.size());
    let inner = ComplexSchur::new(&system.matrix.view((0, 0), (states, states)).into_owned())?;
    if size == states {
        return Some(inner);
    }
    let complex = |x: f64| Complex::new(x, 0.0);
    let mut basis = DMatrix::identity(size, size);
    let mut triangle = DMatrix::zeros(size, size);
    basis.view_mut((0, 0), (states, states)).copy_from(&inner.basis);
    triangle.view_mut((0, 0), (states, states)).copy_from(&inner.triangle);
    let generators = size - states;
    let corner = system.matrix.view((states, states), (generators, generators));
    triangle.view_mut((states, states), (generators, generators)).copy_from(&corner.map(complex));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for (at, omega) in system.generators.waves() {
        let (p, q) = (states + at, states + at + 1);
        // p' = ω q, q' = −ω p: the vectors (1, ±i)/√2 belong to ±iω.
        basis[(p, p)] = complex(half);
        basis[(p, q)] = complex(half);
        basis[(q, p)] = Complex::new(0.0, half);
        basis[(q, q)] = Complex::new(0.0, -half);
        triangle[(p, p)] = Complex::new(0.0, omega);
        triangle[(q, q)] = Complex::new(0.0, -omega);
        triangle[(p, q)] = Complex::default();
        triangle[(q, p)] = Complex::default();
    }
    let coupling = system.matrix.view((0, states), (states, generators)).map(complex);
    let turned = inner.basis.adjoint() * coupling;
    let outer = basis.view((states, states), (generators, generators)).into_owned();
    triangle.view_mut((0, states), (states, generators)).copy_from(&(turned * outer));
    Some(ComplexSchur { basis, triangle })
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
