//! One solution of a case, and the claims that it is held against.

use std::cell::RefCell;

use dashpot::{
    analysis::{MeasureReport, RunReport, Solution},
    dae::{Signal, Switch},
    network::parameters::WindowWish,
};

/// Errors of stepping methods in parts of their tolerance and of the largest value, where the report
/// states none; ten times more for a method of second order.
const ERRORS_PER_TOLERANCE: f64 = 1e3;
/// Roundings that a closed form, a sum of times and the reading of a number may have, in units of
/// the size of what is compared.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// A solution of a case.
pub(super) struct Trial<'a> {
    pub(super) report: &'a RunReport,
    pub(super) solution: Solution<'a>,
    pub(super) checks: RefCell<Vec<Check>>,
    /// The accuracy wanted of all measures.
    wish: f64,
}

/// One claim, held against what was found.
#[derive(Debug, Clone)]
pub(super) struct Check {
    pub(super) what: String,
    /// Size to which errors refer.
    pub(super) scale: f64,
    /// How far what was found is from what is claimed, beyond what the claim itself leaves open.
    pub(super) error: f64,
    /// What the claim itself leaves open.
    pub(super) open: f64,
    /// What the report, or the method's tolerance, says of that; `None` where nothing is said.
    pub(super) bar: Option<f64>,
    /// How large the error may be.
    pub(super) allowed: f64,
    /// Whether the report says that the accuracy wanted is not reached.
    pub(super) is_warned: bool,
}

impl<'a> Trial<'a> {
    pub(super) fn new(report: &'a RunReport, wish: f64) -> Self {
        Self { report, solution: report.solution(), checks: RefCell::default(), wish }
    }

    pub(super) fn is_exact(&self) -> bool {
        self.report.solver.rtol.is_none()
    }

    pub(super) fn end(&self) -> f64 {
        self.report.trajectory.t_end
    }

    fn add(&self, check: Check) {
        self.checks.borrow_mut().push(check);
    }

    /// A measure of the report, that over the whole run if there are several.
    pub(super) fn measure(&self, key: &str, truth: f64) {
        self.measure_known(key, truth, 0.0);
    }

    /// A measure whose true value is known to `threshold` only: a limit that is not quite reached, a printed
    /// number of few digits, a time that is rounded.
    pub(super) fn measure_known(&self, key: &str, truth: f64, threshold: f64) {
        let wanted = key.split_once('.').and_then(|(target, kind)| {
            let is_whole = |measure_report: &&MeasureReport| {
                measure_report.window_wish == Some(WindowWish::Run)
            };
            let alike = self.report.measures.iter().filter(is_whole);
            alike.clone().find(|own| own.target == target && own.kind == kind)
        });
        let Some(own) = wanted.or_else(|| self.report.measure(key)) else {
            let known: Vec<&str> =
                self.report.measures.iter().map(|measure| &*measure.key).collect();
            panic!("no {key} in {known:?}")
        };
        let scale = own.size.abs().max(truth.abs());
        let names_it = |warning: String| {
            warning.contains(&format!("`{}`", own.key)) || warning.contains("energy does not close")
        };
        let is_warned = own.excess > 1.0
            || own.error.is_some_and(f64::is_infinite)
            || own.is_undetermined
            || self.report.warnings.iter().map(ToString::to_string).any(names_it);
        let error = own.value.map_or(f64::INFINITY, |value| (value - truth).abs());
        // Not a number stays none.
        let error = if error <= threshold { 0.0 } else { error - threshold };
        let wanted = if self.is_exact() { 0.0 } else { self.wish * scale };
        let allowed = own.error.unwrap_or(0.0).max(wanted) + ROUNDINGS * scale;
        let what =
            format!("{key} = {:?}, not {truth:e}; {}", own.value, own.note().unwrap_or_default());
        self.add(Check { what, scale, error, open: threshold, bar: own.error, allowed, is_warned });
    }

    /// Place and speed of a node at the end.
    pub(super) fn ends(&self, node: &str, position: f64, velocity: f64) {
        self.measure(&format!("{node}.end-position"), position);
        self.measure(&format!("{node}.end-velocity"), velocity);
    }

    pub(super) fn signal(&self, output: &str) -> &Signal {
        let at = self.report.assembly.output(output);
        self.solution.signal(at.unwrap_or_else(|| panic!("no output {output}")))
    }

    /// The value of an output at a time.
    pub(super) fn output(&self, output: &str, time: f64, truth: f64) {
        let signal = self.signal(output);
        let found = signal.value(time);
        self.number(&format!("{output} at {time:e}"), found, truth, signal.bound(), signal.error);
    }

    /// The last value of an output.
    pub(super) fn last(&self, output: &str, truth: f64) {
        self.output(output, self.end(), truth);
    }

    /// A number of the size `scale`, of which an error may be stated.
    pub(super) fn number(
        &self,
        what: &str,
        found: f64,
        truth: f64,
        scale: f64,
        stated: Option<f64>,
    ) {
        let scale = scale.max(truth.abs());
        let bar = match self.report.solver.rtol {
            None => stated,
            Some(rtol) => {
                let order = if self.report.solver.method == "tr-bdf2" { 10.0 } else { 1.0 };
                Some(order * ERRORS_PER_TOLERANCE * rtol * scale)
            }
        };
        let wanted = if self.is_exact() { 0.0 } else { self.wish * scale };
        self.add(Check {
            what: format!("{what}: {found:e}, not {truth:e}"),
            scale,
            error: (found - truth).abs(),
            open: 0.0,
            bar,
            allowed: bar.unwrap_or(0.0).max(wanted) + ROUNDINGS * scale,
            is_warned: false,
        });
    }

    /// What is true or not.
    pub(super) fn holds(&self, what: impl Into<String>, is_true: bool) {
        let error = if is_true { 0.0 } else { f64::INFINITY };
        self.add(Check {
            what: what.into(),
            scale: 1.0,
            error,
            open: 0.0,
            bar: Some(0.0),
            allowed: 0.0,
            is_warned: false,
        });
    }

    /// The switchings of a part, or of something in it.
    fn switches<'t>(&'t self, part: &'t str) -> impl Iterator<Item = &'t Switch> {
        let belongs = move |switch: &&Switch| {
            switch
                .name
                .strip_prefix(part)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
        };
        self.report.trajectory.switches.iter().filter(belongs)
    }

    /// How often a part goes into a phase.
    pub(super) fn switched(&self, part: &str, phase: &str) -> usize {
        self.switches(part).filter(|switch| switch.what == phase).count()
    }

    /// The impacts of a part.
    pub(super) fn impacts(&self, part: &str) -> usize {
        self.switches(part).filter(|switch| switch.impulse > 0.0).count()
    }

    /// The times at which a part goes into a phase.
    pub(super) fn times(&self, part: &str, phase: &str) -> Vec<f64> {
        self.switches(part)
            .filter(|switch| switch.what == phase)
            .map(|switch| switch.time)
            .collect()
    }

    /// That the energy at the end is that of the start, within what the ledger states.
    pub(super) fn energy_closes(&self) {
        let energy = &self.report.energy;
        let scale = energy.turned_over;
        self.number("energy that is missing", energy.missing(), 0.0, scale, energy.error);
    }
}
