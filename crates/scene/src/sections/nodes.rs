//! `[nodes]`: points with one displacement.

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
    let mass = table.take("mass").map(|table| {
        let check = |mass| Range::NonNegative.check("mass", mass);
        quantities.of("mass").read_checked(&table.item, Dimension::MASS, check)
    });
    let velocity = table.take("velocity");
    let drop = table.take("drop");
    if let (Some(_), Some(drop)) = (velocity, drop) {
        let fault = Fault::Exclusive { first: "velocity", second: "drop" };
        reading.faults.error(drop.key_place, fault);
    }
    let velocity = velocity
        .map(|velocity| quantities.read(&velocity.item, Dimension::VELOCITY).map(Start::Velocity));
    let drop = drop.map(|drop| {
        let check = |height| Range::NonNegative.check("drop", height);
        let height = quantities.of("drop").read_checked(&drop.item, Dimension::LENGTH, check);
        height.map(Start::Drop)
    });
    let supports = ["fixed", "motion", "acceleration"].map(|key| (key, table.take(key)));
    let mut given = supports.iter().filter_map(|(key, entry)| entry.map(|entry| (*key, entry)));
    if let (Some((first, _)), Some((second, entry))) = (given.next(), given.next()) {
        reading.faults.error(entry.key_place, Fault::Exclusive { first, second });
    }
    let [fixed, motion, acceleration] = supports.map(|(_, entry)| entry);
    let is_fixed = fixed.map(|fixed| {
        let on = matches!(fixed.item.value, Content::Switch(true));
        if !on {
            wrong_type(&fixed.item, "`fixed`", "`true`, or left out", reading.faults);
        }
        on
    });
    let motion = motion.map(|motion| reading.waveform(motion, Dimension::LENGTH));
    let shaken = acceleration.map(|acceleration| displacement(reading, acceleration));
    table.finish();
    let support = match (is_fixed, motion.or(shaken)) {
        (Some(_), _) => Support::Fixed,
        (None, Some(motion)) => Support::Prescribed(motion?),
        (None, None) => Support::Free,
    };
    Some(Node {
        name: entry.key.to_string(),
        mass: mass.unwrap_or(Some(0.0))?,
        support,
        start: velocity.or(drop).unwrap_or(Some(Start::Rest))?,
    })
}

/// The displacement of a node at rest at `t = 0` that has the acceleration in `entry` from then on.
fn displacement<'d>(reading: &Reading<'d>, entry: &'d Entry) -> Option<Waveform> {
    let acceleration = reading.waveform(entry, Dimension::ACCELERATION)?;
    let twice = acceleration.integral().and_then(|velocity| velocity.integral());
    if twice.is_none() {
        let is_swept = acceleration.pieces().iter().any(Piece::is_swept);
        let (range, found) = if is_swept {
            ("such that its displacement has a closed form", "a chirp")
        } else {
            ("such that its displacement fits into double precision", "too large")
        };
        let fault = Fault::Invalid(InvalidParameter::new("acceleration", range, found));
        let fault = if is_swept {
            fault.with_help(
                "give the chirp as `motion`, a displacement, or its acceleration as a table",
            )
        } else {
            fault
        };
        reading.faults.error(entry.item.place, fault);
    }
    twice
}
