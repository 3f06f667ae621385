//! Scattered designs around a scene whose numbers have other values than its text.

use dashpot_analysis::{SolveSettings, sweep::ScenePoint};
use dashpot_scene::{Sample, Scene, Tunables, read};

use crate::input::AsCommanded as _;
use crate::{
    error::{CliError, StudyError},
    input::Input,
    varied::Varied,
    verbs::run::scatter::{self, ScatterArguments},
};

/// A sample around a scene.
pub(crate) struct Around {
    pub(crate) scene: Scene,
    pub(crate) sample: Sample,
    /// What is set from outside and has no scatter.
    pub(crate) plain: Vec<(String, String)>,
}

impl Around {
    /// A sample around the scene of a text; none where no number has scatter that does anything. Numbers that the sample
    /// of another scene has as well are drawn as there.
    pub(crate) fn of(
        text: &str,
        (input, set): (&Input, &[(String, String)]),
        arguments: ScatterArguments,
        beside: Option<&Sample>,
    ) -> Result<Option<Self>, CliError> {
        let scene = read(text, &input.options(set)).map_err(StudyError::Scene)?.value;
        let plain = scatter::plainly_set(&scene, set);
        let sample = scatter::drawn(&scene, arguments, &plain, beside)?;
        Ok(sample.map(|sample| Self { scene, sample, plain }))
    }

    /// Its designs, with the settings of a run.
    pub(crate) fn designs(&self, settings: &SolveSettings) -> Result<Vec<ScenePoint>, String> {
        let one =
            |at: usize| scatter::design(&self.scene, &self.sample, at, (settings, &self.plain));
        (0..self.sample.len()).map(one).collect()
    }
}

/// A number with the scatter that it has in a scene: the same part of it where that is in percent, else as much.
pub(crate) fn with_scatter(
    (scene, tunables): (&Scene, &Tunables),
    (own, at): (&Varied, usize),
    value: f64,
) -> Option<String> {
    let path = &tunables.all()[at].path;
    let scatter = scene.scatter.iter().find(|own| own.path == *path && !own.is_together)?;
    let is_part = tunables.shown(at).trim_end().ends_with('%') && own.unit != "%";
    let part = if is_part { value / scatter.mean } else { 1.0 };
    let [mean, deviation] = [value, scatter.deviation * part].map(|of| own.written(of));
    Some(if own.unit == "%" {
        let [mean, deviation] = [&mean, &deviation].map(|own| own.trim_end_matches([' ', '%']));
        format!("({mean} ± {deviation}) %")
    } else {
        format!("{mean} ± {deviation}")
    })
}
