//! The exact solution as a trajectory.

use std::sync::{Arc, OnceLock};

use super::{
    Augmented, Complex,
    augmented::Span,
    block::Block,
    coordinates::{SpanCoordinates, follow},
    decomposition::{Form, Shared, decompose},
    decoupling::CAUTIONS,
    modal_row::{ModalRow, coordinates_at, largest_of},
    modes::Modes,
    panels::{Piece, Tally, interpolate},
    propagator::{Grid, advance, drifts, propagate},
    stations::{Common, MOST_MODES, MOST_SPANS, Stations, Told},
};
use crate::{Budget, Dense, Panel, Signal, System};

/// Rounding of a value relative to the sizes of its terms, in units of `ε`: interpolation, a few
/// operations for each term, and what trimming leaves between panels.
const NOISE: f64 = 16.0;
/// The same in the range below full precision: some of the smallest numbers.
const SMALLEST: f64 = NOISE * f64::MIN_POSITIVE * f64::EPSILON;
/// Spans up to which the propagator is used for samples; each takes exponentials of its own.
const FEW_SPANS: usize = 8;
/// `‖Ā‖ T` up to which the propagator is used for samples; beyond it the modes are more accurate.
const GENTLE: f64 = 1e6;
/// `‖Ā‖ T` up to which even free motion may be marched.
const BRIEF: f64 = 20.0;
/// Relative error bound below which no other clustering of the modes is tried.
const GOOD: f64 = 1e-11;
/// Most times at which the coordinates are kept that values are told from.
const MOST_TIMES: usize = 256;
/// Deviation from a uniform grid that is rounding, relative to the last time.
const UNIFORM: f64 = 1e-14;

/// `y(t)` on `[0, end]`. Nothing is computed before it is asked for.
#[derive(Debug, Clone)]
pub(crate) struct Solution {
    system: Augmented,
    /// The end of the run \[s\], which the last panel shall meet exactly.
    t_end: f64,
    time_scale: f64,
    budget: Budget,
    modal: OnceLock<Arc<Modal>>,
    /// What outputs share, where there is anything.
    common: OnceLock<Option<Arc<Common>>>,
    /// Where values were asked for first.
    instants: OnceLock<Arc<Instants>>,
}

/// Times \[s\] and the coordinates there.
#[derive(Debug)]
struct Instants {
    times: Vec<f64>,
    /// One row of coordinates after another.
    coordinates: Vec<Complex>,
}

#[derive(Debug)]
struct Modal {
    form: Arc<Form>,
    spans: Vec<SpanCoordinates>,
}

impl Modal {
    fn of(system: &Augmented, form: Arc<Form>) -> Self {
        let spans = follow(system, &form.modes);
        Self { form, spans }
    }

    fn in_modes(system: &Augmented, modes: Modes) -> Self {
        Self::of(system, Arc::new(Form::of(modes)))
    }

    /// The largest error bound of any state relative to the largest state at any breakpoint, in the
    /// units of `z`. Not finite where nothing is known.
    fn loss(&self, system: &Augmented) -> f64 {
        let modes = &self.form.modes;
        let rows: Vec<ModalRow> =
            (0..modes.len()).map(|k| ModalRow::new(modes, &[(k, 1.0)])).collect();
        let (mut size, mut error) = (0.0_f64, 0.0_f64);
        for (span, coordinates) in system.spans.iter().zip(&self.spans) {
            let last = coordinates_at(modes, &coordinates.start, span.length());
            for row in &rows {
                size = size.max(row.value(&coordinates.start).abs()).max(row.value(&last).abs());
                let bound = row.error(modes, coordinates);
                error = if bound.is_finite() { error.max(bound) } else { f64::INFINITY };
            }
        }
        if error == 0.0 { 0.0 } else { error / size }
    }
}

impl Solution {
    /// The solution of the augmented system over a run that ends at `t_end` \[s\], within a budget:
    /// where that ends, signals have no bound.
    pub(crate) fn new(system: Augmented, (t_end, time_scale): (f64, f64), budget: Budget) -> Self {
        let (modal, common, instants) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { system, t_end, time_scale, budget, modal, common, instants }
    }

    /// The same solution in the modes of one of the same equations, where it is as good in them.
    pub(crate) fn alike(mut self, shared: &Shared) -> Self {
        if let Some((equations, form)) = shared.of(&self.system.equations) {
            self.system.equations = Arc::clone(equations);
            let modal = Modal::of(&self.system, Arc::clone(form));
            if modal.loss(&self.system) <= GOOD {
                self.modal = OnceLock::from(Arc::new(modal));
            }
        }
        self
    }

    /// Lets those of the same equations that follow know its modes.
    pub(crate) fn share(&self, shared: &mut Shared) {
        shared.remember(&self.system.equations, &self.modal().form);
    }

    /// The same solution on a run that ends earlier, at `t_end` \[s\].
    pub(crate) fn until(mut self, t_end: f64) -> Self {
        let end = t_end / self.time_scale;
        self.system.spans.retain(|span| span.start == 0.0 || span.start < end);
        if let Some(last) = self.system.spans.last_mut() {
            last.end = end;
        }
        self.t_end = t_end;
        (self.common, self.instants) = (OnceLock::new(), OnceLock::new());
        self
    }

    /// The same solution, each of whose outputs has panels of its own, as suits few of them.
    pub(crate) fn apart(self) -> Self {
        Self { common: OnceLock::from(None), ..self }
    }

    /// Panels that are good for all outputs, where they share them.
    fn shared_by_all(&self, system: &System) -> Option<Arc<Common>> {
        let Modal { form, spans } = self.modal();
        let modes = &form.modes;
        if modes.len() > MOST_MODES || spans.len() > MOST_SPANS {
            return None;
        }
        let (rows, largest) = (form.rows(&self.system, &system.outputs), self.largest());
        let scales: Vec<f64> = rows.iter().map(|row| self.scale(row, &largest)).collect();
        let told: Vec<Told<'_>> = rows.iter().zip(scales.iter().copied()).collect();
        let stations = |(span, own): (&Span, &SpanCoordinates)| {
            Stations::of((modes, &self.budget), &own.start, span.length(), &told)
        };
        let spans = self.system.spans.iter().zip(spans).map(stations).collect::<Option<_>>()?;
        Some(Arc::new(Common { rows, scales, spans }))
    }

    /// For each span how large the coordinates are at most.
    fn largest(&self) -> Vec<Vec<f64>> {
        let Modal { form, spans } = self.modal();
        let all = self.system.spans.iter().zip(spans);
        all.map(|(span, own)| largest_of(&form.modes, own, span.length())).collect()
    }

    /// The largest size of the terms of an output where the coordinates are so large.
    fn scale(&self, row: &ModalRow, largest: &[Vec<f64>]) -> f64 {
        let sizes = largest.iter().map(|own| row.size(&self.modal().form.modes, own));
        sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
    }

    /// The coordinates at these times \[s\]; found once for those that are asked for first.
    fn instants(&self, times: &[f64]) -> Arc<Instants> {
        let found = || {
            let Modal { form, spans } = self.modal();
            let coordinates = |time: &f64| {
                let t = time / self.time_scale;
                let at = self.system.span_at(t);
                coordinates_at(&form.modes, &spans[at].start, t - self.system.spans[at].start)
            };
            let coordinates = times.iter().flat_map(coordinates).collect();
            Arc::new(Instants { times: times.to_vec(), coordinates })
        };
        let known = self.instants.get_or_init(found);
        if known.times == times { Arc::clone(known) } else { found() }
    }

    /// The modal form of an output or, of order 1, of its rate.
    fn row(&self, system: &System, output: usize, order: usize) -> ModalRow {
        let form = self.system.form(system.outputs.at(output));
        let form = if order == 0 { form } else { self.system.rate(&form) };
        ModalRow::new(&self.modal().form.modes, &form)
    }

    /// Drops the tables that panels were made of, unless other solutions share them.
    pub(crate) fn clear(&self) {
        let own = self.modal.get().filter(|modal| Arc::strong_count(&modal.form) == 1);
        if let Some(modal) = own {
            modal.form.tables.clear();
        }
    }

    /// The same solution with its modes found, so that its copies need not find them again.
    pub(crate) fn decomposed(self) -> Self {
        self.modal();
        self
    }

    fn modal(&self) -> &Modal {
        self.modal.get_or_init(|| {
            let mut best: Option<(f64, Modal)> = None;
            for caution in CAUTIONS {
                self.budget.charge_decomposition(self.system.size());
                let modal = Modal::in_modes(&self.system, decompose(&self.system, caution));
                let loss = modal.loss(&self.system);
                if best.as_ref().is_none_or(|(least, _)| loss < *least) {
                    best = Some((loss, modal));
                }
                if loss <= GOOD {
                    break;
                }
            }
            Arc::new(match best {
                Some((loss, modal)) if loss.is_finite() => modal,
                _ => Modal::in_modes(&self.system, Modes::undivided(&self.system)),
            })
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

    /// The radians that all modes together pass through until `end`, dimensionless.
    ///
    /// A mode that decays is forgotten after so many lifetimes, and one that stands still in a span,
    /// as that of a pulse before and after it, passes through none there.
    pub(crate) fn radians(&self, end: f64, lifetimes: f64) -> f64 {
        let Modal { form, spans } = self.modal();
        let of_block = |block: &Block| {
            let spans = self.system.spans.iter().zip(spans);
            let moving = spans.filter(|(_, coordinates)| block.moves(&coordinates.start));
            let length = moving.map(|(span, _)| (span.end.min(end) - span.start).max(0.0)).sum();
            radians(block, length, lifetimes)
        };
        form.modes.blocks.iter().map(of_block).sum()
    }

    /// The same if every mode that moves went on until `end`, which may lie beyond that of the run.
    pub(crate) fn radians_beyond(&self, end: f64, lifetimes: f64) -> f64 {
        let Modal { form, spans } = self.modal();
        let moving =
            form.modes.blocks.iter().filter(|block| spans.iter().any(|at| block.moves(&at.start)));
        moving.map(|block| radians(block, end, lifetimes)).sum()
    }

    /// The same of the one mode that oscillates most, whether it moves or not.
    pub(crate) fn most_radians(&self, end: f64, lifetimes: f64) -> f64 {
        let blocks = self.modal().form.modes.blocks.iter();
        let modes = blocks.flat_map(|block| (0..block.len()).map(|at| block.matrix[(at, at)]));
        modes.map(|rate| radians_of(rate, end, lifetimes)).fold(0.0, f64::max)
    }

    /// The most by which rounding of the entries of `Ā` may change a mode until `end`, dimensionless, or until
    /// it has decayed.
    pub(crate) fn blur(&self, end: f64) -> f64 {
        let modes = &self.modal().form.modes;
        let sizes = self.system.matrix.abs() * modes.basis.map(Complex::norm);
        let blur = modes.dual.map(Complex::norm) * sizes * f64::EPSILON;
        let of_block = |block: &Block| {
            let life = |at: usize| end.min(block.matrix[(at, at)].re.abs().recip());
            let places = (0..block.len()).flat_map(|i| (0..block.len()).map(move |j| (i, j)));
            places.map(|(i, j)| blur[(block.start + i, block.start + j)] * life(j)).sum()
        };
        let all: Vec<f64> = modes.blocks.iter().map(of_block).collect();
        all.into_iter()
            .map(|own| if own.is_nan() { f64::INFINITY } else { own })
            .fold(0.0, f64::max)
    }

    /// All unknowns at `times` from the modal form.
    pub(super) fn by_modes(&self, times: &[f64]) -> Vec<f64> {
        let Modal { form, spans } = self.modal();
        let modes = &form.modes;
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

    /// Whether marching is quick and accurate enough.
    ///
    /// Each step adds an error of its own; one of a velocity moves all positions after it, so that in
    /// free motion the errors add up twice.
    fn can_propagate(&self) -> bool {
        let system = &self.system;
        let reach = system.norm() * system.end();
        system.spans.len() <= FEW_SPANS
            && reach <= GENTLE
            && (reach <= BRIEF || !drifts(&system.matrix, system.states))
    }

    /// All unknowns on a uniform grid from the propagator.
    pub(super) fn by_propagator(&self, grid: Grid) -> Vec<f64> {
        let system = &self.system;
        let units = &system.units[..system.states];
        let mut values = Vec::with_capacity(grid.count * system.states);
        let mut state = system.initial.clone();
        let mut done = 0;
        let time = |k: usize| grid.first + k as f64 * grid.step;
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
                propagate(&system.matrix, &state, units, part, &mut values);
                done = until;
            }
            if let Some(next) = system.spans.get(at + 1) {
                state = advance(&system.matrix, &state, span.length());
                state[system.states..].copy_from_slice(&next.generators);
            }
        }
        values
    }

    /// An output in SI units, of which the dimensionless value 1 is `unit`.
    fn told(&self, told: Told<'_>, common: Option<&Common>, unit: f64) -> Signal {
        let Modal { form, spans } = self.modal();
        let (modes, tables) = (&form.modes, &form.tables);
        let (row, scale) = told;
        let (mut tally, mut pieces) = (Tally::default(), Vec::new());
        for (at, (span, coordinates)) in self.system.spans.iter().zip(spans).enumerate() {
            let shared = common.and_then(|own| {
                let place = (coordinates, span.start);
                own.spans.get(at)?.interpolate(told, modes, place, &mut tally, &mut pieces)
            });
            if shared.is_none() {
                let place = (span.start, span.length());
                let known = (&mut tally, &self.budget);
                interpolate(row, (modes, tables), coordinates, place, scale, known, &mut pieces);
            }
        }
        let noise = NOISE * f64::EPSILON * tally.size * unit.abs();
        let largest = tally.size * unit.abs();
        let is_small = largest > 0.0 && largest < f64::MIN_POSITIVE / f64::EPSILON;
        let error = tally.error * unit.abs() + if is_small { noise + SMALLEST } else { noise };
        let panels = pieces.into_iter().map(|piece| self.panel(piece, unit)).collect();
        Signal::new(panels, error.is_finite().then_some(error), noise)
    }

    fn common(&self, system: &System) -> Option<&Common> {
        self.common.get_or_init(|| self.shared_by_all(system)).as_deref()
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
    fn signal(&self, system: &System, output: usize) -> Signal {
        let own = system.outputs.at(output);
        let common = self.common(system);
        // Whoever asks may have added outputs.
        let known = common.and_then(|own| Some((own.rows.get(output)?, own.scales[output])));
        if let Some(known) = known {
            return self.told(known, common, own.scale);
        }
        let row = self.row(system, output, 0);
        self.told((&row, self.scale(&row, &self.largest())), common, own.scale)
    }

    fn has_rates(&self) -> bool {
        true
    }

    fn rate(&self, system: &System, output: usize) -> Signal {
        let row = self.row(system, output, 1);
        let told = (&row, self.scale(&row, &self.largest()));
        let unit = system.outputs.at(output).scale / self.time_scale;
        self.told(told, self.common(system), unit)
    }

    fn values(
        &self,
        system: &System,
        output: usize,
        order: usize,
        times: &[f64],
    ) -> Option<Vec<f64>> {
        let Modal { form, spans } = self.modal();
        let is_forgotten = matches!(self.common.get(), Some(None));
        let is_large = form.modes.len() > MOST_MODES || spans.len() > MOST_SPANS;
        if is_forgotten || is_large || times.len() > MOST_TIMES {
            return None;
        }
        let unit = system.outputs.at(output).scale;
        let instants = self.instants(times);
        let by = |row: &ModalRow, unit: f64| {
            let all = instants.coordinates.chunks_exact(form.modes.len().max(1));
            all.map(|own| unit * row.value(own)).collect()
        };
        Some(match order {
            0 => by(&form.rows(&self.system, &system.outputs)[output], unit),
            _ => by(&self.row(system, output, order), unit / self.time_scale),
        })
    }

    fn sample(&self, _system: &System, times: &[f64]) -> Vec<f64> {
        match uniform(times) {
            // One state is wanted where equations change: as exactly as the signals are. That at the start is given.
            Some(grid) if (grid.count > 1 || grid.first == 0.0) && self.can_propagate() => {
                self.by_propagator(grid)
            }
            _ => self.by_modes(times),
        }
    }

    fn forget(&self) {
        // Nothing that outputs would share is made any more.
        let _ = self.common.set(None);
        self.clear();
    }

    fn bytes(&self) -> usize {
        /// Entries of the size of a number for each of a matrix: it, the modes with their low digits and
        /// their inverse, what both miss, and the blocks.
        const ENTRIES: usize = 12;
        let size = self.system.size();
        let is_shared = Arc::strong_count(&self.system.equations) > 1;
        let matrices = if is_shared { 0 } else { ENTRIES * size.pow(2) };
        let spans = self.system.spans.len() * (4 * size + self.system.generators.len());
        size_of::<Self>() + size_of::<f64>() * (matrices + spans)
    }
}

/// The radians that the modes of a block pass through in a time, as long as they live.
fn radians(block: &Block, length: f64, lifetimes: f64) -> f64 {
    (0..block.len()).map(|at| radians_of(block.matrix[(at, at)], length, lifetimes)).sum()
}

/// Those of one mode.
fn radians_of(rate: Complex, length: f64, lifetimes: f64) -> f64 {
    let alive = if rate.re < 0.0 { lifetimes / -rate.re } else { f64::INFINITY };
    rate.im.abs() * length.min(alive)
}

/// The grid that these times are, if they are equally spaced.
fn uniform(times: &[f64]) -> Option<Grid> {
    let (&first, &last) = (times.first()?, times.last()?);
    let count = times.len();
    if count == 1 {
        return Some(Grid { first, step: 0.0, count });
    }
    let step = (last - first) / (count - 1) as f64;
    let tolerance = UNIFORM * last.abs();
    let fits = |(k, t): (usize, &f64)| (first + k as f64 * step - t).abs() <= tolerance;
    times.iter().enumerate().all(fits).then_some(Grid { first, step, count })
}
