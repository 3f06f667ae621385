//! How much the details of a network matter, as dimensionless numbers, and networks without them.
//!
//! A number is an estimate of the part by which a detail changes what is felt, from scales alone:
//! nothing is solved. The scales are those of [`Situation`].

mod depth;
mod detail;
mod situation;

#[cfg(test)]
mod tests;

pub use self::{
    detail::Detail,
    situation::{ImpactScales, Situation},
};

/// A dimensionless number that measures how much a detail of a network matters.
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// What it is, as a formula, for instance `A = g δ/V0²`.
    pub formula: String,
    /// Its value \[1\], ≥ 0; the detail matters little where it is far below 1.
    pub value: f64,
}

impl Influence {
    /// The number of this formula.
    pub fn new(formula: impl Into<String>, value: f64) -> Self {
        Self { formula: formula.into(), value }
    }

    /// The largest of several.
    pub fn largest(all: Vec<Self>) -> Option<Self> {
        all.into_iter().max_by(|one, other| one.value.total_cmp(&other.value))
    }

    /// The part of `reach` that lies beyond `limit`, both ≥ 0: `1 − limit/reach`, 0 where the limit
    /// is not reached.
    pub(crate) fn beyond(formula: impl Into<String>, reach: f64, limit: f64) -> Self {
        Self::new(formula, if reach > limit { 1.0 - limit / reach } else { 0.0 })
    }
}
