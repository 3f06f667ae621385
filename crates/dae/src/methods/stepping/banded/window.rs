//! Factors that reach a few places only, without exchanged rows.
//!
//! Factorising and solving go through the rows once and in order, with the last rows and values at
//! hand. Each value waits for the one before it, so the time goes by how soon that one is there.

use super::{GOOD_PIVOT, Layout};

/// The factors `L` and `U` of a band, without gaps.
#[derive(Debug, Default)]
pub(super) struct Factors {
    /// `L` row by row, the nearest column first.
    before: Vec<f64>,
    /// `U` row by row: one over the pivot, then what is behind it, divided by the pivot.
    behind: Vec<f64>,
}

impl Factors {
    /// Factorises the matrix with these values of its entries and scales its rows. Whether that can be
    /// done: the band reaches a few places only, and no row has to be exchanged.
    pub(super) fn factorise(
        &mut self,
        reach: usize,
        layout: &Layout,
        values: &[f64],
        scales: &mut [f64],
    ) -> bool {
        match reach {
            1 => self.eliminate::<1, 2, 3>(layout, values, scales),
            2 => self.eliminate::<2, 3, 5>(layout, values, scales),
            3 => self.eliminate::<3, 4, 7>(layout, values, scales),
            4 => self.eliminate::<4, 5, 9>(layout, values, scales),
            5 => self.eliminate::<5, 6, 11>(layout, values, scales),
            _ => false,
        }
    }

    /// Row by row: each less its multiples of the rows before it.
    fn eliminate<const REACH: usize, const WIDTH: usize, const BAND: usize>(
        &mut self,
        layout: &Layout,
        values: &[f64],
        scales: &mut [f64],
    ) -> bool {
        self.before.resize(scales.len() * REACH, 0.0);
        self.behind.resize(scales.len() * WIDTH, 0.0);
        let (before, _) = self.before.as_chunks_mut::<REACH>();
        let (behind, _) = self.behind.as_chunks_mut::<WIDTH>();
        for (at, ((entries, scale), before)) in layout.rows().zip(scales).zip(before).enumerate() {
            let mut row = [0.0; BAND];
            for (source, offset) in entries {
                row[offset] += values[source];
            }
            *scale = row.iter().fold(0.0_f64, |most, value| most.max(value.abs())).recip();
            for value in &mut row {
                *value *= *scale;
            }
            for back in (1..=REACH.min(at)).rev() {
                let above = &behind[at - back];
                let own = row[REACH - back];
                let factor = own * above[0];
                if factor.abs() * GOOD_PIVOT > 1.0 {
                    return false;
                }
                before[back - 1] = factor;
                for (value, above) in row[REACH - back + 1..].iter_mut().zip(&above[1..]) {
                    *value -= own * above;
                }
            }
            let inverse = row[REACH].recip();
            if row[REACH] == 0.0 || !inverse.is_finite() {
                return false;
            }
            behind[at][0] = inverse;
            for (value, own) in behind[at][1..].iter_mut().zip(&row[REACH + 1..]) {
                *value = own * inverse;
            }
        }
        true
    }

    /// Replaces the right-hand side by the solution. `order` and `scales` are those of the rows, `reach`
    /// that of the factors.
    pub(super) fn solve(
        &self,
        reach: usize,
        rows: (&[u32], &[f64]),
        work: &mut [f64],
        unknowns: &mut [f64],
    ) {
        match reach {
            1 => self.substitute::<1, 2>(rows, work, unknowns),
            2 => self.substitute::<2, 3>(rows, work, unknowns),
            3 => self.substitute::<3, 4>(rows, work, unknowns),
            4 => self.substitute::<4, 5>(rows, work, unknowns),
            _ => self.substitute::<5, 6>(rows, work, unknowns),
        }
    }

    fn substitute<const REACH: usize, const WIDTH: usize>(
        &self,
        (order, scales): (&[u32], &[f64]),
        work: &mut [f64],
        unknowns: &mut [f64],
    ) {
        let (before, _) = self.before.as_chunks::<REACH>();
        let (behind, _) = self.behind.as_chunks::<WIDTH>();
        let mut last = [0.0; REACH];
        let rows = work.iter_mut().zip(before).zip(order.iter().zip(scales));
        for ((value, factors), (&unknown, scale)) in rows {
            *value = advance(unknowns[unknown as usize] * scale, factors, &mut last);
        }
        last = [0.0; REACH];
        for ((value, row), &unknown) in work.iter().zip(behind).zip(order).rev() {
            let Some((inverse, factors)) = row.split_first() else { continue };
            let Some(factors) = factors.first_chunk() else { continue };
            unknowns[unknown as usize] = advance(value * inverse, factors, &mut last);
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
