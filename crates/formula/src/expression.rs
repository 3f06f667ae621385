//! Expressions in pure numbers.

use std::sync::Arc;

use crate::Function;

/// A function of numbered variables, made of sums, products, powers and the [functions](Function).
///
/// What is constant in it is folded as it is made; terms that are zero and factors that are one are left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression(pub(crate) Arc<Term>);

#[derive(Debug, PartialEq)]
pub(crate) enum Term {
    Number(f64),
    Variable(usize),
    Negative(Expression),
    Sum([Expression; 2]),
    Difference([Expression; 2]),
    Product([Expression; 2]),
    /// A product, and 0 where the first one is zero, whatever the second one is there: a slope by the chain rule.
    Chain([Expression; 2]),
    Quotient([Expression; 2]),
    /// To a constant power.
    Power(Expression, f64),
    /// To a power that varies.
    Raised([Expression; 2]),
    Call(Function, Expression),
    /// A function of two.
    Pair(Function, [Expression; 2]),
    /// 1 where it is positive, else 0.
    Step(Expression),
}

/// A power, by multiplication where it is small and whole.
pub(crate) fn power(base: f64, exponent: f64) -> f64 {
    const MOST: f64 = 64.0;
    if exponent.fract() == 0.0 && exponent.abs() <= MOST {
        #[expect(clippy::cast_possible_truncation, reason = "it is whole and small")]
        return base.powi(exponent as i32);
    }
    base.powf(exponent)
}

impl Expression {
    fn of(term: Term) -> Self {
        Self(Arc::new(term))
    }

    /// A constant.
    pub fn number(value: f64) -> Self {
        Self::of(Term::Number(value))
    }

    /// The variable of this number.
    pub fn variable(at: usize) -> Self {
        Self::of(Term::Variable(at))
    }

    /// Its value where it is a constant.
    pub fn constant(&self) -> Option<f64> {
        if let Term::Number(value) = *self.0 { Some(value) } else { None }
    }

    fn is(&self, value: f64) -> bool {
        self.constant() == Some(value)
    }

    pub(crate) fn parts(&self) -> &[Self] {
        match &*self.0 {
            Term::Number(_) | Term::Variable(_) => &[],
            Term::Negative(inner)
            | Term::Power(inner, _)
            | Term::Call(_, inner)
            | Term::Step(inner) => std::slice::from_ref(inner),
            Term::Sum(parts)
            | Term::Difference(parts)
            | Term::Product(parts)
            | Term::Chain(parts)
            | Term::Quotient(parts)
            | Term::Raised(parts)
            | Term::Pair(_, parts) => parts,
        }
    }

    /// Whether a variable is in it.
    pub fn depends_on(&self, variable: usize) -> bool {
        matches!(*self.0, Term::Variable(at) if at == variable)
            || self.parts().iter().any(|part| part.depends_on(variable))
    }

    /// The same with a number in the place of a variable.
    #[must_use]
    pub fn with(&self, variable: usize, value: f64) -> Self {
        let inner = |own: &Self| own.with(variable, value);
        match &*self.0 {
            Term::Variable(at) if *at == variable => Self::number(value),
            Term::Number(_) | Term::Variable(_) => self.clone(),
            Term::Negative(own) => inner(own).negative(),
            Term::Sum([left, right]) => inner(left).plus(&inner(right)),
            Term::Difference([left, right]) => inner(left).minus(&inner(right)),
            Term::Product([left, right]) => inner(left).times(&inner(right)),
            Term::Chain([left, right]) => inner(left).chained(&inner(right)),
            Term::Quotient([left, right]) => inner(left).over(&inner(right)),
            Term::Power(base, exponent) => inner(base).to_the(&Self::number(*exponent)),
            Term::Raised([base, exponent]) => inner(base).to_the(&inner(exponent)),
            Term::Call(function, own) => inner(own).called(*function),
            Term::Pair(function, [left, right]) => {
                inner(left).called_with(*function, &inner(right))
            }
            Term::Step(own) => inner(own).step(),
        }
    }

    pub(crate) fn negative(&self) -> Self {
        match &*self.0 {
            Term::Number(value) => Self::number(-value),
            Term::Negative(inner) => inner.clone(),
            _ => Self::of(Term::Negative(self.clone())),
        }
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        match (self.constant(), other.constant()) {
            (Some(own), Some(other)) => Self::number(own + other),
            (Some(0.0), _) => other.clone(),
            (_, Some(0.0)) => self.clone(),
            _ => Self::of(Term::Sum([self.clone(), other.clone()])),
        }
    }

    pub(crate) fn minus(&self, other: &Self) -> Self {
        match (self.constant(), other.constant()) {
            (Some(own), Some(other)) => Self::number(own - other),
            (Some(0.0), _) => other.negative(),
            (_, Some(0.0)) => self.clone(),
            _ => Self::of(Term::Difference([self.clone(), other.clone()])),
        }
    }

    pub(crate) fn times(&self, other: &Self) -> Self {
        match (self.constant(), other.constant()) {
            (Some(own), Some(other)) => Self::number(own * other),
            (None, Some(_)) => other.times(self),
            (Some(0.0), _) => Self::number(0.0),
            (Some(1.0), _) => other.clone(),
            (Some(-1.0), _) => other.negative(),
            (Some(factor), None) => match &*other.0 {
                Term::Product([inner, rest]) if inner.constant().is_some() => {
                    Self::number(factor).times(inner).times(rest)
                }
                _ => Self::of(Term::Product([self.clone(), other.clone()])),
            },
            _ => Self::of(Term::Product([self.clone(), other.clone()])),
        }
    }

    /// This slope of an inner function times that of the outer one, which may be infinite where this is zero.
    pub(crate) fn chained(&self, outer: &Self) -> Self {
        match (self.constant(), outer.constant()) {
            (Some(_), _) => self.times(outer),
            (_, Some(slope)) if slope.is_finite() => self.times(outer),
            _ => Self::of(Term::Chain([self.clone(), outer.clone()])),
        }
    }

    pub(crate) fn over(&self, other: &Self) -> Self {
        match (self.constant(), other.constant()) {
            (Some(own), Some(other)) => Self::number(own / other),
            (_, Some(1.0)) | (Some(0.0), None) => self.clone(),
            _ => Self::of(Term::Quotient([self.clone(), other.clone()])),
        }
    }

    pub(crate) fn to_the(&self, exponent: &Self) -> Self {
        match (self.constant(), exponent.constant()) {
            (Some(base), Some(exponent)) => Self::number(power(base, exponent)),
            (_, Some(0.0)) => Self::number(1.0),
            (_, Some(1.0)) => self.clone(),
            (_, Some(exponent)) => Self::of(Term::Power(self.clone(), exponent)),
            (_, None) => Self::of(Term::Raised([self.clone(), exponent.clone()])),
        }
    }

    pub(crate) fn called(&self, function: Function) -> Self {
        match self.constant() {
            Some(value) => Self::number(function.value(value, 0.0)),
            None => Self::of(Term::Call(function, self.clone())),
        }
    }

    pub(crate) fn called_with(&self, function: Function, other: &Self) -> Self {
        match (self.constant(), other.constant()) {
            (Some(own), Some(other)) => Self::number(function.value(own, other)),
            _ => Self::of(Term::Pair(function, [self.clone(), other.clone()])),
        }
    }

    pub(crate) fn step(&self) -> Self {
        match self.constant() {
            Some(value) => Self::number(f64::from(u8::from(value > 0.0))),
            None => Self::of(Term::Step(self.clone())),
        }
    }

    /// The coefficients of 1, x, x² … where it is a polynomial of this variable alone, of a degree of at most 12.
    pub fn polynomial(&self, variable: usize) -> Option<Vec<f64>> {
        const MOST: usize = 12;
        let both = |parts: &[Self; 2]| {
            Some([parts[0].polynomial(variable)?, parts[1].polynomial(variable)?])
        };
        let sum = |[own, other]: [Vec<f64>; 2], sign: f64| {
            let at = |own: &[f64], power: usize| own.get(power).copied().unwrap_or(0.0);
            (0..own.len().max(other.len()))
                .map(|power| at(&own, power) + sign * at(&other, power))
                .collect::<Vec<_>>()
        };
        let product = |own: &[f64], other: &[f64]| {
            let mut found = vec![0.0; own.len() + other.len() - 1];
            for (at, factor) in own.iter().enumerate() {
                for (to, other) in found[at..].iter_mut().zip(other) {
                    *to += factor * other;
                }
            }
            (found.len() <= MOST + 1).then_some(found)
        };
        match &*self.0 {
            Term::Number(value) => Some(vec![*value]),
            Term::Variable(at) => (*at == variable).then(|| vec![0.0, 1.0]),
            Term::Negative(inner) => Some(product(&[-1.0], &inner.polynomial(variable)?)?),
            Term::Sum(parts) => Some(sum(both(parts)?, 1.0)),
            Term::Difference(parts) => Some(sum(both(parts)?, -1.0)),
            Term::Product(parts) => {
                let [own, other] = both(parts)?;
                product(&own, &other)
            }
            Term::Quotient([own, other]) => {
                let divisor = other.constant()?;
                Some(own.polynomial(variable)?.iter().map(|own| own / divisor).collect())
            }
            Term::Power(base, exponent)
                if exponent.fract() == 0.0 && (1.0..=12.0).contains(exponent) =>
            {
                let base = base.polynomial(variable)?;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "1 to 12"
                )]
                let times = *exponent as usize;
                (1..times).try_fold(base.clone(), |found, _| product(&found, &base))
            }
            _ => None,
        }
    }

    /// The slope over this variable where it is a straight line of it that is not level, with constants only.
    pub(crate) fn slope(&self, variable: usize) -> Option<f64> {
        match *self.polynomial(variable)?.as_slice() {
            [_, slope] if slope != 0.0 => Some(slope),
            _ => None,
        }
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.is(0.0)
    }
}
