//! What the reader of a report must know: what is wrong with a run as a picture of the scene, and of its measures.

use std::collections::BTreeSet;

use dashpot_dae::{Direction, Guard, SolveError};
use dashpot_network::{
    ConnectionOutputs, NodeId, PrimitiveOutputs, SegmentOutputs, SegmentPlace,
    effects::Gravity,
    parameters::{Kind as _, Value, WindowWish},
};

use super::preloads;
use crate::{
    Beyond, Compression, ContactReport, Harder, Ledger, MeasureReport, Missed, Note, Solution,
    Through, Warning,
    energy::ledger::leak,
    errors::{open_ends::OpenEnd, solved::Task},
    impact::{
        contacts,
        interval::{Contact, Impact, SLIGHT},
        sliders::Idle,
    },
    measures::{
        AverageDeceleration, Clip, Clip3ms, EndDeformation, EndForce, EndPosition, EndVelocity,
        Energy, Family, Hic, Hic15, Hic36, Impulse, Measure as _, PeakAcceleration,
        PeakDisplacement, PeakForce, PeakStrain, PeakVelocity, Reading, SeverityIndex,
        selection::Selected,
    },
    report::compression::{ROUNDING, is_as_thick},
};

pub(crate) struct Findings<'a> {
    pub(crate) solution: &'a Solution<'a>,
    pub(crate) task: &'a Task<'a>,
    pub(crate) measures: &'a [MeasureReport],
    pub(crate) contacts: &'a [ContactReport],
    pub(crate) energy: &'a Ledger,
    pub(crate) open_end: Option<&'a OpenEnd>,
    pub(crate) obstacle: Option<&'a SolveError>,
    pub(crate) guards: &'a [Guard],
    pub(crate) effects: &'a [&'static str],
    pub(crate) idle: &'a [Idle],
}

/// Measures whose values over the whole run are looked at in every run, and those that mean one impact alone; of the others
/// those on which there are limits.
const PEAKS: [&str; 2] = [PeakForce::KIND, PeakAcceleration::KIND];
const OF_ONE_IMPACT: [&str; 9] = [
    Impulse::KIND,
    Energy::KIND,
    EndForce::KIND,
    EndDeformation::KIND,
    EndVelocity::KIND,
    EndPosition::KIND,
    AverageDeceleration::KIND,
    // What has bounced off goes farther than it was pressed in.
    PeakDisplacement::KIND,
    PeakVelocity::KIND,
];
/// Part by which a peak outside the impact must exceed that within to be worth a warning.
const HARDER: f64 = 0.05;
/// Measures of what an impact does to a body.
const INJURIES: [&str; 6] =
    [SeverityIndex::KIND, Hic15::KIND, Hic36::KIND, Hic::KIND, Clip3ms::KIND, Clip::KIND];

/// All warnings, the most important first.
pub(crate) fn collect(findings: &Findings<'_>) -> Vec<Warning> {
    let mut warnings = pulling(findings);
    warnings.extend(pressed_through(findings.solution));
    warnings.extend(beyond_measured(findings.solution));
    warnings.extend(crushed_layers(findings));
    warnings.extend(energy(findings));
    warnings.extend(preloads::loose(findings.solution));
    warnings.extend(findings.idle.iter().cloned().map(Warning::IdleSlider));
    warnings.extend(stops_that_hold(findings));
    warnings.extend(still_falling(findings.solution));
    warnings.extend(still_in_contact(findings));
    warnings.extend(contacts_that_pull(findings));
    warnings.extend(open_end(findings));
    warnings.extend(harder_outside(findings));
    warnings.extend(flying_away(findings));
    warnings.extend(accuracy(findings));
    let assembly = findings.solution.assembly();
    warnings.extend(assembly.held.iter().cloned().map(Warning::HeldTable));
    warnings.extend(assembly.warnings.iter().cloned().map(Warning::Network));
    warnings
}

fn pulling(findings: &Findings<'_>) -> Vec<Warning> {
    let end = findings.solution.end();
    let since = |impact: &Impact| match impact.contact {
        Contact::Released if impact.end < end => Some(Some(impact.end)),
        Contact::Pulling => Some(None),
        _ => None,
    };
    let assembly = findings.solution.assembly();
    let is_glued = |element: &&str| {
        assembly.position(element).is_some_and(|at| contacts::is_glued(assembly, at))
    };
    let contacts =
        findings.contacts.iter().map(|contact| (contact.element.as_str(), contact.impact));
    let warning = |(element, impact): (&str, Impact)| {
        since(&impact).map(|since| Warning::Pulls { element: element.to_owned(), since })
    };
    let all = contacts.chain(pads(findings));
    all.filter(|(element, _)| is_glued(element)).filter_map(warning).collect()
}

/// How the pads between parts that are no impactors are pressed: what has a thickness lies between
/// its ends and cannot pull at them, while mounts may.
fn pads<'a>(findings: &'a Findings<'a>) -> impl Iterator<Item = (&'a str, Impact)> {
    let solution = findings.solution;
    let connections = solution.assembly().connections.iter();
    let heads = heads_without_a_pad(findings);
    connections.filter_map(move |connection| {
        let carries_a_head = || connection.between.iter().any(|end| heads.contains(end));
        (connection.thickness.is_some() || carries_a_head()).then_some(())?;
        let force = connection.force.filter(|_| !solution.touches_impactor(connection))?;
        if !solution.keeps(force) {
            return None;
        }
        Some((connection.name.as_str(), solution.impact_of(connection, solution.signal(force))))
    })
}

/// Nodes whose injury is asked for in a run without impactors, where no element there has a thickness:
/// what they touch are pads of which only that is not said.
fn heads_without_a_pad(findings: &Findings<'_>) -> BTreeSet<NodeId> {
    let assembly = findings.solution.assembly();
    let injuries = findings.measures.iter().filter(|measure| INJURIES.contains(&measure.kind));
    let targets: BTreeSet<&str> = injuries.map(|injury| injury.target.as_str()).collect();
    if targets.is_empty() || assembly.has_impactor() {
        return BTreeSet::new();
    }
    let is_head = |end: &NodeId| targets.contains(assembly.nodes[end.index()].name.as_str());
    let ends = |is_pad: bool| {
        let own = assembly
            .connections
            .iter()
            .filter(move |connection| connection.thickness.is_some() == is_pad);
        own.flat_map(|own| own.between)
    };
    let mut heads: BTreeSet<NodeId> = ends(false).filter(is_head).collect();
    for end in ends(true) {
        heads.remove(&end);
    }
    heads
}

/// Layers that are pressed in by more than their thickness, while the pad as a whole is not.
fn crushed_layers(findings: &Findings<'_>) -> Vec<Warning> {
    let solution = findings.solution;
    let strains = findings.measures.iter().filter(|measure| measure.kind == PeakStrain::KIND);
    let crushed = strains.filter_map(|own| {
        let connection = solution.assembly().connection(&own.target)?;
        let (strain, time) = own.value.zip(own.time)?;
        let is_crushed = connection.has_layers && own.notes.contains(&Note::Crushed);
        let (element, notes) = (own.target.clone(), own.notes.clone());
        is_crushed.then_some(Warning::CrushedPart { element, strain, time, notes })
    });
    crushed.collect()
}

fn energy(findings: &Findings<'_>) -> Option<Warning> {
    let closure = findings.energy.closure();
    let bound = match findings.energy.error {
        Some(error) if findings.energy.turned_over > 0.0 => error / findings.energy.turned_over,
        _ => worst(findings.measures).unwrap_or(findings.task.settings.accuracy.default),
    };
    (closure.abs() > bound.max(ROUNDING))
        .then(|| Warning::EnergyNotClosed { closure, leak: leak(findings.solution) })
}

/// A condition that holds from the start is not met then: only a passage of its level is.
fn stops_that_hold(findings: &Findings<'_>) -> Vec<Warning> {
    let holds = |guard: &&Guard| {
        let signal = findings.solution.signal(guard.output);
        let above = signal.value(0.0) - guard.level;
        match guard.direction {
            Direction::Rising => above > signal.noise,
            Direction::Falling => above < -signal.noise,
            Direction::Either => false,
        }
    };
    let held = findings.guards.iter().filter(|guard| guard.stops).filter(holds);
    held.map(|guard| Warning::StopHolds { condition: guard.name.clone() }).collect()
}

fn worst(measures: &[MeasureReport]) -> Option<f64> {
    measures.iter().filter_map(MeasureReport::relative_error).reduce(f64::max)
}

/// What was dropped and has not arrived when the run ends.
fn still_falling(solution: &Solution<'_>) -> Vec<Warning> {
    let impactors = solution.assembly().nodes.iter().filter(|node| node.is_impactor());
    let end = solution.end();
    let falling = impactors.filter(|node| node.fall > end);
    falling
        .map(|falling| Warning::StillFalling {
            node: falling.name.clone(),
            end,
            fall: falling.fall,
        })
        .collect()
}

fn still_in_contact(findings: &Findings<'_>) -> Vec<Warning> {
    // Whether it is may be open.
    let is_known = findings.open_end.is_none_or(|open_end| open_end.undecided.is_empty());
    let contacts = findings.contacts.iter().filter(|_| is_known);
    let lasting = contacts.filter(|contact| contact.impact.contact == Contact::Lasting);
    let has_faded = |element: &str| {
        let force = findings.solution.assembly().connection(element).and_then(|own| own.force);
        force.filter(|force| findings.solution.keeps(*force)).is_some_and(|force| {
            let force = findings.solution.signal(force);
            force.left_value(findings.solution.end()).abs() <= SLIGHT * force.bound()
        })
    };
    // A force that fades has no end, which is no matter to who does not ask for one.
    let is_asked = |element: &str| findings.measures.iter().any(|own| own.target == element);
    lasting
        .filter(|contact| is_asked(&contact.element) || !has_faded(&contact.element))
        .map(|lasting| Warning::StillInContact {
            element: lasting.element.clone(),
            end: lasting.impact.end,
        })
        .collect()
}

/// A contact whose release has not been seen.
fn contacts_that_pull(findings: &Findings<'_>) -> Option<Warning> {
    let solution = findings.solution;
    let tension =
        solution.tension().filter(|own| own.part > findings.task.settings.accuracy.strictest())?;
    let element = solution.assembly().connections[tension.connection].name.clone();
    Some(Warning::ReleaseMissed { element, pull: [tension.pull, tension.part], time: tension.time })
}

/// An impact of which it cannot be told whether it ends.
fn open_end(findings: &Findings<'_>) -> Option<Warning> {
    let OpenEnd { time, measures, .. } = findings.open_end?;
    let measures = measures.iter().map(|&at| findings.measures[at].key.clone()).collect();
    Some(Warning::OpenEnd { time: *time, measures, is_covered: findings.task.settings.estimate })
}

/// Peaks of forces and accelerations that lie outside the impact, and above those within.
fn harder_outside(findings: &Findings<'_>) -> Option<Warning> {
    let solution = findings.solution;
    let has_ended = |measure_report: &MeasureReport| {
        let is_of_impact = measure_report.window_wish == Some(WindowWish::Impact);
        is_of_impact
            && measure_report.window.is_some_and(|(from, to)| from > 0.0 || to < solution.end())
    };
    let is_limited = |own: &MeasureReport| {
        findings.task.settings.limits.iter().any(|limit| limit.key == own.key)
    };
    let is_looked_at = |own: &MeasureReport| {
        PEAKS.contains(&own.kind) || is_limited(own) && !OF_ONE_IMPACT.contains(&own.kind)
    };
    let read = findings.task.selected.iter().zip(findings.measures);
    let harder: Vec<Harder> = read
        .filter(|(_, measure)| has_ended(measure) && is_looked_at(measure))
        .filter_map(|(entry, measure)| {
            let most = measure.value?;
            let largest = largest_of_run(solution, entry)?;
            let value = largest.value.unwrap_or(f64::INFINITY);
            let margin = measure.error.unwrap_or(0.0).max(HARDER * most.abs());
            // What is but rounding in the impact has no peak there to be exceeded.
            let is_harder = value > most + margin && value > largest.noise;
            is_harder.then(|| Harder {
                measure: measure.key.clone(),
                // The seconds of an index are not told.
                unit: if measure.unit == "s" { "1" } else { measure.unit },
                within: most,
                outside: value,
                time: largest.time.unwrap_or_else(|| when_hardest(solution, entry)),
            })
        })
        .collect();
    (!harder.is_empty()).then_some(Warning::HarderOutside(harder))
}

/// What a measure of the impact is over the whole run.
fn largest_of_run(solution: &Solution<'_>, entry: &Selected) -> Option<Reading> {
    let over_run = |own: Value| match own {
        Value::Window(_) => Value::Window(WindowWish::Run),
        own => own,
    };
    let values: Vec<Value> = entry.measure.values().into_iter().map(over_run).collect();
    let of_run = entry.measure.with_values(&values).ok()?;
    Some(of_run.read(solution, entry.target))
}

/// When the force of an element, or the acceleration of a node, is largest in the run \[s\].
fn when_hardest(solution: &Solution<'_>, entry: &Selected) -> f64 {
    let window = WindowWish::Run;
    let peak = match entry.measure.applies_to() {
        Family::Element => PeakForce { window }.read(solution, entry.target),
        Family::Node => PeakAcceleration { window }.read(solution, entry.target),
    };
    peak.time.unwrap_or(0.0)
}

/// What is shaken or pushed off without a weight that brings it back.
fn flying_away(findings: &Findings<'_>) -> Option<Warning> {
    let solution = findings.solution;
    let is_struck = solution.assembly().has_impactor();
    if is_struck || findings.effects.contains(&Gravity::KIND) {
        return None;
    }
    let left = contacts::left_for_good(solution.assembly(), solution.trajectory());
    let (time, names) = left.into_iter().next()?;
    Some(Warning::NeverComesBack { names: names.map(str::to_owned), time })
}

fn accuracy(findings: &Findings<'_>) -> Vec<Warning> {
    let mut warnings = Vec::new();
    warnings.extend(unknown_errors(findings));
    let keys = |is_meant: fn(&MeasureReport) -> bool| {
        let meant = findings.measures.iter().filter(|measure| is_meant(measure));
        let keys: Vec<String> = meant.map(|meant| meant.key.clone()).collect();
        (!keys.is_empty()).then_some(keys)
    };
    let undecided = keys(|own| own.error.is_some_and(f64::is_infinite));
    warnings.extend(undecided.map(Warning::Undecided));
    warnings.extend(keys(|own| own.is_undetermined).map(Warning::Undetermined));
    let missed = findings.measures.iter().filter_map(|measure| {
        let reached = measure.relative_error().filter(|error| error.is_finite())?;
        let wish = findings.task.settings.accuracy.of(&measure.key);
        (measure.excess > 1.0).then(|| Missed {
            measure: measure.key.clone(),
            accuracy: [reached, wish],
            zero_within: might_be_zero(measure).map(|error| (error, measure.unit)),
        })
    });
    let (missed, obstacle): (Vec<Missed>, _) = (missed.collect(), findings.obstacle.cloned());
    if !missed.is_empty() {
        warnings.push(Warning::NotReached { missed, obstacle });
    }
    warnings
}

/// That nothing is known of any error.
fn unknown_errors(findings: &Findings<'_>) -> Option<Warning> {
    let mut valued = findings.measures.iter().filter(|measure| measure.value.is_some()).peekable();
    valued.peek().filter(|_| findings.task.settings.estimate)?;
    let is_none = valued.all(|own| own.error.is_none());
    is_none.then(|| Warning::ErrorsUnknown { obstacle: findings.obstacle.cloned() })
}

/// The error of a value that cannot be told from zero.
fn might_be_zero(measure: &MeasureReport) -> Option<f64> {
    let (value, error) = measure.value.zip(measure.error)?;
    (value.abs() <= error).then_some(error)
}

impl Through {
    fn of(solution: &Solution<'_>, name: &str, output: usize, thickness: f64) -> Option<Self> {
        if !solution.keeps(output) {
            return None;
        }
        let run = (0.0, solution.end());
        let compression = Compression::of(&solution.glance(output), run, thickness);
        compression.is_through().then(|| Self { name: name.to_owned(), compression })
    }
}

/// Pads that are pressed in by more than their thickness, and of those within a pad the worst one.
pub(crate) fn pressed_through(solution: &Solution<'_>) -> Vec<Warning> {
    let of_connection = |connection_outputs: &ConnectionOutputs| {
        let whole = connection_outputs.thickness.and_then(|thickness| {
            Through::of(
                solution,
                &connection_outputs.name,
                connection_outputs.deformation,
                thickness,
            )
        });
        let parts = connection_outputs.segments.iter().filter(|part| {
            !connection_outputs.thickness.is_some_and(|whole| is_as_thick(part.thickness, whole))
        });
        let parts: Vec<Through> = parts
            .filter_map(|part: &SegmentOutputs| match &part.place {
                SegmentPlace::Branch { path } => {
                    Through::of(solution, path, part.deformation, part.thickness)
                }
                SegmentPlace::Whole | SegmentPlace::Layer { .. } => None,
            })
            .collect();
        let others = parts.len().saturating_sub(1);
        let worst = parts
            .into_iter()
            .max_by(|one, other| one.compression.strain().total_cmp(&other.compression.strain()));
        let worst = worst.map(|through| Warning::PressedThrough { through, others });
        whole.map(|through| Warning::PressedThrough { through, others: 0 }).into_iter().chain(worst)
    };
    solution.assembly().connections.iter().flat_map(of_connection).collect()
}

/// Part of the span of a law beyond which it is not told that it is extrapolated: what is released at its first
/// point lies beyond it by the error of the solution, and the force there is that of the point.
const NEXT_TO_NOTHING: f64 = 1e-6;

/// Measured laws that are followed beyond their points: of each element the one that is followed
/// furthest on either side.
pub(crate) fn beyond_measured(solution: &Solution<'_>) -> Vec<Warning> {
    let assembly = solution.assembly();
    let of_connection = |connection_outputs: &ConnectionOutputs| {
        let parts = assembly.primitives.get(connection_outputs.primitives.clone()).unwrap_or(&[]);
        let beyond: Vec<Beyond> =
            parts.iter().flat_map(|part| Beyond::of(solution, part)).collect();
        let furthest = |is_pressed: bool| {
            let of_side = beyond.iter().filter(|own| own.is_pressed == is_pressed);
            let found = of_side.max_by(|one, other| one.excess.total_cmp(&other.excess));
            found.cloned().map(Warning::BeyondLaw)
        };
        [true, false].map(furthest).into_iter().flatten()
    };
    assembly.connections.iter().flat_map(of_connection).collect()
}

impl Beyond {
    fn of(solution: &Solution<'_>, part: &PrimitiveOutputs) -> Vec<Self> {
        let range = part.element.range().filter(|_| solution.keeps(part.deformation));
        let Some((first, last)) = range else { return Vec::new() };
        let deformation = solution.glance(part.deformation);
        let run = (0.0, solution.end());
        let size = if first.is_finite() { last - first } else { last };
        let noise = deformation.error.unwrap_or(0.0).max(NEXT_TO_NOTHING * size);
        let (deepest, longest) = (deformation.maximum(run), deformation.minimum(run));
        let name = || part.name.to_string();
        let pressed = (deepest.value > last + noise).then(|| Self {
            name: name(),
            is_pressed: true,
            excess: deepest.value - last,
            time: deepest.time,
            point: last,
            at_equator: part.element.ends_at_equator(),
        });
        // A law that begins flat is meant to have no more force before.
        let [before, there] = [longest.value, first].map(|at| part.element.force(at, 0.0));
        let pull = there - before;
        let is_told = longest.value < first - noise
            && pull > solution.doubt() * solution.glance(part.force).bound();
        let stretched = is_told.then(|| Self {
            name: name(),
            is_pressed: false,
            excess: first - longest.value,
            time: longest.time,
            point: first,
            at_equator: false,
        });
        pressed.into_iter().chain(stretched).collect()
    }
}
