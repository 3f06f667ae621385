//! The verbs that find something out: how each is asked, and what it states as a
//! [`Study`](crate::output::Study).

mod compare;
mod cost;
mod groups;
mod rheometer;
mod run;
mod sweep;
mod thesis;
mod vibrate;

pub(crate) use self::{
    compare::compare, cost::cost, groups::groups, rheometer::rheometer, run::run, sweep::sweep,
    thesis::thesis, vibrate::vibrate,
};
