//! Values and slopes that satisfy the balances at the start of a span.

use diffsol::{Context as _, DiffsolError, LinearSolver, NonLinearOp, NonLinearOpJacobian, Op};
use nalgebra_sparse::CsrMatrix;

use super::{
    algebra::{Algebra, Slice, entries, matrix, pattern, square_operator},
    equations::Equations,
    terms::{self, Places, Slopes, Terms},
};
use crate::{System, Term, UnknownKind};

/// Why the algebraic unknowns have no consistent values or slopes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Imbalance {
    /// The linearised balances do not determine them.
    Singular,
    /// No values were found that satisfy the balance of this unknown.
    Unsettled {
        /// The unknown.
        unknown: usize,
    },
}

impl From<DiffsolError> for Imbalance {
    fn from(_: DiffsolError) -> Self {
        Self::Singular
    }
}

/// The factorised matrix that keeps the differential unknowns and solves the rows
/// `0 = J y + B w + n(y, w)`, linearised, for the algebraic ones: the identity in the rows of the
/// former, `J` and the slopes of the terms in those of the latter.
///
/// One linear solve gives consistent values, or a few where there are terms; another, of the differentiated rows, gives
/// the slopes of the algebraic unknowns. The integrators' own start would iterate on the whole system and leave these
/// slopes at zero, which spoils the first step's dense output.
pub(super) struct Balance<M: Algebra> {
    factor: M::Factor,
    algebraic: Vec<usize>,
    /// Whether the columns of the differential unknowns are left out and their part of the balances
    /// is brought to the other side, so that no elimination mixes small numbers with large ones.
    apart: bool,
    curved: Option<Curved<M>>,
    /// Factorisations and linear solves so far.
    work: (usize, usize),
}

/// A matrix that is factorised anew wherever the slopes of the terms are others.
struct Curved<M: Algebra> {
    stored: Stored<M>,
    /// Its values without the terms.
    base: Vec<f64>,
    places: Places,
    /// Which slopes it holds.
    kind: Slopes,
}

/// A matrix as the operator that the factorisations ask for.
struct Stored<M: Algebra> {
    context: M::C,
    matrix: M,
}

square_operator!(Stored<M>, |own| own.matrix.nrows());

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
    /// The balances of `system`, factorised if they are linear; `None` where it has no algebraic unknown.
    ///
    /// The block of the algebraic unknowns must have a structural rank of its own, see
    /// [`undetermined`].
    pub(super) fn new(system: &System) -> Result<Option<Self>, DiffsolError> {
        Self::build(system, !system.is_linear())
    }

    /// As [`new`](Self::new), with each algebraic unknown as accurate as its own balance permits,
    /// however large the others are.
    pub(super) fn apart(system: &System) -> Result<Option<Self>, DiffsolError> {
        Self::build(system, true)
    }

    fn build(system: &System, apart: bool) -> Result<Option<Self>, DiffsolError> {
        let algebraic: Vec<usize> = algebraic(system).collect();
        if algebraic.is_empty() {
            return Ok(None);
        }
        let kind = |row: usize| system.unknowns[row].kind;
        let kept = (0..system.len())
            .filter(|&row| kind(row) == UnknownKind::Differential)
            .map(|row| (row, row, 1.0));
        // Dense matrices keep the last of several entries, sparse ones add them up.
        let room = terms::pattern(system).map(|(row, column)| (row, column, 0.0));
        let balances = room.chain(entries(&system.jacobian)).filter(|&(row, column, _)| {
            let counts = !apart || kind(column) == UnknownKind::Algebraic;
            kind(row) == UnknownKind::Algebraic && counts
        });
        let context = M::C::default();
        let matrix = matrix::<M>(system.len(), kept.chain(balances))?;
        let stored = Stored { context, matrix };
        let mut factor = M::Factor::default();
        factor.set_problem(&stored);
        let mut balance = Self { factor, algebraic, apart, curved: None, work: (0, 0) };
        if let Some(terms) = Terms::of(system) {
            let columns = |column| kind(column) == UnknownKind::Algebraic;
            let places = terms.places(&stored.matrix, columns);
            let base = stored.matrix.values().to_vec();
            balance.curved = Some(Curved { stored, base, places, kind: Slopes::Own });
        } else {
            balance.factorise(&stored);
        }
        Ok(Some(balance))
    }

    fn factorise(&mut self, stored: &Stored<M>) {
        let zero: M::V = stored.context.vector_zeros(stored.nstates());
        self.factor.set_linearisation(stored, &zero, 0.0);
        self.work.0 += 1;
    }

    /// Whether no term makes the balances other than linear.
    pub(super) fn is_linear(&self) -> bool {
        self.curved.is_none()
    }

    /// The algebraic unknowns in order.
    pub(super) fn algebraic(&self) -> &[usize] {
        &self.algebraic
    }

    /// Factorisations and linear solves so far.
    pub(super) fn work(&self) -> (usize, usize) {
        self.work
    }

    /// Replaces the algebraic entries of `slopes`, the `order`-th derivatives of the unknowns at
    /// `state`, by those that keep the balances satisfied, given those of the differential unknowns.
    ///
    /// The terms are linear with their slopes at `state`.
    pub(super) fn slopes(
        &mut self,
        order: u32,
        equations: &Equations<'_, M>,
        state: &[f64],
        slopes: &mut [f64],
    ) -> Result<(), DiffsolError> {
        let mut driven = equations.driven(order);
        if let (Some(terms), Some(curved)) = (equations.terms(), &self.curved) {
            let point = (equations.start(), state);
            terms.add_drive(order, point, curved.kind, &mut driven);
            terms.add_product(point, curved.kind, &self.differential(slopes), &mut driven);
        }
        self.solve(equations, driven, slopes)
    }

    /// Factorises the balances, linearised at `state`.
    pub(super) fn linearise(&mut self, equations: &Equations<'_, M>, state: &[f64], kind: Slopes) {
        let (Some(terms), Some(mut curved)) = (equations.terms(), self.curved.take()) else {
            return;
        };
        let values = curved.stored.matrix.values_mut();
        values.copy_from_slice(&curved.base);
        terms.add_slopes((equations.start(), state), kind, &curved.places, values);
        curved.kind = kind;
        self.factorise(&curved.stored);
        self.curved = Some(curved);
    }

    /// The change of the algebraic unknowns that changes the balances by the entries of `right`;
    /// `None` if there is none.
    pub(super) fn direction(&mut self, right: &[f64]) -> Option<Vec<f64>> {
        let mut change = vec![0.0; right.len()];
        for &row in &self.algebraic {
            change[row] = right[row];
        }
        let mut vector: M::V = M::C::default().vector_from_vec(change.clone());
        self.work.1 += 1;
        solve(&self.factor, &mut vector).ok()?;
        for &row in &self.algebraic {
            change[row] = vector.slice()[row];
        }
        change.iter().all(|value| value.is_finite()).then_some(change)
    }

    /// The same numbers with zero for the algebraic unknowns.
    fn differential(&self, numbers: &[f64]) -> Vec<f64> {
        let mut kept = numbers.to_vec();
        for &row in &self.algebraic {
            kept[row] = 0.0;
        }
        kept
    }

    /// Solves the linearised balances in which `driven` does not depend on the unknowns that `numbers` are of.
    pub(super) fn solve(
        &mut self,
        equations: &Equations<'_, M>,
        mut driven: Vec<f64>,
        numbers: &mut [f64],
    ) -> Result<(), DiffsolError> {
        if self.apart {
            let known = equations.product(&self.differential(numbers));
            for (driven, known) in driven.iter_mut().zip(known) {
                *driven += known;
            }
        }
        let mut right = numbers.to_vec();
        for &row in &self.algebraic {
            right[row] = -driven[row];
        }
        let mut vector: M::V = M::C::default().vector_from_vec(right);
        self.work.1 += 1;
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
/// The sparse factorisation cannot be asked for a matrix of deficient structure, so that this has to be found before.
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
        let stored = self.jacobian.row(row);
        let linear = stored.col_indices().iter().zip(stored.values());
        let others = self.system.terms.iter().filter(|term| term.row == row);
        linear
            .filter(|&(_, &value)| value != 0.0)
            .map(|(&column, _)| column)
            .chain(others.flat_map(Term::columns))
            .filter(|&column| self.system.unknowns[column].kind == UnknownKind::Algebraic)
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
