//! The virtual rheometer: a model tested alone, in closed form and by simulation.
//!
//! Each protocol of the register puts a force or a deformation on a model and looks at the answer,
//! twice: from the model object ([`dashpot_rheology::LinearModel`]) as a sum of modes, and from the
//! network of the model, which is compiled and solved without knowledge of the modes. The report
//! holds both, and how far they are apart.
//!
//! # Examples
//!
//! ```
//! use dashpot_analysis::rheometer::{DEFAULT_METHODS, Specimen, protocol};
//! use dashpot_network::{Model, elements::{Dashpot, Spring}, part};
//!
//! let maxwell = Model::series([part(Spring { stiffness: 2e6 }), part(Dashpot { damping: 4e3 })]);
//! let specimen = Specimen::new(&maxwell)?;
//! let report = protocol("relaxation", &[])?.run(&specimen, DEFAULT_METHODS)?;
//! assert!(report.largest_difference().unwrap() < 1e-12);
//! # Ok::<(), dashpot_analysis::rheometer::RheometerError>(())
//! ```

mod comparison;
mod error;
mod frequency;
mod given;
mod history;
mod peak;
mod protocols;
mod report;
mod response;
mod rig;
mod schedule;
mod shaking;
mod simulation;
mod specimen;
mod trial;

#[cfg(test)]
mod tests;

use std::fmt::Debug;

use dashpot_network::parameters::{InvalidParameter, Parameter, Value};

pub use error::RheometerError;
pub use protocols::{ConstantRate, Creep, CreepRecovery, LoadHoldUnload, Relaxation, Sweep};
pub use report::{Computation, Computed, Disagreement, Figure, RheometerReport, Series, Setting};
pub use specimen::Specimen;

/// The methods by which tests are simulated where nothing else is asked for.
pub const DEFAULT_METHODS: &[&str] = &["exact"];

/// A test of a model with all its settings.
///
/// Implemented for every [`ProtocolKind`]; this is the form in which tests are passed around.
pub trait Protocol: Debug {
    /// Word for the test, for instance `creep`.
    fn kind(&self) -> &'static str;

    /// Makes the test in closed form, and by each of the methods named in `methods`. A frequency
    /// sweep solves the equations of the network at each frequency instead, if any is named.
    ///
    /// # Errors
    ///
    /// Any [`RheometerError`] but those of names of protocols and parameters.
    fn run(&self, specimen: &Specimen, methods: &[&str])
    -> Result<RheometerReport, RheometerError>;
}

/// What a protocol says about itself.
pub trait ProtocolKind: Debug + Default + Sized + 'static {
    /// Word for the test on the command line.
    const KIND: &'static str;
    /// One line for a list: what is done, and what is looked at.
    const SUMMARY: &'static str;
    /// Its parameters, all optional; where the default is [`FROM_THE_MODEL`] it follows from the
    /// model's times.
    const PARAMETERS: &'static [Parameter];

    /// The test with these values, one for each of [`PARAMETERS`](Self::PARAMETERS); what is left
    /// out has its default.
    ///
    /// # Errors
    ///
    /// [`InvalidParameter`] when a value is out of range.
    fn from_values(values: &[Option<Value>]) -> Result<Self, InvalidParameter>;

    /// Makes the test; see [`Protocol::run`].
    ///
    /// # Errors
    ///
    /// As [`Protocol::run`].
    fn test(
        &self,
        specimen: &Specimen,
        methods: &[&str],
    ) -> Result<RheometerReport, RheometerError>;
}

/// The default of parameters that follow from the times of the model.
pub const FROM_THE_MODEL: &str = "from the model";

impl<P: ProtocolKind> Protocol for P {
    fn kind(&self) -> &'static str {
        P::KIND
    }

    fn run(
        &self,
        specimen: &Specimen,
        methods: &[&str],
    ) -> Result<RheometerReport, RheometerError> {
        self.test(specimen, methods)
    }
}

/// Sees every protocol.
pub trait ProtocolVisitor {
    /// Called once for each kind.
    fn visit<P: ProtocolKind>(&mut self);
}

/// Shows every protocol to `visitor`. **A new protocol is registered here.**
pub fn visit_protocols(visitor: &mut impl ProtocolVisitor) {
    visitor.visit::<Creep>();
    visitor.visit::<CreepRecovery>();
    visitor.visit::<LoadHoldUnload>();
    visitor.visit::<Relaxation>();
    visitor.visit::<ConstantRate>();
    visitor.visit::<Sweep>();
}

/// The test of the given word with these parameters, in SI units; what is left out has its default.
///
/// # Errors
///
/// [`RheometerError`] for a word or a name that is not known, and for a value out of its range.
pub fn protocol(kind: &str, given: &[(&str, f64)]) -> Result<Box<dyn Protocol>, RheometerError> {
    struct Find<'a> {
        kind: &'a str,
        given: &'a [(&'a str, f64)],
        known: Vec<&'static str>,
        found: Option<Result<Box<dyn Protocol>, RheometerError>>,
    }
    impl Find<'_> {
        fn make<P: ProtocolKind>(&self) -> Result<Box<dyn Protocol>, RheometerError> {
            let mut values = vec![None; P::PARAMETERS.len()];
            for &(name, value) in self.given {
                let Some(at) = P::PARAMETERS.iter().position(|known| known.name == name) else {
                    return Err(RheometerError::UnknownParameter {
                        protocol: P::KIND,
                        name: name.to_owned(),
                        known: P::PARAMETERS.iter().map(|known| known.name).collect(),
                    });
                };
                values[at] = Some(Value::Number(value));
            }
            Ok(Box::new(P::from_values(&values)?))
        }
    }
    impl ProtocolVisitor for Find<'_> {
        fn visit<P: ProtocolKind>(&mut self) {
            self.known.push(P::KIND);
            if P::KIND == self.kind {
                self.found = Some(self.make::<P>());
            }
        }
    }
    let mut find = Find { kind, given, known: Vec::new(), found: None };
    visit_protocols(&mut find);
    let Find { known, found, .. } = find;
    let unknown = || RheometerError::UnknownProtocol { name: kind.to_owned(), known };
    found.unwrap_or_else(|| Err(unknown()))
}
