//! A [`System`] in the form that the integrators ask for.

use std::cell::Cell;

use diffsol::{
    ConstantOp, Context as _, DiffsolError, LinearOp, NonLinearOp, NonLinearOpJacobian,
    OdeEquations, OdeEquationsRef, Op, UnitCallable,
};

use super::algebra::{Algebra, Rows, Slice, entries, matrix, pattern};
use crate::{Piece, System, UnknownKind};

/// An input that changes with time during a span, and the column of `B` that it drives.
#[derive(Debug, Clone)]
struct Drive {
    piece: Piece,
    derivative: u32,
    input: usize,
}

/// `M ẏ = J y + B w` on one smooth span, in the span's own time `t − start`.
pub(in crate::methods) struct Equations<'s, M: Algebra> {
    system: &'s System,
    rows: Rows<'s>,
    context: M::C,
    jacobian: M,
    mass: Option<Mass<M>>,
    start: f64,
    state: Vec<f64>,
    /// The columns of `B`: rows and factors.
    columns: Vec<Vec<(usize, f64)>>,
    /// `B w` of the inputs that are constant on the span; empty where there are none.
    constant: Vec<f64>,
    drives: Vec<Drive>,
    calls: Cell<usize>,
    jacobians: Cell<usize>,
}

/// `M = diag(1…, 0…)`.
pub(in crate::methods) struct Mass<M: Algebra> {
    context: M::C,
    diagonal: Vec<f64>,
    matrix: M,
}

impl<'s, M: Algebra> Equations<'s, M> {
    /// The equations of `system`; [`enter`](Self::enter) must follow.
    pub(super) fn new(system: &'s System) -> Result<Self, DiffsolError> {
        let size = system.len();
        let mass = if system.algebraic() == 0 {
            None
        } else {
            let one = |kind| if kind == UnknownKind::Differential { 1.0 } else { 0.0 };
            let diagonal: Vec<f64> = system.unknowns.iter().map(|u| one(u.kind)).collect();
            let context = M::C::default();
            let vector = context.vector_from_vec::<M::V>(diagonal.clone());
            Some(Mass { context, diagonal, matrix: M::from_diagonal(&vector) })
        };
        let mut columns = vec![Vec::new(); system.inputs.len()];
        for (row, input, factor) in entries(&system.input_matrix) {
            columns[input].push((row, factor));
        }
        Ok(Self {
            system,
            rows: Rows::of(&system.jacobian),
            context: M::C::default(),
            jacobian: matrix(size, entries(&system.jacobian))?,
            mass,
            start: 0.0,
            state: system.initial.clone(),
            columns,
            constant: Vec::new(),
            drives: Vec::new(),
            calls: Cell::new(0),
            jacobians: Cell::new(0),
        })
    }

    /// Enters the span that begins at `start`, where the unknowns are `state`.
    pub(super) fn enter(&mut self, start: f64, state: &[f64]) {
        self.start = start;
        self.state.copy_from_slice(state);
        self.drives.clear();
        self.constant.clear();
        for (k, input) in self.system.inputs.iter().enumerate() {
            let piece = *self.system.waveforms[input.waveform].piece_at(start);
            let drive = Drive { piece, derivative: input.derivative, input: k };
            if self.columns[k].is_empty() {
                continue;
            }
            if drive.is_constant() {
                self.constant.resize(self.system.len(), 0.0);
                drive.add(0, start, &self.columns[k], &mut self.constant);
            } else {
                self.drives.push(drive);
            }
        }
    }

    /// `J y + B w` at the span's own time `t`.
    pub(super) fn evaluate(&self, t: f64, y: &[f64], out: &mut [f64]) {
        self.rows.multiply(y, out);
        for (value, constant) in out.iter_mut().zip(&self.constant) {
            *value += constant;
        }
        for drive in &self.drives {
            drive.add(0, self.start + t, &self.columns[drive.input], out);
        }
    }

    /// `B w` (`order` 0) or `B ẇ` (`order` 1) at the span's start.
    pub(super) fn driven(&self, order: u32) -> Vec<f64> {
        let mut out = vec![0.0; self.system.len()];
        if order == 0 && !self.constant.is_empty() {
            out.copy_from_slice(&self.constant);
        }
        for drive in &self.drives {
            drive.add(order, self.start, &self.columns[drive.input], &mut out);
        }
        out
    }

    /// Evaluations of the right-hand side and of the Jacobian so far.
    pub(super) fn counts(&self) -> (usize, usize) {
        (self.calls.get(), self.jacobians.get())
    }

    /// The system behind the equations.
    pub(super) fn system(&self) -> &'s System {
        self.system
    }
}

impl Drive {
    fn is_constant(&self) -> bool {
        let wave = self.piece.omega != 0.0 && (self.piece.sine != 0.0 || self.piece.cosine != 0.0);
        !wave && (self.derivative > 0 || self.piece.slope == 0.0)
    }

    fn add(&self, order: u32, t: f64, column: &[(usize, f64)], out: &mut [f64]) {
        let value = self.piece.derivative(self.derivative + order, t);
        for &(row, factor) in column {
            out[row] += factor * value;
        }
    }
}

impl<M: Algebra> Op for Equations<'_, M> {
    type T = f64;
    type V = M::V;
    type M = M;
    type C = M::C;

    fn context(&self) -> &M::C {
        &self.context
    }

    fn nstates(&self) -> usize {
        self.state.len()
    }

    fn nout(&self) -> usize {
        self.state.len()
    }

    fn nparams(&self) -> usize {
        0
    }
}

impl<M: Algebra> NonLinearOp for Equations<'_, M> {
    fn call_inplace(&self, y: &M::V, t: f64, out: &mut M::V) {
        self.calls.set(self.calls.get() + 1);
        self.evaluate(t, y.slice(), out.slice_mut());
    }
}

impl<M: Algebra> NonLinearOpJacobian for Equations<'_, M> {
    fn jac_mul_inplace(&self, _y: &M::V, _t: f64, v: &M::V, out: &mut M::V) {
        self.rows.multiply(v.slice(), out.slice_mut());
    }

    fn jacobian_inplace(&self, _y: &M::V, _t: f64, out: &mut M) {
        self.jacobians.set(self.jacobians.get() + 1);
        out.copy_from(&self.jacobian);
    }

    fn jacobian_sparsity(&self) -> Option<M::Sparsity> {
        pattern(&self.jacobian)
    }
}

impl<M: Algebra> ConstantOp for Equations<'_, M> {
    fn call_inplace(&self, _t: f64, out: &mut M::V) {
        out.slice_mut().copy_from_slice(&self.state);
    }
}

impl<M: Algebra> Op for Mass<M> {
    type T = f64;
    type V = M::V;
    type M = M;
    type C = M::C;

    fn context(&self) -> &M::C {
        &self.context
    }

    fn nstates(&self) -> usize {
        self.diagonal.len()
    }

    fn nout(&self) -> usize {
        self.diagonal.len()
    }

    fn nparams(&self) -> usize {
        0
    }
}

impl<M: Algebra> LinearOp for Mass<M> {
    fn gemv_inplace(&self, x: &M::V, _t: f64, beta: f64, out: &mut M::V) {
        for ((out, x), mass) in out.slice_mut().iter_mut().zip(x.slice()).zip(&self.diagonal) {
            *out = mass * x + beta * *out;
        }
    }

    fn matrix_inplace(&self, _t: f64, out: &mut M) {
        out.copy_from(&self.matrix);
    }

    fn sparsity(&self) -> Option<M::Sparsity> {
        pattern(&self.matrix)
    }
}

impl<'a, M: Algebra> OdeEquationsRef<'a> for Equations<'_, M> {
    type Rhs = &'a Self;
    type Mass = &'a Mass<M>;
    type Init = &'a Self;
    type Root = UnitCallable<M>;
    type Out = UnitCallable<M>;
    type Reset = UnitCallable<M>;
}

impl<M: Algebra> OdeEquations for Equations<'_, M> {
    fn rhs(&self) -> &Self {
        self
    }

    fn mass(&self) -> Option<&Mass<M>> {
        self.mass.as_ref()
    }

    fn init(&self) -> &Self {
        self
    }

    fn set_params(&mut self, _parameters: &M::V) {}

    fn get_params(&self, _parameters: &mut M::V) {}
}
