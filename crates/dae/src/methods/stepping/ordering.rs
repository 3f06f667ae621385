//! Orders of unknowns that make the band of a matrix narrow.

use std::collections::VecDeque;

use dashpot_numerics::packed;

/// An order of unknowns, and the band that it gives to a matrix.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Order {
    /// The unknown at each place.
    pub(super) unknowns: Vec<u32>,
    /// Distance of the farthest entry from the diagonal.
    pub(super) reach: usize,
}

/// The order of `size` unknowns in which the entries `(row, column)` of a matrix come to lie close to
/// the diagonal; `None` if the search finds none in which no entry is farther away than `most`.
///
/// It goes from an unknown at the rim outwards, neighbours with few neighbours of their own first (`cuthill1969` in
/// `docs/references.bib`). For paths this is the narrowest band, for most graphs a narrow one.
pub(super) fn narrow(
    size: usize,
    entries: impl Iterator<Item = (usize, usize)> + Clone,
    most: usize,
) -> Option<Order> {
    let graph = Graph::of(size, entries.clone());
    if (0..size).any(|unknown| graph.neighbours(unknown).len() > 2 * most) {
        return None;
    }
    let unknowns = graph.order();
    let places = places(&unknowns);
    let distance = |(row, column): (usize, usize)| places[row].abs_diff(places[column]);
    let reach = entries.map(distance).max().unwrap_or(0) as usize;
    (reach <= most).then_some(Order { unknowns, reach })
}

/// The place of each unknown in an order.
pub(super) fn places(order: &[u32]) -> Vec<u32> {
    let mut places = vec![0; order.len()];
    for (place, &unknown) in (0..).zip(order) {
        places[unknown as usize] = place;
    }
    places
}

/// Which unknowns stand in a row or a column of one another.
pub(super) struct Graph {
    /// Where the neighbours of each end.
    ends: Vec<u32>,
    others: Vec<u32>,
}

impl Graph {
    /// The graph of these entries `(row, column)`.
    ///
    /// # Panics
    ///
    /// When there are 2³¹ or more.
    pub(super) fn of(size: usize, entries: impl Iterator<Item = (usize, usize)> + Clone) -> Self {
        let pairs = entries.filter(|(row, column)| row != column);
        let mut ends = vec![0; size];
        for (row, column) in pairs.clone() {
            ends[row] += 1;
            ends[column] += 1;
        }
        let mut sum = 0_u32;
        for end in &mut ends {
            sum += std::mem::replace(end, sum);
        }
        let mut others = vec![0; sum as usize];
        for (row, column) in pairs {
            for (one, other) in [(row, column), (column, row)] {
                others[ends[one] as usize] = packed(other);
                ends[one] += 1;
            }
        }
        let (mut start, mut kept) = (0, 0);
        for end in &mut ends {
            others[start..*end as usize].sort_unstable();
            let first = kept;
            for at in std::mem::replace(&mut start, *end as usize)..*end as usize {
                if kept == first || others[kept - 1] != others[at] {
                    others[kept] = others[at];
                    kept += 1;
                }
            }
            *end = packed(kept);
        }
        others.truncate(kept);
        Self { ends, others }
    }

    /// The others that stand in a row or a column of this one, in rising order.
    pub(super) fn neighbours(&self, unknown: usize) -> &[u32] {
        let start = unknown.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.others[start as usize..self.ends[unknown] as usize]
    }

    fn order(&self) -> Vec<u32> {
        let size = self.ends.len();
        let mut order = Vec::with_capacity(size);
        let mut is_placed = vec![false; size];
        let mut rounds = vec![0; size];
        for start in 0..size {
            if !is_placed[start] {
                let rim = self.rim(start, &mut rounds);
                self.spread(rim, &mut is_placed, &mut order);
            }
        }
        order
    }

    /// An unknown at the rim of the part that `start` belongs to: the one met last on the way from
    /// there, and once more from that one. `rounds` counts the ways that have met each unknown.
    fn rim(&self, start: usize, rounds: &mut [u8]) -> usize {
        let mut from = start;
        for round in 1..=2 {
            rounds[from] = round;
            let mut queue = VecDeque::from([from]);
            while let Some(unknown) = queue.pop_front() {
                from = unknown;
                for other in self.neighbours(unknown).iter().map(|&other| other as usize) {
                    if rounds[other] < round {
                        rounds[other] = round;
                        queue.push_back(other);
                    }
                }
            }
        }
        from
    }

    /// Appends the part that `from` belongs to.
    fn spread(&self, from: usize, is_placed: &mut [bool], order: &mut Vec<u32>) {
        let mut at = order.len();
        is_placed[from] = true;
        order.push(packed(from));
        while let Some(&unknown) = order.get(at) {
            at += 1;
            let first = order.len();
            for &other in self.neighbours(unknown as usize) {
                if !is_placed[other as usize] {
                    is_placed[other as usize] = true;
                    order.push(other);
                }
            }
            order[first..].sort_by_key(|&own| (self.neighbours(own as usize).len(), own));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reach that is found for a graph with these edges, whose unknowns are renumbered at random.
    fn reach(size: usize, edges: &[(usize, usize)]) -> usize {
        let mut names: Vec<usize> = (0..size).collect();
        let mut seed = 1_u64;
        for at in (1..size).rev() {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            names.swap(at, (seed >> 33) as usize % (at + 1));
        }
        let entries = edges.iter().map(|&(a, b)| (names[a], names[b]));
        let order = narrow(size, entries, size).unwrap();
        let mut sorted = order.unknowns.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..packed(size)), "each unknown has one place");
        order.reach
    }

    fn path(size: usize) -> Vec<(usize, usize)> {
        (1..size).map(|at| (at - 1, at)).collect()
    }

    #[test]
    fn a_path_reaches_to_the_next_and_a_ring_to_the_next_but_one() {
        assert_eq!(reach(1, &[]), 0);
        assert_eq!(reach(200, &path(200)), 1);
        let mut ring = path(200);
        ring.push((199, 0));
        assert_eq!(reach(200, &ring), 2);
    }

    #[test]
    fn parts_without_connection_stand_one_behind_the_other() {
        let mut edges = path(50);
        edges.extend((51..90).map(|at| (at - 1, at)));
        edges.push((89, 50));
        // A path of 50, a ring of 40 and ten on their own.
        assert_eq!(reach(100, &edges), 2);
    }

    #[test]
    fn a_comb_reaches_over_its_teeth_and_a_lattice_over_its_width() {
        let comb: Vec<_> =
            (0..60).flat_map(|at| [(2 * at, 2 * at + 1), (2 * at, 2 * at + 2)]).collect();
        assert!(reach(121, &comb) <= 2);
        let place = |x: usize, y: usize| 7 * x + y;
        let along = (0..39).flat_map(|x| (0..7).map(move |y| (place(x, y), place(x + 1, y))));
        let across = (0..40).flat_map(|x| (0..6).map(move |y| (place(x, y), place(x, y + 1))));
        let lattice: Vec<_> = along.chain(across).collect();
        assert_eq!(reach(280, &lattice), 7);
    }

    #[test]
    fn a_binary_tree_stays_within_its_widest_level() {
        let tree: Vec<_> = (1..255).map(|at| ((at - 1) / 2, at)).collect();
        assert!(reach(255, &tree) <= 128);
    }

    #[test]
    fn what_is_wider_than_allowed_has_no_order() {
        let star: Vec<_> = (1..100).map(|at| (0, at)).collect();
        assert_eq!(narrow(100, star.iter().copied(), 12), None);
        let mut ring = path(20);
        ring.push((19, 0));
        assert_eq!(narrow(20, ring.iter().copied(), 1), None);
        assert!(narrow(20, ring.iter().copied(), 2).is_some());
    }

    #[test]
    fn direction_and_repetition_of_entries_do_not_matter() {
        let there = [(0, 1), (1, 2), (3, 2)];
        let back = [(1, 0), (2, 1), (1, 1), (2, 3), (0, 1), (2, 3)];
        assert_eq!(narrow(4, there.into_iter(), 3), narrow(4, back.into_iter(), 3));
    }
}
