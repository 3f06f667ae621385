//! What happened in a run, in order of time.

use dashpot_dae::{Run, Switch, Trajectory};
use dashpot_network::{Assembly, NodeId};

use crate::{
    Collision, ContactReport, Event, EventReport, Stop,
    errors::instants::Instants,
    impact::{
        contacts::{is_contact, stays_closed},
        interval::Contact,
    },
};

/// Conditions that were met, contacts that end, and what switched, with what is known of the errors of their times:
/// of what the trajectory holds, and of the release of an element.
pub(crate) fn collect(
    run: &Run,
    assembly: &Assembly,
    trajectory: &Trajectory,
    contacts: &[ContactReport],
    instants: &Instants,
    release: impl Fn(&str) -> Option<f64>,
) -> Vec<EventReport> {
    let crossings = trajectory.events.iter().zip(&instants.crossings);
    let guards = crossings.filter_map(|(event, error)| {
        let guard = run.guards.get(event.guard)?;
        let output = assembly.system.outputs.at(guard.output);
        let (name, unit) = (output.name.to_string(), output.unit);
        let stop = Stop { output: name, level: guard.level, direction: guard.direction };
        let what = Event::Condition { stop, unit };
        Some(EventReport { time: event.time, error: *error, what, stops: guard.stops })
    });
    let event = |time: f64, error: Option<f64>, what: Event| EventReport {
        time,
        error,
        what,
        stops: false,
    };
    let pulls = contacts
        .iter()
        .filter(|contact| contact.is_glued && contact.impact.contact == Contact::Released);
    let pulls = pulls.map(|pull| {
        let what = Event::Tension { element: pull.element.clone() };
        event(pull.impact.end, release(&pull.element), what)
    });
    let switchings = switchings(assembly, trajectory);
    let switchings = switchings.into_iter().zip(&instants.switches);
    let switchings = switchings.map(|((time, what), error)| event(time, *error, what));
    let mut events: Vec<EventReport> = pulls.chain(guards).chain(switchings).collect();
    events.sort_by(|one, other| one.time.total_cmp(&other.time));
    events
}

/// What switches, with the time of each \[s\].
fn switchings(assembly: &Assembly, trajectory: &Trajectory) -> Vec<(f64, Event)> {
    let mut met: Vec<usize> = Vec::new();
    let begins_struck = |part: usize| {
        trajectory.switches.iter().any(|switch| switch.part == part && switch.time <= 0.0)
    };
    let first = trajectory.first_phases.iter().enumerate().map(|(part, phase)| (part, phase.0));
    let lies = |&(part, phase): &(usize, usize)| phase > 0 && !begins_struck(part);
    met.extend(first.filter(lies).map(|(part, _)| part));
    let mut found = Vec::with_capacity(trajectory.switches.len());
    for switch in &trajectory.switches {
        let again = met.contains(&switch.part);
        let at = assembly.primitives.iter().position(|primitive| *primitive.name == *switch.name);
        let what = match at.filter(|&at| is_contact(&assembly.primitives[at])) {
            Some(at) => {
                if !again {
                    met.push(switch.part);
                }
                of_contact(assembly, switch, at, again)
            }
            None => Event::Phase { part: switch.name.clone(), phase: switch.what },
        };
        found.push((switch.time, what));
    }
    found
}

/// What switches at the contact that is the primitive number `at`.
fn of_contact(assembly: &Assembly, switch: &Switch, at: usize, again: bool) -> Event {
    let owner = assembly.owner(at);
    // A contact that is all of an element goes by the element's name.
    let is_connection = owner.is_some_and(|at| assembly.connections[at].name == switch.name);
    let name = if is_connection { &switch.name } else { assembly.primitives[at].place() };
    let contact = name.to_owned();
    let impulse = Collision { impulse: switch.impulse, lost: switch.lost.max(0.0) };
    if stays_closed(switch) {
        return if switch.lost > 0.0 {
            Event::Impact { contact, collision: impulse }
        } else {
            Event::PassesOn { contact, impulse: switch.impulse }
        };
    }
    let collision = (switch.impulse > 0.0).then_some(impulse);
    match owner.and_then(|at| sides(assembly, at)) {
        // Where an impulse parts them again at once, they have met all the same.
        Some(sides) if switch.impulse > 0.0 || switch.phase > 0 => {
            Event::Meets { sides, again, collision }
        }
        Some(sides) => Event::Leaves { sides },
        None if switch.phase > 0 => Event::Closes { contact, again, collision },
        None if switch.impulse > 0.0 => Event::Impact { contact, collision: impulse },
        None => Event::Opens { contact },
    }
}

/// The node and the element between which this contact is, where an effect has put it there.
fn sides(assembly: &Assembly, contact: usize) -> Option<[String; 2]> {
    let pad = assembly.pad_behind(contact)?;
    let mut ends = assembly.connections[contact].between.into_iter().map(NodeId::index);
    let node = ends.find(|&end| pad.face != Some(end))?;
    Some([&assembly.nodes[node].name, &assembly.connections[pad.element].name].map(String::clone))
}
