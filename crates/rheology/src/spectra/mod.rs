//! Fibres: series of Kelvin–Voigt elements with a spectrum of retardation times, and their
//! reduction to the fewest elements that keep a stated error.
//!
//! A spectrum has a total compliance `J` \[m/N\] and a density `L(λ)` over `ln λ`, of unit area.
//! Its creep function is `R(t) = J ∫ L(λ) (1 − e^(−t/λ)) d ln λ` \[m/N\]. [`reduce`] replaces it by
//! `Σ J_i (1 − e^(−t/λ_i))` and proves how few terms can do.

mod exchange;
mod kinds;
mod reduction;
mod target;
#[cfg(test)]
mod tests;

use std::fmt::Debug;

use thiserror::Error;

pub use kinds::{List, LogNormal, PowerLaw};
pub use reduction::{MOST_BRANCHES, Reduced, ReductionError, SMALLEST_ERROR, reduce};

/// One Kelvin–Voigt element, as seen in creep: `J (1 − e^(−t/λ))`.
///
/// | symbol | field        | unit | range |
/// |--------|--------------|------|-------|
/// | `λ`    | `time`       | s    | > 0   |
/// | `J`    | `compliance` | m/N  | > 0   |
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Retardation {
    /// Retardation time `λ` \[s\].
    pub time: f64,
    /// Compliance `J` \[m/N\].
    pub compliance: f64,
}

impl Retardation {
    /// Spring constant `1/J` \[N/m\].
    pub fn stiffness(&self) -> f64 {
        self.compliance.recip()
    }

    /// Dashpot constant `λ/J` \[N s/m\].
    pub fn damping(&self) -> f64 {
        self.time / self.compliance
    }
}

/// A fibre or felt in creep: any positive distribution of retardation times.
pub trait Spectrum: Debug {
    /// Total compliance `J` \[m/N\], the creep at infinite time.
    fn compliance(&self) -> f64;

    /// Creep `R(t)` \[m/N\] at `time` ≥ 0 \[s\], with a relative error of the order of 1e-14 at any
    /// time, however short.
    fn creep(&self, time: f64) -> f64;

    /// The elements, of a spectrum that is a finite list of them.
    fn branches(&self) -> Option<&[Retardation]> {
        None
    }
}

/// A parameter of a spectrum is out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("`{parameter}` must be {range}, but it is {value}")]
pub struct InvalidSpectrum {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Its range in words.
    pub range: &'static str,
    /// What was given.
    pub value: f64,
}

/// Refuses what is not above zero and finite.
fn positive(parameter: &'static str, value: f64) -> Result<(), InvalidSpectrum> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(InvalidSpectrum { parameter, range: "positive and finite", value })
    }
}

/// `1 − e^(−x)` without loss of digits at small `x`.
fn approach(x: f64) -> f64 {
    -(-x).exp_m1()
}

/// The whole part of a small number, 0 for one below.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast saturates at 0, as it should, and no caller comes near the other end"
)]
fn whole(value: f64) -> usize {
    value as usize
}
