//! What is asked of a run.

use std::{collections::BTreeMap, sync::Arc};

use dashpot_dae::{Direction, Method, methods};

use crate::{Limit, MeasureWish, RunError, wording::quantity};

/// What is asked of a run.
#[derive(Debug, Clone)]
pub struct SolveSettings {
    /// The method.
    pub method: Choice,
    /// Length of the run \[s\], zero or positive.
    pub duration: f64,
    /// Whether the length was found for this network, so that another one has another.
    pub is_duration_found: bool,
    /// The method's own relative tolerance, that of the finest of four solutions where errors are estimated, from 1e-13
    /// to 1e-3 (to 1e-1 without estimate); `None` finds one that gives the accuracy wanted.
    pub rtol: Option<f64>,
    /// The accuracy wanted of the measures.
    pub accuracy: Accuracy,
    /// Whether errors are estimated, by further solutions where the method states no bound.
    pub estimate: bool,
    /// Conditions that end the run early.
    pub stops: Vec<Stop>,
    /// How much work the run may be, with all solutions that its errors take, in units of
    /// [`Budget`](dashpot_dae::Budget); positive.
    pub budget: u64,
    /// Measures besides those that every run reports.
    pub measures: Vec<MeasureWish>,
    /// Limits; the measures that they are on are reported as well.
    pub limits: Vec<Limit>,
}

/// How the method of a run is chosen.
#[derive(Debug, Clone, Default)]
pub enum Choice {
    /// By the system: its structure, its size, and how long the run is.
    #[default]
    Auto,
    /// It is given.
    Method(Arc<dyn Method>),
}

impl Choice {
    /// What chooses by itself.
    const AUTO: &str = "auto";

    /// The choice of this name: `auto`, or a method of the register.
    ///
    /// # Errors
    ///
    /// [`RunError::UnknownMethod`] for any other name.
    pub fn named(name: &str) -> Result<Self, RunError> {
        if name == Self::AUTO {
            return Ok(Self::Auto);
        }
        methods::by_name(name).map(|own| Self::Method(own.into())).ok_or_else(|| {
            let known = methods::all().iter().map(|method| method.name()).collect();
            RunError::UnknownMethod { name: name.to_owned(), known }
        })
    }

    /// The method; where the system is to tell, one that looks at it first.
    pub(crate) fn method(&self) -> Arc<dyn Method> {
        match self {
            Self::Auto => Arc::new(methods::Auto),
            Self::Method(method) => Arc::clone(method),
        }
    }

    /// Its name.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Auto => Self::AUTO,
            Self::Method(method) => method.name(),
        }
    }
}

impl<M: Method + 'static> From<M> for Choice {
    fn from(method: M) -> Self {
        Self::Method(Arc::new(method))
    }
}

/// The accuracy wanted, relative to each measure's magnitude.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// That of all measures without a wish of their own, positive.
    pub default: f64,
    /// That of single measures, by key such as `padding.peak-force`, positive.
    pub by_measure: BTreeMap<String, f64>,
    /// What moves no measure by more than this part of its size may be left out, from more than 0
    /// to [`LOOSEST`](Self::LOOSEST); `None` leaves nothing out.
    pub neglect_below: Option<f64>,
}

impl Default for Accuracy {
    /// 0.1 % in every measure.
    fn default() -> Self {
        Self::of_all(1e-3)
    }
}

impl Accuracy {
    /// The loosest wish that makes sense: a number that is further off says nothing any more.
    pub const LOOSEST: f64 = 0.2;

    /// The same accuracy in every measure.
    pub fn of_all(relative: f64) -> Self {
        Self { default: relative, by_measure: BTreeMap::new(), neglect_below: None }
    }

    /// The strictest of all wishes.
    pub(crate) fn strictest(&self) -> f64 {
        self.by_measure.values().copied().fold(self.default, f64::min)
    }

    /// The accuracy wanted of the measure with this key.
    pub fn of(&self, key: &str) -> f64 {
        self.by_measure.get(key).copied().unwrap_or(self.default)
    }
}

/// A condition that ends the run: an output crosses a level.
#[derive(Debug, Clone, PartialEq)]
pub struct Stop {
    /// Name of the output, for instance `padding.force`.
    pub output: String,
    /// The level, in the output's SI unit.
    pub level: f64,
    /// Which crossings count.
    pub direction: Direction,
}

impl Stop {
    /// What has happened when a run stops, in words; the level is in the SI unit `unit`.
    pub(crate) fn text(&self, unit: &str) -> String {
        let way = match self.direction {
            Direction::Rising => "rose above",
            Direction::Falling => "fell below",
            Direction::Either => "reached",
        };
        let level =
            if self.level == 0.0 { format!("0 {unit}") } else { quantity(self.level, unit) };
        format!("{} {way} {level}", self.output)
    }
}

impl SolveSettings {
    /// The work that a run may be unless more is asked for: about half a minute, which no scene that makes sense takes.
    pub const BUDGET: u64 = 1_000_000_000;

    /// A run of `duration` \[s\] by the method that suits, with measures good to 0.1 %.
    pub fn lasting(duration: f64) -> Self {
        Self {
            method: Choice::Auto,
            duration,
            is_duration_found: false,
            rtol: None,
            accuracy: Accuracy::default(),
            estimate: true,
            stops: Vec::new(),
            budget: Self::BUDGET,
            measures: Vec::new(),
            limits: Vec::new(),
        }
    }

    /// The same run by another method.
    #[must_use]
    pub fn by(self, method: impl Into<Choice>) -> Self {
        Self { method: method.into(), ..self }
    }

    /// The same run by the method of this name; `auto` chooses.
    ///
    /// # Errors
    ///
    /// [`RunError::UnknownMethod`].
    pub fn by_name(self, method: &str) -> Result<Self, RunError> {
        Ok(Self { method: Choice::named(method)?, ..self })
    }

    pub(crate) fn validate(&self) -> Result<(), RunError> {
        let invalid = |setting: &str, range, value| {
            Err(RunError::InvalidSetting { setting: setting.to_owned(), range, value })
        };
        if !(self.duration >= 0.0 && self.duration.is_finite()) {
            return invalid("duration", "zero or positive, and finite", self.duration);
        }
        // The coarsest of four solutions takes 32 times the tolerance.
        let (coarsest, range) = if self.estimate {
            (1e-3, "from 1e-13 to 1e-3 where errors are estimated")
        } else {
            (1e-1, "from 1e-13 to 1e-1")
        };
        if let Some(rtol) = self.rtol
            && !(1e-13..=coarsest).contains(&rtol)
        {
            return invalid("rtol", range, rtol);
        }
        let all = [("accuracy", self.accuracy.default)];
        let single = self.accuracy.by_measure.iter().map(|(key, &wish)| (key.as_str(), wish));
        for (key, wish) in all.into_iter().chain(single) {
            if !(wish > 0.0 && wish.is_finite()) {
                return invalid(key, "positive and finite", wish);
            }
        }
        if self.budget == 0 {
            return invalid("budget", "positive", 0.0);
        }
        match self.accuracy.neglect_below {
            Some(bound) if !(bound > 0.0 && bound <= Accuracy::LOOSEST) => {
                invalid("neglect-below", "more than 0 and at most 0.2", bound)
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_wishes_override_the_default() {
        let mut accuracy = Accuracy::default();
        accuracy.by_measure.insert("a.b".to_owned(), 1e-6);
        assert!((accuracy.of("a.b") - 1e-6).abs() < 1e-20);
        assert!((accuracy.of("c") - 1e-3).abs() < 1e-20);
        assert!((accuracy.strictest() - 1e-6).abs() < 1e-20);
    }
}
