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

use dashpot_scene::Scene;

pub(crate) use self::{
    compare::compare, cost::cost, groups::groups, rheometer::rheometer, run::run, sweep::sweep,
    thesis::thesis, vibrate::vibrate,
};

pub(crate) use self::run::estimate;

/// The scene's title, or the name of its file.
pub(crate) fn title(scene: &Scene) -> &str {
    scene.title.as_deref().or(scene.file.as_deref()).unwrap_or("a scene without title")
}
