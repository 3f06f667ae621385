//! `[nodes]`: points with one displacement; `[loads]`: forces on them.

use dashpot_dae::{Piece, Waveform};
use dashpot_network::{
    Network, Node, Start, Support,
    parameters::{Dimension, InvalidParameter, Range},
};

use super::Reading;
use crate::{
    diagnostics::fault::Fault,
    text::{
        document::{Content, Entry},
        table::{check_name, wrong_type},
    },
};

/// Reads the nodes into `network`.
pub(crate) fn read_nodes(reading: &mut Reading<'_>, network: &mut Network) {
    reading.nodes.insert("ground", network.ground());
    for entry in reading.section("nodes") {
        if entry.key == "ground" {
            let reason = "`ground` is the fixed node that every scene has";
            let fault = Fault::BadName { name: entry.key.to_string(), reason };
            reading.faults.error(entry.key_place, fault);
            continue;
        }
        check_name(&entry.key, entry.key_place, reading.faults);
        // A faulty node is known by its name all the same, so that its fault is told once.
        let node = read_node(reading, entry).unwrap_or_else(|| Node::massless(&*entry.key));
        reading.nodes.insert(&entry.key, network.add_node(node));
    }
}

fn read_node<'d>(reading: &Reading<'d>, entry: &'d Entry) -> Option<Node> {
    let table = reading.table(entry, "node")?;
    let quantities = reading.quantities();
    let range = Range::NonNegative;
    let mass = table
        .take("mass")
        .map(|mass| quantities.within(range, "mass", &mass.item, Dimension::MASS));
    let [velocity, drop, energy] =
        one_of(reading, ["velocity", "drop", "energy"].map(|key| (key, table.take(key))));
    // A function of time gives the motion.
    let (moving, velocity) = match velocity {
        Some(own) if own.item.table().is_some() => (Some(own), None),
        own => (None, own),
    };
    let velocity = velocity.map(|own| quantities.read(&own.item, Dimension::VELOCITY));
    let drop = drop.map(|drop| {
        quantities.within(range, "drop", &drop.item, Dimension::LENGTH).map(Start::Drop)
    });
    let energy = energy.map(|energy| {
        let value = quantities.within(range, "energy", &energy.item, Dimension::ENERGY)?;
        if mass.is_none_or(|mass| mass == Some(0.0)) {
            let (key, owner) = ("mass".to_owned(), format!("node `{}` with `energy`", entry.key));
            let example = "mass = \"5 kg\"".to_owned();
            reading.faults.missing(energy.key_place, Fault::MissingKey { key, owner, example });
        }
        Some(Start::Velocity((2.0 * value / mass??).sqrt()))
    });
    let position = table
        .take("position")
        .map(|own| quantities.of("position").read(&own.item, Dimension::LENGTH));
    let given = ["fixed", "motion", "acceleration"].map(|key| (key, table.take(key)));
    let [fixed, motion, acceleration, moving] =
        one_of(reading, [given[0], given[1], given[2], ("velocity", moving)]);
    let is_fixed = fixed.map(|fixed| {
        let on = matches!(fixed.item.value, Content::Switch(true));
        if !on {
            wrong_type(&fixed.item, "`fixed`", "`true`, or left out", reading.faults);
        }
        on
    });
    let motion = motion.map(|motion| reading.waveform(motion, Dimension::LENGTH));
    let shaken = acceleration.map(|own| displacement(reading, own, velocity.flatten()));
    let moved = moving.map(|own| integrated(reading, own));
    // The velocity at the start is part of the motion.
    let velocity = velocity.filter(|_| shaken.is_none()).map(|own| own.map(Start::Velocity));
    table.finish();
    let support = match (is_fixed, motion.or(shaken).or(moved)) {
        (Some(_), _) => Support::Fixed,
        (None, Some(motion)) => Support::Prescribed(motion?),
        (None, None) => Support::Free,
    };
    Some(Node {
        name: entry.key.to_string(),
        mass: mass.unwrap_or(Some(0.0))?,
        support,
        start: velocity.or(drop).or(energy).unwrap_or(Some(Start::Rest))?,
        position: position.unwrap_or(Some(0.0))?,
    })
}

/// The entries of keys that exclude each other, with an error where several are given.
fn one_of<'d, const N: usize>(
    reading: &Reading<'_>,
    keys: [(&'static str, Option<&'d Entry>); N],
) -> [Option<&'d Entry>; N] {
    let mut given = keys.iter().filter_map(|(key, entry)| entry.map(|entry| (*key, entry)));
    if let (Some((first, _)), Some((second, entry))) = (given.next(), given.next()) {
        reading.faults.error(entry.key_place, Fault::Exclusive { first, second });
    }
    keys.map(|(_, entry)| entry)
}

/// The displacement of a node at `t = 0` that has the acceleration in `entry` from then on, and begins at rest or with a
/// velocity.
fn displacement<'d>(
    reading: &Reading<'d>,
    entry: &'d Entry,
    velocity: Option<f64>,
) -> Option<Waveform> {
    let acceleration = reading.waveform(entry, Dimension::ACCELERATION)?;
    let twice = acceleration.motion(velocity.unwrap_or(0.0));
    without_closed_form(reading, ("acceleration", entry), &acceleration, twice)
}

/// The displacement of a node that has the velocity in `entry` from `t = 0` on.
fn integrated<'d>(reading: &Reading<'d>, entry: &'d Entry) -> Option<Waveform> {
    let velocity = reading.waveform(entry, Dimension::VELOCITY)?;
    without_closed_form(reading, ("velocity", entry), &velocity, velocity.integral())
}

/// The motion of a given function, or what keeps it from having one.
fn without_closed_form(
    reading: &Reading<'_>,
    (key, entry): (&'static str, &Entry),
    given: &Waveform,
    motion: Option<Waveform>,
) -> Option<Waveform> {
    if motion.is_none() {
        let is_swept = given.pieces().iter().any(Piece::is_swept);
        let is_cubic = given.pieces().iter().any(|own| !own.is_constant(1) && !own.is_wave());
        let (range, found) = if is_swept || is_cubic {
            let found = if is_swept { "a chirp" } else { "a formula with powers of t" };
            ("such that its displacement has a closed form", found)
        } else {
            ("such that its displacement fits into double precision", "too large")
        };
        let fault = Fault::Invalid(InvalidParameter::new(key, range, found));
        let fault = if is_swept || is_cubic {
            fault.with_help(format!("give it as `motion`, a displacement, or the {key} as a table"))
        } else {
            fault
        };
        reading.faults.error(entry.item.place, fault);
    }
    motion
}

/// Reads the loads into `network`.
pub(crate) fn read_loads(reading: &Reading<'_>, network: &mut Network) {
    for entry in reading.section("loads") {
        check_name(&entry.key, entry.key_place, reading.faults);
        read_load(reading, entry, network);
    }
}

fn read_load<'d>(reading: &Reading<'d>, entry: &'d Entry, network: &mut Network) -> Option<()> {
    if entry.item.table().is_none() {
        note_bare_force(reading, entry);
        return None;
    }
    let table = reading.table(entry, "load")?;
    let node = table.require("on", "on = \"head\"").and_then(|own| reading.node(&own.item));
    let example = "force = { half-sine = { peak = \"2 kN\", duration = \"10 ms\" } }";
    let force =
        table.require("force", example).and_then(|own| reading.waveform(own, Dimension::FORCE));
    table.finish();
    network.add_load(&*entry.key, node?, force?);
    Some(())
}

/// Notes a load that is not a table; its name is that of a node where the force alone was given.
fn note_bare_force(reading: &Reading<'_>, entry: &Entry) {
    let Entry { key, item, .. } = entry;
    let force = match &item.value {
        Content::Text(text) => text.to_string(),
        Content::Number(digits) => format!("{digits} N"),
        _ => "2 kN".to_owned(),
    };
    let node = if reading.nodes.contains_key(key.as_str()) { key } else { "head" };
    let fault = Fault::WrongType {
        what: format!("load `{key}`"),
        expected: "a table".to_owned(),
        found: item.type_name(),
    };
    let help = format!(
        "write [loads.name] with `on = \"{node}\"` and `force = {{ constant = \"{force}\" }}`"
    );
    reading.faults.error(item.place, fault.with_help(help));
}
