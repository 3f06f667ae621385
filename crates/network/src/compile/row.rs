//! Quantities as linear combinations of unknowns and inputs.

use std::ops::Div;

use dashpot_numerics::{Coefficient, DoubleDouble, LinearForm, packed};

/// What rows are made of: numbers of twice the digits of a double, of which the small rest of large terms keeps its
/// own, or [traced](super::parametric) ones. Of a spring in parallel with the fastest dashpot of a chain only what the other
/// dashpots give way to is left.
pub(super) trait Scalar: Coefficient + From<f64> + Div<Output = Self> + PartialEq {}

impl<T: Coefficient + From<f64> + Div<Output = T> + PartialEq> Scalar for T {}

/// What can be scaled and added: numbers and [`Row`]s.
pub(super) trait Combination: Clone + Default {
    /// What it is scaled by.
    type Factor: Scalar;

    /// `self + factor · other`.
    #[must_use]
    fn plus(&self, factor: impl Into<Self::Factor>, other: &Self) -> Self;
}

impl Combination for f64 {
    type Factor = DoubleDouble;

    fn plus(&self, factor: impl Into<DoubleDouble>, other: &Self) -> Self {
        self + factor.into().high() * other
    }
}

/// A quantity in SI units as a combination of unknowns (SI) and inputs (SI).
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Row<T = DoubleDouble> {
    /// Coefficients over the unknowns.
    pub(super) unknowns: LinearForm<T>,
    /// Coefficients over the inputs.
    pub(super) inputs: LinearForm<T>,
}

impl<T: Scalar> Row<T> {
    pub(super) fn unknown(at: usize) -> Self {
        Self { unknowns: LinearForm::variable(at), inputs: LinearForm::zero() }
    }

    pub(super) fn input(at: usize) -> Self {
        Self { unknowns: LinearForm::zero(), inputs: LinearForm::variable(at) }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.unknowns.is_zero() && self.inputs.is_zero()
    }

    pub(super) fn times(&self, factor: impl Into<T>) -> Self {
        Self::default().plus(factor, self)
    }
}

impl<T: Scalar> Combination for Row<T> {
    type Factor = T;

    fn plus(&self, factor: impl Into<T>, other: &Self) -> Self {
        let factor = factor.into();
        Self {
            unknowns: self.unknowns.plus(factor, &other.unknowns),
            inputs: self.inputs.plus(factor, &other.inputs),
        }
    }
}

/// Numbered rows, one behind the other: a large network has some ten for each of its masses. A row takes
/// 12 bytes and 20 for each term, unless it is that of the number before or behind: what stands side by side is
/// deformed alike.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows<T = DoubleDouble> {
    places: Vec<Place>,
    variables: Vec<u32>,
    coefficients: Vec<T>,
}

/// Where a row's terms over unknowns begin and end, and where those over inputs end.
#[derive(Debug, Clone, Copy)]
struct Place {
    start: u32,
    middle: u32,
    end: u32,
}

impl Place {
    const NONE: Self = Self { start: u32::MAX, middle: 0, end: 0 };
}

impl<T: Scalar> Rows<T> {
    fn place(&self, at: usize) -> Option<Place> {
        self.places.get(at).copied().filter(|place| place.start != Place::NONE.start)
    }

    pub(super) fn has(&self, at: usize) -> bool {
        self.place(at).is_some()
    }

    pub(super) fn get(&self, at: usize) -> Option<Row<T>> {
        let Place { start, middle, end } = self.place(at)?;
        let form = |from: u32, to: u32| {
            let place = from as usize..to as usize;
            let variables = self.variables[place.clone()].iter().map(|&own| own as usize);
            LinearForm::of(variables.zip(self.coefficients[place].iter().copied()))
        };
        Some(Row { unknowns: form(start, middle), inputs: form(middle, end) })
    }

    /// The row, zero if it is not there.
    pub(super) fn row(&self, at: usize) -> Row<T> {
        self.get(at).unwrap_or_default()
    }

    /// Puts a row in the place of the one that may be there.
    ///
    /// # Panics
    ///
    /// When there are 2³² terms in all, or as many variables.
    pub(super) fn set(&mut self, at: usize, row: &Row<T>) {
        let mut beside = [at.checked_sub(1), Some(at + 1)].into_iter().flatten();
        let known = beside.find(|&beside| self.get(beside).is_some_and(|own| own == *row));
        let known = known.and_then(|known| self.place(known));
        let place = known.unwrap_or_else(|| self.add(row));
        self.places.resize(self.places.len().max(at + 1), Place::NONE);
        self.places[at] = place;
    }

    /// Adds a row behind the others.
    fn add(&mut self, row: &Row<T>) -> Place {
        let mut end_of = |form: &LinearForm<T>| {
            self.variables.extend(form.terms().iter().map(|term| packed(term.0)));
            self.coefficients.extend(form.terms().iter().map(|term| term.1));
            packed(self.variables.len())
        };
        let start = end_of(&LinearForm::zero());
        let middle = end_of(&row.unknowns);
        Place { start, middle, end: end_of(&row.inputs) }
    }
}

/// A sum of many rows, formed in one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct RowSum<T = DoubleDouble> {
    unknowns: Vec<(usize, T)>,
    inputs: Vec<(usize, T)>,
}

impl<T: Scalar> RowSum<T> {
    pub(super) fn add(&mut self, factor: impl Into<T>, row: &Row<T>) {
        let factor = factor.into();
        let scaled = |&(at, coefficient): &(usize, T)| (at, factor * coefficient);
        self.unknowns.extend(row.unknowns.terms().iter().map(scaled));
        self.inputs.extend(row.inputs.terms().iter().map(scaled));
    }

    pub(super) fn total(&self) -> Row<T> {
        let [unknowns, inputs] =
            [&self.unknowns, &self.inputs].map(|terms| LinearForm::sum(terms.iter().copied()));
        Row { unknowns, inputs }
    }
}

impl<T: Scalar> From<&Row<T>> for RowSum<T> {
    fn from(row: &Row<T>) -> Self {
        let mut sum = Self::default();
        sum.add(1.0, row);
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_back_as_they_were_put_in() {
        let third = DoubleDouble::ONE / 3.0;
        let one = Row::unknown(7).plus(third, &Row::unknown(2)).plus(-1.0, &Row::input(1));
        let mut rows = Rows::<DoubleDouble>::default();
        rows.set(2, &one);
        rows.set(0, &Row::default());
        assert_eq!(
            (rows.get(2), rows.get(0), rows.get(1)),
            (Some(one), Some(Row::default()), None)
        );
        assert!(rows.has(0) && !rows.has(1) && !rows.has(3) && rows.row(1).is_zero());
        rows.set(2, &Row::input(4));
        rows.set(1, &Row::unknown(0));
        let terms = rows.variables.len();
        rows.set(3, &Row::input(4));
        rows.set(0, &Row::unknown(0));
        rows.set(6, &Row::unknown(0));
        assert_eq!((rows.variables.len(), rows.row(3)), (terms + 1, Row::input(4)));
        assert_eq!((rows.row(2), rows.row(1)), (Row::input(4), Row::unknown(0)));
    }
}
