//! Which points of a group have errors of their own, and which have theirs from points about them.

use std::{borrow::BorrowMut, collections::BTreeMap};

use super::{Estimates, Row};

/// Fewer points of a part are not worth it.
const FEWEST: usize = 6;

/// A way to solve points, by which not all of them need errors of their own.
pub(super) trait Thinned {
    /// What is known of a point that was solved with its errors.
    type Solved;
    /// What holds for the points between others.
    type Known;

    /// Solves a row with its errors, where that can be done.
    fn solved(&mut self, row: &mut Row<'_>) -> Option<Self::Solved>;

    /// What three points agree in, if they do.
    fn agreed(&mut self, solved: [&Self::Solved; 3], rows: [&Row<'_>; 3]) -> Option<Self::Known>;

    /// Solves a row by what is known of those about it, where that holds for it too.
    fn spared(&mut self, known: &Self::Known, row: &mut Row<'_>) -> Option<()>;

    /// Solves the rows of a group, and returns what is known of those that were solved with their errors.
    fn thin<'r>(
        &mut self,
        rows: &mut [impl BorrowMut<Row<'r>>],
        estimates: Estimates,
    ) -> Vec<Self::Solved> {
        let mut solved: BTreeMap<usize, Option<Self::Solved>> = BTreeMap::new();
        let mut parts: Vec<(usize, usize)> =
            rows.len().checked_sub(1).map(|last| (0, last)).into_iter().collect();
        while let Some((first, last)) = parts.pop() {
            let middle = (first + last).div_ceil(2);
            let anchors = [first, middle, last];
            let mut known = None;
            if estimates == Estimates::Some && last - first + 1 >= FEWEST {
                for at in anchors {
                    solved.entry(at).or_insert_with(|| self.solved(rows[at].borrow_mut()));
                }
                if let [Some(one), Some(other), Some(third)] =
                    anchors.map(|at| solved[&at].as_ref())
                {
                    let rows = anchors.map(|at| rows[at].borrow());
                    known = self.agreed([one, other, third], rows);
                }
                if known.is_none() {
                    parts.extend([(middle, last), (first, middle)]);
                    continue;
                }
            }
            for (at, row) in rows.iter_mut().enumerate().take(last + 1).skip(first) {
                if solved.contains_key(&at) {
                    continue;
                }
                let row = row.borrow_mut();
                if known.as_ref().and_then(|known| self.spared(known, row)).is_none() {
                    solved.insert(at, self.solved(row));
                }
            }
        }
        solved.into_values().flatten().collect()
    }
}
