//! Impacts: what jumps where masses meet.

use super::{
    super::{bodies::Role, carry::State},
    PhasedNetwork, is_contact,
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
}

/// A contact that may take part in impacts.
struct Candidate {
    part: usize,
    /// Bodies of its sides; of a massless one that which it lies on.
    ends: [usize; 2],
    /// The contacts between massless sides and what they lie on, which pass the impulse on.
    through: Vec<usize>,
    restitution: f64,
    /// Speed of approach before \[m/s\].
    approach: f64,
}

/// Most sweeps over the contacts of one instant.
const SWEEPS: usize = 20_000;
/// Speeds of rebound below this part of the network's own speeds are none: what bounces so slowly
/// rests. It ends what would bounce infinitely often in a finite time.
const RESTING: f64 = 1e-9;

impl PhasedNetwork {
    /// Applies to `state` the impacts of all contacts at whose level it is: impulses `p ≥ 0` with
    /// which no contact approaches any more, and each that pushes parts with its restitution times
    /// its speed of approach (Newton), at one instant for all.
    ///
    /// Without `rebound` none of them parts.
    pub(super) fn impacts(
        &self,
        state: &mut State,
        phases: &[Phase],
        touching: &[bool],
        doubt: f64,
        rebound: bool,
    ) -> Vec<Impact> {
        let slowest =
            if rebound { self.own_speed(state) * RESTING.max(4.0 * doubt) } else { f64::INFINITY };
        let contacts = self.candidates(state, phases, touching, slowest);
        let noise = doubt.max(1e-14);
        let scale = contacts
            .iter()
            .flat_map(|own| own.ends)
            .map(|body| self.velocity(state, body).abs())
            .fold(0.0, f64::max);
        if contacts.iter().all(|own| own.approach <= noise * scale) {
            return Vec::new();
        }
        let mobility = |body: usize| match self.apart.all[body].role {
            Role::Mass(mass) => mass.recip(),
            _ => 0.0,
        };
        let count = self.apart.all.len();
        let before: Vec<f64> = (0..count).map(|body| self.velocity(state, body)).collect();
        let mut after = before.clone();
        let mut impulses = vec![0.0_f64; contacts.len()];
        for _ in 0..SWEEPS {
            let mut change = 0.0_f64;
            for (impulse, contact) in impulses.iter_mut().zip(&contacts) {
                let [a, b] = contact.ends;
                let ease = mobility(a) + mobility(b);
                let wanted = -contact.restitution * contact.approach.max(0.0);
                let missing = (after[a] - after[b]) - wanted;
                let next = (*impulse + missing / ease).max(0.0);
                let step = next - *impulse;
                *impulse = next;
                after[a] -= step * mobility(a);
                after[b] += step * mobility(b);
                change = change.max(step.abs() * ease);
            }
            if change <= 2.0 * f64::EPSILON * scale {
                break;
            }
        }
        let energy = |body: usize, speed: f64| match self.apart.all[body].role {
            Role::Mass(mass) => 0.5 * mass * speed * speed,
            _ => 0.0,
        };
        let total: f64 = impulses.iter().sum();
        let lost: f64 =
            (0..count).map(|body| energy(body, before[body]) - energy(body, after[body])).sum();
        // What a moving support gives or takes is work from outside, not a loss.
        let work: f64 = contacts
            .iter()
            .zip(&impulses)
            .flat_map(|(own, &impulse)| {
                [(own.ends[0], -impulse), (own.ends[1], impulse)].map(|(body, push)| {
                    if matches!(self.apart.all[body].role, Role::Mass(_)) {
                        0.0
                    } else {
                        -push * before[body]
                    }
                })
            })
            .sum();
        for (joint, body) in self.apart.of_joint.iter().enumerate() {
            if matches!(self.apart.all[*body].role, Role::Mass(_)) {
                state.velocity[joint] = after[*body];
            }
        }
        let mut met: Vec<Impact> = Vec::new();
        for (own, &impulse) in contacts.iter().zip(&impulses).filter(|own| *own.1 > 0.0) {
            let (lost, worked) = ((lost + work) * impulse / total, work * impulse / total);
            met.push(Impact { part: own.part, impulse, lost, worked });
            for &part in &own.through {
                match met.iter_mut().find(|impact| impact.part == part) {
                    Some(passed) => passed.impulse += impulse,
                    None => met.push(Impact { part, impulse, lost: 0.0, worked: 0.0 }),
                }
            }
        }
        met
    }

    fn candidates(
        &self,
        state: &State,
        phases: &[Phase],
        touching: &[bool],
        slowest: f64,
    ) -> Vec<Candidate> {
        let mut found = Vec::new();
        for (part, &at) in self.parts.iter().enumerate() {
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
                match self.carrier(ends[side], side, phases) {
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
            let rebounds = restitution * approach > slowest;
            let restitution = if rebounds { restitution } else { 0.0 };
            found.push(Candidate { part, ends, through, restitution, approach });
        }
        found
    }

    /// The bodies on both sides of a primitive.
    fn sides(&self, primitive: usize) -> [usize; 2] {
        self.expansion.primitives[primitive].ends.map(|joint| self.apart.of_joint[joint])
    }

    /// The body with mass or a given motion on which a massless one lies, behind it as seen from its
    /// contact on the given side, and the closed contact between the two.
    fn carrier(&self, massless: usize, side: usize, phases: &[Phase]) -> Option<(usize, usize)> {
        self.parts.iter().enumerate().find_map(|(part, &at)| {
            let own = self.phases_of(at).filter(|own| is_contact(*own))?;
            let is_closed = matches!(own.law(phases[part]), PhaseLaw::Held(_));
            let ends = self.sides(at);
            let other = ends[side];
            let bears = ends[1 - side] == massless && !self.apart.all[other].is_massless();
            (is_closed && bears).then_some((other, part))
        })
    }

    fn velocity(&self, state: &State, body: usize) -> f64 {
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
    pub(super) fn touching(
        &self,
        state: &State,
        phases: &[Phase],
        fired: &[(usize, usize)],
        doubt: f64,
    ) -> Vec<bool> {
        let size = self.own_length(state);
        let at_level = |part: usize| {
            let at = self.parts[part];
            let Some(own) = self.phases_of(at) else { return false };
            let deformation = state.deformation[at];
            own.exits(phases[part]).iter().enumerate().any(|(number, exit)| {
                exit.watched == Watched::Deformation
                    && (fired.contains(&(part, number))
                        || (deformation - exit.level).abs() <= doubt * (size + exit.level.abs())
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
