//! What is claimed of a solved case: instants, values, peaks, losses and measures.

use dashpot::{
    analysis::ledger::ledger,
    dae::{Signal, Switch},
};

use super::trial::{Side, Trial};

impl Trial<'_> {
    /// All switchings of a part, into the phase `what` if that is given.
    pub(super) fn switches(&self, part: &str, what: Option<&str>) -> Vec<&Switch> {
        let switches = self.report.trajectory.switches.iter();
        switches
            .filter(|switch| belongs_to(&switch.name, part))
            .filter(|switch| what.is_none_or(|what| switch.what == what))
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
    fn time_error(&self, switch: &Switch) -> f64 {
        let primitives = &self.report.assembly.primitives;
        let Some(part) = primitives.iter().find(|part| *part.name == *switch.name) else {
            return 0.0;
        };
        let watched = match switch.what {
            "open" | "sliding forward" | "sliding backward" => part.force,
            "stuck" => part.rate.unwrap_or(part.deformation),
            _ => part.deformation,
        };
        let signal = self.solution.signal(watched);
        // A gap is a small difference of the ways of its sides.
        let way = if watched == part.deformation { self.longest_way() } else { 0.0 };
        let error = self.error(signal.error, signal.bound().max(way));
        let late = if self.is_exact() { 0.0 } else { self.error(None, switch.time) };
        late + within(signal, switch.time, error)
    }

    fn longest_way(&self) -> f64 {
        let places = self.report.assembly.nodes.iter().map(|node| node.position);
        places.map(|place| self.solution.signal(place).bound()).fold(0.0, f64::max)
    }

    /// By how much all is shifted in time at `time`: by the errors of the switchings until then.
    fn shift(&self, time: f64) -> f64 {
        let switches = self.report.trajectory.switches.iter();
        let until = switches.filter(|switch| switch.time > 0.0 && switch.time <= time);
        until.map(|until| self.time_error(until)).sum()
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
    pub(super) fn instant(&self, switch: &Switch, quantity: &str) -> f64 {
        self.late_instant(switch, quantity, 0.0)
    }

    /// The same of one that may be `late` \[s\] for a reason of its own.
    pub(super) fn late_instant(&self, switch: &Switch, quantity: &str, late: f64) -> f64 {
        let name = format!("time of {} {} ({quantity})", switch.name, switch.what);
        self.within(&name, switch.time, self.case.get(quantity), late + self.shift(switch.time));
        switch.time
    }

    /// The time at which a series of ever shorter flights ends, of which a run leaves out those that
    /// cannot be told from rest: at most as long as the last two together.
    pub(super) fn rests(&self, switch: &Switch, quantity: &str) {
        let impacts = self.impacts(&switch.name);
        let times: Vec<f64> =
            impacts.iter().map(|impact| impact.time).filter(|time| *time < switch.time).collect();
        let [.., before, last] = times[..] else { panic!("{times:?}") };
        let (first, second) = (last - before, switch.time - last);
        // The flights are a geometric series.
        let left = second * second / (first - second);
        let slack = 0.02 * left;
        self.late_instant(&Switch { time: switch.time + left, ..switch.clone() }, quantity, slack);
        if self.is_exact() {
            assert!(left < 1e-6 * switch.time, "{left:e} s are left out");
        }
    }

    /// The impacts of a part.
    pub(super) fn impacts(&self, part: &str) -> Vec<&Switch> {
        self.switches(part, None).into_iter().filter(|switch| switch.impulse > 0.0).collect()
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
        let names: Vec<&str> = assembly.primitives[own].iter().map(|own| &*own.name).collect();
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
            let known: Vec<&str> =
                self.report.measures.iter().map(|measure| &*measure.key).collect();
            panic!("no {key} in {known:?}")
        };
        let (Some(value), Some(error)) = (own.value, own.error) else {
            self.faults.borrow_mut().push(format!("{own:?}"));
            return;
        };
        let expected = self.case.get(quantity);
        let stated = bars * error;
        let allowed =
            if self.is_exact() { self.error(Some(stated), expected.abs()) } else { stated };
        self.within(key, value, expected, allowed);
    }

    /// A number that was made of others, of the size `scale`, without an error of its own.
    pub(super) fn number(&self, what: &str, found: f64, expected: f64, scale: f64) {
        self.within(what, found, expected, self.error(Some(f64::INFINITY), scale));
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
