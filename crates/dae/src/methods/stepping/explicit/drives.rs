//! The driving functions in a span, and how far they are from what the stages of a step see of them.

use dashpot_numerics::chebyshev::{Coefficients, Interpolation, evaluate};

use crate::{Input, System, Waveform, pieces::between};

/// One input, of whose function the pieces of a span are known.
#[derive(Debug, Clone, Copy)]
struct Source<'s> {
    waveform: &'s Waveform,
    pieces: (usize, usize),
    derivative: u32,
}

impl Source<'_> {
    fn at(&self, t: f64) -> f64 {
        self.waveform.piece_of(self.pieces, t).derivative(self.derivative, t)
    }
}

/// All inputs in a span.
#[derive(Debug)]
pub(super) struct Drives<'s> {
    sources: Vec<Source<'s>>,
    /// Those in the equations whose functions have corners within the span.
    cornered: Vec<usize>,
}

/// Where an input between two times is farthest from a polynomial through some of its values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excursion {
    pub(super) input: usize,
    pub(super) time: f64,
    /// The value of the polynomial there.
    pub(super) smooth: f64,
}

impl<'s> Drives<'s> {
    pub(super) fn new(system: &'s System, (start, end): (f64, f64)) -> Self {
        let source = |own: &Input| {
            let waveform = &system.waveforms[own.waveform];
            Source { waveform, pieces: waveform.range(start, end), derivative: own.derivative }
        };
        let sources: Vec<Source<'s>> = system.inputs.iter().map(source).collect();
        let has_corners = |&input: &usize| sources[input].pieces.0 < sources[input].pieces.1;
        let mut cornered = Vec::new();
        if (0..sources.len()).any(|input| has_corners(&input)) {
            cornered.extend(system.acting().filter(has_corners));
            cornered.sort_unstable();
            cornered.dedup();
        }
        Self { sources, cornered }
    }

    /// All inputs at `t`.
    pub(super) fn values(&self, t: f64, values: &mut [f64]) {
        self.sources.iter().zip(values).for_each(|(own, value)| *value = own.at(t));
    }

    /// The excursions to both sides of each input in the equations that has corners between two times from the polynomial of
    /// this degree through its values there; they are looked for at the corners and half-way between.
    pub(super) fn excursions(
        &self,
        (start, end): (f64, f64),
        degree: usize,
    ) -> impl Iterator<Item = Excursion> + '_ {
        let of_input = move |&input: &usize| {
            let source = &self.sources[input];
            let (first, last) = source.waveform.range(start, end);
            if first == last {
                return None;
            }
            let interpolation = Interpolation::of_degree(degree);
            let nodes = interpolation.nodes().iter();
            let values: Coefficients = nodes.map(|&x| source.at(between(start, end, x))).collect();
            let mut coefficients = Coefficients::zeros(degree + 1);
            interpolation.coefficients(&values, &mut coefficients);
            let corners = source.waveform.pieces()[first + 1..=last].iter().map(|own| own.start);
            let mut before = start;
            let places = corners.chain([end]).flat_map(|corner| {
                let middle = 0.5 * (before + corner);
                before = corner;
                [middle, corner]
            });
            let none = (0.0, Excursion { input, time: start, smooth: source.at(start) });
            let mut most = [none; 2];
            for time in places {
                let smooth = evaluate(&coefficients, 2.0 * (time - start) / (end - start) - 1.0);
                let distance = source.at(time) - smooth;
                for (most, distance) in most.iter_mut().zip([distance, -distance]) {
                    if distance > most.0 {
                        *most = (distance, Excursion { input, time, smooth });
                    }
                }
            }
            Some(most.map(|own| own.1))
        };
        self.cornered.iter().filter_map(of_input).flatten()
    }
}
