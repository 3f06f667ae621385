//! How much memory models take, foreseen before they are expanded.

/// What a part or composition of a model takes in all that is made of it until it is solved \[B\]: a spring
/// side by side with others 1000, one in a row with them 2300.
pub const PART_BYTES: u64 = 2000;

/// Models that take more are refused \[B\].
pub const MOST_BYTES: u64 = 8_000_000_000;
