//! One case solved by one method, and what it is judged by.
//!
//! `exact` must stay within the error that it states and, besides, within 1e-12 of the largest value
//! of the quantity. Of a method with a tolerance `rtol` the true error is 100 to 700 `rtol` of the
//! largest value, and ten times that for one of second order, which takes so many more steps: its
//! quantities must stay within 1000, or 10 000. An instant at which a quantity passes a level is known
//! as well as the quantity, divided by its slope there, and as the time that has passed.

use std::cell::RefCell;

use dashpot::{
    analysis::{RunReport, Solution, Solve},
    dae::Signal,
    scene::{ReadOptions, Scene, read},
};

use super::reference::Case;

/// The methods that solve what is linear between switchings.
pub(super) const ALL: &[&str] = &["exact", "bdf", "esdirk34", "tr-bdf2"];
/// The methods that solve what is not.
pub(super) const STEPPING: &[&str] = &["bdf", "esdirk34", "tr-bdf2"];

/// Part of the largest value within which `exact` must be.
const EXACT: f64 = 1e-12;
/// Errors of stepping methods in parts of their tolerance.
const ERRORS_PER_TOLERANCE: f64 = 1e3;
/// Relative error of a number that is read, or is a sum of times.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A case solved by one method.
pub(super) struct Trial<'a> {
    pub(super) case: &'a Case,
    pub(super) report: &'a RunReport,
    pub(super) solution: Solution<'a>,
    pub(super) faults: RefCell<Vec<String>>,
}

/// The side of an instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Before,
    After,
}

pub(super) fn scene(text: &str) -> Scene {
    read(text, &ReadOptions::default()).unwrap_or_else(|faults| panic!("{text}\n{faults}")).value
}

pub(super) fn run(text: &str, method: &str) -> RunReport {
    let scene = scene(text);
    let report = scene.network.solve_with(&scene.settings(method).unwrap());
    report.unwrap_or_else(|error| panic!("{method}: {error}\n{text}"))
}

/// Solves the case by each method, and judges each solution, its ledger, and its measures against
/// those of the first method.
pub(super) fn judge(case: &Case, methods: &[&str], text: &str, claims: impl Fn(&Trial<'_>)) {
    let text = case.fill(text);
    let mut first: Option<RunReport> = None;
    let mut faults = Vec::new();
    for method in methods {
        let report = run(&text, method);
        let trial = Trial {
            case,
            report: &report,
            solution: report.solution(),
            faults: RefCell::default(),
        };
        claims(&trial);
        trial.energy_closes();
        if let Some(first) = &first {
            trial.agrees_with(first);
        }
        let found = trial.faults.take();
        faults.extend(found.into_iter().map(|fault| format!("{} by {method}: {fault}", case.name)));
        drop(trial);
        first.get_or_insert(report);
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

impl Trial<'_> {
    pub(super) fn is_exact(&self) -> bool {
        self.report.solver.rtol.is_none()
    }

    pub(super) fn end(&self) -> f64 {
        self.report.trajectory.t_end
    }

    pub(super) fn signal(&self, output: &str) -> &Signal {
        let at = self.report.assembly.output(output);
        self.solution.signal(at.unwrap_or_else(|| {
            let outputs = &self.report.assembly.system.outputs;
            let known: Vec<_> = outputs.iter().map(|output| output.name.to_string()).collect();
            panic!("no {output} in {known:?}")
        }))
    }

    /// The error of a quantity that is as large as `scale` and of which the run states an error.
    pub(super) fn error(&self, stated: Option<f64>, scale: f64) -> f64 {
        match self.report.solver.rtol {
            None => stated.expect("`exact` states its error").min(EXACT * scale),
            Some(rtol) => self.errors_per_tolerance() * rtol * scale,
        }
    }

    fn errors_per_tolerance(&self) -> f64 {
        let is_second_order = self.report.solver.method == "tr-bdf2";
        if is_second_order { 10.0 * ERRORS_PER_TOLERANCE } else { ERRORS_PER_TOLERANCE }
    }

    pub(super) fn within(&self, what: &str, found: f64, expected: f64, allowed: f64) {
        let error = (found - expected).abs();
        let allowed = allowed + ROUNDING * expected.abs();
        if error.is_nan() || error > allowed {
            self.faults.borrow_mut().push(format!(
                "{what} is {found:.17e}, not {expected:.17e}: {error:.1e} > {allowed:.1e}"
            ));
        }
    }

    /// Energy is conserved: to 1e-12 by `exact`, within its errors by the others.
    fn energy_closes(&self) {
        let energy = &self.report.energy;
        let allowed = match self.report.solver.rtol {
            None => EXACT,
            // Many short steps add up their roundings.
            Some(rtol) => self.errors_per_tolerance() * rtol.max(1e-10),
        };
        let closure = energy.closure().abs();
        if closure.is_nan() || closure > allowed {
            let fault = format!("the energy is off by {closure:.1e}: {energy:?}");
            self.faults.borrow_mut().push(fault);
        }
    }

    /// The measures of two methods agree within their errors.
    fn agrees_with(&self, other: &RunReport) {
        for one in &other.measures {
            let two = self.report.measure(&one.key).expect("the same measures");
            let (Some(a), Some(b)) = (one.value, two.value) else {
                if one.value.is_some() != two.value.is_some() {
                    self.faults.borrow_mut().push(format!("{one:?}\n{two:?}"));
                }
                continue;
            };
            let Some((first, second)) = one.error.zip(two.error) else {
                self.faults.borrow_mut().push(format!("no error: {one:?}\n{two:?}"));
                continue;
            };
            // Bars are made to hold in 99 of 100 scenes, and those of the release of a force y^3.5 do
            // not meet.
            let is_flat = one.kind == "contact-time" && self.case.find("param.p") > Some(3.0);
            let bar = (first + second) * if is_flat { 4.0 } else { 2.0 };
            let gap = (a - b).abs();
            if gap > bar + ROUNDING * a.abs() {
                let fault = format!(
                    "{} is {b:e}, and {a:e} by {}: {gap:.1e} > {bar:.1e}",
                    one.key, other.solver.method
                );
                self.faults.borrow_mut().push(fault);
            }
        }
    }

    /// Something else of the case that is told by `exact` alone.
    pub(super) fn if_exact(&self, claim: impl FnOnce()) {
        if self.is_exact() {
            claim();
        }
    }
}
