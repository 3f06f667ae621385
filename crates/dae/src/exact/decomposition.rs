//! The modal decomposition of an augmented system.

use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

use nalgebra::DMatrix;

use super::{
    Augmented, Complex,
    augmented::Equations,
    decoupling::{Caution, Clusters, decouple},
    modal_row::ModalRow,
    modes::{Modes, chains},
    refinement::refine,
    schur::ComplexSchur,
    tables::Tables,
};
use crate::Outputs;

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

/// Of how many equations the last are remembered.
const REMEMBERED: usize = 32;

/// The modes of a system, what they do on panels, and what they make of its outputs: the same wherever a run begins.
#[derive(Debug)]
pub(super) struct Form {
    pub(super) modes: Modes,
    pub(super) tables: Tables,
    /// The modal forms of outputs, one set for each that was asked for.
    rows: Mutex<Vec<(Outputs, Arc<[ModalRow]>)>>,
}

impl Form {
    pub(super) fn of(modes: Modes) -> Self {
        Self { modes, tables: Tables::default(), rows: Mutex::default() }
    }

    /// The modal forms of all outputs of a system with these equations.
    pub(super) fn rows(&self, equations: &Equations, outputs: &Outputs) -> Arc<[ModalRow]> {
        let mut known = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, rows)) = known.iter().find(|own| own.0.are_those(outputs)) {
            return Arc::clone(rows);
        }
        let row = |output| ModalRow::new(&self.modes, &equations.form(output));
        let rows: Arc<[ModalRow]> = outputs.iter().map(row).collect();
        known.push((outputs.clone(), Arc::clone(&rows)));
        rows
    }
}

/// What solutions that were met before are made of, so that those which follow need not find and keep it again:
/// a run that switches goes through the same few sets of equations.
#[derive(Debug, Default)]
pub struct Shared {
    known: Vec<(Arc<Equations>, Arc<Form>)>,
    /// The part of each interval \[s\] in which its end was found.
    parts: VecDeque<Option<f64>>,
    /// Whether the same intervals follow once more.
    is_again: bool,
}

impl Shared {
    /// From now on the intervals follow once more, hardly changed.
    pub(crate) fn again(&mut self) {
        self.is_again = true;
    }

    /// The part of the next interval \[s\] in which its end was found before, if it was.
    pub(crate) fn part(&mut self) -> Option<f64> {
        if self.is_again { self.parts.pop_front().flatten() } else { None }
    }

    /// Remembers the part of an interval in which its end was found.
    pub(crate) fn found_in(&mut self, part: Option<f64>) {
        if !self.is_again {
            self.parts.push_back(part);
        }
    }

    /// The last that was remembered of equations that are alike, bit by bit.
    pub(super) fn of(&self, own: &Equations) -> Option<&(Arc<Equations>, Arc<Form>)> {
        self.known.iter().rev().find(|known| *known.0 == *own)
    }

    pub(super) fn remember(&mut self, equations: &Arc<Equations>, form: &Arc<Form>) {
        if self.known.iter().any(|known| Arc::ptr_eq(&known.1, form)) {
            return;
        }
        if self.known.len() == REMEMBERED {
            self.known.remove(0).1.tables.clear();
        }
        self.known.push((Arc::clone(equations), Arc::clone(form)));
    }
}

impl Drop for Shared {
    /// The solutions remain, without the tables that were made on the way.
    fn drop(&mut self) {
        self.known.iter().for_each(|known| known.1.tables.clear());
    }
}
