//! From measurement to model: numbers of models from records of tests, with what the records cannot tell.
//!
//! [`linear`] finds the spectrum of a linear material, [`network`] any numbers of any model; [`structure`] knows which
//! of them no test can tell apart. It reads no files, solves no scene and prints nothing.

pub mod among;
pub mod linear;
pub mod network;
pub mod nnls;
pub mod optimum;
pub mod structure;
mod student;
