//! The verbs, one file each.

mod check;
mod convert;
mod explain;
mod list;
mod printed;

pub(crate) use check::{check, undefined};
pub(crate) use convert::convert;
pub(crate) use explain::explain;
pub(crate) use list::list;
pub(crate) use printed::{completions, man, new, schema};
