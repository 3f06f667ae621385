//! The command as its users meet it: exit codes, both streams, and files.

mod input;
mod results;
mod streams;
mod verbs;
mod verdict;

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::Value;
use tempfile::TempDir;

/// A pad that is far too soft.
const SOFT: &str = r#"
[values]
K = "50 kN/m"
[nodes]
head = { mass = "5 kg", velocity = "6 m/s" }
[elements]
pad = { between = ["head", "ground"], kelvin-voigt = { spring = "K", dashpot = "80 N s/m" }, thickness = "3 cm" }
[run]
duration = "40 ms"
"#;

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dashpot"));
    command.args(arguments).env_remove("NO_COLOR");
    command
}

pub(crate) fn run(arguments: &[&str]) -> Output {
    command(arguments).output().unwrap()
}

pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

pub(crate) fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub(crate) fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// What is said on standard error, without its line breaks.
pub(crate) fn said(output: &Output) -> String {
    err(output).split_whitespace().collect::<Vec<_>>().join(" ")
}

pub(crate) fn json(arguments: &[&str]) -> Value {
    let output = run(arguments);
    assert_eq!(code(&output), 0, "{}", err(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

pub(crate) fn file(folder: &TempDir, name: &str, text: &str) -> PathBuf {
    let path = folder.path().join(name);
    fs::write(&path, text).unwrap();
    path
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

pub(crate) fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}
