//! What poses the scene of a design: its text with other numbers and choices, and with scattered ones.

use std::sync::atomic::{AtomicUsize, Ordering};

use dashpot_analysis::{
    Limit,
    sweep::{PoseAt, ScenePoint},
};
use dashpot_scene::{Sample, Scene, read};

use super::{
    among::Choice,
    asked::Asked,
    scenes::{Test, TestScene},
};
use crate::{
    error::CliError,
    host::{self, ENDED},
    output::list,
    varied::{Varied, messages, point, posed},
    verbs::run::scatter::{self, ScatterArguments},
};

/// What poses the scene.
pub(super) struct Posing<'a> {
    /// The scenes of the tests.
    pub(super) scenes: &'a [TestScene],
    pub(super) set: &'a [(String, String)],
    pub(super) asked: &'a Asked,
    pub(super) limits: &'a [Limit],
    pub(super) method: Option<&'a str>,
    pub(super) sample: ScatterArguments,
    /// After so many scenes half of the search is thought to be done …
    pub(super) half: usize,
    /// … and so many have been posed.
    pub(super) posed: AtomicUsize,
}

/// A sample around a design.
pub(super) struct Drawn {
    pub(super) scene: Scene,
    pub(super) sample: Sample,
    /// What is set from outside and has no scatter.
    pub(super) plain: Vec<(String, String)>,
}

impl Posing<'_> {
    /// The text of a scene with a choice and these numbers in SI units, to the bit.
    fn text(&self, scene: &TestScene, choice: &Choice, values: &[f64]) -> String {
        let numbers = self.asked.numbers.iter().zip(values);
        let numbers = numbers.map(|(own, value)| own.exact(*value));
        scene.text(list(numbers), self.asked, choice)
    }

    /// The same for people, with the scatter that a number has.
    pub(super) fn written(&self, scene: &TestScene, choice: &Choice, values: &[f64]) -> String {
        let numbers = self.asked.numbers.iter().zip(values).enumerate();
        let numbers = numbers.map(|(at, (own, value))| {
            let place = scene.place(at);
            let scattered = place.and_then(|at| with_scatter(scene, (own, at), *value));
            scattered.unwrap_or_else(|| own.written(*value))
        });
        scene.text(list(numbers), self.asked, choice)
    }

    /// The share of the search that is thought to be done, with one more scene.
    fn share(&self) -> f64 {
        let posed = self.posed.fetch_add(1, Ordering::Relaxed) as f64;
        posed / (posed + self.half as f64)
    }

    pub(super) fn scene(&self, test: &Test) -> &TestScene {
        &self.scenes[test.scene]
    }

    /// Whether any number of any test has scatter.
    pub(super) fn has_scatter(&self) -> bool {
        self.asked.tests.iter().any(|own| !self.scene(own).scene.scatter.is_empty())
    }

    fn set_for(&self, test: &Test) -> Vec<(String, String)> {
        [self.set, &test.set].concat()
    }

    fn asked_of(&self, mut own: ScenePoint) -> ScenePoint {
        Limit::add(&mut own.settings.limits, self.limits.iter().cloned());
        own
    }

    /// The scene of a test with a choice, for any numbers.
    pub(super) fn pose<'s>(&'s self, choice: &'s Choice, test: &'s Test) -> Box<PoseAt<'s>> {
        let (set, scene, watch) = (self.set_for(test), self.scene(test), host::watch());
        Box::new(move |values: &[f64]| {
            if watch.as_ref().is_some_and(|watch| watch(self.share()).is_break()) {
                return Err(ENDED.to_owned());
            }
            let posed = posed(&self.text(scene, choice, values), &scene.input, &set);
            let point = posed.and_then(|own| point(own, self.method));
            let of_test = |fault| match &*test.name {
                "" => fault,
                name => format!("in the test `{name}`: {fault}"),
            };
            Ok(self.asked_of(point.map_err(of_test)?))
        })
    }

    /// The sample of a test around these numbers; none where no number has scatter that does anything.
    pub(super) fn drawn(
        &self,
        choice: &Choice,
        test: &Test,
        values: &[f64],
    ) -> Result<Option<Drawn>, CliError> {
        let (set, own) = (self.set_for(test), self.scene(test));
        let text = self.written(own, choice, values);
        let scene = read(&text, &own.input.options(&set)).map_err(CliError::Scene)?.value;
        let plain = scatter::plainly_set(&scene, &set);
        // One design has its numbers in all scenes.
        let first = self.asked.tests.first().filter(|own| own.scene != test.scene);
        let first = first.map(|first| self.drawn(choice, first, values)).transpose()?.flatten();
        let sample =
            scatter::drawn(&scene, self.sample, &plain, first.as_ref().map(|own| &own.sample))?;
        Ok(sample.map(|sample| Drawn { scene, sample, plain }))
    }

    /// The scattered designs of a test around these numbers; the design itself where it has no scatter.
    pub(super) fn scattered(
        &self,
        choice: &Choice,
        test: &Test,
        values: &[f64],
    ) -> Result<Vec<ScenePoint>, String> {
        let own = self.pose(choice, test)(values)?;
        let drawn = self.drawn(choice, test, values).map_err(|fault| match fault {
            CliError::Scene(faults) => messages(&faults),
            other => other.to_string(),
        })?;
        let Some(Drawn { scene, sample, plain }) = drawn else {
            return Ok(vec![own; self.sample.count()]);
        };
        let one = |at: usize| scatter::design(&scene, &sample, at, (&own.settings, &plain));
        (0..sample.len()).map(one).collect()
    }
}

/// A number with the scatter that it has in a scene: the same part of it where that is in percent, else as much.
fn with_scatter(scene: &TestScene, (own, at): (&Varied, usize), value: f64) -> Option<String> {
    let tunables = &scene.tunables;
    let path = &tunables.all()[at].path;
    let scatter = scene.scene.scatter.iter().find(|own| own.path == *path && !own.is_together)?;
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
