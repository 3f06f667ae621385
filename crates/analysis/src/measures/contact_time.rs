//! Contact time.

use dashpot_network::parameters;

use super::{Family, MeasureKind, Reading};
use crate::{Note, Solution, impact::interval::Contact};

/// Part of a time within which the end of a run is at that time.
const AT_ONCE: f64 = 1e-9;

parameters! {
    /// The time from first contact to the first zero of an element's force \[s\], for elements that
    /// touch an impactor.
    ///
    /// Of an element that an impactor strikes through a face with mass it is the time from the first touch
    /// of the face until the impactor has left it and the element is unloaded.
    ///
    /// It is 0 where the element pulls from the start or masses meet and part at once, and undefined where it still pushes at the end
    /// of the run.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct ContactTime: "contact-time",
        "time from first contact to the first zero of the force [s]"
    {}
}

impl MeasureKind for ContactTime {
    const UNIT: &'static str = "s";
    const APPLIES_TO: Family = Family::Element;
    const BY_DEFAULT: bool = true;
    const WITHOUT_IMPACTOR: bool = false;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let touches = solution.touches_impactor(&solution.assembly().connections[target]);
        if !touches && solution.struck_face(target).is_none() {
            return Reading::undefined(Note::NoImpactor);
        }
        let impact = solution.element_impact(target);
        match impact.contact {
            Contact::Released | Contact::Parted => {
                let length = impact.end - impact.start;
                // A run that stops at the release ends with it, whenever that is.
                let room = solution.end() - impact.end;
                let room = (room > AT_ONCE * impact.end).then_some(room);
                // No length has no size of its own: it is the difference of two times.
                let size = if length > 0.0 { length } else { impact.end };
                let reading = Reading {
                    value: Some(length),
                    size,
                    time: Some(impact.end),
                    error: impact.end_error,
                    room,
                    ..Reading::default()
                };
                if length > 0.0 { reading } else { reading.noting(Note::PartsAtOnce) }
            }
            Contact::Pulling => Reading {
                value: Some(0.0),
                time: Some(impact.start),
                error: Some(0.0),
                ..Reading::undefined(Note::PullsFromTheStart)
            },
            Contact::Lasting => Reading::undefined(Note::StillInContact),
            Contact::Unloaded | Contact::NoImpactor => Reading::undefined(Note::NeverLoaded),
        }
    }
}
