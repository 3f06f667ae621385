//! The tests, one file each.

mod constant_rate;
mod creep;
mod creep_recovery;
mod load_hold_unload;
mod relaxation;
mod sweep;

pub use constant_rate::ConstantRate;
pub use creep::Creep;
pub use creep_recovery::CreepRecovery;
pub use load_hold_unload::LoadHoldUnload;
pub use relaxation::Relaxation;
pub use sweep::Sweep;

use super::{Note, RheometerError, Specimen};

/// How many times the slowest time a test goes on after the last change.
const LONG: f64 = 10.0;
/// How many times the slowest retardation time a force is held.
const HELD: f64 = 5.0;

/// Refuses to put a force on what bears none.
fn bears_force(protocol: &'static str, specimen: &Specimen) -> Result<(), RheometerError> {
    if specimen.linear().kelvin().is_some() {
        return Ok(());
    }
    let reason = "the model bears no force, so it would give way without end under any";
    Err(RheometerError::Impossible { protocol, reason })
}

/// Refuses to deform what is rigid.
fn deforms(protocol: &'static str, specimen: &Specimen) -> Result<(), RheometerError> {
    if specimen.linear().maxwell().is_some() {
        return Ok(());
    }
    let reason = "a rigid link does not deform, whatever the force";
    Err(RheometerError::Impossible { protocol, reason })
}

/// What is special about the model under a force step.
fn notes_under_force(specimen: &Specimen) -> Vec<Note> {
    let Some(form) = specimen.linear().kelvin() else { return Vec::new() };
    if specimen.linear().maxwell().is_none() {
        return vec![Note::NothingDeforms];
    }
    let mut notes = Vec::new();
    if form.spring_compliance() == 0.0 {
        notes.push(Note::NoInstantaneousDeformation);
    }
    if form.fluidity() > 0.0 {
        notes.push(Note::Flows);
    }
    notes
}
