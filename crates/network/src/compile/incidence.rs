//! What acts on each joint and body.

use std::collections::BTreeMap;

use dashpot_numerics::packed;

use super::{drives::Drive, expand::Expansion};

/// The primitives at each joint and the drives of each body.
#[derive(Debug)]
pub(super) struct Incidence {
    /// Where the primitives of each joint end in `primitives`.
    ends: Vec<u32>,
    /// Primitives, each with the sign of its force on the joint.
    primitives: Vec<(u32, f32)>,
    /// Drives by body, and by node, where there are any.
    by_body: BTreeMap<usize, Vec<usize>>,
    by_node: BTreeMap<usize, Vec<usize>>,
}

impl Incidence {
    pub(super) fn of(expansion: &Expansion, drives: &[Drive]) -> Self {
        let mut ends = vec![0_u32; expansion.joints];
        for joint in expansion.primitives.iter().flat_map(|primitive| primitive.ends) {
            ends[joint] += 1;
        }
        let mut sum = 0;
        for end in &mut ends {
            let count = *end;
            *end = sum;
            sum += count;
        }
        let mut primitives = vec![(0, 0.0); sum as usize];
        for (at, primitive) in expansion.primitives.iter().enumerate() {
            for (joint, sign) in primitive.ends.into_iter().zip([-1.0, 1.0]) {
                primitives[ends[joint] as usize] = (packed(at), sign);
                ends[joint] += 1;
            }
        }
        let mut by_body: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut by_node = by_body.clone();
        for (at, drive) in drives.iter().enumerate() {
            by_body.entry(drive.body).or_default().push(at);
            by_node.entry(drive.node).or_default().push(at);
        }
        Self { ends, primitives, by_body, by_node }
    }

    /// The primitives at a joint, each with the sign of its force on it.
    pub(super) fn at_joint(&self, joint: usize) -> impl Iterator<Item = (usize, f64)> {
        let start = joint.checked_sub(1).map_or(0, |before| self.ends[before]);
        let own = &self.primitives[start as usize..self.ends[joint] as usize];
        own.iter().map(|&(at, sign)| (at as usize, f64::from(sign)))
    }

    /// The drives of a body.
    pub(super) fn drives<'p>(
        &'p self,
        drives: &'p [Drive],
        body: usize,
    ) -> impl Iterator<Item = &'p Drive> {
        self.by_body.get(&body).into_iter().flatten().map(|&at| &drives[at])
    }

    /// The drives of a node.
    pub(super) fn drives_at<'p>(
        &'p self,
        drives: &'p [Drive],
        node: usize,
    ) -> impl Iterator<Item = &'p Drive> {
        self.by_node.get(&node).into_iter().flatten().map(|&at| &drives[at])
    }
}
