//! Foam that unloads on another curve.

use dashpot_numerics::quadrature::integral;

use super::{
    Element, Foam,
    hysteresis::{TwoCurves, two_curves},
};
use crate::parameters::{
    Described, Dimension, Field, Given, InvalidParameter, Kind, Parameter, ParameterKind, Range,
    Value,
};

/// A block of foam that unloads on another curve than it was loaded on, and keeps a set.
///
/// While it is pressed deeper than ever before, the force is that of a [`Foam`], `F = f(y)`. Where the deformation
/// turns back at `y_m`, it remembers that depth and follows `F = f(y) s^q`, `s = (y − y_p)/(y_m − y_p)`, with the set
/// `y_p = r y_m`. It is loaded again on the same curve, up to `y_m`, where the first one goes on. Below the set it is
/// slack, `F = 0`: it pushes and never pulls, also when it is new.
///
/// | symbol | field                | unit | range |
/// |--------|----------------------|------|-------|
/// | `f`    | `foam`               | N    | see [`Foam`] |
/// | `r`    | `set`                | 1    | 0 ≤ r < 1 |
/// | `q`    | `unloading-exponent` | 1    | ≥ 1   |
///
/// The curve of unloading is the first one times a factor from 0 to 1, as in the codes for crash
/// simulation. So it never lies above the first one, whatever its shape: no cycle creates energy.
/// (A chord or power of `y` alone would lie above it in the densification.)
///
/// # Energy
///
/// It stores what it would give back, `W = ∫ f s^q dy` from `y_p` to `y` on the curve of unloading;
/// on the first curve, that for `y_m = y`. All else that was put in is dissipated, and at once: with
/// `y_m` the store rises by less than `f dy`, since `s` falls.
///
/// # Limits
///
/// It has one memory, the greatest deformation: a loop within the curve of unloading takes no energy, nothing heals
/// with time, and no force depends on the rate. Beyond the strain 0.99 it is as straight as its [`Foam`].
///
/// # Examples
///
/// ```
/// use dashpot_network::{Element, elements::{Foam, HystereticFoam}};
///
/// let foam = Foam {
///     modulus: 2e6,
///     plateau: 1e5,
///     densification: 2e4,
///     exponent: 3.0,
///     thickness: 0.02,
///     area: 0.01,
/// };
/// let crushed = HystereticFoam { foam, set: 0.2, unloading_exponent: 2.0 };
/// assert_eq!(crushed.force(0.01, 1.0), foam.force(0.01, 1.0));
/// assert!(crushed.stored(0.01) < 0.4 * foam.stored(0.01));
/// ```
///
/// # References
///
/// `avalle2007` in `docs/references.bib` for the first curve; `hallquist2006`, material type 57,
/// for unloading on the first curve times a factor; `gibson1997` for what happens in the cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HystereticFoam {
    /// The foam as it is loaded for the first time.
    pub foam: Foam,
    /// Part `r` of the greatest deformation that remains.
    pub set: f64,
    /// Exponent `q` of the curve of unloading.
    pub unloading_exponent: f64,
}

two_curves!(HystereticFoam);

impl TwoCurves for HystereticFoam {
    fn loading(&self) -> &dyn Element {
        &self.foam
    }

    fn kept(&self, deepest: f64) -> f64 {
        self.set * deepest
    }

    fn factor(&self, deformation: f64, deepest: f64) -> (f64, f64) {
        let from = self.set * deepest;
        let slope = (deepest - from).recip();
        let part = ((deformation - from) * slope).max(0.0);
        if part <= 0.0 {
            return (0.0, 0.0);
        }
        let q = self.unloading_exponent;
        (part.powf(q), q * part.powf(q - 1.0) * slope)
    }

    fn recoverable(&self, deformation: f64, deepest: f64) -> f64 {
        let from = self.set * deepest;
        if deformation <= from {
            return 0.0;
        }
        let length = deepest - from;
        let force = |part: f64| {
            self.foam.force(from + length * part, 0.0) * part.powf(self.unloading_exponent)
        };
        length * integral(force, 0.0, (deformation - from) / length)
    }

    fn bends(&self) -> Vec<f64> {
        vec![self.set]
    }
}

/// The parameters of the foam, and those of unloading.
const PARAMETERS: [Parameter; 8] = {
    let number = ParameterKind::Quantity(Dimension::NUMBER);
    let set = "part r of the greatest deformation that remains [1], from 0, below 1";
    let set = Parameter::new("set", number, set).range(Range::PartBelowOne);
    let exponent = "exponent q of the curve of unloading [1], 1 or more";
    let exponent = Parameter::new("unloading-exponent", number, exponent).range(Range::AtLeastOne);
    let mut all = [set, set, set, set, set, set, set, exponent];
    all.split_at_mut(Foam::PARAMETERS.len()).0.copy_from_slice(Foam::PARAMETERS);
    all
};

impl Kind for HystereticFoam {
    const KIND: &'static str = "hysteretic-foam";
    const SUMMARY: &'static str = "foam with hysteresis and permanent set; never pulls";
    const PARAMETERS: &'static [Parameter] = &PARAMETERS;

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let foam = Foam::from_values(values)?;
        let own = values.get(Foam::PARAMETERS.len()..).unwrap_or_default();
        let mut given = Given::new(Self::PARAMETERS.split_at(Foam::PARAMETERS.len()).1, own);
        Ok(Self { foam, set: given.take()?, unloading_exponent: given.take()? })
    }

    fn fields(&self) -> Vec<Value> {
        let mut values = self.foam.values();
        values.extend([self.set.value(), self.unloading_exponent.value()]);
        values
    }

    fn check_whole(&self) -> Result<(), InvalidParameter> {
        self.foam.validate()
    }

    fn sample() -> Self {
        Self { foam: Foam::sample(), set: 0.2, unloading_exponent: 2.0 }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::{
        elements::hysteresis::{
            LOADING, SLACK, UNLOADING,
            tests::{never_gives_more_than_it_took, travelled},
        },
        phases::{Phase, PhaseLaw, Phases},
    };

    /// A foam that is linear as it is loaded, to 1e-9.
    fn linear(set: f64, unloading_exponent: f64) -> HystereticFoam {
        let foam = Foam {
            modulus: 1e3,
            plateau: 1e12,
            densification: 0.0,
            exponent: 1.0,
            thickness: 1.0,
            area: 1.0,
        };
        HystereticFoam { foam, set, unloading_exponent }
    }

    fn curve(foam: &HystereticFoam, deepest: f64) -> Arc<dyn Element> {
        let phase = Phase { index: UNLOADING, memory: deepest };
        match Phases::law(foam, phase) {
            PhaseLaw::Element(element) => element,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_linear_foam_gives_back_what_its_exponent_says() {
        // ∫ k y (y/y_m)^q dy = k y_m²/(q + 2).
        for q in [1.0, 2.0, 3.7] {
            let foam = linear(0.0, q);
            assert!((foam.stored(0.5) / (250.0 / (q + 2.0)) - 1.0).abs() < 1e-8);
            let back = curve(&foam, 0.5);
            let part = 0.6_f64.powf(q + 2.0);
            assert!((back.stored(0.3) / (250.0 / (q + 2.0) * part) - 1.0).abs() < 1e-8);
        }
        // With a set r: ∫₀¹ (r + (1 − r) s) s^q ds (1 − r) k y_m².
        let (r, q) = (0.25, 2.0);
        let exact = 250.0 * (1.0 - r) * (r / (q + 1.0) + (1.0 - r) / (q + 2.0));
        assert!((linear(r, q).stored(0.5) / exact - 1.0).abs() < 1e-8);
    }

    #[test]
    fn force_and_store_are_continuous_at_every_exit() {
        let foam = HystereticFoam::sample();
        for deepest in [1e-6, 0.001, 0.0123, 0.0199, 0.025] {
            let back = curve(&foam, deepest);
            let force = foam.force(deepest, 0.0);
            assert!((back.force(deepest, 0.0) / force - 1.0).abs() < 1e-13);
            assert!((back.stored(deepest) / foam.stored(deepest) - 1.0).abs() < 1e-12);
            let kept = 0.2 * deepest;
            assert!(back.force(kept, 0.0).abs() <= 1e-13 * force);
            assert!(back.stored(kept).abs() <= 1e-13 * foam.stored(deepest));
            assert!(back.force(0.9 * kept, 0.0).abs() <= 0.0);
            for part in [0.25, 0.5, 0.75, 0.99] {
                let y = kept + part * (deepest - kept);
                assert!(back.force(y, 0.0) <= foam.force(y, 0.0), "it lies above the first curve");
            }
        }
    }

    #[test]
    fn it_follows_its_curves_from_phase_to_phase() {
        let foam = linear(0.2, 1.0);
        let (_, phase, _) = travelled(&foam, &[0.0, 0.5]);
        assert_eq!(phase.index, LOADING);
        let (_, phase, _) = travelled(&foam, &[0.0, 0.5, 0.3]);
        assert_eq!((phase.index, phase.memory), (UNLOADING, 0.5));
        let (work, phase, _) = travelled(&foam, &[0.0, 0.5, -0.1]);
        assert_eq!((phase.index, phase.memory), (SLACK, 0.5));
        // The first curve's ½ k y², less what it gives back, to the second order of the steps.
        let lost = 125.0 - foam.stored(0.5);
        assert!((work / lost - 1.0).abs() < 1e-5);
        // A second round up to the same depth takes and gives the same: nothing more is lost.
        let (again, phase, _) = travelled(&foam, &[0.0, 0.5, -0.1, 0.5, -0.1]);
        assert_eq!((phase.index, phase.memory), (SLACK, 0.5));
        assert!((again / lost - 1.0).abs() < 1e-5);
        // Deeper than before, the first curve goes on as if it had never been left.
        let (deeper, phase, _) = travelled(&foam, &[0.0, 0.5, 0.3, 0.8]);
        assert_eq!(phase.index, LOADING);
        assert!((deeper / (0.5 * 1e3 * 0.64) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn no_history_takes_out_more_than_was_put_in() {
        for set in [0.0, 0.3, 0.9] {
            for q in [1.0, 4.0] {
                let foam = HystereticFoam { foam: Foam::sample(), set, unloading_exponent: q };
                never_gives_more_than_it_took(&foam, 0.0195);
            }
        }
    }

    #[test]
    fn a_set_of_the_whole_depth_is_refused() {
        let foam = HystereticFoam { set: 1.0, ..HystereticFoam::sample() };
        assert_eq!(foam.validate().unwrap_err().parameter, "set");
        let foam = HystereticFoam { unloading_exponent: 0.5, ..HystereticFoam::sample() };
        assert_eq!(foam.validate().unwrap_err().parameter, "unloading-exponent");
    }
}
