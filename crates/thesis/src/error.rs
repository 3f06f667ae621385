//! What can go wrong.

use dashpot_analysis::{RunError, rheometer::RheometerError, similarity::SimilarityError};
use dashpot_network::NetworkErrors;
use dashpot_rheology::appendix_a::AppendixAError;
use thiserror::Error;

/// Why something was not recomputed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ThesisError {
    /// Groups that no padding has.
    #[error(transparent)]
    Similarity(#[from] SimilarityError),
    /// An impact that cannot be solved.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A test of the padding that cannot be made.
    #[error(transparent)]
    Rheometer(#[from] RheometerError),
    /// An equivalent model that does not exist.
    #[error(transparent)]
    EquivalentModel(#[from] AppendixAError),
}

impl From<NetworkErrors> for ThesisError {
    fn from(errors: NetworkErrors) -> Self {
        Self::Run(errors.into())
    }
}

impl From<dashpot_dae::SolveError> for ThesisError {
    fn from(error: dashpot_dae::SolveError) -> Self {
        Self::Run(error.into())
    }
}
