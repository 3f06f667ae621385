//! Unilateral contact.

use super::{Element, ElementKind, Law, Tangent, number};
use crate::{
    parameters::{Dimension, InvalidParameter, Parameter, ParameterKind, Value, non_negative},
    phases::{Exit, Phase, PhaseLaw, Phases, Watched},
};

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
pub struct Contact {
    /// Deformation at which it closes \[m\].
    pub gap: f64,
    /// Coefficient of restitution `e` of an impact between masses.
    pub restitution: f64,
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
    fn kind(&self) -> &'static str {
        Self::KIND
    }

    fn force(&self, _deformation: f64, _rate: f64) -> f64 {
        0.0
    }

    fn tangent(&self, _deformation: f64, _rate: f64) -> Tangent {
        Tangent::default()
    }

    fn stored(&self, _deformation: f64) -> f64 {
        0.0
    }

    fn law(&self) -> Law {
        Law::Phased
    }

    fn phases(&self) -> Option<&dyn Phases> {
        Some(self)
    }

    fn never_pulls(&self) -> bool {
        true
    }

    fn validate(&self) -> Result<(), InvalidParameter> {
        non_negative("gap", self.gap)?;
        non_negative("restitution", self.restitution)?;
        if self.restitution > 1.0 {
            let found = self.restitution.to_string();
            return Err(InvalidParameter::new("restitution", "from 0 to 1", found));
        }
        Ok(())
    }

    fn values(&self) -> Vec<Value> {
        vec![Value::Number(self.gap), Value::Number(self.restitution)]
    }
}

impl ElementKind for Contact {
    const KIND: &'static str = "contact";
    const SUMMARY: &'static str = "pushes and never pulls: F = 0 or y = gap";
    const PARAMETERS: &'static [Parameter] = &[
        Parameter::optional(
            "gap",
            ParameterKind::Quantity(Dimension::LENGTH),
            "0 m",
            "deformation at which it closes [m], zero or positive",
        ),
        Parameter::optional(
            "restitution",
            ParameterKind::Quantity(Dimension::NUMBER),
            "0",
            "coefficient of restitution of an impact between masses, 0 to 1",
        ),
    ];

    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter> {
        let contact =
            Self { gap: number(values, 0, "gap")?, restitution: number(values, 1, "restitution")? };
        contact.validate().map(|()| contact)
    }

    fn sample() -> Self {
        Self { gap: 0.0, restitution: 0.0 }
    }
}
