//! What is odd about a scene as a whole, but not wrong; supports that drift away.

use std::collections::HashMap;

use dashpot_dae::Waveform;
use dashpot_network::{
    Network, Node, Start, Support,
    effects::Stop,
    parameters::{Dimension, Kind as _, ParameterKind, registered},
    waveforms::WAVEFORMS,
};
use dashpot_units::{STANDARD_GRAVITY, format_short};

use crate::{
    diagnostics::fault::Fault,
    models::notes::{ModelNote, Remark},
    sections::Reading,
    text::{
        document::{Content, Entry, Item, value_of},
        library::tables::{file_named, is_table},
        source::Place,
    },
};

/// Warns of what is odd in a scene that has been read without errors.
pub(crate) fn review(reading: &Reading<'_>, network: &Network, duration: f64) {
    unused_values(reading);
    still(reading, network);
    deep_stops(reading, network);
    let mut ends = vec![[0_usize; 2]; network.nodes().count()];
    for connection in network.connections() {
        connection.between.iter().enumerate().for_each(|(end, id)| ends[id.index()][end] += 1);
    }
    let entries: HashMap<&str, &Entry> =
        reading.section("nodes").iter().map(|own| (own.key.as_str(), own)).collect();
    for (id, node) in network.nodes().filter(|(id, _)| *id != network.ground()) {
        let Some(&entry) = entries.get(node.name.as_str()) else { continue };
        let [starting, ending] = ends[id.index()];
        let is_driven = matches!(node.support, Support::Prescribed(_));
        if starting + ending == 0 && !is_driven {
            let message = format!("no element touches `{}`", node.name);
            let help = "name it in the `between` of an element, or remove it";
            reading.faults.warning(entry.key_place, Fault::odd(message, help));
        }
        if ending == 0 && starting > 0 {
            moving_away(reading, entry, node);
        }
    }
    let driving = Driving::of(network);
    for (section, key) in
        [("loads", "force"), ("nodes", "motion"), ("nodes", "velocity"), ("nodes", "acceleration")]
    {
        for own in reading.section(section) {
            let driven = value_of(own, key).filter(|own| own.table().is_some());
            let Some(driven) = driven else { continue };
            time_table(reading, driven, duration);
            if let Some(waveform) = driving.named(section, &own.key) {
                file(reading, driven, waveform, duration);
                // What nothing touches may go where it will.
                let is_held = network
                    .nodes()
                    .any(|(id, node)| node.name == own.key.as_str() && ends[id.index()] != [0, 0]);
                if key == "acceleration" && is_held {
                    drift(reading, (&own.key, driven), waveform, duration);
                }
            }
        }
    }
}

fn unused_values(reading: &Reading<'_>) {
    let entries = reading.library.section("values").and_then(|entry| entry.item.table());
    for entry in entries.unwrap_or(&[]) {
        let known = reading.library.values().get(entry.key.as_str());
        if known.is_some_and(|known| !known.is_used.get()) {
            let message = format!("nothing uses the value `{}`", entry.key);
            let help = format!("write \"{}\" where it is meant, or remove it", entry.key);
            reading.faults.warning(entry.key_place, Fault::odd(message, help));
        }
    }
}

/// Warns of stops that are met only when the padding is used up.
fn deep_stops(reading: &Reading<'_>, network: &Network) {
    for stop in network.effects().iter().filter_map(|effect| effect.of_kind::<Stop>()) {
        let name = stop.element.as_str();
        let element = network.connections().iter().find(|connection| connection.name == name);
        let thickness = element.and_then(|element| element.thickness);
        let Some((at, thickness)) = stop.at.zip(thickness) else { continue };
        if at > thickness {
            let kind = reading.section("effects").iter().find(|own| own.key == Stop::KIND);
            let own = kind.and_then(|kind| kind.item.table()?.iter().find(|own| own.key == name));
            let place = own.and_then(|own| value_of(own, "at")).map(|item| item.place);
            let [at, thickness] =
                [at, thickness].map(|own| format_short(own, Dimension::LENGTH, 4));
            let message = format!(
                "the stop of `{name}` at {at} lies deeper than its thickness of {thickness}"
            );
            let help = "the padding is used up before the stop is met: give a smaller `at`, or \
                        leave it out for the thickness";
            reading.faults.warning(place, Fault::odd(message, help));
        }
    }
}

/// A weight that adds more than this part to the energy of an impact is told of.
const HEAVY: f64 = 0.02;

/// What is left out of a drop, or of an impact that may go down, where gravity is off.
pub(crate) fn weightless(network: &Network) -> Vec<ModelNote> {
    if network.effects().iter().any(|effect| effect.gravity().is_some()) {
        return Vec::new();
    }
    let mut notes = Vec::new();
    for (id, node) in network.nodes().filter(|own| own.1.mass > 0.0) {
        let what = match node.start {
            Start::Drop(height) if height > 0.0 => Remark::Weightless(height),
            Start::Velocity(speed) if speed > 0.0 => {
                let pads = network.connections().iter().filter(|own| own.between.contains(&id));
                let thickness = pads.filter_map(|own| own.thickness).fold(0.0, f64::max);
                let energy = node.mass * STANDARD_GRAVITY * thickness;
                let part = energy / (0.5 * node.mass * speed * speed);
                if part < HEAVY {
                    continue;
                }
                Remark::WeightLeftOut { energy, part }
            }
            _ => continue,
        };
        notes.push(ModelNote { subject: format!("node `{}`", node.name), what, until: None });
    }
    notes
}

/// That weight pulls away from the support, where it does.
pub(crate) fn upward(network: &Network) -> Option<ModelNote> {
    let value = network.effects().iter().find_map(|effect| effect.gravity())?;
    (value < 0.0).then(|| ModelNote {
        subject: "gravity".to_owned(),
        what: Remark::Upward(value),
        until: None,
    })
}

/// Whether a node begins with a speed that is not zero.
fn starts(node: &Node) -> bool {
    match node.start {
        Start::Rest => false,
        Start::Velocity(speed) => speed != 0.0,
        Start::Drop(height) => height > 0.0,
    }
}

/// Nodes that are impactors by a speed of zero, where another one strikes.
pub(crate) fn resting_impactors(network: &Network) -> Vec<ModelNote> {
    let Some((_, other)) = network.nodes().find(|own| starts(own.1)) else { return Vec::new() };
    let resting = network.nodes().filter(|own| own.1.is_impactor() && !starts(own.1));
    let note = |(_, node): (_, &Node)| ModelNote {
        subject: format!("node `{}`", node.name),
        what: Remark::StartsAtRest(other.name.clone()),
        until: None,
    };
    resting.map(note).collect()
}

/// Warns of a network in which all that begins at rest stays at rest.
fn still(reading: &Reading<'_>, network: &Network) {
    let is_driven = |node: &Node| matches!(node.support, Support::Prescribed(_));
    let moves = !network.loads().is_empty()
        || network.nodes().any(|(_, node)| starts(node) || is_driven(node) || node.position != 0.0)
        || network
            .effects()
            .iter()
            .any(|effect| effect.gravity().is_some() && !effect.starts_in_balance());
    if !moves {
        let message = "nothing moves: no node has `velocity`, `drop` or `position`, there is no load and no motion";
        let place = reading.library.section("nodes").map(|entry| entry.key_place);
        let help = "for example `velocity = \"10 m/s\"` at the node that strikes";
        reading.faults.warning(place, Fault::odd(message, help));
    }
}

/// Warns of an impactor that is at the outer end of all its elements and moves outward.
fn moving_away(reading: &Reading<'_>, entry: &Entry, node: &Node) {
    if let Start::Velocity(speed) = node.start
        && speed < 0.0
    {
        let message =
            format!("`{}` moves away from the support: positive is towards it", node.name);
        let place = value_of(entry, "velocity").map_or(entry.key_place, |item| item.place);
        let help = "turn its sign; if it comes from the other side, turn the `between` of what it \
                    strikes instead";
        reading.faults.warning(place, Fault::odd(message, help));
    }
}

/// Warns of models that stand for their description only up to a time within the run.
pub(crate) fn outlasted(reading: &Reading<'_>, notes: &[ModelNote], duration: f64) {
    let run = reading.section("run").iter().find(|own| own.key == "duration");
    let place = run.map(|run| run.item.place);
    for ModelNote { subject, until, .. } in notes {
        let Some(until) = until.filter(|until| *until < duration) else { continue };
        let [until, end] = [until, duration].map(|time| format_short(time, Dimension::TIME, 4));
        let message =
            format!("{subject} stands for its spectrum up to {until}; the run lasts {end}");
        let help = "give the spectrum a later `to`";
        reading.faults.warning(place, Fault::odd(message, help));
    }
}

/// What drives loads and nodes, by name.
struct Driving<'n> {
    loads: HashMap<&'n str, &'n Waveform>,
    nodes: HashMap<&'n str, &'n Waveform>,
}

impl<'n> Driving<'n> {
    fn of(network: &'n Network) -> Self {
        let loads = network.loads().iter().map(|load| (load.name.as_str(), &load.force));
        let nodes = network.nodes().filter_map(|(_, node)| match &node.support {
            Support::Prescribed(motion) => Some((node.name.as_str(), motion)),
            _ => None,
        });
        Self { loads: loads.collect(), nodes: nodes.collect() }
    }

    fn named(&self, section: &str, name: &str) -> Option<&'n Waveform> {
        if section == "loads" { self.loads.get(name) } else { self.nodes.get(name) }.copied()
    }
}

/// Warns of rows of a file that have no influence.
fn file(reading: &Reading<'_>, driven: &Item, waveform: &Waveform, duration: f64) {
    let table = driven.table().unwrap_or(&[]).iter().find(|own| is_table(&own.key));
    let Some(named) = table.and_then(|table| file_named(&table.item)) else { return };
    let count = waveform.breakpoints().count();
    let late = waveform.breakpoints().filter(|time| *time > duration).count();
    if late > 0 {
        late_points(reading, named.place, (late, count, "times"), duration);
    }
}

fn late_points(
    reading: &Reading<'_>,
    place: Place,
    (late, count, what): (usize, usize, &str),
    duration: f64,
) {
    let end = format_short(duration, Dimension::TIME, 4);
    let verb = if late == 1 { "lies" } else { "lie" };
    let message = format!("{late} of {count} {what} {verb} after the end of the run at {end}");
    let help = "give a longer `duration` in [run], or check the unit of the times";
    reading.faults.warning(place, Fault::odd(message, help));
}

/// Warns of points of a table of time that have no influence.
fn time_table(reading: &Reading<'_>, driven: &Item, duration: f64) {
    for own in driven.table().unwrap_or(&[]) {
        let kind = registered(WAVEFORMS, &own.key);
        let parameter = kind.and_then(|kind| {
            kind.parameters.iter().find(|parameter| parameter.kind == ParameterKind::TimeTable)
        });
        let Some(parameter) = parameter else { continue };
        let item = value_of(own, parameter.name).unwrap_or(&own.item);
        let Content::List(points) = &item.value else { continue };
        if points.len() == 1 {
            let message = "a table with one point is a constant for ever";
            let help = "give at least two points, or write `constant`";
            reading.faults.warning(item.place, Fault::odd(message, help));
        }
        let is_late = |point: &&Item| {
            let Content::List(pair) = &point.value else { return false };
            let time = pair.first().and_then(|time| reading.quantities().peek(time));
            time.is_some_and(|time| time > duration)
        };
        let late = points.iter().filter(is_late).count();
        if late > 0 {
            late_points(reading, item.place, (late, points.len(), "points"), duration);
        }
    }
}

/// How often a drift exceeds the way to and fro about it.
const DRIFT: f64 = 3.0;
/// Points at which a motion is looked at.
const POINTS: u32 = 2000;

/// Warns of an acceleration whose mean velocity is not zero, so that the support drifts away.
fn drift(reading: &Reading<'_>, (name, driven): (&str, &Item), motion: &Waveform, duration: f64) {
    let mut entries = driven.table().unwrap_or(&[]).iter();
    let Some(entry) = entries.find(|entry| registered(WAVEFORMS, &entry.key).is_some()) else {
        return;
    };
    let is_sine = entry.key == "sine";
    // A shock of one sign is meant to leave its support with a speed; what starts with one is meant to travel.
    let is_shaken = is_sine || is_table(&entry.key) && shakes(motion);
    let travels = motion.piece_at(0.0).derivative(1, 0.0) != 0.0;
    if !is_shaken || travels {
        return;
    }
    let end = motion.value(duration);
    let aside = (0..=POINTS).map(|at| {
        let share = f64::from(at) / f64::from(POINTS);
        (motion.value(share * duration) - share * end).abs()
    });
    // A constant acceleration goes one way, too.
    let aside = aside.fold(0.0, f64::max);
    if duration <= 0.0 || end.abs() <= DRIFT * aside {
        return;
    }
    let millimetres = 1e3 * end;
    let speed = format_short(end / duration, Dimension::VELOCITY, 3);
    let run = format_short(duration, Dimension::TIME, 4);
    let message = format!(
        "the acceleration makes `{name}` drift away: {millimetres:.3} mm in {run}, at {speed} in the \
         mean"
    );
    let help = if is_sine {
        "a sine that is to shake about one place begins with its peak: `phase = \"90 deg\"`; or give its \
         displacement as `motion`"
    } else {
        "take its mean off the record, so that velocity and displacement end near zero, or give the \
         displacement as `motion`"
    };
    reading.faults.warning(entry.item.place, Fault::odd(message, help));
}

/// Whether the acceleration of a motion has both signs.
fn shakes(motion: &Waveform) -> bool {
    let mut signs = motion.pieces().iter().map(|piece| piece.derivative(2, piece.start));
    signs.clone().any(|sign| sign > 0.0) && signs.any(|sign| sign < 0.0)
}
