//! Generated scenes beside an independent integrator.
//!
//! `campaign/reference` draws scenes from seeds, of all elements and effects, and solves them event by event to some
//! 1e-12 in code that shares nothing with the program. A hundred of them, and thirty of the later kinds (seeds from 100 000
//! on: coinciding eigenvalues, measured curves, pulses of several humps), are kept beside it with their values and run with all
//! other tests; a thousand are tried by hand:
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
    analysis::{RunError, Solve},
    dae::SolveError,
    scene::{ReadOptions, read},
};

use crate::calibration::Patience;
use table::Entry;
use tally::Tally;

const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/it/campaign/scenes.txt");
const METHODS: [&str; 7] = ["auto", "exact", "bdf", "tr-bdf2", "esdirk34", "tsit45", "dop853"];
/// Steps that a method may take for one scene, with all its solutions, and where it is tried with all other tests.
const PATIENCE: usize = 200_000;
const SHORT_PATIENCE: usize = 40_000;
/// So many of the kept runs may be longer.
const MOST_TOO_LONG: usize = 10;

/// Scenes that the program does not solve rightly, by all methods or by one, and why.
const KNOWN: [(&str, &str); 3] = [
    (
        "12 driven by esdirk34",
        "bars of esdirk34 beside a rate spring are half as wide as they ought to be",
    ),
    (
        "34 struck by esdirk34",
        "the linear part of a power dashpot is beyond the bars of fine solutions",
    ),
    (
        "991 driven by esdirk34",
        "the balances of a power dashpot below exponent 1 are refused at the first instant",
    ),
];

/// Solves each scene by those methods that take it of the ones for its number.
fn campaign<'a>(path: &str, patience: usize, methods: impl Fn(usize) -> Vec<&'a str>) -> Tally {
    let table = fs::read_to_string(path).unwrap();
    let mut tally = Tally::default();
    for (at, entry) in Entry::all(&table).enumerate() {
        let is_known = |name: &str| KNOWN.iter().any(|(known, _)| name.starts_with(known));
        if is_known(&entry.name) {
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
        for method in methods(at) {
            let name = format!("{} by {method}", entry.name);
            if is_known(&name) {
                tally.known += 1;
                continue;
            }
            let settings = scene.settings(method).unwrap();
            match scene.network.solve_watched(&settings, &mut Patience { steps: patience }) {
                Ok(report) => tally.add(&name, &entry, &report),
                Err(RunError::Solve(SolveError::NotApplicable { .. })) if method != "auto" => {}
                Err(RunError::Solve(SolveError::Cancelled { .. })) => tally.too_long.push(name),
                Err(error) => tally.failed.push(format!("{name}: {error}")),
            }
        }
    }
    tally
}

#[test]
fn kept_scenes_are_as_an_independent_integrator_has_them() {
    // What the program chooses, and beside every other scene one of the others in turn.
    let other = |at: usize| METHODS[1 + at / 2 % (METHODS.len() - 1)];
    let methods = |at: usize| match at % 2 {
        0 => vec![METHODS[0], other(at)],
        _ => vec![METHODS[0]],
    };
    let tally = campaign(KEPT, SHORT_PATIENCE, methods);
    println!("{tally}");
    assert!(tally.is_good() && tally.too_long.len() <= MOST_TOO_LONG, "{tally}");
}

#[test]
#[ignore = "takes many minutes, and a file of scenes; see the top of the file"]
fn full() {
    let path = std::env::var("DASHPOT_CAMPAIGN").expect("a file of scenes");
    let chosen = std::env::var("DASHPOT_METHODS");
    let methods: Vec<&str> =
        chosen.as_ref().map_or(METHODS.to_vec(), |chosen| chosen.split(',').collect());
    let tally = campaign(&path, PATIENCE, |_| methods.clone());
    println!("{tally}");
    assert!(tally.is_good());
}
