//! The sum of the least maximum, by exchange of the places of greatest deviation.

use std::f64::consts::PI;

use dashpot_numerics::{extrema::vertex, roots::bisect};
use nalgebra::{DMatrix, DVector};

use super::{approach, kinds::Sum, target::Target, whole};

/// Intervals between two neighbouring places in which a lobe's peak is looked for.
const INTERVALS: usize = 12;

/// Lobes are level when their sizes agree to this part.
const LEVEL: f64 = 1e-6;

/// A sum of n terms and 2n + 1 places, at which its deviation alternates once it is levelled.
#[derive(Debug, Clone)]
pub(super) struct Levelled {
    pub(super) sum: Sum,
    /// Values of `ln t`, rising.
    pub(super) places: Vec<f64>,
}

impl Levelled {
    /// The best single term.
    pub(super) fn single(target: &Target<'_>) -> Self {
        let [start, end] = target.steep_range();
        let places = vec![start, 0.5 * (start + end), end];
        Self::guessed(target, single(target), places).levelled(target)
    }

    /// The best sum with one term more.
    pub(super) fn with_one_more(&self, target: &Target<'_>) -> Self {
        let known = self.steep_places(target);
        let places = resampled(&known, 2, 0.0);
        if let [(time, strength)] = self.sum.terms[..] {
            let sum = pair(target, time, strength);
            return Self::guessed(target, sum, places).levelled(target);
        }
        let (times, strengths): (Vec<f64>, Vec<f64>) = self.sum.terms.iter().copied().unzip();
        let weaker = (times.len() as f64 / (times.len() as f64 + 1.0)).ln();
        let times = resampled(&times, 1, 0.5);
        let strengths = resampled(&strengths, 1, 0.5);
        let terms = times
            .into_iter()
            .zip(strengths.into_iter().map(|strength| strength + weaker))
            .collect();
        Self { sum: Sum { terms }, places }.levelled(target)
    }

    /// With the peaks of the deviation for places if it alternates already, else with `places`.
    fn guessed(target: &Target<'_>, sum: Sum, places: Vec<f64>) -> Self {
        let peaks = peaks(target, &sum, &places);
        let places = peaks
            .map(|peaks| peaks.into_iter().map(|(place, _)| place).collect())
            .unwrap_or(places);
        Self { sum, places }
    }

    /// The places, but the first and the last where their lobes begin to be flat: far outside of the
    /// spectrum's times the deviation stays the same, and there is no room for further lobes.
    fn steep_places(&self, target: &Target<'_>) -> Vec<f64> {
        let deviation = |place| self.sum.share(place) / target.quick_share(place) - 1.0;
        let mut places = self.places.clone();
        for _ in 0..2 {
            // Turned around, the first place and the last are treated alike.
            let peak = deviation(places[0]);
            places[0] = bisect(places[0], places[1], 30, |at| deviation(at) / peak <= 0.97).0;
            places.reverse();
        }
        places
    }

    /// Levels the deviation at the places and moves these to the peaks of its lobes, in turn, after
    /// Remez. Ends where it is level, or where the digits of the creep functions end.
    fn levelled(mut self, target: &Target<'_>) -> Self {
        for _ in 0..30 {
            let shares: Vec<f64> = self.places.iter().map(|place| target.share(*place)).collect();
            let Some(sum) = equalised(&self.sum, &self.places, &shares) else { break };
            let peaks = peaks(target, &sum, &self.places);
            self.sum = sum;
            let Some(peaks) = peaks else { break };
            self.places = peaks.iter().map(|(place, _)| *place).collect();
            let sizes = peaks.iter().map(|(_, deviation)| deviation.abs());
            let low = sizes.clone().fold(f64::INFINITY, f64::min);
            let high = sizes.fold(0.0, f64::max);
            if high - low <= LEVEL * high {
                break;
            }
        }
        self
    }
}

/// Place and deviation at the peak of each lobe, if there are as many lobes as `places`, between
/// which the deviation changes its sign.
fn peaks(target: &Target<'_>, sum: &Sum, places: &[f64]) -> Option<Vec<(f64, f64)>> {
    let [start, end] = target.range();
    let sampled = |place: f64| {
        let share = target.quick_share(place);
        (place, (sum.share(place) - share) / share)
    };
    let ends: Vec<f64> = [start].into_iter().chain(places.iter().copied()).chain([end]).collect();
    let mut row: Vec<(f64, f64)> = Vec::with_capacity(ends.len() * INTERVALS);
    for pair in ends.windows(2).filter(|pair| pair[1] > pair[0]) {
        for index in 0..INTERVALS {
            let part = index as f64 / INTERVALS as f64;
            row.push(sampled(pair[0] * (1.0 - part) + pair[1] * part));
        }
    }
    row.push(sampled(end));
    let mut peaks: Vec<usize> = Vec::with_capacity(places.len());
    for (index, (_, deviation)) in row.iter().enumerate() {
        match peaks.last_mut() {
            Some(peak) if row[*peak].1 * deviation > 0.0 => {
                if deviation.abs() > row[*peak].1.abs() {
                    *peak = index;
                }
            }
            _ => peaks.push(index),
        }
    }
    if peaks.len() != places.len() {
        return None;
    }
    let refined = peaks.into_iter().map(|peak| {
        let Some([left, middle, right]) =
            peak.checked_sub(1).and_then(|left| row.get(left..left + 3))
        else {
            return row[peak];
        };
        let place = vertex([*left, *middle, *right]).map_or(middle.0, |vertex| vertex.0);
        let vertex = sampled(place);
        if vertex.1.abs() > middle.1.abs() { vertex } else { *middle }
    });
    Some(refined.collect())
}

/// Deviations below this are rounding errors of the sums and of their target.
const DIGITS: f64 = 1e-12;

/// The sum of n terms whose relative deviation from `shares` is `±level` in turn at 2n + 1 `places`,
/// from any sum to start with.
///
/// Newton's method alone finds it from near by. From further away, the shares are led from those of
/// the start, which it meets with the level 0, to those wanted. All mixtures of the two belong to
/// positive spectra, for each of which there is one such sum, so that the way cannot end between. Where
/// it gets too steep for the digits of a double, the sum reached on it is returned.
pub(super) fn equalised(start: &Sum, places: &[f64], shares: &[f64]) -> Option<Sum> {
    let own: Vec<f64> = places.iter().map(|place| start.share(*place)).collect();
    let mut reached = (start.clone(), 0.0);
    let (mut part, mut stride) = (0.0, 1.0_f64);
    while part < 1.0 {
        let ahead = (part + stride).min(1.0);
        let mixed: Vec<f64> = own
            .iter()
            .zip(shares)
            .map(|(own, share)| own * (1.0 - ahead) + share * ahead)
            .collect();
        if let Some(found) = newton(&reached, places, &mixed) {
            (reached, part) = (found, ahead);
            stride *= 2.0;
        } else {
            stride *= 0.25;
            if stride < 1e-5 {
                break;
            }
        }
    }
    (part > 0.0).then_some(reached.0)
}

/// Newton's method from a sum and a level near by; `None` as soon as its steps do not shrink.
///
/// Steps are measured, not deviations: in some directions the parameters hardly change the sum, and
/// deviations that are still large there may well be close to the end.
fn newton(start: &(Sum, f64), places: &[f64], shares: &[f64]) -> Option<(Sum, f64)> {
    let size = places.len();
    let (mut sum, mut level) = start.clone();
    let mut slopes = vec![0.0; size - 1];
    let mut last_step = 1.5;
    for _ in 0..30 {
        let mut system = DMatrix::zeros(size, size);
        let mut missing = DVector::zeros(size);
        for (index, (place, share)) in places.iter().zip(shares).enumerate() {
            let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
            missing[index] = sign * level - sum.deviation(*place, *share, &mut slopes);
            for (column, slope) in slopes.iter().enumerate() {
                system[(index, column)] = *slope;
            }
            system[(index, size - 1)] = -sign;
        }
        let missing_most = missing.amax();
        if missing_most <= DIGITS.max(1e-3 * f64::abs(level)) {
            return Some((sum, level));
        }
        let change = system.lu().solve(&missing)?;
        let step = change.rows(0, size - 1).amax();
        if step.is_nan() || step > 0.7 * last_step {
            return None;
        }
        sum = sum.moved(&change.as_slice()[..size - 1]);
        level += change[size - 1];
        last_step = step;
    }
    None
}

/// Instants at which guesses are compared with the target.
const INSTANTS: usize = 32;
/// Times that are tried over the whole range.
const TIMES: u32 = 64;
/// Distances in `ln λ` outside of the range that are tried: at the last ones, the creep within the
/// range is at once or a straight line.
const BEYOND: [f64; 10] = [0.5, 1.0, 2.0, 3.0, 5.0, 8.0, 12.0, 18.0, 26.0, 36.0];
/// Distances in `ln λ` from the best single time that are tried for pairs: a narrow spectrum has its
/// best pair close together.
const SPLITS: [f64; 11] = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0];

/// One term by itself: `ln λ`, and the relative share of it in the target at all instants.
struct Column {
    time: f64,
    values: [f64; INSTANTS],
}

impl Column {
    fn new(target: &Target<'_>, [start, end]: [f64; 2], time: f64) -> Self {
        let values = std::array::from_fn(|index| {
            // Dense towards both ends: the least mean square over such instants is near the least maximum.
            let angle = (index as f64 + 0.5) * PI / INSTANTS as f64;
            let place = 0.5 * (start + end) - 0.5 * (end - start) * angle.cos();
            approach((place - time).exp()) / target.quick_share(place)
        });
        Self { time, values }
    }

    fn product(&self, other: &Self) -> f64 {
        self.values.iter().zip(&other.values).map(|(a, b)| a * b).sum()
    }

    fn total(&self) -> f64 {
        self.values.iter().sum()
    }
}

fn columns(target: &Target<'_>, [start, end]: [f64; 2]) -> Vec<Column> {
    let within =
        (0..=TIMES).map(|index| start + (end - start) * f64::from(index) / f64::from(TIMES));
    let outside = BEYOND.iter().flat_map(|beyond| [start - beyond, end + beyond]);
    within.chain(outside).map(|time| Column::new(target, [start, end], time)).collect()
}

/// The single term of least mean square deviation among a row of times.
pub(super) fn single(target: &Target<'_>) -> Sum {
    let candidates = columns(target, target.steep_range()).into_iter().map(|column| {
        let strength = column.total() / column.product(&column);
        let misfit: f64 = column.values.iter().map(|value| (strength * value - 1.0).powi(2)).sum();
        (misfit, (column.time, strength.ln()))
    });
    let best = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
    Sum { terms: best.map(|(_, term)| term).into_iter().collect() }
}

/// The pair of least mean square deviation among a row of times and splittings of the best single term.
pub(super) fn pair(target: &Target<'_>, time: f64, strength: f64) -> Sum {
    let range = target.steep_range();
    let mut columns = columns(target, range);
    for split in SPLITS {
        columns.extend([-split, split].map(|split| Column::new(target, range, time + split)));
    }
    columns.sort_by(|a, b| a.time.total_cmp(&b.time));
    // Where no pair is better than the single term, its halves are a little apart.
    let half = strength - 2.0_f64.ln();
    let mut best = (f64::INFINITY, vec![(time - 1e-3, half), (time + 1e-3, half)]);
    for (index, first) in columns.iter().enumerate() {
        for second in &columns[index + 1..] {
            let (own, other) = (first.product(first), second.product(second));
            let both = first.product(second);
            let (right, other_right) = (first.total(), second.total());
            let determinant = own * other - both * both;
            let strength = (right * other - other_right * both) / determinant;
            let other_strength = (other_right * own - right * both) / determinant;
            if !(strength > 0.0 && other_strength > 0.0) {
                continue;
            }
            let values = first.values.iter().zip(&second.values);
            let misfit: f64 =
                values.map(|(a, b)| (strength * a + other_strength * b - 1.0).powi(2)).sum();
            if misfit < best.0 {
                best.0 = misfit;
                best.1 = vec![(first.time, strength.ln()), (second.time, other_strength.ln())];
            }
        }
    }
    Sum { terms: best.1 }
}

/// `values` as a function of the position in their row, read off at `more` more positions. The ends
/// of the row are `margin` before the first position and after the last.
pub(super) fn resampled(values: &[f64], more: usize, margin: f64) -> Vec<f64> {
    let last = values.len() as f64 - 1.0;
    let count = values.len() + more;
    let stretch = (last + 2.0 * margin) / (count as f64 - 1.0 + 2.0 * margin);
    (0..count)
        .map(|index| {
            let position = (index as f64 + margin) * stretch - margin;
            let left = whole(position).min(values.len() - 2);
            let part = position - left as f64;
            values[left] + part * (values[left + 1] - values[left])
        })
        .collect()
}
