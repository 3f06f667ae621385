//! The law that elements of impact damping share.

use std::sync::Arc;

use super::{Element, Law, Tangent, power::PowerLaw};
use crate::{
    parameters::{Described, InvalidParameter, Parameter, Value},
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

/// An element of this law.
pub(super) trait Impact: Element {
    /// The law with the constants of the element.
    fn impact(&self) -> ImpactLaw;
}

impl<T: Impact> Phases for T {
    fn names(&self) -> &'static [&'static str] {
        &["free", "engaged"]
    }

    fn first(&self, deformation: f64) -> Phase {
        let index = if deformation < self.impact().gap { FREE } else { ENGAGED };
        Phase { index, memory: 0.0 }
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        if phase.index != ENGAGED {
            return PhaseLaw::Open;
        }
        let (impact, kind) = (self.impact(), self.kind());
        let (parameters, values) = (self.parameters(), self.values());
        PhaseLaw::Element(Arc::new(Engaged { impact, kind, parameters, values }))
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        let is_free = phase.index != ENGAGED;
        vec![Exit {
            watched: Watched::Deformation,
            level: self.impact().gap,
            rising: is_free,
            to: if is_free { ENGAGED } else { FREE },
            remembers: false,
        }]
    }
}

/// `F = F_r (z/y_r)^n max(0, 1 + c ẏ)` for `z = y − gap > 0`, else 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ImpactLaw {
    /// The force at rest over `z`.
    pub(super) power: PowerLaw,
    /// `c` \[s/m\].
    pub(super) dissipation: f64,
    /// Deformation at which it engages \[m\].
    pub(super) gap: f64,
}

const FREE: usize = 0;
const ENGAGED: usize = 1;

impl ImpactLaw {
    /// Slope over the rate at the reference deformation \[N s/m\].
    fn damping(&self) -> f64 {
        self.power.force * self.dissipation
    }

    fn depth(&self, deformation: f64) -> f64 {
        (deformation - self.gap).max(0.0)
    }

    /// Depth and factor of the rate while it is engaged. At rest a law that is linear in the depth has no kink at the
    /// gap, so that what rests within the tolerance of it is not at one; on the other side no rate counts.
    fn engaged(&self, deformation: f64, rate: f64) -> (f64, f64) {
        let depth = deformation - self.gap;
        if depth > 0.0 {
            (depth, 1.0 + self.dissipation * rate)
        } else {
            (if self.power.exponent > 1.0 { 0.0 } else { depth }, 1.0)
        }
    }

    fn engaged_force(&self, deformation: f64, rate: f64) -> f64 {
        let (depth, factor) = self.engaged(deformation, rate);
        self.power.value(depth.abs()).copysign(depth) * factor.max(0.0)
    }

    fn engaged_tangent(&self, deformation: f64, rate: f64) -> Tangent {
        let (depth, factor) = self.engaged(deformation, rate);
        if factor <= 0.0 {
            return Tangent::default();
        }
        Tangent {
            stiffness: self.power.slope(depth.abs()) * factor,
            damping: self.power.value(depth.max(0.0)) * self.dissipation,
        }
    }

    pub(super) fn force(&self, deformation: f64, rate: f64) -> f64 {
        if deformation > self.gap { self.engaged_force(deformation, rate) } else { 0.0 }
    }

    pub(super) fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        if deformation > self.gap {
            self.engaged_tangent(deformation, rate)
        } else {
            Tangent::default()
        }
    }

    pub(super) fn stored(&self, deformation: f64) -> f64 {
        self.power.integral(self.depth(deformation))
    }

    /// Whether its slopes at the references are numbers.
    pub(super) fn fits(&self) -> Result<(), InvalidParameter> {
        self.power.fits()?;
        if self.dissipation > 0.0 && !self.damping().is_normal() {
            let range = "such that the slope of the law fits into double precision";
            return Err(InvalidParameter::new("dissipation", range, self.dissipation));
        }
        Ok(())
    }
}

/// An element of this law while it is engaged.
#[derive(Debug)]
struct Engaged {
    impact: ImpactLaw,
    /// Word of the element.
    kind: &'static str,
    /// Parameters of the element.
    parameters: &'static [Parameter],
    /// Their values.
    values: Vec<Value>,
}

impl Described for Engaged {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn parameters(&self) -> &'static [Parameter] {
        self.parameters
    }

    fn values(&self) -> Vec<Value> {
        self.values.clone()
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        self.impact.fits()
    }
}

impl Element for Engaged {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.impact.engaged_force(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        self.impact.engaged_tangent(deformation, rate)
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.impact.power.integral(self.impact.engaged(deformation, 0.0).0.abs())
    }

    fn law(&self) -> Law {
        Law::Nonlinear { stiffness: self.impact.power.secant(), damping: self.impact.damping() }
    }

    fn grows_from(&self) -> Option<f64> {
        Some(self.impact.gap)
    }
}
