//! Power-law spectrum.

use dashpot_numerics::quadrature::GaussLegendre;

use super::{InvalidSpectrum, Spectrum, approach, positive, whole};

/// Nodes of the Gauss–Legendre rule in each panel.
const NODES: usize = 12;

/// A power law between two retardation times, `L(λ) ∝ λ^exponent`, as in soft glasses and
/// biological fibres; the exponent 0 is a box.
///
/// | symbol  | parameter    | unit | range        |
/// |---------|--------------|------|--------------|
/// | `J`     | `compliance` | m/N  | > 0          |
/// |         | `exponent`   | 1    | finite       |
/// | `λ_min` | `shortest`   | s    | > 0          |
/// | `λ_max` | `longest`    | s    | > `shortest` |
///
/// With an exponent of 0 < m < 1, the creep grows as `t^m` well inside of the two times.
///
/// The integral is taken in panels of `ln λ` by a Gauss–Legendre rule. In each, the integrand is
/// analytic in an ellipse on which it is bounded by its values on the real axis, so that the relative
/// error is of the order of 1e-14 at any time.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    compliance: f64,
    exponent: f64,
    shortest: f64,
    longest: f64,
    /// Retardation time \[s\] and share of the compliance, of each node.
    nodes: Vec<(f64, f64)>,
    /// The density where it is greatest.
    peak: f64,
}

impl PowerLaw {
    /// A spectrum of the total compliance `compliance` \[m/N\] from the retardation time `shortest`
    /// to `longest` \[s\].
    ///
    /// # Errors
    ///
    /// Compliance or times that are not positive and finite, `longest` not above `shortest`, an
    /// exponent that is not finite.
    pub fn new(
        compliance: f64,
        exponent: f64,
        shortest: f64,
        longest: f64,
    ) -> Result<Self, InvalidSpectrum> {
        positive("compliance", compliance)?;
        positive("shortest", shortest)?;
        positive("longest", longest)?;
        if !exponent.is_finite() {
            return Err(InvalidSpectrum {
                parameter: "exponent",
                range: "finite",
                value: exponent,
            });
        }
        if longest <= shortest {
            return Err(InvalidSpectrum {
                parameter: "longest",
                range: "longer than `shortest`",
                value: longest,
            });
        }
        // The places are measured from the end where the density is greatest, so that nothing
        // overflows.
        let ratio = (longest - shortest) / shortest;
        let span = if ratio.is_finite() { ratio.ln_1p() } else { longest.ln() - shortest.ln() };
        let (anchor, direction) = if exponent > 0.0 { (longest, -1.0) } else { (shortest, 1.0) };
        let decay = exponent.abs();
        // At short times the creep weighs the density by 1/λ, and a steep rise by one power less.
        let fade = if exponent > 0.0 { (exponent - 1.0).max(0.0) } else { decay };
        let counts = span.min(40.0 / fade);
        let width = (0.25 * decay).max(1.0).recip();
        let panels = (counts / width).ceil().max(1.0);
        let half = 0.5 * counts / panels;
        let rule = GaussLegendre::with_points(NODES);
        let mut nodes = Vec::new();
        for panel in 0..whole(panels) {
            for (x, weight) in rule.nodes().iter().zip(rule.weights()) {
                let distance = half * (2.0 * panel as f64 + 1.0 + x);
                let time = anchor * (direction * distance).exp();
                nodes.push((time, half * weight * (-decay * distance).exp()));
            }
        }
        let area: f64 = nodes.iter().map(|(_, share)| share).sum();
        nodes.iter_mut().for_each(|(_, share)| *share /= area);
        Ok(Self { compliance, exponent, shortest, longest, nodes, peak: area.recip() })
    }

    /// A box, all retardation times between the two alike on a logarithmic axis: the exponent 0, with
    /// `L = 1/ln(λ_max/λ_min)`. The creep then grows as the logarithm of time between the two,
    /// `R(t) = J (1 − (E1(t/λ_max) − E1(t/λ_min))/ln(λ_max/λ_min))` with the exponential integral
    /// `E1`. As the two times meet, the spectrum becomes a single Kelvin–Voigt element.
    ///
    /// The closed form loses digits at short times, where `R` is small against 1; the quadrature does
    /// not.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    pub fn uniform(compliance: f64, shortest: f64, longest: f64) -> Result<Self, InvalidSpectrum> {
        Self::new(compliance, 0.0, shortest, longest)
    }

    /// Density `L(λ)` over `ln λ` at the retardation time `time` > 0 \[s\], of unit area.
    pub fn density(&self, time: f64) -> f64 {
        if time < self.shortest || time > self.longest {
            return 0.0;
        }
        let anchor = if self.exponent > 0.0 { self.longest } else { self.shortest };
        self.peak * (self.exponent * (time / anchor).ln()).exp()
    }
}

impl Spectrum for PowerLaw {
    fn compliance(&self) -> f64 {
        self.compliance
    }

    fn creep(&self, time: f64) -> f64 {
        let sum: f64 = self.nodes.iter().map(|(node, share)| share * approach(time / node)).sum();
        self.compliance * sum
    }
}
