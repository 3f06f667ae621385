//! One case solved by one method, and what it is judged by.
//!
//! `exact` must stay within the error that it states and, besides, within 1e-10 of the largest value
//! of the quantity. Of a method with a tolerance `rtol` the true error is 100 to 700 `rtol` of the
//! largest value, and ten times that for one of second order, which takes so many more steps: its
//! quantities must stay within 1000, or 10 000. An instant at which a quantity passes a level is known
//! as well as the quantity, divided by its slope there, and as the time that has passed.

use std::cell::{Cell, RefCell};

use dashpot::{
    analysis::{RunReport, Solution, ledger::ledger, solve},
    dae::{Signal, Silent, Switch},
    scene::{ReadOptions, Scene, read},
};

use super::reference::Case;

/// The methods that solve what is linear between switchings.
pub(super) const ALL: &[&str] = &["exact", "bdf", "esdirk34", "tr-bdf2"];
/// The methods that solve what is not.
pub(super) const STEPPING: &[&str] = &["bdf", "esdirk34", "tr-bdf2"];

/// Part of the largest value within which `exact` must be.
const EXACT: f64 = 1e-10;
/// Errors of stepping methods in parts of their tolerance.
const ERRORS_PER_TOLERANCE: f64 = 1e3;
/// Relative error of a number that is read, or is a sum of times.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// A case solved by one method.
pub(super) struct Trial<'a> {
    pub(super) case: &'a Case,
    pub(super) report: &'a RunReport,
    pub(super) solution: Solution<'a>,
    /// The largest error in parts of what is allowed.
    worst: Cell<f64>,
    faults: RefCell<Vec<String>>,
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
    let report = solve(&scene.network, &scene.settings(method), &mut Silent);
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
            worst: Cell::new(0.0),
            faults: RefCell::default(),
        };
        claims(&trial);
        trial.energy_closes();
        if let Some(first) = &first {
            trial.agrees_with(first);
        }
        println!("{} by {method}: {:.1e} of what is allowed", case.name, trial.worst.get());
        let found = trial.faults.take();
        faults.extend(found.into_iter().map(|fault| format!("{} by {method}: {fault}", case.name)));
        drop(trial);
        first.get_or_insert(report);
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

impl Trial<'_> {
    fn is_exact(&self) -> bool {
        self.report.solver.rtol.is_none()
    }

    pub(super) fn end(&self) -> f64 {
        self.report.trajectory.t_end
    }

    pub(super) fn signal(&self, output: &str) -> &Signal {
        let at = self.report.assembly.output(output);
        self.solution.signal(at.unwrap_or_else(|| {
            let outputs = &self.report.assembly.system.outputs;
            let known: Vec<&str> = outputs.iter().map(|own| own.name.as_str()).collect();
            panic!("no {output} in {known:?}")
        }))
    }

    /// The error of a quantity that is as large as `scale` and of which the run states an error.
    fn error(&self, stated: Option<f64>, scale: f64) -> f64 {
        match self.report.solver.rtol {
            None => stated.expect("`exact` states its error").min(EXACT * scale),
            Some(rtol) => self.errors_per_tolerance() * rtol * scale,
        }
    }

    fn errors_per_tolerance(&self) -> f64 {
        let is_second_order = self.report.solver.method == "tr-bdf2";
        if is_second_order { 10.0 * ERRORS_PER_TOLERANCE } else { ERRORS_PER_TOLERANCE }
    }

    fn within(&self, what: &str, found: f64, expected: f64, allowed: f64) {
        let error = (found - expected).abs();
        let allowed = allowed + ROUNDING * expected.abs();
        self.worst.set(self.worst.get().max(error / allowed));
        if error.is_nan() || error > allowed {
            self.faults.borrow_mut().push(format!(
                "{what} is {found:.17e}, not {expected:.17e}: {error:.1e} > {allowed:.1e}"
            ));
        }
    }

    /// All switchings of a part, into the phase `what` if that is given.
    pub(super) fn switches(&self, part: &str, what: Option<&str>) -> Vec<&Switch> {
        let switches = self.report.trajectory.switches.iter();
        switches
            .filter(|own| belongs_to(&own.name, part))
            .filter(|own| what.is_none_or(|what| own.what == what))
            .collect()
    }

    pub(super) fn count(&self, part: &str, what: &str, expected: usize) {
        let found = self.switches(part, Some(what)).len();
        if found != expected {
            let fault = format!("{part} is {what} {found} times, not {expected}");
            self.faults.borrow_mut().push(fault);
        }
    }

    /// How well the instant of a switching is known: an error of what is watched, over its slope.
    fn time_error(&self, own: &Switch) -> f64 {
        let primitives = &self.report.assembly.primitives;
        let Some(part) = primitives.iter().find(|part| part.name == own.name) else { return 0.0 };
        let watched = match own.what {
            "open" | "sliding forward" | "sliding backward" => part.force,
            "stuck" => part.rate.unwrap_or(part.deformation),
            _ => part.deformation,
        };
        let signal = self.solution.signal(watched);
        // A gap is a small difference of the ways of its sides.
        let way = if watched == part.deformation { self.longest_way() } else { 0.0 };
        let error = self.error(signal.error, signal.bound().max(way));
        let late = if self.is_exact() { 0.0 } else { self.error(None, own.time) };
        late + within(signal, own.time, error)
    }

    fn longest_way(&self) -> f64 {
        let places = self.report.assembly.nodes.iter().map(|node| node.position);
        places.map(|place| self.solution.signal(place).bound()).fold(0.0, f64::max)
    }

    /// By how much all is shifted in time at `time`: by the errors of the switchings until then.
    fn shift(&self, time: f64) -> f64 {
        let switches = self.report.trajectory.switches.iter();
        let until = switches.filter(|own| own.time > 0.0 && own.time <= time);
        until.map(|own| self.time_error(own)).sum()
    }

    /// The time of the switching number `nth` (from 1) of a part into a phase, held against the case.
    pub(super) fn switch(&self, [part, what]: [&str; 2], nth: usize, quantity: &str) -> f64 {
        let switches = self.switches(part, Some(what));
        let Some(own) = switches.get(nth - 1) else {
            let count = switches.len();
            let method = self.report.solver.method;
            panic!("{} by {method}: {part} is {what} {count} times only", self.case.name)
        };
        self.instant(own, quantity)
    }

    /// The time of a switching, held against the case.
    pub(super) fn instant(&self, own: &Switch, quantity: &str) -> f64 {
        self.late_instant(own, quantity, 0.0)
    }

    /// The same of one that may be `late` \[s\] for a reason of its own.
    pub(super) fn late_instant(&self, own: &Switch, quantity: &str, late: f64) -> f64 {
        let name = format!("time of {} {} ({quantity})", own.name, own.what);
        self.within(&name, own.time, self.case.get(quantity), late + self.shift(own.time));
        own.time
    }

    /// The time at which a series of ever shorter flights ends, of which a run leaves out those that
    /// cannot be told from rest: at most as long as the last two together.
    pub(super) fn rests(&self, own: &Switch, quantity: &str) {
        let impacts = self.impacts(&own.name);
        let times: Vec<f64> =
            impacts.iter().map(|own| own.time).filter(|time| *time < own.time).collect();
        let [.., before, last] = times[..] else { panic!("{times:?}") };
        let (first, second) = (last - before, own.time - last);
        // The flights are a geometric series.
        let left = second * second / (first - second);
        let slack = 0.02 * left;
        self.late_instant(&Switch { time: own.time + left, ..own.clone() }, quantity, slack);
        if self.is_exact() {
            assert!(left < 1e-6 * own.time, "{left:e} s are left out");
        }
    }

    /// The error of a method of a quantity as large as `scale`.
    pub(super) fn part_of(&self, scale: f64) -> f64 {
        self.error(Some(f64::INFINITY), scale)
    }

    /// The impacts of a part.
    pub(super) fn impacts(&self, part: &str) -> Vec<&Switch> {
        self.switches(part, None).into_iter().filter(|own| own.impulse > 0.0).collect()
    }

    /// The time of the impact number `nth` (from 1) of a part, held against the case.
    pub(super) fn touch(&self, part: &str, nth: usize, quantity: &str) -> f64 {
        let impacts = self.impacts(part);
        let Some(own) = impacts.get(nth - 1) else {
            let (count, method) = (impacts.len(), self.report.solver.method);
            panic!("{} by {method}: {part} has {count} impacts only", self.case.name)
        };
        self.instant(own, quantity)
    }

    /// A value at an instant that was found, or is given.
    pub(super) fn value(&self, output: &str, time: f64, side: Side, quantity: &str) {
        self.value_is(output, time, side, self.case.get(quantity));
    }

    pub(super) fn value_is(&self, output: &str, time: f64, side: Side, expected: f64) {
        let signal = self.signal(output);
        let (found, slope) = match side {
            Side::Before => (signal.left_value(time), left_slope(signal, time)),
            Side::After => (signal.value(time), signal.slope(time)),
        };
        let shifted = if self.is_exact() { 0.0 } else { slope.abs() * self.shift(time) };
        let error = self.error(signal.error, signal.bound()) + shifted;
        self.within(&format!("{output} {side:?} {time}"), found, expected, error);
    }

    /// The largest value in a window, and its time where the case has it.
    pub(super) fn peak(&self, output: &str, window: (f64, f64), quantity: &str) {
        self.extremum(&self.signal(output).clone(), output, window, quantity);
    }

    /// The same of the negative of an output.
    pub(super) fn trough(&self, output: &str, window: (f64, f64), quantity: &str) {
        self.extremum(&self.signal(output).scaled(-1.0), output, window, quantity);
    }

    pub(super) fn extremum(&self, signal: &Signal, name: &str, window: (f64, f64), quantity: &str) {
        let peak = signal.maximum(window);
        let error = self.error(signal.error, signal.bound());
        self.within(&format!("peak of {name}"), peak.value, self.case.get(quantity), error);
        let Some(time) = self.case.find(&format!("{quantity}.time")) else { return };
        // A top is flat: an error of its height moves it by the root of that, over its curvature.
        let curvature = signal.derivative().slope(peak.time).abs();
        let flat = (4.0 * error / curvature).sqrt();
        let steep = 2.0 * error / left_slope(signal, peak.time).abs();
        let allowed = if flat.is_finite() { flat } else { 0.0 };
        let at_border = peak.time <= window.0 || peak.time >= window.1;
        let allowed = allowed.max(if at_border && steep.is_finite() { steep } else { 0.0 });
        let allowed = allowed + self.shift(peak.time);
        self.within(&format!("time of the peak of {name}"), peak.time, time, allowed);
    }

    /// The energy that an element has dissipated until `time`.
    pub(super) fn dissipated(&self, element: &str, time: f64) -> f64 {
        let ledger = ledger(&self.solution, time);
        let assembly = &self.report.assembly;
        let own = assembly.connection(element).expect("an element").primitives.clone();
        let names: Vec<&str> =
            assembly.primitives[own].iter().map(|own| own.name.as_str()).collect();
        let own = ledger.dissipated.iter().filter(|entry| names.contains(&entry.0.as_str()));
        own.map(|entry| entry.1).sum()
    }

    pub(super) fn loss(&self, element: &str, time: f64, quantity: &str) {
        let found = self.dissipated(element, time);
        let ledger = ledger(&self.solution, time);
        let error = self.error(ledger.error, ledger.turned_over);
        self.within(&format!("loss in {element}"), found, self.case.get(quantity), error);
    }

    /// A measure of the report, within the error that it states.
    pub(super) fn measure(&self, key: &str, quantity: &str) {
        self.measure_within(1.0, key, quantity);
    }

    /// A measure within so many of the errors that it states.
    pub(super) fn measure_within(&self, bars: f64, key: &str, quantity: &str) {
        let Some(own) = self.report.measure(key) else {
            let known: Vec<&str> = self.report.measures.iter().map(|own| &*own.key).collect();
            panic!("no {key} in {known:?}")
        };
        let (Some(value), Some(error)) = (own.value, own.error) else {
            self.faults.borrow_mut().push(format!("{own:?}"));
            return;
        };
        self.within(key, value, self.case.get(quantity), bars * error);
    }

    /// A number that was made of others, of the size `scale`, without an error of its own.
    pub(super) fn number(&self, what: &str, found: f64, expected: f64, scale: f64) {
        self.within(what, found, expected, self.error(Some(f64::INFINITY), scale));
    }

    /// Energy is conserved: to 1e-10 by `exact`, within its errors by the others.
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
            // Two bars of the release of a force y^3.5 need not meet.
            let is_flat = one.kind == "contact-time" && self.case.find("param.p") > Some(3.0);
            let bar = (first + second) * if is_flat { 4.0 } else { 1.0 };
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

/// Whether a path is that of a part or of something in it.
fn belongs_to(path: &str, part: &str) -> bool {
    path.strip_prefix(part).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// How long before `time` a signal is as close to its value there as its error.
fn within(signal: &Signal, time: f64, error: f64) -> f64 {
    let end = signal.left_value(time);
    let mut span = 4.0 * f64::EPSILON * time;
    while span < time && (signal.left_value(time - span) - end).abs() < error {
        span *= 1.25;
    }
    span.min(time)
}

/// The slope on the way to an instant, at which there may be a kink.
fn left_slope(signal: &Signal, time: f64) -> f64 {
    let mut at = signal.panel_at(time);
    if signal.panels[at].start >= time && at > 0 {
        at -= 1;
    }
    signal.panels[at].slope(time)
}
