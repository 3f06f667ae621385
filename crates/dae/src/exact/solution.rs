//! The exact solution as a trajectory.

use std::sync::OnceLock;

use super::{
    Augmented,
    coordinates::{SpanCoordinates, follow},
    modes::Modes,
    number,
    panels::{ModalRow, Piece, Quality, coordinates_at},
    propagator::{Grid, advance, march},
};
use crate::{Dense, Output, Panel, Signal, System};

/// Rounding of a value relative to the sizes of its terms, in units of `ε`: interpolation, a few
/// operations for each term, and what trimming leaves between panels.
const NOISE: f64 = 16.0;
/// Spans up to which the propagator is used for samples; each takes exponentials of its own.
const FEW_SPANS: usize = 8;
/// `‖Ā‖ T` up to which the propagator is used for samples; beyond it the modes are more accurate.
const GENTLE: f64 = 1e4;
/// Deviation from a uniform grid that is rounding, relative to the last time.
const UNIFORM: f64 = 1e-14;

/// `y(t)` on `[0, end]`. Nothing is computed before it is asked for.
#[derive(Debug)]
pub(crate) struct Solution {
    system: Augmented,
    /// The end of the run \[s\], which the last panel shall meet exactly.
    t_end: f64,
    time_scale: f64,
    modal: OnceLock<Modal>,
}

#[derive(Debug, Clone)]
struct Modal {
    modes: Modes,
    spans: Vec<SpanCoordinates>,
}

impl Solution {
    /// The solution of the augmented system over a run that ends at `t_end` \[s\].
    pub(crate) fn new(system: Augmented, t_end: f64, time_scale: f64) -> Self {
        Self { system, t_end, time_scale, modal: OnceLock::new() }
    }

    /// The same solution on a run that ends earlier, at `t_end` \[s\].
    pub(crate) fn until(mut self, t_end: f64) -> Self {
        let end = t_end / self.time_scale;
        self.system.spans.retain(|span| span.start == 0.0 || span.start < end);
        if let Some(last) = self.system.spans.last_mut() {
            last.end = end;
        }
        self.t_end = t_end;
        self
    }

    fn modal(&self) -> &Modal {
        self.modal.get_or_init(|| {
            let modes = Modes::new(&self.system);
            let spans = follow(&self.system, &modes);
            Modal { modes, spans }
        })
    }

    /// The index of the first unknown that leaves the range of numbers within the run, if any does.
    pub(crate) fn lost(&self) -> Option<usize> {
        if let Some(at) = self.system.initial.iter().position(|z| !z.is_finite()) {
            return Some(at.min(self.system.states.saturating_sub(1)));
        }
        if self.system.stays_finite() {
            return None;
        }
        let ends: Vec<f64> = self.system.spans.iter().map(|span| span.end).collect();
        self.by_modes(&ends).iter().position(|y| !y.is_finite()).map(|at| at % self.system.states)
    }

    /// The growth rates `Re λ` and frequencies `|Im λ|` of all modes, dimensionless.
    pub(crate) fn rates(&self) -> Vec<(f64, f64)> {
        let diagonal = |block: &super::block::Block| {
            (0..block.len()).map(|i| block.matrix[(i, i)]).collect::<Vec<_>>()
        };
        let blocks = self.modal().modes.blocks.iter();
        blocks.flat_map(diagonal).map(|rate| (rate.re, rate.im.abs())).collect()
    }

    /// All unknowns at `times` from the modal form.
    pub(super) fn by_modes(&self, times: &[f64]) -> Vec<f64> {
        let Modal { modes, spans } = self.modal();
        let rows: Vec<ModalRow> = (0..self.system.states)
            .map(|i| ModalRow::new(modes, &[(i, self.system.units[i])]))
            .collect();
        let mut values = Vec::with_capacity(times.len() * rows.len());
        for &t in times {
            let at = self.system.span_at(t);
            let local = t - self.system.spans[at].start;
            let coordinates = coordinates_at(modes, &spans[at].start, local);
            values.extend(rows.iter().map(|row| row.value(&coordinates)));
        }
        values
    }

    /// All unknowns on a uniform grid from the propagator.
    pub(super) fn by_propagator(&self, grid: Grid) -> Vec<f64> {
        let system = &self.system;
        let units = &system.units[..system.states];
        let mut values = Vec::with_capacity(grid.count * system.states);
        let mut state = system.initial.clone();
        let mut done = 0;
        let time = |k: usize| grid.first + number(k) * grid.step;
        for (at, span) in system.spans.iter().enumerate() {
            let last = at + 1 == system.spans.len();
            let mut until = done;
            if last {
                until = grid.count;
            } else {
                while until < grid.count && time(until) < span.end {
                    until += 1;
                }
            }
            if until > done {
                let first = time(done) - span.start;
                let part = Grid { first, step: grid.step, count: until - done };
                march(&system.matrix, &state, units, part, &mut values);
                done = until;
            }
            if let Some(next) = system.spans.get(at + 1) {
                state = advance(&system.matrix, &state, span.length());
                state[system.states..].copy_from_slice(&next.generators);
            }
        }
        values
    }

    fn panel(&self, piece: Piece, scale: f64) -> Panel {
        let seconds = |t: f64| {
            if t >= self.system.end() { self.t_end } else { (t * self.time_scale).min(self.t_end) }
        };
        let mut coefficients = piece.coefficients;
        coefficients.iter_mut().for_each(|c| *c *= scale);
        Panel { start: seconds(piece.start), end: seconds(piece.end), coefficients }
    }
}

impl Dense for Solution {
    fn signal(&self, _system: &System, output: &Output) -> Signal {
        let Modal { modes, spans } = self.modal();
        let row = ModalRow::new(modes, &self.system.form(output));
        let lengths = || self.system.spans.iter().zip(spans);
        let scale = lengths()
            .map(|(span, coordinates)| row.size(modes, coordinates, span.length()))
            .filter(|size| size.is_finite())
            .fold(0.0, f64::max);
        let (mut quality, mut pieces) = (Quality::default(), Vec::new());
        for (span, coordinates) in lengths() {
            let place = (span.start, span.length());
            row.interpolate(modes, coordinates, place, scale, &mut quality, &mut pieces);
        }
        let unit = output.scale;
        let noise = NOISE * f64::EPSILON * quality.size * unit.abs();
        let error = quality.error * unit.abs() + noise;
        let panels = pieces.into_iter().map(|piece| self.panel(piece, unit)).collect();
        Signal::new(panels, error.is_finite().then_some(error), noise)
    }

    fn sample(&self, _system: &System, times: &[f64]) -> Vec<f64> {
        let few = self.system.spans.len() <= FEW_SPANS;
        match uniform(times) {
            Some(grid) if few && self.system.norm() * self.system.end() <= GENTLE => {
                self.by_propagator(grid)
            }
            _ => self.by_modes(times),
        }
    }
}

/// The grid that these times are, if they are equally spaced.
fn uniform(times: &[f64]) -> Option<Grid> {
    let (&first, &last) = (times.first()?, times.last()?);
    let count = times.len();
    if count == 1 {
        return Some(Grid { first, step: 0.0, count });
    }
    let step = (last - first) / number(count - 1);
    let tolerance = UNIFORM * last.abs();
    let fits = |(k, t): (usize, &f64)| (first + number(k) * step - t).abs() <= tolerance;
    times.iter().enumerate().all(fits).then_some(Grid { first, step, count })
}
