//! Dimensionless groups, similar scenes, and the laboratory test that stands for a real impact.
//!
//! A network has parameters in kilogram, metre and second. Three of them that are independent, the references, are
//! units for all: every other parameter over its product of powers of them is a number. By Buckingham's theorem `n`
//! parameters whose dimensions have the rank `r` have `n − r` such groups, and these alone say what the network does:
//! two networks of one structure whose groups are equal are similar, and their answers differ by a [`Scale`] only.

mod comparison;
mod four_parameter;
mod groups;
mod laboratory;
mod measured;
mod names;
mod scale;
mod views;
mod walk;

#[cfg(test)]
mod tests;

pub use comparison::{GroupPair, Similarity};
pub use four_parameter::{
    FourParameterGroups, FourParameterImpact, FourParameterPadding, FourParameterSupport,
    ImpactScales, Ranges,
};
pub use groups::{Group, Groups, Reference};
pub use groups::{Inventory, Quantity};
pub use laboratory::SimilarityError;
pub use laboratory::{Chosen, Laboratory, Wish};
pub use measured::{Alone, Measured, alone, measured, similar_settings};
pub use scale::{Scale, scaled};
