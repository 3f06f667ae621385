//! Dynamic response index.

use dashpot_network::{parameters, parameters::WindowWish};

use super::{Family, MeasureKind, Needs, Reading, STANDARD_GRAVITY, WHOLE_RUN};
use crate::{
    Solution,
    impact::driven::{Oscillator, largest_deformation},
    similarity::Scale,
};

/// Angular frequency of the model of the spine \[rad/s\].
const OMEGA: f64 = 52.9;
/// Its damping ratio.
const DAMPING_RATIO: f64 = 0.224;

parameters! {
    /// The dynamic response index, `DRI = ω² δ_max/g0`: how far a mass on a spring and a dashpot, which
    /// stand for the spine, is pressed by what an accelerometer on the body reads.
    ///
    /// | symbol | value | unit |
    /// |--------|-------|------|
    /// | `ω`    | 52.9  | rad/s |
    /// | `ζ`    | 0.224 | 1     |
    /// | `g0`   | [`STANDARD_GRAVITY`] | m/s² |
    ///
    /// `y″ + 2 ζ ω y′ + ω² y = a(t)`, from rest at the start of the window; `δ_max` is the largest `|y|`.
    /// Jumps of the speed act as impulses. A long steady acceleration of `A g0` that sets in at once has
    /// `DRI = A (1 + exp(−π ζ/√(1 − ζ²)))`, one that sets in slowly `A`.
    ///
    /// # References
    ///
    /// The constants are those of `stech1969` in `docs/references.bib`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Dri: "dri", "dynamic response index of the spine [1]" {
        /// The part of the run that drives it, and in which its largest value is sought.
        pub window: WindowWish => WHOLE_RUN;
    }
    default { window: WindowWish::Run }
}

impl MeasureKind for Dri {
    const UNIT: &'static str = "1";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn gravities(&self) -> f64 {
        1.0
    }

    fn of_similar(&self, _scale: &Scale) -> Option<std::sync::Arc<dyn super::Measure>> {
        // It has a frequency of its own.
        None
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        let spine = Oscillator::new(OMEGA, DAMPING_RATIO);
        let factor = OMEGA * OMEGA / STANDARD_GRAVITY;
        largest_deformation(solution, target, (&spine, factor), self.window)
    }
}
