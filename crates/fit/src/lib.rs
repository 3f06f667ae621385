//! From measurement to model: numbers of models from records of tests, with what the records cannot tell.
//!
//! [`linear`] finds the spectrum of a linear material. It reads no files and prints nothing.

pub mod linear;
pub mod nnls;
