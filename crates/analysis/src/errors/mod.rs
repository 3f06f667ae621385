//! How wrong a number is, and as many solutions as it takes to know.

pub(crate) mod accuracy;
pub(crate) mod instants;
pub(crate) mod open_ends;
pub(crate) mod refinement;
pub(crate) mod solved;
