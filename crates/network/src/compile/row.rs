//! Quantities as linear combinations of unknowns and inputs.

use dashpot_twofold::Twofold;

use super::form::Form;

/// What can be scaled and added: numbers and [`Row`]s.
pub(super) trait Combination: Clone + Default {
    /// `self + factor · other`.
    #[must_use]
    fn plus(&self, factor: impl Into<Twofold>, other: &Self) -> Self;
}

impl Combination for f64 {
    fn plus(&self, factor: impl Into<Twofold>, other: &Self) -> Self {
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

    pub(super) fn times(&self, factor: impl Into<Twofold>) -> Self {
        Self::default().plus(factor, self)
    }
}

impl Combination for Row {
    fn plus(&self, factor: impl Into<Twofold>, other: &Self) -> Self {
        let factor = factor.into();
        Self {
            unknowns: self.unknowns.plus(factor, &other.unknowns),
            inputs: self.inputs.plus(factor, &other.inputs),
        }
    }
}

/// A sum of many rows, formed in one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct RowSum {
    unknowns: Vec<(usize, Twofold)>,
    inputs: Vec<(usize, Twofold)>,
}

impl RowSum {
    pub(super) fn add(&mut self, factor: impl Into<Twofold>, row: &Row) {
        let factor = factor.into();
        let scaled = |&(at, coefficient): &(usize, Twofold)| (at, factor * coefficient);
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
