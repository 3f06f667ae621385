//! The verbs, one file each.

mod check;
mod completions;
mod explain;
mod list;
mod new;
mod run;
mod schema;

pub(crate) use check::check;
pub(crate) use completions::completions;
pub(crate) use explain::explain;
pub(crate) use list::list;
pub(crate) use new::new;
pub(crate) use run::run;
pub(crate) use schema::schema;
