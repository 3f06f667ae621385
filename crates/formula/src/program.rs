//! Expressions made fast: a list of steps in which nothing is computed twice.

use crate::{Expression, Function, expression::Term, expression::power};

/// Several expressions, compiled to be evaluated together many times.
#[derive(Debug, Clone)]
pub struct Program {
    steps: Vec<Step>,
    /// The steps whose values are wanted.
    outputs: Vec<u32>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    Number(f64),
    Variable(usize),
    Negative(u32),
    Sum([u32; 2]),
    Difference([u32; 2]),
    Product([u32; 2]),
    Quotient([u32; 2]),
    Square(u32),
    Power(u32, f64),
    Raised([u32; 2]),
    Call(Function, u32),
    Pair(Function, [u32; 2]),
    Positive(u32),
}

/// So many steps are kept without an allocation.
const ON_STACK: usize = 48;

impl Program {
    /// The program of these expressions.
    pub fn of<'e>(expressions: impl IntoIterator<Item = &'e Expression>) -> Self {
        let mut own = Self { steps: Vec::new(), outputs: Vec::new() };
        for expression in expressions {
            let output = own.add(expression);
            own.outputs.push(output);
        }
        own
    }

    fn add(&mut self, expression: &Expression) -> u32 {
        let step = match &*expression.0 {
            Term::Number(value) => Step::Number(*value),
            Term::Variable(at) => Step::Variable(*at),
            Term::Negative(inner) => Step::Negative(self.add(inner)),
            Term::Sum(parts) => Step::Sum(self.both(parts)),
            Term::Difference(parts) => Step::Difference(self.both(parts)),
            Term::Product(parts) => Step::Product(self.both(parts)),
            Term::Quotient(parts) => Step::Quotient(self.both(parts)),
            Term::Power(base, 2.0) => Step::Square(self.add(base)),
            Term::Power(base, exponent) => Step::Power(self.add(base), *exponent),
            Term::Raised(parts) => Step::Raised(self.both(parts)),
            Term::Call(function, inner) => Step::Call(*function, self.add(inner)),
            Term::Pair(function, parts) => Step::Pair(*function, self.both(parts)),
            Term::Step(inner) => Step::Positive(self.add(inner)),
        };
        let known = self.steps.iter().position(|own| *own == step);
        let at = known.unwrap_or_else(|| {
            self.steps.push(step);
            self.steps.len() - 1
        });
        u32::try_from(at).unwrap_or(u32::MAX)
    }

    fn both(&mut self, [left, right]: &[Expression; 2]) -> [u32; 2] {
        [self.add(left), self.add(right)]
    }

    /// The values of the expressions at these variables, into `values`, in their order.
    pub fn evaluate(&self, variables: &[f64], values: &mut [f64]) {
        if self.steps.len() <= ON_STACK {
            self.run(variables, &mut [0.0; ON_STACK], values);
        } else {
            self.run(variables, &mut vec![0.0; self.steps.len()], values);
        }
    }

    /// The value of the first expression.
    pub fn value(&self, variables: &[f64]) -> f64 {
        let mut value = [f64::NAN];
        self.evaluate(variables, &mut value);
        value[0]
    }

    fn run(&self, variables: &[f64], found: &mut [f64], values: &mut [f64]) {
        for (at, step) in self.steps.iter().enumerate() {
            let of = |own: u32| found[own as usize];
            found[at] = match *step {
                Step::Number(value) => value,
                Step::Variable(at) => variables.get(at).copied().unwrap_or(f64::NAN),
                Step::Negative(inner) => -of(inner),
                Step::Sum([left, right]) => of(left) + of(right),
                Step::Difference([left, right]) => of(left) - of(right),
                Step::Product([left, right]) => of(left) * of(right),
                Step::Quotient([left, right]) => of(left) / of(right),
                Step::Square(inner) => of(inner) * of(inner),
                Step::Power(base, exponent) => power(of(base), exponent),
                Step::Raised([base, exponent]) => of(base).powf(of(exponent)),
                Step::Call(function, inner) => function.value(of(inner), 0.0),
                Step::Pair(function, [left, right]) => function.value(of(left), of(right)),
                Step::Positive(inner) => f64::from(u8::from(of(inner) > 0.0)),
            };
        }
        for (value, output) in values.iter_mut().zip(&self.outputs) {
            *value = found[*output as usize];
        }
    }
}
