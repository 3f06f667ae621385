//! What always holds, on generated input: networks through all methods, and texts of every kind.
//!
//! The seed is fixed, so a run repeats; `PROPTEST_CASES` asks for more cases and `PROPTEST_RNG_SEED`
//! for others. A case that fails is shrunk and printed; networks that failed are in `tests/corpus`, all of
//! which is replayed.

mod grammar;
mod invariants;
mod methods;
mod mutations;
pub(crate) mod networks;
mod readers;
mod scenes;
pub(crate) mod solved;

use std::env;

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
