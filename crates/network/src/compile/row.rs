//! Quantities as linear combinations of unknowns and inputs.

use dashpot_dae::LinearForm;

/// What can be scaled and added: numbers and [`Row`]s.
pub(super) trait Combination: Clone + Default {
    /// `self + factor · other`.
    #[must_use]
    fn plus(&self, factor: f64, other: &Self) -> Self;
}

impl Combination for f64 {
    fn plus(&self, factor: f64, other: &Self) -> Self {
        self + factor * other
    }
}

/// A quantity in SI units as a combination of unknowns (SI) and inputs (SI).
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Row {
    /// Coefficients over the unknowns.
    pub(super) unknowns: LinearForm,
    /// Coefficients over the inputs.
    pub(super) inputs: LinearForm,
}

impl Row {
    pub(super) fn unknown(at: usize) -> Self {
        Self { unknowns: LinearForm::term(at, 1.0), inputs: LinearForm::zero() }
    }

    pub(super) fn input(at: usize) -> Self {
        Self { unknowns: LinearForm::zero(), inputs: LinearForm::term(at, 1.0) }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.unknowns.is_zero() && self.inputs.is_zero()
    }

    pub(super) fn times(&self, factor: f64) -> Self {
        Self::default().plus(factor, self)
    }
}

impl Combination for Row {
    fn plus(&self, factor: f64, other: &Self) -> Self {
        Self {
            unknowns: self.unknowns.plus(factor, &other.unknowns),
            inputs: self.inputs.plus(factor, &other.inputs),
        }
    }
}

/// A sum of many rows, formed in one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct RowSum {
    unknowns: Vec<(usize, f64)>,
    inputs: Vec<(usize, f64)>,
}

impl RowSum {
    pub(super) fn add(&mut self, factor: f64, row: &Row) {
        let scaled = |&(at, coefficient): &(usize, f64)| (at, factor * coefficient);
        self.unknowns.extend(row.unknowns.terms().iter().map(scaled));
        self.inputs.extend(row.inputs.terms().iter().map(scaled));
    }

    pub(super) fn total(&self) -> Row {
        Row {
            unknowns: LinearForm::sum(self.unknowns.clone()),
            inputs: LinearForm::sum(self.inputs.clone()),
        }
    }
}

impl From<&Row> for RowSum {
    fn from(row: &Row) -> Self {
        let mut sum = Self::default();
        sum.add(1.0, row);
        sum
    }
}
