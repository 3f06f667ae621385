//! What is wrong with shards of a sweep.

use std::fmt;

use dashpot_report::numbers::counted;
use thiserror::Error;

/// What is wrong with a folder of a shard.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub(crate) enum ShardFault {
    /// There is no result of a shard.
    #[error("there is no shard of a sweep in it, or not yet")]
    None,
    /// A file of it is gone, or not as it was written.
    #[error("`{0}` of its shard is not as it was written")]
    Broken(&'static str),
    /// It is of another sweep than the others.
    #[error("its shard is of another sweep than the first one")]
    OfAnother,
    /// The scene, a file of it, or the program is another one by now.
    #[error(
        "the scene, a file of it or the version of the program has changed since its shard was solved"
    )]
    Changed,
    /// There is a shard of another sweep where this one is to be written.
    #[error("there are points of another sweep or shard in it{}", differing(.0))]
    Taken(Vec<Difference>),
    /// It is there twice.
    #[error("its shard is there twice")]
    Twice,
}

impl ShardFault {
    pub(crate) fn help(&self) -> &'static str {
        match self {
            Self::None => "a shard is written by `dashpot sweep … --shard 3/10 --out DIR`",
            Self::Broken(_) => "remove the folder, and solve the shard again",
            Self::OfAnother | Self::Twice => "leave the folder out",
            Self::Changed => "solve all shards again, or bring back what was changed",
            Self::Taken(_) => "choose another folder for `--out`, or remove this one",
        }
    }
}

/// What to do about shards that are missing.
pub(crate) const MISSING_HELP: &str =
    "solve them with the same command; shards that are there already are left as they are";

/// `2 shards of 10 are missing: 3, 7`; of many the first.
pub(crate) fn missing(numbers: &[usize], of: usize) -> String {
    const MOST: usize = 12;
    let mut words: Vec<String> = numbers.iter().take(MOST).map(usize::to_string).collect();
    if numbers.len() > MOST {
        words.push("…".to_owned());
    }
    let (count, verb) =
        (counted(numbers.len(), "shard"), if numbers.len() == 1 { "is" } else { "are" });
    format!("{count} of {of} {verb} missing: {}", words.join(", "))
}

/// In what two sweeps differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Difference {
    pub(crate) what: String,
    /// What it is there, and what it is here; of a text that is not told.
    pub(crate) values: Option<[String; 2]>,
}

impl fmt::Display for Difference {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.values {
            Some([there, here]) => write!(out, "{} (there {there}, here {here})", self.what),
            None => out.write_str(&self.what),
        }
    }
}

/// The end of a sentence on points of another sweep: in what they differ, where that is known.
fn differing(all: &[Difference]) -> String {
    let words = all.iter().map(Difference::to_string).collect::<Vec<_>>();
    if words.is_empty() {
        String::new()
    } else {
        format!(", which differs in {}", words.join(", "))
    }
}
