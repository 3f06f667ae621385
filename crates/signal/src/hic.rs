//! The head injury criterion with intervals from sample to sample, as many tools have it. That of the line between
//! samples is the criterion of any signal, and stands in `dashpot_analysis`.

use dashpot_analysis::measures::STANDARD_GRAVITY;

use crate::Channel;

/// Where the best interval begins, the acceleration next to it is no less than this part of its mean: 0.6 of it on the
/// line.
const STEEP: f64 = 0.5;

/// The largest `T (|∫ a/g0 dt|/T)^2.5` \[s\] of intervals from sample to sample that are no longer than `cap` \[s\], with
/// the best interval on the line, which is near.
///
/// Every interval is tried that can be better than the best so far. No criterion exceeds `V^2.5/T^1.5` with the largest `V`
/// of any, so long ones are left out, and so are starts with less acceleration than those of the best have.
pub(crate) fn on_samples(channel: &Channel, cap: f64, near: (f64, f64)) -> f64 {
    let (times, values) = (channel.times(), channel.values());
    let sums = sums(channel);
    let low = sums.iter().copied().fold(f64::INFINITY, f64::min);
    let high = sums.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let widest = (high - low).powi(5);
    let longest = cap * (1.0 + 1e-9);
    let last = times.len() - 1;
    let whole = (times[last] - times[0]).min(longest);
    // The criterion squared, `V^5/T^3`, which takes no power.
    let square = |from: usize, to: usize| {
        let (area, length) = ((sums[to] - sums[from]).abs(), times[to] - times[from]);
        area.powi(5) / length.powi(3)
    };
    let inside = [
        times.partition_point(|time| *time < near.0),
        times.partition_point(|time| *time <= near.1).saturating_sub(1),
    ];
    let mut best = if inside[0] < inside[1] { square(inside[0], inside[1]) } else { 0.0 };
    for from in 0..last {
        let least = STEEP * STANDARD_GRAVITY * (best.sqrt() / whole).powf(0.4);
        let around = &values[from.saturating_sub(1)..=from + 1];
        if from > 0 && around.iter().all(|own| own.abs() < least) {
            continue;
        }
        for to in from + 1..=last {
            let length = times[to] - times[from];
            if length > longest || widest < best * length.powi(3) {
                break;
            }
            best = best.max(square(from, to));
        }
    }
    best.sqrt()
}

/// The integral of the line up to each sample, over g0 \[s\].
fn sums(channel: &Channel) -> Vec<f64> {
    let samples = channel.times().windows(2).zip(channel.values().windows(2));
    let parts = samples.map(|(t, v)| 0.5 * (t[1] - t[0]) * (v[0] + v[1]) / STANDARD_GRAVITY);
    let sums = parts.scan(0.0, |sum, part| {
        *sum += part;
        Some(*sum)
    });
    [0.0].into_iter().chain(sums).collect()
}

#[cfg(test)]
mod tests;
