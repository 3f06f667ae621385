//! The verbs, one file each.

mod check;
mod compare;
mod completions;
mod convert;
mod cost;
mod explain;
mod groups;
mod list;
mod new;
mod rheometer;
mod run;
mod schema;
mod sweep;
mod thesis;
mod vibrate;

pub(crate) use check::check;
pub(crate) use compare::compare;
pub(crate) use completions::completions;
pub(crate) use convert::convert;
pub(crate) use cost::cost;
pub(crate) use explain::explain;
pub(crate) use groups::groups;
pub(crate) use list::list;
pub(crate) use new::new;
pub(crate) use rheometer::rheometer;
pub(crate) use run::run;
pub(crate) use schema::schema;
pub(crate) use sweep::sweep;
pub(crate) use thesis::thesis;
pub(crate) use vibrate::vibrate;
