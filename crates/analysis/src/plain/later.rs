//! The curves of a run whose measures are known.

use std::sync::Arc;

use dashpot_dae::{
    Budget, Dense, Method, Outcome, Panel, Run, Signal, Silent, Statistics, Switch, System,
    Trajectory, methods, switching,
};
use dashpot_network::Assembly;

use crate::report::curves::{Curves, Struck};

/// What is `struck`, and the curves of a run to `t_end` \[s\], by the method of the measures at their tolerance, or by another one that gets
/// through. None are kept where there is none.
pub(super) fn curves(
    assembly: &Arc<Assembly>,
    (t_end, rtol, budget): (f64, f64, u64),
    struck: Struck,
    shell: impl Fn() -> Trajectory + Send + Sync + 'static,
) -> Curves {
    let assembly = Arc::clone(assembly);
    let maker = move || {
        let methods: [&dyn Method; 3] = [&methods::Dop853, &methods::Bdf, &methods::Esdirk34];
        let solved = |method: &dyn Method| {
            let phased = assembly.switching.as_deref()?;
            let run = Run { budget: Budget::of(budget), ..Run::to(t_end) }.with_rtol(rtol);
            switching::integrate(method, phased, &run, &mut Silent).ok()
        };
        methods.into_iter().find_map(solved).unwrap_or_else(&shell)
    };
    Curves::later(maker, Some(struck))
}

/// A trajectory that tells what has switched, and keeps nothing else.
pub(super) fn shell(
    method: &'static str,
    t_end: f64,
    (first_phases, switches): (Vec<(usize, f64)>, Vec<Switch>),
    statistics: Statistics,
) -> Trajectory {
    Trajectory {
        method,
        outcome: Outcome::Finished,
        t_end,
        events: Vec::new(),
        first_phases,
        switches,
        statistics,
        dense: Box::new(Nothing { t_end }),
    }
}

/// No curve at all.
#[derive(Debug)]
struct Nothing {
    t_end: f64,
}

impl Dense for Nothing {
    fn signal(&self, _system: &System, _output: usize) -> Signal {
        Signal::new(vec![Panel::constant(0.0, self.t_end, f64::NAN)], None, f64::NAN)
    }

    fn sample(&self, _system: &System, _times: &[f64]) -> Vec<f64> {
        Vec::new()
    }

    fn keeps(&self, _system: &System, _output: usize) -> bool {
        false
    }
}
