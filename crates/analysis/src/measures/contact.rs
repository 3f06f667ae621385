//! How long a contact lasts, and how fast it ends.

use std::borrow::Cow;

use dashpot_network::{NodeId, parameters, parameters::WindowWish};

use super::{MeasureKind, MeasureTraits, Reading};
use crate::{Note, Solution, VelocityJump, impact::interval::Contact};

/// Ends that meet with less than this part of the largest rate of their deformation meet without speed: what is left is
/// rounding.
pub(crate) const NO_APPROACH: f64 = 1e-9;
/// Part of a time within which the end of a run is at that time.
const AT_ONCE: f64 = 1e-9;

parameters! {
    /// The time from first contact to the first zero of an element's force \[s\], for elements that touch an impactor.
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
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("s").of_impacts();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let touches = solution.touches_impactor(&solution.assembly().connections[target]);
        if !touches && solution.struck_face(target).is_none() {
            return Err(Note::NoImpactor);
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
                Ok(reading.noting_if(length <= 0.0, Note::PartsAtOnce))
            }
            Contact::Pulling => Ok(Reading {
                value: Some(0.0),
                time: Some(impact.start),
                error: Some(0.0),
                ..Reading::undefined(Note::PullsFromTheStart)
            }),
            Contact::Lasting => Err(Note::StillInContact),
            Contact::Unloaded | Contact::NoImpactor => Err(Note::NeverLoaded),
        }
    }
}

parameters! {
    /// The speed at which an element's ends part at release over that at which they met,
    /// `e = −ẏ(release)/ẏ(contact)` \[1\], for elements that touch an impactor.
    ///
    /// Of an element that is struck through a face with mass they are the speeds of what strikes the face
    /// and of the other end, before the first touch and at the end of the impact.
    ///
    /// It is undefined where the ends meet with less than 10⁻⁹ of the largest rate of the deformation: a sum of roundings.
    ///
    /// A massless face has the speed of what strikes it, from the touch until it is let go. Where masses
    /// meet, the speeds are those before and after the impulse; an impact of masses that stay together
    /// has ended when they part, without speed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub struct CoefficientOfRestitution: "coefficient-of-restitution",
        "speed of parting over speed of meeting [1]"
    {}
}

impl MeasureKind for CoefficientOfRestitution {
    const ABOUT: MeasureTraits = MeasureTraits::of_element::<Self>("1").of_impacts();

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let connection = &solution.assembly().connections[target];
        let face = solution.struck_face(target);
        if !solution.touches_impactor(connection) && face.is_none() {
            return Err(Note::NoImpactor);
        }
        let impact = solution.element_impact(target);
        if impact.contact == Contact::Lasting {
            return Err(Note::StillInContact);
        }
        let span = impact.span(WindowWish::Impact, solution.end())?;
        let own = || solution.approach(connection);
        let rate = match face {
            Some(face) => solution.approach_of(face.ends).map_or_else(own, Cow::Owned),
            None => own(),
        };
        let touch = face.map_or(target, |face| face.connection);
        let jumps = solution.element_jumps(touch);
        let is_struck = |time: f64| !VelocityJump::within(jumps, (time, time)).is_empty();
        let ends = face.map_or(connection.between.map(NodeId::index), |face| face.ends);
        let meeting = if is_struck(span.from) && span.from <= 0.0 {
            solution.start_approach(ends)
        } else if is_struck(span.from) {
            rate.left_value(span.from)
        } else {
            rate.value(span.from)
        };
        if meeting.abs() <= rate.noise.max(NO_APPROACH * rate.absolute_maximum(span.window()).value)
        {
            return Err(Note::NoApproach);
        }
        let parting = Reading::end_value(&rate, &span);
        // What jumps at the end has jumped.
        let speed = if is_struck(span.to) {
            Some(rate.value(span.to))
        } else {
            let told = || solution.told_approach(connection, span.to);
            face.map_or_else(told, |_| None).or(parting.value)
        };
        let value = -speed.unwrap_or(f64::NAN) / meeting;
        let error = parting.error.zip(rate.error);
        let error = error.map(|(end, start)| (end + value.abs() * start) / meeting.abs());
        let end_rate = parting.end_rate / meeting.abs();
        Ok(Reading::over(&span, value, error).of_size(1.0).at(span.to).changing(end_rate))
    }
}
