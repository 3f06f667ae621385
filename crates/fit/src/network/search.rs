//! The search for the lowest minimum.
//!
//! Where a curve jumps, the sum of squares is a staircase of its clock with a local minimum on every sample, so no
//! descent on the samples comes from one to another. Averages over a part of a pulse depend smoothly on where it jumps.
//! So the search goes from start to start on averages, over wide and then over narrow windows, until several ended at
//! the same minimum, and only from there on the samples, with the clock between the two at which the curve jumps.

use dashpot_numerics::Stream;
use serde::Serialize;

use super::{
    Band, NetworkFault, NetworkFit, NetworkSettings, Number, Other, Phase, Test,
    certainty::certainty,
    residuals::Task,
    told::{FEWEST, deviation, deviation_at_rest, is_structured},
};
use crate::optimum::{Optimum, Residuals as _, least_squares, sum};

/// Starts whose sums differ by less than this part are at the same minimum.
const SAME: f64 = 1e-4;
/// Numbers that differ by more than this in their logarithms are others.
const APART: f64 = 0.02;
/// Residuals beyond so many standard deviations are far off.
const FAR: f64 = 3.0;
/// What is left of a test counts in no smaller parts of its peak than this.
const LEAST: f64 = 1e-12;
/// Rounds in which noise, and the samples between which curves jump, are found anew.
const ROUNDS: usize = 3;
/// Of so many parts of a pulse samples are averaged over one, first of the wide ones.
const WINDOWS: [usize; 2] = [3, 12];
/// So many starts have to end at the lowest minimum; more where more than this is left of a record in parts of its
/// noise.
const AGREE: [usize; 2] = [2, 3];
/// Sums of squares of rows in parts of their peaks that are no larger are rounding.
const EXACT: f64 = 1e-18;
/// So many starts for each number are looked at, of which the nearest come first.
const SPREAD: usize = 8;

/// Whether numbers are those of the lowest minimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Convergence {
    /// A minimum at which several starts ended, or the only one that was asked for.
    Reached,
    /// A minimum at which no other start ended: there may be a lower one.
    #[serde(rename = "one-start-alone")]
    Alone,
    /// The search ended before it was at a minimum.
    #[serde(rename = "no-minimum")]
    Unsettled,
}

pub(super) fn search(
    (numbers, tests): (&[Number], &[Test]),
    settings: NetworkSettings,
    task: &mut Task<'_>,
) -> Result<NetworkFit, NetworkFault> {
    let (rows, unknowns) = (task.rows(), task.unknowns());
    if rows <= unknowns {
        return Err(NetworkFault::TooFew { rows, unknowns });
    }
    let found = minima(numbers, settings, task)?;
    let first = found[0].clone();
    let scale = settings.is_robust.then_some(FAR);
    task.begin_phase(Phase::Refinement);
    let best = settled(task, first, scale);
    task.begin_phase(Phase::Certainty);
    let certainty = certainty(task, &best, scale, settings.profile);
    let left = task.left(&best.unknowns);
    let parts = task.parts().enumerate().flat_map(|(at, rows)| rows.map(move |row| (at, row)));
    let is_far = |(at, row): &(usize, usize)| {
        scale.is_some_and(|far| left[*row].abs() > far.max(task.solved_to(*at)))
    };
    let outliers = parts.filter(is_far).count();
    let noise = found[0].cost * (SAME + 4.0 * certainty.correlation / rows as f64);
    let is_low = |own: &Optimum| own.cost - found[0].cost <= noise + f64::MIN_POSITIVE;
    let distance = |own: &Optimum| {
        let [one, other] = [own, &found[0]].map(|own| &own.unknowns[..numbers.len()]);
        // Parts of a model that are alike may have changed places.
        if is_low(own) { apart(&sorted(one), &sorted(other)) } else { apart(one, other) }
    };
    // Along what is not determined there are others anyhow.
    let is_apart = |own: &Optimum| certainty.undetermined.ncols() == 0 && distance(own) > APART;
    let is_same =
        |own: &&Optimum| if distance(own) > APART { !is_apart(own) && is_low(own) } else { true };
    let reached = found.iter().filter(is_same).count();
    let mut others: Vec<&Optimum> =
        found.iter().filter(|own| is_low(own) && is_apart(own)).collect();
    let numbers_of = |own: &Optimum| own.unknowns[..numbers.len()].to_vec();
    others.dedup_by(|one, other| apart(&numbers_of(one), &numbers_of(other)) <= APART);
    let others = others.into_iter().map(|own| Other {
        values: task.values(&own.unknowns),
        cost: own.cost / found[0].cost.max(f64::MIN_POSITIVE),
    });
    let convergence = if !best.is_converged {
        Convergence::Unsettled
    } else if reached < AGREE[0] && settings.starts > 1 {
        Convergence::Alone
    } else {
        Convergence::Reached
    };
    let mut numbers = certainty.numbers;
    if convergence != Convergence::Reached {
        numbers.iter_mut().for_each(|own| own.ends = [None; 2]);
    }
    let mut fit = NetworkFit {
        tests: task.told(&best.unknowns),
        convergence,
        is_stopped: task.is_ended(),
        reached: [reached, found.len()],
        others: others.collect(),
        outliers,
        numbers,
        correlation: certainty.correlation,
        quantile: certainty.quantile,
        determined: certainty.determined,
        undetermined: certainty.undetermined,
    };
    for test in 0..tests.len() {
        let bands = fit.bands(&|values| task.samples(test, values, &best.unknowns));
        let half = |own: Option<Band>| own.and_then(|own| own.half.ok());
        fit.tests[test].band = bands.unwrap_or_default().into_iter().map(half).collect();
    }
    Ok(fit)
}

/// Where the search ended on averages from start to start, the lowest first, until enough of them agree.
fn minima(
    numbers: &[Number],
    settings: NetworkSettings,
    task: &mut Task<'_>,
) -> Result<Vec<Optimum>, NetworkFault> {
    let mut found: Vec<Optimum> = Vec::new();
    let mut reason = String::new();
    let of = settings.starts.max(1);
    let mut starts = vec![numbers.iter().map(|own| own.start.clamp(own.low, own.high)).collect()];
    for at in 0..of {
        if !task.begin_phase(Phase::Start { at, of }) {
            break;
        }
        if at == 1 {
            starts.extend(promising(numbers, settings, task));
        }
        let Some(values) = starts.get(at) else { break };
        match task.begin(values) {
            Ok(start) => found.extend(descended(task, &start)),
            Err(own) => reason = own,
        }
        found.sort_by(|one, other| one.cost.total_cmp(&other.cost));
        if is_agreed(&found, numbers.len(), task) {
            break;
        }
    }
    if found.is_empty() { Err(NetworkFault::Unsolved { reason }) } else { Ok(found) }
}

/// Other starts: the numbers that are spread over their bounds, those first that are nearest to the tests.
fn promising(numbers: &[Number], settings: NetworkSettings, task: &mut Task<'_>) -> Vec<Vec<f64>> {
    let count = (SPREAD * numbers.len()).max(settings.starts - 1);
    task.average(Some(WINDOWS[0]));
    let mut all: Vec<(f64, Vec<f64>)> = Vec::new();
    for values in spread(numbers, count, settings.seed) {
        let left = task.begin(&values).map(|start| task.left(&start));
        let cost = left.map_or(f64::INFINITY, |left| sum(&left, None));
        if task.is_stopped(0, cost) {
            break;
        }
        all.push((if cost.is_nan() { f64::INFINITY } else { cost }, values));
    }
    task.average(None);
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    all.into_iter().map(|own| own.1).collect()
}

/// Values between the bounds, each of which has a part of every range that no other has (a Latin hypercube of
/// logarithms).
fn spread(numbers: &[Number], count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut stream = Stream::new(seed);
    let columns: Vec<Vec<f64>> = numbers
        .iter()
        .map(|own| {
            let mut parts: Vec<usize> = (0..count).collect();
            (1..count).rev().for_each(|at| parts.swap(at, stream.below(at + 1)));
            let value = |part: usize| {
                let share = (part as f64 + stream.share()) / count as f64;
                own.low * (own.high / own.low).powf(share)
            };
            parts.into_iter().map(value).collect()
        })
        .collect();
    (0..count).map(|at| columns.iter().map(|own| own[at]).collect()).collect()
}

/// The minimum that is found from a start on averages; on samples where there are none.
pub(super) fn descended(task: &mut Task<'_>, start: &[f64]) -> Option<Optimum> {
    let [low, high] = task.bounds();
    let mut found = None;
    task.is_sought = true;
    for parts in WINDOWS {
        let is_averaged = task.average(Some(parts));
        let from = found.as_ref().map_or(start, |own: &Optimum| own.unknowns.as_slice());
        found = least_squares(task, [&low, &high], from, None);
        if !is_averaged || found.is_none() {
            break;
        }
    }
    task.average(None);
    task.is_sought = false;
    found
}

/// Whether enough starts ended at the lowest minimum.
fn is_agreed(found: &[Optimum], count: usize, task: &mut Task<'_>) -> bool {
    let Some(first) = found.first() else { return false };
    let near = SAME * first.cost + EXACT * task.rows() as f64;
    let is_same = |own: &&Optimum| {
        let [one, other] = [*own, first].map(|own| &own.unknowns[..count]);
        own.cost - first.cost <= near || apart(one, other) <= APART
    };
    let agreeing = found.iter().filter(is_same).count();
    agreeing >= AGREE[1] || agreeing >= AGREE[0] && !task.is_noisy(&first.unknowns)
}

/// The largest difference of two sets of numbers.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

fn sorted(all: &[f64]) -> Vec<f64> {
    let mut all = all.to_vec();
    all.sort_by(f64::total_cmp);
    all
}

/// The minimum of the robust sum beyond a scale, with the rows of each test counted in their noise.
fn settled(task: &mut Task<'_>, first: Optimum, scale: Option<f64>) -> Optimum {
    let mut best = Optimum { is_converged: false, ..first };
    for _ in 0..ROUNDS {
        let units = units(task, &best.unknowns, scale.is_some());
        task.count_in(&units);
        let has_jumps = task.place_jumps(&mut best.unknowns, scale);
        if task.is_ended() {
            break;
        }
        let [low, high] = task.bounds();
        let found = least_squares(task, [&low, &high], &best.unknowns, scale);
        best = found.unwrap_or(Optimum { is_converged: false, ..best });
        if !has_jumps {
            break;
        }
    }
    best
}

/// What the rows of each test are counted in: their noise where it is known, or repeats tell it, else the standard deviation that what is
/// left of them at a minimum stands for.
fn units(task: &Task<'_>, unknowns: &[f64], is_robust: bool) -> Vec<f64> {
    let left = task.left(unknowns);
    let taken = task.unknowns() as f64 / left.len() as f64;
    let parts = task.parts().zip(task.tests()).enumerate();
    let unit = |(test, (rows, own)): (usize, (std::ops::Range<usize>, &Test))| {
        if let Some(noise) = own.noise {
            return noise;
        }
        if let Some(scatter) = task.scatter(test, unknowns) {
            return scatter.deviation;
        }
        let left = &left[rows];
        let square = left.iter().map(|own| own * own).sum::<f64>() / left.len() as f64;
        let plain = (square / (1.0 - taken).max(0.1)).sqrt();
        let median = deviation(left);
        let own = if is_robust && median > 0.0 { median } else { plain };
        task.unit(test) * own.max(LEAST)
    };
    parts.map(unit).collect()
}

impl Task<'_> {
    /// Whether more is left of a test than its noise, where that is known or its rows before the impact tell it, else than
    /// white noise.
    fn is_noisy(&self, unknowns: &[f64]) -> bool {
        let left = self.left(unknowns);
        self.parts().zip(self.tests()).enumerate().any(|(at, (rows, own))| {
            let left = &left[rows];
            let resting = self.rows_at_rest(at, unknowns);
            let at_rest = (resting >= FEWEST).then(|| deviation_at_rest(&left[..resting]));
            is_structured(left, own.noise.map(|own| own / self.unit(at)), at_rest)
        })
    }
}
