//! Factorisation of matrices with a narrow band.

mod window;

use std::cell::RefCell;

use super::ordering::{Order, places};

/// Part of the largest entry below from which on that on the diagonal is left to be the pivot, as in
/// KLU (`davis2010` in `docs/references.bib`). Where no rows are exchanged the factors stay half as
/// wide.
const GOOD_PIVOT: f64 = 1e-3;

/// A matrix in an order that makes its band narrow, and its factors `P A = L U` with rows exchanged
/// where the pivot on the diagonal is small.
///
/// The factors lie one behind the other in memory, and solving with them takes no look-up of places.
#[derive(Debug)]
pub(in crate::methods) struct Banded {
    order: Vec<usize>,
    reach: usize,
    /// Where each entry of the matrix belongs in `rows`.
    entries: Vec<usize>,
    /// `U` row by row, each from `reach` before the diagonal to `2 · reach` behind it; one over the
    /// pivot stands on the diagonal, and what is behind it is divided by the pivot.
    rows: Vec<f64>,
    /// `L` column by column, `reach` multipliers each.
    lower: Vec<f64>,
    /// How many rows further down that of the pivot was, column by column; empty if none was.
    pivots: Vec<usize>,
    /// One over the largest entry of each row, so that rows are compared on one scale.
    scales: Vec<f64>,
    /// Whether a column was left without a pivot.
    is_singular: bool,
    /// The factors once more, where they can be worked through with the last values at hand.
    window: window::Factors,
    work: RefCell<Vec<f64>>,
}

impl Banded {
    /// Room for matrices with these entries `(row, column)`, in this order.
    pub(super) fn of(order: Order, entries: impl Iterator<Item = (usize, usize)>) -> Self {
        let Order { unknowns, reach } = order;
        let (size, width) = (unknowns.len(), 3 * reach + 1);
        let places = places(&unknowns);
        let entries = entries.map(|(row, column)| {
            let (row, column) = (places[row], places[column]);
            row * width + column + reach - row
        });
        Self {
            entries: entries.collect(),
            order: unknowns,
            reach,
            rows: vec![0.0; size * width],
            lower: vec![0.0; size * reach],
            pivots: Vec::with_capacity(size),
            scales: vec![0.0; size],
            is_singular: true,
            window: window::Factors::default(),
            work: RefCell::new(vec![0.0; size]),
        }
    }

    /// Factorises the matrix with these values of its entries.
    pub(super) fn factorise(&mut self, values: &[f64]) {
        self.rows.fill(0.0);
        for (&place, value) in self.entries.iter().zip(values) {
            self.rows[place] += value;
        }
        for (scale, row) in
            self.scales.iter_mut().zip(self.rows.chunks_exact_mut(3 * self.reach + 1))
        {
            *scale = row.iter().fold(0.0_f64, |most, value| most.max(value.abs())).recip();
            for value in row {
                *value *= *scale;
            }
        }
        self.pivots.clear();
        self.is_singular = !(0..self.order.len()).all(|column| self.eliminate(column));
        if self.pivots.is_empty() && !self.is_singular {
            self.window.take(self.reach, &self.rows, &self.lower);
        }
    }

    /// Chooses the pivot of a column and eliminates what is below it. Whether there was one.
    fn eliminate(&mut self, column: usize) -> bool {
        let (reach, size) = (self.reach, self.order.len());
        let (width, below) = (3 * reach + 1, reach.min(size - 1 - column));
        let (head, rest) = self.rows[column * width..].split_at_mut(width);
        let own = &mut head[reach..];
        // The entry of the row so many further down, in this column.
        let place = |down: usize| (down - 1) * width + reach - down;
        let mut pivot = (0, own[0].abs());
        for down in 1..=below {
            let size = rest[place(down)].abs();
            if size > pivot.1 {
                pivot = (down, size);
            }
        }
        if own[0].abs() >= GOOD_PIVOT * pivot.1 {
            pivot.0 = 0;
        }
        if pivot.0 > 0 {
            self.pivots.resize(size, 0);
            self.pivots[column] = pivot.0;
            own.swap_with_slice(&mut rest[place(pivot.0)..][..=2 * reach]);
        }
        let inverse = own[0].recip();
        if own[0] == 0.0 || !inverse.is_finite() {
            return false;
        }
        for down in 1..=below {
            let other = &mut rest[place(down)..][..=2 * reach];
            let factor = other[0] * inverse;
            self.lower[column * reach + down - 1] = factor;
            if factor != 0.0 {
                for (value, above) in other[1..].iter_mut().zip(&own[1..]) {
                    *value -= factor * above;
                }
            }
        }
        own[0] = inverse;
        for value in &mut own[1..] {
            *value *= inverse;
        }
        true
    }

    /// Replaces the right-hand side by the solution. Whether the matrix has one.
    pub(super) fn solve(&self, unknowns: &mut [f64]) -> bool {
        if self.is_singular {
            return false;
        }
        let mut work = self.work.borrow_mut();
        if self.pivots.is_empty()
            && self.window.solve(self.reach, (&self.order, &self.scales), &mut work, unknowns)
        {
            return true;
        }
        for ((value, &unknown), scale) in work.iter_mut().zip(&self.order).zip(&self.scales) {
            *value = unknowns[unknown] * scale;
        }
        self.substitute(&mut work);
        for (value, &unknown) in work.iter().zip(&self.order) {
            unknowns[unknown] = *value;
        }
        true
    }

    /// Forward and backward, for any reach and with exchanged rows, which reach twice as far.
    fn substitute(&self, work: &mut [f64]) {
        let (reach, size) = (self.reach, self.order.len());
        let width = 3 * reach + 1;
        let across = if self.pivots.is_empty() { reach } else { 2 * reach };
        for column in 0..size {
            if let Some(&pivot) = self.pivots.get(column) {
                work.swap(column, column + pivot);
            }
            let (head, rest) = work[column..].split_at_mut(1);
            for (value, factor) in rest.iter_mut().zip(&self.lower[column * reach..][..reach]) {
                *value -= factor * head[0];
            }
        }
        for row in (0..size).rev() {
            let own = &self.rows[row * width + reach..][..=across];
            let (head, rest) = work[row..].split_at_mut(1);
            let known = own[1..].iter().zip(rest.iter()).map(|(factor, other)| factor * other);
            head[0] = head[0] * own[0] - known.sum::<f64>();
        }
    }
}

#[cfg(test)]
mod tests;
