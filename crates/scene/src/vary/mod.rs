//! The numbers and words of a scene that may have other values: set, or varied in sweeps.

mod filled;
pub(crate) mod listed;
mod sample;
pub(crate) mod scatter;
pub(crate) mod scattered;
pub(crate) mod set;
pub(crate) mod together;
pub(crate) mod tunable;
pub(crate) mod variation;
