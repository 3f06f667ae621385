//! What is to be said about models and scenes, besides errors and warnings.

use std::{cell::RefCell, fmt};

use dashpot_network::{composites::CompositeNote, parameters::Dimension};
use dashpot_units::format_short;
use thiserror::Error;

use crate::{curves::CurveChange, tables::LeftOut};

/// A remark on a model or on a part of a scene, and what that is.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelNote {
    /// What it is about: "model `felt`", "element `padding`".
    pub subject: String,
    /// The remark.
    pub what: Remark,
    /// Time up to which the model stands for its description \[s\]; `None` for any time.
    pub until: Option<f64>,
}

dashpot_units::words! {
    /// What is to be said about a model or a part of a scene.
    #[derive(Debug, Clone, PartialEq, Error)]
    pub enum Remark, fn kind(&self) {
        /// How near a model comes to its description.
        #[error("{note}{}", .factor.map_or(String::new(), |own| format!(", before its times are multiplied by {own:.3e}")))]
        Composite {
            /// Its remark.
            note: CompositeNote,
            /// By what its times are multiplied afterwards, where they are.
            factor: Option<f64>,
        } = "composite",
        /// The times of a model are multiplied.
        #[error("`{word}` multiplies its times by {factor:.3e}")]
        Shift {
            /// Word for what does so.
            word: &'static str,
            /// The factor.
            factor: f64,
        } = "shift",
        /// Several things have the name of the model.
        #[error(
            "the name is also that of another; `models.{0}`, `materials.{0}` and \
             `elements.{0}` tell them apart"
        )]
        SharedName(String) = "shared-name",
        /// A node is dropped from a height \[m\], and has no weight.
        #[error(
            "dropped from {} with gravity off: it begins at touch with the speed of the fall, \
             weighs nothing, and never falls back on what it has left; `gravity = {{}}` under \
             [effects] gives it its weight",
            format_short(*.0, Dimension::LENGTH, 4)
        )]
        Weightless(f64) = "weightless",
        /// A node strikes with gravity off, where its weight is not little.
        #[error(
            "gravity is off: if it moves downwards, its weight does work of {} over the thickness, {} \
             the energy; `gravity = {{}}` under [effects] counts it",
            format_short(*.energy, Dimension::ENERGY, 3),
            match *.part {
                ..10.0 => format!("{:.1} % of", 100.0 * .part),
                10.0..1e3 => format!("{:.0} times", .part),
                _ => "far more than".to_owned(),
            }
        )]
        WeightLeftOut {
            /// What the weight adds over the thickness of the pad, if the impact goes down \[J\].
            energy: f64,
            /// The same in parts of the energy with which it strikes.
            part: f64,
        } = "weight-left-out",
        /// A node starts at 0 m/s beside others that move, and is an impactor by that.
        #[error(
            "it starts at 0 m/s, and is an impactor by that as `{0}` is: impacts are measured by its motion as well; leave \
             `velocity` out for a body that rests"
        )]
        StartsAtRest(String) = "starts-at-rest",
        /// The curve of a law is not that of the rows of its file.
        #[error("{0}")]
        Curve(CurveChange) = "curve",
        /// The area of a pad is constant where a standard loads one that grows.
        #[error(
            "{standard} lays it on a dome with the radius {radius}: the area that is loaded grows, and a \
             constant `area` may be wrong by a factor; `pressed-by = {{ shape = \"dome\", radius = \
             \"{radius}\", diameter = … }}` in its place follows it",
            radius = format_short(*.dome, Dimension::LENGTH, 4)
        )]
        ConstantArea {
            /// The standard.
            standard: &'static str,
            /// Radius \[m\] of the dome on which the pad lies.
            dome: f64,
        } = "constant-area",
        /// Lines of a file are no part of its table.
        #[error("{0}")]
        LeftOut(LeftOut) = "lines-left-out",
        /// Lines of a record behind its largest deformation are no part of a law of one branch.
        #[error(
            "{}: `{curve}` is a curve of loading alone",
            match .lines {
                [first, last] if first == last => {
                    format!("line {first}, after the largest deformation, is left out")
                }
                [first, last] => {
                    format!("lines {first} to {last}, after the largest deformation, are left out")
                }
            }
        )]
        WayBack {
            /// Of which parameter it is the curve.
            curve: &'static str,
            /// The first and the last line, from 1.
            lines: [usize; 2],
        } = "way-back-left-out",
        /// What a record reads at rest was taken off.
        #[error("{0}")]
        RestRemoved(RestRemoved) = "rest-removed",
        /// A pad gives back all that it takes up, where what is asked for hangs on what it loses.
        #[error(
            "its law is elastic: the peak counts, but rebound, impulse, energy and HIC do not show what a real \
             foam loses; `hysteretic-foam` and `hysteretic-table` lose it"
        )]
        Elastic = "elastic",
        /// Gravity \[m/s²\] pulls away from the support.
        #[error(
            "{} pulls away from the support; positive is towards it",
            format_short(*.0, Dimension::ACCELERATION, 4)
        )]
        Upward(f64) = "upward",
        /// The mean of a number with scatter, as it is written, stands for it.
        #[error("the mean of {0} stands for it here")]
        Mean(String) = "mean",
    }
}

/// What a record reads at rest, which was taken off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RestRemoved {
    /// Mean before the pulse, in SI units.
    pub value: f64,
    /// How far the reading at rest during the pulse may be from it.
    pub error: f64,
    /// What was measured.
    pub dimension: Dimension,
    /// From when to when in the file the mean was taken \[s\].
    pub window: (f64, f64),
}

impl fmt::Display for RestRemoved {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let of = |value, digits| format_short(value, self.dimension, digits);
        let time = |time| format_short(time, Dimension::TIME, 4);
        let (from, to) = (time(self.window.0), time(self.window.1));
        let (value, error) = (of(self.value, 3), of(self.error, 2));
        write!(f, "it reads {value} ± {error} at rest from {from} to {to}, which is taken off")
    }
}

impl Remark {
    /// What kind of remark it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Composite { note, .. } => note.code(),
            own => own.kind(),
        }
    }
}

/// Takes up notes while models are read; a model that is used again says the same only once.
#[derive(Debug, Default)]
pub(crate) struct Notes(RefCell<Vec<ModelNote>>);

impl Notes {
    pub(crate) fn add(&self, subject: impl Into<String>, what: Remark, until: Option<f64>) {
        let note = ModelNote { subject: subject.into(), what, until };
        let mut all = self.0.borrow_mut();
        if !all.contains(&note) {
            all.push(note);
        }
    }

    /// All remarks so far, in the order in which the models were read.
    pub(crate) fn all(&self) -> Vec<ModelNote> {
        self.0.borrow().clone()
    }
}
