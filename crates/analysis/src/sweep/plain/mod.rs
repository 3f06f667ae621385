//! Plain impacts: one mass strikes a pad whose laws are not all linear, and is let go.
//!
//! The form of the network is instantiated, followed in explicit steps until the force falls through
//! zero, and measures, with their bars, are read off these steps. What becomes of the pad behind that is followed
//! likewise, to see that it does not meet again what has left it. What turns out not to be plain is solved in full.

pub(super) mod aftermath;
pub(super) mod bars;
pub(super) mod shown;
pub(super) mod stepped;

/// The largest number of unknowns that are instantiated.
pub(super) const MOST_STATES: usize = 12;
