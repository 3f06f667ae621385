//! Generated scenes beside an independent integrator.
//!
//! `campaign/reference` draws scenes from seeds, of all elements and effects, and solves them event by event to some
//! 1e-12 in code that shares nothing with the program. A hundred of them with their values are kept beside it and run
//! with all other tests; a thousand are tried by hand:
//!
//! ```text
//! python3 tests/it/campaign/reference 1000 FILE
//! DASHPOT_CAMPAIGN=FILE cargo test --test it campaign::full -- --ignored --nocapture
//! ```
//!
//! No number may be beyond three of its bars, and one in a hundred beyond one.

mod table;
mod tally;

use std::fs;

use dashpot::{
    analysis::{RunError, solve},
    dae::SolveError,
    scene::{ReadOptions, read},
};

use crate::calibration::Patience;
use table::Entry;
use tally::Tally;

const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/campaign/scenes.txt");
const METHODS: [&str; 6] = ["auto", "exact", "bdf", "tr-bdf2", "esdirk34", "tsit45"];
/// Steps that a method may take for one scene, with all its solutions.
const PATIENCE: usize = 200_000;

/// Kept scenes that the program does not solve rightly, and why.
const KNOWN: [(&str, &str); 0] = [];

/// Solves each scene by each method that takes it.
fn campaign(path: &str, methods: &[&str]) -> Tally {
    let table = fs::read_to_string(path).unwrap();
    let mut tally = Tally::default();
    for entry in Entry::all(&table) {
        if KNOWN.iter().any(|(name, _)| *name == entry.name) {
            tally.known += 1;
            continue;
        }
        let scene = match read(&entry.text, &ReadOptions::default()) {
            Ok(scene) => scene.value,
            Err(faults) => {
                tally.failed.push(format!("{}: {faults}", entry.name));
                continue;
            }
        };
        for method in methods {
            let name = format!("{} by {method}", entry.name);
            let settings = scene.settings(method);
            match solve(&scene.network, &settings, &mut Patience { steps: PATIENCE }) {
                Ok(report) => tally.add(&name, &entry, &report),
                Err(RunError::Solve(SolveError::NotApplicable { .. })) if *method != "auto" => {}
                Err(RunError::Solve(SolveError::Cancelled { .. })) => tally.too_long.push(name),
                Err(error) => tally.failed.push(format!("{name}: {error}")),
            }
        }
    }
    tally
}

#[test]
fn kept_scenes_are_as_an_independent_integrator_has_them() {
    let tally = campaign(KEPT, &METHODS);
    assert!(tally.is_good(), "{tally}");
}

#[test]
#[ignore = "takes many minutes, and a file of scenes; see the top of the file"]
fn full() {
    let path = std::env::var("DASHPOT_CAMPAIGN").expect("a file of scenes");
    let chosen = std::env::var("DASHPOT_METHODS");
    let methods: Vec<&str> =
        chosen.as_ref().map_or(METHODS.to_vec(), |own| own.split(',').collect());
    let tally = campaign(&path, &methods);
    println!("{tally}");
    assert!(tally.is_good());
}
