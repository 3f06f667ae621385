//! The sum of the least maximum, by exchange of the places of greatest deviation.

use dashpot_numerics::{extrema::vertex, roots::bisect};

use super::{equalise::equalised, guess, sum::Sum, target::Target};

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
        Self::guessed(target, guess::single(target), places).levelled(target)
    }

    /// The best sum with one term more.
    pub(super) fn with_one_more(&self, target: &Target<'_>) -> Self {
        let known = self.steep_places(target);
        let places = guess::resampled(&known, 2, 0.0);
        if let [(time, strength)] = self.sum.terms[..] {
            let sum = guess::pair(target, time, strength);
            return Self::guessed(target, sum, places).levelled(target);
        }
        let (times, strengths): (Vec<f64>, Vec<f64>) = self.sum.terms.iter().copied().unzip();
        let weaker = (times.len() as f64 / (times.len() as f64 + 1.0)).ln();
        let times = guess::resampled(&times, 1, 0.5);
        let strengths = guess::resampled(&strengths, 1, 0.5);
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
