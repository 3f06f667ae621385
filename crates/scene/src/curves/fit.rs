//! The curve without a fall that is nearest to measured rows.

use dashpot_network::{Element as _, elements::TableSpring, parameters::CurveRole};
use dashpot_numerics::isotonic::{Block, rising};

use super::{Difference, Fitted, Row, thin::thinned};

/// Rows at one deformation.
#[derive(Debug, Clone, Copy)]
struct Level {
    at: f64,
    /// The mean of their values.
    value: f64,
    count: f64,
}

/// The curve of a role, other than unloading, through rows in any order.
pub(crate) fn fit(rows: &[Row], role: CurveRole) -> Fitted {
    let levels = levels(rows);
    let (points, values) = match role {
        CurveRole::Rising | CurveRole::Unloading => {
            pooled(&levels, f64::NEG_INFINITY..=f64::INFINITY)
        }
        CurveRole::FromRest => from_rest(&levels),
    };
    let mut difference = difference(rows, &levels, &values);
    difference.begins = levels.first().filter(|own| own.at > 0.0).map(|own| (own.at, own.value));
    if role != CurveRole::FromRest {
        difference.begins = None;
    }
    Fitted { points: thinned(points), difference }
}

/// The points that the levels come down to, and the value of each level, all within `bounds`.
fn pooled(levels: &[Level], bounds: std::ops::RangeInclusive<f64>) -> (Vec<(f64, f64)>, Vec<f64>) {
    let blocks = rising(levels.iter().map(|own| (own.value, own.count)));
    let value = |own: &Block| own.value.clamp(*bounds.start(), *bounds.end());
    let (mut points, mut values) = (Vec::new(), Vec::new());
    for block in &blocks {
        let own = &levels[block.start..block.end];
        points.push((centre(own), value(block)));
        values.extend(own.iter().map(|_| value(block)));
    }
    (points, values)
}

/// The same through (0, 0): nothing below zero beyond it, and nothing above zero before it.
fn from_rest(levels: &[Level]) -> (Vec<(f64, f64)>, Vec<f64>) {
    let before = levels.partition_point(|own| own.at < 0.0);
    let beyond = levels.partition_point(|own| own.at <= 0.0);
    let (mut points, mut values) = pooled(&levels[..before], f64::NEG_INFINITY..=0.0);
    points.push((0.0, 0.0));
    values.extend(levels[before..beyond].iter().map(|_| 0.0));
    let (pushed, their_values) = pooled(&levels[beyond..], 0.0..=f64::INFINITY);
    points.extend(pushed);
    values.extend(their_values);
    (points, values)
}

/// What is given back, nowhere above the curve of `loading`, to which rows of unloading are fitted: their shares of
/// that curve never fall, and least squares are those of the forces. It ends on that curve, at the depth of the
/// turn. Where the rows end before the force does, the line through the last tenth of the way leads to zero. `None`
/// where there is no such curve.
pub(crate) fn unloading(loading: &[(f64, f64)], rows: &[Row]) -> Option<Fitted> {
    let curve = TableSpring::new(loading.to_vec()).ok()?;
    let force = |at: f64| curve.force(at, 0.0);
    let all = levels(rows);
    let depth = all.last()?.at.min(loading.last()?.0);
    let inner: Vec<Level> = all
        .iter()
        .filter(|own| own.at > 0.0 && own.at < depth && force(own.at) > 0.0)
        .copied()
        .collect();
    let shares = inner.iter().map(|own| {
        let force = force(own.at);
        ((own.value / force).clamp(0.0, 1.0), own.count * force * force)
    });
    let blocks = rising(shares);
    let (mut points, mut fitted) = (Vec::new(), Vec::new());
    for block in &blocks {
        let own = &inner[block.start..block.end];
        let at = centre(own);
        points.push((at, block.value * force(at)));
        fitted.extend(own.iter().map(|level| (*level, block.value * force(level.at))));
    }
    let (kept, values): (Vec<Level>, Vec<f64>) = fitted.into_iter().unzip();
    let used: Vec<Row> =
        rows.iter().filter(|own| own.at > 0.0 && own.at < depth).copied().collect();
    let difference = difference(&used, &kept, &values);
    let slack = points.iter().rposition(|own| own.1 <= 0.0);
    let mut points = points.split_off(slack.unwrap_or(0));
    if slack.is_none() {
        points.insert(0, (set(&points, depth), 0.0));
    }
    points.push((depth, force(depth)));
    Some(Fitted { points: thinned(points), difference })
}

/// The deformation at which the line through the first tenth of the way has no force, not below zero.
fn set(points: &[(f64, f64)], depth: f64) -> f64 {
    let Some(&(first, value)) = points.first() else { return 0.0 };
    let end = first + 0.1 * (depth - first);
    let other = points.iter().find(|own| own.0 >= end && own.1 > value);
    let Some(&(at, more)) = other else { return 0.0 };
    (first - value * (at - first) / (more - value)).max(0.0)
}

/// The rows in order of the deformation, those at the same one together.
fn levels(rows: &[Row]) -> Vec<Level> {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by(|one, other| one.at.total_cmp(&other.at));
    let same = sorted.chunk_by(|one, other| one.at >= other.at);
    let level = |own: &[&Row]| {
        let count: f64 = own.iter().map(|_| 1.0).sum();
        // One row stays as it is.
        let mean =
            own[0].value + own.iter().map(|row| row.value - own[0].value).sum::<f64>() / count;
        Level { at: own[0].at, value: mean, count }
    };
    same.map(level).collect()
}

/// The mean deformation of levels, by their rows.
fn centre(levels: &[Level]) -> f64 {
    let [first, ..] = levels else { return 0.0 };
    let count: f64 = levels.iter().map(|own| own.count).sum();
    first.at + levels.iter().map(|own| own.count * (own.at - first.at)).sum::<f64>() / count
}

/// How far the values of levels are from the rows in them.
fn difference(rows: &[Row], levels: &[Level], values: &[f64]) -> Difference {
    let peak = values.iter().copied().fold(0.0, |most: f64, own| most.max(own.abs()));
    let mut found = Difference { peak, rows: rows.len(), ..Difference::default() };
    let mut sum = 0.0;
    for row in rows {
        let at = levels.partition_point(|own| own.at < row.at);
        let Some(value) = values.get(at).filter(|_| levels[at].at <= row.at) else { continue };
        let off = (value - row.value).abs();
        sum += off;
        if off > found.largest {
            (found.largest, found.start) = (off, row.start);
        }
    }
    let count: f64 = rows.iter().map(|_| 1.0).sum();
    found.mean = if rows.is_empty() { 0.0 } else { sum / count };
    found
}
