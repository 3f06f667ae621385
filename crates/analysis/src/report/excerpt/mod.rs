//! Where in a run something happens: the times of contact, the part of the run around them, and
//! sample times that resolve them.

use dashpot_dae::Signal;
use dashpot_network::phases::{Phase, PhaseLaw, Phases};

use crate::Solution;

/// Part of the largest force by which a force may change where nothing happens.
const STILL: f64 = 0.01;
/// Times at which forces are looked at in a flight.
const LOOKS: usize = 400;
/// What is shown before and after, in parts of what lies between.
const ROOM: f64 = 0.1;
/// Part of a run from which on an excerpt is not worth its while.
const NEARLY_ALL: f64 = 0.9;
/// A contact longer than this part of the times is resolved by regular ones.
const SHORT: f64 = 0.125;
/// Part of the samples that short contacts get, and the least number for each.
const SHARE: f64 = 0.5;
const LEAST: usize = 10;

/// The spans \[s\] in which any contact is closed, in order of time and apart from each other; masses that meet and
/// part at once touch for no time. What never pulls is closed while it pushes. Empty where nothing can let go.
pub fn touching(solution: &Solution<'_>) -> Vec<(f64, f64)> {
    let Some(switching) = &solution.assembly().switching else { return Vec::new() };
    let assembly = solution.assembly();
    let parts = switching.parts();
    let counted = parts.iter().enumerate().filter_map(|(number, part)| {
        let at = assembly.primitives.iter().position(|primitive| *primitive.name == *part.name)?;
        let phases = assembly.primitives[at].element.phases()?;
        let opens = (0..part.phases.len()).any(|index| is_open(phases, index, 0.0));
        // Where an effect has put a contact before a padding, that one tells.
        let pad = assembly.pad(assembly.owner(at)?);
        let is_behind = pad.is_some_and(|pad| pad.contact.is_some());
        (opens && !is_behind).then_some((number, phases))
    });
    joined(counted.flat_map(|own| closed(solution, own)).collect())
}

fn is_open(phases: &dyn Phases, index: usize, memory: f64) -> bool {
    matches!(phases.law(Phase { index, memory }), PhaseLaw::Open)
}

/// The spans in which one part is not open, in order of time.
fn closed(solution: &Solution<'_>, (number, phases): (usize, &dyn Phases)) -> Vec<(f64, f64)> {
    let trajectory = solution.trajectory();
    let (first, memory) = trajectory.first_phases.get(number).copied().unwrap_or_default();
    let mut spans = Vec::new();
    let mut since = (!is_open(phases, first, memory)).then_some(0.0);
    for own in trajectory.switches.iter().filter(|switch| switch.part == number) {
        match (since, is_open(phases, own.phase, own.memory)) {
            (None, false) => since = Some(own.time),
            (None, true) => spans.push((own.time, own.time)),
            (Some(from), true) => {
                spans.push((from, own.time));
                since = None;
            }
            (Some(_), false) => {}
        }
    }
    spans.extend(since.map(|from| (from, trajectory.t_end)));
    spans
}

/// Spans in order, those that overlap made one.
fn joined(mut spans: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    spans.sort_by(|one, other| one.0.total_cmp(&other.0));
    let mut apart: Vec<(f64, f64)> = Vec::new();
    for span in spans {
        match apart.last_mut() {
            Some(last) if span.0 <= last.1 => last.1 = last.1.max(span.1),
            _ => apart.push(span),
        }
    }
    apart
}

/// The part of a run \[s\] worth a look: from a little before the first contact to a little after
/// the last one, and longer where forces change before or after it; the whole run where it has no
/// flight at its ends, or a short one only.
pub fn excerpt(solution: &Solution<'_>) -> (f64, f64) {
    let end = solution.end();
    let spans = touching(solution);
    let (Some(first), Some(last)) = (spans.first(), spans.last()) else { return (0.0, end) };
    let from = stir(solution, (0.0, first.0)).unwrap_or(first.0);
    let to = stir(solution, (end, last.1)).unwrap_or(last.1);
    let room = ROOM * (to - from);
    let (from, to) = ((from - room).max(0.0), (to + room).min(end));
    if from < to && to - from <= NEARLY_ALL * end { (from, to) } else { (0.0, end) }
}

/// The first time on the way from an end of the run to a contact at which any force is no longer
/// what it is at that end.
fn stir(solution: &Solution<'_>, (outer, inner): (f64, f64)) -> Option<f64> {
    let connections = solution.assembly().connections.iter();
    let forces: Vec<_> = connections.filter_map(|connection| connection.force).collect();
    let forces: Vec<_> = forces.into_iter().map(|force| solution.signal(force)).collect();
    let largest = forces.iter().map(|force| force.bound()).fold(0.0, f64::max);
    let still: Vec<f64> = forces.iter().map(|force| force.value(outer)).collect();
    let time = |look: usize| outer + (inner - outer) * look as f64 / LOOKS as f64;
    // The contact itself is not looked at: its force may begin with a jump.
    (1..LOOKS).map(time).find(|&time| {
        let changed =
            |(force, still): (&&Signal, &f64)| (force.value(time) - still).abs() > STILL * largest;
        forces.iter().zip(&still).any(changed)
    })
}

/// `count` times from one end of `window` \[s\] to the other: regular ones, but closer to each other
/// in and around those of `spans` that are short against the window.
pub fn resolving_times(window: (f64, f64), spans: &[(f64, f64)], count: usize) -> Vec<f64> {
    let (from, to) = window;
    let length = to - from;
    let most = count / (2 * LEAST);
    let is_short = |own: &&(f64, f64)| {
        let own_length = own.1 - own.0;
        own_length > 0.0 && own_length <= SHORT * length && own.1 > from && own.0 < to
    };
    let mut short: Vec<(f64, f64)> = spans.iter().filter(is_short).copied().collect();
    short.sort_by(|one, other| (other.1 - other.0).total_cmp(&(one.1 - one.0)));
    short.truncate(most);
    let with_room = |(start, end): (f64, f64)| {
        let room = ROOM * (end - start);
        ((start - room).max(from), (end + room).min(to))
    };
    let short = joined(short.into_iter().map(with_room).collect());
    let covered: f64 = short.iter().map(|own| own.1 - own.0).sum();
    // A span gets a share of the samples in proportion to its length, and its part of the rest.
    let rise = if covered > 0.0 { SHARE / covered } else { 0.0 };
    let flat = (if covered > 0.0 { 1.0 - SHARE } else { 1.0 }) / length;
    let mut knots = vec![(0.0, from)];
    for &(start, end) in &short {
        let (part, time) = knots[knots.len() - 1];
        let part = part + flat * (start - time);
        knots.push((part, start));
        knots.push((part + (flat + rise) * (end - start), end));
    }
    let last = count.saturating_sub(1).max(1);
    let mut at = 0;
    let time = |index: usize| {
        if index == last {
            return to;
        }
        let part = index as f64 / last as f64;
        while knots.get(at + 1).is_some_and(|knot| knot.0 <= part) {
            at += 1;
        }
        let (known, start) = knots[at];
        let rate = knots.get(at + 1).map_or(flat, |next| (next.0 - known) / (next.1 - start));
        let step = (part - known) / rate;
        if step.is_finite() { (start + step).min(to) } else { start }
    };
    (0..count).map(time).collect()
}

#[cfg(test)]
mod tests;
