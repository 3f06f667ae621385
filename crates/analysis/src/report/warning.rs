//! What the reader of a report must know, as data.

use std::fmt;

use dashpot_dae::SolveError;
use dashpot_network::{HeldTable, NetworkWarning, parameters::Dimension};

use crate::{
    Bound, Compression, Idle, Leak, Limit, Note, Reason,
    wording::{percent, quantity},
};

/// How many measures one warning names.
const NAMED: usize = 4;

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
        /// The measures whose errors cover both.
        measures: Vec<String>,
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
        /// The measure.
        measure: String,
        /// By what part of its size it differs, and what is expected.
        parts: [f64; 2],
        /// Segments, and those that they are compared with.
        counts: [usize; 2],
    },
}

/// Something that is pressed in by more than its thickness.
#[derive(Debug, Clone, PartialEq)]
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
}

/// A peak outside of the impact.
#[derive(Debug, Clone, PartialEq)]
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
    /// What kind of warning it is, in one word that stays the same.
    pub fn code(&self) -> &'static str {
        match self {
            Self::FollowedInPart { .. } => "followed-in-part",
            Self::Pulls { since: Some(_), .. } => "pulls",
            Self::Pulls { since: None, .. } => "pulls-from-the-start",
            Self::PressedThrough { .. } => "pressed-through",
            Self::BeyondLaw(Beyond { is_pressed: true, .. }) => "pressed-beyond-points",
            Self::BeyondLaw(_) => "stretched-beyond-points",
            Self::CrushedPart { .. } => "crushed-part",
            Self::EnergyNotClosed { .. } => "energy-not-closed",
            Self::IdleSlider(_) => "idle-slider",
            Self::StopHolds { .. } => "stop-holds",
            Self::StillFalling { .. } => "still-falling",
            Self::StillInContact { .. } => "still-in-contact",
            Self::ReleaseMissed { .. } => "release-missed",
            Self::OpenEnd { .. } => "open-end",
            Self::HarderOutside(_) => "harder-outside",
            Self::NeverComesBack { .. } => "never-comes-back",
            Self::ErrorsUnknown { .. } => "errors-unknown",
            Self::Undecided(_) => "undecided",
            Self::Undetermined(_) => "undetermined",
            Self::NotReached { .. } => "accuracy-not-reached",
            Self::HeldTable(_) => "held-table",
            Self::Network(own) => own.code(),
            Self::Unasked => "unasked",
            Self::Segments { .. } => "segments",
        }
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

    /// Why a limit that is kept may not be, where the warning says so. One that stands for several runs has the
    /// numbers of one of them alone: then it `stands_for_others`.
    pub fn doubt(&self, limit: &Limit, stands_for_others: bool) -> Option<Reason> {
        match self {
            Self::HarderOutside(all) => {
                let own = all.iter().find(|own| own.measure == limit.key)?;
                let is_exceeded = matches!(limit.bound, Bound::Max(most) if own.outside > most);
                (is_exceeded || stands_for_others).then_some(Reason::Outside)
            }
            own => own.is_beyond_known().then_some(Reason::Beyond),
        }
    }

    /// Names of the elements, nodes and measures that it is about.
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::FollowedInPart { .. }
            | Self::EnergyNotClosed { .. }
            | Self::ErrorsUnknown { .. }
            | Self::Unasked => Vec::new(),
            Self::Pulls { element, .. }
            | Self::CrushedPart { element, .. }
            | Self::StillInContact { element, .. }
            | Self::ReleaseMissed { element, .. } => vec![element],
            Self::PressedThrough { through, .. } => vec![&through.name],
            Self::BeyondLaw(own) => vec![&own.name],
            Self::IdleSlider(own) => all(&own.slider.sliders),
            Self::StopHolds { condition } => vec![condition],
            Self::StillFalling { node, .. } => vec![node],
            Self::OpenEnd { measures, .. }
            | Self::Undecided(measures)
            | Self::Undetermined(measures) => all(measures),
            Self::HarderOutside(own) => own.iter().map(|own| own.measure.as_str()).collect(),
            Self::NeverComesBack { names, .. } => all(names),
            Self::NotReached { missed, .. } => {
                missed.iter().map(|own| own.measure.as_str()).collect()
            }
            Self::HeldTable(own) => vec![&own.name],
            Self::Network(own) => own.names(),
            Self::Segments { measure, .. } => vec![measure],
        }
    }

    /// Whether it differs from another one in numbers alone.
    pub fn is_like(&self, other: &Self) -> bool {
        self.code() == other.code() && self.names() == other.names()
    }
}

fn all(names: &[String]) -> Vec<&str> {
    names.iter().map(String::as_str).collect()
}

/// The first of these entries, and how many more there are.
fn listed(entries: &[String]) -> String {
    let shown = entries.iter().take(NAMED).cloned().collect::<Vec<_>>().join(", ");
    match entries.len().checked_sub(NAMED) {
        None | Some(0) => shown,
        Some(more) => format!("{shown} and {more} more"),
    }
}

fn quoted(names: &[String]) -> String {
    listed(&names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>())
}

fn why(obstacle: Option<&SolveError>) -> String {
    obstacle.map_or(String::new(), |error| format!(" ({error})"))
}

impl fmt::Display for Through {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the {} is pressed in by {} at {}: {} more than its thickness of {}",
            self.name,
            quantity(self.compression.deepest, "m"),
            quantity(self.compression.time, "s"),
            quantity(-self.compression.left(), "m"),
            quantity(self.compression.thickness, "m"),
        )
    }
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [how, which] =
            if self.is_pressed { ["pressed", "end"] } else { ["stretched", "beginning"] };
        let excess = quantity(self.excess, "m");
        let point = if self.point.abs() > 0.0 { quantity(self.point, "m") } else { "0".to_owned() };
        write!(
            f,
            "{} is {how} {excess} beyond the {which} of its law at {point}, at {}: its force there is \
             extrapolated",
            self.name,
            quantity(self.time, "s"),
        )
    }
}

impl fmt::Display for Harder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let outside = if self.outside.is_finite() {
            quantity(self.outside, self.unit)
        } else {
            "infinite".to_owned()
        };
        let (within, time) = (quantity(self.within, self.unit), quantity(self.time, "s"));
        write!(f, "`{}` is {within}, but {outside} at {time}", self.measure)
    }
}

impl fmt::Display for Missed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [reached, wish] = self.accuracy;
        match self.zero_within {
            // A part of what may be zero says nothing.
            Some((error, unit)) => {
                write!(f, "`{}` is zero within {}", self.measure, quantity(error, unit))
            }
            None => {
                write!(
                    f,
                    "`{}` is known to {}, not to {}",
                    self.measure,
                    percent(reached),
                    percent(wish)
                )
            }
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let time = |time: &f64| quantity(*time, "s");
        match self {
            Self::FollowedInPart { until, duration } => write!(
                f,
                "the run is followed to {} of {} only: it has more oscillations than are followed",
                time(until),
                time(duration)
            ),
            Self::Pulls { element, since } => {
                let since = since.as_ref().map_or("the start".to_owned(), time);
                write!(f, "from {since} the {element} is in tension: separation is off")
            }
            Self::PressedThrough { through, others } => match others {
                0 => write!(f, "{through}"),
                1 => write!(f, "{through}; so is another part of it"),
                count => write!(f, "{through}; so are {count} other parts of it"),
            },
            Self::BeyondLaw(own) => write!(f, "{own}"),
            Self::CrushedPart { element, strain, time: at, notes } => write!(
                f,
                "a part of the {element} is pressed in by {} of its own thickness at {} ({})",
                percent(*strain),
                time(at),
                Note::joined(notes)
            ),
            Self::EnergyNotClosed { closure, leak } => {
                let way = if *closure > 0.0 { "is missing" } else { "is too much" };
                let leak = leak.as_ref().map_or(String::new(), |leak| format!(", {leak}"));
                write!(
                    f,
                    "the energy does not close: {} of the energy turned over {way}{leak}; that is \
                     more than the errors reported",
                    percent(closure.abs()),
                )
            }
            Self::IdleSlider(own) => write!(f, "{own}"),
            Self::StopHolds { condition } => write!(
                f,
                "`stop` when {condition} holds already at the start: it fires at the next crossing \
                 only"
            ),
            Self::StillFalling { node, end, fall } => write!(
                f,
                "{node} is still falling at the end of the run at {}: its fall takes {}; make \
                 `duration` longer",
                time(end),
                time(fall)
            ),
            Self::StillInContact { element, end } => {
                write!(
                    f,
                    "the {element} is still in contact at the end of the run at {}",
                    time(end)
                )
            }
            Self::ReleaseMissed { element, pull: [pull, part], time: at } => write!(
                f,
                "{element} pulls with {} at {}, {} of what it pushes with at most, which no contact \
                 does: its release has been missed, and what follows is wrong; use a smaller `rtol` \
                 or another method",
                quantity(*pull, "N"),
                time(at),
                percent(*part)
            ),
            _ => self.fmt_of_results(f),
        }
    }
}

impl Warning {
    /// Those that are about measures and their accuracy, and about the input.
    fn fmt_of_results(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OpenEnd { time, measures } => {
                write!(
                    f,
                    "the contact force comes within its error of zero at {} and pushes on, as far \
                     as can be told: whether the impact ends there is open",
                    quantity(*time, "s")
                )?;
                if measures.is_empty() {
                    return Ok(());
                }
                write!(f, ", and the errors cover both ends: {}", quoted(measures))
            }
            Self::HarderOutside(own) => {
                let peaks: Vec<String> = own.iter().map(Harder::to_string).collect();
                write!(
                    f,
                    "there is a harder blow outside the impact: {}; measures with `window = \
                     \"run\"` see it",
                    listed(&peaks)
                )
            }
            Self::NeverComesBack { names: [node, element], time } => write!(
                f,
                "{node} leaves the {element} at {} and never comes back: gravity is off",
                quantity(*time, "s")
            ),
            Self::ErrorsUnknown { obstacle: Some(error) } => write!(
                f,
                "the errors are not known: further solutions, which would tell them, fail ({error})"
            ),
            Self::ErrorsUnknown { obstacle: None } => write!(
                f,
                "the errors are not known: with the last digits of its state shaken, the run \
                 switches otherwise"
            ),
            Self::Undecided(measures) => {
                write!(f, "whether there is a value depends on the tolerance: {}", quoted(measures))
            }
            Self::Undetermined(measures) => write!(f, "not determined: {}", quoted(measures)),
            Self::NotReached { missed, obstacle } => {
                let missed: Vec<String> = missed.iter().map(Missed::to_string).collect();
                let why = why(obstacle.as_ref());
                write!(f, "the accuracy wanted is not reached: {}{why}", listed(&missed))
            }
            Self::HeldTable(table) => {
                let unit = |dimension: Dimension| dimension.named().map_or("", |own| own.1);
                let show = |value, dimension| quantity(value, unit(dimension));
                write!(f, "{}; {}", table.message(show), table.help())
            }
            Self::Network(own) => write!(f, "{own}"),
            Self::Segments { measure, parts: [part, stated], counts: [segments, others] } => {
                write!(
                    f,
                    "`{measure}` differs by {} with {others} segments of layers instead of {segments}, \
                 more than the {} that is expected of them: cut them finer, by `segments` or \
                 `accuracy`",
                    percent(*part),
                    percent(*stated)
                )
            }
            _ => write!(
                f,
                "the network is large and has no impactor: only measures that are asked for are \
                 reported"
            ),
        }
    }
}
