//! Factorisation of matrices with a narrow band.

mod window;

use std::cell::RefCell;

use dashpot_numerics::packed;

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
    order: Vec<u32>,
    reach: usize,
    layout: Layout,
    /// One over the largest entry of each row, so that rows are compared on one scale.
    scales: Vec<f64>,
    /// The factors where no rows are exchanged and the last values can be kept at hand.
    window: window::Factors,
    /// The factors of any other matrix.
    general: General,
    /// Which of both hold; `None` where a column was left without a pivot.
    holds: Option<Holds>,
    work: RefCell<Vec<f64>>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Holds {
    Window,
    General,
}

/// Where the entries of a matrix belong in its band.
#[derive(Debug)]
struct Layout {
    /// Where the entries of each row end.
    ends: Vec<u32>,
    /// The number of each entry.
    sources: Vec<u32>,
    /// How far behind the first place of the band's row it belongs.
    offsets: Vec<u16>,
}

impl Layout {
    /// The layout of these entries `(row, column)`, whose unknowns come to lie in these `places`.
    fn of(
        places: &[usize],
        reach: usize,
        entries: impl Iterator<Item = (usize, usize)> + Clone,
    ) -> Self {
        let mut ends = vec![0; places.len()];
        for (row, _) in entries.clone() {
            ends[places[row]] += 1;
        }
        let mut sum = 0;
        for end in &mut ends {
            sum += std::mem::replace(end, sum);
        }
        let (mut sources, mut offsets) = (vec![0; sum as usize], vec![0; sum as usize]);
        for (source, (row, column)) in (0..).zip(entries) {
            let (row, column) = (places[row], places[column]);
            let at = ends[row] as usize;
            sources[at] = source;
            offsets[at] = u16::try_from(column + reach - row).unwrap_or(u16::MAX);
            ends[row] += 1;
        }
        Self { ends, sources, offsets }
    }

    /// The rows in order, each as its entries: numbers and offsets.
    fn rows(&self) -> impl Iterator<Item = impl Iterator<Item = (usize, usize)>> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&start, &end)| {
            let place = start as usize..end as usize;
            let entries = self.sources[place.clone()].iter().zip(&self.offsets[place]);
            entries.map(|(&source, &offset)| (source as usize, usize::from(offset)))
        })
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
    /// Room for matrices with these entries `(row, column)`, in this order; fewer than 2³².
    pub(super) fn of(order: Order, entries: impl Iterator<Item = (usize, usize)> + Clone) -> Self {
        let Order { unknowns, reach } = order;
        let size = unknowns.len();
        Self {
            layout: Layout::of(&places(&unknowns), reach, entries),
            order: unknowns.iter().map(|&unknown| packed(unknown)).collect(),
            reach,
            scales: vec![0.0; size],
            window: window::Factors::default(),
            general: General::default(),
            holds: None,
            work: RefCell::new(vec![0.0; size]),
        }
    }

    /// Factorises the matrix with these values of its entries.
    pub(super) fn factorise(&mut self, values: &[f64]) {
        self.holds = if self.window.factorise(self.reach, &self.layout, values, &mut self.scales) {
            Some(Holds::Window)
        } else {
            let found = self.general.factorise(self.reach, &self.layout, values, &mut self.scales);
            found.then_some(Holds::General)
        };
    }

    /// Replaces the right-hand side by the solution. Whether the matrix has one.
    pub(super) fn solve(&self, unknowns: &mut [f64]) -> bool {
        let Some(holds) = self.holds else { return false };
        let mut work = self.work.borrow_mut();
        if holds == Holds::Window {
            self.window.solve(self.reach, (&self.order, &self.scales), &mut work, unknowns);
            return true;
        }
        for ((value, &unknown), scale) in work.iter_mut().zip(&self.order).zip(&self.scales) {
            *value = unknowns[unknown as usize] * scale;
        }
        self.general.substitute(&mut work);
        for (value, &unknown) in work.iter().zip(&self.order) {
            unknowns[unknown as usize] = *value;
        }
        true
    }
}

impl General {
    /// Factorises the matrix with these values of its entries. Whether each column has a pivot.
    fn factorise(
        &mut self,
        reach: usize,
        layout: &Layout,
        values: &[f64],
        scales: &mut [f64],
    ) -> bool {
        let (size, width) = (scales.len(), 3 * reach + 1);
        self.reach = reach;
        self.rows.resize(size * width, 0.0);
        self.lower.resize(size * reach, 0.0);
        self.rows.fill(0.0);
        let rows = self.rows.chunks_exact_mut(width).zip(layout.rows());
        for ((row, entries), scale) in rows.zip(scales) {
            for (source, offset) in entries {
                row[offset] += values[source];
            }
            *scale = row.iter().fold(0.0_f64, |most, value| most.max(value.abs())).recip();
            for value in row {
                *value *= *scale;
            }
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
mod tests;
