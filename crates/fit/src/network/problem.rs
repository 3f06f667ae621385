//! What is fitted to what: numbers, tests and settings.

use dashpot_signal::{Cfc, Padding};
use thiserror::Error;

/// A curve over time.
pub trait Curve {
    /// The value at a time \[s\]: before the start what is there at rest, behind the end what is there last.
    fn value(&self, time: f64) -> f64;

    /// Time of the largest magnitude \[s\], and that with its sign.
    fn peak(&self) -> (f64, f64);
}

/// The curve of a test, by its position, where the numbers have these values in SI units: those that all tests share,
/// then those that the test has [to itself](Test::known).
pub type Model<'m> = dyn Fn(usize, &[f64]) -> Result<Box<dyn Curve>, String> + Sync + 'm;

/// A number that is fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Number {
    /// The lower bound, positive.
    pub low: f64,
    /// The upper bound.
    pub high: f64,
    /// Where the search begins first.
    pub start: f64,
}

/// A number of one test that was measured besides, such as the speed of its drop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Known {
    /// What was measured, in SI units.
    pub mean: f64,
    /// Its standard deviation, positive.
    pub deviation: f64,
}

/// What the rows of a test are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    /// An impact: nothing acts before it, and when it comes in the record is not known.
    #[default]
    Blow,
    /// What answers a history that was measured beside it, by a clock that is off by two steps at most.
    Answer,
    /// Values above zero, moduli or compliances over time or frequency, which are compared in parts of them: what is
    /// left of them are differences of logarithms.
    Modulus,
}

/// A test: rows of time \[s\] and value in SI units, and what may be off with them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Test {
    /// The rows.
    pub rows: Vec<(f64, f64)>,
    /// What they are.
    pub kind: Kind,
    /// Whether its clock may be off.
    pub is_shifted: bool,
    /// Whether its zero may be off.
    pub is_offset: bool,
    /// Standard deviation of its gain, in parts of it, where that may be off.
    pub gain: Option<f64>,
    /// The filter that it went through, and what stands beyond its ends.
    pub filter: Option<(Cfc, Padding)>,
    /// Standard deviation of a sample before the filter, in SI units, where that is known; of moduli in parts of them.
    pub noise: Option<f64>,
    /// Which test it is a record of, where that was repeated: any number that these records share.
    pub repeated: Option<usize>,
    /// Numbers of this test alone.
    pub known: Vec<Known>,
}

impl Test {
    /// How many unknowns it has to itself.
    pub(crate) fn unknowns(&self) -> usize {
        let own = [self.is_shifted, self.is_offset, self.gain.is_some()];
        own.into_iter().filter(|own| *own).count() + self.known.len()
    }

    /// How many of its unknowns are known from elsewhere, more or less.
    pub(super) fn priors(&self) -> usize {
        usize::from(self.gain.is_some()) + self.known.len()
    }
}

/// Which intervals are those of the profile likelihood, which takes many times as long.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Profile {
    /// None: what the covariance does not determine has none.
    Never,
    /// Those where the covariance falls short.
    #[default]
    WhereNeeded,
    /// All.
    Always,
}

/// What is asked of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NetworkSettings {
    /// From how many starts the search begins; 1 is the scene's own values alone.
    pub starts: usize,
    /// The seed of the others.
    pub seed: u64,
    /// Whether rows that are far off count by their magnitude, in place of its square.
    pub is_robust: bool,
    /// Which intervals are those of the profile likelihood.
    pub profile: Profile,
}

/// Why nothing was fitted.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NetworkFault {
    /// Too few rows for so many unknowns.
    #[error("{rows} independent rows do not determine {unknowns} unknowns")]
    TooFew {
        /// Rows of all tests; behind a filter those of which noise tells them apart.
        rows: usize,
        /// Numbers, clocks, zeros and gains.
        unknowns: usize,
    },
    /// A test that is nothing but zeros.
    #[error("test {} is zero throughout", .test + 1)]
    Nothing {
        /// Its number from 0.
        test: usize,
    },
    /// A record that cannot have gone through the filter.
    #[error("test {}: {fault}", .test + 1)]
    Filter {
        /// Its number from 0.
        test: usize,
        /// Why not.
        fault: dashpot_signal::SettingsFault,
    },
    /// The model cannot be solved at any start.
    #[error("the model cannot be solved: {reason}")]
    Unsolved {
        /// Why not.
        reason: String,
    },
}
