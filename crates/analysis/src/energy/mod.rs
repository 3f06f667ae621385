//! Where energy comes from, where it is, and where it goes.

pub mod ledger;
pub(crate) mod roles;
