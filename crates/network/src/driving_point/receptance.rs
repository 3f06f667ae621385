//! The receptance of a network.

use dashpot_numerics::DoubleDouble;
use dashpot_rheology::LinearModel;

use super::{Hidden, Massless, complex::Complex, terms::Term};

/// The receptance `H(s) = J + Σ N(s − p)/D(s − p)` of a network at two nodes: a constant and a term for each pole, or
/// for each group of poles that stand so close that single residues would be large and opposite.
///
/// Kept with twice the digits of a double.
#[derive(Debug, Clone)]
pub struct Receptance {
    pub(super) compliance: DoubleDouble,
    /// In rising order of `|p|`.
    pub(super) terms: Vec<Term>,
    pub(super) hidden: Vec<Hidden>,
    pub(super) error: f64,
}

/// One term of a [`Receptance`], in SI units of m/N.
#[derive(Debug, Clone, PartialEq)]
pub struct Pole {
    /// The pole `p`, the mean of a group \[1/s\]; real and imaginary part.
    pub at: [f64; 2],
    /// How many poles it stands for, as seen from outside: the degree of `D`.
    pub order: usize,
    /// Coefficients of `D` besides the first, which is 1; the constant comes first. All zero where the poles coincide.
    pub spread: Vec<[f64; 2]>,
    /// Coefficients of `N`, the constant first: for a simple pole its residue, for poles that
    /// coincide the Laurent coefficients, the one of `1/(s − p)^order` first.
    pub residues: Vec<[f64; 2]>,
}

impl Receptance {
    /// The compliance `J` at infinite rate \[m/N\], ≥ 0.
    pub fn instantaneous_compliance(&self) -> f64 {
        self.compliance.high()
    }

    /// The terms in rising order of `|p|`; complex ones come in conjugate pairs.
    pub fn poles(&self) -> Vec<Pole> {
        let rounded = |values: &[Complex]| values.iter().map(|value| value.rounded()).collect();
        let pole = |term: &Term| Pole {
            at: term.at.rounded(),
            order: term.residues.len(),
            spread: rounded(&term.spread),
            residues: rounded(&term.residues),
        };
        self.terms.iter().map(pole).collect()
    }

    /// Poles of the network that do not show.
    pub fn hidden(&self) -> &[Hidden] {
        &self.hidden
    }

    /// Relative error of every pole and strength: the largest difference of two computations, and
    /// what the condition of the poles makes of the rounding.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The receptance at the complex rate `re + i im` \[1/s\], real and imaginary part \[m/N\].
    pub fn at(&self, [re, im]: [f64; 2]) -> [f64; 2] {
        self.value(Complex::new(re, im)).rounded()
    }

    /// The dynamic stiffness `F/y = 1/H` there \[N/m\].
    pub fn stiffness(&self, [re, im]: [f64; 2]) -> [f64; 2] {
        Complex::one().over(self.value(Complex::new(re, im))).rounded()
    }

    /// The same of a circuit without masses, whose terms are those of a Kelvin form.
    pub(super) fn massless(self) -> Massless {
        let real = |term: &Term| (-term.at.re, term.residues[0].re);
        let (creep, modes): (Vec<_>, Vec<_>) =
            self.terms.iter().map(real).partition(|mode| mode.0.high() == 0.0);
        let fluidity = creep.first().map_or(DoubleDouble::ZERO, |creep| creep.1);
        let model = LinearModel::from_kelvin(self.compliance, fluidity, modes);
        Massless { model, hidden: self.hidden, error: self.error }
    }

    pub(super) fn value(&self, s: Complex) -> Complex {
        let start = Complex::new(self.compliance, 0.0);
        self.terms.iter().fold(start, |sum, term| sum + term.value(s))
    }
}
