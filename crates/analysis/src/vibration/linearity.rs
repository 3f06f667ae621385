//! Whether a network answers to a sine with a sine. All that must not be in it is looked for here.

use dashpot_network::{Assembly, Network, first_nonlinear};

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

/// The same for what the network was compiled to, where an effect may have put in more.
pub(super) fn require_linear_system(assembly: &Assembly) -> Result<(), VibrationError> {
    let nonlinear = assembly.system.terms.len();
    if nonlinear == 0 {
        return Ok(());
    }
    Err(VibrationError::NotLinear {
        part: "the scene".to_owned(),
        law: format!("{nonlinear} terms of its equations"),
    })
}
