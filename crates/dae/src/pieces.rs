//! A solution kept as values at points of time, one polynomial for each step through some of them.

mod inputs;
mod lagrange;

use crate::{Dense, Output, Signal, System, chebyshev::Interpolation};
use lagrange::Lagrange;

/// Roundings of the largest term that a value of an output may be off by: those of the
/// interpolation, and of its coefficients.
pub(crate) const ROUNDING: f64 = 16.0;

/// One step: where it lies, and the rows that its polynomial passes through. Times are counted from
/// `origin`, so that steps far below the resolution of the time of day are told apart.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    /// Start of the smooth span that the step belongs to; the driving functions' pieces that hold
    /// from there on hold in the step.
    origin: f64,
    start: f64,
    end: f64,
    /// First of `degree + 1` rows.
    first: usize,
    degree: usize,
}

/// The solution of a run in dimensionless time: rows of values of all unknowns, and the steps.
///
/// A multistep method needs no row but the last of a step: its polynomial passes through the rows of
/// the steps before. A one-step method adds rows inside the step.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pieces {
    size: usize,
    /// Rows of `size` values each.
    rows: Vec<f64>,
    /// The time of each row, from the origin of its span.
    times: Vec<f64>,
    steps: Vec<Step>,
    origin: f64,
    /// The first row of the span.
    first: usize,
    /// Time that the steps of the span have reached.
    reached: f64,
    /// End of the run \[s\], to the last bit.
    t_end: f64,
}

impl Pieces {
    /// A store for `size` unknowns, without any step yet.
    pub(crate) fn new(size: usize) -> Self {
        Self {
            size,
            rows: Vec::new(),
            times: Vec::new(),
            steps: Vec::new(),
            origin: 0.0,
            first: 0,
            reached: 0.0,
            t_end: f64::INFINITY,
        }
    }

    /// Sets aside room for this many rows.
    pub(crate) fn reserve(&mut self, rows: usize) {
        self.steps.reserve(rows);
        self.times.reserve(rows);
        self.rows.reserve(rows * self.size);
    }

    /// Begins a smooth span at `origin`, where the unknowns are `state`.
    pub(crate) fn begin(&mut self, origin: f64, state: &[f64]) {
        self.origin = origin;
        self.reached = 0.0;
        self.first = self.times.len();
        self.add_row(0.0, state);
    }

    /// Adds the unknowns at a time after the span's origin.
    pub(crate) fn add_row(&mut self, time: f64, state: &[f64]) {
        self.times.push(time);
        self.rows.extend_from_slice(state);
    }

    /// Ends a step at the last row. Its polynomial has this degree, or a lower one where the span has
    /// not enough rows, and passes through the last rows.
    pub(crate) fn end_step(&mut self, degree: usize) {
        let last = self.times.len() - 1;
        let degree = degree.min(last - self.first).min(lagrange::HIGHEST);
        let end = self.times[last];
        let first = last - degree;
        self.steps.push(Step { origin: self.origin, start: self.reached, end, first, degree });
        self.reached = end;
    }

    /// Adds a step up to `end` in which no unknown moves.
    pub(crate) fn rest(&mut self, end: f64) {
        let first = self.times.len() - 1;
        self.steps.push(Step { origin: self.origin, start: self.reached, end, first, degree: 0 });
        self.reached = end;
    }

    /// Number of steps.
    pub(crate) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Ends the run at `t_end` \[s\], which lies in the last step.
    pub(crate) fn finish(&mut self, time_scale: f64, t_end: f64) {
        self.t_end = t_end;
        if let Some(last) = self.steps.last_mut() {
            last.end = (t_end / time_scale - last.origin).clamp(last.start, last.end);
        }
    }

    /// The output over the steps from number `from` on.
    pub(crate) fn signal_from(&self, system: &System, output: &Output, from: usize) -> Signal {
        let mut panels = Vec::with_capacity(self.steps.len() - from);
        let mut magnitude = 0.0_f64;
        let mut values = Vec::new();
        for step in &self.steps[from..] {
            self.at_nodes(output, step, &mut values, &mut magnitude);
            inputs::add(system, output, step, &values, &mut panels, &mut magnitude);
        }
        if let Some(panel) = panels.last_mut()
            && self.t_end.is_finite()
        {
            panel.end = self.t_end.max(panel.start);
        }
        Signal::new(panels, None, ROUNDING * f64::EPSILON * magnitude * output.scale.abs())
    }

    /// `unknowns · y` at the Chebyshev–Lobatto points of a step, and how large its terms are.
    fn at_nodes(&self, output: &Output, step: &Step, values: &mut Vec<f64>, magnitude: &mut f64) {
        let terms = output.unknowns.terms();
        let mut in_rows = [0.0; lagrange::HIGHEST + 1];
        for (at, in_row) in in_rows.iter_mut().enumerate().take(step.degree + 1) {
            let row = &self.rows[(step.first + at) * self.size..][..self.size];
            let mut size = 0.0;
            for &(unknown, factor) in terms {
                let term = factor * row[unknown];
                *in_row += term;
                size += term.abs();
            }
            *magnitude = magnitude.max(size);
        }
        let lagrange = self.lagrange(step);
        let nodes = Interpolation::of_degree(step.degree);
        let value = |&node: &f64| {
            let weights = lagrange.weights(between(step.start, step.end, node));
            weights.iter().zip(&in_rows).map(|(weight, value)| weight * value).sum::<f64>()
        };
        values.clear();
        values.extend(nodes.nodes().iter().map(value));
    }

    fn lagrange(&self, step: &Step) -> Lagrange<'_> {
        Lagrange::new(&self.times[step.first..=step.first + step.degree])
    }
}

impl Dense for Pieces {
    fn signal(&self, system: &System, output: usize) -> Signal {
        self.signal_from(system, &system.outputs[output], 0)
    }

    fn sample(&self, _system: &System, times: &[f64]) -> Vec<f64> {
        let mut samples = vec![0.0; times.len() * self.size];
        if self.size == 0 {
            return samples;
        }
        let mut rest = times.iter().zip(samples.chunks_exact_mut(self.size)).peekable();
        for (at, step) in self.steps.iter().enumerate() {
            let next =
                self.steps.get(at + 1).map_or(f64::INFINITY, |next| next.origin + next.start);
            if rest.peek().is_none_or(|(time, _)| **time >= next) {
                continue;
            }
            let (first, count) = (step.first, step.degree + 1);
            let rows = &self.rows[first * self.size..][..count * self.size];
            let here = std::iter::from_fn(|| {
                let (time, out) = rest.next_if(|(time, _)| **time < next)?;
                Some(((time - step.origin).clamp(step.start, step.end), out))
            });
            lagrange::sample(&self.times[first..first + count], rows, self.size, here);
        }
        samples
    }
}

/// The time at place `x`, from −1 to 1, between `start` and `end`; exact at both ends.
pub(crate) fn between(start: f64, end: f64, x: f64) -> f64 {
    if x < 0.0 {
        start + 0.5 * (end - start) * (1.0 + x)
    } else {
        end - 0.5 * (end - start) * (1.0 - x)
    }
}
