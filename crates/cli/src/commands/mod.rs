//! The verbs, one file each.

mod check;
mod completions;
mod convert;
mod explain;
mod list;
mod man;
mod new;
mod schema;

pub(crate) use check::{check, undefined};
pub(crate) use completions::completions;
pub(crate) use convert::convert;
pub(crate) use explain::explain;
pub(crate) use list::list;
pub(crate) use man::man;
pub(crate) use new::new;
pub(crate) use schema::schema;
