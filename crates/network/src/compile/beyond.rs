//! Tables that a run reaches beyond.

use dashpot_dae::{Given, Piece};

use crate::{Network, NetworkError, NetworkErrors, Support, parameters::Dimension};

/// A run that is longer by no more than this part is as long.
const ROUNDING: f64 = 1e-12;
/// Part of a table's largest value, or of its largest speed, from which on one counts.
const COUNTS: f64 = 1e-3;

/// What a run does with a table where nobody has said what holds beyond its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unsaid {
    /// It holds a first value other than zero from the start of the run.
    First,
    /// It holds a last value other than zero to the end of the run.
    Last,
    /// A motion has a speed at its last point \[m/s\] and stops there.
    Stops(f64),
}

/// A table that holds its first or its last value within a run.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldTable {
    /// The load, or the node that is moved.
    pub name: String,
    /// Whether it is a formula with an end, and not a table.
    pub is_formula: bool,
    /// What the table is of: a force, a displacement or an acceleration.
    pub dimension: Dimension,
    /// What is told.
    pub what: Unsaid,
    /// Time of its first, or its last point \[s\].
    pub time: f64,
    /// Its value there, in SI units.
    pub value: f64,
    /// Length of the run \[s\].
    pub duration: f64,
}

impl HeldTable {
    /// What it does; `show` writes quantities.
    pub fn message(&self, show: impl Fn(f64, Dimension) -> String) -> String {
        let time = show(self.time, Dimension::TIME);
        let run = show(self.duration, Dimension::TIME);
        let value = show(self.value, self.dimension);
        let of = match self.dimension {
            Dimension::FORCE => "the load",
            Dimension::LENGTH => "the motion of",
            _ => "the acceleration of",
        };
        let what = if self.is_formula { "formula" } else { "table" };
        let table = format!("the {what} of {of} `{}`", self.name);
        match self.what {
            Unsaid::First => {
                format!(
                    "{table} begins at {time} with {value}, which is held from the start of the run"
                )
            }
            Unsaid::Last => {
                format!(
                    "{table} ends at {time} with {value}, which is held to the end of the run at {run}"
                )
            }
            Unsaid::Stops(speed) => {
                let speed = show(speed, Dimension::VELOCITY);
                format!(
                    "{table} ends at {time} at {speed}: from there to the end of the run at {run} it is \
                     held at {value}, so it stops dead"
                )
            }
        }
    }

    /// What to write instead.
    pub fn help(&self) -> &'static str {
        match self.what {
            _ if self.is_formula => {
                "let `until` reach the end of the run; there `min(t, 5 ms)` in place of `t` is what holds a \
                 value from 5 ms on, and a sum or product with `min` or `max` what ends it"
            }
            Unsaid::Stops(_) => {
                "let the motion come to rest, or the run end with it; `outside = \"hold\"` says that it \
                 is meant"
            }
            _ => {
                "write `outside = \"zero\"` for zero there, or `outside = \"hold\"` if that is meant"
            }
        }
    }
}

/// The tables that hold a value in a run of `duration` \[s\] although nobody says so.
/// Errors: tables that must not be used beyond their points, in a run that is longer.
pub(super) fn held(network: &Network, duration: f64) -> Result<Vec<HeldTable>, NetworkErrors> {
    let loads = network.loads.iter().map(|load| (&load.name, Dimension::FORCE, &load.force));
    let motions = network.nodes.iter().filter_map(|node| match &node.support {
        Support::Prescribed(motion) => Some((&node.name, Dimension::LENGTH, motion)),
        _ => None,
    });
    let (mut held, mut errors) = (Vec::new(), Vec::new());
    for (name, dimension, waveform) in loads.chain(motions) {
        let Some(given) = waveform.given() else { continue };
        let dimension = if given.integrals == 2 { Dimension::ACCELERATION } else { dimension };
        let is_late = given.from > 0.0;
        let is_short = given.to < duration * (1.0 - ROUNDING);
        if given.is_strict {
            let is_load = dimension == Dimension::FORCE;
            let Given { from, to, .. } = given;
            let error =
                NetworkError::OutsideTable { name: name.clone(), is_load, from, to, duration };
            errors.extend((is_late || is_short).then_some(error));
            continue;
        }
        let pieces = waveform.pieces();
        // That one point is a constant is told where it is read.
        let [.., moving, last] = pieces else { continue };
        if given.from >= given.to {
            continue;
        }
        let counts = |piece: &Piece, order: u32, time: f64| {
            let value = piece.derivative(order, time);
            (value.abs() > COUNTS * largest(pieces, order)).then_some(value)
        };
        let order = given.integrals;
        let told = |what, time, value| {
            let is_formula = given.is_formula;
            HeldTable { name: name.clone(), is_formula, dimension, what, time, value, duration }
        };
        if let Some(value) = counts(&pieces[0], order, given.from).filter(|_| is_late) {
            held.push(told(Unsaid::First, given.from, value));
        }
        if !is_short {
            continue;
        }
        let (time, value) = (given.to, last.derivative(order, given.to));
        let what = if dimension == Dimension::LENGTH {
            counts(moving, 1, time).map(Unsaid::Stops)
        } else {
            counts(last, order, time).map(|_| Unsaid::Last)
        };
        held.extend(what.map(|what| told(what, time, value)));
    }
    if errors.is_empty() { Ok(held) } else { Err(NetworkErrors(errors)) }
}

/// The largest absolute value of a derivative of straight lines.
fn largest(pieces: &[Piece], order: u32) -> f64 {
    let ends = pieces.windows(2).flat_map(|pair| {
        let time = pair[1].start;
        [pair[0].derivative(order, time), pair[1].derivative(order, time)]
    });
    ends.map(f64::abs).fold(0.0, f64::max)
}
