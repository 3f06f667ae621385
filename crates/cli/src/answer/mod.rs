//! What a run of a scene has to say, before it becomes text, JSON, or a page.

pub(crate) mod comparison;
pub(crate) mod cost;
mod energy;
pub(crate) mod groups;
mod json;
mod measures;
mod page;
mod partial;
pub(crate) mod rheometer;
mod settings;
mod solving;
pub(crate) mod sweep;
pub(crate) mod thesis;
mod verdict;
pub(crate) mod vibration;
mod zero;

use std::{collections::HashMap, time::Duration};

use dashpot_analysis::{Difference, RunReport, differences};
use dashpot_scene::Scene;

use crate::{as_run::Changes, error::CliError};

pub(crate) use energy::energy_table;
pub(crate) use json::document;
pub(crate) use measures::{measures_table, measures_tables, notes};
pub(crate) use page::page;
pub(crate) use partial::estimate;
pub(crate) use solving::{reasons, solving_table};
pub(crate) use verdict::verdict;

/// A scene and its runs.
pub(crate) struct Answer {
    /// What was solved.
    pub(crate) scene: Scene,
    /// What the command line said in place of the scene.
    pub(crate) changes: Changes,
    /// The accuracy and the other settings with which each method was asked, in their order.
    pub(crate) asked: Vec<dashpot_analysis::SolveSettings>,
    /// The runs that went well, in the order of the methods; at least one.
    pub(crate) runs: Vec<RunReport>,
    /// What each of them took in all: solutions, measures and errors.
    pub(crate) elapsed: Vec<Duration>,
    /// The methods that failed, and why.
    pub(crate) failed: Vec<(String, CliError)>,
}

impl Answer {
    /// The scene's title, or the name of its file.
    pub(crate) fn title(&self) -> &str {
        title(&self.scene)
    }

    /// The most accurate run; of equals the first. `None` if no run went well.
    pub(crate) fn best(&self) -> Option<&RunReport> {
        let error = |run: &RunReport| run.worst_relative_error().unwrap_or(f64::INFINITY);
        self.runs.iter().min_by(|one, other| error(one).total_cmp(&error(other)))
    }

    /// All warnings, the most important first; those that not every run gives name their methods.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let mut said: Vec<(&str, Vec<&str>)> = Vec::new();
        let mut places = HashMap::new();
        for run in &self.runs {
            for warning in &run.warnings {
                let place = *places.entry(warning.as_str()).or_insert_with(|| {
                    said.push((warning.as_str(), Vec::new()));
                    said.len() - 1
                });
                said[place].1.push(run.solver.method);
            }
        }
        let text = |(warning, methods): (&str, Vec<&str>)| {
            if methods.len() == self.runs.len() {
                warning.to_owned()
            } else {
                format!("{}: {warning}", methods.join(", "))
            }
        };
        said.into_iter().map(text).collect()
    }

    /// How far the runs are apart in each measure: the largest difference from the first one.
    pub(crate) fn differences(&self) -> Vec<Difference> {
        let Some((first, others)) = self.runs.split_first() else { return Vec::new() };
        let mut largest: Vec<Difference> = Vec::new();
        for difference in others.iter().flat_map(|other| differences(first, other)) {
            match largest.iter_mut().find(|known| known.key == difference.key) {
                Some(known) => known.relative = known.relative.max(difference.relative),
                None => largest.push(difference),
            }
        }
        largest
    }
}

/// The scene's title, or the name of its file.
pub(crate) fn title(scene: &Scene) -> &str {
    scene.title.as_deref().or(scene.file.as_deref()).unwrap_or("a scene without title")
}
