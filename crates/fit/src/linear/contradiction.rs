//! Storage and loss of one material determine each other (Kramers and Kronig); measured ones may not fit together.

use serde::Serialize;

use super::{
    floor::{Dense, Misfit},
    problem::Problem,
    record::Record,
};

/// The floor of both together exceeds what those of each alone explain by this factor.
const CONTRADICTS: f64 = 2.0;

/// Storage and loss, of which each alone is that of a passive network, and both together are not.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Contradiction {
    /// How far the nearest network is from the storage moduli alone, in the mean (root of the mean square).
    pub storage_alone: f64,
    /// The same of the loss moduli.
    pub loss_alone: f64,
    /// How far the loss is from that of the network that is nearest to the storage: the median.
    pub loss_from_storage: f64,
    /// How far the storage is from that of the network that is nearest to the loss, up to a constant: the
    /// median.
    pub storage_from_loss: f64,
}

/// The contradiction in a record of both, where there is one; `together` is the lower bound of both.
pub(super) fn contradiction(record: &Record, together: f64) -> Option<Contradiction> {
    let Record::Oscillation(rows) = record else { return None };
    let storage = Record::Storage(rows.iter().map(|own| (own[0], own[1])).collect());
    let loss = Record::Loss(rows.iter().map(|own| (own[0], own[2])).collect());
    let [(storage_alone, loss_off), (loss_alone, storage_off)] =
        [(&storage, &loss), (&loss, &storage)].map(|(fitted, other)| crossed(fitted, other));
    if together <= CONTRADICTS * storage_alone.hypot(loss_alone) {
        return None;
    }
    let (loss_from_storage, storage_from_loss) = (median(loss_off), median(storage_off));
    Some(Contradiction { storage_alone, loss_alone, loss_from_storage, storage_from_loss })
}

/// How near a network comes to one record, and how far it then is from the rows of the other.
fn crossed(fitted: &Record, other: &Record) -> (f64, Vec<f64>) {
    let [own, opposite] =
        [fitted, other].map(|record| Problem::of(std::slice::from_ref(record), &[0.0]));
    let dense = Dense::of(&own);
    let minimum = dense.minimum();
    let mut spectrum = dense.spectrum(&minimum);
    let is_loss = matches!(fitted, Record::Loss(_));
    if is_loss {
        spectrum.spring = 0.0;
    }
    let off = spectrum.residual(&opposite);
    let pairs = || off.iter().copied().zip(opposite.weights());
    // The loss determines the storage up to a constant: it is the one that fits best, by the sum of magnitudes.
    let wanted = || weighted_median(pairs().map(|(own, weight)| (own / weight, weight)).collect());
    let constant = if is_loss { wanted() } else { 0.0 };
    let left = pairs().map(|(own, weight)| (own - constant * weight).abs()).collect();
    (Misfit::of_vector(&minimum.residual).rms, left)
}

/// The value on each side of which half of the weights are.
fn weighted_median(mut pairs: Vec<(f64, f64)>) -> f64 {
    pairs.sort_by(|one, other| one.0.total_cmp(&other.0));
    let half = 0.5 * pairs.iter().map(|own| own.1).sum::<f64>();
    let mut sum = 0.0;
    let found = pairs.iter().find(|own| {
        sum += own.1;
        sum >= half
    });
    found.map_or(0.0, |own| own.0)
}

fn median(values: Vec<f64>) -> f64 {
    weighted_median(values.into_iter().map(|own| (own, 1.0)).collect())
}
