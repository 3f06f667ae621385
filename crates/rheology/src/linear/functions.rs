//! Material functions.

use dashpot_numerics::DoubleDouble;

use super::{Fractions, LinearModel};

impl LinearModel {
    /// Instantaneous (glassy) stiffness `G(0⁺)` \[N/m\]: the force that a small sudden deformation
    /// meets. Infinite where only a dashpot yields, or nothing.
    pub fn instantaneous_stiffness(&self) -> f64 {
        self.kelvin.as_ref().map_or(0.0, |form| form.0.constant.recip_or_infinity())
    }

    /// Equilibrium (rubbery) stiffness `G(∞)` \[N/m\]: 0 for liquids, infinite for a rigid link.
    pub fn equilibrium_stiffness(&self) -> f64 {
        self.maxwell.as_ref().map_or(f64::INFINITY, |form| form.0.at_zero.high())
    }

    /// Long-time viscosity \[N s/m\]: force over rate in steady flow. Infinite for solids.
    pub fn viscosity(&self) -> f64 {
        self.kelvin.as_ref().map_or(0.0, |form| form.0.at_zero.recip_or_infinity())
    }

    /// Relaxation stiffness `G(t) = K_e + Σ K_j e^(−r_j t)` \[N/m\] at the time `t ≥ 0` \[s\] after a
    /// sudden deformation, the force over it. The impulse of a dashpot that stands beside all else
    /// is not part of it. Infinite for a rigid link.
    pub fn relaxation(&self, t: f64) -> f64 {
        let Some(form) = &self.maxwell else { return f64::INFINITY };
        let terms = form.0.lines.iter().map(|line| line.strength.high() * decay(line.rate, t));
        form.0.at_zero.high() + terms.sum::<f64>()
    }

    /// Creep compliance `J(t) = J_g + φ₀ t + Σ (φ_i/z_i)(1 − e^(−z_i t))` \[m/N\] at the time `t ≥ 0`
    /// \[s\] after a force was put on, the deformation over it. Infinite for what bears no force.
    pub fn creep(&self, t: f64) -> f64 {
        let Some(form) = &self.kelvin else { return f64::INFINITY };
        let terms = form.0.lines.iter().map(|line| {
            let compliance = (line.strength / line.rate).high();
            // Where nothing has decayed yet, rounding of the rate is the whole error.
            compliance * -(-(line.rate * t).high()).exp_m1()
        });
        form.0.constant.high() + form.0.at_zero.high() * t + terms.sum::<f64>()
    }

    /// Storage stiffness `k′ = Re Q(iω)` \[N/m\] at the angular frequency `ω > 0` \[rad/s\].
    pub fn storage(&self, omega: f64) -> f64 {
        let Some(form) = &self.maxwell else { return f64::INFINITY };
        let term = |rate: f64| 1.0 / (1.0 + (rate / omega).powi(2));
        form.0.at_zero.high() + form.0.weighted(term)
    }

    /// Loss stiffness `k″ = Im Q(iω)` \[N/m\] at the angular frequency `ω > 0` \[rad/s\]; 0 for a rigid link.
    pub fn loss(&self, omega: f64) -> f64 {
        let Some(form) = &self.maxwell else { return 0.0 };
        let term = |rate: f64| 1.0 / (omega / rate + rate / omega);
        form.0.constant.high() * omega + form.0.weighted(term)
    }

    /// Loss factor `tan δ = k″/k′`; infinite for a single dashpot, 0 where nothing is lost.
    pub fn loss_factor(&self, omega: f64) -> f64 {
        let loss = self.loss(omega);
        if loss == 0.0 { 0.0 } else { loss / self.storage(omega) }
    }

    /// Relaxance `Q(s)` \[N/m\] at a real `s > 0` \[1/s\].
    pub fn relaxance(&self, s: f64) -> f64 {
        let Some(form) = &self.maxwell else { return f64::INFINITY };
        let term = |rate: f64| 1.0 / (1.0 + rate / s);
        form.0.at_zero.high() + form.0.constant.high() * s + form.0.weighted(term)
    }

    /// Retardance `1/Q(s)` \[m/N\] at a real `s > 0` \[1/s\], from the Kelvin form.
    pub fn retardance(&self, s: f64) -> f64 {
        let Some(form) = &self.kelvin else { return f64::INFINITY };
        let term = |rate: f64| 1.0 / (s + rate);
        form.0.constant.high() + form.0.at_zero.high() / s + form.0.weighted(term)
    }
}

impl Fractions {
    fn weighted(&self, term: impl Fn(f64) -> f64) -> f64 {
        self.lines.iter().map(|line| line.strength.high() * term(line.rate.high())).sum()
    }
}

trait RecipOrInfinity {
    fn recip_or_infinity(self) -> f64;
}

impl RecipOrInfinity for DoubleDouble {
    fn recip_or_infinity(self) -> f64 {
        if self.high() > 0.0 { self.recip().high() } else { f64::INFINITY }
    }
}

/// `e^(−r t)`, to rounding even where it is small: the exponent is taken in twice the digits.
fn decay(rate: DoubleDouble, t: f64) -> f64 {
    let exponent = rate * t;
    (-exponent.high()).exp() * (1.0 - exponent.low())
}
