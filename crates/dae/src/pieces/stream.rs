//! What is summed up over all unknowns while a run proceeds.

use std::{collections::VecDeque, sync::Arc};

use super::{
    ROUNDING, Step,
    lagrange::{HIGHEST, Lagrange},
    products::{Products, Row},
};
use crate::{Digest, Jump, Part, System, run::Instant};

/// The last rows of all unknowns, and what has been made of those before.
///
/// A step is summed up when the next row arrives: until then a guard may still end the run within it.
#[derive(Debug)]
pub(super) struct Stream {
    part: Arc<Part>,
    /// Relative size of jumps that are errors of the method.
    negligible: f64,
    /// The last rows of the span, as many as the polynomial of any step passes through.
    recent: VecDeque<Row>,
    /// The step that is still to be summed up; it ends at the last row.
    pub(super) pending: Option<Step>,
    products: Products,
    pub(super) digest: Digest,
}

impl Stream {
    pub(super) fn new(system: &System, part: &Arc<Part>, rtol: f64) -> Self {
        Self {
            part: Arc::clone(part),
            negligible: rtol.max(ROUNDING * f64::EPSILON),
            recent: VecDeque::with_capacity(HIGHEST + 1),
            pending: None,
            products: Products::new(system, &part.products),
            digest: Digest::default(),
        }
    }

    /// Begins a smooth span; the driving functions' pieces at the end of the one before began at `from`.
    pub(super) fn begin(&mut self, system: &System, (from, origin): (f64, f64), state: &[f64]) {
        let after = Instant::new(system, state.to_vec(), (origin, origin));
        match self.recent.pop_back() {
            None => self.digest.first = after,
            Some(last) if !self.part.jumps.is_empty() => {
                let before = Instant::new(system, last.state, (from, origin));
                self.add_jumps(system, origin, [&before, &after]);
            }
            Some(_) => {}
        }
        self.recent.clear();
    }

    fn add_jumps(&mut self, system: &System, origin: f64, sides: [&Instant; 2]) {
        for &output in &self.part.jumps {
            let [before, after] = sides.map(|side| side.value(system, output));
            let [one, other] = sides.map(|side| side.magnitude(system, output));
            if (after - before).abs() > self.negligible * one.max(other) {
                let time = origin * system.time_scale;
                self.digest.jumps.push(Jump { time, output, before, after });
            }
        }
    }

    /// Adds a row of all unknowns.
    pub(super) fn add_row(&mut self, state: &[f64]) {
        let mut row = match self.recent.len() {
            0..=HIGHEST => Row::default(),
            _ => self.recent.pop_front().unwrap_or_default(),
        };
        row.state.clear();
        row.state.extend_from_slice(state);
        self.products.factors(state, &mut row.factors);
        self.recent.push_back(row);
    }

    /// Sums up the last step, if that has not been done; `times` are those of all rows.
    pub(super) fn settle(&mut self, system: &System, times: &[f64]) {
        if let Some(step) = self.pending.take() {
            let lagrange = Lagrange::new(&times[step.first..=step.first + step.degree]);
            let rows = last_rows(&self.recent, &step);
            self.products.add(system, &step, &lagrange, &rows);
        }
    }

    /// Ends the run at the end of the pending step.
    pub(super) fn finish(&mut self, system: &System, times: &[f64]) {
        if let Some(step) = self.pending {
            let lagrange = Lagrange::new(&times[step.first..=step.first + step.degree]);
            let weights = lagrange.weights(step.end);
            let mut state = vec![0.0; system.len()];
            for (weight, row) in weights.iter().zip(last_rows(&self.recent, &step)) {
                state.iter_mut().zip(&row.state).for_each(|(sum, value)| *sum += weight * value);
            }
            let time = step.origin + step.end;
            self.digest.last = Instant::new(system, state, (step.last_piece(system), time));
        }
        self.settle(system, times);
        self.recent = VecDeque::new();
        self.digest.products = std::mem::take(&mut self.products).finish();
    }
}

/// The rows that the polynomial of the last step passes through.
fn last_rows<'r>(recent: &'r VecDeque<Row>, step: &Step) -> Vec<&'r Row> {
    recent.iter().skip(recent.len().saturating_sub(step.degree + 1)).collect()
}
