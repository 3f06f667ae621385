//! Sparse linear forms.

/// A sparse linear form `Σ cᵢ zᵢ` over numbered variables, kept sorted by variable.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LinearForm {
    terms: Vec<(usize, f64)>,
}

impl LinearForm {
    /// The form that is zero everywhere.
    pub fn zero() -> Self {
        Self::default()
    }

    /// The form `coefficient · z_variable`.
    pub fn term(variable: usize, coefficient: f64) -> Self {
        if coefficient == 0.0 {
            Self::zero()
        } else {
            Self { terms: vec![(variable, coefficient)] }
        }
    }

    /// The sum of `terms`, which may stand in any order and name a variable more than once.
    pub fn sum(mut terms: Vec<(usize, f64)>) -> Self {
        terms.sort_by_key(|term| term.0);
        let mut merged: Vec<(usize, f64)> = Vec::with_capacity(terms.len());
        for (variable, coefficient) in terms {
            match merged.last_mut() {
                Some(last) if last.0 == variable => last.1 += coefficient,
                _ => merged.push((variable, coefficient)),
            }
        }
        merged.retain(|term| term.1 != 0.0);
        Self { terms: merged }
    }

    /// The terms `(variable, coefficient)` in rising order of the variable; none is zero.
    pub fn terms(&self) -> &[(usize, f64)] {
        &self.terms
    }

    /// Whether no variable appears.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The coefficient of `variable`, zero where it does not appear.
    pub fn coefficient(&self, variable: usize) -> f64 {
        self.terms.binary_search_by_key(&variable, |term| term.0).map_or(0.0, |at| self.terms[at].1)
    }

    /// `self + factor · other`; terms that cancel exactly disappear.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let mut terms = Vec::with_capacity(self.terms.len() + other.terms.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            let term = match (left.peek(), right.peek()) {
                (Some(&&(i, a)), Some(&&(j, _))) if i < j => {
                    left.next();
                    (i, a)
                }
                (Some(&&(i, a)), Some(&&(j, b))) if i == j => {
                    left.next();
                    right.next();
                    (i, a + factor * b)
                }
                (_, Some(&&(j, b))) => {
                    right.next();
                    (j, factor * b)
                }
                (Some(&&(i, a)), None) => {
                    left.next();
                    (i, a)
                }
                (None, None) => break,
            };
            if term.1 != 0.0 {
                terms.push(term);
            }
        }
        Self { terms }
    }

    /// `factor · self`.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        Self::zero().plus(factor, self)
    }

    /// The value at the point `z`.
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn at(&self, z: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, c)| c * z[i]).sum()
    }

    /// `Σ |cᵢ zᵢ|`, the scale of the rounding error of [`at`](Self::at).
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn magnitude_at(&self, z: &[f64]) -> f64 {
        self.terms.iter().map(|&(i, c)| (c * z[i]).abs()).sum()
    }
}

/// A [`LinearForm`] that lies among others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FormRef<'f> {
    variables: &'f [u32],
    coefficients: &'f [f64],
}

impl<'f> FormRef<'f> {
    /// The form of these variables, in rising order, and as many coefficients.
    pub(crate) fn new(variables: &'f [u32], coefficients: &'f [f64]) -> Self {
        Self { variables, coefficients }
    }

    /// The terms `(variable, coefficient)` in rising order of the variable; none is zero.
    pub fn terms(self) -> impl ExactSizeIterator<Item = (usize, f64)> + Clone + 'f {
        let variables = self.variables.iter().map(|&variable| variable as usize);
        variables.zip(self.coefficients.iter().copied())
    }

    /// Whether no variable appears.
    pub fn is_zero(self) -> bool {
        self.variables.is_empty()
    }

    /// The coefficient of `variable`, zero where it does not appear.
    pub fn coefficient(self, variable: usize) -> f64 {
        self.terms().find(|term| term.0 == variable).map_or(0.0, |term| term.1)
    }

    /// The value at the point `z`.
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn at(self, z: &[f64]) -> f64 {
        self.terms().map(|(i, c)| c * z[i]).sum()
    }

    /// `Σ |cᵢ zᵢ|`, the scale of the rounding error of [`at`](Self::at).
    ///
    /// # Panics
    ///
    /// When a variable of the form lies beyond the end of `z`.
    pub fn magnitude_at(self, z: &[f64]) -> f64 {
        self.terms().map(|(i, c)| (c * z[i]).abs()).sum()
    }

    /// The same form by itself.
    pub fn to_form(self) -> LinearForm {
        LinearForm { terms: self.terms().collect() }
    }
}
