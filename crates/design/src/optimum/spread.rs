//! Designs spread over the bounds, and where numbers are between these.

use dashpot_numerics::Stream;

use super::Variable;

/// Steps of differences, in parts of a number or of the room between its bounds.
const STEP: f64 = 1e-4;
/// The seed of designs that are spread.
const SEED: u64 = 1;

/// Where a number is between its bounds, from 0 to 1: in its logarithm where both are above zero.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    low: f64,
    high: f64,
    is_log: bool,
}

impl Place {
    pub(super) fn of(own: &Variable) -> Self {
        Self { low: own.low, high: own.high, is_log: own.low > 0.0 }
    }

    /// How far its bounds are apart.
    pub(super) fn room(self) -> f64 {
        self.high - self.low
    }

    pub(super) fn value(self, place: f64) -> f64 {
        if self.is_log {
            self.low * (self.high / self.low).powf(place)
        } else {
            self.low + (self.high - self.low) * place
        }
    }

    pub(super) fn place(self, value: f64) -> f64 {
        if self.is_log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }

    /// How far a step of a difference is.
    pub(super) fn step(self) -> f64 {
        if self.is_log { STEP / (self.high / self.low).ln() } else { STEP }
    }
}

/// Places of so many designs at most, and whether they are all of a grid: of one or two numbers all points of one, of
/// more a Latin hypercube.
pub(super) fn spread(numbers: usize, count: usize) -> (Vec<Vec<f64>>, bool) {
    if numbers == 0 || count == 0 {
        return (Vec::new(), numbers == 0);
    }
    let along = |each: usize| (0..each).map(move |at| at as f64 / (each - 1) as f64);
    match numbers {
        1 => (along(count.max(2)).map(|own| vec![own]).collect(), true),
        2 => {
            let each = count.isqrt().max(2);
            (
                along(each)
                    .flat_map(|one| along(each).map(move |other| vec![one, other]))
                    .collect(),
                true,
            )
        }
        _ => {
            let mut stream = Stream::new(SEED);
            let columns: Vec<Vec<f64>> = (0..numbers).map(|_| column(&mut stream, count)).collect();
            ((0..count).map(|at| columns.iter().map(|own| own[at]).collect()).collect(), false)
        }
    }
}

/// A number from each of so many parts of the room, in any order.
fn column(stream: &mut Stream, count: usize) -> Vec<f64> {
    let mut order: Vec<usize> = (0..count).collect();
    for at in (1..count).rev() {
        order.swap(at, stream.below(at + 1));
    }
    order.iter().map(|own| (*own as f64 + stream.share()) / count as f64).collect()
}
