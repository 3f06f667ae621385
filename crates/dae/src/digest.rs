//! What is known of a solution of which only a part is kept.

use crate::System;

/// What is known of all outputs of a run that [keeps](crate::Keep) a part of them only: their values
/// at both ends, and what was to be summed up on the way.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Digest {
    pub(crate) first: Instant,
    pub(crate) last: Instant,
    /// One entry for each pair of [`Part::products`](crate::Part::products), in its order.
    pub products: Vec<Product>,
    /// The jumps of the outputs in [`Part::jumps`](crate::Part::jumps), in order of time; what cannot
    /// be told from rounding is none.
    pub jumps: Vec<Jump>,
}

/// All unknowns and inputs at one time, dimensionless.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Instant {
    pub(crate) state: Vec<f64>,
    pub(crate) inputs: Vec<f64>,
}

/// The integral of the product of two outputs over time, in SI units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Product {
    /// The integral over the whole run.
    pub total: f64,
    /// The largest value that it has at the end of any step; at least 0.
    pub largest: f64,
}

/// A jump of an output where a driving function may jump.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// When \[s\].
    pub time: f64,
    /// Index into [`System::outputs`].
    pub output: usize,
    /// The value just before, in SI units.
    pub before: f64,
    /// The value just after.
    pub after: f64,
}

impl Digest {
    /// The values of the output number `output` at the start and at the end of the run, in SI units.
    ///
    /// # Panics
    ///
    /// When `system` is not the one that was solved.
    pub fn ends(&self, system: &System, output: usize) -> [f64; 2] {
        [&self.first, &self.last].map(|instant| instant.value(system, output))
    }
}

impl Instant {
    /// The inputs on the piece that holds at `piece_time`, with all unknowns, at the dimensionless
    /// `time`.
    pub(crate) fn new(system: &System, state: Vec<f64>, (piece_time, time): (f64, f64)) -> Self {
        let mut inputs = vec![0.0; system.inputs.len()];
        system.inputs_at(piece_time, time, &mut inputs);
        Self { state, inputs }
    }

    /// An output in SI units.
    pub(crate) fn value(&self, system: &System, output: usize) -> f64 {
        let output = system.outputs.at(output);
        output.scale * (output.unknowns.at(&self.state) + output.inputs.at(&self.inputs))
    }

    /// The size of an output's terms in SI units, which its rounding follows.
    pub(crate) fn magnitude(&self, system: &System, output: usize) -> f64 {
        let output = system.outputs.at(output);
        let terms =
            output.unknowns.magnitude_at(&self.state) + output.inputs.magnitude_at(&self.inputs);
        output.scale.abs() * terms
    }
}
