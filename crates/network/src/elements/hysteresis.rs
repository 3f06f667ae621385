//! Laws of two curves: one for the first loading, another one for all that follows.

use std::sync::Arc;

use super::{Element, Law, Tangent};
use crate::{
    parameters::{Described, InvalidParameter, Parameter, Value, described_as},
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

/// A law with the force `f(y)` while it is pressed deeper than ever before, and `f(y) φ(y, y_m)` once it has turned
/// back at `y_m`: up to that depth again, and down to the set, where the force is zero. It never pulls.
///
/// `φ` rises with `y` from 0 or more to 1 at `y_m`, and never rises with `y_m`. So the second curve never lies above
/// the first, and what it gives back grows by no more than the work that goes deeper: no history creates energy.
pub trait TwoCurves {
    /// The first curve `f`, for deformations ≥ 0.
    fn loading(&self) -> &dyn Element;

    /// The deformation below which it is slack once it was pressed to `deepest` \[m\].
    fn kept(&self, deepest: f64) -> f64;

    /// `φ` and its slope over the deformation \[1/m\].
    fn factor(&self, deformation: f64, deepest: f64) -> (f64, f64);

    /// Energy \[J\] that unloading from `deepest` gives back from `deformation` on: the integral of `f φ` from the set.
    fn recoverable(&self, deformation: f64, deepest: f64) -> f64;

    /// Parts of the deepest deformation between which `φ` is smooth, the set among them.
    fn bends(&self) -> Vec<f64>;
}

/// The phases of an element of such a law.
macro_rules! two_curves {
    ($element:ty) => {
        impl crate::phases::Phases for $element {
            fn names(&self) -> &'static [&'static str] {
                crate::elements::hysteresis::NAMES
            }

            fn first(&self, deformation: f64) -> crate::phases::Phase {
                crate::elements::hysteresis::first(deformation)
            }

            fn law(&self, phase: crate::phases::Phase) -> crate::phases::PhaseLaw {
                crate::elements::hysteresis::law(self, phase)
            }

            fn exits(&self, phase: crate::phases::Phase) -> Vec<crate::phases::Exit> {
                crate::elements::hysteresis::exits(self, phase)
            }

            fn less_deep(&self, phase: crate::phases::Phase) -> Option<usize> {
                use crate::elements::hysteresis::{LOADING, UNLOADING};
                (phase.index == LOADING).then_some(UNLOADING)
            }
        }

        impl crate::elements::hysteresis::Hysteresis for $element {}
    };
}
pub(super) use two_curves;

/// An element of such a law.
pub(super) trait Hysteresis: TwoCurves + Phases + Described + Clone + 'static {}

pub(super) const SLACK: usize = 0;
pub(super) const LOADING: usize = 1;
pub(super) const UNLOADING: usize = 2;

pub(super) const NAMES: &[&str] = &["slack", "loading", "unloading"];

/// The phase in which such a law begins.
pub(super) fn first(deformation: f64) -> Phase {
    let index = if deformation < 0.0 { SLACK } else { LOADING };
    Phase { index, memory: 0.0 }
}

/// What holds in a phase of such a law.
pub(super) fn law(of: &impl Hysteresis, phase: Phase) -> PhaseLaw {
    let curve = |deepest| PhaseLaw::Element(Arc::new(Curve { law: of.clone(), deepest }));
    match phase.index {
        LOADING => curve(None),
        UNLOADING if phase.memory > 0.0 => curve(Some(phase.memory)),
        _ => PhaseLaw::Open,
    }
}

/// The ways out of a phase of such a law.
pub(super) fn exits(of: &(impl TwoCurves + ?Sized), phase: Phase) -> Vec<Exit> {
    let kept = of.kept(phase.memory);
    let pass = |level, rising, to| Exit {
        watched: Watched::Deformation,
        level,
        rising,
        to,
        remembers: false,
    };
    match phase.index {
        LOADING => vec![Exit {
            watched: Watched::Rate,
            level: 0.0,
            rising: false,
            to: UNLOADING,
            remembers: true,
        }],
        UNLOADING => vec![pass(phase.memory, true, LOADING), pass(kept, false, SLACK)],
        _ => vec![pass(kept, true, if phase.memory > 0.0 { UNLOADING } else { LOADING })],
    }
}

/// One of the two curves. The first one goes on below zero, where it is no more than by a tolerance, so that what rests
/// at a deformation within the tolerance is not at a kink.
#[derive(Debug)]
struct Curve<H> {
    law: H,
    /// The deformation from which it unloads \[m\]; none while it is loaded for the first time.
    deepest: Option<f64>,
}

impl<H: Hysteresis> Curve<H> {
    fn factor(&self, deformation: f64) -> (f64, f64) {
        self.deepest.map_or((1.0, 0.0), |deepest| self.law.factor(deformation, deepest))
    }
}

impl<H: Hysteresis> Described for Curve<H> {
    described_as!(law);
}

impl<H: Hysteresis> Element for Curve<H> {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.law.loading().force(deformation, rate) * self.factor(deformation).0
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        let (factor, slope) = self.factor(deformation);
        if factor <= 0.0 {
            return Tangent::default();
        }
        let loading = self.law.loading();
        let stiffness = loading.tangent(deformation, rate).stiffness * factor
            + loading.force(deformation, rate) * slope;
        Tangent { stiffness, damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        match self.deepest {
            None if deformation < 0.0 => self.law.loading().stored(deformation),
            deepest => self.law.recoverable(deformation, deepest.unwrap_or(deformation)),
        }
    }

    fn law(&self) -> Law {
        self.law.loading().law()
    }
}

impl<H: Hysteresis> Element for H {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        if deformation > 0.0 { self.loading().force(deformation, rate) } else { 0.0 }
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        if deformation > 0.0 {
            self.loading().tangent(deformation, rate)
        } else {
            Tangent::default()
        }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.recoverable(deformation, deformation)
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }

    fn range(&self) -> Option<(f64, f64)> {
        self.loading().range()
    }

    fn two_curves(&self) -> Option<&dyn TwoCurves> {
        Some(self)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Follows the exits as a run would, in small steps, on a way through these turning points.
    pub(in super::super) fn travelled(of: &impl Phases, turns: &[f64]) -> (f64, Phase, f64) {
        let mut phase = of.first(turns[0]);
        let mut work = 0.0;
        let mut lowest = f64::INFINITY;
        let steps = 4000;
        for pair in turns.windows(2) {
            let step = (pair[1] - pair[0]) / f64::from(steps);
            for at in 0..steps {
                let from = pair[0] + step * f64::from(at);
                let middle = from + 0.5 * step;
                // Several exits may follow one another at one instant.
                for _ in 0..3 {
                    let left = of.exits(phase).into_iter().find(|exit| {
                        let now = if exit.watched == Watched::Rate { step } else { middle };
                        if exit.rising { now > exit.level } else { now < exit.level }
                    });
                    let Some(exit) = left else { break };
                    let memory = if exit.remembers { from } else { phase.memory };
                    phase = Phase { index: exit.to, memory };
                }
                let force = match of.law(phase) {
                    PhaseLaw::Element(element) => element.force(middle, step),
                    _ => 0.0,
                };
                work += force * step;
                lowest = lowest.min(work);
            }
        }
        (work, phase, lowest)
    }

    /// Sends a law through many turning points up to a depth: it never gives more than it took,
    /// neither in all nor from any time on at which it is slack.
    pub(in super::super) fn never_gives_more_than_it_took(of: &impl Phases, most: f64) {
        let mut stream = dashpot_numerics::Stream::new(11);
        let turns: Vec<f64> = (0..24).map(|_| 1.1 * most * stream.share() - 0.1 * most).collect();
        let (work, _, lowest) = travelled(of, &[&[-0.05 * most][..], &turns].concat());
        assert!(work > 0.0 && lowest >= 0.0, "{of:?}: {work} {lowest}");
        // Cycles that go deeper each time dissipate no less than the ones before.
        let lost = |cycles: u32| {
            let depths = (1..=cycles).map(|at| most * f64::from(at) / 5.0);
            let turns: Vec<f64> = depths.flat_map(|depth| [depth, -0.05 * most]).collect();
            travelled(of, &[&[-0.05 * most][..], &turns].concat()).0
        };
        for cycles in 1..5 {
            let (before, after) = (lost(cycles), lost(cycles + 1));
            assert!(after >= before * (1.0 - 1e-6), "{of:?}: {before} {after}");
        }
    }
}
