//! Numerics that know nothing of what their numbers stand for.
//!
//! - [`DoubleDouble`] and [`Accumulator`]: double-double arithmetic, for what doubles cannot tell apart;
//! - [`chebyshev`]: polynomials, their zeros and their interpolation;
//! - [`dop853`]: an explicit method of order 8;
//! - [`quadrature`]: rules of Gauss and Legendre, and of Gauss and Kronrod on halved intervals;
//! - [`roots`] and [`extrema`]: bisection, bracketed Newton steps, false position, golden section;
//! - [`isotonic`]: the nearest sequence that never falls;
//! - [`normal`]: the normal distribution and its quantiles;
//! - [`Stream`]: numbers that look random;
//! - [`decompositions`]: Schur form, eigenvalues and singular values, with limits of their steps;
//! - [`small`] and [`exponential`]: matrices on the stack, exponentials of any real matrix;
//! - [`LinearForm`]: sparse linear forms.

mod accumulator;
pub mod chebyshev;
pub mod decompositions;
pub mod dop853;
mod double_double;
pub mod exponential;
pub mod extrema;
pub mod isotonic;
mod linear_form;
pub mod normal;
pub mod quadrature;
mod random;
pub mod roots;
pub mod small;

pub use accumulator::Accumulator;
pub use double_double::{DoubleDouble, two_product, two_sum};
pub use linear_form::{Coefficient, FormRef, Forms, LinearForm, packed};
pub use random::Stream;
