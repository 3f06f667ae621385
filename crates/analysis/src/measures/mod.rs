//! The register of measures: scalars read off a continuous solution, never off samples.

/// Declares a measure of which the part of the run that it looks at is the one parameter.
macro_rules! windowed {
    ($(#[$note:meta])* $name:ident: $kind:literal, $summary:literal) => {
        dashpot_network::parameters! {
            $(#[$note])*
            #[derive(Debug, Clone, Copy, PartialEq, Default)]
            pub struct $name: $kind, $summary {
                /// The part of the run that it looks at.
                pub window: dashpot_network::parameters::WindowWish => $crate::measures::WINDOW;
            }
        }
    };
}

pub(crate) mod asked;
pub(crate) mod exceedance;
pub mod hic_search;
pub(crate) mod powers;
pub(crate) mod selection;

mod contact;
mod driven;
mod energy;
mod injury;
mod integrals;
mod peaks;
mod reading;
mod response_index;
mod segments;
mod transmitted;

use std::sync::Arc;

use dashpot_network::{
    Assembly,
    parameters::{Described, InvalidParameter, Kind, Parameter, ParameterKind, Registered, Value},
};
pub use dashpot_units::STANDARD_GRAVITY;

pub(crate) use self::contact::NO_APPROACH;
pub use self::{
    contact::{CoefficientOfRestitution, ContactTime},
    energy::{Energy, EnergyAtEnd},
    exceedance::{Clip, Clip3ms, Exceedance, Level},
    injury::{Hic, Hic15, Hic36, SeverityIndex},
    integrals::{AverageDeceleration, Impulse},
    peaks::{
        EndDeformation, EndForce, EndPosition, EndVelocity, PeakAcceleration, PeakDeformation,
        PeakDisplacement, PeakForce, PeakRate, PeakVelocity,
    },
    reading::Reading,
    response_index::{Dri, Edi},
    segments::{PeakStrain, PeakStress},
    transmitted::{Transmissibility, TransmittedForce},
};
use crate::{Note, Solution};

/// What a measure is a measure of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// An element between two nodes.
    Element,
    /// A node.
    Node,
}

/// What an element or node must have so that a measure of it can have a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Needs {
    /// Nothing that others of its family lack.
    Nothing,
    /// An acceleration that an accelerometer reads, as every free mass has.
    Acceleration,
    /// A thickness, of the whole element or of a part of it.
    Thickness,
    /// An area, of the whole element or of a part of it.
    Area,
}

impl Needs {
    /// Why the element or node number `target` can have no value; `None` where it can.
    pub(crate) fn lacking(self, assembly: &Assembly, target: usize) -> Option<Note> {
        match self {
            Self::Nothing => None,
            Self::Acceleration => {
                assembly.nodes[target].acceleration.is_none().then_some(Note::Massless)
            }
            Self::Thickness => {
                assembly.connections[target].segments.is_empty().then_some(Note::NoThickness)
            }
            Self::Area => {
                let segments = &assembly.connections[target].segments;
                segments.iter().all(|segment| segment.area.is_none()).then_some(Note::NoArea)
            }
        }
    }
}

/// A scalar that can be read off a solution.
///
/// Implemented for every [`MeasureKind`]; this is the form in which measures are stored.
pub trait Measure: Described {
    /// SI unit of the value.
    fn unit(&self) -> &'static str;

    /// What it is a measure of.
    fn applies_to(&self) -> Family;

    /// What its target must have.
    fn needs(&self) -> Needs;

    /// The power of standard gravity over which its values are given.
    fn gravities(&self) -> f64;

    /// The measure that tells the same and has all its own times among its parameters; see
    /// [`MeasureKind::general`].
    fn general(&self) -> Option<Arc<dyn Measure>>;

    /// The measure of the same kind with these values, one for each parameter.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is missing or out of range.
    fn with_values(&self, values: &[Value]) -> Result<Arc<dyn Measure>, InvalidParameter>;

    /// Reads the measure off `solution` for the element or node number `target`; where it has no value, a
    /// note says why.
    ///
    /// # Panics
    ///
    /// When the network has no such element or node.
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading;
}

/// What a measure kind says about itself. All its parameters are optional.
pub trait MeasureKind: Kind + Default {
    /// What the register says of it.
    const ABOUT: MeasureTraits;

    /// The power of standard gravity over which its values are given: 2.5 for `∫ (|a|/g0)^2.5 dt`. Its
    /// values times this power of it have the dimension that their unit and the power make up.
    fn gravities(&self) -> f64 {
        0.0
    }

    /// The measure that tells the same and has all its own times among its parameters, which a scene of
    /// another scale has otherwise: itself, or for a kind with a fixed time one of another kind. `None`
    /// where no kind has its time for a parameter.
    fn general(&self) -> Option<Arc<dyn Measure>> {
        Self::from_values(&self.values())
            .ok()
            .map(|from_value| Arc::new(from_value) as Arc<dyn Measure>)
    }

    /// Reads the measure off `solution` for the element or node number `target`.
    ///
    /// # Errors
    ///
    /// Why it has no value.
    fn read(&self, solution: &Solution<'_>, target: usize) -> Result<Reading, Note>;
}

impl<M: MeasureKind> Measure for M {
    fn unit(&self) -> &'static str {
        M::ABOUT.unit
    }

    fn applies_to(&self) -> Family {
        M::ABOUT.family
    }

    fn needs(&self) -> Needs {
        M::ABOUT.needs
    }

    fn gravities(&self) -> f64 {
        MeasureKind::gravities(self)
    }

    fn general(&self) -> Option<Arc<dyn Measure>> {
        MeasureKind::general(self)
    }

    fn with_values(&self, values: &[Value]) -> Result<Arc<dyn Measure>, InvalidParameter> {
        Ok(Arc::new(M::from_values(values)?))
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        MeasureKind::read(self, solution, target).unwrap_or_else(Reading::undefined)
    }
}

/// What the register says of a measure besides how it is made.
#[derive(Debug, Clone, Copy)]
pub struct MeasureTraits {
    /// SI unit of the value.
    pub unit: &'static str,
    /// What it is a measure of.
    pub family: Family,
    /// What its target must have for it to have a value.
    pub needs: Needs,
    /// The measure with all parameters as they are by default.
    pub default: fn() -> Arc<dyn Measure>,
    /// Whether every run with an impactor reports it: for elements that touch one, or for impactors.
    pub by_default: bool,
    /// Whether every run without an impactor reports it: for elements that touch a mass, or for
    /// free masses that an element touches. What needs an impact to be defined is left out.
    pub without_impactor: bool,
    /// Whether every run reports it for the elements that are made of layers.
    pub of_layers: bool,
}

impl MeasureTraits {
    /// Whether it is the work that an element takes up.
    pub(crate) fn is_work_of_element(&self) -> bool {
        self.family == Family::Element && self.unit == "J"
    }

    const fn of<M: MeasureKind>(unit: &'static str, family: Family, needs: Needs) -> Self {
        let (by_default, without_impactor, of_layers) = (false, false, false);
        let default = || Arc::new(M::default()) as Arc<dyn Measure>;
        Self { unit, family, needs, default, by_default, without_impactor, of_layers }
    }

    /// Those of a measure of elements in this SI unit, which only those who ask for it are told.
    pub const fn of_element<M: MeasureKind>(unit: &'static str) -> Self {
        Self::of::<M>(unit, Family::Element, Needs::Nothing)
    }

    /// The same of nodes.
    pub const fn of_node<M: MeasureKind>(unit: &'static str) -> Self {
        Self::of::<M>(unit, Family::Node, Needs::Nothing)
    }

    /// The same of nodes with an acceleration.
    pub const fn of_body<M: MeasureKind>(unit: &'static str) -> Self {
        Self::of::<M>(unit, Family::Node, Needs::Acceleration)
    }

    /// Every run reports it.
    pub(crate) const fn by_default(self) -> Self {
        Self { by_default: true, without_impactor: true, ..self }
    }

    /// Every run with an impactor reports it.
    pub(crate) const fn of_impacts(self) -> Self {
        Self { by_default: true, ..self }
    }
}

/// A measure in the register.
pub type MeasureEntry = Registered<Arc<dyn Measure>, MeasureTraits>;

const fn measure<M: MeasureKind>() -> MeasureEntry {
    Registered::new::<M>(|values| Ok(Arc::new(M::from_values(values)?)), M::ABOUT)
}

/// Every measure kind. **A new kind is registered here.**
pub static MEASURES: &[MeasureEntry] = &[
    measure::<PeakForce>(),
    measure::<PeakDeformation>(),
    measure::<ContactTime>(),
    measure::<Impulse>(),
    measure::<Energy>(),
    measure::<EnergyAtEnd>(),
    measure::<PeakRate>(),
    measure::<EndDeformation>(),
    measure::<EndForce>(),
    measure::<CoefficientOfRestitution>(),
    measure::<PeakAcceleration>(),
    measure::<SeverityIndex>(),
    measure::<Hic15>(),
    measure::<Hic36>(),
    measure::<Hic>(),
    measure::<Clip3ms>(),
    measure::<Clip>(),
    measure::<Edi>(),
    measure::<Dri>(),
    measure::<Transmissibility>(),
    measure::<AverageDeceleration>(),
    measure::<EndVelocity>(),
    measure::<EndPosition>(),
    measure::<PeakDisplacement>(),
    measure::<PeakVelocity>(),
    measure::<PeakStress>(),
    measure::<PeakStrain>(),
    measure::<TransmittedForce>(),
];

/// The measures of a family that every run reports, with or without an impactor, in the order of the register.
pub fn by_default(family: Family, has_impactor: bool) -> Vec<Arc<dyn Measure>> {
    let is_reported = |measure_traits: &MeasureTraits| {
        if has_impactor { measure_traits.by_default } else { measure_traits.without_impactor }
    };
    let all = MEASURES.iter().map(|own| own.about);
    all.filter(|own| own.family == family && is_reported(own)).map(|own| (own.default)()).collect()
}

/// The measures that every run reports for elements made of layers, besides those of all elements.
pub fn of_layers() -> Vec<Arc<dyn Measure>> {
    let all = MEASURES.iter().filter(|own| own.about.of_layers);
    all.map(|own| (own.about.default)()).collect()
}

/// The `window` parameter of a measure of the impact.
pub const WINDOW: Parameter =
    Parameter::new("window", ParameterKind::Window, "`impact`, `run`, or a pair of times [s]")
        .default("impact");

/// The same of a measure whose largest value may come after the impact.
pub const WHOLE_RUN: Parameter = WINDOW.default("run");

#[cfg(test)]
mod tests;
