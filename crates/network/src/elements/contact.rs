//! Unilateral contact.

use super::{Element, Tangent};
use crate::{
    parameters,
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

parameters! {
    /// A contact that pushes and never pulls: `F = 0` while `y < gap`, `y = gap` while `F > 0`
    /// (Signorini's conditions).
    ///
    /// | symbol | field         | unit | range |
    /// |--------|---------------|------|-------|
    /// | `gap`  | `gap`         | m    | ≥ 0, the free travel |
    /// | `e`    | `restitution` | 1    | 0 … 1 |
    ///
    /// It closes where the deformation reaches the gap and opens where the force falls to zero. Where
    /// both sides have mass, closing is an impact: the relative speed is reversed and multiplied by `e`
    /// (Newton), momentum is kept, and the loss of energy is booked in the ledger. A massless side takes
    /// the speed of the other one without any impact. Where a given motion on one side has a kink, a mass that lies
    /// on it is hit by the difference of the speeds, or parts with it.
    ///
    /// # Limits
    ///
    /// Both sides are rigid where they meet: speeds jump, and where masses meet the force is infinite
    /// for no time. One number `e` holds at all speeds; a contact with a force over time is a
    /// [`HuntCrossley`](super::HuntCrossley). Rebounds whose height cannot be told from zero end, and
    /// the contact stays closed. Of contacts between the same bodies that close at one deformation only
    /// the sum of their forces is determined, which is warned of.
    ///
    /// # References
    ///
    /// `signorini1959` and, for impacts, `brogliato1999` in `docs/references.bib`.
    #[derive(Debug, Clone, Copy, PartialEq)]
    pub struct Contact: "contact", "pushes and never pulls: F = 0 or y = gap" {
        /// deformation at which it closes [m], zero or positive
        pub gap: f64 = Quantity(Dimension::LENGTH), default "0 m", range NonNegative;
        /// coefficient of restitution of an impact between masses, 0 to 1
        pub restitution: f64 = Quantity(Dimension::NUMBER), default "0", range Part;
    }
    sample { gap: 0.0, restitution: 0.0 }
}

const OPEN: usize = 0;
const CLOSED: usize = 1;

impl Phases for Contact {
    fn names(&self) -> &'static [&'static str] {
        &["open", "closed"]
    }

    fn first(&self, deformation: f64) -> Phase {
        let index = if deformation < self.gap { OPEN } else { CLOSED };
        Phase { index, memory: 0.0 }
    }

    fn law(&self, phase: Phase) -> PhaseLaw {
        if phase.index == CLOSED { PhaseLaw::Held(self.gap) } else { PhaseLaw::Open }
    }

    fn exits(&self, phase: Phase) -> Vec<Exit> {
        let exit = if phase.index == CLOSED {
            Exit { watched: Watched::Force, level: 0.0, rising: false, to: OPEN, remembers: false }
        } else {
            Exit {
                watched: Watched::Deformation,
                level: self.gap,
                rising: true,
                to: CLOSED,
                remembers: false,
            }
        };
        vec![exit]
    }

    fn restitution(&self) -> f64 {
        self.restitution
    }
}

impl Element for Contact {
    fn force(&self, _deformation: f64, _rate: f64) -> f64 {
        0.0
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent::default()
    }

    fn stored(&self, _deformation: f64) -> f64 {
        0.0
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }
}
