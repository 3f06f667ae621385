//! A solution kept as values at points of time, one polynomial for each step through some of them.

mod conversion;
mod inputs;
mod lagrange;
mod products;
mod stream;

#[cfg(test)]
mod tests;

use std::sync::OnceLock;

use crate::{Dense, Digest, Keep, Output, Panel, Run, Signal, System, derivatives};
use conversion::Conversions;
use stream::Stream;

/// Roundings of the largest term that a value of an output may be off by: those of the
/// interpolation, and of its coefficients.
pub(crate) const ROUNDING: f64 = 16.0;

/// Memory \[B\] that a panel of a signal takes, whose polynomial follows some waves.
pub(crate) const PANEL_BYTES: usize = 300;

/// Memory \[B\] that the rows of a run may take.
pub(crate) const MOST_BYTES: usize = 1 << 30;

/// Steps whose conversions are kept, at most.
const MOST_CONVERTED: usize = 4096;

/// One step: where it lies, and the rows that its polynomial passes through. Times are counted from
/// `origin`, so that steps far below the resolution of the time of day are told apart.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Step {
    /// Start of the smooth span that the step belongs to.
    origin: f64,
    /// The driving functions' pieces that hold from this time on hold at the start of the step.
    from: f64,
    start: f64,
    end: f64,
    /// First of `degree + 1` rows.
    first: usize,
    degree: usize,
}

/// The solution of a run in dimensionless time: rows of values of the unknowns, and the steps.
///
/// Where only a part is kept, rows hold the unknowns that its outputs need; what is to be known of all
/// others is summed up while the last rows of all of them are still there.
///
/// A multistep method needs no row but the last of a step: its polynomial passes through the rows of
/// the steps before. A one-step method adds rows inside the step.
#[derive(Debug)]
pub(crate) struct Pieces {
    /// The unknowns that are kept, in rising order; `None` where all are.
    kept: Option<Vec<usize>>,
    stream: Option<Box<Stream>>,
    /// How many unknowns are kept.
    size: usize,
    /// Rows of `size` values each.
    rows: Vec<f64>,
    /// The time of each row, from the origin of its span.
    times: Vec<f64>,
    steps: Vec<Step>,
    /// From the rows of each step to coefficients, once an output of the whole run was asked for.
    conversions: OnceLock<Conversions>,
    origin: f64,
    /// See [`Step::from`], of the next step.
    from: f64,
    /// The first row of the span.
    first: usize,
    /// Time that the steps of the span have reached.
    reached: f64,
    /// End of the run \[s\], to the last bit.
    t_end: f64,
}

impl Pieces {
    /// A store for what `run` keeps, without any step yet.
    pub(crate) fn new(system: &System, run: &Run) -> Self {
        let (kept, stream) = match &run.keep {
            Keep::Everything => (None, None),
            Keep::Part(part) => {
                let guards =
                    run.guards.iter().flat_map(|guard| [Some(guard.output), guard.rate_of]);
                let watched = guards.flatten();
                let outputs = part.outputs.iter().copied().chain(watched);
                let forms = outputs.filter_map(|at| system.outputs.get(at));
                let mut kept: Vec<usize> =
                    forms.flat_map(|form| form.unknowns.terms()).map(|term| term.0).collect();
                kept.sort_unstable();
                kept.dedup();
                (Some(kept), Some(Box::new(Stream::new(system, part, run.rtol))))
            }
        };
        Self {
            size: kept.as_ref().map_or(system.len(), Vec::len),
            kept,
            stream,
            rows: Vec::new(),
            times: Vec::new(),
            steps: Vec::new(),
            conversions: OnceLock::new(),
            origin: 0.0,
            from: 0.0,
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
    pub(crate) fn begin(&mut self, system: &System, origin: f64, state: &[f64]) {
        if let Some(stream) = &mut self.stream {
            stream.settle(system, &self.times);
            stream.begin(system, (self.from, origin), state);
        }
        (self.origin, self.from) = (origin, origin);
        self.reached = 0.0;
        self.first = self.times.len();
        self.add_row(system, 0.0, state);
    }

    /// Adds the unknowns at a time after the span's origin.
    pub(crate) fn add_row(&mut self, system: &System, time: f64, state: &[f64]) {
        if let Some(stream) = &mut self.stream {
            stream.settle(system, &self.times);
            stream.add_row(state);
        }
        self.times.push(time);
        match &self.kept {
            None => self.rows.extend_from_slice(state),
            Some(kept) => self.rows.extend(kept.iter().map(|&unknown| state[unknown])),
        }
    }

    /// Ends a step at the last row. Its polynomial has this degree, or a lower one where the span has
    /// not enough rows, and passes through the last rows.
    pub(crate) fn end_step(&mut self, system: &System, degree: usize) {
        let last = self.times.len() - 1;
        let degree = degree.min(last - self.first).min(lagrange::HIGHEST);
        let end = self.times[last];
        self.add_step(system, (last - degree, degree), end);
    }

    /// Adds a step up to `end` in which no unknown moves.
    pub(crate) fn rest(&mut self, system: &System, end: f64) {
        self.add_step(system, (self.times.len() - 1, 0), end);
    }

    fn add_step(&mut self, system: &System, (first, degree): (usize, usize), end: f64) {
        let Self { origin, from, reached: start, .. } = *self;
        let step = Step { origin, from, start, end, first, degree };
        self.from = step.last_piece(system);
        self.reached = step.end;
        self.steps.push(step);
        if let Some(stream) = &mut self.stream {
            stream.pending = Some(step);
        }
    }

    /// Memory that the rows and steps take \[B\].
    pub(crate) fn size_of_rows(&self) -> usize {
        size_of::<f64>() * (self.rows.len() + self.times.len())
            + size_of::<Step>() * self.steps.len()
    }

    /// How many panels follow the driving functions over the last step.
    pub(crate) fn panels(&self, system: &System) -> usize {
        self.steps.last().map_or(0, |step| inputs::panels(system, step))
    }

    /// Number of steps.
    pub(crate) fn len(&self) -> usize {
        self.steps.len()
    }

    /// Ends the run at `t_end` \[s\], which lies in the last step.
    pub(crate) fn finish(&mut self, system: &System, t_end: f64) {
        self.t_end = t_end;
        if let Some(last) = self.steps.last_mut() {
            last.end = (t_end / system.time_scale - last.origin).clamp(last.start, last.end);
            if let Some(stream) = &mut self.stream {
                stream.pending = Some(*last);
                stream.finish(system, &self.times);
            }
        }
    }

    /// The output over the whole run.
    pub(crate) fn whole(&self, system: &System, output: Output<'_>) -> Signal {
        let all = || self.conversions(&self.steps);
        let own;
        let conversions = if self.steps.len() > MOST_CONVERTED {
            own = all();
            &own
        } else {
            self.conversions.get_or_init(all)
        };
        self.signal_of(system, output, (&self.steps, conversions))
    }

    /// Outputs over the last step.
    pub(crate) fn last_step(&self) -> LastStep<'_> {
        let steps = &self.steps[self.steps.len().saturating_sub(1)..];
        LastStep { pieces: self, steps, conversions: self.conversions(steps) }
    }

    fn conversions(&self, steps: &[Step]) -> Conversions {
        let mut conversions = Conversions::default();
        for step in steps {
            let nodes = &self.times[step.first..=step.first + step.degree];
            conversions.push(nodes, (step.start, step.end));
        }
        conversions
    }

    /// The output over adjoining steps, with their conversions.
    fn signal_of(
        &self,
        system: &System,
        output: Output<'_>,
        (steps, conversions): (&[Step], &Conversions),
    ) -> Signal {
        let mut panels = Vec::with_capacity(steps.len());
        let mut magnitude = 0.0_f64;
        let Some(terms) = self.places(output) else {
            let start = steps.first().map_or(0.0, |step| step.origin + step.start);
            let start = (start * system.time_scale).min(self.t_end);
            let panel = Panel::constant(start, self.t_end, f64::NAN);
            return Signal::new(vec![panel], None, f64::NAN);
        };
        let mut reader = conversions.reader();
        for step in steps {
            let mut values = [0.0; lagrange::HIGHEST + 1];
            self.in_rows(&terms, step, &mut values, &mut magnitude);
            let own = reader.coefficients(&values[..=step.degree]);
            inputs::add(system, output, step, own, &mut panels, &mut magnitude);
        }
        if let Some(panel) = panels.last_mut()
            && self.t_end.is_finite()
        {
            panel.end = self.t_end.max(panel.start);
        }
        Signal::new(panels, None, ROUNDING * f64::EPSILON * magnitude * output.scale.abs())
    }

    /// The terms of an output over the values of a row; `None` where not all of them are kept.
    fn places(&self, output: Output<'_>) -> Option<Vec<(usize, f64)>> {
        let terms = output.unknowns.terms();
        let Some(kept) = &self.kept else { return Some(terms.collect()) };
        let place = |(unknown, factor)| Some((kept.binary_search(&unknown).ok()?, factor));
        terms.map(place).collect()
    }

    /// The sum of `terms` in the rows of a step, and how large they are.
    fn in_rows(
        &self,
        terms: &[(usize, f64)],
        step: &Step,
        values: &mut [f64; lagrange::HIGHEST + 1],
        magnitude: &mut f64,
    ) {
        for (at, in_row) in values.iter_mut().enumerate().take(step.degree + 1) {
            let row = &self.rows[(step.first + at) * self.size..][..self.size];
            let mut size = 0.0;
            for &(unknown, factor) in terms {
                let term = factor * row[unknown];
                *in_row += term;
                size += term.abs();
            }
            *magnitude = magnitude.max(size);
        }
    }
}

/// The last step of a run that goes on.
pub(crate) struct LastStep<'p> {
    pieces: &'p Pieces,
    steps: &'p [Step],
    conversions: Conversions,
}

impl LastStep<'_> {
    /// An output over the step.
    pub(crate) fn signal(&self, system: &System, output: Output<'_>) -> Signal {
        self.pieces.signal_of(system, output, (self.steps, &self.conversions))
    }
}

impl Dense for Pieces {
    fn signal(&self, system: &System, output: usize) -> Signal {
        self.whole(system, system.outputs.at(output))
    }

    /// Rates: those of the equations, which tell of corners of driving functions within a step.
    fn values(
        &self,
        system: &System,
        output: usize,
        order: usize,
        times: &[f64],
    ) -> Option<Vec<f64>> {
        let rate = |time: &f64| {
            let time = time / system.time_scale;
            let state = self.sample(system, &[time]);
            let waveforms = system.waveforms.iter().map(|own| own.since(time)).collect();
            let system = System { waveforms, ..system.clone() };
            let is_told = !state.is_empty() && state.len() == system.len();
            let motion = is_told.then(|| derivatives(&system, &state, 1).ok())??;
            let output = system.outputs.at(output);
            let rate = output.unknowns.at(&motion.values[1]) + output.inputs.at(&motion.inputs[1]);
            Some(output.scale * rate / system.time_scale)
        };
        (order == 1).then(|| times.iter().map(rate).collect())?
    }

    fn sample(&self, _system: &System, times: &[f64]) -> Vec<f64> {
        if self.size == 0 || self.kept.is_some() {
            return Vec::new();
        }
        let mut samples = vec![0.0; times.len() * self.size];
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

    fn keeps(&self, system: &System, output: usize) -> bool {
        system.outputs.get(output).is_some_and(|output| self.places(output).is_some())
    }

    fn digest(&self) -> Option<&Digest> {
        self.stream.as_ref().map(|stream| &stream.digest)
    }

    fn bytes(&self) -> usize {
        self.size_of_rows()
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
