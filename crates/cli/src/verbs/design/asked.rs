//! What a design is asked for: numbers with bounds and sums, choices, tests, and what is made least.

use dashpot_design::optimum::{Aim, Total, Variable};
use dashpot_scene::{Tunables, Variation, units::Dimension};

use super::{
    DesignArguments,
    among::{Among, Choice, Taken},
    scenes::Test,
    total,
};
use crate::{
    counts::{CHOICES, DESIGNS_OF_CHOICES},
    error::CliError,
    input::bare_numbers,
    output::list,
    varied::Varied,
};

/// What `--solve-for` looks at, in parts of what the scene has.
const AROUND: [f64; 2] = [0.1, 10.0];
/// Bounds that are offered, in parts of what the scene has, and their digits.
const AROUND_USUAL: [f64; 2] = [0.5, 2.0];
const FEW: usize = 3;

#[derive(Debug, Clone)]
pub(super) struct Asked {
    pub(super) tunables: Tunables,
    /// What varies between bounds.
    pub(super) numbers: Vec<Varied>,
    /// Which of that has a given sum.
    pub(super) totals: Vec<Total>,
    /// What is chosen among words and steps.
    pub(super) among: Vec<Among>,
    pub(super) least: Least,
    /// What is made least besides.
    pub(super) and: Option<Least>,
    /// The tests; one without a name is the scene as it is.
    pub(super) tests: Vec<Test>,
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

impl Least {
    pub(super) fn name<'a>(&'a self, asked: &'a Asked) -> &'a str {
        match self {
            Self::Number(at) => &asked.numbers[*at].name,
            Self::Step(at) => &asked.among[*at].names[0],
            Self::Measure(key) => key,
        }
    }

    pub(super) fn aim(&self, asked: &Asked, choice: &Choice) -> Aim {
        match self {
            Self::Number(at) => Aim::Number(*at),
            Self::Step(at) => Aim::Given(asked.among[*at].value(choice[*at])),
            Self::Measure(key) => Aim::Measure(key.clone()),
        }
    }
}

impl Asked {
    pub(super) fn of(
        arguments: &DesignArguments,
        tunables: Tunables,
        tests: Vec<Test>,
    ) -> Result<Self, CliError> {
        let (numbers, among) = (Vec::new(), Vec::new());
        let (totals, least, and) = (Vec::new(), Least::Number(0), None);
        let mut asked = Self { tunables, numbers, totals, among, least, and, tests };
        if let Some(name) = &arguments.solve_for {
            asked.solve_for(name)?;
        }
        asked.vary(&arguments.vary)?;
        asked.totals = total::totals(&arguments.total, &asked.numbers)?;
        if let Some(name) = &arguments.least {
            asked.least = asked.least_of("--least", name)?;
        }
        asked.and = arguments.and.as_ref().map(|own| asked.least_of("--and", own)).transpose()?;
        let and = asked.and.as_ref();
        if let Some(name) =
            and.map(|own| own.name(&asked)).filter(|own| *own == asked.least.name(&asked))
        {
            let reason = format!("`{name}` is made least already");
            return Err(CliError::setting("--and", reason));
        }
        CHOICES.check(asked.count(), "choices")?;
        let designs = asked.count().saturating_mul(arguments.sample);
        DESIGNS_OF_CHOICES.check(designs, "designs of `--sample` in all choices")?;
        Ok(asked)
    }

    fn solve_for(&mut self, name: &str) -> Result<(), CliError> {
        let flag = "--solve-for";
        let at = self.tunables.find(name).map_err(|fault| CliError::Tunable { flag, fault })?;
        let start = self.tunables.all()[at].value;
        self.add((name, at), AROUND.map(|own| own * start), ("", None), flag)
    }

    /// Numbers with bounds, and choices.
    fn vary(&mut self, texts: &[String]) -> Result<(), CliError> {
        let fault = |fault| CliError::Tunable { flag: "--vary", fault };
        let (mut variations, mut groups) = (Vec::new(), Vec::new());
        for text in texts {
            if text.split_once('=').is_none_or(|own| own.1.trim().is_empty()) {
                return Err(self.without_values(text.trim_end_matches([' ', '='])));
            }
            let own = Among::parse(text)?;
            groups.push(own.len());
            variations.extend(own);
        }
        let matched = self.tunables.matched(&mut variations, bare_numbers()).map_err(fault)?;
        let mut each = variations.into_iter().zip(matched);
        for count in groups {
            let group: Vec<(Variation, usize)> = list(each.by_ref().take(count));
            match &group[..] {
                [(own, at)] if own.is_range => {
                    let bounds = [own.values[0], own.values[own.len() - 1]];
                    let of_command = (&*own.unit, own.dimension);
                    self.add((&own.name, *at), bounds, of_command, "--vary")?;
                }
                _ => self.among.push(Among::of(group)),
            }
        }
        Ok(())
    }

    /// What to write where it is not said between which bounds a number may vary.
    fn without_values(&self, name: &str) -> CliError {
        let own = self.tunables.find(name).ok();
        let own = own.map(|at| Varied::of(&self.tunables, (name, at), [0.0; 2], ("", None)));
        let own = own.filter(|own| own.start > 0.0);
        let bounds = own.map_or_else(
            || "10..60 mm".to_owned(),
            |own| {
                let [low, high] = AROUND_USUAL.map(|part| own.short(part * own.start, FEW));
                format!("{}..{high}", low.split(' ').next().unwrap_or_default())
            },
        );
        let reason = format!(
            "`{name}` is given no values: write its bounds, as in \"{name}={bounds}\", or what it may be, one by one with \
             commas"
        );
        CliError::setting("--vary", reason)
    }

    fn add(
        &mut self,
        named: (&str, usize),
        bounds: [f64; 2],
        of_command: (&str, Option<Dimension>),
        flag: &str,
    ) -> Result<(), CliError> {
        let [low, high] = bounds;
        if !(low < high && low.is_finite() && high.is_finite()) {
            let reason = format!("`{}` has no room between {low} and {high}", named.0);
            return Err(CliError::setting(flag, reason));
        }
        self.numbers.push(Varied::of(&self.tunables, named, bounds, of_command));
        Ok(())
    }

    fn least_of(&self, flag: &str, name: &str) -> Result<Least, CliError> {
        let number = self.numbers.iter().position(|own| own.name == name);
        let step = self.among.iter().position(|own| own.is_number(name));
        match (number, step) {
            (Some(at), _) => Ok(Least::Number(at)),
            (None, Some(at)) => Ok(Least::Step(at)),
            (None, None) if self.tunables.find(name).is_ok() => {
                let reason =
                    format!("`{name}` does not vary: give its bounds, `--vary \"{name}=…\"`");
                Err(CliError::setting(flag, reason))
            }
            (None, None) => Ok(Least::Measure(name.to_owned())),
        }
    }

    fn count(&self) -> usize {
        self.among.iter().map(Among::len).fold(1, usize::saturating_mul)
    }

    /// All choices of words and steps.
    pub(super) fn choices(&self) -> Vec<Choice> {
        let mut all = vec![Vec::new()];
        for own in &self.among {
            let longer = |choice: &Choice| {
                (0..own.len()).map(|at| [&choice[..], &[at]].concat()).collect::<Vec<_>>()
            };
            all = all.iter().flat_map(longer).collect();
        }
        all
    }

    /// What a choice takes, name by name.
    pub(super) fn chosen<'a>(
        &'a self,
        choice: &'a Choice,
    ) -> impl Iterator<Item = (&'a str, &'a Taken)> {
        let each = self.among.iter().zip(choice);
        each.flat_map(|(own, at)| own.names.iter().map(String::as_str).zip(&own.options[*at]))
    }

    pub(super) fn variables(&self) -> Vec<Variable> {
        let one =
            |own: &Varied| Variable { low: own.bounds[0], high: own.bounds[1], start: own.start };
        self.numbers.iter().map(one).collect()
    }
}
