//! Whether a network answers to a sine with a sine. All that must not be in it is looked for here.

use dashpot_network::{Assembly, Network, elements::Law, first_nonlinear};

use super::VibrationError;

/// Refuses a network with a part that is not linear, by the name of that part.
pub(super) fn require_linear(network: &Network) -> Result<(), VibrationError> {
    for connection in network.connections() {
        if let Some(element) = first_nonlinear(&connection.model) {
            return Err(VibrationError::NotLinear {
                part: format!("the element `{}`", connection.name),
                law: element.kind().to_owned(),
            });
        }
    }
    Ok(())
}

/// The same for what the network was compiled to, where an effect may have put in more: by the name
/// of that element.
pub(super) fn require_linear_system(assembly: &Assembly) -> Result<(), VibrationError> {
    if assembly.system.terms.is_empty() && assembly.switching.is_none() {
        return Ok(());
    }
    let is_linear = |law: Law| matches!(law, Law::Spring(_) | Law::Dashpot(_) | Law::Rigid);
    let found = assembly.connections.iter().find_map(|connection| {
        let mut own = assembly.primitives.get(connection.primitives.clone())?.iter();
        let primitive = own.find(|primitive| !is_linear(primitive.element.law()))?;
        Some((format!("the element `{}`", connection.name), primitive.element.kind().to_owned()))
    });
    let (part, law) = found.unwrap_or_else(|| ("the scene".to_owned(), "its equations".to_owned()));
    Err(VibrationError::NotLinear { part, law })
}
