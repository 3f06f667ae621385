//! Quantities: numbers with units, named values, and the pads whose values they are.

pub(crate) mod arithmetic;
pub(crate) mod bare;
pub(crate) mod basis;
pub(crate) mod named;
pub(crate) mod plausible;
pub(crate) mod quantity;
pub(crate) mod scatter;
pub(crate) mod sizes;
pub(crate) mod values;
pub(crate) mod words;
