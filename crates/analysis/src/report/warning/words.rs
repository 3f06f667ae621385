//! Warnings in words.

use std::fmt;

use dashpot_dae::SolveError;
use dashpot_network::parameters::Dimension;

use super::{Beyond, Harder, Missed, Warning};
use crate::{
    Note,
    wording::{percent, quantity},
};

/// How many measures one warning names.
const NAMED: usize = 4;

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

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [how, which] =
            if self.is_pressed { ["pressed", "end"] } else { ["stretched", "beginning"] };
        let excess = quantity(self.excess, "m");
        if self.at_equator {
            let (radius, time) = (quantity(self.point, "m"), quantity(self.time, "s"));
            return write!(
                f,
                "{} is pressed in by {excess} more than the radius of its body, {radius}, at {time}: what touches it \
                 beyond is not modelled",
                self.name
            );
        }
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
            Self::LoosePreload { element, preload, node } => write!(
                f,
                "nothing holds the preload of the {element}, {}: it moves {node} from the start; a contact, a stop \
                 or another preload holds it, or `start = \"equilibrium\"` of gravity a weight",
                quantity(*preload, "N")
            ),
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
            Self::OpenEnd { time, measures, is_covered } => {
                write!(
                    f,
                    "the contact force comes within its error of zero at {} and pushes on, as far \
                     as can be told: whether the impact ends there is open",
                    quantity(*time, "s")
                )?;
                match is_covered {
                    _ if measures.is_empty() => Ok(()),
                    true => write!(f, ", and the errors cover both ends: {}", quoted(measures)),
                    false => write!(
                        f,
                        ", and with it {}; `--estimate on` or a smaller `--rtol` may tell",
                        quoted(measures)
                    ),
                }
            }
            Self::HarderOutside(own) => {
                let peaks: Vec<String> = own.iter().map(Harder::to_string).collect();
                write!(
                    f,
                    "over the run there is more than in the impact: {}; measures with `window = \
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
            Self::Segments { measures, stated, counts: [segments, others] } => {
                let named = measures.iter().take(NAMED);
                let named = named.map(|(key, part)| format!("`{key}` by {}", percent(*part)));
                let more = match measures.len().saturating_sub(NAMED) {
                    0 => String::new(),
                    more => format!(" and {more} more"),
                };
                write!(
                    f,
                    "{others} segments of layers instead of {segments} change {}{more}, more than the \
                     {} that is expected of them: cut them finer, by `segments` or `accuracy`",
                    named.collect::<Vec<_>>().join(", "),
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
