//! A [`System`] in the form that the integrators ask for.

use std::cell::Cell;

use diffsol::{
    ConstantOp, Context as _, DiffsolError, LinearOp, NonLinearOp, NonLinearOpJacobian,
    OdeEquations, OdeEquationsRef, UnitCallable,
};

use super::{
    algebra::{Algebra, Rows, Slice, entries, matrix, pattern, square_operator},
    terms::{self, Drive, Places, Slopes, Terms},
};
use crate::{System, UnknownKind};

/// `M ẏ = J y + B w + n(y, w)` on one smooth span, in the span's own time `t − start`.
pub(in crate::methods) struct Equations<'s, M: Algebra> {
    system: &'s System,
    fastest: f64,
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
    /// What is not linear, and where its slopes belong in the Jacobian.
    terms: Option<(Terms<'s>, Places)>,
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
        // Dense matrices keep the last of several entries, sparse ones add them up.
        let room = terms::pattern(system).map(|(row, column)| (row, column, 0.0));
        let jacobian: M = matrix(size, room.chain(entries(&system.jacobian)))?;
        let terms = Terms::of(system).map(|terms| {
            let places = terms.places(&jacobian, |_| true);
            (terms, places)
        });
        let is_rate = |row: usize| system.unknowns[row].kind == UnknownKind::Differential;
        let rates = entries(&system.jacobian).filter(|entry| is_rate(entry.0));
        let fastest = rates.map(|entry| entry.2.abs()).fold(0.0, f64::max);
        let rows = Rows::of(&system.jacobian)
            .ok_or_else(|| DiffsolError::Other("2³² coefficients or more".to_owned()))?;
        Ok(Self {
            system,
            fastest,
            rows,
            context: M::C::default(),
            jacobian,
            mass,
            start: 0.0,
            state: system.initial.clone(),
            columns,
            constant: Vec::new(),
            drives: Vec::new(),
            terms,
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
        if let Some((terms, _)) = &mut self.terms {
            terms.enter(start);
        }
        for k in 0..self.system.inputs.len() {
            let drive = Drive::of(self.system, k, start);
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

    /// `J y + B w + n(y, w)` at the span's own time `t`.
    pub(super) fn evaluate(&self, t: f64, y: &[f64], out: &mut [f64]) {
        self.rows.multiply(y, out);
        for (value, constant) in out.iter_mut().zip(&self.constant) {
            *value += constant;
        }
        for drive in &self.drives {
            drive.add(0, self.start + t, &self.columns[drive.input()], out);
        }
        if let Some((terms, _)) = &self.terms {
            terms.add_values(self.start + t, y, out);
        }
    }

    /// The `order`-th derivative of `B w` at the span's start.
    pub(super) fn driven(&self, order: u32) -> Vec<f64> {
        let mut out = vec![0.0; self.system.len()];
        if order == 0 && !self.constant.is_empty() {
            out.copy_from_slice(&self.constant);
        }
        for drive in &self.drives {
            drive.add(order, self.start, &self.columns[drive.input()], &mut out);
        }
        out
    }

    /// `J slopes` and the `order`-th derivative of `B w` at the span's start: in differential rows the
    /// next derivative where `slopes` are those of this order.
    pub(super) fn rates(&self, order: u32, slopes: &[f64]) -> Vec<f64> {
        let mut rates = self.product(slopes);
        for (rate, driven) in rates.iter_mut().zip(self.driven(order)) {
            *rate += driven;
        }
        rates
    }

    /// `J y`.
    pub(super) fn product(&self, y: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; y.len()];
        self.rows.multiply(y, &mut product);
        product
    }

    /// `|J| unknowns + |B| inputs`.
    pub(super) fn magnitudes(&self, unknowns: &[f64], inputs: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; unknowns.len()];
        self.rows.magnitudes(unknowns, &mut sums);
        for (column, input) in self.columns.iter().zip(inputs) {
            for &(row, factor) in column {
                sums[row] += (factor * input).abs();
            }
        }
        sums
    }

    /// `Σ |terms|` of each row at the span's start, with what the rounding of the arguments of laws
    /// makes of these, in parts of `ε`.
    pub(super) fn sizes(&self, y: &[f64]) -> Vec<f64> {
        let mut inputs = vec![0.0; self.system.inputs.len()];
        self.system.inputs_at(self.start, self.start, &mut inputs);
        let mut sizes = self.magnitudes(y, &inputs);
        if let Some((terms, _)) = &self.terms {
            terms.add_sizes((self.start, y), (y, &inputs), &mut sizes);
        }
        sizes
    }

    /// The sums of the coefficients' sizes in each row, at the span's start; one for an empty row.
    pub(super) fn row_sums(&self, y: &[f64]) -> Vec<f64> {
        let (ones, none) = (vec![1.0; y.len()], vec![0.0; self.system.inputs.len()]);
        let mut sums = self.magnitudes(&ones, &none);
        if let Some((terms, _)) = &self.terms {
            terms.add_magnitudes((self.start, y), (&ones, &none), &mut sums);
        }
        for sum in &mut sums {
            *sum = if *sum > 0.0 && sum.is_finite() { *sum } else { 1.0 };
        }
        sums
    }

    /// The terms that are not linear.
    pub(super) fn terms(&self) -> Option<&Terms<'s>> {
        self.terms.as_ref().map(|(terms, _)| terms)
    }

    /// The span's start.
    pub(super) fn start(&self) -> f64 {
        self.start
    }

    /// Evaluations of the right-hand side and of the Jacobian so far.
    pub(super) fn counts(&self) -> (usize, usize) {
        (self.calls.get(), self.jacobians.get())
    }

    pub(super) fn system(&self) -> &'s System {
        self.system
    }

    /// The largest coefficient of an unknown in a rate: the shortest time in the equations is no shorter
    /// than about its reciprocal.
    pub(super) fn fastest(&self) -> f64 {
        self.fastest
    }
}

/// Copies `from` into a matrix of the same pattern without making it anew.
fn refill<M: Algebra>(into: &mut M, from: &M) {
    if into.values().len() == from.values().len() {
        into.values_mut().copy_from_slice(from.values());
    } else {
        into.copy_from(from);
    }
}

square_operator!(Equations<'_, M>, |own| own.state.len());

impl<M: Algebra> NonLinearOp for Equations<'_, M> {
    fn call_inplace(&self, y: &M::V, t: f64, out: &mut M::V) {
        self.calls.set(self.calls.get() + 1);
        self.evaluate(t, y.slice(), out.slice_mut());
    }
}

impl<M: Algebra> NonLinearOpJacobian for Equations<'_, M> {
    fn jac_mul_inplace(&self, y: &M::V, t: f64, v: &M::V, out: &mut M::V) {
        self.rows.multiply(v.slice(), out.slice_mut());
        if let Some((terms, _)) = &self.terms {
            let point = (self.start + t, y.slice());
            terms.add_product(point, Slopes::Filled, v.slice(), out.slice_mut());
        }
    }

    fn jacobian_inplace(&self, y: &M::V, t: f64, out: &mut M) {
        self.jacobians.set(self.jacobians.get() + 1);
        refill(out, &self.jacobian);
        if let Some((terms, places)) = &self.terms {
            let point = (self.start + t, y.slice());
            terms.add_slopes(point, Slopes::Filled, places, out.values_mut());
        }
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

square_operator!(Mass<M>, |own| own.diagonal.len());

impl<M: Algebra> LinearOp for Mass<M> {
    fn gemv_inplace(&self, x: &M::V, _t: f64, beta: f64, out: &mut M::V) {
        for ((out, x), mass) in out.slice_mut().iter_mut().zip(x.slice()).zip(&self.diagonal) {
            *out = mass * x + beta * *out;
        }
    }

    fn matrix_inplace(&self, _t: f64, out: &mut M) {
        refill(out, &self.matrix);
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
