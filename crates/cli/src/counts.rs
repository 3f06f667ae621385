//! How many of anything a command may be asked for: one list, checked where its words are read, before any work.

use std::{
    fmt::{Display, Formatter},
    num::NonZero,
};

use crate::error::{CliError, StudyError};

/// The least and the largest number of something that may be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Count {
    least: usize,
    most: usize,
}

/// Points of one sweep: the values of a measure stay in memory.
pub(crate) const SWEEP_POINTS: Count = Count::new(1, 10_000_000);
/// Scattered designs of a run, of which each measure has a value.
pub(crate) const SCATTERED: Count = Count::new(1, 1_000_000);
/// Scattered scenes that are instantiated together around a design or a cushion: each takes some kilobytes.
pub(crate) const SCATTERED_SCENES: Count = Count::new(1, 20_000);
/// Designs that are spread over the bounds before a search.
pub(crate) const DESIGNS: Count = Count::new(1, 100_000);
/// The same for all choices of words and steps together.
pub(crate) const DESIGNS_OF_CHOICES: Count = Count::new(1, 1_000_000);
/// Choices of words and steps, each of which is searched.
pub(crate) const CHOICES: Count = Count::new(1, 1000);
pub(crate) const FRONT_POINTS: Count = Count::new(2, 1000);
pub(crate) const STARTS: Count = Count::new(1, 1000);
pub(crate) const CURVES: Count = Count::new(1, 200);
pub(crate) const CURVE_POINTS: Count = Count::new(1, 10_000);
pub(crate) const SHARDS: Count = Count::new(1, 1_000_000);
pub(crate) const THREADS: Count = Count::new(1, 1024);

impl Count {
    const fn new(least: usize, most: usize) -> Self {
        Self { least, most }
    }

    pub(crate) const fn most(self) -> usize {
        self.most
    }

    pub(crate) fn allows(self, count: usize) -> bool {
        (self.least..=self.most).contains(&count)
    }

    /// What reads such a number from a command line.
    pub(crate) fn read(self) -> impl Fn(&str) -> Result<usize, String> + Clone + Send + Sync {
        move |text| {
            let count = text.trim().parse().ok().filter(|count| self.allows(*count));
            count.ok_or_else(|| format!("a whole number {self} is wanted"))
        }
    }

    /// The error where more are asked for than there may be.
    pub(crate) fn check(self, count: usize, of: &'static str) -> Result<(), CliError> {
        if count <= self.most {
            Ok(())
        } else {
            Err(StudyError::TooMany { of, most: self.most }.into())
        }
    }
}

/// Memory \[B\] that a result may take as a whole.
const MOST_MEMORY: usize = 1 << 30;

/// The error where a result of so many bytes is asked for, estimated before the work; `help` says what to ask for instead.
pub(crate) fn check_memory(
    what: impl FnOnce() -> String,
    bytes: usize,
    help: &'static str,
) -> Result<(), CliError> {
    if bytes <= MOST_MEMORY {
        return Ok(());
    }
    Err(CliError::TooLarge { what: what(), bytes, most: MOST_MEMORY, help })
}

/// What reads a number of threads from a command line.
pub(crate) fn threads(text: &str) -> Result<NonZero<usize>, String> {
    let count = THREADS.read()(text)?;
    NonZero::new(count).ok_or_else(|| format!("a whole number {THREADS} is wanted"))
}

impl Display for Count {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        write!(out, "from {} to {}", self.least, self.most)
    }
}
