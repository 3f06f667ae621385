//! Measures that are asked for by their keys.

use dashpot_network::Assembly;

use super::selection::{select, wish};
use crate::{RunError, SolveSettings};

/// Asks for the measures of these keys, as far as they are not reported anyway.
///
/// # Errors
///
/// A key of no measure, and what [`SolveSettings`] ask for and the network does not have.
pub fn ask(
    assembly: &Assembly,
    settings: &mut SolveSettings,
    keys: &[String],
) -> Result<(), RunError> {
    let reported = select(assembly, &settings.measures, &settings.limits)?;
    for key in keys.iter().filter(|key| !reported.iter().any(|own| own.key == **key)) {
        let known = || reported.iter().map(|own| own.key.clone()).collect();
        let wish =
            wish(key).ok_or_else(|| RunError::NoMeasure { key: key.clone(), known: known() });
        settings.measures.push(wish?);
    }
    Ok(())
}
