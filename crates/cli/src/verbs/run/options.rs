//! What may be said of a run in place of its scene.

use dashpot_analysis::{Accuracy, RunError, SolveSettings, ask};
use dashpot_scene::Scene;

use super::{RunArguments, scatter::ScatterArguments};
use crate::args::Switch;

/// What is asked of a run in place of what its scene says.
#[derive(Debug, Clone, Default)]
pub struct RunOptions {
    /// Accuracy of every measure, relative.
    pub accuracy: Option<f64>,
    /// Leaves out what moves no measure by more than this, relative.
    pub neglect: Option<f64>,
    /// The method's own relative tolerance, in place of the search for one.
    pub rtol: Option<f64>,
    /// Errors are not estimated.
    pub without_errors: bool,
    /// Most work, in units of a step of one unknown.
    pub budget: Option<u64>,
    /// Measures by their keys, besides those of the scene.
    pub measures: Vec<String>,
    /// What is drawn of numbers with scatter.
    pub sample: ScatterArguments,
    /// Tells what no pad can beat.
    pub floor: bool,
}

impl RunOptions {
    pub(super) fn of(arguments: &RunArguments) -> Self {
        Self {
            accuracy: arguments.accuracy,
            neglect: arguments.neglect,
            rtol: arguments.rtol,
            without_errors: arguments.estimate == Switch::Off,
            budget: arguments.budget.map(|budget| budget.0),
            measures: arguments.measure.clone(),
            sample: arguments.scatter,
            floor: arguments.floor,
        }
    }

    /// The settings of a run of this scene by the method of this name.
    ///
    /// # Errors
    ///
    /// A method or a measure that there is not.
    pub fn settings(&self, scene: &Scene, method: &str) -> Result<SolveSettings, RunError> {
        let mut settings = scene.settings(method)?;
        settings.estimate = !self.without_errors;
        settings.budget = self.budget.unwrap_or(settings.budget);
        settings.rtol = self.rtol.or(settings.rtol);
        if let Some(accuracy) = self.accuracy {
            let neglect_below = settings.accuracy.neglect_below;
            settings.accuracy = Accuracy { neglect_below, ..Accuracy::of_all(accuracy) };
            // A tolerance of the scene would keep the accuracy from being sought.
            settings.rtol = None;
        }
        settings.accuracy.neglect_below = self.neglect.or(settings.accuracy.neglect_below);
        // Of none nothing is to be looked for.
        if !self.measures.is_empty() {
            ask(&scene.assembly, &mut settings, &self.measures)?;
        }
        Ok(settings)
    }
}
