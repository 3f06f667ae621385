//! Numerics that know nothing of what their numbers stand for.
//!
//! - [`Twofold`] and [`Accumulator`]: double-double arithmetic, for what doubles cannot tell apart;
//! - [`chebyshev`]: polynomials, their zeros and their interpolation;
//! - [`quadrature`]: rules of Gauss and Legendre, and of Gauss and Kronrod on halved intervals;
//! - [`roots`] and [`extrema`]: bisection, bracketed Newton steps, false position, golden section;
//! - [`small`] and [`exponential`]: matrices on the stack, exponentials of any real matrix;
//! - [`LinearForm`]: sparse linear forms.

mod accumulator;
pub mod chebyshev;
pub mod exponential;
pub mod extrema;
mod linear_form;
pub mod quadrature;
pub mod roots;
pub mod small;
mod twofold;

pub use accumulator::Accumulator;
pub use linear_form::{Coefficient, FormRef, Forms, LinearForm, packed};
pub use twofold::{Twofold, two_product, two_sum};
