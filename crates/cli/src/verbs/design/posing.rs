//! What poses the scene of a design: its text with other numbers and choices, and with scattered ones.

use std::{
    ops::ControlFlow,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicUsize, Ordering},
    },
};

use dashpot_analysis::{
    Limit,
    sweep::{PoseAt, ScenePoint},
};

use super::{
    among::Choice,
    asked::Asked,
    scenes::{Test, TestScene},
};
use crate::{
    around::{Around, with_scatter},
    error::{CliError, StudyError},
    host::{ENDED, Watch},
    output::list,
    progress::Bar,
    varied::{messages, point, posed},
    verbs::run::scatter::ScatterArguments,
};
use dashpot_report::numbers::counted;

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
    /// Shows that, until the search is over …
    pub(super) bar: Mutex<Option<Bar>>,
    /// … where no host does.
    pub(super) watch: Option<Watch>,
}

impl Posing<'_> {
    /// The text of a scene with a choice and these numbers in SI units, for people, with the scatter that a number has.
    pub(super) fn written(&self, scene: &TestScene, choice: &Choice, values: &[f64]) -> String {
        let numbers = self.asked.numbers.iter().zip(values).enumerate();
        let numbers = numbers.map(|(at, (own, value))| {
            let place = scene.place(at);
            let scattered = place
                .and_then(|at| with_scatter((&scene.scene, &scene.tunables), (own, at), *value));
            scattered.unwrap_or_else(|| own.written(*value))
        });
        scene.tunables.text_with(&scene.values(list(numbers), self.asked, choice))
    }

    /// Shows how far a search may have come with one more scene. Errors: it is to end.
    fn show(&self) -> Result<(), String> {
        let posed = self.posed.fetch_add(1, Ordering::Relaxed);
        let share = posed as f64 / (posed + self.half) as f64;
        let bar = || self.bar.lock().unwrap_or_else(PoisonError::into_inner);
        let answer = match &self.watch {
            Some(watch) => watch(share),
            None => bar().as_mut().map_or(ControlFlow::Continue(()), |bar| {
                bar.show(share, || counted(posed, "scene"))
            }),
        };
        if answer.is_break() { Err(ENDED.to_owned()) } else { Ok(()) }
    }

    /// The search is over.
    pub(super) fn end(&self) {
        *self.bar.lock().unwrap_or_else(PoisonError::into_inner) = None;
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
        let (set, scene) = (self.set_for(test), self.scene(test));
        Box::new(move |values: &[f64]| {
            self.show()?;
            // To the bit.
            let numbers = self.asked.numbers.iter().zip(values);
            let numbers = list(numbers.map(|(own, value)| own.exact(*value)));
            let values = scene.values(numbers, self.asked, choice);
            let posed = posed((&scene.tunables, &values), &scene.input, &set);
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
    ) -> Result<Option<Around>, CliError> {
        let (set, own) = (self.set_for(test), self.scene(test));
        // One design has its numbers in all scenes.
        let first = self.asked.tests.first().filter(|own| own.scene != test.scene);
        let first = first.map(|first| self.drawn(choice, first, values)).transpose()?.flatten();
        let beside = first.as_ref().map(|own| &own.sample);
        Around::of(&self.written(own, choice, values), (&own.input, &set), self.sample, beside)
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
            CliError::Study(StudyError::Scene(faults)) => messages(&faults),
            other => other.to_string(),
        })?;
        match drawn {
            Some(drawn) => drawn.designs(&own.settings),
            None => Ok(vec![own; self.sample.count()]),
        }
    }
}
