//! What an impact of the thesis' form is made of, in SI units.

use std::fmt;

use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    part,
};
use dashpot_rheology::{Branch, Tree};

/// What the groups refer to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactScales {
    /// Mass of the impactor m₁ \[kg\], > 0.
    pub mass: f64,
    /// Its speed V₀ \[m/s\], > 0.
    pub speed: f64,
    /// Thickness of the padding δ \[m\], > 0.
    pub thickness: f64,
}

impl ImpactScales {
    /// m₁ = V₀ = δ = 1: deformation, force and time are ξ, φ and τ*.
    pub const UNIT: Self = Self { mass: 1.0, speed: 1.0, thickness: 1.0 };
    /// Those of chapter IV.
    pub const CHAPTER_4: Self = Self { mass: 10.0, speed: 10.0, thickness: 0.02 };

    /// `J = δ/V₀` \[s\].
    pub fn time(&self) -> f64 {
        self.thickness / self.speed
    }

    /// `m₁ V₀²/δ` \[N\].
    pub fn force(&self) -> f64 {
        self.mass * self.speed * self.speed / self.thickness
    }
}

/// The spring and dashpot parameters of a four-parameter padding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourParameterPadding {
    /// Spring of the Kelvin–Voigt element K₁ \[N/m\].
    pub k1: f64,
    /// Dashpot of the Kelvin–Voigt element C₁ \[N s/m\].
    pub c1: f64,
    /// Spring in a row K₂ \[N/m\].
    pub k2: f64,
    /// Dashpot in a row C₂ \[N s/m\].
    pub c2: f64,
}

impl FourParameterPadding {
    /// That of chapter IV, Valox 310.
    pub const CHAPTER_4: Self = Self { k1: 20e6, c1: 4e3, k2: 20e6, c2: 6e3 };

    /// K₂ and C₂ in a row with K₁ ∥ C₁, K₂ on the impactor's side.
    pub fn model(&self) -> Model {
        Tree::Series(vec![
            Branch::new("spring", part(Spring { stiffness: self.k2 })),
            Branch::new("dashpot", part(Dashpot { damping: self.c2 })),
            Branch::new("parallel", kelvin_voigt(self.k1, self.c1)),
        ])
    }
}

/// The support: a mass that a spring and a dashpot side by side hold to the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FourParameterSupport {
    /// m₃ \[kg\].
    pub mass: f64,
    /// K₃ \[N/m\], ≥ 0.
    pub stiffness: f64,
    /// C₃ \[N s/m\], ≥ 0.
    pub damping: f64,
}

impl FourParameterSupport {
    /// That of chapter IV with C₃ = 10 kN s/m, for which α is the 0.2 that is printed.
    pub const CHAPTER_4: Self = Self { mass: 100.0, stiffness: 50e6, damping: 10e3 };
    /// With the C₃ that chapter IV prints, for which α is 200.
    pub const CHAPTER_4_STIFF: Self = Self { damping: 10e6, ..Self::CHAPTER_4 };

    /// K₃ ∥ C₃.
    pub fn mount(&self) -> Model {
        kelvin_voigt(self.stiffness, self.damping)
    }
}

fn kelvin_voigt(stiffness: f64, damping: f64) -> Model {
    Tree::Parallel(vec![
        Branch::new("spring", part(Spring { stiffness })),
        Branch::new("dashpot", part(Dashpot { damping })),
    ])
}

/// The open ranges of `a`, `b`, `c` and `d`, each with the others as they are, in which there is a
/// padding; `None` where there is one for no value. That of `a` has no upper end.
///
/// Shown as `a > 16.667; 0 < b < 166.67; no c; no d`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ranges(pub [Option<(f64, f64)>; 4]);

impl fmt::Display for Ranges {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, range) in ["a", "; b", "; c", "; d"].into_iter().zip(self.0) {
            let (stop, letter) = name.split_at(name.len() - 1);
            match range {
                Some((from, f64::INFINITY)) => write!(f, "{stop}{letter} > {}", five(from))?,
                Some((from, to)) => write!(f, "{stop}{} < {letter} < {}", five(from), five(to))?,
                None => write!(f, "{stop}no {letter}")?,
            }
        }
        Ok(())
    }
}

/// A number with five digits.
fn five(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}
