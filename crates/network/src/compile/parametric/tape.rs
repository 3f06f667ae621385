//! The operations of an assembly, done with the numbers of one network after the other.

use super::traced::{Kind, Node, Recorder, Traced};
use crate::compile::row::Row;

/// An operation on two values, and the place of its result.
#[derive(Debug, Clone, Copy)]
struct Operation {
    kind: Kind,
    operands: [usize; 2],
    result: usize,
}

/// Operations one after the other, and where what they begin with stands among the values.
#[derive(Debug, Clone, Default)]
pub(super) struct Tape {
    numbers: Vec<(usize, usize)>,
    constants: Vec<(usize, f64)>,
    operations: Vec<Operation>,
    values: usize,
}

/// A coefficient over unknowns and slots.
#[derive(Debug, Clone, Copy)]
pub(super) struct Term {
    pub(super) column: usize,
    /// Where it stands among the values.
    value: usize,
    /// What it is to be multiplied by.
    factor: f64,
}

impl Term {
    pub(super) fn at(self, values: &[f64]) -> f64 {
        values[self.value] * self.factor
    }
}

/// A row over unknowns and slots.
#[derive(Debug, Clone, Default)]
pub(super) struct Pattern {
    pub(super) terms: Vec<Term>,
}

impl Pattern {
    /// A row of `recorder` times a factor over unknowns in units of their `scales`, with inputs in slots behind them. `None`
    /// where one of its coefficients is no number.
    pub(super) fn of(
        row: &Row<Traced<'_>>,
        recorder: &Recorder,
        (factor, scales): (f64, &[f64]),
        inputs: usize,
    ) -> Option<Self> {
        let given = row.inputs.terms().iter().map(|&(at, own)| (inputs + at, own));
        let all = row.unknowns.terms().iter().copied().chain(given);
        let term = |(column, own): (usize, Traced<'_>)| {
            let value = own.asked(recorder)?;
            Some(Term { column, value, factor: factor * scales[column] })
        };
        Some(Self { terms: all.map(term).collect::<Option<_>>()? })
    }

    pub(super) fn at<const N: usize>(&self, values: &[f64]) -> [f64; N] {
        let mut row = [0.0; N];
        self.terms.iter().for_each(|term| row[term.column] = term.at(values));
        row
    }
}

impl Tape {
    /// What was asked for of a recording.
    pub(super) fn of(recorder: &Recorder) -> Self {
        let nodes = recorder.nodes();
        let mut own = Self { values: nodes.len(), ..Self::default() };
        for (result, (node, _)) in nodes.into_iter().enumerate().filter(|(_, node)| node.1) {
            match node {
                Node::Number(number) => own.numbers.push((result, number)),
                Node::Constant(value) => own.constants.push((result, value)),
                Node::Done(kind, operands) => {
                    own.operations.push(Operation { kind, operands, result });
                }
            }
        }
        own
    }

    /// Room for all values.
    pub(super) fn values(&self) -> Vec<f64> {
        let mut values = vec![0.0; self.values];
        self.constants.iter().for_each(|&(at, constant)| values[at] = constant);
        values
    }

    /// Does all operations with these numbers.
    pub(super) fn run(&self, numbers: &[f64], values: &mut [f64]) {
        self.numbers.iter().for_each(|&(at, number)| values[at] = numbers[number]);
        for Operation { kind, operands, result } in &self.operations {
            let [one, other] = operands.map(|operand| values[operand]);
            values[*result] = match kind {
                Kind::Sum => one + other,
                Kind::Product => one * other,
                Kind::Quotient => one / other,
            };
        }
    }
}
