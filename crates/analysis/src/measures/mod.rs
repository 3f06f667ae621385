//! The register of measures: scalars read off a continuous solution, never off samples.

mod average_deceleration;
mod clip;
mod clip_3ms;
mod coefficient_of_restitution;
mod contact_time;
mod dri;
mod edi;
mod end_deformation;
mod end_position;
mod end_velocity;
mod energy;
mod energy_at_end;
mod hic;
mod hic_within;
mod impulse;
mod needs;
mod of_segments;
mod peak_acceleration;
mod peak_deformation;
mod peak_displacement;
mod peak_force;
mod peak_rate;
mod peak_strain;
mod peak_stress;
pub(crate) mod reading;
mod severity_index;
mod transmissibility;
mod transmitted_force;

use std::{fmt::Debug, sync::Arc};

use dashpot_network::parameters::{InvalidParameter, Parameter, ParameterKind, Value, WindowWish};

pub use average_deceleration::AverageDeceleration;
pub use clip::Clip;
pub use clip_3ms::Clip3ms;
pub use coefficient_of_restitution::CoefficientOfRestitution;
pub use contact_time::ContactTime;
pub use dri::Dri;
pub use edi::Edi;
pub use end_deformation::EndDeformation;
pub use end_position::EndPosition;
pub use end_velocity::EndVelocity;
pub use energy::Energy;
pub use energy_at_end::EnergyAtEnd;
pub use hic::Hic;
pub use hic_within::{Hic15, Hic36, HicWithin};
pub use impulse::Impulse;
pub(crate) use needs::MASSLESS;
pub use needs::Needs;
pub use peak_acceleration::PeakAcceleration;
pub use peak_deformation::PeakDeformation;
pub use peak_displacement::PeakDisplacement;
pub use peak_force::PeakForce;
pub use peak_rate::PeakRate;
pub(crate) use peak_strain::CRUSHED;
pub use peak_strain::PeakStrain;
pub use peak_stress::PeakStress;
pub use reading::Reading;
pub use severity_index::SeverityIndex;
pub use transmissibility::Transmissibility;
pub use transmitted_force::TransmittedForce;

use crate::{
    Solution,
    similarity::{Scale, scaled_values},
};

pub use dashpot_units::STANDARD_GRAVITY;

/// What a measure is a measure of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// An element between two nodes.
    Element,
    /// A node.
    Node,
}

/// A scalar that can be read off a solution.
///
/// Implemented for every [`MeasureKind`]; this is the form in which measures are stored.
pub trait Measure: Debug + Send + Sync {
    /// Word for the measure, for instance `peak-force`.
    fn kind(&self) -> &'static str;

    /// SI unit of the value.
    fn unit(&self) -> &'static str;

    /// What it is a measure of.
    fn applies_to(&self) -> Family;

    /// The parameters that it has.
    fn parameters(&self) -> &'static [Parameter];

    /// The parameters' values in the order of [`parameters`](Self::parameters).
    fn values(&self) -> Vec<Value>;

    /// What its target must have.
    fn needs(&self) -> Needs;

    /// The power of standard gravity over which its values are given.
    fn gravities(&self) -> f64;

    /// The measure that tells the same of a scene that is similar at this scale; `None` where there
    /// is none.
    fn of_similar(&self, scale: &Scale) -> Option<Arc<dyn Measure>>;

    /// Reads the measure off `solution` for the element or node number `target`.
    ///
    /// # Panics
    ///
    /// When the network has no such element or node.
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading;
}

/// What a measure kind says about itself.
pub trait MeasureKind: Debug + Default + Send + Sync + Sized + 'static {
    /// Word for the measure in scenes.
    const KIND: &'static str;
    /// One line for a list: what it is, and its unit.
    const SUMMARY: &'static str;
    /// SI unit of the value.
    const UNIT: &'static str;
    /// Its parameters, all optional.
    const PARAMETERS: &'static [Parameter] = WINDOW_ONLY;
    /// What it is a measure of.
    const APPLIES_TO: Family;
    /// What its target must have for it to have a value.
    const NEEDS: Needs = Needs::Nothing;
    /// Whether every run with an impactor reports it: for elements that touch one, or for impactors.
    const BY_DEFAULT: bool = false;
    /// Whether every run without an impactor reports it: for elements that touch a mass, or for
    /// free masses that an element touches. What needs an impact to be defined is left out.
    const WITHOUT_IMPACTOR: bool = Self::BY_DEFAULT;
    /// Whether every run reports it for the elements that are made of layers.
    const OF_LAYERS: bool = false;

    /// The measure with these values, one for each of [`PARAMETERS`](Self::PARAMETERS).
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is out of range.
    fn from_values(values: &[Value]) -> Result<Self, InvalidParameter>;

    /// The parameters' values in the order of [`PARAMETERS`](Self::PARAMETERS).
    fn values(&self) -> Vec<Value>;

    /// The power of standard gravity over which its values are given: 2.5 for `∫ (|a|/g0)^2.5 dt`. Its
    /// values times this power of it have the dimension that their unit and the power make up.
    fn gravities(&self) -> f64 {
        0.0
    }

    /// The measure that tells the same of a scene that is similar at this scale: its parameters times
    /// the factors of their dimensions. A measure with a time of its own has another kind for its
    /// counterpart, or none.
    fn of_similar(&self, scale: &Scale) -> Option<Arc<dyn Measure>> {
        let values = scaled_values(Self::PARAMETERS, &MeasureKind::values(self), scale)?;
        Self::from_values(&values).ok().map(|own| Arc::new(own) as Arc<dyn Measure>)
    }

    /// Reads the measure off `solution` for the element or node number `target`.
    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading;

    /// A valid example.
    fn sample() -> Self {
        Self::default()
    }
}

impl<M: MeasureKind> Measure for M {
    fn kind(&self) -> &'static str {
        M::KIND
    }

    fn unit(&self) -> &'static str {
        M::UNIT
    }

    fn applies_to(&self) -> Family {
        M::APPLIES_TO
    }

    fn parameters(&self) -> &'static [Parameter] {
        M::PARAMETERS
    }

    fn values(&self) -> Vec<Value> {
        MeasureKind::values(self)
    }

    fn needs(&self) -> Needs {
        M::NEEDS
    }

    fn gravities(&self) -> f64 {
        MeasureKind::gravities(self)
    }

    fn of_similar(&self, scale: &Scale) -> Option<Arc<dyn Measure>> {
        MeasureKind::of_similar(self, scale)
    }

    fn read(&self, solution: &Solution<'_>, target: usize) -> Reading {
        MeasureKind::read(self, solution, target)
    }
}

/// Sees every measure kind.
pub trait MeasureVisitor {
    /// Called once for each kind.
    fn visit<M: MeasureKind>(&mut self);
}

/// Shows every measure kind to `visitor`. **A new kind is registered here.**
pub fn visit_measures(visitor: &mut impl MeasureVisitor) {
    visitor.visit::<PeakForce>();
    visitor.visit::<PeakDeformation>();
    visitor.visit::<ContactTime>();
    visitor.visit::<Impulse>();
    visitor.visit::<Energy>();
    visitor.visit::<EnergyAtEnd>();
    visitor.visit::<PeakRate>();
    visitor.visit::<EndDeformation>();
    visitor.visit::<CoefficientOfRestitution>();
    visitor.visit::<PeakAcceleration>();
    visitor.visit::<SeverityIndex>();
    visitor.visit::<Hic15>();
    visitor.visit::<Hic36>();
    visitor.visit::<Hic>();
    visitor.visit::<Clip3ms>();
    visitor.visit::<Clip>();
    visitor.visit::<Edi>();
    visitor.visit::<Dri>();
    visitor.visit::<Transmissibility>();
    visitor.visit::<AverageDeceleration>();
    visitor.visit::<EndVelocity>();
    visitor.visit::<EndPosition>();
    visitor.visit::<PeakDisplacement>();
    visitor.visit::<PeakStress>();
    visitor.visit::<PeakStrain>();
    visitor.visit::<TransmittedForce>();
}

/// The measures of a family that every run reports, with or without an impactor, in the order of
/// the register.
pub fn by_default(family: Family, has_impactor: bool) -> Vec<Arc<dyn Measure>> {
    let mut collect =
        Collect { wanted: Wanted::Always { family, has_impactor }, found: Vec::new() };
    visit_measures(&mut collect);
    collect.found
}

/// The measures that every run reports for elements made of layers, besides those of all elements.
pub fn of_layers() -> Vec<Arc<dyn Measure>> {
    let mut collect = Collect { wanted: Wanted::OfLayers, found: Vec::new() };
    visit_measures(&mut collect);
    collect.found
}

/// Which measures are collected.
enum Wanted {
    Always { family: Family, has_impactor: bool },
    OfLayers,
}

struct Collect {
    wanted: Wanted,
    found: Vec<Arc<dyn Measure>>,
}

impl MeasureVisitor for Collect {
    fn visit<M: MeasureKind>(&mut self) {
        let is_wanted = match self.wanted {
            Wanted::Always { family, has_impactor } => {
                let reported = if has_impactor { M::BY_DEFAULT } else { M::WITHOUT_IMPACTOR };
                reported && M::APPLIES_TO == family
            }
            Wanted::OfLayers => M::OF_LAYERS,
        };
        if is_wanted {
            self.found.push(Arc::new(M::default()));
        }
    }
}

/// Note on a measure of the force of a rigid link in a loop of rigid links.
const UNDETERMINED_FORCE: &str = "the force is undetermined in a loop of rigid links";
/// Note on a measure of a velocity that is not a function of time.
const NO_VELOCITY: &str = "the velocity of this massless node jumps with the loads' rates";

/// The `window` parameter of a measure of the impact.
const WINDOW: Parameter = Parameter::optional(
    "window",
    ParameterKind::Window,
    "impact",
    "`impact`, `run`, or a pair of times [s]",
);

/// The same of a measure whose largest value may come after the impact.
const WHOLE_RUN: Parameter =
    Parameter::optional("window", ParameterKind::Window, "run", WINDOW.help);

/// The parameters of a measure that has no other.
const WINDOW_ONLY: &[Parameter] = &[WINDOW];

/// The window at `at`, for [`MeasureKind::from_values`].
fn window(values: &[Value], at: usize) -> Result<WindowWish, InvalidParameter> {
    let invalid =
        |found: &str| InvalidParameter::new("window", "`impact`, `run` or a pair of times", found);
    let Some(Value::Window(window)) = values.get(at) else {
        return Err(invalid("missing"));
    };
    match *window {
        WindowWish::Times(from, to) if !(from.is_finite() && to.is_finite() && from < to) => {
            Err(InvalidParameter::new(
                "window",
                "a pair of times, the earlier one first",
                format!("{from} s to {to} s"),
            ))
        }
        window => Ok(window),
    }
}

#[cfg(test)]
mod tests;
