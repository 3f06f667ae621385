//! From a model to a design: the best numbers within limits, what no pad can beat, and cushion curves.

pub mod cushion;
pub mod floor;
pub mod optimum;
mod shared;
