//! The virtual rheometer: a model tested alone, in closed form and by simulation.
//!
//! Each protocol of the register puts a force or a deformation on a model and looks at the answer, twice: from the
//! model object ([`dashpot_rheology::LinearModel`]) as a sum of modes, and from the network of the model, which is
//! compiled and solved without knowledge of the modes. The report holds both, and how far they are apart. A model that
//! is not linear has no modes: of it the report holds what the network gives, with its error.
//!
//! # Examples
//!
//! ```
//! use dashpot_analysis::rheometer::{Specimen, default_methods, protocol};
//! use dashpot_network::{Model, elements::{Dashpot, Spring}, part};
//!
//! let maxwell = Model::series([part(Spring { stiffness: 2e6 }), part(Dashpot { damping: 4e3 })]);
//! let specimen = Specimen::new(&maxwell)?;
//! let report = protocol("relaxation", &[])?.run(&specimen, &default_methods())?;
//! assert!(report.largest_difference().unwrap() < 1e-12);
//! # Ok::<(), dashpot_analysis::rheometer::RheometerError>(())
//! ```

mod answer;
mod cycle;
mod history;
mod lines;
mod note;
mod perturbation;
mod protocols;
mod report;
mod rig;
mod simulation;
mod solved;
mod specimen;
mod track;
mod trial;

#[cfg(test)]
mod tests;

use dashpot_dae::methods;
use dashpot_network::parameters::{Described, Kind, Registered, Value, registered};

pub use answer::Answer;
pub use history::Drive;
pub use note::RheometerError;
pub use note::{Note, Obstacle};
pub use protocols::{
    ConstantRate, Creep, CreepRecovery, LoadHoldUnload, LoadUnload, Relaxation, Sweep,
};
pub use report::{Computation, Computed, Disagreement, Figure, RheometerReport, Series, Setting};
pub use specimen::Specimen;

use crate::Choice;

/// What a test has found, or why it cannot be made.
pub type Tested = Result<RheometerReport, RheometerError>;

/// The methods by which tests of a linear model are simulated where nothing else is asked for.
pub fn default_methods() -> [Choice; 1] {
    [Choice::from(methods::Exact)]
}

/// The methods by which tests of this specimen are simulated where nothing else is asked for: `exact` for a
/// linear model, else the one that suits.
pub fn methods_for(specimen: &Specimen) -> [Choice; 1] {
    if specimen.linear().is_some() { default_methods() } else { [Choice::Auto] }
}

/// A test of a model with all its settings.
///
/// Implemented for every [`ProtocolKind`]; this is the form in which tests are passed around.
pub trait Protocol: Described {
    /// Makes the test in closed form, and by each of the `methods`. A frequency
    /// sweep solves the equations of the network at each frequency instead, if there is any.
    ///
    /// # Errors
    ///
    /// Any [`RheometerError`] but those of names of protocols and parameters.
    fn run(
        &self,
        specimen: &Specimen,
        methods: &[Choice],
    ) -> Result<RheometerReport, RheometerError>;
}

/// What a protocol says about itself. All its parameters are optional; where the default is
/// [`FROM_THE_MODEL`] it follows from the model's times.
pub trait ProtocolKind: Kind + Default {
    /// Makes the test; see [`Protocol::run`].
    ///
    /// # Errors
    ///
    /// As [`Protocol::run`].
    fn test(&self, specimen: &Specimen, methods: &[Choice]) -> Tested;
}

/// The default of parameters that follow from the times of the model.
pub const FROM_THE_MODEL: &str = "from the model";

impl<P: ProtocolKind> Protocol for P {
    fn run(
        &self,
        specimen: &Specimen,
        methods: &[Choice],
    ) -> Result<RheometerReport, RheometerError> {
        self.test(specimen, methods)
    }
}

/// A protocol in the register, stored as a test.
pub type ProtocolEntry = Registered<Box<dyn Protocol>>;

const fn entry<P: ProtocolKind>() -> ProtocolEntry {
    Registered::new::<P>(|values| Ok(Box::new(P::from_values(values)?)), ())
}

/// Every protocol. **A new protocol is registered here.**
pub static PROTOCOLS: &[ProtocolEntry] = &[
    entry::<Creep>(),
    entry::<CreepRecovery>(),
    entry::<LoadHoldUnload>(),
    entry::<Relaxation>(),
    entry::<ConstantRate>(),
    entry::<LoadUnload>(),
    entry::<Sweep>(),
];

/// The test of the given word with these parameters, in SI units; what is left out has its default.
///
/// # Errors
///
/// [`RheometerError`] for a word or a name that is not known, and for a value out of its range.
pub fn protocol(kind: &str, given: &[(&str, f64)]) -> Result<Box<dyn Protocol>, RheometerError> {
    let Some(own) = registered(PROTOCOLS, kind) else {
        let known = PROTOCOLS.iter().map(|own| own.word).collect();
        return Err(RheometerError::UnknownProtocol { name: kind.to_owned(), known });
    };
    let mut values = (own.sample)();
    for &(name, value) in given {
        let Some(at) = own.parameters.iter().position(|known| known.name == name) else {
            return Err(RheometerError::UnknownParameter {
                protocol: own.word,
                name: name.to_owned(),
                known: own.parameters.iter().map(|known| known.name).collect(),
            });
        };
        values[at] = Value::Number(value);
    }
    Ok((own.make)(&values)?)
}
