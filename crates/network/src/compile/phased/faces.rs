//! What is struck through a contact with a massless side.

use std::collections::HashSet;

use super::{
    super::{assemble::Compiled, bodies::Groups},
    PhasedNetwork, is_contact,
};
use crate::phases::{Phase, PhaseLaw};

/// A contact with a massless side.
struct Face {
    /// The bodies apart on both sides.
    ends: [usize; 2],
    /// In which order it is looked at: what lies on something from the start belongs to that, whatever else it
    /// meets later; then comes what strikes, then what has mass.
    rank: (bool, usize),
}

impl PhasedNetwork {
    /// Numbers the bodies as if every contact with a massless side were closed, so that what is
    /// struck through one belongs to the body that strikes, whichever phase the run begins in. A massless
    /// side of several belongs to one body only.
    pub(super) fn join_bodies(&self, compiled: &mut Compiled) {
        let mut groups = Groups::new(self.apart.all.len());
        let mut has_joined = vec![false; self.apart.all.len()];
        for Face { ends, .. } in self.faces() {
            let massless = || ends.into_iter().filter(|&end| self.apart.all[end].is_massless());
            if massless().all(|end| !has_joined[end]) {
                groups.join(ends[0], ends[1]);
                massless().for_each(|end| has_joined[end] = true);
            }
        }
        for (at, node) in compiled.nodes.iter_mut().enumerate() {
            node.body = groups.of(self.apart.of_joint[at]);
        }
        for connection in &mut compiled.connections {
            let [a, b] = connection.between.map(|id| groups.of(self.apart.of_joint[id.index()]));
            connection.is_rigid = a == b;
        }
    }

    /// The contacts between nodes that have a massless side, in the order of their ranks. One that has
    /// something beside it that deforms with it, as a stop has, is not among them: that is struck itself.
    fn faces(&self) -> Vec<Face> {
        let contact = |at: usize| self.phases_of(at).filter(|own| is_contact(*own));
        let sorted = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
        let all = 0..self.expansion.primitives.len();
        let deforming: HashSet<[usize; 2]> =
            all.filter(|&at| contact(at).is_none()).map(|at| sorted(self.sides(at))).collect();
        let likeness = |end: usize| match &self.apart.all[end] {
            body if body.is_massless() => 2,
            body => usize::from(!body.is_impactor),
        };
        let face = |(&at, first): (&usize, &Phase)| {
            let (own, ends) = (contact(at)?, self.sides(at));
            let joints = self.expansion.primitives[at].ends;
            let is_face = joints.iter().all(|&joint| joint < self.network.nodes.len())
                && ends.iter().any(|&end| self.apart.all[end].is_massless())
                && !deforming.contains(&sorted(ends));
            let is_open = !matches!(own.law(*first), PhaseLaw::Held(_));
            let other = ends.into_iter().map(likeness).min().unwrap_or(2);
            is_face.then_some(Face { ends, rank: (is_open, other) })
        };
        let mut faces: Vec<Face> = self.parts.iter().zip(&self.first).filter_map(face).collect();
        faces.sort_by_key(|face| face.rank);
        faces
    }
}
