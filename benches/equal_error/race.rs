//! What each contender needs for a wanted error.

use std::{
    hint::black_box,
    time::{Duration, Instant},
};

use super::{by_hand::Job, cpu::cpu};

/// Tolerances are tried from 10⁻¹ to 10⁻¹³, this many to a decade.
const TO_A_DECADE: i32 = 4;
/// Turns of each contender, and how long one lasts at least \[s\].
const TURNS: usize = 5;
const TURN: f64 = 0.1;

/// What is said of a wanted error where no tolerance leads to it, and none fails either.
const NOT_REACHED: &str = "not reached";

/// Someone who solves a problem.
pub(crate) struct Contender<'a> {
    /// Its name.
    pub(crate) name: String,
    /// How it does it.
    pub(crate) job: Job<'a>,
    /// Whether tolerances make no difference to it.
    pub(crate) is_exact: bool,
}

/// The loosest tolerance with which a wanted error is reached, and the error there.
#[derive(Clone, Copy)]
pub(crate) struct Reached {
    /// The tolerance.
    pub(crate) rtol: f64,
    /// The error, in parts of the largest value.
    pub(crate) error: f64,
}

/// What a contender can do.
pub(crate) struct Ladder {
    /// For each wanted error what reaches it.
    pub(crate) reached: [Option<Reached>; 3],
    /// Why it went no further, where it did not reach all.
    pub(crate) end: String,
}

/// The largest difference in parts of the largest true value.
pub(crate) fn error(found: &[f64], truth: &[f64]) -> f64 {
    let largest = truth.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let differences = found.iter().zip(truth).map(|(one, other)| (one - other).abs());
    differences.fold(0.0, f64::max) / largest
}

/// Climbs from tolerance to tolerance until all `wanted` errors are reached, each by two tolerances
/// in a row, so that none is met by chance; or until a run lasts longer than `patience`.
pub(crate) fn climb(
    contender: &mut Contender<'_>,
    truth: &[f64],
    wanted: [f64; 3],
    patience: Duration,
) -> Ladder {
    let mut rungs: Vec<Reached> = Vec::new();
    let mut end = NOT_REACHED.to_owned();
    for rung in TO_A_DECADE..=13 * TO_A_DECADE {
        let rtol = 10_f64.powf(-f64::from(rung) / f64::from(TO_A_DECADE));
        let clock = Instant::now();
        match (contender.job)(rtol) {
            Ok(found) => {
                rungs.push(Reached { rtol, error: error(&found, truth) });
                NOT_REACHED.clone_into(&mut end);
            }
            // A loose tolerance may fail where a tighter one does not.
            Err(reason) => end = reason,
        }
        let least = wanted.iter().copied().fold(f64::INFINITY, f64::min);
        let is_done = rungs.iter().rev().take(2).filter(|rung| rung.error <= least).count() == 2;
        if is_done || contender.is_exact {
            break;
        }
        if clock.elapsed() > patience {
            end = format!("over {} s", patience.as_secs());
            break;
        }
    }
    let first = |wanted: f64| {
        let holds = |at: &usize| rungs[*at..].iter().take(2).all(|own| own.error <= wanted);
        (0..rungs.len()).find(holds).map(|at| rungs[at])
    };
    Ladder { reached: wanted.map(first), end }
}

/// What jobs cost at their tolerances \[s\]: medians of CPU time in turns that they take, so that the
/// machine's moods hit all alike.
pub(crate) fn race<const N: usize>(mut jobs: [(&mut Job<'_>, f64); N]) -> [f64; N] {
    let clock = Instant::now();
    let mut times = [[0.0; TURNS]; N];
    for turn in 0..TURNS {
        for ((job, rtol), times) in jobs.iter_mut().zip(&mut times) {
            let (begin, mut rounds, mut spent) = (cpu(clock), 0, 0.0);
            while spent < TURN {
                drop(black_box(job(*rtol)));
                rounds += 1;
                spent = cpu(clock) - begin;
            }
            times[turn] = spent / f64::from(rounds);
        }
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[TURNS / 2]
    })
}
