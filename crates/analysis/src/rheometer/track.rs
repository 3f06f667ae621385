//! An output of a rig at the instants of a history, with its error.

use dashpot_dae::Signal;

use super::history::{Instant, Side};

/// Tolerances of a method that states no bound; its error follows from their differences.
pub(super) const TOLERANCES: [f64; 3] = [1e-7, 1e-8, 1e-9];

/// An output at the instants.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    /// The values; `None` beyond the reach of the simulation.
    pub(super) values: Vec<Option<f64>>,
    /// The largest error of the values, as far as it is known.
    pub(super) error: Option<f64>,
}

/// A signal at the instants, as far as it reaches.
pub(super) fn read(signal: &Signal, reach: f64, instants: &[Instant]) -> Track {
    let value = |instant: &Instant| {
        (instant.time <= reach).then(|| match instant.side {
            Side::After => signal.value(instant.time),
            Side::Before if instant.time > 0.0 => signal.left_value(instant.time),
            Side::Before => 0.0,
        })
    };
    Track { values: instants.iter().map(value).collect(), error: signal.error }
}

/// The finest of three solutions, with the errors that their differences tell.
pub(super) fn estimated(coarse: &[Track], middle: &[Track], fine: Vec<Track>) -> Vec<Track> {
    let tracks = fine.into_iter().zip(middle).zip(coarse);
    let estimated = tracks.map(|((fine, middle), coarse)| {
        let late = difference(&fine.values, &middle.values);
        let early = difference(&middle.values, &coarse.values);
        let error = late.zip(early).map(|(late, early)| (2.0 * late).max(0.5 * early));
        Track { error, ..fine }
    });
    estimated.collect()
}

/// The largest difference.
pub(super) fn difference(one: &[Option<f64>], other: &[Option<f64>]) -> Option<f64> {
    let pairs = one.iter().zip(other).filter_map(|(one, other)| one.zip(*other));
    pairs.map(|(one, other)| (one - other).abs()).reduce(f64::max)
}
