//! Values and slopes that satisfy the balances at the start of a span.

use diffsol::{Context as _, DiffsolError, LinearSolver, NonLinearOp, NonLinearOpJacobian, Op};
use nalgebra_sparse::CsrMatrix;

use super::{
    algebra::{Algebra, Slice, entries, matrix, pattern},
    equations::Equations,
};
use crate::{System, UnknownKind};

/// The factorised matrix that keeps the differential unknowns and solves the rows `0 = J y + B w`
/// for the algebraic ones: the identity in the rows of the former, `J` in those of the latter.
///
/// One linear solve gives consistent values; another, of the differentiated rows, gives the slopes
/// of the algebraic unknowns. The integrators' own start would iterate on the whole system and
/// leave these slopes at zero, which spoils the first step's dense output.
pub(super) struct Balance<M: Algebra> {
    factor: M::Factor,
    algebraic: Vec<usize>,
}

/// A matrix as the operator that the factorisations ask for.
struct Stored<M: Algebra> {
    context: M::C,
    matrix: M,
}

impl<M: Algebra> Op for Stored<M> {
    type T = f64;
    type V = M::V;
    type M = M;
    type C = M::C;

    fn context(&self) -> &M::C {
        &self.context
    }

    fn nstates(&self) -> usize {
        self.matrix.ncols()
    }

    fn nout(&self) -> usize {
        self.matrix.nrows()
    }

    fn nparams(&self) -> usize {
        0
    }
}

impl<M: Algebra> NonLinearOp for Stored<M> {
    fn call_inplace(&self, x: &M::V, _t: f64, out: &mut M::V) {
        self.matrix.gemv(1.0, x, 0.0, out);
    }
}

impl<M: Algebra> NonLinearOpJacobian for Stored<M> {
    fn jac_mul_inplace(&self, _x: &M::V, t: f64, v: &M::V, out: &mut M::V) {
        self.call_inplace(v, t, out);
    }

    fn jacobian_inplace(&self, _x: &M::V, _t: f64, out: &mut M) {
        out.copy_from(&self.matrix);
    }

    fn jacobian_sparsity(&self) -> Option<M::Sparsity> {
        pattern(&self.matrix)
    }
}

impl<M: Algebra> Balance<M> {
    /// Factorises the balances of `system`; `None` where it has no algebraic unknown.
    ///
    /// The block of the algebraic unknowns must have a structural rank of its own, see
    /// [`undetermined`].
    pub(super) fn new(system: &System) -> Result<Option<Self>, DiffsolError> {
        let algebraic: Vec<usize> = algebraic(system).collect();
        if algebraic.is_empty() {
            return Ok(None);
        }
        let kind = |row: usize| system.unknowns[row].kind;
        let kept = (0..system.len())
            .filter(|&row| kind(row) == UnknownKind::Differential)
            .map(|row| (row, row, 1.0));
        let balances =
            entries(&system.jacobian).filter(|entry| kind(entry.0) == UnknownKind::Algebraic);
        let context = M::C::default();
        let zero: M::V = context.vector_zeros(system.len());
        let stored = Stored { context, matrix: matrix::<M>(system.len(), kept.chain(balances))? };
        let mut factor = M::Factor::default();
        factor.set_problem(&stored);
        factor.set_linearisation(&stored, &zero, 0.0);
        Ok(Some(Self { factor, algebraic }))
    }

    /// Replaces the algebraic entries of `state` by those that satisfy the balances at the start of
    /// the span that `equations` have entered.
    pub(super) fn values(
        &self,
        equations: &Equations<'_, M>,
        state: &mut [f64],
    ) -> Result<(), DiffsolError> {
        self.solve(&equations.driven(0), state)
    }

    /// Replaces the algebraic entries of `slopes` by those that keep the balances satisfied, given
    /// the slopes of the differential unknowns.
    pub(super) fn slopes(
        &self,
        equations: &Equations<'_, M>,
        slopes: &mut [f64],
    ) -> Result<(), DiffsolError> {
        self.solve(&equations.driven(1), slopes)
    }

    fn solve(&self, driven: &[f64], numbers: &mut [f64]) -> Result<(), DiffsolError> {
        let mut right = numbers.to_vec();
        for &row in &self.algebraic {
            right[row] = -driven[row];
        }
        let mut vector: M::V = M::C::default().vector_from_vec(right);
        solve(&self.factor, &mut vector)?;
        for &row in &self.algebraic {
            numbers[row] = vector.slice()[row];
        }
        Ok(())
    }
}

/// Solves with a factorised matrix.
fn solve<M: Algebra, F: LinearSolver<M>>(
    factor: &F,
    vector: &mut M::V,
) -> Result<(), DiffsolError> {
    Ok(factor.solve_in_place(vector)?)
}

/// The algebraic unknowns in order.
fn algebraic(system: &System) -> impl Iterator<Item = usize> {
    let kinds = system.unknowns.iter().map(|unknown| unknown.kind).enumerate();
    kinds.filter(|&(_, kind)| kind == UnknownKind::Algebraic).map(|(at, _)| at)
}

/// An algebraic unknown that no balance can be assigned to, whatever the values of the matrix.
///
/// The sparse factorisation cannot be asked for a matrix of deficient structure, so that this has to
/// be found before.
pub(super) fn undetermined(system: &System) -> Option<usize> {
    if system.algebraic() == 0 {
        return None;
    }
    let mut assignment = Assignment {
        jacobian: &system.jacobian,
        system,
        owner: vec![None; system.len()],
        visited: vec![usize::MAX; system.len()],
    };
    let diagonal = |&row: &usize| assignment.candidates(row).contains(&row);
    let (own, rest): (Vec<_>, Vec<_>) = algebraic(system).partition(diagonal);
    for row in own {
        assignment.owner[row] = Some(row);
    }
    rest.into_iter().find(|&row| !assignment.augment(row))
}

/// Which balance each algebraic unknown is assigned to.
struct Assignment<'s> {
    jacobian: &'s CsrMatrix<f64>,
    system: &'s System,
    owner: Vec<Option<usize>>,
    visited: Vec<usize>,
}

impl Assignment<'_> {
    /// The algebraic unknowns that appear in a balance.
    fn candidates(&self, row: usize) -> Vec<usize> {
        let row = self.jacobian.row(row);
        let terms = row.col_indices().iter().zip(row.values());
        let wanted = |column: usize, value: f64| {
            value != 0.0 && self.system.unknowns[column].kind == UnknownKind::Algebraic
        };
        terms
            .filter(|&(&column, &value)| wanted(column, value))
            .map(|(&column, _)| column)
            .collect()
    }

    /// Gives the balance `root` an unknown of its own, by an augmenting path found depth first.
    fn augment(&mut self, root: usize) -> bool {
        let mut path = vec![(root, self.candidates(root), 0_usize)];
        while let Some((_, columns, next)) = path.last_mut() {
            let Some(&column) = columns.get(*next) else {
                path.pop();
                continue;
            };
            *next += 1;
            if self.visited[column] == root {
                continue;
            }
            self.visited[column] = root;
            if let Some(row) = self.owner[column] {
                let candidates = self.candidates(row);
                path.push((row, candidates, 0));
            } else {
                for (row, columns, next) in path {
                    self.owner[columns[next - 1]] = Some(row);
                }
                return true;
            }
        }
        false
    }
}
