//! What is to be known first of a run, in numbers.

mod depth;

use dashpot_dae::Extremum;
use dashpot_network::{
    ConnectionOutputs, NodeId, NodeOutputs,
    parameters::{Kind as _, WindowWish},
};

pub use self::depth::{Depth, Layer};
use crate::{
    Contact, ContactReport, MeasureReport, RunReport,
    energy::ledger::{Ledger, ledger},
    impact::contacts,
    measures::{
        CoefficientOfRestitution, ContactTime, EndVelocity, Energy, Measure, PeakAcceleration,
        PeakForce, TransmittedForce,
    },
};

/// A force elsewhere is larger if it is so by this part.
const MARGIN: f64 = 1e-3;
/// An error below this part of the size of a value is rounding.
const ROUNDING: f64 = 1e-9;
/// Speeds that differ by less than this part are one.
const SAME_SPEED: f64 = 1e-3;

/// What is to be known first of a run.
#[derive(Debug, Clone)]
pub struct Verdict<'r> {
    /// The largest force of an element that is reported.
    pub peak_force: Option<Peak<'r>>,
    /// The force of a padding and its stop together, where it is more than that of each.
    pub whole_force: Option<WholeForce<'r>>,
    /// A larger force of another element; none beside [`whole_force`](Self::whole_force).
    pub elsewhere: Option<Elsewhere<'r>>,
    /// The largest acceleration.
    pub peak_acceleration: Option<Peak<'r>>,
    /// The pad with the least left of its thickness, or else the largest deformation.
    pub depth: Option<Depth<'r>>,
    /// All other elements and parts of elements that have a thickness, in the order of the network.
    pub layers: Vec<Layer<'r>>,
    /// The largest energy that an element takes up.
    pub energy: Option<TakenUp<'r>>,
    /// How the impact ends.
    pub ending: Option<Ending<'r>>,
    /// What is known of the errors.
    pub reached: Reached<'r>,
    /// Whether the run ends while something is still pressed.
    pub is_cut: bool,
}

/// A largest value.
#[derive(Debug, Clone, Copy)]
pub enum Peak<'r> {
    /// It is infinite, where speeds jump.
    Infinite {
        /// The measure, which has no value.
        measure: &'r MeasureReport,
        /// When \[s\].
        time: f64,
    },
    /// It has a value.
    Finite {
        /// The measure.
        measure: &'r MeasureReport,
        /// Its value.
        value: f64,
        /// Whether the run ends in contact before it falls.
        is_so_far: bool,
    },
}

/// A force that several elements bear together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeForce<'r> {
    /// The contact of a padding whose force it is, or the padding on whose support it acts.
    pub element: &'r str,
    /// Whether it acts on what lies behind the padding.
    pub is_behind: bool,
    /// How much \[N\], and when \[s\].
    pub peak: Extremum,
}

/// A force of an element that is not reported.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elsewhere<'r> {
    /// The element.
    pub element: &'r str,
    /// How much \[N\], infinite where masses meet in it, and when \[s\].
    pub peak: Extremum,
    /// The window of the largest force that is reported \[s\].
    pub window: Option<(f64, f64)>,
}

/// What an element takes up, and of what.
#[derive(Debug, Clone)]
pub struct TakenUp<'r> {
    /// The measure.
    pub measure: &'r MeasureReport,
    /// Its value \[J\].
    pub value: f64,
    /// Where that comes from; `None` without impactors, and where it is not known.
    pub supply: Option<Supply<'r>>,
}

/// The energy that an element is given.
#[derive(Debug, Clone, PartialEq)]
pub struct Supply<'r> {
    /// The impactors that strike the element, where there are others as well; else none.
    pub impactors: Vec<&'r str>,
    /// Their kinetic energy at the start \[J\].
    pub kinetic: f64,
    /// The work done on them, or without others on all, from outside \[J\].
    pub work: f64,
}

/// How an impact ends.
#[derive(Debug, Clone)]
pub enum Ending<'r> {
    /// There is no impactor; perhaps something opens.
    NoImpactor(Option<Opened<'r>>),
    /// An element still pushes at the end of the run.
    Lasting {
        /// Its contact.
        contact: &'r ContactReport,
        /// Whether that is open, by the errors.
        is_open: bool,
    },
    /// No element is pressed, this one for instance.
    Never(&'r ContactReport),
    /// All contacts have ended.
    Ended {
        /// The longest contact.
        measure: &'r MeasureReport,
        /// How long it takes \[s\].
        value: f64,
        /// The contact of the element.
        contact: Option<&'r ContactReport>,
        /// Whether the element pulls from then on.
        pulls: bool,
        /// The fastest impactor of those that strike the element.
        leaving: Option<Leaving<'r>>,
    },
}

/// What opens in a run without impactors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opened<'r> {
    /// The element, or its path.
    pub name: &'r str,
    /// When for the first time \[s\].
    pub time: f64,
    /// How often.
    pub times: usize,
}

/// An impactor at the end of the impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaving<'r> {
    /// Its name.
    pub impactor: &'r str,
    /// Its speed \[m/s\].
    pub speed: f64,
    /// Whether it has turned.
    pub returns: bool,
    /// The coefficient of restitution with its error, where the impactor has turned and that is known: of the element that
    /// it strikes between bodies, else the impactor's own, its speed over that at touch.
    pub restitution: Option<(f64, Option<f64>)>,
    /// Whether it is that of the element.
    pub of_element: bool,
    /// The element, where its ends part at another part of their speed than the impactor has of that at its start: what it
    /// is pressed against moves, or the impactor was sped up before.
    pub parting: Option<&'r str>,
}

/// What is known of the errors of the values.
#[derive(Debug, Clone, Default)]
pub struct Reached<'r> {
    /// The largest relative error of those that are not [`small`](Self::small); infinite where some come and go with the
    /// tolerance.
    pub worst: Option<f64>,
    /// Values of which not even the first digit is known, for more than rounding, though the error is
    /// small beside others of their kind.
    pub small: Vec<&'r MeasureReport>,
    /// Values without an error, where others have one.
    pub unknown: Vec<&'r MeasureReport>,
    /// Whether there are values other than zero, and no error of any.
    pub is_unknown: bool,
}

impl<'r> Verdict<'r> {
    /// Reads it off a report.
    pub fn of(run: &'r RunReport) -> Self {
        let found = Found(run);
        let whole_force = found.whole_force();
        let depth = found.depth();
        Self {
            peak_force: found.peak(PeakForce::KIND),
            elsewhere: if whole_force.is_some() { None } else { found.elsewhere() },
            whole_force,
            peak_acceleration: found.peak(PeakAcceleration::KIND),
            layers: found.layers(depth.map(Depth::element)),
            depth,
            energy: found.energy(),
            ending: found.ending(),
            reached: found.reached(),
            is_cut: run.is_cut(),
        }
    }
}

#[derive(Clone, Copy)]
struct Found<'r>(&'r RunReport);

impl<'r> Found<'r> {
    fn of_kind(self, kind: &str) -> impl Iterator<Item = &'r MeasureReport> {
        self.0.measures.iter().filter(move |measure| measure.kind == kind)
    }

    /// The measure of this kind with the largest value.
    fn largest(self, kind: &str) -> Option<(&'r MeasureReport, f64)> {
        let valued = self.of_kind(kind).filter_map(|own| own.value.map(|value| (own, value)));
        valued.max_by(|one, other| one.1.total_cmp(&other.1))
    }

    /// The first measure of this kind that is infinite, or the one with the largest value.
    fn peak(self, kind: &str) -> Option<Peak<'r>> {
        // What is infinite has a time, and no value there.
        let mut none = self.of_kind(kind).filter(|measure| measure.value.is_none());
        let infinite = none.find_map(|measure| Some((measure, measure.time?)));
        if let Some((measure, time)) = infinite {
            return Some(Peak::Infinite { measure, time });
        }
        self.largest(kind).map(|(measure, value)| self.finite(measure, value))
    }

    fn finite(self, measure: &'r MeasureReport, value: f64) -> Peak<'r> {
        let is_so_far = measure.time.is_some() && self.0.is_so_far(measure);
        Peak::Finite { measure, value, is_so_far }
    }

    fn connections(self) -> &'r [ConnectionOutputs] {
        &self.0.assembly.connections
    }

    /// In the window of the largest force, and of the padding whose stop that acts in: at its contact, or where it has none on
    /// what lies behind.
    fn whole_force(self) -> Option<WholeForce<'r>> {
        let (headline, most) = self.largest(PeakForce::KIND)?;
        let element = self.0.assembly.position(&headline.target)?;
        let pad = self.0.assembly.pads.iter();
        let pad = pad.clone().find(|own| own.element == element || own.stop == Some(element))?;
        let padding = &self.connections()[pad.element].name;
        let windows = self.of_kind(PeakForce::KIND).filter(|own| own.target == *padding);
        let windows = windows.filter_map(|own| own.window);
        let (from, to) =
            windows.fold(headline.window?, |one, other| (one.0.min(other.0), one.1.max(other.1)));
        let window = WindowWish::Times(from, to);
        let solution = self.0.solution();
        let (element, is_behind, reading) = match (pad.contact, pad.stop) {
            (Some(contact), _) => {
                let reading = PeakForce { window }.read(&solution, contact);
                // Where masses meet in it, it has a time and no value.
                let value = Some(reading.value.unwrap_or(f64::INFINITY));
                (contact, false, (value, reading.time))
            }
            (None, Some(_)) => {
                let reading = TransmittedForce { window }.read(&solution, pad.element);
                (pad.element, true, (reading.value, reading.time))
            }
            (None, None) => return None,
        };
        let (value, time) = reading.0.zip(reading.1)?;
        let is_more = value.is_finite() && value > most * (1.0 + MARGIN);
        let element = &self.connections()[element].name;
        is_more.then_some(WholeForce { element, is_behind, peak: Extremum { time, value } })
    }

    fn elsewhere(self) -> Option<Elsewhere<'r>> {
        let Some(Peak::Finite { measure, value, .. }) = self.peak(PeakForce::KIND) else {
            return None;
        };
        let (element, peak) = self.0.largest_force()?;
        let window = measure.window;
        let margin = measure.error.filter(|error| error.is_finite()).unwrap_or(0.0);
        let is_larger = peak.value > value + margin.max(MARGIN * value);
        let is_other = element != measure.target && is_larger;
        (peak.value.is_infinite() || is_other).then_some(Elsewhere { element, peak, window })
    }

    /// The impactors, or those that strike an element.
    fn impactors(self, element: Option<&str>) -> Vec<(usize, &'r NodeOutputs)> {
        let assembly = &*self.0.assembly;
        let mut ends = Vec::new();
        if let Some(at) = element.and_then(|name| assembly.position(name)) {
            let contact = assembly.pad(at).and_then(|pad| pad.contact);
            for at in [at].into_iter().chain(contact) {
                ends.extend(contacts::between(assembly, &assembly.connections[at]));
            }
        }
        let all = assembly.nodes.iter().enumerate().filter(|(_, node)| node.is_impactor());
        all.filter(|(_, node)| element.is_none() || ends.contains(&node.body)).collect()
    }

    fn energy(self) -> Option<TakenUp<'r>> {
        let (measure, value) = self.largest(Energy::KIND)?;
        let supply = self.supply(measure);
        Some(TakenUp { measure, value, supply })
    }

    fn supply(self, measure: &MeasureReport) -> Option<Supply<'r>> {
        let run = self.0;
        let all = self.impactors(None);
        let own = self.impactors(Some(&measure.target));
        if all.is_empty() {
            return None;
        }
        let until = measure.window.map_or(run.energy.time, |(_, end)| end);
        let is_whole = own.is_empty() || own.len() == all.len();
        let work = self.work_in(until, (!is_whole).then_some(&own))?;
        if is_whole {
            return Some(Supply { impactors: Vec::new(), kinetic: run.impact_energy(), work });
        }
        let kinetic = own.iter().map(|(_, node)| kinetic(node)).sum::<f64>().min(run.energy.start);
        let impactors = own.into_iter().map(|(_, node)| node.name.as_str()).collect();
        Some(Supply { impactors, kinetic, work })
    }

    /// The work done from outside \[J\] from the start until a time \[s\], on all or on some nodes; unknown
    /// within the run of a large network.
    fn work_in(self, until: f64, on: Option<&Vec<(usize, &NodeOutputs)>>) -> Option<f64> {
        let run = self.0;
        if run.energy.work_in.is_empty() {
            return Some(0.0);
        }
        let sum = |ledger: &Ledger| match on {
            None => ledger.total_work_in(),
            Some(nodes) => {
                let bodies: Vec<usize> = nodes.iter().map(|(_, node)| node.body).collect();
                let drives = run.assembly.drives.iter();
                let ours =
                    drives.filter(|drive| bodies.contains(&run.assembly.nodes[drive.node].body));
                let names: Vec<&str> = ours.map(|our| our.name.as_str()).collect();
                let works = ledger.work_in.iter().filter(|own| names.contains(&own.0.as_str()));
                works.map(|work| work.1).sum()
            }
        };
        let ledgers = run.energy_after_impact.iter().chain([&run.energy]);
        let known =
            ledgers.into_iter().find(|ledger| (ledger.time - until).abs() <= 1e-9 * ledger.time);
        let work = known.map_or_else(|| sum(&ledger(&run.solution(), until)), sum);
        (!work.is_nan()).then_some(work)
    }

    fn ending(self) -> Option<Ending<'r>> {
        let run = self.0;
        if self.impactors(None).is_empty() {
            return Some(Ending::NoImpactor(self.opened()));
        }
        let of = |contact: Contact| run.contacts.iter().find(|own| own.impact.contact == contact);
        if let Some(contact) = of(Contact::Lasting) {
            let time = run.measure(&format!("{}.{}", contact.element, ContactTime::KIND));
            let is_open = time.and_then(|time| time.error).is_some_and(f64::is_infinite);
            return Some(Ending::Lasting { contact, is_open });
        }
        if !run.contacts.iter().any(|contact| contact.impact.has_ended()) {
            return of(Contact::Pulling).or_else(|| of(Contact::Unloaded)).map(Ending::Never);
        }
        let (measure, value) = self.largest(ContactTime::KIND)?;
        let contact = run.contacts.iter().find(|contact| contact.element == measure.target);
        let pulls = contact.is_some_and(|contact| {
            contact.is_glued
                && contact.impact.contact == Contact::Released
                && contact.impact.end < run.energy.time
        });
        let leaving = self.leaving(&measure.target);
        Some(Ending::Ended { measure, value, contact, pulls, leaving })
    }

    fn opened(self) -> Option<Opened<'r>> {
        let assembly = &*self.0.assembly;
        let mut opened = self.0.trajectory.switches.iter().filter(|switch| switch.what == "open");
        let first = opened.next()?;
        let times = 1 + opened.filter(|opened| opened.name == first.name).count();
        let at = assembly.primitives.iter().position(|primitive| *primitive.name == *first.name)?;
        let behind = assembly.owner(at).and_then(|own| assembly.pad_behind(own));
        let name = behind
            .map_or(assembly.primitives[at].place(), |pad| &assembly.connections[pad.element].name);
        Some(Opened { name, time: first.time, times })
    }

    fn leaving(self, element: &str) -> Option<Leaving<'r>> {
        let speeds = self.impactors(Some(element)).into_iter().filter_map(|(at, node)| {
            let reading = Measure::read(&EndVelocity::default(), &self.0.solution(), at);
            Some((node, reading.value?))
        });
        let (node, speed) = speeds.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()))?;
        let returns = speed * node.start_velocity.unwrap_or(0.0) < 0.0;
        let at = self.0.assembly.position(element)?;
        // A face with mass keeps what strikes it; the element behind it throws both back.
        let at = self.0.assembly.pad_behind(at).map_or(at, |pad| pad.element);
        let of_element = self.is_between_bodies(at, node);
        let restitution = if of_element {
            let key = format!("{}.{}", self.connections()[at].name, CoefficientOfRestitution::KIND);
            self.0.measure(&key).and_then(|own| Some((own.value?, own.error)))
        } else {
            node.start_velocity.map(|start| (speed.abs() / start.abs(), None))
        };
        let restitution = restitution.filter(|_| returns);
        let (impactor, speed) = (&*node.name, speed.abs());
        let own = speed / node.start_velocity.unwrap_or(0.0).abs();
        let is_other = |of: &(f64, Option<f64>)| (of.0 - own).abs() > SAME_SPEED * own;
        let parting = restitution.filter(|of| of_element && is_other(of));
        let parting = parting.map(|_| &*self.connections()[at].name);
        Some(Leaving { impactor, speed, returns, restitution, of_element, parting })
    }

    /// Whether the end of an element that is not struck is held or has mass: else the speed of its ends is not that of
    /// what strikes it against anything.
    fn is_between_bodies(self, element: usize, struck_by: &NodeOutputs) -> bool {
        let assembly = &*self.0.assembly;
        let face = assembly.pads.iter().find(|own| own.element == element).and_then(|own| own.face);
        let ends = assembly.connections[element].between.map(NodeId::index);
        let mut others = ends
            .into_iter()
            .filter(|own| Some(*own) != face && assembly.nodes[*own].body != struck_by.body);
        let is_body = |own: &NodeOutputs| !own.free || own.mass > 0.0;
        others.all(|own| {
            let body = assembly.nodes[own].body;
            assembly.nodes.iter().any(|own| own.body == body && is_body(own))
        })
    }

    fn reached(self) -> Reached<'r> {
        let valued = self.0.measures.iter().filter(|measure| measure.value.is_some());
        let (known, unknown): (Vec<&MeasureReport>, Vec<_>) =
            valued.partition(|own| own.error.is_some());
        let is_small = |measure_report: &&MeasureReport| {
            // A time is as long as the run may be.
            let run = if measure_report.unit == "s" { self.0.energy.time } else { 0.0 };
            let size = measure_report.size.max(run);
            let is_rounding = measure_report.error.is_some_and(|error| error <= ROUNDING * size);
            let is_infinite = measure_report.error == Some(f64::INFINITY);
            measure_report.is_next_to_nothing() && !is_rounding && !is_infinite
        };
        let is_nothing = |measure_report: &MeasureReport| measure_report.value == Some(0.0);
        let (small, others): (Vec<_>, Vec<_>) = known.iter().copied().partition(is_small);
        Reached {
            worst: others.iter().filter_map(|own| own.relative_error()).reduce(f64::max),
            small,
            is_unknown: {
                let mut others = unknown.iter().filter(|own| !is_nothing(own)).peekable();
                others.peek().is_some() && known.iter().all(|own| is_nothing(own))
            },
            unknown: if known.is_empty() { Vec::new() } else { unknown },
        }
    }
}

fn kinetic(node: &NodeOutputs) -> f64 {
    0.5 * node.mass * node.start_velocity.unwrap_or(0.0).powi(2)
}

#[cfg(test)]
mod tests;
