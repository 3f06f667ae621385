//! The best static stress of a curve, and the stresses that keep a limit.

use dashpot_numerics::extrema::maximum_within;

use super::{
    CushionPoint, Known, NoCushion,
    curves::{Curve, Tests},
    edge::{Seen, edge, surely},
};

/// The logarithm of a best stress is found to this …
const NEAR: f64 = 2e-4;
/// … and that of one beyond which something ends to this.
const NEAREST: f64 = 4e-6;
/// Whether a peak falls up to an end is seen in this part of the way there.
const INNER: f64 = 1e-3;
/// Stresses between which a range is looked for, in parts of the scene's own, and how many.
const AROUND: [f64; 2] = [1e-2, 1e2];
const SOUNDINGS: u16 = 25;
/// A range reaches so far below the least of the best stresses, and above the largest of them.
const BELOW: f64 = 6.0;
const ABOVE: f64 = 4.0;
/// Stresses of a range that nobody gave.
const USUAL: u16 = 40;

dashpot_units::words! {
    /// Where the least peak of a curve lies.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Place, pub fn word(self) {
        /// Within the range of stresses.
        Within = "within",
        /// At its lower end: it may be less below.
        Low = "low",
        /// At its upper end: it may be less above.
        High = "high",
        /// Where what is known of the cushion ends.
        EndOfKnown = "end-of-known",
    }
}

/// The least peak of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Best {
    /// The drop.
    pub point: CushionPoint,
    /// Where it lies.
    pub place: Place,
}

dashpot_units::words! {
    /// How a range of stresses that keep a limit ends.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Reach, pub fn word(self) {
        /// The peak exceeds the limit beyond.
        Limit = "limit",
        /// What was looked at ends.
        Range = "range",
        /// What is known of the cushion ends.
        Known = "known",
    }
}

/// The static stresses about the best one that keep a limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passing {
    /// The least and the largest \[Pa\].
    pub stress: [f64; 2],
    /// How each end comes about.
    pub ends: [Reach; 2],
}

/// The best stress of a curve, and the range about it that keeps a limit.
pub(super) fn find(
    tests: &Tests<'_>,
    curve: &Curve,
    limit: Option<f64>,
) -> (Option<Best>, Option<Passing>) {
    let best = best(tests, curve);
    let keeping = best.filter(|own| limit.is_some_and(|limit| own.point.keeps(limit)));
    (best, keeping.zip(limit).map(|(best, limit)| passing(tests, curve, best, limit)))
}

fn best(tests: &Tests<'_>, curve: &Curve) -> Option<Best> {
    let points = &curve.points;
    let usable = points.iter().enumerate().filter(|own| own.1.is_usable());
    let (at, least) = usable.min_by(|one, other| one.1.peak.total_cmp(&other.1.peak))?;
    let drop = |log: f64| tests.drop(curve.height, curve.thickness, log.exp());
    let rough = |log: f64| low(&tests.rough(curve.height, curve.thickness, log.exp()));
    let better =
        |own: CushionPoint| if own.is_usable() && own.peak < least.peak { own } else { *least };
    let last = points.len() - 1;
    let place = match at {
        _ if at == last => Place::High,
        _ if !points[at + 1].is_usable() => Place::EndOfKnown,
        0 => Place::Low,
        _ => Place::Within,
    };
    match place {
        Place::Low | Place::High => return Some(Best { point: *least, place }),
        Place::Within => {
            let three = [at - 1, at, at + 1].map(|at| (points[at].stress.ln(), low(&points[at])));
            let found = maximum_within(three, NEAR, rough);
            return Some(Best { point: better(drop(found.0)), place });
        }
        Place::EndOfKnown => {}
    }
    // It falls up to there, or has turned before.
    let from = (least.stress.ln(), low(least));
    let beyond = (points[at + 1].stress.ln(), f64::INFINITY);
    let excess = |log: f64| if rough(log).is_finite() { -1.0 } else { f64::INFINITY };
    let [(end, _), _] = edge((from.0, -1.0), beyond, NEAREST, excess);
    let (edge, inner) = (drop(end), end - INNER * (end - from.0));
    let (at_end, at_inner) = (low(&edge), rough(inner));
    let three = if from.1 > at_end.max(at_inner) {
        let Some(before) = at.checked_sub(1).map(|at| &points[at]) else {
            return Some(Best { point: *least, place: Place::Low });
        };
        [(before.stress.ln(), low(before)), from, (end, at_end)]
    } else if at_inner > at_end {
        [from, (inner, at_inner), (end, at_end)]
    } else {
        return Some(Best { point: better(edge), place });
    };
    let found = maximum_within(three, NEAR, rough);
    Some(Best { point: better(drop(found.0)), place: Place::Within })
}

/// What is largest where a peak is lowest.
fn low(own: &CushionPoint) -> f64 {
    if own.is_usable() { -own.peak } else { f64::NEG_INFINITY }
}

fn passing(tests: &Tests<'_>, curve: &Curve, best: Best, limit: f64) -> Passing {
    let from = (best.point.stress.ln(), best.point.excess(limit));
    let best = best.point.stress;
    let below = curve.points.iter().rev().filter(|own| own.stress < best);
    let above = curve.points.iter().filter(|own| own.stress > best);
    let low = end(tests, curve, limit, from, below);
    let high = end(tests, curve, limit, from, above);
    Passing { stress: [low.0, high.0], ends: [low.1, high.1] }
}

/// Where the stresses that keep a limit end, along points that lead away from the best one.
fn end<'c>(
    tests: &Tests<'_>,
    curve: &Curve,
    limit: f64,
    best: Seen,
    points: impl Iterator<Item = &'c CushionPoint>,
) -> (f64, Reach) {
    let mut last = best;
    for point in points {
        let excess = point.excess(limit);
        let here = (point.stress.ln(), excess);
        if excess <= 0.0 {
            last = here;
            continue;
        }
        let drop = |log: f64| tests.rough(curve.height, curve.thickness, log.exp());
        let [kept, beyond] = edge(last, here, NEAREST, |log| drop(log).excess(limit));
        let held = |log: f64| tests.drop(curve.height, curve.thickness, log.exp()).keeps(limit);
        let sure = surely(kept.0, last.0, NEAREST, held);
        let is_exceeded = beyond.1.is_finite() || drop(beyond.0).known == Known::Infinite;
        let reach = if is_exceeded { Reach::Limit } else { Reach::Known };
        return (sure.exp(), reach);
    }
    (last.0.exp(), Reach::Range)
}

/// Static stresses at equal ratios from well below the best ones of all curves to above them.
pub(super) fn range(tests: &Tests<'_>) -> Result<Vec<f64>, NoCushion> {
    let own = tests.platen.stress();
    let around = AROUND.map(|part| part * own);
    let ends = |all: &[f64]| [all[0], all[all.len() - 1]];
    let mut found: Option<[f64; 2]> = None;
    for height in ends(&tests.asked.heights) {
        for thickness in ends(&tests.asked.thicknesses) {
            let drops = ratios(around, SOUNDINGS).map(|own| tests.rough(height, thickness, own));
            let usable = drops.filter(CushionPoint::is_usable);
            let least = usable.min_by(|one, other| one.peak.total_cmp(&other.peak));
            let Some(least) = least else { continue };
            let [low, high] = found.unwrap_or([least.stress; 2]);
            found = Some([low.min(least.stress), high.max(least.stress)]);
        }
    }
    let none = || {
        let missing = tests.missing.told(0);
        let beyond = "none of them is within what is known of the cushion".to_owned();
        let reason = missing.causes.into_iter().next().map_or(beyond, |own| own.cause.message);
        NoCushion::NoStress { range: around, reason }
    };
    let [low, high] = found.ok_or_else(none)?;
    Ok(ratios([low / BELOW, high * ABOVE], USUAL).collect())
}

/// So many numbers at equal ratios.
pub(super) fn ratios([low, high]: [f64; 2], count: u16) -> impl Iterator<Item = f64> {
    let last = f64::from(count - 1);
    (0..count).map(move |at| low * (high / low).powf(f64::from(at) / last))
}
