//! What a mass on a model makes of the acceleration of the body that carries it.

use std::sync::Arc;

use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    first_nonlinear, parameters,
    parameters::{InvalidParameter, WindowWish},
    part,
};
use dashpot_rheology::Tree;

use super::{
    Measure, MeasureKind, MeasureTraits, Reading, STANDARD_GRAVITY, WHOLE_RUN,
    driven::{Oscillator, largest_deformation},
};
use crate::{Note, Solution};

/// Angular frequency of the model of the spine \[rad/s\].
const OMEGA: f64 = 52.9;
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
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("1");

    fn gravities(&self) -> f64 {
        1.0
    }

    fn general(&self) -> Option<Arc<dyn Measure>> {
        // It has a frequency of its own.
        None
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let spine = Oscillator::new(OMEGA, DAMPING_RATIO);
        let factor = OMEGA * OMEGA / STANDARD_GRAVITY;
        largest_deformation(solution, target, (&spine, factor), self.window)
    }
}

parameters! {
    /// The effective displacement index, `EDI = max |y|` \[m\]: how far a mass on a model of springs and
    /// dashpots is displaced by what an accelerometer on the body reads.
    ///
    /// | symbol | field   | unit | range    |
    /// |--------|---------|------|----------|
    /// |        | `model` |      | linear springs and dashpots |
    /// | `m`    | `mass`  | kg   | positive |
    ///
    /// `m y″ + F = m a(t)`, where `F` is the force of the model at the deformation `y`, from rest at the
    /// start of the window. Jumps of the speed act as impulses. The body does not feel the mass.
    ///
    /// # References
    ///
    /// The thesis, chapter II, asks for it with a Maxwell model (`thesis` in `docs/references.bib`).
    #[derive(Debug, Clone)]
    pub struct Edi: "edi",
        "largest displacement of a mass on a model that the acceleration drives [m]", checked by Self::deforms
    {
        /// what the mass hangs on: linear springs and dashpots
        pub model: Model = Model;
        /// the mass m [kg], positive
        pub mass: f64 = Quantity(Dimension::MASS), default "1 kg", range Positive;
        /// The part of the run that drives it, and in which its largest displacement is sought.
        pub window: WindowWish => WHOLE_RUN;
    }
}

impl Default for Edi {
    /// An example, not one from the literature: 1 kg on a Maxwell element of 4 kN/m and 100 N s/m.
    fn default() -> Self {
        let maxwell = [part(Spring { stiffness: 4e3 }), part(Dashpot { damping: 100.0 })];
        Self { model: Tree::series(maxwell), mass: 1.0, window: WindowWish::Run }
    }
}

impl Edi {
    fn oscillator(&self) -> Option<Oscillator> {
        Oscillator::of(&self.model, self.mass)
    }

    /// Whether its model is linear and gives way.
    fn deforms(&self) -> Result<(), InvalidParameter> {
        let invalid = |found: &str| {
            let range = "made of linear springs and dashpots that can deform";
            Err(InvalidParameter::new("model", range, found))
        };
        match first_nonlinear(&self.model) {
            Some(element) => invalid(&format!("not linear (`{}`)", element.kind())),
            None if self.oscillator().is_none() => invalid("rigid"),
            None => Ok(()),
        }
    }
}

impl MeasureKind for Edi {
    const ABOUT: MeasureTraits = MeasureTraits::of_body::<Self>("m");

    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note> {
        let own = self.oscillator().ok_or(Note::NotLinear)?;
        largest_deformation(solution, target, (&own, 1.0), self.window)
    }
}
