//! What a design is asked for: numbers with bounds, choices, tests, and what is made least.

use dashpot_analysis::{
    Limit,
    sweep::{PoseAt, ScenePoint},
};
use dashpot_design::optimum::{Aim, Variable};
use dashpot_scene::{
    Diagnostic, Scene, Tunables, Variation, pose,
    units::{parse_quantity, si_unit},
};

use super::DesignArguments;
use crate::{args::Variant, error::CliError, input::Input, output::list};

/// What `--solve-for` looks at, in parts of what the scene has.
const AROUND: [f64; 2] = [0.1, 10.0];
/// So many choices are tried at most.
const MOST: usize = 1000;

/// What is asked for.
#[derive(Debug, Clone)]
pub(super) struct Asked {
    tunables: Tunables,
    /// What varies between bounds.
    pub(super) numbers: Vec<Between>,
    /// What is chosen among words and steps.
    pub(super) among: Vec<Among>,
    pub(super) least: Least,
    pub(super) tests: Vec<Variant>,
}

/// A number with bounds, in SI units.
#[derive(Debug, Clone)]
pub(super) struct Between {
    pub(super) name: String,
    pub(super) si: String,
    pub(super) bounds: [f64; 2],
    start: f64,
    at: usize,
}

/// A number or word with what it may be.
#[derive(Debug, Clone)]
pub(super) struct Among {
    pub(super) variation: Variation,
    at: usize,
}

/// What is made least.
#[derive(Debug, Clone)]
pub(super) enum Least {
    /// A number with bounds.
    Number(usize),
    /// A number that is chosen among steps.
    Step(usize),
    /// A measure.
    Measure(String),
}

/// Which of its values everything takes that is chosen.
pub(super) type Choice = Vec<usize>;

impl Least {
    pub(super) fn name<'a>(&'a self, asked: &'a Asked) -> &'a str {
        match self {
            Self::Number(at) => &asked.numbers[*at].name,
            Self::Step(at) => &asked.among[*at].variation.name,
            Self::Measure(key) => key,
        }
    }
}

impl Asked {
    pub(super) fn of(
        arguments: &DesignArguments,
        scene: &Scene,
        input: &Input,
    ) -> Result<Self, CliError> {
        let tunables = Tunables::of(&scene.text, Some(&input.file)).map_err(CliError::Scene)?;
        let fault = |flag| move |fault| CliError::Tunable { flag, fault };
        let (mut numbers, mut among) = (Vec::new(), Vec::new());
        if let Some(name) = &arguments.solve_for {
            let at = tunables.find(name).map_err(fault("--solve-for"))?;
            let start = tunables.all()[at].value;
            let bounds = AROUND.map(|own| own * start);
            numbers.push(Between::of(&tunables, (name, at), bounds, "--solve-for")?);
        }
        let parsed = arguments.vary.iter().map(|own| Variation::parse(own));
        let mut variations = parsed.collect::<Result<Vec<_>, _>>()?;
        let matched = tunables.matched(&mut variations).map_err(fault("--vary"))?;
        for (own, at) in variations.into_iter().zip(matched) {
            if own.is_range {
                let bounds = [own.values[0], own.values[own.len() - 1]];
                numbers.push(Between::of(&tunables, (&own.name, at), bounds, "--vary")?);
            } else {
                among.push(Among { variation: own, at });
            }
        }
        let least = match (&arguments.least, &arguments.solve_for) {
            (Some(name), _) => {
                let number = numbers.iter().position(|own| own.name == *name);
                let is_step =
                    |own: &Among| own.variation.name == *name && !own.variation.is_of_words();
                let step = among.iter().position(is_step);
                match (number, step) {
                    (Some(at), _) => Least::Number(at),
                    (None, Some(at)) => Least::Step(at),
                    (None, None) if tunables.find(name).is_ok() => {
                        let reason = format!(
                            "`{name}` does not vary: give its bounds, `--vary \"{name}=…\"`"
                        );
                        return Err(CliError::WrongSetting { name: "--least".to_owned(), reason });
                    }
                    (None, None) => Least::Measure(name.clone()),
                }
            }
            (None, _) => Least::Number(0),
        };
        let plain = || Variant { name: String::new(), set: Vec::new() };
        let tests = if arguments.test.is_empty() { vec![plain()] } else { arguments.test.clone() };
        let asked = Self { tunables, numbers, among, least, tests };
        if asked.count() > MOST {
            return Err(CliError::TooManyPoints { most: MOST });
        }
        Ok(asked)
    }

    fn count(&self) -> usize {
        self.among.iter().map(|own| own.variation.len()).fold(1, usize::saturating_mul)
    }

    /// All choices of words and steps.
    pub(super) fn choices(&self) -> Vec<Choice> {
        let mut all = vec![Vec::new()];
        for own in &self.among {
            let longer = |choice: &Choice| {
                (0..own.variation.len()).map(|at| [&choice[..], &[at]].concat()).collect::<Vec<_>>()
            };
            all = all.iter().flat_map(longer).collect();
        }
        all
    }

    /// What a choice takes: names, values in SI units, and what is written.
    pub(super) fn chosen(&self, choice: &Choice) -> Vec<(String, Option<f64>, Option<String>)> {
        let one = |(own, at): (&Among, &usize)| {
            let Variation { name, values, words, .. } = &own.variation;
            let is_word = own.variation.is_of_words();
            let value = if is_word { None } else { values.get(*at).copied() };
            let word =
                if is_word { words.get(*at).cloned() } else { Some(own.variation.text(*at)) };
            (name.clone(), value, word)
        };
        self.among.iter().zip(choice).map(one).collect()
    }

    pub(super) fn variables(&self) -> Vec<Variable> {
        let one =
            |own: &Between| Variable { low: own.bounds[0], high: own.bounds[1], start: own.start };
        self.numbers.iter().map(one).collect()
    }

    pub(super) fn aim(&self, choice: &Choice) -> Aim {
        match &self.least {
            Least::Number(at) => Aim::Number(*at),
            Least::Step(at) => Aim::Given(self.among[*at].variation.values[choice[*at]]),
            Least::Measure(key) => Aim::Measure(key.clone()),
        }
    }
}

impl Between {
    fn of(
        tunables: &Tunables,
        (name, at): (&str, usize),
        [low, high]: [f64; 2],
        flag: &str,
    ) -> Result<Self, CliError> {
        let number = &tunables.all()[at];
        if !(low < high && low.is_finite() && high.is_finite()) {
            let reason = format!("`{name}` has no room between {low} and {high}");
            return Err(CliError::WrongSetting { name: flag.to_owned(), reason });
        }
        let si = number.dimension.map_or(String::new(), si_unit);
        let one = parse_quantity(&format!("1 {}", number.unit));
        let one = one.map_or(1.0, |one| number.dimension.map_or(one, |to| one.meant(to)).value);
        let start = (number.value * one).clamp(low, high);
        Ok(Self { name: name.to_owned(), si, bounds: [low, high], start, at })
    }
}

/// What poses the scene.
pub(super) struct Numbers<'a> {
    pub(super) input: &'a Input,
    pub(super) set: &'a [(String, String)],
    pub(super) asked: &'a Asked,
    pub(super) limits: &'a [Limit],
    pub(super) method: Option<&'a str>,
}

impl Numbers<'_> {
    /// The text of the scene with a choice and these numbers in SI units.
    pub(super) fn text(&self, choice: &Choice, values: &[f64]) -> String {
        let numbers = self.asked.numbers.iter().zip(values);
        let numbers = numbers.map(|(own, value)| {
            let text = format!("{value:e} {}", own.si);
            (own.at, text.trim_end().to_owned())
        });
        let chosen = self.asked.among.iter().zip(choice);
        let chosen = chosen.map(|(own, at)| (own.at, own.variation.text(*at)));
        self.asked.tunables.text_with(&list(numbers.chain(chosen)))
    }

    /// The scene of a test with a choice, for any numbers.
    pub(super) fn pose<'s>(&'s self, choice: &'s Choice, test: &'s Variant) -> Box<PoseAt<'s>> {
        Box::new(move |values: &[f64]| {
            let set = [self.set, &test.set].concat();
            let posed = pose(&self.text(choice, values), &self.input.options(&set));
            let posed = posed
                .map_err(|faults| list(faults.list.iter().map(Diagnostic::message)).join("; "))?;
            let method = match (self.method, &posed.run.methods[..]) {
                (Some(wanted), _) => wanted,
                (None, [only]) => only,
                _ => "auto",
            };
            let mut settings = posed.settings(method).map_err(|error| error.to_string())?;
            Limit::add(&mut settings.limits, self.limits.iter().cloned());
            Ok(ScenePoint { network: posed.network, settings })
        })
    }
}
