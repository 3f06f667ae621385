//! From one step to the next.

use dashpot_numerics::chebyshev::Interpolation;
use diffsol::{OdeSolverMethod, OdeSolverStopReason, Vector, ode_solver::OdeSolverStatistics};

use super::{
    Algebra, Stop, algebra::Slice, equations::Equations, explicit::Control, failure::Site,
};
use crate::{
    Observer, Output, Progress, Run, Signal, SolveError, Statistics, System, UnknownKind,
    budget::Besides,
    events::Watch,
    pieces::{self, MOST_BYTES, Pieces, between},
};

/// Steps after which a run is given up.
const MOST_STEPS: usize = 1_000_000;

/// A step of no more than so many roundings of the time has no points of time inside.
pub(super) const ROUNDINGS: f64 = 64.0;

/// What a run has collected so far.
pub(in crate::methods) struct Walk<'r> {
    pub(super) method: &'static str,
    pub(super) system: &'r System,
    pub(super) run: &'r Run,
    pub(super) observer: &'r mut dyn Observer,
    pub(super) watch: Watch,
    /// The largest terms of each guard's output so far.
    pub(super) largest: Vec<f64>,
    pub(super) pieces: Pieces,
    /// Panels of a signal that follow driving functions within steps, beyond one for each step.
    pub(super) further: usize,
    pub(super) statistics: Statistics,
    /// Start and end of the current span, dimensionless.
    pub(super) span: (f64, f64),
    /// The times at which another piece of a driving function begins, dimensionless.
    pub(super) corners: Vec<f64>,
    /// What the explicit method knows from the spans before.
    pub(super) control: Control,
    /// The unknowns at the end of the last span, or where the integrator got stuck in it.
    pub(super) state: Vec<f64>,
}

/// What a step's dense output is.
#[derive(Debug, Clone, Copy)]
pub(in crate::methods) enum Polynomial {
    /// The polynomial of the solver's order through the ends of the last steps.
    History,
    /// The solver's own, of this degree, taken at points inside the step.
    Inner(usize),
}

impl Walk<'_> {
    /// Takes all steps of the current span. For the error of each the solver solves
    /// `error_solves` linear systems, which it does not count.
    pub(in crate::methods) fn steps<'p, 's: 'p, M, S>(
        &mut self,
        mut solver: S,
        polynomial: Polynomial,
        error_solves: usize,
    ) -> Result<(), Stop>
    where
        M: Algebra,
        S: OdeSolverMethod<'p, Equations<'s, M>>,
    {
        let (start, end) = self.span;
        let outcome = self.advance(&mut solver, start, end, polynomial);
        let work = solver.get_statistics();
        self.statistics.accepted += work.number_of_steps;
        self.statistics.rejected +=
            work.number_of_error_test_failures + work.number_of_nonlinear_solver_fails;
        self.statistics.factorizations += work.number_of_linear_solver_setups;
        let judged = work.number_of_steps + work.number_of_error_test_failures;
        self.statistics.linear_solves +=
            work.number_of_nonlinear_solver_iterations + error_solves * judged;
        outcome
    }

    fn advance<'p, 's: 'p, M, S>(
        &mut self,
        solver: &mut S,
        start: f64,
        end: f64,
        polynomial: Polynomial,
    ) -> Result<(), Stop>
    where
        M: Algebra,
        S: OdeSolverMethod<'p, Equations<'s, M>>,
    {
        solver.set_stop_time(end - start)?;
        let mut inner = M::V::zeros(self.system.len(), M::C::default());
        let mut before = 0.0;
        let mut done = Besides::default();
        loop {
            let reason = solver.step();
            done = self.count(solver.get_statistics(), done);
            let state = solver.state();
            let reached = matches!(reason, Ok(OdeSolverStopReason::TstopReached));
            let t = if reached { end - start } else { state.t };
            let site = Site {
                method: self.method,
                time: (start + t) * self.system.time_scale,
                system: self.system,
            };
            let failed = if let Err(error) = reason {
                Some(site.integrator(&error, state.y.slice(), state.dy.slice()))
            } else {
                site.finite(state.y.slice())?;
                (t <= before).then(|| site.too_small(state.y.slice(), state.dy.slice()))
            };
            if let Some(error) = failed {
                self.state.copy_from_slice(state.y.slice());
                return Err(Stop::Stuck { at: before, error });
            }
            let degree = match polynomial {
                Polynomial::History => solver.order(),
                Polynomial::Inner(_) if t - before <= ROUNDINGS * f64::EPSILON * t => 1,
                Polynomial::Inner(degree) => {
                    let nodes = Interpolation::of_degree(degree);
                    for &node in nodes.nodes().get(1..degree).unwrap_or_default() {
                        let time = between(before, state.t, node);
                        solver.interpolate_inplace(time, &mut inner)?;
                        self.pieces.add_row(self.system, time, inner.slice());
                    }
                    degree
                }
            };
            self.pieces.add_row(self.system, t, state.y.slice());
            self.pieces.end_step(self.system, degree);
            before = state.t;
            self.report(site.time)?;
            if reached {
                self.state.copy_from_slice(state.y.slice());
                return Ok(());
            }
        }
    }

    /// Counts what a step took besides itself; `before` is what had been counted.
    fn count(&self, work: &OdeSolverStatistics, before: Besides) -> Besides {
        let now = Besides {
            rejected: work.number_of_error_test_failures + work.number_of_nonlinear_solver_fails,
            factorizations: work.number_of_linear_solver_setups,
            solutions: work.number_of_nonlinear_solver_iterations,
        };
        let new = Besides {
            rejected: now.rejected - before.rejected,
            factorizations: now.factorizations - before.factorizations,
            solutions: now.solutions - before.solutions,
        };
        self.run.budget.charge_besides(new, self.system.len());
        now
    }

    /// Shows the last step to the observer and to the guards.
    pub(super) fn report(&mut self, time: f64) -> Result<(), Stop> {
        let steps = self.pieces.len();
        if self.observer.progress(Progress { time, steps }).is_break() {
            return Err(SolveError::Cancelled { time }.into());
        }
        if steps >= MOST_STEPS {
            return Err(SolveError::TooManySteps { method: self.method, time, steps }.into());
        }
        let further = self.pieces.panels(self.system).saturating_sub(1);
        let is_over = self.run.budget.charge_panels(further);
        if self.run.budget.charge_accepted(self.system.len()) || is_over {
            let work = self.run.budget.done();
            return Err(SolveError::BudgetSpent { method: self.method, time, work }.into());
        }
        self.further = self.further.saturating_add(further);
        let signal = self.further.saturating_mul(pieces::PANEL_BYTES);
        let bytes = signal.saturating_add(self.pieces.size_of_rows());
        if bytes > MOST_BYTES {
            return Err(SolveError::TooLarge { method: self.method, time, steps, bytes }.into());
        }
        if self.watch.is_idle() {
            return Ok(());
        }
        self.run.budget.charge_watched_step(self.run.guards.len());
        self.run.budget.charge_watched_panels(further.saturating_mul(self.run.guards.len()));
        let last = self.pieces.last_step();
        let mut signals = Vec::with_capacity(self.run.guards.len());
        let mut roundings = Vec::with_capacity(self.run.guards.len());
        for (guard, largest) in self.run.guards.iter().zip(&mut self.largest) {
            let output = self.system.outputs.at(guard.output);
            let mut signal = last.signal(self.system, output);
            // A small difference of large terms is known no better than they are, and what balances
            // determine no better than the absolute tolerance.
            let size =
                |unknown: usize| self.run.tolerance_scaling.get(unknown).copied().unwrap_or(1.0);
            let balanced = |unknown: usize| match self.system.unknowns[unknown].kind {
                UnknownKind::Algebraic => size(unknown),
                UnknownKind::Differential => 0.0,
            };
            let least = absolute(output, balanced);
            *largest = largest.max(terms(&signal)).max(least);
            let mut noise = self.run.rtol * *largest;
            if let Some(whole) = guard.rate_of.and_then(|rate_of| self.system.outputs.get(rate_of))
            {
                let own = terms(&last.signal(self.system, whole));
                let length = signal.panels.iter().map(|panel| panel.end - panel.start).sum::<f64>();
                noise = noise.min(self.run.rtol * (own + absolute(whole, size)) / length);
            }
            roundings.push(signal.noise);
            signal.noise = signal.noise.max(noise);
            signals.push(signal);
        }
        if self.watch.feed(&self.run.guards, &signals, &roundings).is_some() {
            Err(Stop::Guard)
        } else {
            Ok(())
        }
    }
}

/// The size of the terms of a signal, from that of their rounding.
fn terms(signal: &Signal) -> f64 {
    signal.noise / (pieces::ROUNDING * f64::EPSILON)
}

/// The most that an output is where the unknowns are of these sizes.
fn absolute(output: Output<'_>, size: impl Fn(usize) -> f64) -> f64 {
    let own = output.unknowns.terms().map(|(unknown, factor)| factor.abs() * size(unknown));
    output.scale.abs() * own.sum::<f64>()
}
