//! Coulomb friction.

use super::{Element, Law, Tangent};
use crate::{
    parameters,
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

parameters! {
    /// A slider with dry friction, `F = F_c sgn ẏ` while it slides and `|F| ≤ F_c` while it sticks (Coulomb).
    ///
    /// | symbol    | field   | unit | range |
    /// |-----------|---------|------|-------|
    /// | `F_c`     | `force` | N    | ≥ 0   |
    /// | `F_s/F_c` | `ratio` | 1    | ≥ 1, 1 where left out |
    ///
    /// It sticks where its rate comes to zero, and slides again where the force that holds it would exceed that of
    /// static friction, `F_s`: sticking is exact, not a creep. It stores no energy and dissipates `F_c |ẏ|`. `F_c = 0`
    /// is no slider at all. A mass that it holds to a given motion slides where that has a kink.
    ///
    /// # Limits
    ///
    /// Where static friction is greater than kinetic, the force drops as it lets go, so one of its ends must
    /// have a mass or a dashpot beside it that takes the difference.
    ///
    /// `F_c` does not depend on a normal force, on the speed or on the time of rest. Between two given
    /// motions it cannot stick: it slides the way they go, and while they pause it keeps the force that
    /// it had, and so it does while something else holds its ends, though its force follows from nothing
    /// then. Sliders side by side between the same two places slide together, and each reports its part
    /// of their force in proportion to its `F_c`, also while they stick: how they would share it then
    /// depends on how each of them came to rest, which this law does not know.
    ///
    /// # References
    ///
    /// `coulomb1785` in `docs/references.bib`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Friction: "friction", "dry friction, F = F_c sgn ẏ, with true stick" {
        /// force F_c of kinetic friction, while it slides [N], zero or positive
        pub force as "friction": f64 = Quantity(Dimension::FORCE), range NonNegative;
        /// static friction F_s in parts of F_c [1], 1 or more
        pub ratio as "static-to-kinetic": f64 = Quantity(Dimension::NUMBER), default "1", range AtLeastOne;
    }
    sample { force: 50.0, ratio: 1.0 }
}

const STUCK: usize = 0;
const FORWARD: usize = 1;
const BACKWARD: usize = 2;

impl Phases for Friction {
    fn names(&self) -> &'static [&'static str] {
        &["stuck", "sliding forward", "sliding backward"]
    }

    fn first(&self, deformation: f64) -> Phase {
        Phase { index: STUCK, memory: deformation }
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        match phase.index {
            FORWARD => PhaseLaw::Force(self.force),
            BACKWARD => PhaseLaw::Force(-self.force),
            _ => PhaseLaw::Held(phase.memory),
        }
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        let stop = |rising| Exit {
            watched: Watched::Rate,
            level: 0.0,
            rising,
            to: STUCK,
            remembers: true,
        };
        let slip = |level, rising, to| Exit {
            watched: Watched::Force,
            level,
            rising,
            to,
            remembers: false,
        };
        match phase.index {
            FORWARD => vec![stop(false)],
            BACKWARD => vec![stop(true)],
            _ => {
                let holds = self.force * self.ratio;
                vec![slip(holds, true, FORWARD), slip(-holds, false, BACKWARD)]
            }
        }
    }

    fn capacity(&self) -> Option<f64> {
        Some(self.force)
    }

    fn static_to_kinetic(&self) -> f64 {
        self.ratio
    }
}

impl Element for Friction {
    fn force(&self, _deformation: f64, rate: f64) -> f64 {
        if rate == 0.0 { 0.0 } else { self.force.copysign(rate) }
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent::default()
    }

    fn stored(&self, _deformation: f64) -> f64 {
        0.0
    }

    fn law(&self) -> Law {
        if self.force > 0.0 { Law::Phased } else { Law::Dashpot(0.0) }
    }

    fn phases(&self) -> Option<&dyn Phases> {
        (self.force > 0.0).then_some(self as &dyn Phases)
    }
}
