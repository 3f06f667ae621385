//! From a model to a design: the best numbers within limits, and what no pad can beat.

pub mod floor;
pub mod optimum;
