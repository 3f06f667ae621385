//! The driving functions in a span, and what they have made of the unknowns by themselves.
//!
//! Where driving functions have corners within a span, the unknowns are integrated without what these functions add to
//! their rates: `ẏ = f(y) + B w(t)` becomes `ż = f(z + s(t))`, `y = z + s(t)`, `s = B ∫w dt`, whose integral is known in
//! closed form. What is left to the method is smoother by an order than `w`, and no impulse of `w` is missed between stages.

use std::rc::Rc;

use crate::{Input, System, Waveform};

/// The integrals of the driving functions with corners, of those that have one.
pub(in super::super) type Integrals = Rc<[Option<Waveform>]>;

/// The integrals of those driving functions of `system` with corners whose values act in rates.
pub(in super::super) fn integrals(system: &System) -> Integrals {
    let acts = |waveform: usize| {
        system.inputs.iter().any(|own| own.waveform == waveform && own.derivative == 0)
    };
    let integral = |(at, waveform): (usize, &Waveform)| {
        (waveform.pieces().len() > 1 && acts(at)).then(|| waveform.integral()).flatten()
    };
    system.waveforms.iter().enumerate().map(integral).collect()
}

/// One derivative of a function, of which the pieces of a span are known.
#[derive(Debug, Clone, Copy)]
struct Source<'s> {
    waveform: &'s Waveform,
    pieces: (usize, usize),
    derivative: u32,
}

impl<'s> Source<'s> {
    fn new(waveform: &'s Waveform, derivative: u32, (start, end): (f64, f64)) -> Self {
        Self { waveform, pieces: waveform.range(start, end), derivative }
    }

    fn at(&self, t: f64) -> f64 {
        self.waveform.piece_of(self.pieces, t).derivative(self.derivative, t)
    }
}

/// All inputs in a span.
#[derive(Debug)]
pub(super) struct Drives<'s> {
    inputs: Vec<Source<'s>>,
    /// The integrals of those with corners; empty where none has any.
    integrals: Vec<Option<Source<'s>>>,
}

impl<'s> Drives<'s> {
    pub(super) fn new(
        system: &'s System,
        span: (f64, f64),
        integrals: &'s [Option<Waveform>],
    ) -> Self {
        let input =
            |own: &Input| Source::new(&system.waveforms[own.waveform], own.derivative, span);
        let inputs: Vec<Source<'s>> = system.inputs.iter().map(input).collect();
        let integral = |(own, input): (&Source<'s>, &Input)| {
            if own.pieces.0 == own.pieces.1 {
                return None;
            }
            match own.derivative.checked_sub(1) {
                Some(derivative) => Some(Source { derivative, ..*own }),
                None => {
                    integrals.get(input.waveform)?.as_ref().map(|own| Source::new(own, 0, span))
                }
            }
        };
        let mut integrals: Vec<_> = inputs.iter().zip(&system.inputs).map(integral).collect();
        if integrals.iter().all(Option::is_none) {
            integrals.clear();
        }
        Self { inputs, integrals }
    }

    /// Whether the unknowns are integrated without an input.
    pub(super) fn is_apart(&self, input: usize) -> bool {
        self.integrals.get(input).is_some_and(Option::is_some)
    }

    /// Whether they are so without any.
    pub(super) fn are_apart(&self) -> bool {
        !self.integrals.is_empty()
    }

    /// All inputs at `t`.
    pub(super) fn values(&self, t: f64, values: &mut [f64]) {
        self.inputs.iter().zip(values).for_each(|(own, value)| *value = own.at(t));
    }

    /// The integrals of those that are apart at `t`; zero for the others.
    pub(super) fn integrals(&self, t: f64, values: &mut [f64]) {
        let at = |own: &Option<Source<'_>>| own.map_or(0.0, |own| own.at(t));
        self.integrals.iter().zip(values).for_each(|(own, value)| *value = at(own));
    }
}
