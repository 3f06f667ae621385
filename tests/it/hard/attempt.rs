//! A case by one method: in a thread of its own, with a limit of steps and of time.

use std::{
    ops::ControlFlow,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{Arc, mpsc},
    thread,
    time::Duration,
};

use dashpot::{
    analysis::Solve,
    dae::{Observer, Progress},
};

use super::{case::Case, outcome::Outcome, trial::Trial};

/// A run that takes longer than this has hung, on whatever machine.
const PATIENCE: Duration = Duration::from_secs(180);

/// A method's outcome, and the method that solved.
pub(super) struct Attempt {
    pub(super) outcome: Outcome,
    /// The one that `auto` chose, or the method itself.
    pub(super) by: &'static str,
}

/// Ends a run after so many steps, those of all its solutions together.
struct Limit {
    steps: usize,
    most: usize,
}

impl Observer for Limit {
    fn progress(&mut self, _progress: Progress) -> ControlFlow<()> {
        self.steps += 1;
        if self.steps > self.most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Solves the case by the method, whatever may happen.
pub(super) fn attempt(case: &Arc<Case>, method: &'static str) -> Attempt {
    let (send, receive) = mpsc::channel();
    let own = Arc::clone(case);
    thread::spawn(move || {
        let caught = catch_unwind(AssertUnwindSafe(|| solved(&own, method)));
        let attempt = caught.unwrap_or_else(|panic| {
            let words = panic.downcast_ref::<String>().cloned();
            let words = words.or_else(|| panic.downcast_ref::<&str>().map(|own| (*own).to_owned()));
            Attempt { outcome: Outcome::Panic(words.unwrap_or_default()), by: method }
        });
        // Nobody listens after the limit of time.
        let _ = send.send(attempt);
    });
    receive.recv_timeout(PATIENCE).unwrap_or(Attempt { outcome: Outcome::Hang, by: method })
}

#[expect(clippy::print_stdout, reason = "one case alone is shown where it is asked for")]
fn solved(case: &Case, method: &'static str) -> Attempt {
    let (network, settings) = match case.network(method) {
        Ok(own) => own,
        Err(words) => return Attempt { outcome: Outcome::Refused(words), by: method },
    };
    let mut limit = Limit { steps: 0, most: case.most_steps };
    let report = match network.solve_watched(&settings, &mut limit) {
        Ok(report) => report,
        Err(error) => {
            return Attempt { outcome: Outcome::of_error(&error, case.most_steps), by: method };
        }
    };
    let trial = Trial::new(&report, settings.accuracy.default);
    (case.claims)(&trial);
    let checks = trial.checks.take();
    if std::env::var_os("HARD_CASE").is_some() {
        println!("{} by {method} ({} steps in all):", case.name, limit.steps);
        for check in &checks {
            let (error, bar, allowed) = (check.error, check.bar, check.allowed);
            println!("  {}: {error:.1e}, stated {bar:?}, allowed {allowed:.1e}", check.what);
        }
        println!("  {:?}", report.warnings);
    }
    assert!(!checks.is_empty(), "nothing is claimed");
    Attempt { outcome: Outcome::of_checks(&checks), by: report.solver.method }
}
