//! The unknowns and the generators of their driving functions in one autonomous system.

use std::{ops::Deref, sync::Arc};

use dashpot_numerics::two_product;
use nalgebra::DMatrix;

use super::{
    balance::{balance, power_of_two},
    generators::Generators,
};
use crate::{LinearForm, Output, System};

/// The time between two breakpoints.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Span {
    /// Where it begins, dimensionless.
    pub(super) start: f64,
    pub(super) end: f64,
    /// The generators at its start, in their own units.
    pub(super) generators: Vec<f64>,
}

impl Span {
    /// How long it is.
    pub(super) fn length(&self) -> f64 {
        self.end - self.start
    }
}

/// `ż = Ā z`, `z = D⁻¹ [y; g]`, where `g` are the generators and `D` a diagonal of powers of two
/// that balances `Ā = D⁻¹ [A B C; 0 G] D`.
#[derive(Debug, Clone)]
pub(crate) struct Augmented {
    /// What does not depend on where the run begins and ends.
    pub(super) equations: Arc<Equations>,
    /// `z` at the start of the run.
    pub(super) initial: Vec<f64>,
    /// The spans in order of time; at least one.
    pub(super) spans: Vec<Span>,
}

/// The equations of an augmented system.
#[derive(Debug, PartialEq)]
pub(crate) struct Equations {
    /// Number of unknowns `y`.
    pub(super) states: usize,
    /// `Ā`.
    pub(super) matrix: DMatrix<f64>,
    /// The diagonal of `D`.
    pub(super) units: Vec<f64>,
    pub(super) generators: Generators,
    /// The inputs as forms over `[y; g]`.
    inputs: Vec<LinearForm>,
}

impl Equations {
    /// The output, dimensionless, as a form over `z`.
    pub(super) fn form(&self, output: Output<'_>) -> Vec<(usize, f64)> {
        let mut form = output.unknowns.to_form();
        for (input, coefficient) in output.inputs.terms() {
            form = form.plus(coefficient, &self.inputs[input]);
        }
        form.terms().iter().map(|&(i, c)| (i, c * self.units[i])).collect()
    }
}

impl Deref for Augmented {
    type Target = Equations;

    fn deref(&self) -> &Equations {
        &self.equations
    }
}

impl Augmented {
    /// The augmented form of a system without algebraic unknowns on `[0, end]`.
    pub(crate) fn new(system: &System, end: f64) -> Self {
        let states = system.len();
        let generators = Generators::new(system);
        let size = states + generators.len();
        let mut matrix = DMatrix::zeros(size, size);
        for (i, j, &value) in system.jacobian.triplet_iter() {
            matrix[(i, j)] += value;
        }
        let mut units = balance(&mut matrix, states);
        let inputs: Vec<LinearForm> =
            system.inputs.iter().map(|&input| generators.form(input, states)).collect();
        for (i, input, &value) in system.input_matrix.triplet_iter() {
            for &(j, coefficient) in inputs[input].terms() {
                matrix[(i, j)] += value * coefficient / units[i];
            }
        }
        generators.fill(&mut matrix, states);
        scale_generators(&mut matrix, &mut units, &generators, end);
        let equations = Arc::new(Equations { states, matrix, units, generators, inputs });
        let mut augmented = Self { equations, initial: Vec::new(), spans: Vec::new() };
        augmented.cut(system, end);
        let unknowns = system.initial.iter();
        let first = augmented.spans[0].generators.iter();
        augmented.initial =
            unknowns.zip(&augmented.units).map(|(y, d)| y / d).chain(first.copied()).collect();
        augmented
    }

    fn cut(&mut self, system: &System, end: f64) {
        let mut start = 0.0;
        let inner = if self.generators.len() == 0 { Vec::new() } else { system.breakpoints(end) };
        for stop in inner.into_iter().chain([end]) {
            let mut generators = self.generators.values(system, start);
            for (value, unit) in generators.iter_mut().zip(&self.units[self.states..]) {
                *value /= unit;
            }
            self.spans.push(Span { start, end: stop, generators });
            start = stop;
        }
    }

    /// Number of unknowns and generators.
    pub(crate) fn size(&self) -> usize {
        self.matrix.nrows()
    }

    /// The end of the run, dimensionless.
    pub(super) fn end(&self) -> f64 {
        self.spans.last().map_or(0.0, |span| span.end)
    }

    /// The span that begins at or before `t` and is not over.
    pub(super) fn span_at(&self, t: f64) -> usize {
        self.spans.partition_point(|span| span.start <= t).saturating_sub(1)
    }

    /// The rate of a form over `z`, per unit of dimensionless time. The products that it is made of stand in
    /// it one by one, and what rounding takes of them, so that nothing is lost where they cancel.
    pub(super) fn rate(&self, form: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let mut rate = Vec::new();
        for &(i, factor) in form {
            let entries = self.matrix.row(i).into_iter().enumerate();
            for (j, &entry) in entries.filter(|(_, entry)| **entry != 0.0) {
                let (product, rest) = two_product(factor, entry);
                rate.extend([(j, product), (j, rest)]);
            }
        }
        rate
    }

    /// `‖Ā‖₁`.
    pub(crate) fn norm(&self) -> f64 {
        self.matrix.column_iter().map(|column| column.lp_norm(1)).fold(0.0, f64::max)
    }

    /// Whether it can be shown without modes that no state grows beyond the range of numbers.
    ///
    /// With `M` the matrix whose off-diagonal entries are replaced by their sizes, `w > 0` and
    /// `Mᵀ w < μ w` show that `Σ w |z|` grows by at most `e^{μ t}`. First `w = 1` is tried, which is a
    /// logarithmic norm; then the solution of `(μ − Mᵀ) w = 1`, which is positive if any `w` is.
    pub(super) fn stays_finite(&self) -> bool {
        /// Logarithm of the largest size that is allowed.
        const RANGE: f64 = 600.0;
        let size: f64 = self.initial.iter().map(|z| z.abs()).sum();
        let room = RANGE - size.max(1.0).ln();
        let rate = |(j, column): (usize, nalgebra::DVectorView<'_, f64>)| {
            column.lp_norm(1) - column[j].abs() + column[j]
        };
        let growth = self.matrix.column_iter().enumerate().map(rate).fold(0.0, f64::max);
        if growth * self.end() < room {
            return true;
        }
        weights(&self.matrix, 0.5 * room / self.end()).is_some_and(|weights| {
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            let largest = weights.iter().copied().fold(0.0, f64::max);
            (largest / least).ln() < 0.5 * room
        })
    }
}

/// The solution of `(most − Mᵀ) w = 1` for the matrix `M` with entries replaced by their sizes off the diagonal, by
/// elimination without pivots; `None` unless all pivots are positive, and with them all of `w`.
fn weights(matrix: &DMatrix<f64>, most: f64) -> Option<Vec<f64>> {
    let n = matrix.nrows();
    let mut rows: Vec<f64> = matrix.iter().map(|entry| -entry.abs()).collect();
    for i in 0..n {
        rows[i * n + i] = most - matrix[(i, i)];
    }
    let mut weights = vec![1.0; n];
    for k in 0..n {
        let (top, rest) = rows.split_at_mut((k + 1) * n);
        let top = &top[k * n..];
        if top[k].is_nan() || top[k] <= 0.0 {
            return None;
        }
        for (i, row) in rest.chunks_exact_mut(n).enumerate() {
            let factor = row[k] / top[k];
            row[k + 1..].iter_mut().zip(&top[k + 1..]).for_each(|(x, t)| *x -= factor * t);
            weights[k + 1 + i] -= factor * weights[k];
        }
    }
    for k in (0..n).rev() {
        let row = &rows[k * n..(k + 1) * n];
        let known: f64 = row[k + 1..].iter().zip(&weights[k + 1..]).map(|(a, w)| a * w).sum();
        weights[k] = (weights[k] - known) / row[k];
    }
    Some(weights)
}

/// Chooses the generators' units so that their columns are as large as `A` itself: then rounding
/// relative to the norm of the whole is rounding relative to each part.
fn scale_generators(
    matrix: &mut DMatrix<f64>,
    units: &mut Vec<f64>,
    generators: &Generators,
    end: f64,
) {
    let (states, size) = (units.len(), matrix.nrows());
    units.resize(size, 1.0);
    if size == states {
        return;
    }
    let part = |matrix: &DMatrix<f64>, j: usize| matrix.column(j).rows(0, states).lp_norm(1);
    let norm = (0..states).map(|j| part(matrix, j)).fold(0.0, f64::max);
    let norm = if norm > 0.0 { norm } else { 1.0 / end.clamp(1e-300, 1e300) };
    let pairs: Vec<usize> = generators.waves().map(|(at, _)| states + at).collect();
    let mut j = states;
    while j < size {
        let pair = pairs.contains(&j);
        let coupling = if pair {
            part(matrix, j) + part(matrix, j + 1)
        } else if j > states && matrix[(j - 1, j)] != 0.0 {
            // A derivative feeds the one of the order below, whose unit is settled.
            part(matrix, j) + matrix[(j - 1, j)]
        } else {
            part(matrix, j)
        };
        let factor = if coupling > 0.0 { power_of_two(norm / coupling) } else { 1.0 };
        let width = if pair { 2 } else { 1 };
        for column in j..j + width {
            for row in 0..size {
                if !(pair && row >= states) {
                    matrix[(row, column)] *= factor;
                }
            }
            units[column] = factor;
        }
        if !pair {
            for column in 0..size {
                matrix[(j, column)] /= factor;
            }
        }
        j += width;
    }
}
