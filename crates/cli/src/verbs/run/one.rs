//! One run of a scene by one method, with what the command tells of it besides its measures.

use std::{ops::ControlFlow, sync::Arc};

use dashpot_analysis::{RunReport, SolveSettings, solve_partial, sweep::Watch};
use dashpot_dae::{Observer, Progress};
use dashpot_network::Assembly;
use dashpot_scene::{Sample, Scene};
use serde::{Serialize, Serializer};

use super::{RunOptions, curves, floor, scatter};
use crate::{error::CliError, host::Said};

/// The designs that stand for the scatter of a scene.
pub(super) struct Scattered {
    sample: Sample,
    seed: u64,
    /// What is set from outside and has no scatter.
    plain: Vec<(String, String)>,
}

impl Scattered {
    /// As many as are asked for; none where no number of the scene has scatter.
    pub(super) fn of(
        scene: &Scene,
        set: &[(String, String)],
        options: &RunOptions,
    ) -> Result<Option<Self>, CliError> {
        if scene.scatter.is_empty() || options.sample.count() == 0 {
            return Ok(None);
        }
        let plain = scatter::plainly_set(scene, set);
        let sample = scatter::drawn(scene, options.sample, &plain, None)?;
        let seed = options.sample.seed();
        Ok(sample.map(|sample| Self { sample, seed, plain }))
    }

    /// Adds to a run what they make of it.
    pub(super) fn add_to(
        &self,
        report: &mut RunReport,
        scene: &Scene,
        settings: &SolveSettings,
        watch: &mut Watch<'_>,
    ) -> Result<(), CliError> {
        let (drawn, asked) = ((&self.sample, self.seed), (settings, &*self.plain));
        let found = scatter::solved(scene, drawn, asked, watch)?;
        report.scatter = found.map(Box::new);
        Ok(())
    }
}

/// A run, and what no pad can beat where that is asked for. It is serialised as `dashpot run --json` has it among its
/// runs.
pub struct SceneRun {
    /// The run.
    pub report: RunReport,
    floor: Option<floor::Told>,
}

impl SceneRun {
    /// Solves a scene, in which `set` stands in place of what its text says, by the method of this name.
    ///
    /// # Errors
    ///
    /// The exit code of the command, and what it would have said.
    pub fn of(
        (scene, assembly): (&Scene, &Arc<Assembly>),
        set: &[(String, String)],
        (options, method): (&RunOptions, &str),
        observer: &mut dyn Observer,
    ) -> Result<Self, (u8, Vec<Said>)> {
        let failed = |error: CliError| (error.status() as u8, Said::all(&error));
        Self::solved((scene, assembly), set, (options, method), observer).map_err(failed)
    }

    fn solved(
        (scene, assembly): (&Scene, &Arc<Assembly>),
        set: &[(String, String)],
        (options, method): (&RunOptions, &str),
        observer: &mut dyn Observer,
    ) -> Result<Self, CliError> {
        let settings = options.settings(scene, method)?;
        let scattered = Scattered::of(scene, set, options)?;
        let mut report = solve_partial(&scene.network, assembly, &settings, observer)?;
        if let Some(own) = scattered {
            let end = settings.duration;
            let mut watch = |done: usize, of: usize| -> ControlFlow<()> {
                // The share of the designs stands for that of the time.
                observer.progress(Progress { time: end * done as f64 / of as f64, steps: done })
            };
            own.add_to(&mut report, scene, &settings, &mut watch)?;
        }
        report.only.clone_from(&options.measures);
        let floor = options
            .floor
            .then(|| floor::Told::of(&scene.network, scene.run.duration, &scene.limits));
        Ok(Self { report, floor })
    }
}

impl Serialize for SceneRun {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        curves::Run::<()>::of(&self.report, self.floor.as_ref()).serialize(serializer)
    }
}
