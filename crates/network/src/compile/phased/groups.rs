//! Parts that act on each other at one instant.

use super::{
    super::{
        bodies::{Groups, Role},
        transfer::State,
    },
    PhasedNetwork,
};
use crate::network::start_velocity;
use crate::phases::{Phase, PhaseLaw};

/// Parts whose phases bear on one another at an instant, and the bodies that can pass that on. What
/// happens in one group is nothing to the others: only what is held, or is given a motion, is between.
#[derive(Debug, Clone, Default)]
pub(super) struct Group {
    /// Numbers of the parts in rising order.
    pub(super) parts: Vec<usize>,
    /// Numbers of the bodies apart that move, in rising order.
    pub(super) bodies: Vec<usize>,
    /// Those that are held, or given a motion, and touch a part of the group.
    pub(super) anchors: Vec<usize>,
}

impl PhasedNetwork {
    /// All parts in groups, of which `options` are the phases in reach.
    ///
    /// What is open and stays so joins nothing; everything else does, however little it passes on
    /// at once: springs do by the higher derivatives, by which it is judged who stays.
    pub(super) fn groups(&self, options: &[Vec<Phase>]) -> Vec<Group> {
        let count = self.apart.all.len();
        let mut joined = Groups::new(count);
        let mut part_of = vec![None; self.expansion.primitives.len()];
        for (part, &at) in self.parts.iter().enumerate() {
            part_of[at] = Some(part);
        }
        for (at, part) in part_of.iter().enumerate() {
            let [a, b] = self.sides(at);
            let passes = part.is_none_or(|part| !self.stays_open(part, &options[part]));
            if passes && !self.is_anchor(a) && !self.is_anchor(b) {
                joined.join(a, b);
            }
        }
        let mut groups: Vec<Group> = Vec::new();
        let mut of_body: Vec<Option<usize>> = vec![None; count];
        for (part, &at) in self.parts.iter().enumerate() {
            let sides = self.sides(at);
            let root = sides.into_iter().find(|&side| !self.is_anchor(side));
            let root = root.map(|side| joined.of(side));
            let known = root.and_then(|root| of_body[root]);
            let group = known.unwrap_or_else(|| {
                groups.push(Group::default());
                groups.len() - 1
            });
            if let Some(root) = root {
                of_body[root] = Some(group);
            }
            groups[group].parts.push(part);
            groups[group].anchors.extend(sides.into_iter().filter(|&side| self.is_anchor(side)));
        }
        for body in (0..count).filter(|&body| !self.is_anchor(body)) {
            if let Some(group) = of_body[joined.of(body)] {
                groups[group].bodies.push(body);
            }
        }
        groups
    }

    /// The largest speed of a group's own \[m/s\]: that it begins with, or has.
    pub(super) fn group_speed(&self, state: &State, group: &Group) -> f64 {
        let bodies = group.bodies.iter().chain(&group.anchors);
        let joints = bodies.flat_map(|&body| &self.apart.all[body].joints);
        let speed = |&joint: &usize| {
            let start = self.network.nodes.get(joint).map(|node| node.start);
            let start = start.map_or(0.0, |start| start_velocity(&self.network, start));
            start.abs().max(state.velocity[joint].abs())
        };
        joints.map(speed).filter(|own| own.is_finite()).fold(0.0, f64::max)
    }

    /// Whether a body is held, or given a motion.
    pub(super) fn is_anchor(&self, body: usize) -> bool {
        matches!(self.apart.all[body].role, Role::Fixed | Role::Prescribed(_))
    }

    fn stays_open(&self, part: usize, options: &[Phase]) -> bool {
        let law = |&phase: &Phase| self.phases_of(self.parts[part]).map(|own| own.law(phase));
        matches!(options, [only] if matches!(law(only), Some(PhaseLaw::Open)))
    }
}
