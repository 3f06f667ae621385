//! Linear spring with a preload.

use std::sync::Arc;

use super::{Element, Law, Tangent, line::Line};
use crate::{
    parameters,
    phases::{Exit, Phase, PhaseLaw, Phases},
};

parameters! {
    /// A linear spring that is pressed already where its deformation is counted from, `F = F₀ + k y`.
    ///
    /// | symbol | field       | unit | range |
    /// |--------|-------------|------|-------|
    /// | `k`    | `stiffness` | N/m  | > 0   |
    /// | `F₀`   | `preload`   | N    | finite |
    ///
    /// It stores `F²/2k`, and dissipates none. With `F₀ < 0` it is stretched. Something else must take the preload, a
    /// contact or stop for instance, or else the spring moves what it lies between.
    ///
    /// # Limits
    ///
    /// It pulls once it is stretched by more than `F₀/k`.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::PreloadedSpring};
    ///
    /// let spring = PreloadedSpring { stiffness: 2e4, preload: 200.0 };
    /// assert_eq!(spring.force(0.01, 0.0), 400.0);
    /// assert_eq!(spring.stored(0.01), 4.0);
    /// ```
    ///
    /// # References
    ///
    /// `hooke1678` in `docs/references.bib`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct PreloadedSpring: "preloaded-spring", "preloaded linear spring, F = F₀ + k y" {
        /// spring constant k [N/m], positive
        pub stiffness: f64 = Quantity(Dimension::STIFFNESS), range Positive;
        /// force F₀ at zero deformation [N], positive where it is pressed
        pub preload: f64 = Quantity(Dimension::FORCE);
    }
    sample { stiffness: 2e4, preload: 200.0 }
}

impl PreloadedSpring {
    fn line(self) -> Line {
        Line::new(self.stiffness, self.preload)
    }
}

impl Element for PreloadedSpring {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.line().force(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        self.line().tangent(deformation, rate)
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.line().stored(deformation)
    }

    fn law(&self) -> Law {
        if self.preload == 0.0 { Law::Spring(self.stiffness) } else { Law::Phased }
    }

    fn phases(&self) -> Option<&dyn Phases> {
        (self.preload != 0.0).then_some(self as &dyn Phases)
    }
}

impl Phases for PreloadedSpring {
    fn names(&self) -> &'static [&'static str] {
        &["preloaded"]
    }

    fn first(&self, _deformation: f64) -> Phase {
        Phase { index: 0, memory: 0.0 }
    }

    fn law(&self, _phase: Phase) -> PhaseLaw {
        PhaseLaw::Element(Arc::new(self.line()))
    }

    fn exits(&self, _phase: Phase) -> Vec<Exit> {
        Vec::new()
    }

    fn at_rest(&self) -> Option<Law> {
        Some(Law::Nonlinear { stiffness: self.stiffness, damping: 0.0 })
    }
}
