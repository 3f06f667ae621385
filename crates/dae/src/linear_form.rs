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

/// Many linear forms, one behind the other: each takes four bytes and twelve for each term.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Forms {
    /// Where the terms of each form end.
    ends: Vec<u32>,
    variables: Vec<u32>,
    coefficients: Vec<f64>,
}

impl Forms {
    /// Adds a form of these terms, in rising order of the variable.
    ///
    /// # Panics
    ///
    /// When there are 2³² terms in all, or as many variables.
    pub(crate) fn push(&mut self, terms: impl Iterator<Item = (usize, f64)>) {
        for (variable, coefficient) in terms {
            self.variables.push(packed(variable));
            self.coefficients.push(coefficient);
        }
        self.ends.push(packed(self.variables.len()));
    }

    /// The form of this number.
    ///
    /// # Panics
    ///
    /// When there are not so many.
    pub(crate) fn form(&self, at: usize) -> FormRef<'_> {
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        self.between(start, self.ends[at])
    }

    /// All forms in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = FormRef<'_>> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(&start, &end)| self.between(start, end))
    }

    fn between(&self, start: u32, end: u32) -> FormRef<'_> {
        let place = start as usize..end as usize;
        FormRef {
            variables: &self.variables[place.clone()],
            coefficients: &self.coefficients[place],
        }
    }

    /// Gives back memory that was set aside for more.
    pub(crate) fn shrink_to_fit(&mut self) {
        self.ends.shrink_to_fit();
        self.variables.shrink_to_fit();
        self.coefficients.shrink_to_fit();
    }
}

/// A number in four bytes.
///
/// # Panics
///
/// When it has no room there.
pub(crate) fn packed(number: usize) -> u32 {
    u32::try_from(number).unwrap_or_else(|_| panic!("{number} has no room in 32 bits"))
}
