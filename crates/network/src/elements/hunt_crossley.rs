//! Contact with a stiffness and damping that grow from zero.

use super::{
    Element, Tangent,
    impact_law::{Impact, ImpactLaw},
    power::PowerLaw,
};
use crate::{parameters, parameters::InvalidParameter, phases::Phases};

parameters! {
    /// A contact with a stiffness and a damping that grow from zero with the depth,
    /// `F = F_r (z/y_r)^n (1 + c ẏ)` with `z = y − gap > 0`, else 0.
    ///
    /// | symbol | field         | unit | range |
    /// |--------|---------------|------|-------|
    /// | `F_r`  | `force`       | N    | > 0   |
    /// | `y_r`  | `at`          | m    | > 0   |
    /// | `c`    | `dissipation` | s/m  | ≥ 0   |
    /// | `n`    | `exponent`    | 1    | ≥ 1, 3/2 (Hertz) where left out |
    /// | `gap`  | `gap`         | m    | finite, 0 where left out |
    ///
    /// The force begins at zero where it engages and ends at zero where it lets go, unlike that of a
    /// spring and dashpot in parallel. It stores `∫ F_r (z/y_r)^n dz`, and dissipates
    /// `F_r (z/y_r)^n c ẏ²`. A mass that meets it at the speed `v` leaves with a speed `e v` that depends
    /// on `d = c v` alone: `d (1 + e) = ln((1 + d)/(1 − e d))`. For small `d`, `e ≈ 1 − 2 d/3`.
    /// [`Bumper`](super::Bumper) finds `c` from a wanted `e`.
    ///
    /// # Limits
    ///
    /// It never pulls: where `ẏ < −1/c`, the factor `1 + c ẏ` counts as 0. Any reference `y_r` with the force
    /// that the law has there is the same law, and gives the same results.
    ///
    /// The slope over the rate vanishes where it engages. A massless node that nothing else damps finds its
    /// rate all the same: while it is engaged, the compiler puts a dashpot beside it there, of 10⁻⁸ of the slope
    /// that it has at the depth of the impact; only by its force may that of such a contact be below zero.
    ///
    /// # Examples
    ///
    /// ```
    /// use dashpot_network::{Element, elements::HuntCrossley};
    ///
    /// let contact =
    ///     HuntCrossley { force: 1000.0, at: 0.001, dissipation: 0.2, exponent: 1.5, gap: 0.0 };
    /// assert!((contact.force(0.001, 2.0) - 1400.0).abs() < 1e-10);
    /// assert_eq!(contact.force(-0.001, 2.0), 0.0);
    /// ```
    ///
    /// # References
    ///
    /// `hunt1975` in `docs/references.bib`; the equation for `e` under [`Bumper`](super::Bumper).
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct HuntCrossley: "hunt-crossley",
        "contact, F = F_r (z/y_r)^n (1 + c y') for z = y - gap > 0", checked by Self::fits
    {
        /// force F_r at the deformation `at` [N], positive
        pub force: f64 = Quantity(Dimension::FORCE), range Positive;
        /// reference deformation y_r [m], positive
        pub at: f64 = Quantity(Dimension::LENGTH), range Positive;
        /// part c by which the force rises with the rate [s/m], zero or positive
        pub dissipation: f64 = Quantity(Dimension::new(0, -1, 1)), range NonNegative;
        /// exponent n of the depth [1], 1 or more
        pub exponent: f64 = Quantity(Dimension::NUMBER), default "1.5", range AtLeastOne;
        /// deformation at which it engages [m]
        pub gap: f64 = Quantity(Dimension::LENGTH), default "0 m";
    }
    sample { force: 1000.0, at: 0.001, dissipation: 0.2, exponent: 1.5, gap: 0.0 }
}

impl HuntCrossley {
    fn fits(&self) -> Result<(), InvalidParameter> {
        self.impact().fits()
    }
}

impl Impact for HuntCrossley {
    fn impact(&self) -> ImpactLaw {
        ImpactLaw {
            power: PowerLaw { force: self.force, at: self.at, exponent: self.exponent },
            dissipation: self.dissipation,
            gap: self.gap,
        }
    }
}

impl Element for HuntCrossley {
    fn force(&self, deformation: f64, rate: f64) -> f64 {
        self.impact().force(deformation, rate)
    }

    fn tangent(&self, deformation: f64, rate: f64) -> Tangent {
        self.impact().tangent(deformation, rate)
    }

    fn stored(&self, deformation: f64) -> f64 {
        self.impact().stored(deformation)
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }
}
