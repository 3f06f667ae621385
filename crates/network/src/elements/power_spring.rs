//! Spring whose force is a power of its deformation.

use super::{Element, Law, Tangent, power::PowerLaw};
use crate::{parameters, parameters::InvalidParameter};

parameters! {
    /// A spring whose force is a power of its deformation, `F = F_r (|y|/y_r)^n sgn y`.
    ///
    /// | symbol | field      | unit | range |
    /// |--------|------------|------|-------|
    /// | `F_r`  | `force`    | N    | > 0   |
    /// | `y_r`  | `at`       | m    | > 0   |
    /// | `n`    | `exponent` | 1    | ≥ 1   |
    ///
    /// The force is `F_r` at the deformation `y_r`, where the slope is `n F_r/y_r`. Tension mirrors
    /// compression. The spring stores `F_r y_r (|y|/y_r)^(n+1)/(n+1)` and dissipates none. `n = 1` is
    /// the linear spring; `n = 3/2` is the contact of two elastic spheres (Hertz 1882). For `n > 1` the
    /// slope is zero at rest, so two such springs do not determine a massless node between them there.
    ///
    /// # Limits
    ///
    /// Hertz's law holds while the radius of the contact is small against the spheres, and for spheres
    /// that are pressed together: as tension mirrors compression here, a contact that parts needs
    /// [`Separation`](crate::effects::Separation) or is a [`HuntCrossley`](super::HuntCrossley). It
    /// goes on to any deformation.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::PowerSpring};
    ///
    /// let spring = PowerSpring { force: 2000.0, at: 0.01, exponent: 1.5 };
    /// assert_eq!(spring.force(0.01, 0.0), 2000.0);
    /// assert!((spring.force(-0.04, 0.0) + 16_000.0).abs() < 1e-9);
    /// ```
    ///
    /// # References
    ///
    /// `hertz1882` in `docs/references.bib` for `n = 3/2`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct PowerSpring: "power-spring",
        "spring of a power law, F = F_r (|y|/y_r)^n sgn y", checked by Self::fits
    {
        /// force F_r at the deformation `at` [N], positive
        pub force: f64 = Quantity(Dimension::FORCE), range Positive;
        /// reference deformation y_r [m], positive
        pub at: f64 = Quantity(Dimension::LENGTH), range Positive;
        /// exponent n [1], 1 or more
        pub exponent: f64 = Quantity(Dimension::NUMBER), range AtLeastOne;
    }
    sample { force: 2000.0, at: 0.01, exponent: 1.5 }
}

impl PowerSpring {
    fn power(&self) -> PowerLaw {
        PowerLaw { force: self.force, at: self.at, exponent: self.exponent }
    }

    fn fits(&self) -> Result<(), InvalidParameter> {
        self.power().fits()
    }
}

impl Element for PowerSpring {
    fn force(&self, deformation: f64, _rate: f64) -> f64 {
        self.power().value(deformation.abs()).copysign(deformation)
    }

    fn tangent(&self, deformation: f64, _rate: f64) -> Tangent {
        Tangent { stiffness: self.power().slope(deformation.abs()), damping: 0.0 }
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.power().integral(deformation.abs())
    }

    fn law(&self) -> Law {
        let stiffness = self.power().secant();
        if self.exponent > 1.0 {
            Law::Nonlinear { stiffness, damping: 0.0 }
        } else {
            Law::Spring(stiffness)
        }
    }

    fn grows_from(&self) -> Option<f64> {
        Some(0.0)
    }
}
