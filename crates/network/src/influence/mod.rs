//! How much the details of a network matter, as dimensionless numbers, and networks without them.
//!
//! A number is an estimate of the part by which a detail changes what is felt, from scales alone:
//! nothing is solved. The scales are those of [`Situation`](crate::Situation).

mod detail;
mod situation;

#[cfg(test)]
mod tests;

pub use self::detail::Detail;
