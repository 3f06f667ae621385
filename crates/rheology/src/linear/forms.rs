//! The two canonical forms of a linear model.

use dashpot_numerics::DoubleDouble;

use super::{Fractions, LinearModel, Primitive};
use crate::{Branch, Tree};

/// A canonical form.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Canonical {
    /// Generalised Maxwell: a spring, a dashpot and Maxwell elements in parallel (a Prony series).
    Maxwell,
    /// Generalised Kelvin–Voigt: a spring, a dashpot and Kelvin–Voigt elements in series.
    Kelvin,
}

/// One Maxwell element of a [`MaxwellForm`]: a line of the relaxation spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaxwellElement {
    /// Stiffness `K` of its spring \[N/m\], > 0.
    pub stiffness: f64,
    /// Damping `C = K/r` of its dashpot \[N s/m\], > 0.
    pub damping: f64,
    /// Relaxation time `τ = C/K` \[s\], > 0.
    pub relaxation_time: f64,
    /// Rate `r = 1/τ` \[1/s\] with all its digits.
    pub rate: DoubleDouble,
}

/// One Kelvin–Voigt element of a [`KelvinForm`]: a line of the retardation spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KelvinElement {
    /// Compliance `J = 1/K` \[m/N\], > 0.
    pub compliance: f64,
    /// Stiffness `K` of its spring \[N/m\], > 0.
    pub stiffness: f64,
    /// Damping `C` of its dashpot \[N s/m\], > 0.
    pub damping: f64,
    /// Retardation time `λ = C/K` \[s\], > 0.
    pub retardation_time: f64,
    /// Rate `z = 1/λ` \[1/s\] with all its digits.
    pub rate: DoubleDouble,
}

/// `Q(s) = K_e + C s + Σ K_j s/(s + r_j)`: a spring, a dashpot and Maxwell elements in parallel.
#[derive(Debug, Clone, PartialEq)]
pub struct MaxwellForm(pub(crate) Fractions);

/// `1/Q(s) = J_g + φ₀/s + Σ φ_i/(s + z_i)`: a spring, a dashpot and Kelvin–Voigt elements in series.
#[derive(Debug, Clone, PartialEq)]
pub struct KelvinForm(pub(crate) Fractions);

impl MaxwellForm {
    /// Stiffness `K_e` of the single spring \[N/m\]; 0 where there is none.
    pub fn spring(&self) -> f64 {
        self.0.at_zero.high()
    }

    /// Damping `C` of the single dashpot \[N s/m\]; 0 where there is none.
    pub fn dashpot(&self) -> f64 {
        self.0.constant.high()
    }

    /// The Maxwell elements in rising order of the relaxation time.
    pub fn elements(&self) -> Vec<MaxwellElement> {
        let element = |line: &super::Line| MaxwellElement {
            stiffness: line.strength.high(),
            damping: (line.strength / line.rate).high(),
            relaxation_time: line.rate.recip().high(),
            rate: line.rate,
        };
        self.0.lines.iter().rev().map(element).collect()
    }
}

impl KelvinForm {
    /// Compliance `J_g` of the single spring \[m/N\]; 0 where there is none.
    pub fn spring_compliance(&self) -> f64 {
        self.0.constant.high()
    }

    /// Fluidity `φ₀` of the single dashpot, one over its damping \[m/(N s)\]; 0 where there is none.
    pub fn fluidity(&self) -> f64 {
        self.0.at_zero.high()
    }

    /// The Kelvin–Voigt elements in rising order of the retardation time.
    pub fn elements(&self) -> Vec<KelvinElement> {
        let element = |line: &super::Line| KelvinElement {
            compliance: (line.strength / line.rate).high(),
            stiffness: (line.rate / line.strength).high(),
            damping: line.strength.recip().high(),
            retardation_time: line.rate.recip().high(),
            rate: line.rate,
        };
        self.0.lines.iter().rev().map(element).collect()
    }
}

impl LinearModel {
    /// The canonical network of the given form, its single spring and dashpot first, then its
    /// elements in rising order of their times, each value rounded once. Branches are named
    /// `spring`, `dashpot`, `maxwell` or `kelvin`, numbered from 1 where there are several.
    ///
    /// A rigid link in the Kelvin form is a rigid link, and what bears no force is a spring of
    /// stiffness 0 in the Maxwell form. `None` where the form does not exist: a rigid link has no Maxwell form, and what bears no
    /// force has no Kelvin form.
    pub fn tree(&self, form: Canonical) -> Option<Tree<Primitive>> {
        let numbered = |word: &str, at: usize, count: usize| {
            if count == 1 { word.to_owned() } else { format!("{word}-{}", at + 1) }
        };
        let pair = |stiffness, damping| {
            [("spring", Primitive::Spring(stiffness)), ("dashpot", Primitive::Dashpot(damping))]
                .map(|(name, part)| Branch::new(name, part.into()))
                .to_vec()
        };
        let (word, singles, pairs, in_series) = match form {
            Canonical::Maxwell => {
                let form = self.maxwell()?;
                let pairs = form
                    .elements()
                    .iter()
                    .map(|element| (element.stiffness, element.damping))
                    .collect();
                ("maxwell", [form.spring(), form.dashpot()], pairs, false)
            }
            Canonical::Kelvin => {
                let form = self.kelvin()?;
                let pairs: Vec<_> = form
                    .elements()
                    .iter()
                    .map(|element| (element.stiffness, element.damping))
                    .collect();
                let inverse = |value: DoubleDouble| {
                    if value.high() > 0.0 { value.recip().high() } else { 0.0 }
                };
                ("kelvin", [inverse(form.0.constant), inverse(form.0.at_zero)], pairs, true)
            }
        };
        let mut branches = pair(singles[0], singles[1]);
        let mut single = singles.iter();
        branches.retain(|_| single.next().is_some_and(|&own| own > 0.0));
        let count = pairs.len();
        branches.extend(pairs.into_iter().enumerate().map(|(at, (stiffness, damping))| {
            let parts = pair(stiffness, damping);
            let tree = if in_series { Tree::Parallel(parts) } else { Tree::Series(parts) };
            Branch::new(numbered(word, at, count), tree)
        }));
        Some(match branches.len() {
            0 if in_series => Primitive::Rigid.into(),
            0 => Primitive::Spring(0.0).into(),
            1 => branches.remove(0).tree,
            _ if in_series => Tree::Series(branches),
            _ => Tree::Parallel(branches),
        })
    }
}
