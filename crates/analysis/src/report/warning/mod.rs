//! What the reader of a report must know, as data.

mod words;

use dashpot_dae::SolveError;
use dashpot_network::{HeldTable, NetworkWarning};
use thiserror::Error;

use crate::{Bound, Compression, Idle, Leak, Limit, Note, Reason, wording::quantity};

/// Something that the reader of a report must know.
#[derive(Debug, Clone, PartialEq)]
pub enum Warning {
    /// The run is followed to a time \[s\] before its end.
    FollowedInPart {
        /// That time.
        until: f64,
        /// The end.
        duration: f64,
    },
    /// An element that nothing lets part is in tension.
    Pulls {
        /// The element.
        element: String,
        /// From when on \[s\]; `None` from the start.
        since: Option<f64>,
    },
    /// A pad is pressed in by more than its thickness.
    PressedThrough {
        /// The deformation.
        through: Through,
        /// How many other parts of the same pad are so as well.
        others: usize,
    },
    /// A law is followed beyond its last point, or further than it is given.
    BeyondLaw(Beyond),
    /// A part of a pad of layers is pressed in by more than its thickness.
    CrushedPart {
        /// The pad.
        element: String,
        /// Its largest strain.
        strain: f64,
        /// When \[s\].
        time: f64,
        /// What is said of that.
        notes: Vec<Note>,
    },
    /// The energy balance does not close.
    EnergyNotClosed {
        /// Energy missing in parts of that turned over; negative if it is too much.
        closure: f64,
        /// Where it goes missing.
        leak: Option<Leak>,
    },
    /// A preload that nothing holds.
    LoosePreload {
        /// The element.
        element: String,
        /// Its force as the run begins \[N\].
        preload: f64,
        /// A body that it moves.
        node: String,
    },
    /// The force of a slider follows from nothing.
    IdleSlider(Idle),
    /// A condition that stops the run holds at its start.
    StopHolds {
        /// The condition.
        condition: String,
    },
    /// A dropped body has not arrived at the end.
    StillFalling {
        /// The body.
        node: String,
        /// The end of the run \[s\].
        end: f64,
        /// How long it falls \[s\].
        fall: f64,
    },
    /// A contact has no end within the run.
    StillInContact {
        /// The element.
        element: String,
        /// The end of the run \[s\].
        end: f64,
    },
    /// The release of a contact has been missed.
    ReleaseMissed {
        /// The contact.
        element: String,
        /// What it pulls with \[N\], and in parts of its largest push.
        pull: [f64; 2],
        /// When \[s\].
        time: f64,
    },
    /// It is open whether an impact ends.
    OpenEnd {
        /// Where it may \[s\].
        time: f64,
        /// The measures to which that makes a difference.
        measures: Vec<String>,
        /// Whether their errors cover both; else they are not estimated.
        is_covered: bool,
    },
    /// Peaks outside the impact are larger than those within.
    HarderOutside(Vec<Harder>),
    /// A body leaves an element for good.
    NeverComesBack {
        /// The body, and the element.
        names: [String; 2],
        /// When \[s\].
        time: f64,
    },
    /// Nothing is known of any error.
    ErrorsUnknown {
        /// What keeps further solutions from telling.
        obstacle: Option<SolveError>,
    },
    /// Whether measures have a value depends on the tolerance.
    Undecided(Vec<String>),
    /// The solution does not tell the value of measures.
    Undetermined(Vec<String>),
    /// The accuracy wanted is not reached.
    NotReached {
        /// The measures.
        missed: Vec<Missed>,
        /// What kept it from being reached.
        obstacle: Option<SolveError>,
    },
    /// A table of time holds a value although nobody says so.
    HeldTable(HeldTable),
    /// Something is odd about the network.
    Network(NetworkWarning),
    /// Nothing is reported of a large network without being asked for.
    Unasked,
    /// The segments of layers make more of a measure than is expected.
    Segments {
        /// The measures, and by what part of its size each differs, the most first.
        measures: Vec<(String, f64)>,
        /// The part that is expected.
        stated: f64,
        /// Segments, and those that they are compared with.
        counts: [usize; 2],
    },
}

/// Something that is pressed in by more than its thickness.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "the {name} is pressed in by {} at {}: {} more than its thickness of {}",
    quantity(.compression.deepest, "m"),
    quantity(.compression.time, "s"),
    quantity(-.compression.left(), "m"),
    quantity(.compression.thickness, "m"),
)]
pub struct Through {
    /// The element, or the path of a part of it.
    pub name: String,
    /// How far.
    pub compression: Compression,
}

/// A measured law that is followed beyond its points.
#[derive(Debug, Clone, PartialEq)]
pub struct Beyond {
    /// The path of the element.
    pub name: String,
    /// Whether it is pressed beyond the end of its law, else stretched beyond its beginning.
    pub is_pressed: bool,
    /// How far \[m\].
    pub excess: f64,
    /// When \[s\].
    pub time: f64,
    /// The deformation where the law ends \[m\].
    pub point: f64,
    /// Whether it ends there because the round body that presses the element is in by its radius.
    pub at_equator: bool,
}

/// A peak outside of the impact.
#[derive(Debug, Clone, PartialEq, Error)]
#[error(
    "`{measure}` is {}, but {} at {}",
    quantity(*.within, .unit),
    if .outside.is_finite() { quantity(*.outside, .unit) } else { "infinite".to_owned() },
    quantity(*.time, "s"),
)]
pub struct Harder {
    /// The measure.
    pub measure: String,
    /// Its unit.
    pub unit: &'static str,
    /// Its value in the impact.
    pub within: f64,
    /// The value over the run, infinite where speeds jump.
    pub outside: f64,
    /// When \[s\].
    pub time: f64,
}

/// A measure that is not as accurate as is wanted.
#[derive(Debug, Clone, PartialEq)]
pub struct Missed {
    /// The measure.
    pub measure: String,
    /// Its error relative to its value, and what is wanted.
    pub accuracy: [f64; 2],
    /// Its absolute error, and its unit, where it cannot be told from zero.
    pub zero_within: Option<(f64, &'static str)>,
}

impl Warning {
    /// What kind of warning it is, in one word that stays the same, and the names of the elements, nodes and measures that
    /// it is about.
    fn about(&self) -> (&'static str, Vec<&str>) {
        match self {
            Self::FollowedInPart { .. } => ("followed-in-part", Vec::new()),
            Self::Pulls { element, since: Some(_) } => ("pulls", vec![element]),
            Self::Pulls { element, since: None } => ("pulls-from-the-start", vec![element]),
            Self::PressedThrough { through, .. } => ("pressed-through", vec![&through.name]),
            Self::BeyondLaw(own) => {
                let code = match own {
                    Beyond { at_equator: true, .. } => "pressed-beyond-radius",
                    Beyond { is_pressed: true, .. } => "pressed-beyond-points",
                    _ => "stretched-beyond-points",
                };
                (code, vec![&own.name])
            }
            Self::CrushedPart { element, .. } => ("crushed-part", vec![element]),
            Self::EnergyNotClosed { .. } => ("energy-not-closed", Vec::new()),
            Self::LoosePreload { element, .. } => ("loose-preload", vec![element]),
            Self::IdleSlider(own) => ("idle-slider", all(&own.slider.sliders)),
            Self::StopHolds { condition } => ("stop-holds", vec![condition]),
            Self::StillFalling { node, .. } => ("still-falling", vec![node]),
            Self::StillInContact { element, .. } => ("still-in-contact", vec![element]),
            Self::ReleaseMissed { element, .. } => ("release-missed", vec![element]),
            Self::OpenEnd { measures, .. } => ("open-end", all(measures)),
            Self::HarderOutside(own) => ("harder-outside", all(own.iter().map(|own| &own.measure))),
            Self::NeverComesBack { names, .. } => ("never-comes-back", all(names)),
            Self::ErrorsUnknown { .. } => ("errors-unknown", Vec::new()),
            Self::Undecided(measures) => ("undecided", all(measures)),
            Self::Undetermined(measures) => ("undetermined", all(measures)),
            Self::NotReached { missed, .. } => {
                ("accuracy-not-reached", all(missed.iter().map(|own| &own.measure)))
            }
            Self::HeldTable(own) => ("held-table", vec![&own.name]),
            Self::Network(own) => (own.code(), own.names()),
            Self::Unasked => ("unasked", Vec::new()),
            Self::Segments { measures, .. } => ("segments", all(measures.iter().map(|own| &own.0))),
        }
    }

    /// What kind of warning it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        self.about().0
    }

    /// Names of the elements, nodes and measures that it is about.
    pub fn names(&self) -> Vec<&str> {
        self.about().1
    }

    /// Whether it says that something is pressed further than is known of it: beyond the points of its law, or
    /// beyond its thickness.
    pub fn is_beyond_known(&self) -> bool {
        match self {
            Self::BeyondLaw(own) => own.is_pressed,
            Self::PressedThrough { .. } | Self::CrushedPart { .. } => true,
            _ => false,
        }
    }

    /// Why it is not known whether a limit is kept, where the warning says so. One that stands for several runs has the
    /// numbers of one of them alone: then it `stands_for_others`.
    pub fn doubt(&self, limit: &Limit, stands_for_others: bool) -> Option<Reason> {
        match self {
            Self::HarderOutside(all) => {
                let own = all.iter().find(|own| own.measure == limit.key)?;
                let is_exceeded = matches!(limit.bound, Bound::Max(most) if own.outside > most);
                (is_exceeded || stands_for_others).then_some(Reason::Outside)
            }
            Self::BeyondLaw(Beyond { at_equator: true, .. }) => Some(Reason::NoLaw),
            Self::Network(NetworkWarning::WithinJump { .. }) => limit
                .measure()
                .is_some_and(|own| own.about.is_work_of_element())
                .then_some(Reason::Error),
            own => own.is_beyond_known().then_some(Reason::Beyond),
        }
    }

    /// Whether it differs from another one in numbers alone.
    pub fn is_like(&self, other: &Self) -> bool {
        self.about() == other.about()
    }
}

fn all<'n>(names: impl IntoIterator<Item = &'n String>) -> Vec<&'n str> {
    names.into_iter().map(String::as_str).collect()
}
