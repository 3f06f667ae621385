//! What a report says of what was left out, and of the segments of layers.

use std::time::Duration;

use dashpot_network::Influence;
use serde::Serialize;

use crate::RunError;

/// What was left out of a run, and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Partial {
    /// The bound: the part of its value, or of a twentieth of its size, by which a measure may move.
    pub bound: f64,
    /// What was left out, the largest influence first.
    pub left_out: Vec<Neglected>,
    /// What stayed although its estimate was below the bound.
    pub put_back: Vec<PutBack>,
    /// How far each measure is moved by all that was left out together; none where nothing was.
    pub costs: Vec<Cost>,
    /// Measures of things that only what was left out brings, and that nobody asked for.
    pub unreported: Vec<String>,
    /// What finding this out took.
    pub verification: Verification,
}

/// An effect that was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Neglected {
    /// What it is called, for instance `gravity` or `inertia of padding`.
    pub effect: String,
    /// The largest of its dimensionless numbers.
    pub influence: Influence,
    /// The measure that it moves the most by itself, where it was left out alone.
    pub alone: Option<Cost>,
}

/// An effect that stayed although its estimate was below the bound.
#[derive(Debug, Clone, PartialEq)]
pub struct PutBack {
    /// What it is called.
    pub effect: String,
    /// The largest of its dimensionless numbers.
    pub influence: Influence,
    /// Why it stayed.
    pub why: Why,
}

/// Why an effect stayed.
#[derive(Debug, Clone, PartialEq)]
pub enum Why {
    /// By itself, or with what else was left out, it moves this measure by more than the bound.
    Moves(Cost),
    /// What is asked of the run does not exist without it, or the run fails.
    Fails(RunError),
    /// An element that can part would pull, as if glued.
    Pulls {
        /// Its name.
        element: String,
        /// From when on \[s\].
        time: f64,
    },
}

/// Work beyond the solution that is reported.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Verification {
    /// Further runs, each with its own error estimates.
    pub solves: usize,
    /// Wall-clock time of those.
    pub wall: Duration,
}

impl Partial {
    /// The measure that what was left out moves the most.
    pub fn worst(&self) -> Option<&Cost> {
        self.costs.iter().max_by(|one, other| one.most().total_cmp(&other.most()))
    }
}

/// How far a measure is moved by what was left out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cost {
    /// Key of the measure, for instance `padding.peak-force`.
    pub measure: String,
    /// The difference over the larger of both values, or over a twentieth of the larger size where the values
    /// are next to nothing beside it; infinite where only one has a value.
    pub relative: f64,
    /// How far it may be off, by the errors of both, in the same parts; 0 where they were not estimated.
    pub uncertainty: f64,
}

impl Cost {
    /// The largest move that the errors allow.
    pub fn most(&self) -> f64 {
        self.relative + self.uncertainty
    }

    /// The one of both that is larger.
    pub(crate) fn larger(self, other: Self) -> Self {
        if other.most() > self.most() { other } else { self }
    }
}

/// The segments of layers beside other numbers of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Segmentation {
    /// Segments of all pads.
    pub segments: usize,
    /// Those of the solution that they were compared with.
    #[serde(rename = "compared_with")]
    pub others: usize,
}
