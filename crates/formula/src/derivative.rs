//! Derivatives.

use crate::{Expression, Function, expression::Term};

impl Expression {
    /// The derivative over a variable. Where `abs`, `min` or `max` have a kink it is that of one of the sides.
    #[must_use]
    pub fn derivative(&self, variable: usize) -> Self {
        let number = Self::number;
        let rate = |own: &Self| own.derivative(variable);
        match &*self.0 {
            Term::Number(_) | Term::Step(_) => number(0.0),
            Term::Variable(at) => number(f64::from(u8::from(*at == variable))),
            Term::Negative(inner) => rate(inner).negative(),
            Term::Sum([left, right]) => rate(left).plus(&rate(right)),
            Term::Difference([left, right]) => rate(left).minus(&rate(right)),
            Term::Product([left, right]) | Term::Chain([left, right]) => {
                rate(left).times(right).plus(&left.times(&rate(right)))
            }
            Term::Quotient([left, right]) => {
                let first = rate(left).over(right);
                let second = rate(right);
                if second.is_zero() {
                    return first;
                }
                first.minus(&left.times(&second).over(&right.times(right)))
            }
            Term::Power(base, exponent) => {
                let outer = number(*exponent).times(&base.to_the(&number(exponent - 1.0)));
                if *exponent < 1.0 { rate(base).chained(&outer) } else { rate(base).times(&outer) }
            }
            Term::Raised([base, exponent]) => {
                let of_exponent = rate(exponent).times(&base.called(Function::Ln));
                let of_base = exponent.times(&rate(base)).over(base);
                self.times(&of_exponent.plus(&of_base))
            }
            Term::Call(function, inner) => {
                let outer = self.outer(*function, inner);
                match function {
                    // What has poles: a slope is infinite where the function ends.
                    Function::Sqrt | Function::Asin | Function::Acos => rate(inner).chained(&outer),
                    _ => rate(inner).times(&outer),
                }
            }
            Term::Pair(function, [left, right]) => {
                let takes_left = match function {
                    Function::Min => right.minus(left),
                    _ => left.minus(right),
                };
                let left_counts = takes_left.step();
                let right_counts = number(1.0).minus(&left_counts);
                rate(left).times(&left_counts).plus(&rate(right).times(&right_counts))
            }
        }
    }

    /// The derivative of the function of `inner`, which is this expression, over `inner`.
    fn outer(&self, function: Function, inner: &Self) -> Self {
        let number = Self::number;
        let square = |own: &Self| own.times(own);
        match function {
            Function::Sqrt => number(0.5).over(self),
            Function::Abs => number(2.0).times(&inner.step()).minus(&number(1.0)),
            Function::Exp => self.clone(),
            Function::Ln => number(1.0).over(inner),
            Function::Log10 => number(std::f64::consts::LOG10_E).over(inner),
            Function::Sin => inner.called(Function::Cos),
            Function::Cos => inner.called(Function::Sin).negative(),
            Function::Tan => number(1.0).plus(&square(self)),
            Function::Asin => {
                number(1.0).over(&number(1.0).minus(&square(inner)).called(Function::Sqrt))
            }
            Function::Acos => {
                number(-1.0).over(&number(1.0).minus(&square(inner)).called(Function::Sqrt))
            }
            Function::Atan => number(1.0).over(&number(1.0).plus(&square(inner))),
            Function::Sinh => inner.called(Function::Cosh),
            Function::Cosh => inner.called(Function::Sinh),
            Function::Tanh => number(1.0).minus(&square(self)),
            // Those of two have no inner one.
            Function::Min | Function::Max => number(0.0),
        }
    }
}
