//! Substitution with factors that reach a few places only.
//!
//! Each value waits for the one before it, so the time goes by how soon that one is at hand: the last
//! values stay in registers. What is read from memory is read once and in order.

/// The factors `L` and `U` of a band in which no rows were exchanged, without gaps.
#[derive(Debug, Default)]
pub(super) struct Factors {
    /// `L` row by row, the nearest column first.
    before: Vec<f64>,
    /// `U` row by row: one over the pivot, then what is behind it.
    behind: Vec<f64>,
}

impl Factors {
    /// Takes the factors over: rows of `U` from `reach` before the diagonal to `2 · reach` behind it,
    /// columns of `L`.
    pub(super) fn take(&mut self, reach: usize, rows: &[f64], lower: &[f64]) {
        let width = 3 * reach + 1;
        let size = rows.len() / width;
        self.before.resize(size * reach, 0.0);
        self.behind.resize(size * (reach + 1), 0.0);
        for (own, row) in self.behind.chunks_exact_mut(reach + 1).zip(rows.chunks_exact(width)) {
            own.copy_from_slice(&row[reach..=2 * reach]);
        }
        for column in 0..size {
            for down in 1..=reach.min(size - 1 - column) {
                self.before[(column + down) * reach + down - 1] = lower[column * reach + down - 1];
            }
        }
    }

    /// Replaces the right-hand side by the solution, unless the band reaches too far. `order` and
    /// `scales` are those of the rows.
    pub(super) fn solve(
        &self,
        reach: usize,
        rows: (&[usize], &[f64]),
        work: &mut [f64],
        unknowns: &mut [f64],
    ) -> bool {
        match reach {
            1 => self.substitute::<1, 2>(rows, work, unknowns),
            2 => self.substitute::<2, 3>(rows, work, unknowns),
            3 => self.substitute::<3, 4>(rows, work, unknowns),
            4 => self.substitute::<4, 5>(rows, work, unknowns),
            5 => self.substitute::<5, 6>(rows, work, unknowns),
            _ => return false,
        }
        true
    }

    fn substitute<const REACH: usize, const WIDTH: usize>(
        &self,
        (order, scales): (&[usize], &[f64]),
        work: &mut [f64],
        unknowns: &mut [f64],
    ) {
        let (before, _) = self.before.as_chunks::<REACH>();
        let (behind, _) = self.behind.as_chunks::<WIDTH>();
        let mut last = [0.0; REACH];
        let rows = work.iter_mut().zip(before).zip(order.iter().zip(scales));
        for ((value, factors), (&unknown, scale)) in rows {
            *value = advance(unknowns[unknown] * scale, factors, &mut last);
        }
        last = [0.0; REACH];
        for ((value, row), &unknown) in work.iter().zip(behind).zip(order).rev() {
            let Some((inverse, factors)) = row.split_first() else { continue };
            let Some(factors) = factors.first_chunk() else { continue };
            unknowns[unknown] = advance(value * inverse, factors, &mut last);
        }
    }
}

/// `value − Σ factor · last`, which becomes the last itself. The nearest is subtracted last, because
/// it is known last.
fn advance<const REACH: usize>(value: f64, factors: &[f64; REACH], last: &mut [f64; REACH]) -> f64 {
    let mut next = value;
    for at in (0..REACH).rev() {
        next -= factors[at] * last[at];
    }
    for at in (1..REACH).rev() {
        last[at] = last[at - 1];
    }
    last[0] = next;
    next
}
