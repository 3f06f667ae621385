//! First guesses, on which the exchange can build.

use std::f64::consts::PI;

use super::{approach, sum::Sum, target::Target, whole};

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
            // Dense towards both ends: the least mean square over such instants is near the least
            // maximum.
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

/// The pair of least mean square deviation among a row of times and splittings of the best single
/// term.
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
