//! The panels of one step, where outputs may follow driving functions directly.

use dashpot_numerics::chebyshev::{Coefficients, Interpolation, evaluate};

use super::{Step, between};
use crate::{Output, Panel, Piece, System};

/// Half periods, as `ω · length / 2`, that one panel may hold; longer steps are divided.
const LONGEST: f64 = 8.0;

/// Coefficients of a sine below this part of its amplitude are left out.
const NEGLIGIBLE: f64 = 1e-17;

/// Roundings of the time that the end of a step may lie beyond the start of a piece.
const ROUNDINGS: f64 = 4.0;

/// A part of a step in which one piece of each driving function holds.
#[derive(Debug, Clone, Copy)]
pub(super) struct Section {
    /// The pieces that hold from this time on are the ones.
    pub(super) from: f64,
    /// Its start and end, counted as those of the step.
    pub(super) start: f64,
    pub(super) end: f64,
}

impl Section {
    /// Where it lies in its step, from −1 to 1.
    fn places(&self, step: &Step) -> (f64, f64) {
        let place = |time: f64| 2.0 * (time - step.start) / (step.end - step.start) - 1.0;
        let first = if self.start > step.start { place(self.start) } else { -1.0 };
        (first, if self.end < step.end { place(self.end) } else { 1.0 })
    }
}

impl Step {
    /// The sections of the step where the next piece begins at `next` of a time.
    pub(super) fn sections(&self, next: impl Fn(f64) -> f64) -> impl Iterator<Item = Section> {
        let end = self.origin + self.end;
        let last = end - ROUNDINGS * f64::EPSILON * end;
        let mut left = Some(Section { from: self.from, start: self.start, end: self.end });
        std::iter::from_fn(move || {
            let mut own = left.take()?;
            loop {
                let corner = next(own.from);
                if corner >= last {
                    return Some(own);
                }
                let border = (corner - self.origin).clamp(self.start, self.end);
                if border > own.start {
                    left = Some(Section { from: corner, start: border, end: self.end });
                    return Some(Section { end: border, ..own });
                }
                own.from = corner;
            }
        })
    }

    /// The sections of the step for all driving functions.
    pub(super) fn pieces(&self, system: &System) -> impl Iterator<Item = Section> {
        self.sections(|time| system.next_piece(time))
    }

    /// From when on the pieces hold that do so at the end of the step.
    pub(super) fn last_piece(&self, system: &System) -> f64 {
        self.pieces(system).last().map_or(self.from, |section| section.from)
    }
}

/// One term of an output that is a driving function.
struct Term {
    piece: Piece,
    derivative: u32,
    factor: f64,
}

/// Adds to `panels` the output over one step, given its part in the unknowns. `magnitude` grows to
/// the size of the terms.
pub(super) fn add(
    system: &System,
    output: Output<'_>,
    step: &Step,
    mut own: Coefficients,
    panels: &mut Vec<Panel>,
    magnitude: &mut f64,
) {
    if output.inputs.is_zero() {
        own.iter_mut().for_each(|coefficient| *coefficient *= output.scale);
        let time = |t| (step.origin + t) * system.time_scale;
        push(panels, time(step.start), time(step.end), own);
        return;
    }
    let waveform = |(input, _): (usize, f64)| &system.waveforms[system.inputs[input].waveform];
    let next = |time: f64| {
        let starts = output.inputs.terms().filter_map(|term| waveform(term).piece_until(time).1);
        starts.fold(f64::INFINITY, f64::min)
    };
    let (mut terms, mut nodal): (Vec<Term>, Vec<f64>) = Default::default();
    for section in step.sections(next) {
        terms.clear();
        terms.extend(output.inputs.terms().map(|term| term_of(system, &section, term)));
        let (half, parts) = parts(&section, terms.iter().map(|term| term.omega(step, &section)));
        let degree = degree(step, &section, &terms, half, parts);
        let interpolation = Interpolation::of_degree(degree);
        let (first, last) = section.places(step);
        for part in 0..parts {
            let place = |k: usize| between(first, last, 2.0 * k as f64 / parts as f64 - 1.0);
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
            nodal.clear();
            nodal.extend(interpolation.nodes().iter().map(value));
            let mut coefficients = Coefficients::zeros(degree + 1);
            interpolation.coefficients(&nodal, &mut coefficients);
            let time = |x| (step.origin + between(step.start, step.end, x)) * system.time_scale;
            push(panels, time(from), time(to), coefficients);
        }
    }
}

/// The degree of polynomials, and the number of equal parts of a section, that follow the step's own
/// polynomial and every driving function.
pub(super) fn resolution(system: &System, step: &Step, section: &Section) -> (usize, usize) {
    let terms: Vec<Term> =
        (0..system.inputs.len()).map(|input| term_of(system, section, (input, 1.0))).collect();
    let (half, parts) = parts(section, terms.iter().map(|term| term.omega(step, section)));
    (degree(step, section, &terms, half, parts), parts)
}

/// How many panels follow the driving functions over a step, whatever the output.
pub(super) fn panels(system: &System, step: &Step) -> usize {
    let parts = |section: Section| {
        let omega = |input| term_of(system, &section, (input, 1.0)).omega(step, &section);
        parts(&section, (0..system.inputs.len()).map(omega)).1
    };
    step.pieces(system).map(parts).sum()
}

/// Half of what the phase of the fastest sine turns by on one of the equal parts of a section, and how many there are.
fn parts(section: &Section, omegas: impl Iterator<Item = f64>) -> (f64, usize) {
    let half = 0.5 * omegas.fold(0.0, f64::max) * (section.end - section.start);
    let parts = count((half / LONGEST).ceil()).max(1);
    (half / parts as f64, parts)
}

/// Adds a panel; adjoining panels share their border to the last bit.
fn push(panels: &mut Vec<Panel>, start: f64, end: f64, coefficients: Coefficients) {
    let start = panels.last().map_or(start, |panel| panel.end);
    panels.push(Panel { start, end: end.max(start), coefficients });
}

fn term_of(system: &System, section: &Section, (input, factor): (usize, f64)) -> Term {
    let input = system.inputs[input];
    let piece = *system.waveforms[input.waveform].piece_at(section.from);
    Term { piece, derivative: input.derivative, factor }
}

/// The degree that follows the step's polynomial, and the driving functions on one of `parts` equal
/// parts of a section, on which the phase of no sine turns by more than ±`half`.
fn degree(step: &Step, section: &Section, terms: &[Term], half: f64, parts: usize) -> usize {
    let own = |term: &Term| term.degree(half, (section.end - section.start) / parts as f64);
    terms.iter().map(own).fold(step.degree, usize::max)
}

/// The degree that follows a sine of phase up to ±`half`: its coefficients are Bessel functions,
/// `|J_k(a)| ≤ (a/2)^k/k!`.
fn waves(half: f64) -> usize {
    let mut waves = 0;
    let mut bound = 0.5 * half;
    while bound > NEGLIGIBLE {
        waves += 1;
        bound *= 0.5 * half / (waves + 1) as f64;
    }
    waves
}

impl Term {
    /// Largest angular frequency of the term in a section; zero where it is no sine.
    fn omega(&self, step: &Step, section: &Section) -> f64 {
        let at = |time: f64| self.piece.frequency(step.origin + time);
        at(section.start).max(at(section.end))
    }

    /// The degree that follows the term over `length`, on which its phase turns by up to ±`half`.
    ///
    /// With the place `x` from −1 to 1, the phase of a swept sine is a constant and `a x + b T₂(x)`,
    /// where `b = κ length²/16`; the coefficients of a product reach as far as those of its factors
    /// together. Each derivative is multiplied by the frequency, which is a line.
    fn degree(&self, half: f64, length: f64) -> usize {
        let polynomial = self.piece.degree().unwrap_or(0).saturating_sub(self.derivative);
        if !self.piece.is_wave() {
            return wide(polynomial);
        }
        let mut degree = waves(half);
        if self.piece.is_swept() {
            let bend = (self.piece.sweep * length * length / 16.0).abs();
            degree += 2 * waves(bend) + wide(self.derivative);
        }
        degree.max(wide(polynomial))
    }
}

fn wide(order: u32) -> usize {
    usize::try_from(order).unwrap_or(usize::MAX)
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
