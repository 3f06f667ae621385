//! What came of a run of the command.

use std::{path::Path, process::Command};

use serde_json::Value;

/// Memory that a run may take \[KiB\].
const MEMORY: u32 = 8_000_000;
/// Limits, the command, and the time that it took.
const SCRIPT: &str = "ulimit -t $1; ulimit -v $2; shift 2; \"$@\"; code=$?; times >&2; exit $code";

/// How a command ended.
#[derive(Debug)]
pub(super) struct Outcome {
    /// Its exit code; above 128 for a signal.
    pub(super) code: Option<i32>,
    /// CPU time \[s\].
    pub(super) time: f64,
    out: Vec<u8>,
    err: String,
}

impl Outcome {
    /// Runs a verb of the command on a file, with at most so many seconds of CPU time.
    pub(super) fn of(verb: &str, file: &Path, seconds: u32) -> Self {
        let mut command = Command::new("sh");
        command.args(["-c", SCRIPT, "sh", &seconds.to_string(), &MEMORY.to_string()]);
        command.arg(env!("CARGO_BIN_EXE_dashpot")).arg(verb).arg(file).env("RUST_BACKTRACE", "0");
        if verb == "run" {
            command.arg("--json");
        }
        let output = command.output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr).into_owned();
        let time = err.lines().last().map_or(0.0, cpu_time);
        Self { code: output.status.code(), time, out: output.stdout, err }
    }

    /// What is wrong with it.
    pub(super) fn wrong(&self) -> Option<String> {
        let what = match self.code {
            Some(0) if !self.out.is_empty() && self.out[0] == b'{' => {
                serde_json::from_slice::<Value>(&self.out).err().map(|error| error.to_string())
            }
            Some(0) => None,
            Some(1 | 2) => {
                (self.err.lines().count() < 3).then(|| "ends without a reason".to_owned())
            }
            code => Some(format!("exit code {code:?} after {:.1} s", self.time)),
        };
        what.map(|what| format!("{what}: {}", self.words()))
    }

    /// The first words that it said.
    pub(super) fn words(&self) -> String {
        let first: Vec<&str> = self.err.lines().take(3).collect();
        first.join(" | ").chars().take(250).collect()
    }
}

/// The sum of two times such as `0m1.25s`.
fn cpu_time(line: &str) -> f64 {
    let one = |text: &str| -> Option<f64> {
        let (minutes, seconds) = text.trim_end_matches('s').split_once('m')?;
        Some(60.0 * minutes.parse::<f64>().ok()? + seconds.parse::<f64>().ok()?)
    };
    line.split_whitespace().filter_map(one).sum()
}
