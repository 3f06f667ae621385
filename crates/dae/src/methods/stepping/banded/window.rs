//! Factors that reach a few places only, without exchanged rows.
//!
//! Factorising and solving go through the rows once and in order, with the last rows and values at
//! hand. Each value waits for the one before it, so the time goes by how soon that one is there.

use super::{GOOD_PIVOT, Layout, Rows};

/// The factors `L` and `U` of a band, without gaps.
#[derive(Debug, Default)]
pub(super) struct Factors {
    /// `L` row by row, the nearest column first.
    before: Vec<f64>,
    /// `U` row by row: one over the pivot, then what is behind it, divided by the pivot.
    behind: Vec<f64>,
}

impl Factors {
    /// Factorises a matrix and scales its rows. Whether that can be done: the band reaches a few places
    /// only, and no row has to be exchanged.
    pub(super) fn factorise(&mut self, rows: &Rows<'_>, scales: &mut [f64]) -> bool {
        match rows.layout.reach {
            1 => self.eliminate::<1, 2, 3>(rows, scales),
            2 => self.eliminate::<2, 3, 5>(rows, scales),
            3 => self.eliminate::<3, 4, 7>(rows, scales),
            4 => self.eliminate::<4, 5, 9>(rows, scales),
            5 => self.eliminate::<5, 6, 11>(rows, scales),
            _ => false,
        }
    }

    /// Row by row: each less its multiples of the rows before it.
    fn eliminate<const REACH: usize, const WIDTH: usize, const BAND: usize>(
        &mut self,
        rows: &Rows<'_>,
        scales: &mut [f64],
    ) -> bool {
        self.before.resize(scales.len() * REACH, 0.0);
        self.behind.resize(scales.len() * WIDTH, 0.0);
        let (before, _) = self.before.as_chunks_mut::<REACH>();
        let (behind, _) = self.behind.as_chunks_mut::<WIDTH>();
        for (at, (scale, before)) in scales.iter_mut().zip(before).enumerate() {
            let mut row = [0.0; BAND];
            *scale = rows.scaled(at, &mut row);
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

    /// Solves with `L` for what is on the right at a place, of an unknown and with a scale.
    pub(super) fn forward(
        &self,
        layout: &Layout,
        scales: &[f64],
        right: impl Fn(usize, u32, f64) -> f64,
        solution: &mut [f64],
    ) {
        match layout.reach {
            1 => self.lower::<1>(layout, scales, right, solution),
            2 => self.lower::<2>(layout, scales, right, solution),
            3 => self.lower::<3>(layout, scales, right, solution),
            4 => self.lower::<4>(layout, scales, right, solution),
            _ => self.lower::<5>(layout, scales, right, solution),
        }
    }

    fn lower<const REACH: usize>(
        &self,
        layout: &Layout,
        scales: &[f64],
        right: impl Fn(usize, u32, f64) -> f64,
        solution: &mut [f64],
    ) {
        let (before, _) = self.before.as_chunks::<REACH>();
        let mut last = [0.0; REACH];
        let rows = solution.iter_mut().zip(before).zip(layout.order.iter().zip(scales));
        for (at, ((value, factors), (&unknown, &scale))) in rows.enumerate() {
            *value = advance(right(at, unknown, scale), factors, &mut last);
        }
    }

    /// Solves with `U` and puts the unknowns where they belong.
    pub(super) fn backward(&self, layout: &Layout, right: &[f64], unknowns: &mut [f64]) {
        match layout.reach {
            1 => self.upper::<1, 2>(layout, right, unknowns),
            2 => self.upper::<2, 3>(layout, right, unknowns),
            3 => self.upper::<3, 4>(layout, right, unknowns),
            4 => self.upper::<4, 5>(layout, right, unknowns),
            _ => self.upper::<5, 6>(layout, right, unknowns),
        }
    }

    fn upper<const REACH: usize, const WIDTH: usize>(
        &self,
        layout: &Layout,
        right: &[f64],
        unknowns: &mut [f64],
    ) {
        let (behind, _) = self.behind.as_chunks::<WIDTH>();
        let mut last = [0.0; REACH];
        for ((value, row), &unknown) in right.iter().zip(behind).zip(&layout.order).rev() {
            let Some((inverse, factors)) = row.split_first() else { continue };
            let Some(factors) = factors.first_chunk() else { continue };
            unknowns[unknown as usize] = advance(value * inverse, factors, &mut last);
        }
    }
}

/// `value − Σ factor · last`, which becomes the last itself. The nearest is subtracted last, because it is known last.
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
