//! DOP853, an explicit method, step by step.
//!
//! Every stage solves the balances, so that algebraic unknowns need no equations of their own. The dense
//! output is a polynomial of degree 7 in the differential unknowns; the others follow from it.

mod corners;
mod drives;
mod reduced;

use dashpot_numerics::{
    chebyshev::Interpolation,
    dop853::{DEGREE, DENSE, END, FIFTH, FURTHER, LAST, Row, STAGES, Stage, THIRD},
};

use self::{
    corners::Corners,
    reduced::{Rate, Reduced, Unbalanced},
};
use super::{Stop, Walk, failure::Site, walk::ROUNDINGS};
use crate::{SolveError, System, budget::Besides, pieces::between};

/// Part of the step that the estimate of its error allows which is taken.
const SAFETY: f64 = 0.9;
/// By what the estimate of a step's error is multiplied: in long oscillations errors add up, and no other method
/// of so high an order at the same tolerance leaves as much.
const CAUTION: f64 = 100.0;
/// What a step may be longer and shorter by than the one before.
const GROWTH: (f64, f64) = (1.0 / 3.0, 6.0);
/// The longest step in parts of a span between corners at the tolerance [`COARSE`]: errors fall by its power of the order
/// where it limits the steps, and half of a span is short enough for that to be seen.
const OF_SPAN: f64 = 0.5;
/// The longest step in periods of the fastest driving function at the tolerance [`COARSE`]: a longer one might miss it.
const OF_PERIOD: f64 = 0.25;
/// Part of a step whose balances have no solution that is tried next.
const RETREAT: f64 = 0.25;
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
/// Roundings by which unknowns must differ to tell of a rate.
const TOLD: f64 = 1e4;
/// The work of a stage in parts of a linear system's: it is counted as so many for a step.
const SOLVES: usize = 4;

/// What the integrator works with.
struct Integrator<'s> {
    reduced: Reduced<'s>,
    /// The slopes of all stages.
    slopes: Vec<Vec<f64>>,
    /// All unknowns at the start of the step, at a stage, and at its end.
    before: Vec<f64>,
    stage: Vec<f64>,
    after: Vec<f64>,
    /// The coefficients of the dense output.
    dense: [Vec<f64>; DEGREE + 1],
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
    let mut own = Integrator::new(walk.system, walk.span, state);
    let length = walk.span.1 - walk.span.0;
    let outcome = own.advance(walk, (first, length), tolerance);
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
    is_after_rejection: bool,
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

    /// By what the next step is longer than one of this error, in parts of the tolerance, which was rejected
    /// where that is more than 1 or not known.
    fn factor(&mut self, error: Option<f64>) -> f64 {
        let own = match error.filter(|error| error.is_finite()) {
            Some(error) => (SAFETY * error.powf(-0.125)).clamp(GROWTH.0, GROWTH.1),
            None => RETREAT,
        };
        let is_rejected = !error.is_some_and(|error| error <= 1.0);
        let most = match (is_rejected, self.is_after_rejection) {
            (true, _) => SAFETY,
            (false, true) => 1.0,
            (false, false) => GROWTH.1,
        };
        self.is_after_rejection = is_rejected;
        own.min(most)
    }
}

impl<'s> Integrator<'s> {
    fn new(system: &'s System, span: (f64, f64), state: &[f64]) -> Self {
        let reduced = Reduced::new(system, span);
        let count = reduced.differential().len();
        Self {
            reduced,
            slopes: vec![vec![0.0; count]; LAST + 1 + FURTHER.len()],
            before: state.to_vec(),
            stage: state.to_vec(),
            after: state.to_vec(),
            dense: std::array::from_fn(|_| vec![0.0; count]),
            times: Vec::with_capacity(DEGREE),
            inside: Vec::with_capacity(DEGREE * state.len()),
            shown: 0.0,
        }
    }

    /// Takes steps up to the end of a span of this length.
    fn advance(
        &mut self,
        walk: &mut Walk<'_>,
        (first, length): (f64, f64),
        tolerance: (f64, &[f64]),
    ) -> Result<(), Stop> {
        let (method, system, start) = (walk.method, walk.system, walk.span.0);
        let end = walk.run.t_end / system.time_scale;
        let site = |t: f64| Site { method, time: (start + t) * system.time_scale, system };
        if self.reduced.slopes(0.0, &mut self.before, &mut self.slopes[0]).is_err() {
            return Err(self.stuck(walk, 0.0, site(0.0)));
        }
        let mut control = std::mem::take(&mut walk.control);
        let share = share(tolerance.0);
        control.longest = LONGEST * share;
        // Where corners limit the steps, and not their errors, they would be the same at all tolerances.
        let of_gap = OF_SPAN * (tolerance.0 / COARSE).powf(0.125);
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
            let error = self.attempt((t, step), to, tolerance).ok();
            let is_accepted = error.is_some_and(|error| error <= 1.0);
            let rejected = usize::from(!is_accepted);
            walk.statistics.rejected += rejected;
            let besides = Besides { rejected, factorizations: 0, solutions: SOLVES };
            walk.run.budget.charge_besides(besides, system.len());
            let mut factor = control.factor(error);
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
                self.go_on();
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
        let own = self.reduced.differential().iter().zip(&self.slopes[0]);
        own.for_each(|(&at, slope)| slopes[at] = *slope);
        Stop::Stuck { at: t, error: site.too_small(&self.before, &slopes) }
    }

    /// Takes a step that ends at `to`; its error in parts of the tolerance.
    fn attempt(
        &mut self,
        (t, step): (f64, f64),
        to: f64,
        tolerance: (f64, &[f64]),
    ) -> Result<f64, Unbalanced> {
        for (at, stage) in STAGES.iter().enumerate() {
            self.stage(at + 1, stage, (t, step))?;
        }
        self.after.copy_from_slice(&self.stage);
        self.reach(END, step);
        std::mem::swap(&mut self.stage, &mut self.after);
        let error = self.error(step, tolerance);
        if error <= 1.0 {
            self.reduced.slopes(to, &mut self.after, &mut self.slopes[LAST])?;
            self.shown = self.rate();
            self.look_inside((t, step), to)?;
            let inside = self.error_inside(tolerance).max(self.error_of_corners(
                (t, step),
                to,
                tolerance,
            )?);
            return Ok(error.max(inside));
        }
        Ok(error)
    }

    /// The slopes of a stage, and the unknowns there.
    fn stage(&mut self, at: usize, stage: &Stage, (t, step): (f64, f64)) -> Result<(), Unbalanced> {
        self.reach(stage.slopes, step);
        self.reduced.slopes(t + stage.time * step, &mut self.stage, &mut self.slopes[at])
    }

    /// Sets the differential unknowns of the stage.
    fn reach(&mut self, slopes: Row, step: f64) {
        for (at, &unknown) in self.reduced.differential().iter().enumerate() {
            let sum: f64 = slopes.iter().map(|&(own, factor)| factor * self.slopes[own][at]).sum();
            self.stage[unknown] = self.before[unknown] + step * sum;
        }
    }

    /// The estimate of the step's error in parts of the tolerance, from the solutions of order 5 and 3.
    fn error(&self, step: f64, (rtol, atol): (f64, &[f64])) -> f64 {
        let (mut fifth, mut third) = (0.0, 0.0);
        let sum = |row: Row, at: usize| -> f64 {
            row.iter().map(|&(own, factor)| factor * self.slopes[own][at]).sum()
        };
        for (at, &unknown) in self.reduced.differential().iter().enumerate() {
            let size = self.before[unknown].abs().max(self.after[unknown].abs());
            let unit = atol[unknown] + rtol * size;
            fifth += (sum(FIFTH, at) / unit).powi(2);
            third += ((sum(END, at) - sum(THIRD, at)) / unit).powi(2);
        }
        let both = fifth + 0.01 * third;
        let count = self.reduced.differential().len().max(1) as f64;
        if both > 0.0 { CAUTION * step * fifth / (both * count).sqrt() } else { both }
    }

    /// The fastest rate that a step shows: by how much the slopes of two stages at its end differ beside the
    /// unknowns; none where these differ by no more than some roundings.
    fn rate(&self) -> f64 {
        let (mut slopes, mut unknowns, mut sizes) = (0.0, 0.0, 0.0);
        for (at, &unknown) in self.reduced.differential().iter().enumerate() {
            slopes += (self.slopes[LAST][at] - self.slopes[LAST - 1][at]).powi(2);
            unknowns += (self.after[unknown] - self.stage[unknown]).powi(2);
            sizes += self.after[unknown].powi(2);
        }
        let rounding = TOLD * f64::EPSILON;
        if unknowns > rounding * rounding * sizes { (slopes / unknowns).sqrt() } else { 0.0 }
    }

    /// Finds the unknowns at the places inside a step that its polynomials pass through; none in a step that the
    /// time hardly resolves.
    fn look_inside(&mut self, (t, step): (f64, f64), to: f64) -> Result<(), Unbalanced> {
        self.times.clear();
        self.inside.clear();
        if step <= ROUNDINGS * f64::EPSILON * to {
            return Ok(());
        }
        self.fit((t, step))?;
        let nodes = Interpolation::of_degree(DEGREE);
        for &node in nodes.nodes().get(1..DEGREE).unwrap_or_default() {
            let time = between(t, to, node);
            self.look((time - t) / step);
            self.reduced.balance(time, &mut self.stage)?;
            self.times.push(time);
            self.inside.extend_from_slice(&self.stage);
        }
        Ok(())
    }

    /// The largest last coefficient of the polynomials of the algebraic unknowns in parts of the tolerance: what
    /// they follow may have kinks and powers that those of the others hardly show.
    fn error_inside(&self, (rtol, atol): (f64, &[f64])) -> f64 {
        if self.times.is_empty() {
            return 0.0;
        }
        let nodes = Interpolation::of_degree(DEGREE);
        let weights = || nodes.rows().map(|row| row[DEGREE]);
        let count = self.before.len();
        let error = |&unknown: &usize| {
            let (first, last) = (self.before[unknown], self.after[unknown]);
            let inside = self.inside.iter().skip(unknown).step_by(count);
            let values = [first].into_iter().chain(inside.copied()).chain([last]);
            let coefficient: f64 = weights().zip(values).map(|(weight, own)| weight * own).sum();
            coefficient.abs() / (atol[unknown] + rtol * first.abs().max(last.abs()))
        };
        self.reduced.algebraic().iter().map(error).fold(0.0, f64::max)
    }

    /// What the stages of a step miss of the driving functions' corners within it, in parts of the tolerance: by how much
    /// balanced unknowns and slopes are others where a function is farthest from a polynomial as smooth as the dense
    /// output. What comes and goes between stages would not show otherwise. Slopes are compared with the largest ones of the
    /// step as well: where all moves far together, little beside the unknowns is much beside what acts.
    fn error_of_corners(
        &mut self,
        (t, step): (f64, f64),
        to: f64,
        (rtol, atol): (f64, &[f64]),
    ) -> Result<f64, Unbalanced> {
        let mut error = 0.0_f64;
        for excursion in self.reduced.excursions((t, to), DEGREE) {
            self.look((excursion.time - t) / step);
            let (stages, free) = self.slopes.split_at_mut(LAST + 1);
            let [own, other, ..] = free else { return Ok(error) };
            self.reduced.slopes(excursion.time, &mut self.stage, own)?;
            let mut without = self.stage.clone();
            self.reduced.slopes_without(&excursion, &mut without, other)?;
            let unit = |unknown: usize| {
                atol[unknown] + rtol * self.before[unknown].abs().max(self.after[unknown].abs())
            };
            for (at, &unknown) in self.reduced.differential().iter().enumerate() {
                let change = (own[at] - other[at]).abs();
                if change > 0.0 {
                    let most = stages.iter().map(|slopes| slopes[at].abs()).fold(0.0, f64::max);
                    error = error.max(change / (rtol * most).min(unit(unknown) / step));
                }
            }
            let balanced = self.reduced.algebraic().iter();
            let balanced = balanced.map(|&at| (self.stage[at] - without[at]).abs() / unit(at));
            error = balanced.fold(error, f64::max);
        }
        Ok(error)
    }

    /// Hands a step that ends at `to` to `walk`.
    fn add_rows(&self, walk: &mut Walk<'_>, to: f64) {
        for (time, row) in self.times.iter().zip(self.inside.chunks_exact(self.before.len())) {
            walk.pieces.add_row(walk.system, *time, row);
        }
        walk.pieces.add_row(walk.system, to, &self.after);
        walk.pieces.end_step(walk.system, if self.times.is_empty() { 1 } else { DEGREE });
    }

    /// Finds the coefficients of the dense output.
    fn fit(&mut self, (t, step): (f64, f64)) -> Result<(), Unbalanced> {
        self.stage.copy_from_slice(&self.before);
        for (at, stage) in FURTHER.iter().enumerate() {
            self.stage(LAST + 1 + at, stage, (t, step))?;
        }
        for (at, &unknown) in self.reduced.differential().iter().enumerate() {
            let (start, change) =
                (self.before[unknown], self.after[unknown] - self.before[unknown]);
            let bend = step * self.slopes[0][at] - change;
            let other = change - step * self.slopes[LAST][at] - bend;
            let known = [start, change, bend, other];
            self.dense.iter_mut().zip(known).for_each(|(own, value)| own[at] = value);
            for (own, row) in self.dense[known.len()..].iter_mut().zip(DENSE) {
                let sum = row.iter().map(|&(stage, factor)| factor * self.slopes[stage][at]);
                own[at] = step * sum.sum::<f64>();
            }
        }
        Ok(())
    }

    /// Sets the differential unknowns at the part `x` of the step.
    fn look(&mut self, x: f64) {
        for (at, &unknown) in self.reduced.differential().iter().enumerate() {
            let mut value = 0.0;
            for (order, own) in self.dense.iter().enumerate().rev() {
                value = own[at] + if order % 2 == 0 { x } else { 1.0 - x } * value;
            }
            self.stage[unknown] = value;
        }
    }

    /// The end of the step is the start of the next one.
    fn go_on(&mut self) {
        std::mem::swap(&mut self.before, &mut self.after);
        self.slopes.swap(0, LAST);
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
