//! Why channels cannot be read.

use dashpot_signal::{CfcFault, ChannelFault, SettingsFault};
use thiserror::Error;

/// Why channels cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SignalError {
    /// A file with channels that cannot be read, or of which it is not clear what they are.
    #[error("`{file}`: {reason}")]
    File {
        /// Its name.
        file: String,
        /// What is wrong, and what to write.
        reason: String,
    },
    /// Samples that are no signal.
    #[error("`{file}`{}, channel `{channel}`: {fault}", .line.map_or_else(String::new, |line| format!(", line {line}")))]
    Samples {
        /// Name of the file.
        file: String,
        /// The line, from 1, of the sample that is meant.
        line: Option<usize>,
        /// Name of the channel.
        channel: String,
        /// What is wrong.
        fault: Box<ChannelFault>,
    },
    /// A channel that cannot be read as it is asked for.
    #[error("`{file}`, channel `{channel}`: {fault}")]
    Channel {
        /// Name of the file.
        file: String,
        /// Name of the channel.
        channel: String,
        /// What is wrong.
        fault: Box<SettingsFault>,
    },
    /// A limit on what no channel has.
    #[error("no channel has the measure `{key}`")]
    Limit {
        /// The key.
        key: String,
        /// Those that there are.
        known: Vec<String>,
        /// That which may be meant.
        meant: Option<String>,
    },
}

impl SignalError {
    /// What to do, where that can be said.
    pub fn help(&self) -> Option<String> {
        let help = match self {
            Self::Limit { meant: Some(meant), .. } => {
                return Some(format!("did you mean `{meant}`?"));
            }
            Self::Limit { known, .. } => return Some(format!("there are {}", known.join(", "))),
            Self::Samples { fault, .. } => sample_help(fault),
            Self::Channel { fault, .. } => channel_help(fault),
            Self::File { .. } => None,
        };
        help.map(str::to_owned)
    }
}

/// What to do about samples that are no signal.
fn sample_help(fault: &ChannelFault) -> Option<&'static str> {
    Some(match fault {
        ChannelFault::TimeBack { .. } => {
            "the first column is that of time; sort the rows by it, and leave one of two rows of the same time; a file of \
             several tests is to be cut into one for each"
        }
        ChannelFault::TooFew { .. } => "look whether the right file was exported, and whole",
        _ => return None,
    })
}

/// What to do about a channel that cannot be read as it is asked for.
fn channel_help(fault: &SettingsFault) -> Option<&'static str> {
    Some(match fault {
        SettingsFault::NoRest => {
            "give what the channel reads at rest, `--offset \"0.3 g\"`, or record from some ms before the pulse on"
        }
        SettingsFault::UnevenSteps { .. } => {
            "`--rate \"20 kHz\"` reads the line between its samples at even steps"
        }
        SettingsFault::Rate(_) => "read a part of it, or take a lower `--rate`",
        SettingsFault::NoTouch { .. } => "without `--touch` the record tells when it begins",
        SettingsFault::Cfc(CfcFault::TooSlow { .. }) => {
            "SAE J211 wants a sampling rate of ten times the class: take a lower class, or record faster"
        }
        SettingsFault::NothingLeft(_) => {
            "look at the times of the record: without `--from`, `--to` and `--rate` they are printed"
        }
        _ => return None,
    })
}
