//! A whole run as a sequence of smooth spans.

use std::time::Instant;

use diffsol::{DefaultDenseMatrix, FaerSparseMat, NalgebraMat, VectorRef, matrix::MatrixRef};

use super::{
    Algebra, Integrator, Scheme, Stop, Walk,
    algebra::DENSE_UP_TO,
    balance::Balance,
    explicit::{Control, is_stiff},
    failure::Site,
    stack::{ROWS, StackMatrix},
    start,
};
use crate::{
    Observer, Outcome, Run, SolveError, Statistics, System, Trajectory, events::Watch,
    methods::check, pieces::Pieces,
};

/// Most spans that a driving function's own time makes of a run.
const MOST_SPANS: f64 = 2e5;
/// Times in a run that an integrator which is stuck is started anew.
const MOST_RESTARTS: usize = 100;
/// Steps for which room is set aside; more are no harm.
const USUAL_STEPS: usize = 160;

/// Integrates `system` by one of the step-by-step methods.
pub(in crate::methods) fn integrate<S: Scheme>(
    system: &System,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Trajectory, SolveError> {
    integrate_in::<S>(World::of(system), system, run, observer)
}

/// The matrices to work with.
#[derive(Debug, Clone, Copy, PartialEq)]
enum World {
    Stack,
    Dense,
    Sparse,
}

impl World {
    fn of(system: &System) -> Self {
        if system.len() <= ROWS {
            Self::Stack
        } else if system.len() <= DENSE_UP_TO {
            Self::Dense
        } else {
            Self::Sparse
        }
    }
}

fn integrate_in<S: Scheme>(
    world: World,
    system: &System,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Trajectory, SolveError> {
    let begin = Instant::now();
    admit::<S>(system, run)?;
    let site = Site { method: S::KIND, time: 0.0, system };
    let mut walk = Walk {
        method: S::KIND,
        system,
        run,
        observer,
        watch: Watch::new(&run.guards),
        largest: vec![0.0; run.guards.len()],
        pieces: Pieces::new(system, run),
        further: 0,
        statistics: Statistics::default(),
        span: (0.0, 0.0),
        corners: system.breakpoints(run.t_end / system.time_scale),
        control: Control::default(),
        state: system.initial.clone(),
    };
    let ended = if system.is_empty() || run.t_end == 0.0 {
        walk.still()
    } else {
        if world != World::Sparse {
            walk.pieces.reserve(USUAL_STEPS);
        }
        match world {
            World::Stack => walk.spans::<S, StackMatrix>(),
            World::Dense => walk.spans::<S, NalgebraMat<f64>>(),
            World::Sparse => walk.spans::<S, FaerSparseMat<f64>>(),
        }
    };
    let (outcome, t_end) = match ended {
        Ok(()) => (Outcome::Finished, run.t_end),
        Err(Stop::Guard) => {
            let stop = walk.watch.stop();
            let (guard, time) = stop.map_or((0, run.t_end), |stop| (stop.guard, stop.time));
            (Outcome::Stopped { guard }, time)
        }
        Err(Stop::Integrator(error)) => {
            let time = walk.span.0 * system.time_scale;
            let slopes = vec![0.0; system.len()];
            return Err(Site { time, ..site }.integrator(&error, &walk.state, &slopes));
        }
        Err(Stop::Failed(error) | Stop::Stuck { error, .. }) => return Err(error),
    };
    walk.pieces.finish(system, t_end);
    walk.statistics.wall = begin.elapsed();
    Ok(Trajectory {
        method: S::KIND,
        outcome,
        t_end,
        events: walk.watch.into_events(),
        first_phases: Vec::new(),
        switches: Vec::new(),
        statistics: walk.statistics,
        dense: Box::new(walk.pieces),
    })
}

/// Turns down what cannot be solved, before anything is built.
fn admit<S: Scheme>(system: &System, run: &Run) -> Result<(), SolveError> {
    check(system, run)?;
    if !(1e-13..=1e-1).contains(&run.rtol) {
        let range = "from 1e-13 to 1e-1";
        return Err(SolveError::InvalidSetting { setting: "rtol", range, value: run.rtol });
    }
    for matrix in [&system.jacobian, &system.input_matrix] {
        if let Some((row, ..)) = matrix.triplet_iter().find(|entry| !entry.2.is_finite()) {
            let unknown = system.unknowns[row].name.clone();
            return Err(SolveError::NotFinite { method: S::KIND, time: 0.0, unknown });
        }
    }
    let site = Site { method: S::KIND, time: 0.0, system };
    site.finite(&system.initial)?;
    site.structure()
}

impl Walk<'_> {
    /// The borders of the spans of a method that estimates its first step from this order, dimensionless.
    ///
    /// A one-step method other than `dop853` judges its steps by the differential unknowns. What follows a driving
    /// function through a law that is not linear may need shorter ones than these, so that the spans
    /// of such a method are parts of the function's own time, the shorter the tighter the tolerance.
    fn borders(&self, order: usize) -> Vec<f64> {
        let end = self.run.t_end / self.system.time_scale;
        let mut borders = vec![0.0];
        borders.extend_from_slice(&self.corners);
        borders.push(end);
        if order < 2 || self.system.is_linear() {
            return borders;
        }
        let parts = 8.0 * self.run.rtol.powf(-1.0 / (order as f64 + 1.0));
        let mut fine = vec![0.0];
        for span in borders.windows(2) {
            let own = self.system.own_time((span[0], span[1])).unwrap_or(f64::INFINITY);
            let longest = (own / parts).max(end / MOST_SPANS);
            let count = ((span[1] - span[0]) / longest).ceil().max(1.0);
            let mut at = 1.0;
            while at < count {
                fine.push(span[0] + (span[1] - span[0]) * at / count);
                at += 1.0;
            }
            fine.push(span[1]);
        }
        fine
    }

    /// A run in which no unknown moves: there is none, or no time. Where a guard may end it, it is looked at in parts
    /// that grow, so that what switches in each period of a long motion does not look at all of it each time.
    fn still(&mut self) -> Result<(), Stop> {
        let borders = self.borders(1);
        for span in borders.windows(2) {
            self.span = (span[0], span[1]);
            let first = self.system.own_time(self.span).filter(|_| !self.watch.is_idle());
            self.pieces.begin(self.system, span[0], &self.state);
            let (mut at, mut part) = (span[0], first.unwrap_or(f64::INFINITY));
            loop {
                // A part that a rounding swallows would not end.
                at = if at + part > at { (at + part).min(span[1]) } else { span[1] };
                part *= 2.0;
                self.pieces.rest(self.system, at - span[0]);
                self.report(at * self.system.time_scale)?;
                if at >= span[1] {
                    break;
                }
            }
        }
        Ok(())
    }

    /// Integrates the current span.
    fn span<S, M>(
        &mut self,
        integrator: Integrator,
        problem: &mut start::Problem<'_, M>,
        balance: &mut Option<Balance<M>>,
    ) -> Result<(), Stop>
    where
        S: Scheme,
        M: Algebra,
        M::V: DefaultDenseMatrix<T = f64, C = M::C>,
        for<'v> &'v M::V: VectorRef<M::V>,
        for<'m> &'m M: MatrixRef<M>,
    {
        let (start, length) = (self.span.0, self.span.1 - self.span.0);
        let time = start * self.system.time_scale;
        let site = Site { method: S::KIND, time, system: self.system };
        let order = integrator.order().unwrap_or(S::ORDER);
        let entered =
            start::enter(problem, balance.as_mut(), (start, length), order, &mut self.state);
        let state = entered.map_err(|failure| site.imbalance(failure, &self.state))?;
        if balance.is_some() && self.state.iter().any(|value| !value.is_finite()) {
            return Err(site.singular(&self.state).into());
        }
        self.pieces.begin(self.system, start, &self.state);
        integrator.span(problem, state, self)
    }

    /// What integrates the current span: an explicit method leaves it to an implicit one where that is stiff.
    fn integrator<S: Scheme>(&self) -> Integrator {
        let left = self.run.t_end / self.system.time_scale - self.span.0;
        match S::INTEGRATOR {
            Integrator::Dop853 if is_stiff(self.system, &self.state, (self.span.0, left)) => {
                Integrator::Bdf
            }
            own => own,
        }
    }

    /// Integrates all spans in one world of matrices.
    ///
    /// At the kink of a law, Newton's iteration may end too early: the algebraic unknowns are then off by
    /// more than the tolerance, and no step from there, however small, is within it. Where the integrator
    /// gets stuck in this way after some steps it begins anew, at values that satisfy the balances. Where an
    /// explicit one does not come on, because the equations are stiff there, an implicit one goes on.
    fn spans<S, M>(&mut self) -> Result<(), Stop>
    where
        S: Scheme,
        M: Algebra,
        M::V: DefaultDenseMatrix<T = f64, C = M::C>,
        for<'v> &'v M::V: VectorRef<M::V>,
        for<'m> &'m M: MatrixRef<M>,
    {
        let mut problem = start::problem::<M>(self.system, self.run)?;
        let mut balance = Balance::<M>::new(self.system)?;
        let mut outcome = Ok(());
        let mut restarts = 0;
        let end = self.run.t_end / self.system.time_scale;
        let is_explicit = matches!(S::INTEGRATOR, Integrator::Dop853);
        // The steps of dop853 are judged by the algebraic unknowns as well.
        let borders = self.borders(if is_explicit { 1 } else { S::ORDER });
        let breaks = if is_explicit { self.system.breaks(end) } else { Vec::new() };
        let mut integrator = self.integrator::<S>();
        let (mut at, mut is_stuck) = (0.0, false);
        while at < end {
            self.span.0 = at;
            // The explicit method looks at the stiffness by itself as long as it makes progress.
            if !(is_stuck || matches!(integrator, Integrator::Dop853)) {
                integrator = self.integrator::<S>();
            }
            let list = if matches!(integrator, Integrator::Dop853) { &breaks } else { &borders };
            let next = list.partition_point(|&border| border <= at);
            self.span.1 = list.get(next).copied().unwrap_or(end);
            outcome = self.span::<S, M>(integrator, &mut problem, &mut balance);
            is_stuck = matches!(outcome, Err(Stop::Stuck { .. }));
            if outcome.is_ok() {
                at = self.span.1;
                continue;
            }
            let Err(Stop::Stuck { at: reached, .. }) = &outcome else { break };
            if matches!(integrator, Integrator::Dop853) {
                integrator = Integrator::Bdf;
            } else if balance.is_some() && *reached > 0.0 && restarts < MOST_RESTARTS {
                restarts += 1;
            } else {
                break;
            }
            if self.span.0 + reached >= self.span.1 {
                break;
            }
            at = self.span.0 + reached;
        }
        let (factorizations, solves) = balance.as_ref().map_or((0, 0), Balance::work);
        self.statistics.factorizations += factorizations;
        self.statistics.linear_solves += solves;
        let (calls, jacobians) = problem.eqn.counts();
        self.statistics.rhs_calls += calls;
        self.statistics.jacobian_calls += jacobians;
        outcome
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Silent,
        methods::{Bdf, Esdirk34, Method, TrBdf2, Tsit45},
        tests::problems,
    };

    fn difference<S: Scheme>(problem: &problems::Problem) -> f64 {
        let system = &problem.system;
        let run = Run::to(problem.t_end).with_rtol(1e-7);
        let end = problem.t_end / system.time_scale;
        let times: Vec<f64> = (0..=100).map(|k| f64::from(k) / 100.0 * end).collect();
        let sample = |world| {
            let trajectory = integrate_in::<S>(world, system, &run, &mut Silent).unwrap();
            trajectory.dense.sample(system, &times)
        };
        let dense = sample(World::Dense);
        let mut others = vec![sample(World::Sparse)];
        if system.len() <= ROWS {
            others.push(sample(World::Stack));
        }
        let differences = others.iter().flatten().zip(dense.iter().cycle());
        differences.map(|(other, dense)| (other - dense).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn all_matrices_give_one_result() {
        for problem in problems::all().into_iter().chain([problems::short_chain()]) {
            let mut found = vec![
                difference::<Bdf>(&problem),
                difference::<TrBdf2>(&problem),
                difference::<Esdirk34>(&problem),
            ];
            let run = Run::to(problem.t_end);
            if !problem.stiff && Tsit45.applies(&problem.system, &run).is_ok() {
                found.push(difference::<Tsit45>(&problem));
            }
            // Steps may be chosen differently by a rounding; the tolerance is 1e-7.
            for difference in found {
                assert!(difference < 1e-9, "{}: {difference:e}", problem.name);
            }
        }
    }
}
