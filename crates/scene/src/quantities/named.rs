//! What names of values stand for.

use std::{cell::Cell, collections::HashMap};

use dashpot_units::Quantity;

use crate::text::source::Place;

/// The named values of one document.
pub(crate) type Values = HashMap<String, Known>;

/// What a name stands for.
#[derive(Debug)]
pub(crate) struct Known {
    /// The quantity, `None` where it is faulty.
    pub(crate) quantity: Option<Quantity>,
    /// Where it comes from in the end.
    pub(crate) definition: Option<Definition>,
    /// Whether something refers to it.
    pub(crate) is_used: Cell<bool>,
}

/// What stands for a name: a text or number, and its place.
#[derive(Debug, Clone)]
pub(crate) struct Definition {
    pub(crate) text: String,
    pub(crate) place: Place,
}
