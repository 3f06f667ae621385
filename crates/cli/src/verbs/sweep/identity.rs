//! What tells a sweep from others: where a folder has points of another one, it is said in what they differ.

use crate::error::shards::Difference;

use dashpot_analysis::sweep::{Column, Estimates};
use dashpot_scene::Scene;
use serde::{Deserialize, Serialize};

use super::{arguments::SweepArguments, words::name};
use crate::output::{VERSION, list};
use dashpot_studies::origin;

/// What a sweep was asked for, and of what.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Identity {
    /// In words, by what they are.
    asked: Vec<(String, String)>,
    /// Hashes of texts, by what they are.
    texts: Vec<(String, String)>,
}

impl Identity {
    pub(super) fn of(
        arguments: &SweepArguments,
        scene: &Scene,
        columns: &[Column],
        estimates: Estimates,
    ) -> Self {
        let own = arguments.in_words(estimates).into_iter();
        let measures = list(columns.iter().map(name)).join(", ");
        let limits = list(arguments.limits.limit.iter().map(|own| own.text.clone())).join(", ");
        let shard = arguments.shard.map_or("all".to_owned(), |own| own.to_string());
        let more = [
            ("measures", measures),
            ("limits", limits),
            ("shard", shard),
            ("version", VERSION.to_owned()),
        ];
        let asked = own.chain(more).map(|(name, own)| (name.to_owned(), own));
        let table = arguments.points.as_ref().map(|own| own.to_string_lossy());
        let table = table.and_then(|own| origin::of_file(&own, &crate::input::load));
        let table = table.map(|own| ("the table of designs".to_owned(), own));
        let files = origin::of_files(scene, &crate::input::load).into_iter();
        let files = files.map(|own| (format!("`{}`", own.file), own.sha256));
        let text = ("the scene".to_owned(), origin::of_text(scene));
        Self {
            asked: asked.collect(),
            texts: [text].into_iter().chain(files).chain(table).collect(),
        }
    }

    /// In what another sweep, which is `there`, differs.
    pub(super) fn differences(&self, there: &Self) -> Vec<Difference> {
        let missing = || "none".to_owned();
        let value = |all: &[(String, String)], name: &str| {
            let own = all.iter().find(|own| own.0 == name && !own.1.is_empty());
            own.map(|own| own.1.clone())
        };
        let names = |own: &[(String, String)], there: &[(String, String)]| {
            let mut names = list(own.iter().map(|own| own.0.clone()));
            let more = there.iter().filter(|(name, _)| own.iter().all(|own| own.0 != *name));
            names.extend(more.map(|own| own.0.clone()));
            names
        };
        let mut all = Vec::new();
        for what in names(&self.asked, &there.asked) {
            let (here, there) = (value(&self.asked, &what), value(&there.asked, &what));
            if here != there {
                let values = [there, here].map(|own| own.unwrap_or_else(missing));
                all.push(Difference { what, values: Some(values) });
            }
        }
        for what in names(&self.texts, &there.texts) {
            if value(&self.texts, &what) != value(&there.texts, &what) {
                all.push(Difference { what, values: None });
            }
        }
        all
    }
}
