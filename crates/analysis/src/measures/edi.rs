//! Effective displacement index.

use dashpot_network::{
    Model,
    elements::{Dashpot, Spring},
    first_nonlinear, parameters,
    parameters::{InvalidParameter, WindowWish},
    part,
};
use dashpot_rheology::Tree;

use super::{Family, MeasureKind, Needs, Reading, WHOLE_RUN};
use crate::{
    Note, Solution,
    impact::driven::{Oscillator, largest_deformation},
};

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
    const UNIT: &'static str = "m";
    const APPLIES_TO: Family = Family::Node;
    const NEEDS: Needs = Needs::Acceleration;

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        match self.oscillator() {
            Some(own) => largest_deformation(solution, target, (&own, 1.0), self.window),
            None => Reading::undefined(Note::NotLinear),
        }
    }
}
