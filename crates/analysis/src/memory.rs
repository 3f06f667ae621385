//! How much memory a run takes, foreseen before it is solved.

use dashpot_network::{
    Assembly,
    memory::{MOST_BYTES, PART_BYTES},
};

use crate::RunError;

/// What solving takes for each unknown \[B\]: the vectors of a method with steps, a row of the matrix, its
/// place and its factors within a band.
const UNKNOWN_BYTES: u64 = 1000;

/// Unknowns beyond which a stepping method keeps a part of the solution only. Below, nothing is left out.
pub(crate) const LARGE: usize = 1000;

/// Whether only a part of the solutions of a network is kept. What switches is kept as a whole.
pub(crate) fn is_large(assembly: &Assembly) -> bool {
    assembly.switching.is_none() && assembly.system.len() > LARGE
}

/// Refuses a network that takes more memory than a run may, with what is made of its parts and what solving takes.
/// Errors: [`RunError::TooMuchMemory`].
pub(crate) fn foresee(assembly: &Assembly) -> Result<(), RunError> {
    refuse_beyond(MOST_BYTES, assembly.primitives.len() as u64, assembly.system.len() as u64)
}

fn refuse_beyond(limit: u64, parts: u64, unknowns: u64) -> Result<(), RunError> {
    let bytes = parts.saturating_mul(PART_BYTES).saturating_add(unknowns * UNKNOWN_BYTES);
    if bytes <= limit {
        return Ok(());
    }
    Err(RunError::TooMuchMemory { parts, unknowns, bytes, limit })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_more_than_a_run_may_is_refused_by_its_memory() {
        // A million masses on springs and dashpots.
        assert_eq!(refuse_beyond(MOST_BYTES, 2_000_000, 2_000_000), Ok(()));
        let error = refuse_beyond(MOST_BYTES, 3_000_000, 3_000_000).unwrap_err();
        let bytes = 9_000_000_000;
        let (parts, unknowns, limit) = (3_000_000, 3_000_000, MOST_BYTES);
        assert_eq!(error, RunError::TooMuchMemory { parts, unknowns, bytes, limit });
        assert_eq!(
            error.to_string(),
            "3000000 parts with 3000000 unknowns take some 9.0 GB to be solved, and a run may take 8.0; join \
             parts that are alike, or use fewer masses"
        );
    }
}
