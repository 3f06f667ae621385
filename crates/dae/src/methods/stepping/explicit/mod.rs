//! DOP853, an explicit method, step by step.
//!
//! The steps are those of the differential unknowns. Every stage solves the balances, so that the others need no equations of
//! their own; within a step they follow from its dense output.

mod corners;
mod drives;
mod reduced;

use dashpot_numerics::{
    chebyshev::Interpolation,
    dop853::{Controller, DEGREE, Step},
};

use self::{
    corners::Corners,
    reduced::{Rate, Reduced, Unbalanced},
};
use super::{Stop, Walk, failure::Site, walk::ROUNDINGS};
use crate::{SolveError, System, budget::Besides, pieces::between};

/// By what the estimate of a step's error is multiplied: in long oscillations errors add up, and no other method
/// of so high an order at the same tolerance leaves as much.
const CAUTION: f64 = 100.0;
/// The longest step in parts of a span between corners at the tolerance [`COARSE`]: errors fall by its power of the order
/// where it limits the steps, and half of a span is short enough for that to be seen.
const OF_SPAN: f64 = 0.5;
/// The longest step in periods of the fastest driving function at the tolerance [`COARSE`]: a longer one might miss it.
const OF_PERIOD: f64 = 0.25;
/// A step may end beyond the end of the span by this part of itself: it is made to end there.
const STRETCH: f64 = 0.01;
/// The longest step in units of the fastest rate at the tolerance [`COARSE`] and above; below, it shrinks with the
/// tolerance as the steps do that follow the fastest. Stability would allow for twice as much, but what it leaves
/// of fast parts spoils the dense output, and steps must tell tolerances apart: error bars live on that.
const LONGEST: f64 = 3.0;
/// See [`LONGEST`].
const COARSE: f64 = 1e-4;
/// Steps between two looks at the linearised equations: what is fast shows in steps only where it has not died away.
const LOOKS: usize = 8;
/// More such steps, at a coarse tolerance, are left to an implicit method, where they are asked for by what dies away …
const PATIENCE: f64 = 100.0;
/// … once so many of them have been taken: a mode interval may end long before the run does, and begun anew an
/// implicit method takes as much.
const TRIED: usize = 25;
/// Of so many the ones that are tried would be too small a part: they are not begun.
const HOPELESS: f64 = 2500.0;
/// What decays by so many e-folds dies away: most of the steps would follow nothing.
const DEAD: f64 = 30.0;
/// So many such steps are left to an implicit method whatever asks for them: more oscillations are seldom excited.
const MOST: f64 = 5e4;
/// The work of a stage in parts of a linear system's: it is counted as so many for a step.
const SOLVES: usize = 4;

/// What the integrator works with.
struct Integrator<'s> {
    reduced: Reduced<'s>,
    /// The relative tolerance, and the absolute ones.
    tolerance: (f64, &'s [f64]),
    /// The step of the differential unknowns.
    step: Step<Vec<f64>>,
    /// All unknowns at the start of the step, at a stage, and at its end.
    before: Vec<f64>,
    stage: Vec<f64>,
    after: Vec<f64>,
    /// Differential unknowns inside the step, and two sets of slopes there.
    scratch: [Vec<f64>; 3],
    /// Times inside the step, and the unknowns there.
    times: Vec<f64>,
    inside: Vec<f64>,
    /// The fastest rate that the step shows.
    shown: f64,
}

/// Takes all steps of the current span from `state`, the first one of length `first`.
pub(super) fn span(
    walk: &mut Walk<'_>,
    state: &[f64],
    first: f64,
    tolerance: (f64, &[f64]),
) -> Result<(), Stop> {
    let mut own = Integrator::new(Reduced::new(walk.system, walk.span), state, tolerance);
    let outcome = own.advance(walk, (first, walk.span.1 - walk.span.0));
    walk.statistics.rhs_calls += own.reduced.calls;
    outcome
}

/// What limits the steps, from span to span.
#[derive(Debug, Default)]
pub(super) struct Control {
    /// The next step; none before the first one.
    step: Option<f64>,
    /// The longest step in units of the fastest rate.
    longest: f64,
    /// The fastest rate that is known, and the steps since the last look.
    rate: f64,
    steps: usize,
    /// Steps that stability has kept short.
    kept_short: usize,
    controller: Controller,
}

impl Control {
    /// Takes down a step that has shown the rate `shown`. Whether too many steps as short as stability asks for
    /// are to come in the time `left` of the run, as far as the linearised equations tell, at which `look` looks; few of them
    /// are tried all the same.
    fn is_stiff(
        &mut self,
        shown: f64,
        left: f64,
        look: impl FnOnce() -> Option<Vec<Rate>>,
    ) -> bool {
        let rates = if self.steps.is_multiple_of(LOOKS) { look() } else { None };
        self.steps += 1;
        if let Some(rates) = &rates {
            self.rate = rates.iter().map(|rate| rate.size).fold(0.0, f64::max);
        }
        self.rate = self.rate.max(shown);
        let patience = if self.kept_short < TRIED { HOPELESS } else { PATIENCE };
        rates.is_some_and(|rates| asks_for_many_steps(&rates, left, patience))
    }

    /// The factor by which the next step is longer than the last one of length `step`, as far as stability lets it.
    fn stable(&mut self, step: f64, factor: f64) -> f64 {
        let most = self.longest / self.rate / step;
        self.kept_short += usize::from(most < factor);
        factor.min(most)
    }
}

impl<'s> Integrator<'s> {
    fn new(reduced: Reduced<'s>, state: &[f64], tolerance: (f64, &'s [f64])) -> Self {
        let own: Vec<f64> = reduced.differential().iter().map(|&at| state[at]).collect();
        Self {
            reduced,
            tolerance,
            scratch: std::array::from_fn(|_| own.clone()),
            step: Step::new(own),
            before: state.to_vec(),
            stage: state.to_vec(),
            after: state.to_vec(),
            times: Vec::with_capacity(DEGREE),
            inside: Vec::with_capacity(DEGREE * state.len()),
            shown: 0.0,
        }
    }

    /// Takes steps up to the end of a span of this length.
    fn advance(&mut self, walk: &mut Walk<'_>, (first, length): (f64, f64)) -> Result<(), Stop> {
        let (method, system, start) = (walk.method, walk.system, walk.span.0);
        let end = walk.run.t_end / system.time_scale;
        let site = |t: f64| Site { method, time: (start + t) * system.time_scale, system };
        let Self { reduced, step, before, .. } = self;
        if step.begin(&mut |_, z, slopes| reduced.slopes(0.0, (z, before), slopes)).is_err() {
            return Err(self.stuck(walk, 0.0, site(0.0)));
        }
        let mut control = std::mem::take(&mut walk.control);
        let (rtol, _) = self.tolerance;
        let share = share(rtol);
        control.longest = LONGEST * share;
        // Where corners limit the steps, and not their errors, they would be the same at all tolerances.
        let of_gap = OF_SPAN * (rtol / COARSE).powf(0.125);
        let mut corners = Corners::of(walk);
        let mut wanted = control.step.unwrap_or(first);
        let mut t = 0.0;
        while t < length {
            let driven = system.period((start + t, start + (t + wanted).min(length)));
            let wave = OF_PERIOD * share * driven;
            let (before, border) = corners.around(t, wanted.min(wave));
            let gap = border - before;
            let mut step = wanted.min(if gap < end { of_gap * gap } else { gap }).min(wave);
            if t + (1.0 + STRETCH) * step >= border {
                step = border - t;
            }
            let to = if step < border - t { t + step } else { border };
            if t + 0.1 * step <= t || step.is_nan() {
                return Err(self.stuck(walk, t, site(t)));
            }
            let error = self.attempt((t, step), to).unwrap_or(f64::NAN);
            let is_accepted = error <= 1.0;
            let rejected = usize::from(!is_accepted);
            walk.statistics.rejected += rejected;
            let besides = Besides { rejected, factorizations: 0, solutions: SOLVES };
            walk.run.budget.charge_besides(besides, system.len());
            let mut factor = control.controller.factor(error);
            if is_accepted {
                site(to).finite(&self.after)?;
                let look = || self.reduced.rates(to, &self.after);
                if control.is_stiff(self.shown, end - start - to, look) {
                    return Err(self.stuck(walk, t, site(t)));
                }
                factor = control.stable(step, factor);
                self.add_rows(walk, to);
                walk.statistics.accepted += 1;
                corners.go_on();
                std::mem::swap(&mut self.before, &mut self.after);
                self.step.go_on();
                walk.report(site(to).time)?;
                t = to;
            } else if walk.run.budget.is_spent() {
                let (work, time) = (walk.run.budget.done(), site(t).time);
                return Err(SolveError::BudgetSpent { method, time, work }.into());
            }
            // What cuts a step is no reason for a shorter one behind it, nor that corners are not crossed.
            let longest = control.longest / control.rate;
            let kept =
                if is_accepted { corners.kept((wanted, step), error).min(longest) } else { 0.0 };
            wanted = if step < wanted { kept.max(step * factor) } else { step * factor };
        }
        walk.control = Control { step: Some(wanted), ..control };
        walk.state.copy_from_slice(&self.before);
        Ok(())
    }

    /// That the steps from the time `t` in the span on would be too small.
    fn stuck(&self, walk: &mut Walk<'_>, t: f64, site: Site<'_>) -> Stop {
        walk.state.copy_from_slice(&self.before);
        let mut slopes = vec![0.0; self.before.len()];
        self.reduced.set(&self.step.slopes()[0], &mut slopes);
        Stop::Stuck { at: t, error: site.too_small(&self.before, &slopes) }
    }

    /// Takes a step that ends at `to`; its error in parts of the tolerance.
    fn attempt(&mut self, (t, length): (f64, f64), to: f64) -> Result<f64, Unbalanced> {
        let Self { reduced, step, stage, after, .. } = self;
        step.attempt(length, &mut |x, z, slopes| {
            reduced.slopes(t + x * length, (z, stage), slopes)
        })?;
        let (rtol, atol) = self.tolerance;
        let differential = reduced.differential();
        let error = step.error(CAUTION, |at, size| atol[differential[at]] + rtol * size);
        if error <= 1.0 {
            after.copy_from_slice(stage);
            step.close(&mut |_, z, slopes| reduced.slopes(to, (z, after), slopes))?;
            self.shown = step.rate();
            self.look_inside((t, length), to)?;
            if !self.times.is_empty() {
                let of_corners = self.error_of_corners((t, length), to)?;
                return Ok(error.max(self.error_inside()).max(of_corners));
            }
        }
        Ok(error)
    }

    /// Finds the unknowns at the places inside a step that its polynomials pass through; none in a step that the
    /// time hardly resolves.
    fn look_inside(&mut self, (t, length): (f64, f64), to: f64) -> Result<(), Unbalanced> {
        self.times.clear();
        self.inside.clear();
        if length <= ROUNDINGS * f64::EPSILON * to {
            return Ok(());
        }
        let Self { reduced, step, stage, scratch: [own, ..], .. } = self;
        stage.copy_from_slice(&self.before);
        step.fit(&mut |x, z, slopes| reduced.slopes(t + x * length, (z, stage), slopes))?;
        let nodes = Interpolation::of_degree(DEGREE);
        for &node in nodes.nodes().get(1..DEGREE).unwrap_or_default() {
            let time = between(t, to, node);
            step.look((time - t) / length, own);
            reduced.set(own, stage);
            reduced.balance(time, stage)?;
            self.times.push(time);
            self.inside.extend_from_slice(stage);
        }
        Ok(())
    }

    /// The largest last coefficient of the polynomials of the algebraic unknowns in parts of the tolerance: what
    /// they follow may have kinks and powers that those of the others hardly show.
    fn error_inside(&self) -> f64 {
        let nodes = Interpolation::of_degree(DEGREE);
        let weights = || nodes.rows().map(|row| row[DEGREE]);
        let count = self.before.len();
        let error = |&unknown: &usize| {
            let (first, last) = (self.before[unknown], self.after[unknown]);
            let inside = self.inside.iter().skip(unknown).step_by(count);
            let values = [first].into_iter().chain(inside.copied()).chain([last]);
            let coefficient: f64 = weights().zip(values).map(|(weight, own)| weight * own).sum();
            coefficient.abs() / self.unit(unknown)
        };
        self.reduced.algebraic().iter().map(error).fold(0.0, f64::max)
    }

    /// What the stages of a step miss of the driving functions' corners within it, in parts of the tolerance: by how much
    /// balanced unknowns and slopes are others where a function is farthest from a polynomial as smooth as the dense
    /// output. What comes and goes between stages would not show otherwise. Slopes are compared with the largest ones of the
    /// step as well: where all moves far together, little beside the unknowns is much beside what acts.
    fn error_of_corners(&mut self, (t, length): (f64, f64), to: f64) -> Result<f64, Unbalanced> {
        let mut error = 0.0_f64;
        for excursion in self.reduced.excursions((t, to), DEGREE) {
            let Self { reduced, step, stage, scratch: [inside, own, other], .. } = self;
            step.look((excursion.time - t) / length, inside);
            reduced.slopes(excursion.time, (inside, stage), own)?;
            let mut without = self.stage.clone();
            reduced.slopes_without(&excursion, &mut without, other)?;
            let [_, own, other] = &self.scratch;
            for (at, &unknown) in self.reduced.differential().iter().enumerate() {
                let change = (own[at] - other[at]).abs();
                if change > 0.0 {
                    let stages = self.step.slopes().iter();
                    let most = stages.map(|slopes| slopes[at].abs()).fold(0.0, f64::max);
                    let unit = self.unit(unknown) / length;
                    error = error.max(change / (self.tolerance.0 * most).min(unit));
                }
            }
            let balanced = self.reduced.algebraic().iter();
            let balanced = balanced.map(|&at| (self.stage[at] - without[at]).abs() / self.unit(at));
            error = balanced.fold(error, f64::max);
        }
        Ok(error)
    }

    /// What errors of an unknown in the step are counted in.
    fn unit(&self, unknown: usize) -> f64 {
        let (rtol, atol) = self.tolerance;
        atol[unknown] + rtol * self.before[unknown].abs().max(self.after[unknown].abs())
    }

    /// Hands a step that ends at `to` to `walk`.
    fn add_rows(&self, walk: &mut Walk<'_>, to: f64) {
        for (time, row) in self.times.iter().zip(self.inside.chunks_exact(self.before.len())) {
            walk.pieces.add_row(walk.system, *time, row);
        }
        walk.pieces.add_row(walk.system, to, &self.after);
        walk.pieces.end_step(walk.system, if self.times.is_empty() { 1 } else { DEGREE });
    }
}

/// By what a step shrinks with the tolerance where something else limits it.
fn share(rtol: f64) -> f64 {
    (rtol / COARSE).powf(0.125).min(1.0)
}

/// Whether stability asks for too many steps to begin a span from `start` of this length, both dimensionless, where
/// the unknowns are `state`; so it counts where the rates are not known.
pub(in crate::methods) fn is_stiff(
    system: &System,
    state: &[f64],
    (start, length): (f64, f64),
) -> bool {
    let rates = Reduced::new(system, (start, start)).rates(0.0, state);
    rates.is_none_or(|rates| asks_for_many_steps(&rates, length, HOPELESS))
}

/// Whether parts with these rates ask for more steps than there is patience for in a time, of which most follow
/// nothing.
fn asks_for_many_steps(rates: &[Rate], length: f64, patience: f64) -> bool {
    rates.iter().any(|rate| {
        let steps = rate.size * length / LONGEST;
        steps > MOST || steps > patience && rate.decay * length > DEAD
    })
}
