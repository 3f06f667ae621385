//! Chapter III: how far a padding is pressed by a force that is prescribed.
//!
//! The thesis takes the force as the pulse `φ = P τ e^(−mτ)` (3.1; it calls P a second A) and finds the
//! deformation from `c ξ″ + d ξ′ = φ″ + a φ′ + b φ`, `ξ(0) = 0`, `ξ′(0) = 1`. With `ν = d/c`,
//! `ρ = (P/c)(m² − a m + b)` and `σ = (P/c)(a − 2m)` that is `ξ″ + ν ξ′ = (ρ τ + σ) e^(−mτ)`.
//!
//! What is solved here are integrals of the right side, which hold for `m = ν` too, where the
//! constants of 3.16 to 3.29 have no value. These are at hand as [`Constants`].
//!
//! A pulse that is prescribed need not be one of any impact: see [`Pulse::checks`].

use dashpot_numerics::{quadrature::GaussLegendre, roots::monotone_root};

use crate::{Groups, lambert::intersections};

/// A pulse on a padding, both without dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// The padding's groups; `c` and `d` are > 0.
    pub padding: Groups,
    /// Start slope P of the pulse, > 0.
    pub slope: f64,
    /// Rate m at which it decays, > 0; its peak is P/(m e), at 1/m.
    pub decay: f64,
}

/// The constants of 3.16 to 3.33.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// ν = d/c (3.7).
    pub nu: f64,
    /// R₁ (3.16).
    pub r1: f64,
    /// R₂ (3.17).
    pub r2: f64,
    /// L₁, where the deformation ends (3.27).
    pub l1: f64,
    /// L₂ (3.26).
    pub l2: f64,
    /// L₃ = −m R₁/(ν L₂) (3.32).
    pub l3: f64,
    /// L₄ = (R₁ − m R₂)/(ν L₂) (3.33).
    pub l4: f64,
    /// θ = L₃/(m − ν), the slope of the straight line in 3.39.
    pub theta: f64,
    /// ψ = L₄, its intercept.
    pub psi: f64,
}

/// What a pulse of an impact has to do, and this one may not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checks {
    /// Impulse `∫φ = P/m²`; 1 stops the impactor, 2 sends it back as fast as it came.
    pub impulse: f64,
    /// Start slope P over `e = c`, that of an impactor which comes with the speed 1.
    pub start_slope: f64,
    /// Energy `∫φ dξ` that the padding takes up in the end.
    pub energy: f64,
    /// Whether that is no more than the impactor brings, ½.
    pub is_affordable: bool,
}

/// A parameter of the constraint 3.55.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// The group b.
    B,
    /// The group c.
    C,
    /// The group d.
    D,
    /// The start slope of the pulse.
    Slope,
    /// Its decay.
    Decay,
}

/// Points of the rule of Gauss and Legendre on each panel of an integral.
const POINTS: usize = 8;
/// Panels of an integral per unit of the fastest rate.
const PANELS: f64 = 4.0;
/// Times of the slowest decay after which nothing is left in doubles.
const LAST: f64 = 40.0;

impl Pulse {
    /// The pulse that chapter III takes from the analogue computer, P = 9.9 and m = 3.1, on the padding of chapter IV.
    pub const PRINTED: Self = Self { padding: Groups::PRINTED, slope: 9.9, decay: 3.1 };

    /// Force φ at τ ≥ 0.
    pub fn force(&self, time: f64) -> f64 {
        self.slope * time * (-self.decay * time).exp()
    }

    fn nu(&self) -> f64 {
        self.padding.d / self.padding.c
    }

    fn rho_sigma(&self) -> (f64, f64) {
        let Groups { a, b, c, .. } = self.padding;
        let (p, m) = (self.slope, self.decay);
        (p / c * (m * m - a * m + b), p / c * (a - 2.0 * m))
    }

    /// Deformation ξ at τ ≥ 0 (3.20).
    pub fn deformation(&self, time: f64) -> f64 {
        let (nu, m) = (self.nu(), self.decay);
        let (rho, sigma) = self.rho_sigma();
        let to_the_end = sigma * time * first(-m * time) + rho * time * time * second(-m * time);
        (-(-nu * time).exp_m1() + to_the_end - self.driven(time)) / nu
    }

    /// Rate ξ′ at τ ≥ 0 (3.24 with its sign mended).
    pub fn rate(&self, time: f64) -> f64 {
        (-self.nu() * time).exp() + self.driven(time)
    }

    /// `e^(−ντ) ∫₀^τ (ρ s + σ) e^((ν−m)s) ds`.
    fn driven(&self, time: f64) -> f64 {
        let (nu, m) = (self.nu(), self.decay);
        let (rho, sigma) = self.rho_sigma();
        let x = (nu - m) * time;
        if x <= 0.0 {
            let inner = sigma * time * first(x) + rho * time * time * second(x);
            return (-nu * time).exp() * inner;
        }
        // The same with the larger exponential taken out, which does not overflow.
        let inner = sigma * time * first(-x) + rho * time * time * (first(-x) - second(-x));
        (-m * time).exp() * inner
    }

    /// Energy ω = ∫φ dξ that has gone into the padding until τ ≥ 0 (3.57).
    pub fn energy(&self, time: f64) -> f64 {
        let fastest = self.nu() + 2.0 * self.decay;
        let time = time.min(LAST / self.decay);
        let panels = (PANELS * fastest * time).ceil().max(1.0);
        let half = 0.5 * time / panels;
        let power = |at: f64| self.force(at) * self.rate(at);
        let rule = GaussLegendre::with_points(POINTS);
        let mut sum = 0.0;
        let mut middle = half;
        while middle < time {
            sum += rule.integrate(middle - half, middle + half, power);
            middle += 2.0 * half;
        }
        sum
    }

    /// The times τ > 0 at which ξ′ is zero: none, one or two, in order.
    ///
    /// `ξ′ e^(ντ)` begins at 1 and turns once at most, at −σ/ρ, so each of its two ways has one root or none.
    pub fn turning_times(&self) -> Vec<f64> {
        let (rho, sigma) = self.rho_sigma();
        let end = LAST / self.nu().min(self.decay);
        let turn = -sigma / rho;
        let mut bounds = vec![0.0];
        bounds.extend(Some(turn).filter(|turn| *turn > 0.0 && *turn < end));
        bounds.push(end);
        // The faster exponential is taken out, so that signs survive where both have decayed.
        let sign = |time: f64| self.rate(time) * (self.nu().min(self.decay) * time).exp();
        bounds.windows(2).filter_map(|way| monotone_root(sign, way[0], way[1])).collect()
    }

    /// Time and size of the largest deformation; the time is infinite where ξ only approaches it.
    pub fn deepest(&self) -> (f64, f64) {
        let end = (f64::INFINITY, self.final_deformation());
        let all = self.turning_times().into_iter().map(|time| (time, self.deformation(time)));
        all.fold(end, |most, own| if own.1 > most.1 { own } else { most })
    }

    /// Where the deformation ends, `L₁ = (c − P + b P/m²)/d`, without a.
    pub fn final_deformation(&self) -> f64 {
        let Groups { b, c, d, .. } = self.padding;
        (c - self.slope + b * self.slope / (self.decay * self.decay)) / d
    }

    /// The constants of the thesis; `None` where m = ν, for which they have no value.
    pub fn constants(&self) -> Option<Constants> {
        let (nu, m) = (self.nu(), self.decay);
        let (rho, sigma) = self.rho_sigma();
        let product = m * (m - nu);
        let r1 = rho / product;
        let r2 = sigma / product + r1 * (2.0 * m - nu) / product;
        let l2 = (r1 - m * r2 - 1.0) / nu;
        let l1 = -r2 - l2;
        let (l3, l4) = (-m * r1 / (nu * l2), (r1 - m * r2) / (nu * l2));
        let theta = l3 / (m - nu);
        let all = [r1, r2, l1, l2, l3, l4, theta];
        let is_known = all.iter().all(|own| own.is_finite());
        is_known.then_some(Constants { nu, r1, r2, l1, l2, l3, l4, theta, psi: l4 })
    }

    /// The term of 3.54 that is left out, at ν τ* = 20 and this τ*; NaN where `m = ν`.
    pub fn left_out(&self, time: f64) -> f64 {
        self.constants().map_or(f64::NAN, |own| {
            let ratio = (own.r1 * time + own.r2) / (own.l3 * time + own.l4);
            (-20.0_f64).exp() * (own.l2 + ratio)
        })
    }

    /// The energy by 3.59, closed; `None` where m = ν.
    pub fn closed_energy(&self, time: f64) -> Option<f64> {
        let Constants { nu, r1, r2, l2, .. } = self.constants()?;
        let (p, m) = (self.slope, self.decay);
        let time = time.min(LAST / m);
        let once = |rate: f64| (1.0 - (-rate * time).exp() * (1.0 + rate * time)) / (rate * rate);
        let s = m * time;
        let twice = (1.0 - (-2.0 * s).exp() * (2.0 * s * s + 2.0 * s + 1.0)) / (4.0 * m * m * m);
        Some(-p * nu * l2 * once(nu + m) - p * m * r1 * twice + p * (r1 - m * r2) * once(2.0 * m))
    }

    /// The times τ > 0 at which ξ′ is zero by 3.39 and Lambert's W, in order; `None` where m = ν.
    ///
    /// With `z = (m − ν) τ` they are where e^z meets the straight line θ z + ψ. Where m < ν, as with
    /// the thesis' own numbers, times are negative values of z, to the left of its figure 4.
    pub fn turning_times_by_lambert(&self) -> Option<Vec<f64>> {
        let Constants { nu, theta, psi, .. } = self.constants()?;
        let roots = intersections(theta, psi).into_iter();
        let mut times: Vec<f64> =
            roots.map(|z| z / (self.decay - nu)).filter(|time| *time > 0.0).collect();
        times.sort_by(f64::total_cmp);
        Some(times)
    }

    /// The thesis' approximation 3.49 of the time of the largest deformation: the smaller one of its
    /// two values that is not negative. It puts `2x/(2L₄ + x)` for `ln(1 + x/L₄)`, `x = L₃ τ`, so it
    /// is good where |L₃ τ| is small beside L₄, and needs `L₄ > 0`.
    pub fn approximate_turning_time(&self) -> Option<f64> {
        let Constants { nu, l3, l4, .. } = self.constants()?;
        if l4 <= 0.0 {
            return None;
        }
        let (rate, log) = (self.decay - nu, l4.ln());
        let lambda = (2.0 + log) / (2.0 * rate) - l4 / l3;
        let root = (lambda * lambda + 2.0 * l4 * log / (rate * l3)).sqrt();
        let both = [lambda - root, lambda + root].into_iter();
        both.filter(|time| *time >= 0.0).reduce(f64::min)
    }

    /// What an impact asks of its pulse.
    pub fn checks(&self) -> Checks {
        let energy = self.energy(f64::INFINITY);
        Checks {
            impulse: self.slope / (self.decay * self.decay),
            start_slope: self.slope / self.padding.c,
            energy,
            is_affordable: energy <= 0.5,
        }
    }

    /// The value of a parameter, others as they are, with which the deformation ends at 1 (3.55):
    /// `c − P + b P/m² = d`. `None` where no positive one does. The group a has no influence.
    pub fn limit(&self, parameter: Parameter) -> Option<f64> {
        let Groups { b, c, d, .. } = self.padding;
        let (p, m) = (self.slope, self.decay);
        let value = match parameter {
            Parameter::B => m * m * (d + p - c) / p,
            Parameter::C => d + p - b * p / (m * m),
            Parameter::D => c - p + b * p / (m * m),
            Parameter::Slope => (d - c) / (b / (m * m) - 1.0),
            Parameter::Decay => (b * p / (d + p - c)).sqrt(),
        };
        Some(value).filter(|value| *value > 0.0 && value.is_finite())
    }
}

/// `∫₀¹ e^(xu) du`.
fn first(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { x.exp_m1() / x }
}

/// `∫₀¹ u e^(xu) du`.
fn second(x: f64) -> f64 {
    if x.abs() > 0.5 {
        return (x.exp() - first(x)) / x;
    }
    // Σ x^k/(k! (k + 2)); the terms that are left out are below 1e-17.
    let mut term = 1.0;
    let mut sum = 0.5;
    for k in 1..16 {
        term *= x / f64::from(k);
        sum += term / f64::from(k + 2);
    }
    sum
}

#[cfg(test)]
mod tests;
