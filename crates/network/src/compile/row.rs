//! Quantities as linear combinations of unknowns and inputs.

use dashpot_numerics::{DoubleDouble, LinearForm, packed};

/// Of the small rest of large terms: of a spring in parallel with the fastest dashpot of a chain only what
/// the other dashpots give way to is left.
type Form = LinearForm<DoubleDouble>;

/// What can be scaled and added: numbers and [`Row`]s.
pub(super) trait Combination: Clone + Default {
    /// `self + factor · other`.
    #[must_use]
    fn plus(&self, factor: impl Into<DoubleDouble>, other: &Self) -> Self;
}

impl Combination for f64 {
    fn plus(&self, factor: impl Into<DoubleDouble>, other: &Self) -> Self {
        self + factor.into().high() * other
    }
}

/// A quantity in SI units as a combination of unknowns (SI) and inputs (SI).
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Row {
    /// Coefficients over the unknowns.
    pub(super) unknowns: Form,
    /// Coefficients over the inputs.
    pub(super) inputs: Form,
}

impl Row {
    pub(super) fn unknown(at: usize) -> Self {
        Self { unknowns: Form::variable(at), inputs: Form::default() }
    }

    pub(super) fn input(at: usize) -> Self {
        Self { unknowns: Form::default(), inputs: Form::variable(at) }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.unknowns.is_zero() && self.inputs.is_zero()
    }

    pub(super) fn times(&self, factor: impl Into<DoubleDouble>) -> Self {
        Self::default().plus(factor, self)
    }
}

impl Combination for Row {
    fn plus(&self, factor: impl Into<DoubleDouble>, other: &Self) -> Self {
        let factor = factor.into();
        Self {
            unknowns: self.unknowns.plus(factor, &other.unknowns),
            inputs: self.inputs.plus(factor, &other.inputs),
        }
    }
}

/// Numbered rows, one behind the other: a large network has some ten for each of its masses. A row takes
/// 12 bytes and 20 for each term.
#[derive(Debug, Clone, Default)]
pub(super) struct Rows {
    places: Vec<Place>,
    variables: Vec<u32>,
    coefficients: Vec<DoubleDouble>,
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

impl Rows {
    fn place(&self, at: usize) -> Option<Place> {
        self.places.get(at).copied().filter(|place| place.start != Place::NONE.start)
    }

    pub(super) fn has(&self, at: usize) -> bool {
        self.place(at).is_some()
    }

    pub(super) fn get(&self, at: usize) -> Option<Row> {
        let Place { start, middle, end } = self.place(at)?;
        let form = |from: u32, to: u32| {
            let place = from as usize..to as usize;
            let variables = self.variables[place.clone()].iter().map(|&own| own as usize);
            Form::of(variables.zip(self.coefficients[place].iter().copied()))
        };
        Some(Row { unknowns: form(start, middle), inputs: form(middle, end) })
    }

    /// The row, zero if it is not there.
    pub(super) fn row(&self, at: usize) -> Row {
        self.get(at).unwrap_or_default()
    }

    /// Puts a row in the place of the one that may be there.
    ///
    /// # Panics
    ///
    /// When there are 2³² terms in all, or as many variables.
    pub(super) fn set(&mut self, at: usize, row: &Row) {
        let mut end_of = |form: &Form| {
            self.variables.extend(form.terms().iter().map(|term| packed(term.0)));
            self.coefficients.extend(form.terms().iter().map(|term| term.1));
            packed(self.variables.len())
        };
        let start = end_of(&Form::default());
        let middle = end_of(&row.unknowns);
        let place = Place { start, middle, end: end_of(&row.inputs) };
        self.places.resize(self.places.len().max(at + 1), Place::NONE);
        self.places[at] = place;
    }
}

/// A sum of many rows, formed in one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct RowSum {
    unknowns: Vec<(usize, DoubleDouble)>,
    inputs: Vec<(usize, DoubleDouble)>,
}

impl RowSum {
    pub(super) fn add(&mut self, factor: impl Into<DoubleDouble>, row: &Row) {
        let factor = factor.into();
        let scaled = |&(at, coefficient): &(usize, DoubleDouble)| (at, factor * coefficient);
        self.unknowns.extend(row.unknowns.terms().iter().map(scaled));
        self.inputs.extend(row.inputs.terms().iter().map(scaled));
    }

    pub(super) fn total(&self) -> Row {
        Row { unknowns: Form::sum(self.unknowns.clone()), inputs: Form::sum(self.inputs.clone()) }
    }
}

impl From<&Row> for RowSum {
    fn from(row: &Row) -> Self {
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
        let mut rows = Rows::default();
        rows.set(2, &one);
        rows.set(0, &Row::default());
        assert_eq!(
            (rows.get(2), rows.get(0), rows.get(1)),
            (Some(one), Some(Row::default()), None)
        );
        assert!(rows.has(0) && !rows.has(1) && !rows.has(3) && rows.row(1).is_zero());
        rows.set(2, &Row::input(4));
        rows.set(1, &Row::unknown(0));
        assert_eq!((rows.row(2), rows.row(1)), (Row::input(4), Row::unknown(0)));
    }
}
