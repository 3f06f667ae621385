//! Impacts: what jumps where masses meet.

use super::{
    super::{bodies::Role, transfer::State},
    PhasedNetwork,
    groups::Group,
    is_contact,
};
use crate::phases::{Phase, PhaseLaw, Watched};

/// An impact in one contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Impact {
    /// Number of the part.
    pub(super) part: usize,
    /// Impulse that pushes the sides apart \[N s\].
    pub(super) impulse: f64,
    /// Kinetic energy lost \[J\], its share of that of all impacts at the instant.
    pub(super) lost: f64,
    /// Work done by moving supports \[J\], likewise.
    pub(super) worked: f64,
    /// How its sides part again, if by their own restitution.
    pub(super) rebound_speed: Option<ReboundSpeed>,
    /// The bodies that met, on both sides of what is massless.
    pub(super) sides: [usize; 2],
}

/// How fast sides part after an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReboundSpeed {
    /// By less than the threshold: only where it is known when they come back, they part at all.
    BelowThreshold,
    /// By more, but when they come back may be known all the same.
    AboveThreshold,
    /// By more, and it is left to the method when they come back.
    Integrated,
}

/// What parts again after an impact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rebound {
    /// All but what comes back too often.
    All,
    /// What is faster than the threshold.
    Fast,
    /// Nothing.
    None,
}

/// Where masses may meet.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting<'a> {
    /// Whose impacts are asked for.
    pub(super) group: &'a Group,
    /// The phases that end.
    pub(super) phases: &'a [Phase],
    /// For each part whether its deformation is at a level.
    pub(super) touching: &'a [bool],
    /// Parts whose deformation has reached a level \[m\] by the event that ended the interval.
    pub(super) at_level: &'a [(usize, f64)],
    /// Speeds of approach below this part of the speeds are none.
    pub(super) threshold: f64,
    /// What parts again.
    pub(super) rebound: Rebound,
}

/// A contact that may take part in impacts.
struct Candidate {
    part: usize,
    /// Bodies of its sides; of a massless one that which it lies on.
    ends: [usize; 2],
    /// The contacts between massless sides and what they lie on, which pass the impulse on.
    through: Vec<usize>,
    restitution: f64,
    rebound_speed: Option<ReboundSpeed>,
    /// Speed of approach before \[m/s\].
    approach: f64,
    /// Whether it is brought to rest although it moves apart.
    settles: bool,
    /// Whether it closes at this instant.
    closes: bool,
}

impl Candidate {
    /// Whether of two contacts on both sides of what is massless it is this one that stops the masses: what throws
    /// them back more, and of equals what they meet now.
    fn stops_before(&self, other: &Self) -> bool {
        let is_equal = self.restitution.to_bits() == other.restitution.to_bits();
        self.restitution > other.restitution || is_equal && self.closes && !other.closes
    }
}

/// Most sweeps over the contacts of one instant.
const SWEEPS: usize = 20_000;
/// Speeds of rebound below this part of the network's own speeds are none: what bounces so slowly
/// rests. It ends what would bounce infinitely often in a finite time.
const RESTING: f64 = 1e-9;
/// The same of what is followed without a method, in parts of the threshold, so that what is left
/// out is no more than a method's tolerance.
pub(super) const FOLLOWED: f64 = 0.01;
/// Speeds of rebound that can be told from none, in parts of the threshold.
const TOLD: f64 = 4.0;

/// Speeds of approach below this part of the speeds are none at all.
const ROUNDING: f64 = 1e-14;
/// How near to its level a deformation is at it, in parts of the lengths: roundings.
const TOUCHING: f64 = 20.0 * f64::EPSILON;

impl PhasedNetwork {
    /// Applies to `state` the impacts of all contacts of a group at whose level it is: impulses
    /// `p ≥ 0` with which no contact approaches any more, and each that pushes parts with its
    /// restitution times its speed of approach (Newton), at one instant for all.
    pub(super) fn impacts(&self, state: &mut State, meeting: &Meeting<'_>) -> Vec<Impact> {
        let contacts = self.candidates(state, meeting);
        let scale = contacts
            .iter()
            .flat_map(|contact| contact.ends)
            .map(|body| self.velocity(state, body).abs())
            .fold(0.0, f64::max);
        let is_below =
            |part: f64| contacts.iter().all(|own| own.approach <= part * scale && !own.settles);
        if is_below(ROUNDING) {
            return Vec::new();
        }
        let before: Vec<f64> =
            (0..self.apart.all.len()).map(|body| self.velocity(state, body)).collect();
        let mut after = before.clone();
        let impulses = self.impulses(&contacts, &mut after, scale);
        for &body in &meeting.group.bodies {
            if matches!(self.apart.all[body].role, Role::Mass(_)) {
                for &joint in &self.apart.all[body].joints {
                    state.velocity[joint] = after[body];
                }
            }
        }
        // What cannot be told from a touch keeps its momentum, and is no impact.
        if is_below(meeting.threshold) {
            return Vec::new();
        }
        self.booked(&contacts, &impulses, &before, &after)
    }

    /// The impulses of all contacts, by projected sweeps over them; `speeds` become those after.
    fn impulses(&self, contacts: &[Candidate], speeds: &mut [f64], scale: f64) -> Vec<f64> {
        let mobility = |body: usize| match self.apart.all[body].role {
            Role::Mass(mass) => mass.recip(),
            _ => 0.0,
        };
        let mut impulses = vec![0.0_f64; contacts.len()];
        for _ in 0..SWEEPS {
            let mut change = 0.0_f64;
            for (impulse, contact) in impulses.iter_mut().zip(contacts) {
                let [a, b] = contact.ends;
                let ease = mobility(a) + mobility(b);
                let wanted = -contact.restitution * contact.approach.max(0.0);
                let missing = (speeds[a] - speeds[b]) - wanted;
                let next = *impulse + missing / ease;
                let next = if contact.settles { next } else { next.max(0.0) };
                let step = next - *impulse;
                *impulse = next;
                speeds[a] -= step * mobility(a);
                speeds[b] += step * mobility(b);
                change = change.max(step.abs() * ease);
            }
            if change <= 2.0 * f64::EPSILON * scale {
                break;
            }
        }
        impulses
    }

    /// The impacts with their impulses, and their shares of what is lost and of what supports do.
    fn booked(
        &self,
        contacts: &[Candidate],
        impulses: &[f64],
        before: &[f64],
        after: &[f64],
    ) -> Vec<Impact> {
        let lost: f64 = self
            .apart
            .all
            .iter()
            .zip(before.iter().zip(after))
            .map(|(body, (before, after))| match body.role {
                Role::Mass(mass) => 0.5 * mass * (before * before - after * after),
                _ => 0.0,
            })
            .sum();
        // What a moving support gives or takes is work from outside, not a loss.
        let push = |body: usize, impulse: f64| match self.apart.all[body].role {
            Role::Mass(_) => 0.0,
            _ => -impulse * before[body],
        };
        let pushes = contacts.iter().zip(impulses);
        let work: f64 = pushes
            .clone()
            .map(|(own, &impulse)| push(own.ends[0], -impulse) + push(own.ends[1], impulse))
            .sum();
        let total: f64 = impulses.iter().sum();
        let mut met: Vec<Impact> = Vec::new();
        for (own, &impulse) in pushes.filter(|push| *push.1 > 0.0) {
            let share = impulse / total;
            let (lost, worked) = ((lost + work) * share, work * share);
            let own_impact = Impact {
                part: own.part,
                impulse,
                lost,
                worked,
                rebound_speed: own.rebound_speed,
                sides: own.ends,
            };
            met.push(own_impact);
            for &part in &own.through {
                match met.iter_mut().find(|impact| impact.part == part) {
                    Some(passed) => passed.impulse += impulse,
                    None => met.push(Impact { part, lost: 0.0, worked: 0.0, ..own_impact }),
                }
            }
        }
        met
    }

    fn candidates(&self, state: &State, meeting: &Meeting<'_>) -> Vec<Candidate> {
        let Meeting { group, phases, touching, .. } = *meeting;
        let speed = self.group_speed(state, group);
        let mut found = Vec::new();
        for &part in &group.parts {
            let at = self.parts[part];
            let Some(own) = self.phases_of(at).filter(|own| is_contact(*own)) else { continue };
            let closed = matches!(own.law(phases[part]), PhaseLaw::Held(_));
            if !closed && !touching[part] {
                continue;
            }
            let mut through = Vec::new();
            let mut ends = self.sides(at);
            let mut is_borne = true;
            for side in 0..2 {
                if !self.apart.all[ends[side]].is_massless() {
                    continue;
                }
                match self.carrier(ends[side], side, meeting) {
                    Some((carrier, contact)) => {
                        ends[side] = carrier;
                        through.push(contact);
                    }
                    None => is_borne = false,
                }
            }
            // What is massless and lies on nothing takes no impulse.
            if !is_borne || ends[0] == ends[1] {
                continue;
            }
            let is_moved =
                ends.iter().any(|&end| matches!(self.apart.all[end].role, Role::Mass(_)));
            if !is_moved {
                continue;
            }
            let approach = self.velocity(state, ends[0]) - self.velocity(state, ends[1]);
            let restitution = own.restitution();
            let is_above = |least: f64, speed: f64| restitution * approach > least * speed;
            let whole = speed.max(self.speed);
            // What loses nothing in impacts does not come to rest by them.
            let told = if restitution < 1.0 { TOLD * meeting.threshold } else { 0.0 };
            let told = RESTING.max(told);
            let rebound_speed = match meeting.rebound {
                Rebound::All if is_above(told, speed) => Some(ReboundSpeed::AboveThreshold),
                Rebound::Fast if is_above(told, speed) => Some(ReboundSpeed::Integrated),
                Rebound::All if is_above(FOLLOWED * meeting.threshold, whole) => {
                    Some(ReboundSpeed::BelowThreshold)
                }
                _ => None,
            };
            let restitution = if rebound_speed.is_some() { restitution } else { 0.0 };
            // What has reached its level by a motion away from it is there by the method's error.
            let settles = meeting.rebound == Rebound::None
                && approach < 0.0
                && -approach <= meeting.threshold.sqrt() * self.speed
                && meeting.at_level.iter().any(|own| own.0 == part);
            found.push(Candidate {
                part,
                ends,
                through,
                restitution,
                rebound_speed,
                approach,
                settles,
                closes: !closed,
            });
        }
        one_of_each_chain(found)
    }

    /// The bodies on both sides of a primitive.
    pub(super) fn sides(&self, primitive: usize) -> [usize; 2] {
        self.expansion.primitives[primitive].ends.map(|joint| self.apart.of_joint[joint])
    }

    /// The body with mass or a given motion on which a massless one lies, or comes to lie at this
    /// instant, behind it as seen from its contact on the given side, and the contact between the two.
    fn carrier(
        &self,
        massless: usize,
        side: usize,
        meeting: &Meeting<'_>,
    ) -> Option<(usize, usize)> {
        self.parts.iter().enumerate().find_map(|(part, &at)| {
            let own = self.phases_of(at).filter(|own| is_contact(*own))?;
            let is_held = matches!(own.law(meeting.phases[part]), PhaseLaw::Held(_));
            let is_closed = is_held || meeting.touching[part];
            let ends = self.sides(at);
            let other = ends[side];
            let bears = ends[1 - side] == massless && !self.apart.all[other].is_massless();
            (is_closed && bears).then_some((other, part))
        })
    }

    /// The velocity of a body apart \[m/s\]; of no meaning for a massless one.
    pub(super) fn velocity(&self, state: &State, body: usize) -> f64 {
        let joints = &self.apart.all[body].joints;
        let rules = |joint: usize| {
            self.network
                .nodes
                .get(joint)
                .is_some_and(|node| node.mass > 0.0 || node.support != crate::Support::Free)
        };
        let joint = joints.iter().copied().find(|&joint| rules(joint)).unwrap_or(joints[0]);
        state.velocity[joint]
    }

    /// For each part whether it is at a level of its deformation at which a phase ends.
    ///
    /// What has not been reached and is nearer than rounding tells is taken to be there. It is not
    /// looked for as far as the threshold: of two levels that follow each other closely, each has
    /// its own instant, and two impacts one after the other are not two at once.
    pub(super) fn touching(
        &self,
        state: &State,
        phases: &[Phase],
        fired: &[(usize, usize)],
    ) -> Vec<bool> {
        let size = self.own_length(state);
        let at_level = |part: usize| {
            let at = self.parts[part];
            let Some(own) = self.phases_of(at) else { return false };
            let deformation = state.deformation[at];
            own.exits(phases[part]).iter().enumerate().any(|(number, exit)| {
                exit.watched == Watched::Deformation
                    && (fired.contains(&(part, number))
                        || (deformation - exit.level).abs() <= TOUCHING * (size + exit.level.abs())
                        || if exit.rising {
                            deformation > exit.level
                        } else {
                            deformation < exit.level
                        })
            })
        };
        (0..self.parts.len()).map(at_level).collect()
    }
}

/// Of the contacts on both sides of what is massless only one: masses that meet through both have one impact.
fn one_of_each_chain(candidates: Vec<Candidate>) -> Vec<Candidate> {
    let mut kept: Vec<Candidate> = Vec::with_capacity(candidates.len());
    for candidate in candidates {
        let is_of_chain = |other: &Candidate| {
            other.through.contains(&candidate.part) && candidate.through.contains(&other.part)
        };
        match kept.iter_mut().find(|other| is_of_chain(other)) {
            None => kept.push(candidate),
            Some(other) if candidate.stops_before(other) => *other = candidate,
            Some(_) => {}
        }
    }
    kept
}
