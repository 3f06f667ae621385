//! Expressions made fast: a list of steps in which nothing is computed twice.

use crate::{Expression, Function, expression::Term, expression::power};

/// Several expressions, compiled to be evaluated together many times.
///
/// Every value has a register: first the numbers, which are there from the beginning, then one for each step.
#[derive(Debug, Clone)]
pub struct Program {
    numbers: Vec<f64>,
    steps: Vec<Step>,
    /// The registers whose values are wanted.
    outputs: Vec<u32>,
}

/// What a step makes of the values of registers.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    Variable(usize),
    Negative(u32),
    Sum([u32; 2]),
    Difference([u32; 2]),
    Product([u32; 2]),
    Chain([u32; 2]),
    Quotient([u32; 2]),
    Square(u32),
    Power(u32, f64),
    Raised([u32; 2]),
    Call(Function, u32),
    Pair(Function, [u32; 2]),
    Positive(u32),
}

/// So many registers need no allocation, and so many little time to be cleared.
const ON_STACK: usize = 48;
const FEW: usize = 12;

impl Program {
    /// The program of these expressions.
    pub fn of<'e>(expressions: impl IntoIterator<Item = &'e Expression> + Clone) -> Self {
        let mut own = Self { numbers: Vec::new(), steps: Vec::new(), outputs: Vec::new() };
        expressions.clone().into_iter().for_each(|expression| own.add_numbers(expression));
        for expression in expressions {
            let output = own.add(expression);
            own.outputs.push(output);
        }
        own
    }

    fn add_numbers(&mut self, expression: &Expression) {
        if let Term::Number(value) = *expression.0
            && self.place_of(value).is_none()
        {
            self.numbers.push(value);
        }
        expression.parts().iter().for_each(|part| self.add_numbers(part));
    }

    fn place_of(&self, number: f64) -> Option<usize> {
        self.numbers.iter().position(|own| own.to_bits() == number.to_bits())
    }

    /// The register of an expression.
    fn add(&mut self, expression: &Expression) -> u32 {
        let step = match &*expression.0 {
            Term::Number(value) => return register(self.place_of(*value)),
            Term::Variable(at) => Step::Variable(*at),
            Term::Negative(inner) => Step::Negative(self.add(inner)),
            Term::Sum(parts) => Step::Sum(self.both(parts)),
            Term::Difference(parts) => Step::Difference(self.both(parts)),
            Term::Product(parts) => Step::Product(self.both(parts)),
            Term::Chain(parts) => Step::Chain(self.both(parts)),
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
        register(Some(self.numbers.len() + at))
    }

    fn both(&mut self, [left, right]: &[Expression; 2]) -> [u32; 2] {
        [self.add(left), self.add(right)]
    }

    /// The values of the expressions at these variables, into `values`, in their order.
    pub fn evaluate(&self, variables: &[f64], values: &mut [f64]) {
        let all = self.numbers.len() + self.steps.len();
        if all <= FEW {
            self.run(variables, &mut [0.0; FEW], values);
        } else if all <= ON_STACK {
            self.run(variables, &mut [0.0; ON_STACK], values);
        } else {
            self.run(variables, &mut vec![0.0; all], values);
        }
    }

    /// The value of the first expression.
    pub fn value(&self, variables: &[f64]) -> f64 {
        let mut value = [f64::NAN];
        self.evaluate(variables, &mut value);
        value[0]
    }

    fn run(&self, variables: &[f64], found: &mut [f64], values: &mut [f64]) {
        let first = self.numbers.len();
        found[..first].copy_from_slice(&self.numbers);
        for (at, step) in self.steps.iter().enumerate() {
            let of = |own: u32| found[own as usize];
            found[first + at] = match *step {
                Step::Variable(at) => variables.get(at).copied().unwrap_or(f64::NAN),
                Step::Negative(inner) => -of(inner),
                Step::Sum([left, right]) => of(left) + of(right),
                Step::Difference([left, right]) => of(left) - of(right),
                Step::Product([left, right]) => of(left) * of(right),
                Step::Chain([slope, _]) if of(slope) == 0.0 => 0.0,
                Step::Chain([slope, outer]) => of(slope) * of(outer),
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

/// A register by its place; no text of a formula is so long that there were none.
fn register(place: Option<usize>) -> u32 {
    place.and_then(|place| u32::try_from(place).ok()).unwrap_or(u32::MAX)
}
