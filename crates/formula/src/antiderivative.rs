//! Integrals in closed form, where they are known.

use crate::{Expression, Function, expression::Term};

impl Expression {
    /// An integral over a variable, with all else constant; `None` where none is known here: of sums of
    /// polynomials, and of functions and powers of straight lines, it is.
    pub fn integral(&self, variable: usize) -> Option<Self> {
        let number = Self::number;
        if let Some(coefficients) = self.polynomial(variable) {
            let x = Self::variable(variable);
            // Horner's scheme from the highest power down.
            let of_power = |(power, own): (usize, &f64)| number(own / (power + 1) as f64);
            let terms = coefficients.iter().enumerate().map(of_power).rev();
            return Some(terms.fold(number(0.0), |sum, own| own.plus(&sum).times(&x)));
        }
        if !self.depends_on(variable) {
            return Some(self.times(&Self::variable(variable)));
        }
        let inner = |own: &Self| own.integral(variable);
        match &*self.0 {
            Term::Negative(own) => Some(inner(own)?.negative()),
            Term::Sum([left, right]) => Some(inner(left)?.plus(&inner(right)?)),
            Term::Difference([left, right]) => Some(inner(left)?.minus(&inner(right)?)),
            Term::Product([left, right]) if !left.depends_on(variable) => {
                Some(left.times(&inner(right)?))
            }
            Term::Product([left, right]) if !right.depends_on(variable) => {
                Some(inner(left)?.times(right))
            }
            Term::Quotient([left, right]) if !right.depends_on(variable) => {
                Some(inner(left)?.over(right))
            }
            Term::Power(base, exponent) if *exponent > 0.0 => {
                let slope = base.slope(variable).or_else(|| base.positive_slope(variable))?;
                let higher = base.to_the(&number(exponent + 1.0));
                Some(higher.over(&number((exponent + 1.0) * slope)))
            }
            Term::Pair(..) => {
                let slope = self.positive_slope(variable)?;
                Some(self.times(self).over(&number(2.0 * slope)))
            }
            Term::Call(function, line) => {
                let slope = line.slope(variable)?;
                let whole = match function {
                    Function::Exp => self.clone(),
                    Function::Sin => line.called(Function::Cos).negative(),
                    Function::Cos => line.called(Function::Sin),
                    Function::Sinh => line.called(Function::Cosh),
                    Function::Cosh => line.called(Function::Sinh),
                    Function::Tanh => line.called(Function::Cosh).called(Function::Ln),
                    _ => return None,
                };
                Some(whole.over(&number(slope)))
            }
            _ => None,
        }
    }

    /// Of a multiple of `max(0, line)`, the slope where it is positive.
    fn positive_slope(&self, variable: usize) -> Option<f64> {
        match &*self.0 {
            Term::Pair(Function::Max, [left, right]) if left.is_zero() => right.slope(variable),
            Term::Pair(Function::Max, [left, right]) if right.is_zero() => left.slope(variable),
            Term::Quotient([own, divisor]) => {
                Some(own.positive_slope(variable)? / divisor.constant()?)
            }
            Term::Product([factor, own]) => {
                Some(factor.constant()? * own.positive_slope(variable)?)
            }
            _ => None,
        }
    }
}
