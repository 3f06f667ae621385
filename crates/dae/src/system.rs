//! The narrow waist's input.

use std::{fmt::Debug, sync::Arc};

use nalgebra_sparse::CsrMatrix;

use crate::{LinearForm, Output, Outputs, Waveform};

/// How an unknown enters the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnknownKind {
    /// It has a rate of its own: a row `ẏᵢ = …`.
    Differential,
    /// It follows from a balance: a row `0 = …`.
    Algebraic,
}

/// One unknown of a [`System`].
#[derive(Debug, Clone, PartialEq)]
pub struct Unknown {
    /// Its name in mechanical words, for instance `velocity of head`.
    pub name: String,
    /// Differential or algebraic.
    pub kind: UnknownKind,
    /// SI value of the dimensionless value 1.
    pub scale: f64,
    /// SI unit of the scaled value.
    pub unit: &'static str,
}

/// One entry `w_k(t̂)` of the input vector: the `derivative`-th derivative, with respect to
/// dimensionless time, of a waveform.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Input {
    /// Index into [`System::waveforms`].
    pub waveform: usize,
    /// 0 for the function itself, 1 or 2 for its rates.
    pub derivative: u32,
}

/// The differential–algebraic system `M ẏ = J y + B w(t) + n(y, w)`, `M = diag(1…1, 0…0)`.
///
/// The terms `n` that are not linear stand in rows of algebraic unknowns; most systems have none.
///
/// Everything is dimensionless: time in units of [`time_scale`](Self::time_scale), unknowns in
/// units of their own [`scale`](Unknown::scale). It is semi-explicit and of index 1: the block of
/// `J` that belongs to the algebraic unknowns is regular.
///
/// # Examples
///
/// `x″ + 0.2 x′ + x = 0`, `x(0) = 1`, `x′(0) = 0.5`:
///
/// ```
/// use dashpot_dae::{Outputs, System, Unknown, UnknownKind, derivatives};
/// use nalgebra_sparse::{CooMatrix, CsrMatrix};
///
/// let unknown = |name: &str, unit| {
///     Unknown { name: name.to_owned(), kind: UnknownKind::Differential, scale: 1.0, unit }
/// };
/// let (rows, columns, values) = (vec![0, 1, 1], vec![1, 0, 1], vec![1.0, -1.0, -0.2]);
/// let jacobian = CooMatrix::try_from_triplets(2, 2, rows, columns, values)?;
/// let system = System {
///     unknowns: vec![unknown("position", "m"), unknown("velocity", "m/s")],
///     jacobian: CsrMatrix::from(&jacobian),
///     input_matrix: CsrMatrix::zeros(2, 0),
///     inputs: vec![],
///     waveforms: vec![],
///     terms: vec![],
///     initial: vec![1.0, 0.5],
///     outputs: Outputs::new(),
///     time_scale: 1.0,
/// };
/// let found = derivatives(&system, &system.initial, 2)?;
/// assert_eq!(found.values[1][0], 0.5);
/// assert!((found.values[2][0] + 1.1).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct System {
    /// The unknowns, in the order of the rows of `J`.
    pub unknowns: Vec<Unknown>,
    /// `J`, square, with its exact pattern.
    pub jacobian: CsrMatrix<f64>,
    /// `B`, one column for each entry of [`inputs`](Self::inputs).
    pub input_matrix: CsrMatrix<f64>,
    /// What the input vector `w` is made of.
    pub inputs: Vec<Input>,
    /// The driving functions, in dimensionless time and value.
    pub waveforms: Vec<Waveform>,
    /// Terms that are not linear.
    pub terms: Vec<Term>,
    /// Initial values of the unknowns; those of algebraic unknowns are a first guess, because methods
    /// solve the balances before they start.
    pub initial: Vec<f64>,
    /// What can be reported.
    pub outputs: Outputs,
    /// Seconds in one unit of dimensionless time \[s\].
    pub time_scale: f64,
}

/// The matrices of a system without algebraic unknowns: `ẏ = A y + B w(t)`.
#[derive(Debug, Clone, Copy)]
pub struct Linear<'a> {
    /// `A`.
    pub a: &'a CsrMatrix<f64>,
    /// `B`.
    pub b: &'a CsrMatrix<f64>,
}

impl System {
    /// The matrices, where the system is linear and every algebraic unknown has been eliminated.
    pub fn linear(&self) -> Option<Linear<'_>> {
        (self.is_linear() && self.algebraic() == 0)
            .then_some(Linear { a: &self.jacobian, b: &self.input_matrix })
    }

    /// Whether it has no other terms than linear ones.
    pub fn is_linear(&self) -> bool {
        self.terms.is_empty()
    }

    /// Number of unknowns.
    pub fn len(&self) -> usize {
        self.unknowns.len()
    }

    /// Whether there is no unknown at all.
    pub fn is_empty(&self) -> bool {
        self.unknowns.is_empty()
    }

    /// Number of differential unknowns.
    pub fn states(&self) -> usize {
        self.len() - self.algebraic()
    }

    /// Number of algebraic unknowns.
    pub fn algebraic(&self) -> usize {
        self.unknowns.iter().filter(|unknown| unknown.kind == UnknownKind::Algebraic).count()
    }

    /// The times in `(0, end)` at which a driving function or one of its rates may jump, sorted, in dimensionless time.
    pub fn breakpoints(&self, end: f64) -> Vec<f64> {
        inside(self.waveforms.iter().flat_map(Waveform::breakpoints).collect(), end)
    }

    /// Of these times those that no step of an explicit method may cross: there a driving function in the equations, its
    /// rate or its curvature jumps. The motion that a measured acceleration makes of a support, lines that are integrated
    /// twice, has such only where the acceleration itself jumps.
    pub(crate) fn breaks(&self, end: f64) -> Vec<f64> {
        let mut orders = vec![None; self.waveforms.len()];
        for Input { waveform, derivative } in self.acting().map(|input| self.inputs[input]) {
            orders[waveform] = orders[waveform].max(Some(2.max(derivative + 1)));
        }
        let all = self.waveforms.iter().zip(orders);
        let broken = all.filter_map(|(waveform, order)| Some(waveform.breaks(order?)));
        inside(broken.flatten().collect(), end)
    }

    /// The inputs in the equations, which others than outputs follow; some more than once.
    pub(crate) fn acting(&self) -> impl Iterator<Item = usize> + '_ {
        let arguments = self.terms.iter().flat_map(|term| &term.arguments);
        let in_terms = arguments.flat_map(|own| own.inputs.terms().iter().map(|term| term.0));
        self.input_matrix.triplet_iter().map(|entry| entry.1).chain(in_terms)
    }

    /// The dimensionless time in which driving functions change in a span between two of their breakpoints: the shortest
    /// period, or length of a piece that is not constant, of which the span may be a part. `None` where none changes.
    pub fn own_time(&self, (start, end): (f64, f64)) -> Option<f64> {
        let of = |waveform: &Waveform| {
            let (piece, next) = waveform.piece_until(start);
            let frequency = piece.frequency(start).max(piece.frequency(end));
            let length = next.unwrap_or(end) - piece.start.min(start);
            (!piece.is_constant(0)).then(|| length.min(std::f64::consts::TAU / frequency))
        };
        self.waveforms.iter().filter_map(of).reduce(f64::min)
    }

    /// The shortest dimensionless period of a driving function in a span, infinite where none oscillates.
    pub(crate) fn period(&self, (start, end): (f64, f64)) -> f64 {
        let frequency = |waveform: &Waveform| {
            let piece = waveform.piece_at(start);
            piece.frequency(start).max(piece.frequency(end))
        };
        std::f64::consts::TAU / self.waveforms.iter().map(frequency).fold(0.0, f64::max)
    }

    /// The shortest dimensionless time in which a driving function may go and come back within `[start, end]`, between
    /// which no other piece begins: a period, or the length of a polynomial that turns. `None` where none does.
    pub(crate) fn shortest_swing(&self, (start, end): (f64, f64)) -> Option<f64> {
        let swing = |waveform: &Waveform| {
            let piece = waveform.piece_at(start);
            let frequency = piece.frequency(start).max(piece.frequency(end));
            let swings = frequency > 0.0 || piece.turns(start, end);
            swings.then(|| (end - start).min(std::f64::consts::TAU / frequency))
        };
        self.waveforms.iter().filter_map(swing).reduce(f64::min)
    }

    /// What the outputs of a solution on `[0, end]` are told from: driving functions and output forms, and the equations
    /// where they are `few`.
    pub(crate) fn reporting(&self, end: f64, few: usize) -> Self {
        let is_small = self.len() <= few;
        let matrix = |own: &CsrMatrix<f64>| {
            if is_small { own.clone() } else { CsrMatrix::zeros(0, 0) }
        };
        let rows = if is_small { self.len() } else { 0 };
        Self {
            unknowns: self.unknowns[..rows].to_vec(),
            jacobian: matrix(&self.jacobian),
            input_matrix: matrix(&self.input_matrix),
            inputs: self.inputs.clone(),
            waveforms: self.waveforms.iter().map(|waveform| waveform.within(end)).collect(),
            terms: if is_small { self.terms.clone() } else { Vec::new() },
            initial: self.initial[..rows].to_vec(),
            outputs: self.outputs.clone(),
            time_scale: self.time_scale,
        }
    }

    /// When the next piece of a driving function begins after `t`; infinite where none does.
    pub(crate) fn next_piece(&self, t: f64) -> f64 {
        let next = |waveform: &Waveform| waveform.piece_until(t).1;
        self.waveforms.iter().filter_map(next).fold(f64::INFINITY, f64::min)
    }

    /// The input vector at dimensionless time `t`, on the piece that holds at `piece_time`
    /// (at a jump, the piece to take is not decided by `t`).
    pub fn inputs_at(&self, piece_time: f64, t: f64, w: &mut [f64]) {
        for (value, input) in w.iter_mut().zip(&self.inputs) {
            *value =
                self.waveforms[input.waveform].piece_at(piece_time).derivative(input.derivative, t);
        }
    }
}

/// The times in `(0, end)`, sorted.
fn inside(mut times: Vec<f64>, end: f64) -> Vec<f64> {
    times.retain(|&time| time > 0.0 && time < end);
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// A scalar law of two quantities, for instance a force of a deformation and its rate; SI units.
///
/// It must be continuous, and its slopes must be those of the value.
pub trait Characteristic: Debug + Send + Sync {
    /// The value at `arguments`.
    fn value(&self, arguments: [f64; 2]) -> f64;

    /// The partial derivatives of [`value`](Self::value) at `arguments`.
    fn slopes(&self, arguments: [f64; 2]) -> [f64; 2];
}

/// A quantity in SI units that a [`Term`] depends on: `scale · (unknowns·y + inputs·w)`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Argument {
    /// SI value of the dimensionless value 1.
    pub scale: f64,
    /// Coefficients over the unknowns.
    pub unknowns: LinearForm,
    /// Coefficients over the inputs.
    pub inputs: LinearForm,
}

impl Argument {
    /// Its value \[SI\] where the unknowns are `y` and the inputs `w`.
    pub fn at(&self, y: &[f64], w: &[f64]) -> f64 {
        self.scale * (self.unknowns.at(y) + self.inputs.at(w))
    }
}

/// A term `factor · law(arguments)` in the row of an algebraic unknown.
#[derive(Debug, Clone)]
pub struct Term {
    /// The row to which it belongs, that of an algebraic unknown.
    pub row: usize,
    /// Value of the row's unit of the law's SI unit.
    pub factor: f64,
    /// The law.
    pub law: Arc<dyn Characteristic>,
    /// What it depends on.
    pub arguments: [Argument; 2],
}

impl Term {
    /// What it adds to its row.
    pub fn value(&self, y: &[f64], w: &[f64]) -> f64 {
        self.factor * self.law.value(self.arguments.each_ref().map(|own| own.at(y, w)))
    }

    /// The slopes of [`value`](Self::value) over both arguments, in SI units of these.
    pub fn slopes(&self, y: &[f64], w: &[f64]) -> [f64; 2] {
        self.law.slopes(self.arguments.each_ref().map(|own| own.at(y, w))).map(|s| self.factor * s)
    }

    /// The unknowns that it depends on, in rising order.
    pub fn columns(&self) -> Vec<usize> {
        let mut columns: Vec<usize> = self
            .arguments
            .iter()
            .flat_map(|argument| argument.unknowns.terms().iter().map(|term| term.0))
            .collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}

/// The time derivatives of all unknowns and inputs of a [`System`](crate::System) at `t = 0`, with respect to
/// dimensionless time; the first index is the order, from 0 on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Derivatives {
    /// `values[k][i]`: the `k`-th derivative of unknown `i`, dimensionless.
    pub values: Vec<Vec<f64>>,
    /// The same recursion on absolute values: `Σ |terms|` instead of `Σ terms`. A value is lost in
    /// rounding where it is below some `ε` times its magnitude.
    pub magnitudes: Vec<Vec<f64>>,
    /// `inputs[k][j]`: the `k`-th derivative of input `j`, dimensionless.
    pub inputs: Vec<Vec<f64>>,
    /// The magnitudes of the inputs' derivatives.
    pub input_magnitudes: Vec<Vec<f64>>,
}

impl Derivatives {
    /// The `k`-th derivative of an output with respect to dimensionless time, and its magnitude, both
    /// in the output's unit.
    ///
    /// # Panics
    ///
    /// When `k` is beyond the highest order, or `output` is one of another system.
    pub fn output(&self, output: Output<'_>, k: usize) -> (f64, f64) {
        let Output { scale, unknowns, inputs, .. } = output;
        let value = unknowns.at(&self.values[k]) + inputs.at(&self.inputs[k]);
        let magnitude = unknowns.magnitude_at(&self.magnitudes[k])
            + inputs.magnitude_at(&self.input_magnitudes[k]);
        (scale * value, scale.abs() * magnitude)
    }
}
