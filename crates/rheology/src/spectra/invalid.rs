//! What makes a spectrum impossible.

use thiserror::Error;

/// A parameter of a spectrum is out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("`{parameter}` must be {range}, but it is {value}")]
pub struct InvalidSpectrum {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Its range in words.
    pub range: &'static str,
    /// What was given.
    pub value: f64,
}

/// Refuses what is not above zero and finite.
pub(super) fn positive(parameter: &'static str, value: f64) -> Result<(), InvalidSpectrum> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(InvalidSpectrum { parameter, range: "positive and finite", value })
    }
}
