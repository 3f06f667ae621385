//! From which other body each body is counted: a spanning tree of springs and dashpots.
//!
//! The deformations of the parts in the tree are unknowns; that of a part beside the tree is the difference of its
//! ends, a sum around a loop. Stiffnesses and dampings of the unknowns are then positive diagonals, to which each part
//! beside the tree adds its own constant times the square of such a sum. Rounding of these sums loses what is smaller
//! than that constant: so the parts beside the tree should be soft, lest the balance of slow motion be lost, and weakly
//! damped, lest that of fast motion be. Where the softest part is not the least damped one, trees between the stiffest
//! and the most damped are tried, and the one that loses least is taken.

use std::collections::{BTreeMap, BTreeSet};

use super::{
    bodies::{Bodies, Groups, Role},
    structure::{MOST_RELATIVE, Structure},
};

/// Up to this loss the tree of the stiffest springs is taken: four bits.
const HARMLESS: f64 = 16.0;
/// Most trees that are tried between the stiffest and the most damped one.
const TRIALS: u32 = 40;

/// All springs and dashpots between two bodies.
#[derive(Debug, Clone, Copy)]
struct Tie {
    ends: [usize; 2],
    /// Sum of the stiffnesses \[N/m\].
    stiffness: f64,
    /// Sum of the dampings \[N s/m\].
    damping: f64,
}

impl Tie {
    /// Force per deformation \[N/m\] of what grows at `rate` \[1/s\].
    fn resistance(&self, rate: f64) -> f64 {
        self.stiffness + rate * self.damping
    }
}

/// For each body the one that it is counted from, in a network whose own time is `time` \[s\].
///
/// Masses are counted from masses and fixed bodies only, because the velocity of a massless body
/// may be the small difference of large terms. Bodies whose place may jump are left out, and what
/// dashpots let jump with them, or tie to nothing, is counted among itself.
pub(super) fn parents(bodies: &Bodies, structure: &Structure, time: f64) -> Vec<Option<usize>> {
    let count = bodies.all.len();
    let is_massless = |body: usize| bodies.all[body].is_massless();
    let ties = ties(structure);
    let (loose, firm): (Vec<Tie>, Vec<Tie>) =
        ties.into_iter().partition(|tie| tie.ends.iter().any(|&end| is_massless(end)));
    let mut neighbours: Vec<Vec<usize>> = vec![Vec::new(); count];
    let mut add = |[a, b]: [usize; 2]| {
        neighbours[a].push(b);
        neighbours[b].push(a);
    };
    // Beside springs, the dashpots along which velocities are counted.
    let is_base = |[a, b]: [usize; 2]| {
        structure.velocity_base[a] == Some(b) || structure.velocity_base[b] == Some(a)
    };
    let counts = |tie: &Tie| tie.stiffness > 0.0 || is_base(tie.ends);
    let mut springs: Vec<Tie> = firm.into_iter().filter(counts).collect();
    springs.sort_by(|a, b| b.stiffness.total_cmp(&a.stiffness));
    let mut masses = Groups::new(count);
    for tie in springs {
        if masses.join(tie.ends[0], tie.ends[1]) {
            add(tie.ends);
        }
    }
    let mut groups = Groups::new(count);
    for tie in loose.iter().filter(|tie| tie.ends.iter().all(|&end| is_massless(end))) {
        groups.join(tie.ends[0], tie.ends[1]);
    }
    let mut parts: BTreeMap<usize, Vec<Tie>> = BTreeMap::new();
    for tie in loose {
        let inner = if is_massless(tie.ends[0]) { tie.ends[0] } else { tie.ends[1] };
        parts.entry(groups.of(inner)).or_default().push(tie);
    }
    for part in parts.values() {
        Part::of(part, is_massless, time)
            .best_tree()
            .into_iter()
            .for_each(|tie| add(part[tie].ends));
    }
    hang(bodies, &neighbours)
}

/// The ties that a tree may go along.
fn ties(structure: &Structure) -> Vec<Tie> {
    let region = regions(structure);
    let anchor = |region: usize| {
        let cluster = structure.clusters.get(region);
        cluster.and_then(|cluster| cluster.anchors.first().copied())
    };
    let is_open = |[a, b]: [usize; 2]| match (region[a], region[b]) {
        (Some(one), Some(other)) => one == other,
        (Some(region), None) => anchor(region) == Some(b),
        (None, Some(region)) => anchor(region) == Some(a),
        (None, None) => false,
    };
    let mut ties: Vec<Tie> = Vec::new();
    let mut numbers: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    let springs = structure.springs.iter().map(|edge| (edge.ends, edge.constant, 0.0));
    let dashpots = structure.dashpots.iter().map(|edge| (edge.ends, 0.0, edge.constant));
    for (ends, stiffness, damping) in springs.chain(dashpots).filter(|spring| is_open(spring.0)) {
        let pair = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let at = *numbers.entry(pair).or_insert(ties.len());
        if at == ties.len() {
            ties.push(Tie { ends, stiffness: 0.0, damping: 0.0 });
        }
        ties[at].stiffness += stiffness;
        ties[at].damping += damping;
    }
    ties
}

/// For each body the region within which it may be counted from others: the number of its cluster
/// where that moves on its own or with a body that jumps, one region behind them for all else.
fn regions(structure: &Structure) -> Vec<Option<usize>> {
    let count = structure.cluster_of.len();
    let all_else = structure.clusters.len();
    let jumps = |body: usize| structure.first_jump[body].is_some();
    let region = |body: usize| match structure.cluster_of[body] {
        Some(at) => {
            let cluster = &structure.clusters[at];
            let is_apart =
                cluster.anchors.is_empty() || cluster.anchors.iter().any(|&anchor| jumps(anchor));
            Some(if is_apart { at } else { all_else })
        }
        None => (!jumps(body)).then_some(all_else),
    };
    let mut regions: Vec<Option<usize>> = (0..count).map(region).collect();
    let mut sizes = vec![0_usize; all_else + 1];
    regions.iter().flatten().for_each(|&region| sizes[region] += 1);
    for region in &mut regions {
        *region = region.filter(|&region| sizes[region] <= MOST_RELATIVE);
    }
    regions
}

/// Massless bodies that hang together, and what ties them to each other and to all else.
struct Part {
    ties: Vec<Tie>,
    /// Number of places: the first stands for all that is not of this part.
    places: usize,
    /// The network's own time \[s\].
    time: f64,
}

impl Part {
    /// Numbers the bodies anew.
    fn of(ties: &[Tie], is_massless: impl Fn(usize) -> bool, time: f64) -> Self {
        let ends = ties.iter().flat_map(|tie| tie.ends).filter(|&end| is_massless(end));
        let inner: BTreeSet<usize> = ends.collect();
        let numbers: BTreeMap<usize, usize> =
            inner.iter().enumerate().map(|(at, &body)| (body, at + 1)).collect();
        let number = |body: usize| numbers.get(&body).copied().unwrap_or(0);
        let ties = ties.iter().map(|tie| Tie { ends: tie.ends.map(number), ..*tie });
        Self { ties: ties.collect(), places: inner.len() + 1, time }
    }

    /// The ties of the tree that loses least.
    fn best_tree(&self) -> Vec<usize> {
        let mut best = self.tree(0.0);
        let mut least = self.loss(&best);
        if least <= HARMLESS {
            return best;
        }
        for rate in self.rates() {
            let tree = self.tree(rate);
            let loss = self.loss(&tree);
            if loss < least {
                (best, least) = (tree, loss);
            }
        }
        best
    }

    /// Rates \[1/s\] from below the slowest to beyond the fastest of stiffness over damping.
    fn rates(&self) -> impl Iterator<Item = f64> + use<> {
        let positive = |value: &f64| *value > 0.0;
        let extremes = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)))
        };
        let stiffnesses = self.ties.iter().map(|tie| tie.stiffness).filter(positive);
        let dampings = self.ties.iter().map(|tie| tie.damping).filter(positive);
        let (softest, stiffest) = extremes(&mut { stiffnesses });
        let (least, most) = extremes(&mut { dampings });
        let (low, high) = ((0.1 * softest / most).log10(), (10.0 * stiffest / least).log10());
        let step = (high - low) / f64::from(TRIALS);
        (0..=TRIALS).map(move |at| 10_f64.powf(low + step * f64::from(at)))
    }

    /// The spanning tree of what resists most at this rate \[1/s\].
    fn tree(&self, rate: f64) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.ties.len()).collect();
        order.sort_by(|&a, &b| {
            let (a, b) = (&self.ties[a], &self.ties[b]);
            let firmer = b.resistance(rate).total_cmp(&a.resistance(rate));
            firmer.then(b.damping.total_cmp(&a.damping))
        });
        let mut groups = Groups::new(self.places);
        order.retain(|&at| groups.join(self.ties[at].ends[0], self.ties[at].ends[1]));
        order
    }

    /// By how much the parts beside the tree exceed those in their loops: in stiffness the softest
    /// spring, in damping the second least damped part, because a loop leaves one of them free.
    ///
    /// Where dashpots flow far over the network's own time, their deformations grow beyond those of
    /// springs. That harms values only, late, and not the equations: it counts as half its decades.
    fn loss(&self, tree: &[usize]) -> f64 {
        let mut neighbours: Vec<Vec<(usize, usize)>> = vec![Vec::new(); self.places];
        for &at in tree {
            let [a, b] = self.ties[at].ends;
            neighbours[a].push((b, at));
            neighbours[b].push((a, at));
        }
        let mut above: Vec<Option<(usize, usize)>> = vec![None; self.places];
        let mut depth = vec![usize::MAX; self.places];
        for root in 0..self.places {
            if depth[root] != usize::MAX {
                continue;
            }
            depth[root] = 0;
            let mut stack = vec![root];
            while let Some(place) = stack.pop() {
                for &(next, at) in &neighbours[place] {
                    if depth[next] == usize::MAX {
                        depth[next] = depth[place] + 1;
                        above[next] = Some((place, at));
                        stack.push(next);
                    }
                }
            }
        }
        let mut is_inside = vec![false; self.ties.len()];
        tree.iter().for_each(|&at| is_inside[at] = true);
        let mut loss = 0.0_f64;
        for tie in self.ties.iter().zip(&is_inside).filter(|own| !own.1).map(|own| own.0) {
            let [mut a, mut b] = tie.ends;
            let [mut softest, mut weakest, mut least, mut second] = [f64::INFINITY; 4];
            while a != b {
                if depth[a] < depth[b] {
                    std::mem::swap(&mut a, &mut b);
                }
                let Some((next, at)) = above[a] else { break };
                let within = &self.ties[at];
                if within.stiffness > 0.0 {
                    softest = softest.min(within.stiffness);
                }
                weakest = weakest.min(within.resistance(1.0 / self.time));
                second = second.min(within.damping.max(least));
                least = least.min(within.damping);
                a = next;
            }
            let damped = if tie.damping > 0.0 { tie.damping / second } else { 0.0 };
            let flown = (tie.resistance(1.0 / self.time) / weakest).sqrt();
            loss = loss.max(tie.stiffness / softest).max(damped).max(flown);
        }
        loss
    }
}

/// Hangs the trees up at masses and given bodies, where they have any.
fn hang(bodies: &Bodies, neighbours: &[Vec<usize>]) -> Vec<Option<usize>> {
    let count = bodies.all.len();
    let is_given = |body: usize| matches!(bodies.all[body].role, Role::Fixed | Role::Prescribed(_));
    let mut roots: Vec<usize> = (0..count).collect();
    roots.sort_by_key(|&body| (bodies.all[body].is_massless(), !is_given(body), body));
    let mut parent = vec![None; count];
    let mut is_done = vec![false; count];
    for root in roots {
        let mut stack = vec![root];
        while let Some(body) = stack.pop() {
            if std::mem::replace(&mut is_done[body], true) {
                continue;
            }
            for &next in &neighbours[body] {
                if !is_done[next] && !is_given(next) && parent[next].is_none() {
                    parent[next] = Some(body);
                    stack.push(next);
                }
            }
        }
    }
    parent
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(time: f64, ties: &[([usize; 2], f64, f64)]) -> Part {
        let ties: Vec<Tie> = ties
            .iter()
            .map(|&(ends, stiffness, damping)| Tie { ends, stiffness, damping })
            .collect();
        let places = 1 + ties.iter().flat_map(|tie| tie.ends).max().unwrap_or(0);
        Part { ties, places, time }
    }

    /// Numbers of the ties that are not in the tree.
    fn beside(part: &Part) -> Vec<usize> {
        let tree = part.best_tree();
        (0..part.ties.len()).filter(|at| !tree.contains(at)).collect()
    }

    #[test]
    fn the_softest_spring_of_a_loop_stays_beside() {
        let chain = part(1.0, &[([0, 1], 1e9, 0.0), ([1, 2], 3e3, 2.0), ([2, 0], 1e6, 0.5)]);
        assert_eq!(beside(&chain), [1]);
    }

    #[test]
    fn of_elements_about_as_stiff_the_least_damped_stays_beside() {
        let elements =
            [([0, 1], 1.0, 1e3), ([1, 2], 1.0, 1e-6), ([2, 3], 0.9, 1e6), ([3, 0], 1.0, 1e3)];
        let chain = part(1.0, &elements);
        assert_eq!(beside(&chain), [1]);
        assert!(chain.loss(&chain.best_tree()) <= 2.0);
    }

    #[test]
    fn a_dashpot_that_hardly_flows_is_in_the_tree() {
        assert_eq!(beside(&part(1.0, &[([0, 1], 0.01, 0.0), ([1, 0], 0.0, 1e6)])), [0]);
        assert_eq!(beside(&part(1.0, &[([0, 1], 1e4, 0.0), ([1, 0], 0.0, 1.0)])), [1]);
    }
}
