//! What happened in a run, in order of time.

use dashpot_dae::{Run, Trajectory};
use dashpot_network::Assembly;

use crate::{
    ContactReport, EventReport,
    impact::{contacts, interval::Contact},
    wording::quantity,
};

/// Most switchings that are listed one by one.
const LISTED: usize = 20;

/// Conditions that were met, contacts that end, and what switched.
pub(crate) fn collect(
    run: &Run,
    assembly: &Assembly,
    trajectory: &Trajectory,
    contacts: &[ContactReport],
) -> Vec<EventReport> {
    let guards = trajectory.events.iter().filter_map(|event| {
        let guard = run.guards.get(event.guard)?;
        Some(EventReport { time: event.time, what: guard.name.clone(), stops: guard.stops })
    });
    let told = |time: f64, what: String| EventReport { time, what, stops: false };
    let pulls =
        contacts.iter().filter(|own| own.is_glued && own.impact.contact == Contact::Released);
    let pulls =
        pulls.map(|own| told(own.impact.end, format!("{} force turns to tension", own.element)));
    let switchings = contacts::switchings(assembly, trajectory);
    let rest = switchings.get(LISTED..).unwrap_or(&[]);
    let summary = rest.first().zip(rest.last()).map(|(first, last)| {
        let until = quantity(last.0, "s");
        told(first.0, format!("… {} more until {until}", rest.len()))
    });
    let listed = switchings.iter().take(LISTED).map(|(time, what)| told(*time, what.clone()));
    let mut events: Vec<EventReport> = pulls.chain(guards).chain(listed).chain(summary).collect();
    events.sort_by(|one, other| one.time.total_cmp(&other.time));
    events
}
