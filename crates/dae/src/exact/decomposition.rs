//! The modal decomposition of an augmented system.

use std::sync::Arc;

use nalgebra::DMatrix;

use super::{
    Augmented, Complex,
    augmented::Equations,
    decoupling::{Caution, Clusters, decouple},
    modes::{Modes, chains},
    refinement::refine,
    schur::ComplexSchur,
    tables::Tables,
};

/// The modes of an augmented system over its run.
///
/// Eigenvalues that the refinement finds to be alike are joined, and the rest begun anew. Where
/// the eigenvalue iteration fails, the whole matrix is taken as one block: slower, and without
/// an error bound, but with the right values.
pub(super) fn decompose(system: &Augmented, caution: Caution) -> Modes {
    if let Some(chains) = chains(&system.matrix) {
        return Modes::of_chains(system, &chains);
    }
    let Some(mut schur) = augmented_schur(system) else { return Modes::undivided(system) };
    let mut clusters = Clusters::single(&schur);
    loop {
        let decoupling = decouple(&mut schur, &mut clusters, system.end(), caution);
        let mut modes = Modes::assemble(&schur, &decoupling, system.end());
        modes.pair_conjugates(&clusters);
        let alike = refine(&system.matrix, &mut modes);
        if alike.is_empty() {
            let known = modes.defect.iter().all(|d| d.is_finite());
            return if known { modes } else { Modes::undivided(system) };
        }
        clusters.join(&alike);
    }
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

/// Of how many equations, and of how many modal forms, the last are remembered.
const REMEMBERED: usize = 32;

/// The modes of a system, and what they do on panels: the same wherever a run begins.
#[derive(Debug)]
pub(super) struct Form {
    pub(super) modes: Modes,
    pub(super) tables: Tables,
}

impl Form {
    pub(super) fn of(modes: Modes) -> Self {
        Self { modes, tables: Tables::default() }
    }
}

/// What solutions that were met before are made of, so that those which follow need not keep it again:
/// a run that switches goes through the same few sets of equations.
#[derive(Debug, Default)]
pub struct Shared {
    equations: Vec<Arc<Equations>>,
    forms: Vec<Arc<Form>>,
}

impl Shared {
    pub(super) fn equations(&mut self, own: &mut Arc<Equations>) {
        share(&mut self.equations, own, |one, other| one == other);
    }

    pub(super) fn form(&mut self, own: &mut Arc<Form>) {
        share(&mut self.forms, own, |one, other| one.modes == other.modes);
    }
}

/// Takes what is alike from those that are known, or makes it known.
fn share<T>(known: &mut Vec<Arc<T>>, own: &mut Arc<T>, is_same: impl Fn(&T, &T) -> bool) {
    if let Some(same) = known.iter().rev().find(|other| is_same(other, own)) {
        *own = Arc::clone(same);
        return;
    }
    if known.len() == REMEMBERED {
        known.remove(0);
    }
    known.push(Arc::clone(own));
}
