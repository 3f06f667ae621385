//! Paddings that are struck through a face with a mass of its own.

use dashpot_dae::Signal;
use dashpot_network::{Assembly, NodeId};

use crate::impact::{
    contacts,
    impulses::VelocityJump,
    interval::{Contact, Impact, NO_PULL, Push, SLIGHT, pushes},
};

/// The contact through which an element is struck, where its face is a body that can part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct FaceContact {
    /// The connection between the face and what strikes it.
    pub(crate) connection: usize,
    /// The ends of the element, with what strikes the face in place of the face.
    pub(crate) ends: [usize; 2],
}

/// The contact of the face of the element number `element`, where that has mass.
pub(crate) fn face_contact(assembly: &Assembly, element: usize) -> Option<FaceContact> {
    let own = &assembly.connections[element];
    let (face, connection) = assembly.pad(element).and_then(|pad| pad.face.zip(pad.contact))?;
    let (node, contact) = (&assembly.nodes[face], &assembly.connections[connection]);
    if !(node.free && node.mass > 0.0) {
        return None;
    }
    let mut ends = own.between.map(NodeId::index);
    if !contacts::has_contact(assembly, contact) {
        return None;
    }
    let [from, to] = contact.between.map(NodeId::index);
    let striker = if from == face { to } else { from };
    for end in ends.iter_mut().filter(|end| **end == face) {
        *end = striker;
    }
    Some(FaceContact { connection, ends })
}

/// What acts on the face of a padding, and the padding's own force.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Struck<'a> {
    /// The force between the face and what strikes it.
    pub(crate) touch: &'a Signal,
    /// The impulses there.
    pub(crate) jumps: &'a [VelocityJump],
    /// The force of the padding.
    pub(crate) padding: &'a Signal,
    /// End of the run \[s\].
    pub(crate) run_end: f64,
}

/// The impact of a padding that is struck through its face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Through {
    /// From the first touch of the face until what struck it has left.
    pub(crate) touch: Impact,
    /// From the first touch of the face until the padding is unloaded.
    pub(crate) whole: Impact,
    /// Whether that is more than the first contact of the face.
    pub(crate) is_more: bool,
}

impl Struck<'_> {
    /// The impact; see [`Impact`].
    pub(crate) fn impact(&self) -> Through {
        let first = Impact::of_contact(self.touch, self.jumps, self.run_end, NO_PULL);
        if !first.has_ended() {
            return Through { touch: first, whole: first, is_more: false };
        }
        // At the start of a run nothing is known of what the padding bore before.
        let rest = if first.start > 0.0 { self.padding.left_value(first.start) } else { 0.0 };
        let pushes = pushes(self.touch);
        let mut last = first;
        let mut most = self.most(last, rest);
        let mut next = self.next(&pushes, last.end);
        while let Some(start) = next {
            let gap = (last.end, start);
            if last.contact == Contact::Lasting || self.unloads(gap, rest, most) {
                break;
            }
            last = self.contact(&pushes, start);
            let between = self.padding.maximum(within(gap)).value - rest;
            most = most.max(between).max(self.most(last, rest));
            next = self.next(&pushes, last.end);
        }
        let touch = Impact { start: first.start, ..last };
        let tail = self.tail(last, next.unwrap_or(self.run_end), rest, most);
        let whole = tail.map_or(touch, |tail| Impact { start: first.start, ..tail });
        Through { touch, whole, is_more: last != first || tail.is_some() }
    }

    /// The next contact of the face after `time` \[s\].
    fn next(&self, pushes: &[Push], time: f64) -> Option<f64> {
        let jump = self.jumps.iter().map(|jump| jump.time).find(|&at| at > time);
        let push = pushes.iter().map(|push| push.start).find(|&at| at > time);
        jump.into_iter().chain(push).reduce(f64::min)
    }

    /// The contact of the face that begins at `start` \[s\].
    fn contact(&self, pushes: &[Push], start: f64) -> Impact {
        let run =
            Impact { start, end: self.run_end, end_error: Some(0.0), contact: Contact::Lasting };
        if pushes.iter().any(|push| push.holds(start)) {
            return Impact::of_push(self.touch, run, NO_PULL);
        }
        let end_error = self.touch.error.map(|_| 4.0 * f64::EPSILON * start);
        Impact { end: start, end_error, contact: Contact::Parted, ..run }
    }

    /// The most that the padding bears in a contact of its face, above `rest` \[N\].
    fn most(&self, contact: Impact, rest: f64) -> f64 {
        let last = self.padding.value(contact.end);
        let most = self.padding.maximum(within((contact.start, contact.end))).value;
        // Of an impulse, what follows it counts.
        if contact.end > contact.start { most - rest } else { last - rest }
    }

    /// Whether the padding loses its load between two contacts of its face.
    fn unloads(&self, gap: (f64, f64), rest: f64, most: f64) -> bool {
        let window = within(gap);
        let least = |window: (f64, f64)| self.padding.minimum(window).value - rest;
        let noise = self.padding.noise;
        if most > noise && least(window) <= SLIGHT * most {
            return true;
        }
        let peak = self.padding.maximum(window);
        let height = peak.value - rest;
        height > noise && least((peak.time, window.1)) <= SLIGHT * height
    }

    /// How the impact of the padding ends, where it is still loaded when its face is left.
    fn tail(&self, last: Impact, until: f64, rest: f64, most: f64) -> Option<Impact> {
        if last.contact == Contact::Lasting || last.end >= until {
            return None;
        }
        let height = self.padding.value(last.end) - rest;
        let is_thrown =
            last.end <= last.start && self.padding.departure(rest, last.end) == Some(true);
        if !is_thrown && height <= (SLIGHT * most).max(self.padding.noise) {
            return None;
        }
        let window = (last.end, until);
        let fall = |level: f64| self.padding.first_crossing(level, window, Some(false));
        let most = most.max(self.padding.maximum(within(window)).value - rest);
        let fallen = fall(rest).or_else(|| fall(rest + SLIGHT * most));
        let fallen = fallen.map(|fallen| {
            let shift = |error: f64| {
                (error / fallen.slope.abs()).min(self.run_end) + 4.0 * f64::EPSILON * fallen.time
            };
            Impact { end: fallen.time, end_error: self.padding.error.map(shift), ..last }
        });
        let run = Impact { start: last.end, end: self.run_end, end_error: Some(0.0), ..last };
        let run = Impact { contact: Contact::Lasting, ..run };
        let rested = Some(Impact::of_push(self.padding, run, NO_PULL));
        let rested =
            rested.filter(|rested| rested.contact == Contact::Parted && rested.end <= until);
        let earlier = |one: Impact, other: Impact| if other.end < one.end { other } else { one };
        Some(fallen.into_iter().chain(rested).reduce(earlier).unwrap_or(run))
    }
}

/// A window without its ends, at which forces jump.
fn within(window: (f64, f64)) -> (f64, f64) {
    const MARGIN: f64 = 1e-3;
    let margin = MARGIN * (window.1 - window.0);
    (window.0 + margin, window.1 - margin)
}
