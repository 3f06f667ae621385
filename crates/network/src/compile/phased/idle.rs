//! Sliders of which the force follows from nothing.

use super::{super::bodies::Groups, PhasedNetwork};
use crate::phases::{Phase, PhaseLaw};

/// A slider whose ends other parts hold together while it slides neither way: they bear what it does
/// not, and nothing tells how much that is. It is taken to go on with the force that it had.
#[derive(Debug, Clone, PartialEq)]
pub struct IdleSlider {
    /// Paths of the slider and of those that share its force.
    pub sliders: Vec<String>,
    /// Paths of what holds its ends.
    pub held_by: Vec<String>,
}

impl PhasedNetwork {
    /// The sliders of which the force follows from nothing in these phases of all parts.
    pub fn idle_sliders(&self, phases: &[Phase]) -> Vec<IdleSlider> {
        let ends = |part: usize| {
            let primitive = &self.expansion.primitives[self.parts[part]];
            primitive.ends.map(|joint| self.apart.of_joint[joint])
        };
        let law = |part: usize| Some(self.phases_of(self.parts[part])?.law(*phases.get(part)?));
        let (mut held, mut pushing) = (Vec::new(), Vec::new());
        for part in 0..self.parts.len() {
            match law(part) {
                Some(PhaseLaw::Held(_)) => held.push(part),
                Some(PhaseLaw::Force(_)) => pushing.push(part),
                _ => {}
            }
        }
        if held.is_empty() || pushing.is_empty() {
            return Vec::new();
        }
        let joined = |without: Option<usize>| {
            let mut groups = Groups::new(self.apart.all.len());
            for &part in held.iter().filter(|&&part| Some(part) != without) {
                let [a, b] = ends(part);
                groups.join(a, b);
            }
            groups
        };
        let is_held = |groups: &mut Groups, part: usize| {
            let [a, b] = ends(part).map(|end| groups.of(end));
            a == b
        };
        let mut all = joined(None);
        let idle = pushing.into_iter().filter(|&part| is_held(&mut all, part));
        idle.map(|part| {
            let holds = |&other: &usize| !is_held(&mut joined(Some(other)), part);
            let path = |&own: &usize| self.expansion.primitives[self.parts[own]].name.to_string();
            let held_by = held.iter().filter(|other| holds(other)).map(path).collect();
            IdleSlider { sliders: self.sharing(self.parts[part]), held_by }
        })
        .collect()
    }

    /// Paths of the sliders that share the force of a primitive, that itself first.
    fn sharing(&self, primitive: usize) -> Vec<String> {
        let all = self.expansion.primitives.iter().enumerate();
        let own = all.filter(|(at, own)| {
            *at == primitive || own.share.is_some_and(|share| share.of == primitive)
        });
        own.map(|(_, own)| own.name.to_string()).collect()
    }
}
