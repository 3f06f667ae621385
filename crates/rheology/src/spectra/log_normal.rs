//! Log-normal spectrum.

use std::f64::consts::{LN_10, PI};

use super::{InvalidSpectrum, Spectrum, approach, positive};

/// A bell of retardation times on a logarithmic axis, as in felts of many similar fibres:
/// `L(λ) = e^(−z²/2) / (σ √(2π))` with `z = ln(λ/λ_m) / σ` and `σ = width · ln 10`.
///
/// | symbol | parameter    | unit    | range      |
/// |--------|--------------|---------|------------|
/// | `J`    | `compliance` | m/N     | > 0        |
/// | `λ_m`  | `time`       | s       | > 0        |
/// |        | `width`      | decades | > 0, ≤ 100 |
///
/// `time` is the median, `width` the standard deviation of `log10 λ`. As the width goes to zero,
/// the spectrum becomes a single Kelvin–Voigt element.
///
/// The integral is taken by the trapezoidal rule in `ln λ`. In a strip `|Im ln λ| ≤ d < π/2`, the
/// integrand is analytic and `e^(d²/2σ²)` times greater than on the axis, so that a step `h` has the
/// relative error `e^(−2πd/h + d²/2σ²)`. That is 1e-14 at most with the step of 0.27, and 0.45 σ for
/// the narrow.
#[derive(Debug, Clone, PartialEq)]
pub struct LogNormal {
    compliance: f64,
    median: f64,
    deviation: f64,
}

impl LogNormal {
    /// A spectrum of the total compliance `compliance` \[m/N\] around the median `time` \[s\], with
    /// the standard deviation `width` \[decades\].
    ///
    /// # Errors
    ///
    /// Parameters that are not positive and finite, a width above 100 decades.
    pub fn new(compliance: f64, time: f64, width: f64) -> Result<Self, InvalidSpectrum> {
        positive("compliance", compliance)?;
        positive("time", time)?;
        if !(width > 0.0 && width <= 100.0) {
            return Err(InvalidSpectrum {
                parameter: "width",
                range: "above 0 and at most 100 decades",
                value: width,
            });
        }
        Ok(Self { compliance, median: time.ln(), deviation: width * LN_10 })
    }

    /// Density `L(λ)` over `ln λ` at the retardation time `time` > 0 \[s\], of unit area.
    pub fn density(&self, time: f64) -> f64 {
        let z = (time.ln() - self.median) / self.deviation;
        (-0.5 * z * z).exp() / (self.deviation * (2.0 * PI).sqrt())
    }
}

impl Spectrum for LogNormal {
    fn compliance(&self) -> f64 {
        self.compliance
    }

    fn creep(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 0.0;
        }
        let instant = time.ln() - self.median;
        let step = (0.27 / self.deviation).min(0.45);
        let term = |place: f64| {
            let z = place * step;
            (-0.5 * z * z).exp() * approach((instant - z * self.deviation).exp())
        };
        // The terms have one peak. It is near this place; from there they are summed to both sides
        // until they no longer count.
        let peak = ((instant / self.deviation).clamp(-self.deviation, 0.0) / step).round();
        let mut sum = term(peak);
        for direction in [1.0, -1.0] {
            let mut place = peak + direction;
            let mut next = term(place);
            while next > 1e-18 * sum {
                sum += next;
                place += direction;
                next = term(place);
            }
        }
        self.compliance * sum * step / (2.0 * PI).sqrt()
    }
}
