//! What is to be said about models and scenes, besides errors and warnings.

use std::{cell::RefCell, fmt};

use dashpot_network::{composites::CompositeNote, parameters::Dimension};
use dashpot_units::format_short;

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

/// What is to be said about a model or a part of a scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Remark {
    /// How near a model comes to its description.
    Composite {
        /// Its remark.
        note: CompositeNote,
        /// By what its times are multiplied afterwards, where they are.
        factor: Option<f64>,
    },
    /// The times of a model are multiplied.
    Shift {
        /// Word for what does so.
        word: &'static str,
        /// The factor.
        factor: f64,
    },
    /// Several things have the name of the model.
    SharedName(String),
    /// A node is dropped from a height \[m\], and has no weight.
    Weightless(f64),
    /// A node strikes with gravity off, where its weight is not little.
    WeightLeftOut {
        /// What the weight adds over the thickness of the pad, if the impact goes down \[J\].
        energy: f64,
        /// The same in parts of the energy with which it strikes.
        part: f64,
    },
    /// The curve of a law is not that of the rows of its file.
    Curve(CurveChange),
    /// The area of a pad is constant where a standard loads one that grows.
    ConstantArea {
        /// The standard.
        standard: &'static str,
        /// Radius \[m\] of the dome on which the pad lies.
        dome: f64,
    },
    /// Lines of a file are no part of its table.
    LeftOut(LeftOut),
    /// Lines of a record behind its largest deformation are no part of a law of one branch.
    WayBack {
        /// Of which parameter it is the curve.
        curve: &'static str,
        /// The first and the last line, from 1.
        lines: [usize; 2],
    },
    /// What a record reads at rest was taken off.
    RestRemoved(RestRemoved),
    /// A pad gives back all that it takes up, where what is asked for hangs on what it loses.
    Elastic,
    /// Gravity \[m/s²\] pulls away from the support.
    Upward(f64),
    /// The mean of a number with scatter, as it is written, stands for it.
    Mean(String),
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
            Self::Shift { .. } => "shift",
            Self::SharedName(_) => "shared-name",
            Self::Weightless(_) => "weightless",
            Self::WeightLeftOut { .. } => "weight-left-out",
            Self::Curve(_) => "curve",
            Self::ConstantArea { .. } => "constant-area",
            Self::LeftOut(_) => "lines-left-out",
            Self::WayBack { .. } => "way-back-left-out",
            Self::RestRemoved(_) => "rest-removed",
            Self::Elastic => "elastic",
            Self::Upward(_) => "upward",
            Self::Mean(_) => "mean",
        }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Composite { note, factor: None } => write!(f, "{note}"),
            Self::Composite { note, factor: Some(factor) } => {
                write!(f, "{note}, before its times are multiplied by {factor:.3e}")
            }
            Self::Shift { word, factor } => {
                write!(f, "`{word}` multiplies its times by {factor:.3e}")
            }
            Self::SharedName(name) => write!(
                f,
                "the name is also that of another; `models.{name}`, `materials.{name}` and \
                 `elements.{name}` tell them apart"
            ),
            Self::Weightless(height) => write!(
                f,
                "dropped from {} with gravity off: it begins at touch with the speed of the fall, \
                 weighs nothing, and never falls back on what it has left; `gravity = {{}}` under \
                 [effects] gives it its weight",
                format_short(*height, Dimension::LENGTH, 4)
            ),
            Self::WeightLeftOut { energy, part } => write!(
                f,
                "gravity is off: if it moves downwards, its weight does work of {} over the thickness, {} \
                 the energy; `gravity = {{}}` under [effects] counts it",
                format_short(*energy, Dimension::ENERGY, 3),
                match *part {
                    ..10.0 => format!("{:.1} % of", 100.0 * part),
                    10.0..1e3 => format!("{part:.0} times"),
                    _ => "far more than".to_owned(),
                }
            ),
            Self::Curve(change) => write!(f, "{change}"),
            Self::ConstantArea { standard, dome } => {
                let radius = format_short(*dome, Dimension::LENGTH, 4);
                write!(
                    f,
                    "{standard} lays it on a dome with the radius {radius}: the area that is loaded grows, and a \
                     constant `area` may be wrong by a factor; `pressed-by = {{ shape = \"dome\", radius = \
                     \"{radius}\", diameter = … }}` in its place follows it"
                )
            }
            Self::LeftOut(lines) => write!(f, "{lines}"),
            Self::WayBack { curve, lines: [first, last] } => {
                let lines = match last - first {
                    0 => format!("line {first}, after the largest deformation, is left out"),
                    _ => format!(
                        "lines {first} to {last}, after the largest deformation, are left out"
                    ),
                };
                write!(f, "{lines}: `{curve}` is a curve of loading alone")
            }
            Self::RestRemoved(own) => write!(f, "{own}"),
            Self::Elastic => write!(
                f,
                "its law is elastic: the peak counts, but rebound, impulse, energy and HIC do not show what a real \
                 foam loses; `hysteretic-foam` and `hysteretic-table` lose it"
            ),
            Self::Upward(acceleration) => write!(
                f,
                "{} pulls away from the support; positive is towards it",
                format_short(*acceleration, Dimension::ACCELERATION, 4)
            ),
            Self::Mean(text) => write!(f, "the mean of {text} stands for it here"),
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
