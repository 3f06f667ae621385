//! The panels of one step, where outputs may follow driving functions directly.

use super::{Step, between};
use crate::{
    Output, Panel, Piece, System,
    chebyshev::{Interpolation, evaluate},
};

/// Half periods, as `ω · length / 2`, that one panel may hold; longer steps are divided.
const LONGEST: f64 = 8.0;

/// Coefficients of a sine below this part of its amplitude are left out.
const NEGLIGIBLE: f64 = 1e-17;

/// One term of an output that is a driving function.
struct Term {
    piece: Piece,
    derivative: u32,
    factor: f64,
}

/// Adds to `panels` the output over one step, given `values` of its part in the unknowns at the
/// step's nodes. `magnitude` grows to the size of the terms.
pub(super) fn add(
    system: &System,
    output: &Output,
    step: &Step,
    values: &[f64],
    panels: &mut Vec<Panel>,
    magnitude: &mut f64,
) {
    let terms: Vec<Term> =
        output.inputs.terms().iter().map(|term| term_of(system, step, *term)).collect();
    let half = 0.5 * terms.iter().map(Term::omega).fold(0.0, f64::max) * (step.end - step.start);
    let parts = count((half / LONGEST).ceil()).max(1);
    let degree = degree(step, &terms, half / size(parts));
    let interpolation = Interpolation::of_degree(degree);
    let mut own = vec![0.0; step.degree + 1];
    Interpolation::of_degree(step.degree).coefficients(values, &mut own);
    if terms.is_empty() {
        own.iter_mut().for_each(|coefficient| *coefficient *= output.scale);
        let time = |t| (step.origin + t) * system.time_scale;
        push(panels, time(step.start), time(step.end), own);
        return;
    }
    for part in 0..parts {
        let place = |k: usize| 2.0 * size(k) / size(parts) - 1.0;
        let (from, to) = (place(part), place(part + 1));
        let value = |&node: &f64| {
            let x = between(from, to, node);
            let t = step.origin + between(step.start, step.end, x);
            let mut sum = evaluate(&own, x);
            for term in &terms {
                let value = term.factor * term.piece.derivative(term.derivative, t);
                *magnitude = magnitude.max(value.abs());
                sum += value;
            }
            sum * output.scale
        };
        let nodal: Vec<f64> = interpolation.nodes().iter().map(value).collect();
        let mut coefficients = vec![0.0; degree + 1];
        interpolation.coefficients(&nodal, &mut coefficients);
        let time = |x| (step.origin + between(step.start, step.end, x)) * system.time_scale;
        push(panels, time(from), time(to), coefficients);
    }
}

/// Adds a panel; adjoining panels share their border to the last bit.
fn push(panels: &mut Vec<Panel>, start: f64, end: f64, coefficients: Vec<f64>) {
    let start = panels.last().map_or(start, |panel| panel.end);
    panels.push(Panel { start, end: end.max(start), coefficients });
}

fn term_of(system: &System, step: &Step, (input, factor): (usize, f64)) -> Term {
    let input = system.inputs[input];
    let piece = *system.waveforms[input.waveform].piece_at(step.origin);
    Term { piece, derivative: input.derivative, factor }
}

/// The degree that follows the step's polynomial, and sines of phase up to ±`half`: their
/// coefficients are Bessel functions, `|J_k(a)| ≤ (a/2)^k/k!`.
fn degree(step: &Step, terms: &[Term], half: f64) -> usize {
    let mut waves = 0;
    let mut bound = 0.5 * half;
    while bound > NEGLIGIBLE {
        waves += 1;
        bound *= 0.5 * half / size(waves + 1);
    }
    let sloped = terms.iter().any(|term| term.derivative == 0 && term.piece.slope != 0.0);
    step.degree.max(usize::from(sloped)).max(waves)
}

impl Term {
    /// Angular frequency of the term; zero where it is no sine.
    fn omega(&self) -> f64 {
        let still = self.piece.sine == 0.0 && self.piece.cosine == 0.0;
        if still { 0.0 } else { self.piece.omega.abs() }
    }
}

/// A small number of things, from a float that is a whole number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "whole, not negative, and bounded by the waves of a run"
)]
fn count(number: f64) -> usize {
    number as usize
}

#[expect(clippy::cast_precision_loss, reason = "counts of panels are small")]
fn size(count: usize) -> f64 {
    count as f64
}
