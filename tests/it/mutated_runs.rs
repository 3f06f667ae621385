//! Mutated scenes by the command: none panics, hangs, dies of a signal or prints what is no JSON.
//!
//! The sources are the gallery and the texts of the hard cases. A small part runs with all other tests. All of
//! it, 3000 scenes, takes about an hour:
//! `cargo test --test it mutated_runs::full -- --ignored --nocapture`. `DASHPOT_SCENES` and `DASHPOT_SEED`
//! ask for others, `DASHPOT_FIRST` for mutated ones from a number on, `DASHPOT_KEEP` for a folder into which what is
//! slow or wrong is written.

mod change;
mod outcome;

use std::{fs, ops::Range, path::Path};

use tempfile::TempDir;

use crate::{hard, random_networks::Dice, scenes::scene_paths};
use change::mutated;
use outcome::Outcome;

/// CPU seconds after which a run has hung.
const PATIENCE: u32 = 60;
/// CPU seconds of which the log tells.
const SLOW: f64 = 10.0;
/// The texts of larger sources take long by themselves.
const LARGEST: usize = 20_000;
const SEED: u64 = 16;
/// Scenes of all of it.
const ALL: usize = 3000;
/// Numbers of the scenes that run with all other tests.
const PART: Range<usize> = 100..140;
/// A pad on a floor that is shaken by more periods than can be followed.
const SHAKEN: &str = "[nodes]\nhead = { mass = 1, velocity = 1 }\nfloor = { motion = { sine = { amplitude = 1e-3, \
                      frequency = \"1 THz\" } } }\n[elements]\npad = { between = [\"head\", \"floor\"], spring = 1e5 }\n\
                      [run]\nduration = 1\n";

/// Names and texts of what is mutated.
fn sources() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = scene_paths()
        .into_iter()
        .map(|path| {
            (
                path.file_stem().unwrap().to_string_lossy().into_owned(),
                fs::read_to_string(path).unwrap(),
            )
        })
        .collect();
    all.extend(hard::texts());
    all.retain(|(_, text)| text.len() < LARGEST);
    all.sort();
    all
}

/// What a campaign comes to.
#[derive(Debug, Default)]
struct Log {
    solved: usize,
    refused: usize,
    failed: usize,
    slow: usize,
    wrong: Vec<String>,
}

/// Runs a text by the command and notes what comes of it.
#[expect(clippy::print_stdout, reason = "the log of the campaign")]
fn try_out(log: &mut Log, folder: &Path, name: &str, text: &str) {
    let file = folder.join("scene.toml");
    fs::write(&file, text).unwrap();
    for verb in ["check", "run"] {
        let outcome = Outcome::of(verb, &file, PATIENCE);
        let place = format!("{name} by {verb}");
        let (what, is_slow) = (outcome.wrong(), outcome.time > SLOW);
        log.slow += usize::from(is_slow);
        if is_slow || what.is_some() {
            println!("{place}: {:.1} s of CPU, {what:?}, {}", outcome.time, outcome.words());
            keep(name, text);
        }
        log.wrong.extend(what.map(|what| format!("{place}: {what}")));
        if verb == "run" {
            match outcome.code {
                Some(0) => log.solved += 1,
                Some(2) => log.refused += 1,
                _ => log.failed += 1,
            }
        }
    }
}

/// Writes a text into the folder that was asked for.
fn keep(name: &str, text: &str) {
    let Some(folder) = std::env::var_os("DASHPOT_KEEP") else { return };
    let plain = |own: char| if own.is_ascii_alphanumeric() { own } else { '-' };
    let name: String = name.chars().map(plain).collect();
    fs::write(Path::new(&folder).join(format!("slow-{name}.toml")), text).unwrap();
}

/// Mutated scenes from one number to another.
fn campaign(seed: u64, scenes: impl IntoIterator<Item = usize>) -> Log {
    let (sources, folder, mut log) = (sources(), TempDir::new().unwrap(), Log::default());
    for at in scenes {
        let mut dice = Dice(seed.wrapping_mul(1_000_003).wrapping_add(at as u64));
        let (source, text) = &sources[dice.below(sources.len())];
        let text = mutated(&mut dice, text);
        try_out(&mut log, folder.path(), &format!("{at} of {source}"), &text);
    }
    log
}

#[test]
fn mutated_scenes_end_without_a_panic() {
    let mut log = campaign(SEED, PART);
    try_out(&mut log, TempDir::new().unwrap().path(), "shaken floor", SHAKEN);
    assert!(log.wrong.is_empty(), "{:#?}", log.wrong);
    assert!(log.solved >= PART.len() / 4, "{log:?}");
}

fn wanted(name: &str) -> Option<usize> {
    std::env::var(name).ok().map(|text| text.parse().expect(name))
}

#[test]
#[ignore = "takes an hour; see the top of the file"]
fn full() {
    let seed = wanted("DASHPOT_SEED").map_or(SEED, |seed| seed as u64);
    let folder = TempDir::new().unwrap();
    let mut whole = Log::default();
    let first = wanted("DASHPOT_FIRST");
    if first.is_none() {
        for (name, text) in sources() {
            try_out(&mut whole, folder.path(), &name, &text);
        }
    }
    let first = first.unwrap_or(0);
    let log = campaign(seed, first..first + wanted("DASHPOT_SCENES").unwrap_or(ALL));
    for (what, own) in [("as they are", &whole), ("mutated", &log)] {
        let Log { solved, refused, failed, slow, wrong } = own;
        println!(
            "{what}: {solved} solved, {refused} refused, {failed} failed, {slow} above {SLOW} s"
        );
        println!("wrong: {wrong:#?}");
    }
    assert!(whole.wrong.is_empty() && log.wrong.is_empty());
}
