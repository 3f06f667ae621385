//! Sums over what hangs on either side of each link, in one pass over all of them.

/// What can be summed up over joints.
pub(super) trait Sum: Clone {
    /// The sum of both.
    #[must_use]
    fn plus(&self, other: &Self) -> Self;
}

/// The sums over the joints on both sides of links. A side takes its joints from the sum of the next one
/// beyond it, so that all sides of all links together are as many sums as there are links.
#[derive(Debug)]
pub(super) struct Sides<S> {
    /// For each link that is the only way between its sides the joint below it, and whether that is its first end.
    below: Vec<Option<(usize, bool)>>,
    /// The sum over each joint and those below it.
    down: Vec<S>,
    /// The sum over all others that hang together with it.
    up: Vec<Option<S>>,
}

impl<S: Sum> Sides<S> {
    /// The sums of what `own` gives for each of the joints that `links` join.
    pub(super) fn of(links: &[[usize; 2]], own: impl Fn(usize) -> S) -> Self {
        let mut joints: Vec<usize> = links.iter().flatten().copied().collect();
        joints.sort_unstable();
        joints.dedup();
        let place = |joint: usize| joints.partition_point(|&other| other < joint);
        let ends: Vec<[usize; 2]> = links.iter().map(|ends| ends.map(place)).collect();
        let forest = Forest::of(joints.len(), &ends);
        let own: Vec<S> = joints.into_iter().map(own).collect();
        let mut down = own.clone();
        for &joint in forest.order.iter().rev() {
            if let Some((above, _)) = forest.above[joint] {
                down[above] = down[above].plus(&down[joint]);
            }
        }
        let up = forest.upwards(&own, &down);
        let mut below = vec![None; links.len()];
        for (joint, above) in forest.above.iter().enumerate() {
            if let Some((_, link)) = above.filter(|_| forest.reach[joint] == forest.rank[joint]) {
                below[link] = Some((joint, ends[link][0] == joint));
            }
        }
        Self { below, down, up }
    }

    /// The sums on the sides of the first and of the second end of a link; `None` where there is another
    /// way between them.
    pub(super) fn of_link(&self, link: usize) -> Option<[&S; 2]> {
        let (joint, is_first) = self.below[link]?;
        let (down, up) = (&self.down[joint], self.up[joint].as_ref()?);
        Some(if is_first { [down, up] } else { [up, down] })
    }
}

/// The joints in order of a search that goes deep first, tree by tree.
struct Forest {
    order: Vec<usize>,
    /// The place of each joint in that order.
    rank: Vec<usize>,
    /// The joint from which each was reached, and by which link.
    above: Vec<Option<(usize, usize)>>,
    /// The lowest rank that links lead to from each joint and those below it, but for the link above it.
    reach: Vec<usize>,
}

impl Forest {
    fn of(joints: usize, links: &[[usize; 2]]) -> Self {
        let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); joints];
        for (link, &[a, b]) in links.iter().enumerate() {
            neighbours[a].push((b, link));
            neighbours[b].push((a, link));
        }
        let mut own = Self {
            order: Vec::with_capacity(joints),
            rank: vec![usize::MAX; joints],
            above: vec![None; joints],
            reach: vec![usize::MAX; joints],
        };
        for root in 0..joints {
            if own.rank[root] == usize::MAX {
                own.search(root, &neighbours);
            }
        }
        for at in (0..joints).rev() {
            let joint = own.order[at];
            let (above, by) = own.above[joint].unzip();
            let others = neighbours[joint].iter().filter(|own| Some(own.1) != by);
            let reach = others.map(|other| own.rank[other.0]).fold(own.rank[joint], usize::min);
            own.reach[joint] = own.reach[joint].min(reach);
            if let Some(above) = above {
                own.reach[above] = own.reach[above].min(own.reach[joint]);
            }
        }
        own
    }

    fn search(&mut self, root: usize, neighbours: &[Vec<(usize, usize)>]) {
        let mut stack = vec![(root, 0)];
        self.visit(root);
        while let Some((joint, at)) = stack.last_mut() {
            let Some(&(next, link)) = neighbours[*joint].get(*at) else {
                stack.pop();
                continue;
            };
            *at += 1;
            if self.rank[next] == usize::MAX {
                self.above[next] = Some((*joint, link));
                self.visit(next);
                stack.push((next, 0));
            }
        }
    }

    fn visit(&mut self, joint: usize) {
        self.rank[joint] = self.order.len();
        self.order.push(joint);
    }

    /// For each joint the sum over all that hangs together with it but those below it and itself.
    fn upwards<S: Sum>(&self, own: &[S], down: &[S]) -> Vec<Option<S>> {
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); own.len()];
        for &joint in &self.order {
            if let Some((above, _)) = self.above[joint] {
                below[above].push(joint);
            }
        }
        let mut up: Vec<Option<S>> = vec![None; own.len()];
        for &joint in &self.order {
            // What comes before each of those below, and then what comes behind it.
            let mut sum =
                up[joint].as_ref().map_or_else(|| own[joint].clone(), |up| up.plus(&own[joint]));
            for &next in &below[joint] {
                up[next] = Some(sum.clone());
                sum = sum.plus(&down[next]);
            }
            let mut behind: Option<S> = None;
            for &next in below[joint].iter().rev() {
                if let (Some(before), Some(behind)) = (&up[next], &behind) {
                    up[next] = Some(before.plus(behind));
                }
                behind = Some(
                    behind.map_or_else(|| down[next].clone(), |behind| down[next].plus(&behind)),
                );
            }
        }
        up
    }
}

#[cfg(test)]
mod tests {
    use std::{cell::Cell, collections::BTreeSet};

    use super::*;

    impl Sum for BTreeSet<usize> {
        fn plus(&self, other: &Self) -> Self {
            assert!(self.is_disjoint(other), "{self:?} {other:?}");
            self | other
        }
    }

    /// What is reached from one end of a link without it; `None` where the other end is.
    fn side(links: &[[usize; 2]], cut: usize, end: usize) -> Option<BTreeSet<usize>> {
        let mut reached = BTreeSet::from([links[cut][end]]);
        loop {
            let others = links.iter().enumerate().filter(|own| own.0 != cut).map(|own| own.1);
            let next: Vec<usize> = others
                .filter(|other| other.iter().any(|at| reached.contains(at)))
                .flatten()
                .copied()
                .collect();
            let before = reached.len();
            reached.extend(next);
            if reached.len() == before {
                return (!reached.contains(&links[cut][1 - end])).then_some(reached);
            }
        }
    }

    #[test]
    fn sides_are_what_is_reached_without_the_link() {
        let mut stream = dashpot_numerics::Stream::new(7);
        let mut random = |below: usize| stream.below(below);
        for _ in 0..400 {
            let (joints, count) = (2 + random(9), 1 + random(12));
            // Few loops: most links lead to what was there before.
            let mut links = Vec::new();
            for at in 0..count {
                let from = if random(4) == 0 { 1 + random(joints) } else { at + 1 };
                let [from, to] = [from, random(from)].map(|joint| 3 * joint);
                links.push(if random(2) == 0 { [from, to] } else { [to, from] });
            }
            let found = Sides::of(&links, |joint| BTreeSet::from([joint]));
            for at in 0..links.len() {
                let expected = side(&links, at, 0).zip(side(&links, at, 1));
                let own = found.of_link(at).map(|[a, b]| (a.clone(), b.clone()));
                assert_eq!(own, expected, "link {at} of {links:?}");
            }
        }
    }

    thread_local! {
        static SUMS: Cell<usize> = const { Cell::new(0) };
    }

    #[derive(Clone)]
    struct Counted;

    impl Sum for Counted {
        fn plus(&self, _other: &Self) -> Self {
            SUMS.set(SUMS.get() + 1);
            Self
        }
    }

    #[test]
    fn sums_are_as_many_as_the_links() {
        let count = 5000;
        let shapes: [&dyn Fn(usize) -> usize; 3] = [&|at| at - 1, &|_| 0, &|at| (at - 1) / 2];
        for (number, shape) in shapes.iter().enumerate() {
            let links: Vec<[usize; 2]> = (1..count).map(|at| [shape(at), at]).collect();
            SUMS.set(0);
            let _ = Sides::of(&links, |_| Counted);
            assert!(SUMS.get() <= 6 * count, "shape {number}: {} sums", SUMS.get());
        }
    }
}
