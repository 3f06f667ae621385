//! Where the entries of a matrix belong in the band of the unknowns that are kept.

use dashpot_numerics::packed;

use super::{
    super::{
        elimination::Role,
        ordering::{Order, narrow, places},
    },
    GOOD_PIVOT,
};

/// Pairs of numbers in groups.
#[derive(Debug)]
pub(super) struct Groups {
    /// Where each group ends.
    ends: Vec<u32>,
    pairs: Vec<[u32; 2]>,
}

impl Groups {
    fn of(count: usize, pairs: impl Iterator<Item = (u32, [u32; 2])> + Clone) -> Self {
        let mut ends = vec![0; count];
        for (group, _) in pairs.clone() {
            ends[group as usize] += 1;
        }
        let mut sum = 0;
        for end in &mut ends {
            sum += std::mem::replace(end, sum);
        }
        let mut sorted = vec![[0; 2]; sum as usize];
        for (group, pair) in pairs {
            sorted[ends[group as usize] as usize] = pair;
            ends[group as usize] += 1;
        }
        Self { ends, pairs: sorted }
    }

    fn place(&self, group: usize) -> std::ops::Range<usize> {
        let start = group.checked_sub(1).map_or(0, |before| self.ends[before]);
        start as usize..self.ends[group] as usize
    }

    fn group(&self, group: usize) -> &[[u32; 2]] {
        &self.pairs[self.place(group)]
    }
}

/// Where the entries of a matrix belong: in the band of the unknowns that are kept, or in the couplings of
/// these to those that are eliminated.
#[derive(Debug)]
pub(super) struct Layout {
    /// The unknown at each place of the band.
    pub(super) order: Vec<u32>,
    /// How far the band reaches from the diagonal.
    pub(super) reach: usize,
    /// The eliminated unknowns, and which entry of theirs stands on the diagonal.
    eliminated: Vec<[u32; 2]>,
    /// Of the row at each place the entries, and how far behind the first place of the band's row each belongs.
    direct: Groups,
    /// Of the row at each place the entries in columns of eliminated unknowns, and the numbers of these.
    left: Groups,
    /// Of the row of each eliminated unknown the entries, and their places in the band.
    right: Groups,
}

impl Layout {
    /// The layout of these entries `(row, column)`, of which there are fewer than 2³¹, if the band is no wider
    /// than `most`.
    pub(super) fn of(
        roles: &[Role],
        entries: impl Iterator<Item = (usize, usize)> + Clone,
        most: usize,
    ) -> Option<Self> {
        use Role::{Eliminated, Kept};
        let kept: Vec<u32> = numbers(roles, |role| matches!(role, Kept(_))).collect();
        let numbered = (0..).zip(entries);
        let roles_of = |(row, column): (usize, usize)| (roles[row], roles[column]);
        let pivots = numbered.clone().filter(|&(_, (row, column))| row == column);
        let mut eliminated = vec![[0; 2]; roles.len() - kept.len()];
        for (source, (unknown, _)) in pivots {
            if let Eliminated(at) = roles[unknown] {
                eliminated[at as usize] = [packed(unknown), source];
            }
        }
        let rows = numbered.clone().filter_map(|(source, entry)| match roles_of(entry) {
            (Eliminated(at), Kept(other)) => Some((at, [source, other])),
            _ => None,
        });
        let columns = numbered.clone().filter_map(|(source, entry)| match roles_of(entry) {
            (Kept(other), Eliminated(at)) => Some((at, [source, other])),
            _ => None,
        });
        let both = numbered.filter_map(|(source, entry)| match roles_of(entry) {
            (Kept(row), Kept(column)) => Some((source, (row, column))),
            _ => None,
        });
        let mut right = Groups::of(eliminated.len(), rows);
        let Order { unknowns, reach } = {
            let (left, right) = (Groups::of(eliminated.len(), columns.clone()), &right);
            let left = &left;
            let products = (0..eliminated.len()).flat_map(move |at| {
                let pairs = left.group(at).iter().map(move |&[_, row]| (row, right.group(at)));
                pairs.flat_map(|(row, others)| others.iter().map(move |&[_, column]| (row, column)))
            });
            let pairs = both.clone().map(|(_, pair)| pair).chain(products);
            narrow(kept.len(), pairs.map(|(row, column)| (row as usize, column as usize)), most)?
        };
        let places = places(&unknowns);
        let direct = both.map(|(source, (row, column))| {
            let (row, column) = (places[row as usize], places[column as usize]);
            (row, [source, column + packed(reach) - row])
        });
        let left = columns.map(|(at, [source, row])| (places[row as usize], [source, at]));
        let (direct, left) = (Groups::of(kept.len(), direct), Groups::of(kept.len(), left));
        for [_, other] in &mut right.pairs {
            *other = places[*other as usize];
        }
        let order = unknowns.iter().map(|&number| kept[number as usize]).collect();
        Some(Self { order, reach, eliminated, direct, left, right })
    }
}

/// The unknowns whose role is one of these.
fn numbers(roles: &[Role], is_one: impl Fn(&Role) -> bool) -> impl Iterator<Item = u32> {
    (0..).zip(roles).filter(move |(_, role)| is_one(role)).map(|(unknown, _)| unknown)
}

/// An unknown that is eliminated has too small a pivot for that: others would lose their digits.
#[derive(Debug)]
pub(in crate::methods) struct Unfit;

/// The values that couple the unknowns that are kept to those that are eliminated.
#[derive(Debug, Default)]
pub(super) struct Couplings {
    /// The entries in columns of eliminated unknowns, place by place.
    left: Vec<f64>,
    /// Those in rows of eliminated unknowns, divided by the pivot.
    right: Vec<f64>,
    /// One over the pivot of each eliminated unknown.
    inverses: Vec<f64>,
}

impl Couplings {
    /// Takes up the values of a matrix, whose pivots must be no smaller beside their rows than those of a band.
    pub(super) fn take(&mut self, layout: &Layout, values: &[f64]) -> Result<(), Unfit> {
        self.left.clear();
        self.left.extend(layout.left.pairs.iter().map(|&[source, _]| values[source as usize]));
        self.right.resize(layout.right.pairs.len(), 0.0);
        self.inverses.clear();
        for (at, &[_, source]) in layout.eliminated.iter().enumerate() {
            let inverse = values[source as usize].recip();
            let place = layout.right.place(at);
            let pairs = &layout.right.pairs[place.clone()];
            let mut largest = 1.0_f64;
            for (value, &[source, _]) in self.right[place].iter_mut().zip(pairs) {
                *value = values[source as usize] * inverse;
                largest = largest.max(value.abs());
            }
            if inverse.is_finite() && largest * GOOD_PIVOT <= 1.0 {
                self.inverses.push(inverse);
            } else {
                return Err(Unfit);
            }
        }
        Ok(())
    }

    /// Adds the entries of the row at a place, after the elimination, to the band's row.
    pub(super) fn add_row(&self, layout: &Layout, values: &[f64], at: usize, row: &mut [f64]) {
        for &[source, offset] in layout.direct.group(at) {
            row[offset as usize] += values[source as usize];
        }
        let left = layout.left.place(at);
        for (&[_, other], &value) in layout.left.pairs[left.clone()].iter().zip(&self.left[left]) {
            let right = layout.right.place(other as usize);
            let pairs = &layout.right.pairs[right.clone()];
            for (&[_, place], factor) in pairs.iter().zip(&self.right[right]) {
                row[place as usize + layout.reach - at] -= value * factor;
            }
        }
    }

    /// Puts what the eliminated unknowns would be without the others into `work`.
    pub(super) fn begin(&self, layout: &Layout, right: &[f64], work: &mut Vec<f64>) {
        work.clear();
        let eliminated = layout.eliminated.iter().zip(&self.inverses);
        work.extend(eliminated.map(|(&[unknown, _], inverse)| right[unknown as usize] * inverse));
    }

    /// What `work` takes from the right-hand side at a place.
    pub(super) fn taken(&self, layout: &Layout, at: usize, work: &[f64]) -> f64 {
        let place = layout.left.place(at);
        let pairs = layout.left.pairs[place.clone()].iter().zip(&self.left[place]);
        pairs.map(|(&[_, other], value)| value * work[other as usize]).sum()
    }

    /// Completes `unknowns`, of which those that are kept are known, from `work`.
    pub(super) fn complete(&self, layout: &Layout, work: &[f64], unknowns: &mut [f64]) {
        for (at, (&[unknown, _], own)) in layout.eliminated.iter().zip(work).enumerate() {
            let place = layout.right.place(at);
            let pairs = layout.right.pairs[place.clone()].iter().zip(&self.right[place]);
            let others = pairs.map(|(&[_, place], value)| {
                value * unknowns[layout.order[place as usize] as usize]
            });
            unknowns[unknown as usize] = own - others.sum::<f64>();
        }
    }
}
