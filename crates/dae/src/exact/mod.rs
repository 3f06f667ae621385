//! The exact solution of `ẏ = A y + B w(t)`.
//!
//! Cubics and sines of time obey linear equations of their own, so between two breakpoints the
//! unknowns together with those *generators* are `ż = Ā z`, `z(t) = e^{Ā t} z(0)`
//! ([`augmented`]). Two evaluations of that exponential are kept, which share no arithmetic:
//!
//! - the propagator ([`propagator`]): `z_{k+1} = e^{Ā Δt} z_k` on uniform grids;
//! - the modal form ([`modes`]): `z(t) = X e^{D t} X⁻¹ z(0)` with block-diagonal `D`, which gives
//!   every output as a sum of modes and from it, with a rigorous bound of the interpolation error,
//!   a piecewise polynomial ([`panels`], which outputs of small systems share, [`stations`]).

mod augmented;
mod balance;
mod block;
mod bounds;
mod components;
mod coordinates;
mod decomposition;
mod decoupling;
mod generators;
mod modal_row;
mod modes;
mod panels;
mod propagator;
mod refinement;
mod schur;
mod solution;
mod stations;
mod tables;

#[cfg(test)]
mod tests;

pub(crate) use augmented::Augmented;
pub use decomposition::Shared;
pub(crate) use solution::Solution;

/// A complex number.
type Complex = nalgebra::Complex<f64>;
