//! Expressions that are a polynomial and sines.

use crate::{Expression, Function, expression::Term};

/// A function of one variable that is a polynomial and a sine.
#[derive(Debug, Clone, PartialEq)]
pub struct PolynomialAndSine {
    /// The coefficients of 1, x, x² …
    pub polynomial: Vec<f64>,
    /// Amplitude of `sin(ω x)`.
    pub sine: f64,
    /// Amplitude of `cos(ω x)`.
    pub cosine: f64,
    /// Angular frequency ω, positive; zero where there is no sine.
    pub omega: f64,
}

impl Expression {
    /// The expression as a polynomial of degree 12 or less and a sine of one frequency; `None` where it is not.
    pub fn polynomial_and_sine(&self, variable: usize) -> Option<PolynomialAndSine> {
        let mut found =
            PolynomialAndSine { polynomial: vec![0.0], sine: 0.0, cosine: 0.0, omega: 0.0 };
        found.add(self, 1.0, variable)?;
        Some(found)
    }
}

impl PolynomialAndSine {
    /// Adds `factor` times a term.
    fn add(&mut self, term: &Expression, factor: f64, variable: usize) -> Option<()> {
        if let Some(own) = term.polynomial(variable) {
            let length = self.polynomial.len().max(own.len());
            self.polynomial.resize(length, 0.0);
            self.polynomial.iter_mut().zip(&own).for_each(|(to, own)| *to += factor * own);
            return Some(());
        }
        match &*term.0 {
            Term::Negative(inner) => self.add(inner, -factor, variable),
            Term::Sum([left, right]) => {
                self.add(left, factor, variable)?;
                self.add(right, factor, variable)
            }
            Term::Difference([left, right]) => {
                self.add(left, factor, variable)?;
                self.add(right, -factor, variable)
            }
            // Constants stand on the left.
            Term::Product([left, right]) => self.add(right, factor * left.constant()?, variable),
            Term::Quotient([left, right]) => self.add(left, factor / right.constant()?, variable),
            Term::Call(function @ (Function::Sin | Function::Cos), line) => {
                let [phase, omega] = *line.polynomial(variable)?.as_slice() else { return None };
                let (sin, cos) = phase.sin_cos();
                let sign = omega.signum();
                // sin(ω x + φ) = cos φ sin ω x + sin φ cos ω x, and likewise cos.
                let (sine, cosine) =
                    if *function == Function::Sin { (sign * cos, sin) } else { (-sign * sin, cos) };
                if self.omega != 0.0 && (self.omega - omega.abs()).abs() > 0.0 {
                    return None;
                }
                self.omega = omega.abs();
                self.sine += factor * sine;
                self.cosine += factor * cosine;
                Some(())
            }
            _ => None,
        }
    }
}
