//! What always holds, on generated input: networks through all methods, and texts of every kind.
//!
//! The seed is fixed, so a run repeats; `PROPTEST_CASES` asks for more cases and `PROPTEST_RNG_SEED`
//! for others. A case that fails is shrunk and printed; it goes into `tests/corpus`, all of which is
//! replayed.

mod corpus;
mod grammar;
mod invariants;
mod mutations;
mod networks;
mod readers;
mod scenes;
mod solved;
mod symmetries;

use std::{env, path::PathBuf};

use proptest::test_runner::{Config, RngSeed};

/// So many cases of fixed seed; more or others if the environment asks for them.
fn config(cases: u32) -> Config {
    let standard = Config::default();
    let is_asked = |name: &str| env::var_os(name).is_some();
    Config {
        cases: if is_asked("PROPTEST_CASES") { standard.cases } else { cases },
        rng_seed: if is_asked("PROPTEST_RNG_SEED") {
            standard.rng_seed
        } else {
            RngSeed::Fixed(0x0da5_4907)
        },
        failure_persistence: None,
        max_shrink_iters: 400,
        ..standard
    }
}

/// The files of a folder of the corpus, by name.
fn corpus(folder: &str) -> Vec<(String, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/corpus").join(folder);
    let files = folder.read_dir().unwrap().map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, std::fs::read(path).unwrap())
        })
        .collect();
    files.sort();
    files
}
