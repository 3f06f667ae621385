//! Terms of a system that are not linear.

use std::{fmt::Debug, sync::Arc};

use crate::LinearForm;

/// A scalar law of two quantities, for instance a force of a deformation and its rate; SI units.
///
/// It must be continuous, and its slopes must be those of the value.
pub trait Characteristic: Debug + Send + Sync {
    /// The value at `arguments`.
    fn value(&self, arguments: [f64; 2]) -> f64;

    /// The partial derivatives of [`value`](Self::value) at `arguments`.
    fn slopes(&self, arguments: [f64; 2]) -> [f64; 2];
}

/// A quantity in SI units that a [`Term`] depends on: `scale · (unknowns·y + inputs·w)`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Argument {
    /// SI value of the dimensionless value 1.
    pub scale: f64,
    /// Coefficients over the unknowns.
    pub unknowns: LinearForm,
    /// Coefficients over the inputs.
    pub inputs: LinearForm,
}

impl Argument {
    /// Its value \[SI\] where the unknowns are `y` and the inputs `w`.
    pub fn at(&self, y: &[f64], w: &[f64]) -> f64 {
        self.scale * (self.unknowns.at(y) + self.inputs.at(w))
    }
}

/// A term `factor · law(arguments)` in the row of an algebraic unknown.
#[derive(Debug, Clone)]
pub struct Term {
    /// The row to which it belongs, that of an algebraic unknown.
    pub row: usize,
    /// Value of the row's unit of the law's SI unit.
    pub factor: f64,
    /// The law.
    pub law: Arc<dyn Characteristic>,
    /// What it depends on.
    pub arguments: [Argument; 2],
}

impl Term {
    /// What it adds to its row.
    pub fn value(&self, y: &[f64], w: &[f64]) -> f64 {
        self.factor * self.law.value(self.arguments.each_ref().map(|own| own.at(y, w)))
    }

    /// The slopes of [`value`](Self::value) over both arguments, in SI units of these.
    pub fn slopes(&self, y: &[f64], w: &[f64]) -> [f64; 2] {
        self.law.slopes(self.arguments.each_ref().map(|own| own.at(y, w))).map(|s| self.factor * s)
    }

    /// The unknowns that it depends on, in rising order.
    pub fn columns(&self) -> Vec<usize> {
        let mut columns: Vec<usize> = self
            .arguments
            .iter()
            .flat_map(|argument| argument.unknowns.terms().iter().map(|term| term.0))
            .collect();
        columns.sort_unstable();
        columns.dedup();
        columns
    }
}
