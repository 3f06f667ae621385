//! The spectra: power law, log-normal, list, and sums of others.

use std::f64::consts::{LN_10, PI};

use dashpot_numerics::quadrature::GaussLegendre;

use super::{InvalidSpectrum, Retardation, Spectrum, approach, positive, whole};

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
    /// A spectrum of the total compliance `compliance` \[m/N\] from the retardation time `shortest` to `longest` \[s\].
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
        // The places are measured from the end where the density is greatest, so that nothing overflows.
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
    /// The closed form loses digits at short times, where `R` is small against 1; the quadrature does not.
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
/// The integral is taken by the trapezoidal rule in `ln λ`. In a strip `|Im ln λ| ≤ d < π/2`, the integrand is analytic
/// and `e^(d²/2σ²)` times greater than on the axis, so that a step `h` has the relative error `e^(−2πd/h + d²/2σ²)`.
/// That is 1e-14 at most with the step of 0.27, and 0.45 σ for the narrow.
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

/// A spectrum of lines: `R(t) = Σ J_i (1 − e^(−t/λ_i))`.
///
/// A long list, measured or computed, can be reduced like any other spectrum.
#[derive(Debug, Clone, PartialEq)]
pub struct List {
    branches: Vec<Retardation>,
    compliance: f64,
}

impl List {
    /// A list of one or more elements. They are sorted by time, and those of the same time become one.
    ///
    /// # Errors
    ///
    /// A list that is empty, and times or compliances that are not positive and finite.
    pub fn new(mut branches: Vec<Retardation>) -> Result<Self, InvalidSpectrum> {
        for branch in &branches {
            positive("time", branch.time)?;
            positive("compliance", branch.compliance)?;
        }
        branches.sort_by(|a, b| a.time.total_cmp(&b.time));
        branches.dedup_by(|later, kept| {
            let same = later.time.total_cmp(&kept.time).is_eq();
            if same {
                kept.compliance += later.compliance;
            }
            same
        });
        let compliance = branches.iter().map(|branch| branch.compliance).sum();
        positive("compliance", compliance)?;
        Ok(Self { branches, compliance })
    }
}

impl Spectrum for List {
    fn compliance(&self) -> f64 {
        self.compliance
    }

    fn creep(&self, time: f64) -> f64 {
        self.branches.iter().map(|branch| branch.compliance * approach(time / branch.time)).sum()
    }

    fn branches(&self) -> Option<&[Retardation]> {
        Some(&self.branches)
    }
}

/// A sum `Σ e^(s_i) (1 − e^(−t/λ_i))`, dimensionless, known by `ln λ_i` and `s_i`. Whatever values
/// these take, strengths and times are positive.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sum {
    /// `ln λ_i` and `s_i`, by rising time.
    pub(super) terms: Vec<(f64, f64)>,
}

impl Sum {
    /// Value at `ln t = place`.
    pub(super) fn share(&self, place: f64) -> f64 {
        self.terms
            .iter()
            .map(|(time, strength)| strength.exp() * approach((place - time).exp()))
            .sum()
    }

    /// `sum/share − 1` at `ln t = place`, and its derivatives by all `ln λ_i`, then all `s_i`.
    pub(super) fn deviation(&self, place: f64, share: f64, slopes: &mut [f64]) -> f64 {
        let (by_times, by_strengths) = slopes.split_at_mut(self.terms.len());
        let mut value = 0.0;
        let each = self.terms.iter().zip(by_times).zip(by_strengths);
        for (((time, strength), by_time), by_strength) in each {
            // Beyond this ratio the exponential is zero, and ratio times it not a number.
            let ratio = (place - time).exp().min(1e3);
            let strength = strength.exp();
            let part = strength * approach(ratio);
            value += part;
            *by_time = -strength * ratio * (-ratio).exp() / share;
            *by_strength = part / share;
        }
        (value - share) / share
    }

    /// The sum with `change` added to its parameters, in the order of the derivatives.
    pub(super) fn moved(&self, change: &[f64]) -> Self {
        let (by_times, by_strengths) = change.split_at(self.terms.len());
        let mut terms: Vec<(f64, f64)> = self
            .terms
            .iter()
            .zip(by_times.iter().zip(by_strengths))
            .map(|((time, strength), (longer, stronger))| (time + longer, strength + stronger))
            .collect();
        terms.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { terms }
    }
}
