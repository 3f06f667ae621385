//! Coefficient of restitution.

use std::borrow::Cow;

use dashpot_network::{NodeId, parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Reading, reading::end_value};
use crate::{
    Note, Solution,
    impact::{impulses, interval::Contact},
};

parameters! {
    /// The speed at which an element's ends part at release over that at which they met,
    /// `e = −ẏ(release)/ẏ(contact)` \[1\], for elements that touch an impactor.
    ///
    /// Of an element that is struck through a face with mass they are the speeds of what strikes the face
    /// and of the other end, before the first touch and at the end of the impact.
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
    const UNIT: &'static str = "1";
    const APPLIES_TO: Family = Family::Element;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let connection = &solution.assembly().connections[target];
        let face = solution.struck_face(target);
        if !solution.touches_impactor(connection) && face.is_none() {
            return Reading::undefined(Note::NoImpactor);
        }
        let impact = solution.element_impact(target);
        if impact.contact == Contact::Lasting {
            return Reading::undefined(Note::StillInContact);
        }
        let span = match impact.span(WindowWish::Impact, solution.end()) {
            Ok(span) => span,
            Err(note) => return Reading::undefined(note),
        };
        let own = || solution.approach(connection);
        let rate = match face {
            Some(face) => solution.approach_of(face.ends).map_or_else(own, Cow::Owned),
            None => own(),
        };
        let touch = face.map_or(target, |face| face.connection);
        let blows = solution.element_blows(touch);
        let is_struck = |time: f64| !impulses::within(blows, (time, time)).is_empty();
        let ends = face.map_or(connection.between.map(NodeId::index), |face| face.ends);
        let meeting = if is_struck(span.from) && span.from <= 0.0 {
            solution.start_approach(ends)
        } else if is_struck(span.from) {
            rate.left_value(span.from)
        } else {
            rate.value(span.from)
        };
        if meeting.abs() <= rate.noise {
            return Reading::undefined(Note::NoApproach);
        }
        let parting = end_value(&rate, &span);
        // What jumps at the end has jumped.
        let speed = if is_struck(span.to) { Some(rate.value(span.to)) } else { parting.value };
        let value = -speed.unwrap_or(f64::NAN) / meeting;
        let error = parting.error.zip(rate.error);
        let error = error.map(|(end, start)| (end + value.abs() * start) / meeting.abs());
        let end_rate = parting.end_rate / meeting.abs();
        Reading::over(&span, value, error).of_size(1.0).at(span.to).changing(end_rate)
    }
}
