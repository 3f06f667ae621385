//! The best static stress of a curve, and the stresses that keep a limit.

use dashpot_numerics::extrema::maximum;

use super::{
    NoCushion,
    curves::{Curve, CushionPoint, Tests},
};

/// Steps of a golden section between two stresses of a curve: they narrow it to 10⁻⁴.
const STEPS: usize = 18;
/// Halvings between two stresses of which one keeps a limit.
const HALVINGS: usize = 24;
/// Stresses between which a range is looked for, in parts of the scene's own, and how many.
const AROUND: [f64; 2] = [1e-2, 1e2];
const SOUNDINGS: u16 = 25;
/// A range reaches so far below the least of the best stresses, and above the largest of them.
const BELOW: f64 = 6.0;
const ABOVE: f64 = 4.0;
/// Stresses of a range that nobody gave.
const USUAL: u16 = 40;

/// Where the least peak of a curve lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Within the range of stresses.
    Within,
    /// At its lower end: it may be less below.
    Low,
    /// At its upper end: it may be less above.
    High,
    /// Where what is known of the cushion ends.
    EndOfKnown,
}

impl Place {
    /// Its word: `within`, `low`, `high` or `end-of-known`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Within => "within",
            Self::Low => "low",
            Self::High => "high",
            Self::EndOfKnown => "end-of-known",
        }
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

/// How a range of stresses that keep a limit ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reach {
    /// The peak exceeds the limit beyond.
    Limit,
    /// What was looked at ends.
    Range,
    /// What is known of the cushion ends.
    Known,
}

impl Reach {
    /// Its word: `limit`, `range` or `known`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Limit => "limit",
            Self::Range => "range",
            Self::Known => "known",
        }
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

/// Finds the best stress of a curve, and the range about it that keeps a limit.
pub(super) fn find(tests: &Tests<'_>, curve: &mut Curve, limit: Option<f64>) {
    curve.best = best(tests, curve);
    let keeping = curve.best.filter(|own| limit.is_some_and(|limit| own.point.keeps(limit)));
    curve.passing = keeping.zip(limit).map(|(best, limit)| passing(tests, curve, best, limit));
}

fn best(tests: &Tests<'_>, curve: &Curve) -> Option<Best> {
    let points = &curve.points;
    let usable = points.iter().enumerate().filter(|own| own.1.is_usable());
    let (at, least) = usable.min_by(|one, other| one.1.peak.total_cmp(&other.1.peak))?;
    let drop = |log: f64| tests.drop(curve.height, curve.thickness, log.exp());
    let rough = |log: f64| tests.rough(curve.height, curve.thickness, log.exp());
    let last = points.len() - 1;
    let is_known_above = at < last && points[at + 1].is_usable();
    if at > 0 && is_known_above && points[at - 1].is_usable() {
        let ends = [at - 1, at + 1].map(|at| points[at].stress.ln());
        let found = maximum(ends[0], ends[1], STEPS, |log| {
            let own = rough(log);
            if own.is_usable() { -own.peak } else { f64::NEG_INFINITY }
        });
        let point = drop(found.0);
        let point = if point.is_usable() && point.peak < least.peak { point } else { *least };
        return Some(Best { point, place: Place::Within });
    }
    let place = match at {
        0 => Place::Low,
        _ if at == last => Place::High,
        _ if !is_known_above => Place::EndOfKnown,
        _ => Place::Within,
    };
    if place != Place::EndOfKnown {
        return Some(Best { point: *least, place });
    }
    // It falls up to there, or has turned before.
    let from = points[at - 1].stress.ln();
    let end = halved(least.stress.ln(), points[at + 1].stress.ln(), |log| rough(log).is_usable());
    let (log, _) = maximum(from, end, STEPS, |log| -rough(log).peak);
    let (inner, edge) = (drop(log), drop(end));
    let is_edge = edge.is_usable() && edge.peak <= inner.peak;
    let place = if is_edge { Place::EndOfKnown } else { Place::Within };
    let point = if is_edge || !inner.is_usable() { edge } else { inner };
    Some(Best { point: if point.is_usable() { point } else { *least }, place })
}

/// The last place towards `without` at which something still holds that holds at `with`.
fn halved(mut with: f64, mut without: f64, holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (with + without);
        *(if holds(middle) { &mut with } else { &mut without }) = middle;
    }
    with
}

fn passing(tests: &Tests<'_>, curve: &Curve, best: Best, limit: f64) -> Passing {
    let best = best.point.stress;
    let below = curve.points.iter().rev().filter(|own| own.stress < best);
    let above = curve.points.iter().filter(|own| own.stress > best);
    let low = end(tests, curve, limit, best, below);
    let high = end(tests, curve, limit, best, above);
    Passing { stress: [low.0, high.0], ends: [low.1, high.1] }
}

/// Where the stresses that keep a limit end, along points that lead away from the best one.
fn end<'c>(
    tests: &Tests<'_>,
    curve: &Curve,
    limit: f64,
    best: f64,
    points: impl Iterator<Item = &'c CushionPoint>,
) -> (f64, Reach) {
    let mut last = best;
    for point in points {
        if point.keeps(limit) {
            last = point.stress;
            continue;
        }
        let drop = |log: f64| tests.rough(curve.height, curve.thickness, log.exp());
        let log = halved(last.ln(), point.stress.ln(), |log| drop(log).keeps(limit));
        let beyond = drop(log + 1e-6 * (point.stress.ln() - last.ln()).signum());
        let reach = if beyond.is_usable() { Reach::Limit } else { Reach::Known };
        return (log.exp(), reach);
    }
    (last, Reach::Range)
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
    let reason = "none of them is within what is known of the cushion".to_owned();
    let [low, high] = found.ok_or(NoCushion::NoStress { range: around, reason })?;
    Ok(ratios([low / BELOW, high * ABOVE], USUAL).collect())
}

/// So many numbers at equal ratios.
fn ratios([low, high]: [f64; 2], count: u16) -> impl Iterator<Item = f64> {
    let last = f64::from(count - 1);
    (0..count).map(move |at| low * (high / low).powf(f64::from(at) / last))
}
