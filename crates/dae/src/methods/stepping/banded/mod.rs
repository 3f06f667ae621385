//! Factorisation of matrices with a narrow band.

mod layout;
mod window;

use std::cell::RefCell;

use self::layout::{Couplings, Layout};
use super::elimination::{none, roles};

pub(in crate::methods) use self::layout::Unfit;

/// Part of the largest entry below from which on that on the diagonal is left to be the pivot, as in KLU (`davis2010`
/// in `docs/references.bib`). Where no rows are exchanged the factors stay half as wide.
const GOOD_PIVOT: f64 = 1e-3;

/// A matrix in an order that makes its band narrow, and its factors `P A = L U` with rows exchanged
/// where the pivot on the diagonal is small. Some of its unknowns may have been eliminated before.
///
/// The factors lie one behind the other in memory, and solving with them takes no look-up of places.
#[derive(Debug)]
pub(in crate::methods) struct Banded {
    layout: Layout,
    couplings: Couplings,
    /// One over the largest entry of each row, so that rows are compared on one scale.
    scales: Vec<f64>,
    /// The factors where no rows are exchanged and the last values can be kept at hand.
    window: window::Factors,
    /// The factors of any other matrix.
    general: General,
    /// Which of both hold; `None` where a column was left without a pivot.
    holds: Option<Holds>,
    work: RefCell<Work>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Holds {
    Window,
    General,
}

/// Right-hand sides on their way to solutions.
#[derive(Debug, Default)]
struct Work {
    kept: Vec<f64>,
    eliminated: Vec<f64>,
}

/// The rows of a band, as they are to be factorised.
struct Rows<'b> {
    layout: &'b Layout,
    couplings: &'b Couplings,
    values: &'b [f64],
}

impl Rows<'_> {
    /// Adds the entries of the row at a place to an empty one and divides them by the largest. One over this.
    fn scaled(&self, at: usize, row: &mut [f64]) -> f64 {
        self.couplings.add_row(self.layout, self.values, at, row);
        let scale = row.iter().fold(0.0_f64, |most, value| most.max(value.abs())).recip();
        for value in row {
            *value *= scale;
        }
        scale
    }
}

/// Factors of a band of any reach, with exchanged rows.
#[derive(Debug, Default)]
struct General {
    reach: usize,
    /// `U` row by row, each from `reach` before the diagonal to `2 · reach` behind it; one over the
    /// pivot stands on the diagonal, and what is behind it is divided by the pivot.
    rows: Vec<f64>,
    /// `L` column by column, `reach` multipliers each.
    lower: Vec<f64>,
    /// How many rows further down that of the pivot was, column by column; empty if none was.
    pivots: Vec<usize>,
}

impl Banded {
    /// Room for matrices with these entries `(row, column)`, of which there are fewer than 2³¹, if a band is
    /// found that reaches no further than `most`. What costs nothing to be eliminated is.
    pub(super) fn reduced(
        size: usize,
        entries: impl Iterator<Item = (usize, usize)> + Clone,
        most: usize,
    ) -> Option<Self> {
        let roles = roles(size, entries.clone());
        Layout::of(&roles, entries, most).map(Self::empty)
    }

    /// The same without any elimination.
    pub(super) fn whole(
        size: usize,
        entries: impl Iterator<Item = (usize, usize)> + Clone,
        most: usize,
    ) -> Option<Self> {
        Layout::of(&none(size), entries, most).map(Self::empty)
    }

    fn empty(layout: Layout) -> Self {
        Self {
            scales: vec![0.0; layout.order.len()],
            layout,
            couplings: Couplings::default(),
            window: window::Factors::default(),
            general: General::default(),
            holds: None,
            work: RefCell::default(),
        }
    }

    /// Factorises the matrix with these values of its entries.
    /// Errors: what is eliminated must not be with these values: only the [`whole`](Self::whole) can be factorised.
    pub(super) fn factorise(&mut self, values: &[f64]) -> Result<(), Unfit> {
        self.holds = None;
        self.couplings.take(&self.layout, values)?;
        let rows = Rows { layout: &self.layout, couplings: &self.couplings, values };
        self.holds = if self.window.factorise(&rows, &mut self.scales) {
            Some(Holds::Window)
        } else {
            self.general.factorise(&rows, &mut self.scales).then_some(Holds::General)
        };
        Ok(())
    }

    /// Replaces the right-hand side by the solution. Whether the matrix has one.
    pub(super) fn solve(&self, unknowns: &mut [f64]) -> bool {
        let Some(holds) = self.holds else { return false };
        let (layout, couplings) = (&self.layout, &self.couplings);
        let Work { kept, eliminated } = &mut *self.work.borrow_mut();
        kept.resize(layout.order.len(), 0.0);
        couplings.begin(layout, unknowns, eliminated);
        let right = |at: usize, unknown: u32, scale: f64| {
            (unknowns[unknown as usize] - couplings.taken(layout, at, eliminated)) * scale
        };
        if holds == Holds::Window {
            self.window.forward(layout, &self.scales, right, kept);
            self.window.backward(layout, kept, unknowns);
        } else {
            let rows = layout.order.iter().zip(&self.scales).enumerate();
            for (value, (at, (&unknown, &scale))) in kept.iter_mut().zip(rows) {
                *value = right(at, unknown, scale);
            }
            self.general.substitute(kept);
            for (value, &unknown) in kept.iter().zip(&layout.order) {
                unknowns[unknown as usize] = *value;
            }
        }
        couplings.complete(layout, eliminated, unknowns);
        true
    }
}

impl General {
    /// Factorises a matrix and scales its rows. Whether each column has a pivot.
    fn factorise(&mut self, rows: &Rows<'_>, scales: &mut [f64]) -> bool {
        let (size, reach) = (scales.len(), rows.layout.reach);
        let width = 3 * reach + 1;
        self.reach = reach;
        self.rows.resize(size * width, 0.0);
        self.lower.resize(size * reach, 0.0);
        self.rows.fill(0.0);
        for (at, (row, scale)) in self.rows.chunks_exact_mut(width).zip(scales).enumerate() {
            *scale = rows.scaled(at, row);
        }
        self.pivots.clear();
        (0..size).all(|column| self.eliminate(column))
    }

    /// Chooses the pivot of a column and eliminates what is below it. Whether there was one.
    fn eliminate(&mut self, column: usize) -> bool {
        let (reach, size) = (self.reach, self.size());
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

    fn size(&self) -> usize {
        self.rows.len() / (3 * self.reach + 1)
    }

    /// Forward and backward; with exchanged rows `U` reaches twice as far.
    fn substitute(&self, work: &mut [f64]) {
        let (reach, size) = (self.reach, self.size());
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
#[path = "tests/reduced.rs"]
mod reduced_tests;
#[cfg(test)]
mod tests;
