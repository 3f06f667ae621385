//! `compare` and `convert` as their users meet them.

mod compare;
mod convert;

use std::path::{Path, PathBuf};

use serde_json::Value;
use tempfile::TempDir;

use crate::cli::{code, err, file, out, run, text};

/// The reference scene with a named constant, a material, and comments.
const SCENE: &str = r#"# Pads of May.
[values]
K = "20 MN/m"

[materials.foam]
zener = { spring = "0.8 MPa", maxwell = { spring = "3 MPa", dashpot = "9 kPa s" } }

# The pad of the thesis.
[models.valox-pad]
# from chapter IV
burgers = { maxwell = { spring = "K", dashpot = "6 kN s/m" }, kelvin = { spring = "20 MN/m", dashpot = "4 kN s/m" } } # Valox 310

[nodes]
head  = { mass = "10 kg", velocity = "10 m/s" }
panel = { mass = "100 kg" } # steel

[elements]
# what is hit
padding = { between = ["head", "panel"], model = "valox-pad", thickness = "2 cm" }
mount   = { between = ["panel", "ground"], parallel = [{ spring = "50 MN/m" }, { dashpot = "10 kN s/m" }] }

[run]
duration = "20 ms"
"#;

/// A folder with files.
struct Desk(TempDir);

impl Desk {
    fn with(files: &[(&str, &str)]) -> Self {
        let folder = TempDir::new().unwrap();
        for (name, content) in files {
            file(&folder, name, content);
        }
        Self(folder)
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// `FILE:NAME`, with the file in this folder.
    fn word(&self, word: &str) -> String {
        text(&self.path(word)).to_owned()
    }
}

/// Runs, expects the exit code, and returns both streams.
#[track_caller]
fn ends(arguments: &[&str], expected: i32) -> (String, String) {
    let output = run(arguments);
    // What is told goes on in further lines.
    let streams = (out(&output), err(&output).replace("\n  ", " "));
    assert_eq!(code(&output), expected, "{arguments:?}\n{}{}", streams.0, streams.1);
    streams
}

/// The measures of a run by `exact`, with their values.
fn measures(scene: &Path) -> Vec<(String, f64)> {
    let (stdout, _) = ends(&["run", text(scene), "--method", "exact", "--json"], 0);
    let answer: Value = serde_json::from_str(&stdout).unwrap();
    let measures = answer["runs"][0]["measures"].as_object().unwrap();
    measures.iter().map(|(key, own)| (key.clone(), own["value"].as_f64().unwrap())).collect()
}
