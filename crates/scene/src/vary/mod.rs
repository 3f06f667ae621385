//! The numbers of a scene that a sweep may give other values.

pub(crate) mod listed;
mod sample;
pub(crate) mod tunable;
pub(crate) mod variation;
