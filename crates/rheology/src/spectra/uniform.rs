//! Box spectrum.

use super::{InvalidSpectrum, PowerLaw, Spectrum};

/// All retardation times between two alike on a logarithmic axis:
/// `L = 1 / ln(λ_max/λ_min)`, a box. The creep then grows as the logarithm of time between the two.
///
/// | symbol  | parameter    | unit | range        |
/// |---------|--------------|------|--------------|
/// | `J`     | `compliance` | m/N  | > 0          |
/// | `λ_min` | `shortest`   | s    | > 0          |
/// | `λ_max` | `longest`    | s    | > `shortest` |
///
/// `R(t) = J (1 − (E1(t/λ_max) − E1(t/λ_min)) / ln(λ_max/λ_min))` with the exponential integral
/// `E1`. As the two times meet, the spectrum becomes a single Kelvin–Voigt element.
#[derive(Debug, Clone, PartialEq)]
pub struct Uniform {
    law: PowerLaw,
}

impl Uniform {
    /// A box of the total compliance `compliance` \[m/N\] from the retardation time `shortest` to
    /// `longest` \[s\].
    ///
    /// # Errors
    ///
    /// Compliance or times that are not positive and finite, `longest` not above `shortest`.
    pub fn new(compliance: f64, shortest: f64, longest: f64) -> Result<Self, InvalidSpectrum> {
        PowerLaw::new(compliance, 0.0, shortest, longest).map(|law| Self { law })
    }

    /// Density `L(λ)` over `ln λ` at the retardation time `time` > 0 \[s\], of unit area.
    pub fn density(&self, time: f64) -> f64 {
        self.law.density(time)
    }
}

impl Spectrum for Uniform {
    fn compliance(&self) -> f64 {
        self.law.compliance()
    }

    // The closed form loses digits at short times, where R is small against 1; the quadrature does
    // not.
    fn creep(&self, time: f64) -> f64 {
        self.law.creep(time)
    }
}
