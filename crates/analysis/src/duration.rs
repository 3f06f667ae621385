//! How long a run has to be, where nobody says: until the impact is over, and nothing larger follows.

use std::collections::BTreeSet;

use dashpot_dae::Waveform;
use dashpot_network::{
    Network, Support,
    parameters::{Kind as _, WindowWish},
};

use crate::{
    Contact, MeasureReport, MeasureWish, RunError, RunReport, Solve, SolveSettings,
    impact::contacts,
    measures::{PeakAcceleration, PeakDeformation, PeakForce, PeakVelocity},
    settings::Accuracy,
};

/// The shortest run that is tried \[s\].
const SHORTEST: f64 = 1e-3;

/// The relative tolerance of the runs that are tried: pulls of 1e-4 of the peak are told from errors.
const RTOL: f64 = 1e-7;

/// A peak that has grown by less than this part has not grown.
const GROWN: f64 = 1e-3;

/// Peaks below this part of the largest of their kind are nothing.
const NOTHING: f64 = 1e-6;

/// A speed below this is none \[m/s\].
const AT_REST: f64 = 1e-12;

/// What is left beside the last that matters, as a factor of its time.
const MARGIN: f64 = 1.25;

/// How often a run is doubled without a larger peak, where no impact ends.
const QUIET: usize = 3;

/// The length of a run that has been found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundDuration {
    /// The length \[s\].
    pub duration: f64,
    /// Whether it is the longest that it may be, and something larger may follow.
    pub is_cut: bool,
}

/// How long a run of `network` has to be: at most `at_most` \[s\], positive, after all that is dropped has arrived.
///
/// Runs of 1 ms, 2 ms, 4 ms, … after that are tried, with loose errors, until
/// - every contact with an impactor has ended, as far as there has been one;
/// - no load and no motion changes its form any more;
/// - nothing that has borne no force yet is about to meet something;
/// - no peak of a force, a deformation or an acceleration anywhere in the network is larger than in a run half as long,
///   nor that of the speed of a mass that elements still push; deformations count where there is still a force.
///
/// The length is the fall and 1.25 times what passes from there to the last of the ends and the peaks, rounded up to
/// two digits. Where a contact lasts, or nothing strikes, the peaks must have been the same since an eighth of the run,
/// which is then taken whole. A run that a condition stops needs to be no longer than to there.
///
/// # Errors
///
/// Any [`RunError`] of the runs that are tried.
pub fn found_duration(
    network: &Network,
    settings: &SolveSettings,
    at_most: f64,
) -> Result<FoundDuration, RunError> {
    let fall = fall(network, at_most)?;
    let at_most = at_most.min(given_until(network) - fall);
    let changes = last_change(network) - fall;
    let mut after = SHORTEST.min(at_most);
    let mut known: Option<Peaks> = None;
    let mut quiet = 0;
    loop {
        let length = fall + after;
        let report = network.solve_with(&trial(network, settings, length))?;
        let found = |last: f64| FoundDuration {
            duration: rounded_up(fall + MARGIN * (last - fall)).min(length),
            is_cut: false,
        };
        if let Some(stop) = report.stopped_by() {
            return Ok(found(stop.time));
        }
        let peaks = Peaks::of(&report);
        let same = known.as_ref().is_some_and(|known| !peaks.exceed(known));
        quiet = if same { quiet + 1 } else { 0 };
        // What a load does shortly before the end has not been seen.
        if same && changes < 0.5 * after && !is_closing(&report) {
            match last_end(&report) {
                Some(end) if end - fall <= 0.5 * after => {
                    let before = known.as_ref().map_or(0.0, |known| known.last);
                    return Ok(found(end.max(before).max(fall + changes)));
                }
                None if quiet >= QUIET => {
                    return Ok(FoundDuration { duration: length, is_cut: false });
                }
                _ => {}
            }
        }
        if after >= at_most {
            return Ok(FoundDuration { duration: length, is_cut: true });
        }
        known = Some(peaks);
        after = (2.0 * after).min(at_most);
    }
}

/// What is asked of a run that is tried.
fn trial(network: &Network, settings: &SolveSettings, duration: f64) -> SolveSettings {
    SolveSettings {
        duration,
        rtol: Some(RTOL),
        accuracy: Accuracy::default(),
        estimate: false,
        measures: wishes(network),
        limits: Vec::new(),
        ..settings.clone()
    }
}

/// When the last of what is dropped arrives \[s\]. Errors: what is wrong with the network.
fn fall(network: &Network, at_most: f64) -> Result<f64, RunError> {
    let nodes = network.compile(at_most)?.nodes;
    Ok(nodes.iter().filter(|node| node.is_impactor()).map(|node| node.fall).fold(0.0, f64::max))
}

/// The peaks of all elements and free masses in the whole run.
fn wishes(network: &Network) -> Vec<MeasureWish> {
    let window = WindowWish::Run;
    let of_elements = network.connections().iter().flat_map(|own| {
        let name = own.name.as_str();
        let force = MeasureWish::new(name, PeakForce { window });
        [force, MeasureWish::new(name, PeakDeformation { window })]
    });
    let free = network.nodes().filter(|(_, node)| node.mass > 0.0 && node.support == Support::Free);
    let of_nodes = free.flat_map(|(_, node)| {
        let name = node.name.as_str();
        let acceleration = MeasureWish::new(name, PeakAcceleration { window });
        [acceleration, MeasureWish::new(name, PeakVelocity { window })]
    });
    of_elements.chain(of_nodes).collect()
}

/// The peaks of a run.
struct Peaks {
    /// The unit and the value of each; 0 where there is none.
    all: Vec<(&'static str, f64)>,
    /// The last time \[s\] of one.
    last: f64,
}

impl Peaks {
    fn of(report: &RunReport) -> Self {
        let (nodes, elements) = pushed_at_the_end(report);
        let of_run = |own: &&MeasureReport| own.window_wish == Some(WindowWish::Run);
        let (mut all, mut last) = (Vec::new(), 0.0_f64);
        for own in report.measures.iter().filter(of_run) {
            let mut value = own.value.unwrap_or(0.0);
            // What flies freely may be as fast and go as far as it likes.
            let counts = match own.kind {
                PeakVelocity::KIND => value >= AT_REST && nodes.contains(own.target.as_str()),
                PeakDeformation::KIND => elements.contains(own.target.as_str()),
                _ => true,
            };
            if !counts {
                value = 0.0;
            }
            all.push((own.unit, value));
            last = last.max(own.time.filter(|_| value > 0.0).unwrap_or(0.0));
        }
        Self { all, last }
    }

    /// Whether one is larger than it was `before`.
    fn exceed(&self, before: &Self) -> bool {
        let largest = |unit: &str| {
            let own = self.all.iter().filter(|own| own.0 == unit && own.1.is_finite());
            own.map(|own| own.1).fold(0.0, f64::max)
        };
        let pairs = self.all.iter().zip(&before.all);
        pairs.into_iter().any(|(&(unit, value), &(_, before))| {
            value > before * (1.0 + GROWN) && value > NOTHING * largest(unit)
        })
    }
}

/// The nodes of the bodies that an element pushes or pulls at the end of a run, and those elements.
fn pushed_at_the_end(report: &RunReport) -> (BTreeSet<&str>, BTreeSet<&str>) {
    let (solution, assembly) = (report.solution(), &*report.assembly);
    let (mut bodies, mut elements) = (BTreeSet::new(), BTreeSet::new());
    for own in &assembly.connections {
        let Some(force) = own.force.map(|force| solution.signal(force)) else { continue };
        if force.left_value(solution.end()).abs() > NOTHING * force.bound() {
            bodies.extend(contacts::between(assembly, own));
            elements.insert(own.name.as_str());
        }
    }
    let nodes = assembly.nodes.iter().filter(|node| bodies.contains(&node.body));
    (nodes.map(|node| node.name.as_str()).collect(), elements)
}

/// When the last contact with an impactor has ended \[s\]; `None` where one lasts, or there is none.
fn last_end(report: &RunReport) -> Option<f64> {
    let mut last = None;
    for contact in &report.contacts {
        match contact.impact.contact {
            Contact::Released | Contact::Parted => {
                last = Some(contact.impact.end.max(last.unwrap_or(0.0)));
            }
            Contact::Lasting => return None,
            Contact::Pulling | Contact::Unloaded | Contact::NoImpactor => {}
        }
    }
    last
}

/// Whether the ends of an element that has borne no force come closer at the end of the run.
fn is_closing(report: &RunReport) -> bool {
    let solution = report.solution();
    let end = solution.end();
    report.assembly.connections.iter().any(|own| {
        let force = own.force.filter(|_| own.never_pulls);
        let is_idle = force.is_some_and(|force| solution.signal(force).bound() == 0.0);
        is_idle && solution.rate_of(own).value(end) > 0.0
    })
}

fn driving(network: &Network) -> impl Iterator<Item = &Waveform> {
    let motions = network.nodes().filter_map(|(_, node)| match &node.support {
        Support::Prescribed(motion) => Some(motion),
        _ => None,
    });
    let forces = network.loads().iter().map(|load| &load.force);
    forces.chain(motions)
}

/// The last time \[s\] at which a load or a motion changes its form; 0 where none does.
fn last_change(network: &Network) -> f64 {
    driving(network).flat_map(Waveform::breakpoints).fold(0.0, f64::max)
}

/// Until when \[s\] all that drives the network is known.
fn given_until(network: &Network) -> f64 {
    let given = driving(network).filter_map(Waveform::given).filter(|given| given.is_strict);
    given.map(|given| given.to).fold(f64::INFINITY, f64::min)
}

/// `time` \[s\], rounded up to two digits.
fn rounded_up(time: f64) -> f64 {
    if time <= 0.0 {
        return SHORTEST;
    }
    let digit = 10_f64.powf(time.log10().floor() - 1.0);
    // Divided by a whole number where the digit is a small one: 21 ms, not 21.000000000000004 ms.
    let count = (time / digit * (1.0 - 4.0 * f64::EPSILON)).ceil();
    if digit < 1.0 { count / (1.0 / digit).round() } else { count * digit }
}
