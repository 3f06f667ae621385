//! In which order combinations of phases are tried.

use std::collections::HashSet;

use super::{groups::Group, impacts::Impact, judge::Fault};
use crate::phases::Phase;

/// Combinations of one group up to which all are tried, nearest first.
const FEW: usize = 64;
/// Most combinations of a larger group that are tried one by one where following the faults has led nowhere.
const MOST_TRIED: usize = 1024;

/// The search for the phases of one group.
#[derive(Debug)]
pub(super) struct Search {
    pub(super) group: Group,
    /// By which of the ways of judging it is judged now.
    pub(super) way: usize,
    pub(super) impacts: Vec<Impact>,
    /// For each of its parts the phases in reach, the natural one first.
    options: Vec<Vec<Phase>>,
    /// The option of each part that is tried now.
    at: Vec<usize>,
    tried: HashSet<Vec<usize>>,
    /// All others in the order of their distance, once they are tried one by one.
    nearest: Option<std::vec::IntoIter<Vec<usize>>>,
}

impl Search {
    /// Begins with the natural phases; `options` are those of all parts of the network.
    pub(super) fn new(group: Group, options: &[Vec<Phase>]) -> Self {
        let options: Vec<Vec<Phase>> =
            group.parts.iter().map(|&part| options[part].clone()).collect();
        let at = vec![0; options.len()];
        let (tried, impacts) = (HashSet::new(), Vec::new());
        Self { group, way: 0, impacts, options, at, tried, nearest: None }
    }

    /// Puts the phases that are tried into those of the network.
    pub(super) fn enter(&self, phases: &mut [Phase]) {
        for ((&part, options), &at) in self.group.parts.iter().zip(&self.options).zip(&self.at) {
            phases[part] = options[at];
        }
    }

    /// The parts that have more than one phase in reach.
    pub(super) fn open_parts(&self) -> impl Iterator<Item = usize> {
        let parts = self.group.parts.iter().zip(&self.options);
        parts.filter(|(_, options)| options.len() > 1).map(|(&part, _)| part)
    }

    /// Begins again with the natural phases.
    pub(super) fn restart(&mut self) {
        self.at.fill(0);
        self.tried.clear();
        self.nearest = None;
    }

    /// Goes on to the next combination, or says that there is none.
    ///
    /// Where there are few, all are tried, those with the fewest changes first. In larger groups the
    /// parts at fault change all at once, then one of them at a time (block pivoting with Murty's
    /// rule of the least index, which ends where the phases are unique); only where that comes back
    /// to what has been tried, the nearest ones are gone through.
    pub(super) fn advance(&mut self, faults: &[Fault]) -> bool {
        self.tried.insert(self.at.clone());
        let counts: Vec<usize> = self.options.iter().map(Vec::len).collect();
        let all = counts.iter().fold(1_usize, |all, &count| all.saturating_mul(count));
        if self.nearest.is_none() && all > FEW {
            let own: Vec<&Fault> =
                faults.iter().filter(|fault| self.group.parts.contains(&fault.part)).collect();
            let least = own.iter().min_by_key(|own| own.part).copied();
            let next = [self.changed(&own), self.changed(least.as_slice())];
            if let Some(next) = next.into_iter().find(|next| !self.tried.contains(next)) {
                self.at = next;
                return true;
            }
        }
        let nearest = self.nearest.get_or_insert_with(|| {
            combinations(&counts).take(MOST_TRIED).collect::<Vec<_>>().into_iter()
        });
        match nearest.find(|next| !self.tried.contains(next)) {
            Some(next) => self.at = next,
            None => return false,
        }
        true
    }

    /// What is tried now, but with these parts in the phases to which their faults lead.
    fn changed(&self, faults: &[&Fault]) -> Vec<usize> {
        let mut next = self.at.clone();
        for fault in faults {
            let Ok(own) = self.group.parts.binary_search(&fault.part) else { continue };
            let options = &self.options[own];
            let wanted = options.iter().position(|phase| Some(phase.index) == fault.towards);
            next[own] = wanted.unwrap_or((next[own] + 1) % options.len());
        }
        next
    }
}

/// All combinations of one option each, those nearest to the first options first.
fn combinations(counts: &[usize]) -> impl Iterator<Item = Vec<usize>> {
    let open: Vec<usize> = (0..counts.len()).filter(|&part| counts[part] > 1).collect();
    (0..=open.len()).flat_map(move |changes| {
        let open = open.clone();
        subsets(open.len(), changes).into_iter().flat_map(move |subset| {
            let mut all = vec![vec![0; counts.len()]];
            for part in subset.into_iter().map(|at| open[at]) {
                all = all
                    .into_iter()
                    .flat_map(|base| {
                        (1..counts[part]).map(move |option| {
                            let mut next = base.clone();
                            next[part] = option;
                            next
                        })
                    })
                    .collect();
            }
            all
        })
    })
}

/// All subsets of this size of `0..count`, at most as many as are tried.
fn subsets(count: usize, size: usize) -> Vec<Vec<usize>> {
    let mut found = Vec::new();
    let mut chosen: Vec<usize> = (0..size).collect();
    if size > count {
        return found;
    }
    loop {
        found.push(chosen.clone());
        if found.len() >= MOST_TRIED {
            return found;
        }
        let Some(at) = (0..size).rev().find(|&at| chosen[at] < count - size + at) else {
            return found;
        };
        chosen[at] += 1;
        for later in at + 1..size {
            chosen[later] = chosen[later - 1] + 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn search(parts: usize, options: usize) -> Search {
        let phase = |index| Phase { index, memory: 0.0 };
        let options = vec![(0..options).map(phase).collect::<Vec<_>>(); parts];
        Search::new(Group { parts: (0..parts).collect(), ..Group::default() }, &options)
    }

    #[test]
    fn few_combinations_are_all_tried_once_and_the_nearest_first() {
        let mut search = search(3, 3);
        let mut all = vec![search.at.clone()];
        while search.advance(&[]) {
            all.push(search.at.clone());
        }
        let changes = |at: &[usize]| at.iter().filter(|&&own| own > 0).count();
        assert!(all.windows(2).all(|pair| changes(&pair[0]) <= changes(&pair[1])));
        assert_eq!(all.iter().collect::<HashSet<_>>().len(), 27);
        assert_eq!(all.len(), 27);
    }

    #[test]
    fn faults_lead_to_the_phases_of_a_large_group_in_a_few_steps() {
        // Every odd part wants its second phase, and says so once the one before is right.
        let mut search = search(40, 2);
        let right = |own: usize| own % 2;
        let mut steps = 0;
        while let Some(first) = (0..40).find(|&own| search.at[own] != right(own)) {
            let fault = Fault { part: first, towards: Some(right(first)) };
            assert!(search.advance(&[fault]));
            steps += 1;
        }
        assert_eq!(steps, 20);
    }
}
