//! Star–mesh elimination: the balance of massless places, solved without subtraction.
//!
//! Each link carries `conductance · (X_p − X_q + offset)` from `p` to `q`; at an eliminated place the links balance a
//! load. Replacing a star by the mesh of its neighbours multiplies, divides and adds positive numbers only, so
//! stiffnesses any number of decades apart keep all their digits (1 and 10¹² N/m in series make 0.999999999999 N/m).

use std::collections::{BTreeMap, BTreeSet, HashMap};

use dashpot_numerics::Coefficient;

use super::row::Combination;

/// Places and the links between them.
#[derive(Clone)]
pub(super) struct Mesh<R: Combination> {
    neighbours: Vec<BTreeMap<usize, Link<R>>>,
    loads: Vec<R>,
}

/// A link as seen from one of its ends.
#[derive(Clone)]
pub(super) struct Link<R: Combination> {
    pub(super) conductance: R::Factor,
    pub(super) offset: R,
}

/// One eliminated place: `X = Σ weight (X_q − offset) + load / total`.
#[derive(Clone)]
struct Step<R: Combination> {
    place: usize,
    star: Vec<(usize, R::Factor, R)>,
    share: R,
}

/// The order of elimination, ready for back-substitution.
#[derive(Clone)]
pub(super) struct Eliminated<R: Combination> {
    steps: Vec<Step<R>>,
    /// What is left between the places that were kept.
    pub(super) rest: Mesh<R>,
}

/// All places, and the differences along all links.
#[derive(Debug, Clone, Default)]
pub(super) struct Solution<R> {
    values: Vec<R>,
    differences: HashMap<(usize, usize), R>,
}

impl<R: Combination> Mesh<R> {
    pub(super) fn new(places: usize) -> Self {
        Self { neighbours: vec![BTreeMap::new(); places], loads: vec![R::default(); places] }
    }

    /// Adds a link that carries `conductance · (X_p − X_q + offset)` from `p` to `q`; one that carries nothing is none.
    pub(super) fn link(
        &mut self,
        p: usize,
        q: usize,
        conductance: impl Into<R::Factor>,
        offset: &R,
    ) {
        let conductance = conductance.into();
        if p == q || conductance.rounded() == 0.0 {
            return;
        }
        self.half_link(p, q, conductance, offset, 1.0);
        self.half_link(q, p, conductance, offset, -1.0);
    }

    fn half_link(&mut self, p: usize, q: usize, conductance: R::Factor, offset: &R, sign: f64) {
        let link = self.neighbours[p]
            .entry(q)
            .or_insert_with(|| Link { conductance: R::Factor::default(), offset: R::default() });
        let total = link.conductance + conductance;
        let (old, new) = (link.conductance / total, conductance / total);
        link.offset = R::default().plus(old, &link.offset).plus(new * sign, offset);
        link.conductance = total;
    }

    /// Adds to the load that the links of `place` have to carry away.
    pub(super) fn load(&mut self, place: usize, factor: f64, load: &R) {
        self.loads[place] = self.loads[place].plus(factor, load);
    }

    pub(super) fn links(&self, place: usize) -> impl Iterator<Item = (usize, &Link<R>)> {
        self.neighbours[place].iter().map(|(&other, link)| (other, link))
    }

    pub(super) fn load_at(&self, place: usize) -> &R {
        &self.loads[place]
    }

    /// Eliminates `places`, the one with the fewest links first, as long as that number does not
    /// exceed `most_links`. A place without links must not be among them.
    pub(super) fn eliminate(mut self, places: &[usize], most_links: usize) -> Eliminated<R> {
        let mut queue: BTreeSet<(usize, usize)> =
            places.iter().map(|&place| (self.neighbours[place].len(), place)).collect();
        let mut waiting = vec![false; self.neighbours.len()];
        for &place in places {
            waiting[place] = true;
        }
        let mut steps = Vec::with_capacity(places.len());
        while let Some((links, place)) = queue.pop_first() {
            if links > most_links {
                break;
            }
            waiting[place] = false;
            let star = std::mem::take(&mut self.neighbours[place]);
            let ends: Vec<usize> = star.keys().copied().filter(|&end| waiting[end]).collect();
            for &end in &ends {
                queue.remove(&(self.neighbours[end].len(), end));
            }
            steps.push(self.star_to_mesh(place, star));
            for &end in &ends {
                queue.insert((self.neighbours[end].len(), end));
            }
        }
        Eliminated { steps, rest: self }
    }

    fn star_to_mesh(&mut self, place: usize, star: BTreeMap<usize, Link<R>>) -> Step<R> {
        let total: R::Factor = star.values().map(|link| link.conductance).sum();
        let load = std::mem::take(&mut self.loads[place]);
        let star: Vec<(usize, R::Factor, Link<R>)> =
            star.into_iter().map(|(q, link)| (q, link.conductance / total, link)).collect();
        for &(q, weight, _) in &star {
            self.neighbours[q].remove(&place);
            self.loads[q] = self.loads[q].plus(weight, &load);
        }
        for (at, (p, weight, link)) in star.iter().enumerate() {
            for (q, _, other) in &star[at + 1..] {
                let offset = other.offset.plus(-1.0, &link.offset);
                self.link(*p, *q, *weight * other.conductance, &offset);
            }
        }
        let share = R::default().plus(R::Factor::ONE / total, &load);
        Step {
            place,
            star: star.into_iter().map(|(q, w, link)| (q, w, link.offset)).collect(),
            share,
        }
    }
}

impl<R: Combination> Eliminated<R> {
    /// The places that were eliminated, first one first.
    pub(super) fn places(&self) -> impl Iterator<Item = usize> + '_ {
        self.steps.iter().map(|step| step.place)
    }

    /// Back-substitution from the `values` of all places that were kept.
    pub(super) fn solve(&self, mut values: Vec<R>) -> Solution<R> {
        let mut differences: HashMap<(usize, usize), R> = HashMap::new();
        for step in self.steps.iter().rev() {
            let mut value = step.share.clone();
            for (q, weight, offset) in &step.star {
                value = value.plus(*weight, &values[*q]).plus(*weight * -1.0, offset);
            }
            for (q, weight, offset) in &step.star {
                let mut difference = step.share.plus(*weight * -1.0, offset);
                for (p, other_weight, other_offset) in &step.star {
                    if p == q {
                        continue;
                    }
                    difference = match differences.get(&(*p, *q)) {
                        Some(known) => difference.plus(*other_weight, known),
                        None => difference
                            .plus(*other_weight, &values[*p])
                            .plus(*other_weight * -1.0, &values[*q]),
                    }
                    .plus(*other_weight * -1.0, other_offset);
                }
                differences.insert((*q, step.place), R::default().plus(-1.0, &difference));
                differences.insert((step.place, *q), difference);
            }
            values[step.place] = value;
        }
        Solution { values, differences }
    }
}

impl<R: Combination> Solution<R> {
    /// `X_place`.
    pub(super) fn value(&self, place: usize) -> &R {
        &self.values[place]
    }

    /// `X_p − X_q`, with full relative accuracy where the two are linked.
    pub(super) fn difference(&self, p: usize, q: usize) -> R {
        match self.differences.get(&(p, q)) {
            Some(difference) => difference.clone(),
            None => self.values[p].plus(-1.0, &self.values[q]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_decades_in_series_keep_all_digits() {
        let mut mesh = Mesh::<f64>::new(3);
        mesh.link(0, 1, 1.0, &0.0);
        mesh.link(1, 2, 1e12, &0.0);
        let solution = mesh.eliminate(&[1], usize::MAX).solve(vec![1.0, 0.0, 0.0]);
        let series = 1.0 / (1.0 + 1e-12);
        assert!((1e12 * solution.difference(1, 2) - series).abs() <= 2.0 * f64::EPSILON);
        assert!((solution.difference(0, 1) - series).abs() <= 2.0 * f64::EPSILON);
    }

    #[test]
    fn a_chain_of_stars_divides_evenly_whatever_the_order() {
        let mut mesh = Mesh::<f64>::new(12);
        for place in 0..11 {
            mesh.link(place, place + 1, 3.0, &0.0);
        }
        let inner: Vec<usize> = (1..11).collect();
        let solution = mesh.eliminate(&inner, usize::MAX).solve({
            let mut ends = vec![0.0; 12];
            ends[0] = 11.0;
            ends
        });
        for place in 0..11 {
            assert!((solution.difference(place, place + 1) - 1.0).abs() < 1e-14);
            assert!((solution.value(place) - (11.0 - place as f64)).abs() < 1e-13);
        }
    }

    #[test]
    fn loads_and_offsets_balance_at_every_place() {
        let mut mesh = Mesh::<f64>::new(5);
        let links = [
            (0, 2, 2.0, 0.3),
            (2, 3, 5.0, -0.2),
            (3, 4, 7.0, 0.0),
            (2, 4, 1.0, 0.1),
            (4, 1, 3.0, 0.5),
        ];
        for (p, q, k, offset) in links {
            mesh.link(p, q, k, &offset);
        }
        let loads = [0.0, 0.0, 1.5, -0.5, 2.0];
        for (place, load) in loads.iter().enumerate() {
            mesh.load(place, 1.0, load);
        }
        let solution = mesh.eliminate(&[2, 3, 4], usize::MAX).solve(vec![0.7, -0.1, 0.0, 0.0, 0.0]);
        for (p, q, _, _) in links {
            let difference = solution.value(p) - solution.value(q);
            assert!((difference - solution.difference(p, q)).abs() < 1e-14, "{p} and {q}");
        }
        for place in 2..5 {
            let carried: f64 = links
                .iter()
                .map(|&(p, q, k, offset)| {
                    let flow = k * (solution.difference(p, q) + offset);
                    if p == place {
                        flow
                    } else if q == place {
                        -flow
                    } else {
                        0.0
                    }
                })
                .sum();
            assert!((carried - loads[place]).abs() < 1e-13, "place {place}: {carried}");
        }
    }
}
