//! What poses the scene of a design: its text with other numbers and choices, and with scattered ones.

use dashpot_analysis::{
    Limit,
    sweep::{PoseAt, ScenePoint},
};
use dashpot_scene::{Sample, ScatteredNumber, Scene, read};

use super::{among::Choice, asked::Asked};
use crate::{
    args::Variant,
    error::CliError,
    input::Input,
    output::list,
    varied::{Varied, messages, point, posed},
    verbs::run::scatter::{self, ScatterArguments},
};

/// What poses the scene.
pub(super) struct Posing<'a> {
    pub(super) input: &'a Input,
    pub(super) set: &'a [(String, String)],
    pub(super) asked: &'a Asked,
    pub(super) limits: &'a [Limit],
    pub(super) method: Option<&'a str>,
    pub(super) scattered: &'a [ScatteredNumber],
    pub(super) sample: ScatterArguments,
}

/// A sample around a design.
pub(super) struct Drawn {
    pub(super) scene: Scene,
    pub(super) sample: Sample,
    /// What is set from outside and has no scatter.
    pub(super) plain: Vec<(String, String)>,
}

impl Posing<'_> {
    /// The text of the scene with a choice and these numbers in SI units, to the bit.
    fn text(&self, choice: &Choice, values: &[f64]) -> String {
        self.text_with(choice, values, &Varied::exact)
    }

    /// The same for people, with the scatter that a number has.
    pub(super) fn written(&self, choice: &Choice, values: &[f64]) -> String {
        self.text_with(choice, values, &|own, value| {
            self.with_scatter(own, value).unwrap_or_else(|| own.written(value))
        })
    }

    fn text_with(
        &self,
        choice: &Choice,
        values: &[f64],
        written: &dyn Fn(&Varied, f64) -> String,
    ) -> String {
        let numbers = self.asked.numbers.iter().zip(values);
        let numbers = numbers.filter_map(|(own, value)| Some((own.at?, written(own, *value))));
        let chosen = self.asked.among.iter().zip(choice).flat_map(|(own, at)| own.written(*at));
        self.asked.tunables.text_with(&list(numbers.chain(chosen)))
    }

    /// A number with the scatter that it has in the scene: the same part of it where that is in percent, else as much.
    fn with_scatter(&self, own: &Varied, value: f64) -> Option<String> {
        let at = own.at?;
        let tunables = &self.asked.tunables;
        let path = &tunables.all()[at].path;
        let scatter = self.scattered.iter().find(|own| own.path == *path)?;
        let is_part = tunables.shown(at).trim_end().ends_with('%') && own.unit != "%";
        let part = if is_part { value / scatter.mean } else { 1.0 };
        let [mean, deviation] = [value, scatter.deviation * part].map(|of| own.written(of));
        Some(if own.unit == "%" {
            format!(
                "({} ± {}) %",
                mean.trim_end_matches([' ', '%']),
                deviation.trim_end_matches([' ', '%'])
            )
        } else {
            format!("{mean} ± {deviation}")
        })
    }

    fn set_for(&self, test: &Variant) -> Vec<(String, String)> {
        [self.set, &test.set].concat()
    }

    fn asked_of(&self, mut own: ScenePoint) -> ScenePoint {
        Limit::add(&mut own.settings.limits, self.limits.iter().cloned());
        own
    }

    /// The scene of a test with a choice, for any numbers.
    pub(super) fn pose<'s>(&'s self, choice: &'s Choice, test: &'s Variant) -> Box<PoseAt<'s>> {
        let set = self.set_for(test);
        Box::new(move |values: &[f64]| {
            let posed = posed(&self.text(choice, values), self.input, &set)?;
            Ok(self.asked_of(point(posed, self.method)?))
        })
    }

    /// The sample of a test around these numbers; none where no number has scatter that does anything.
    pub(super) fn drawn(
        &self,
        choice: &Choice,
        test: &Variant,
        values: &[f64],
    ) -> Result<Option<Drawn>, CliError> {
        let set = self.set_for(test);
        let text = self.written(choice, values);
        let scene = read(&text, &self.input.options(&set)).map_err(CliError::Scene)?.value;
        let plain = scatter::plainly_set(&scene, &set);
        let sample = scatter::drawn(&scene, self.sample, &plain)?;
        Ok(sample.map(|sample| Drawn { scene, sample, plain }))
    }

    /// The scattered designs of a test around these numbers; the design itself where it has no scatter.
    pub(super) fn scattered(
        &self,
        choice: &Choice,
        test: &Variant,
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
