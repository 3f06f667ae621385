//! Where numbers are between their bounds, and designs spread over these.

use dashpot_numerics::Stream;

use super::{Total, Variable};

/// Steps of differences, in parts of a number or of the room between its bounds.
const STEP: f64 = 1e-4;
/// The seed of designs that are spread.
const SEED: u64 = 1;

/// Where a number is between its bounds, from 0 to 1: in its logarithm where both are above zero.
#[derive(Debug, Clone, Copy)]
struct Place {
    low: f64,
    high: f64,
    is_log: bool,
}

impl Place {
    fn of(own: &Variable) -> Self {
        Self { low: own.low, high: own.high, is_log: own.low > 0.0 }
    }

    fn value(self, place: f64) -> f64 {
        if self.is_log {
            self.low * (self.high / self.low).powf(place)
        } else {
            self.low + (self.high - self.low) * place
        }
    }

    fn place(self, value: f64) -> f64 {
        if self.is_log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            let room = self.high - self.low;
            if room > 0.0 { (value - self.low) / room } else { 0.5 }
        }
    }

    /// How far a step of a difference is.
    fn step(self) -> f64 {
        if self.is_log { STEP / (self.high / self.low).ln() } else { STEP }
    }
}

/// All numbers of a search by unknowns from 0 to 1: each has one, but for the last of those with a given sum.
#[derive(Debug, Clone)]
pub(super) struct Space {
    places: Vec<Place>,
    totals: Vec<Total>,
}

impl Space {
    pub(super) fn of(variables: &[Variable], totals: &[Total]) -> Self {
        let mut places: Vec<Place> = variables.iter().map(Place::of).collect();
        for at in totals.iter().flat_map(|own| &own.of) {
            places[*at].is_log = false;
        }
        Self { places, totals: totals.to_vec() }
    }

    /// Whether a number follows from the others of its sum.
    pub(super) fn follows(&self, number: usize) -> bool {
        self.totals.iter().any(|own| own.of.last() == Some(&number))
    }

    /// The numbers that have an unknown of their own.
    pub(super) fn free(&self) -> impl Iterator<Item = usize> {
        (0..self.places.len()).filter(|at| !self.follows(*at))
    }

    /// Where a number may be once those before it in its sum are known.
    fn within(&self, number: usize, values: &[f64]) -> Place {
        let whole = self.places[number];
        let of = self.totals.iter().find_map(|own| {
            let at = own.of.iter().position(|other| *other == number)?;
            Some((own, at))
        });
        let Some((total, at)) = of else { return whole };
        let taken: f64 = total.of[..at].iter().map(|own| values[*own]).sum();
        let behind = |end: fn(&Place) -> f64| -> f64 {
            total.of[at + 1..].iter().map(|own| end(&self.places[*own])).sum()
        };
        let rest = total.sum - taken;
        let low = whole.low.max(rest - behind(|own| own.high));
        let high = whole.high.min(rest - behind(|own| own.low)).max(low);
        Place { low, high, is_log: false }
    }

    /// The numbers for these unknowns.
    pub(super) fn values(&self, unknowns: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.places.len()];
        let mut unknowns = unknowns.iter();
        for number in 0..values.len() {
            let own = self.within(number, &values);
            let is_last = self.follows(number);
            let place = if is_last { 1.0 } else { unknowns.next().copied().unwrap_or(0.5) };
            values[number] = own.value(place);
        }
        values
    }

    /// The unknowns of these numbers, or of those nearest to them that have the sums.
    pub(super) fn unknowns(&self, values: &[f64]) -> Vec<f64> {
        let mut taken = values.to_vec();
        let mut unknowns = Vec::new();
        for number in 0..values.len() {
            let own = self.within(number, &taken);
            taken[number] = values[number].clamp(own.low, own.high);
            if !self.follows(number) {
                unknowns.push(own.place(taken[number]));
            }
        }
        unknowns
    }

    /// The place of a value within the bounds of a number alone.
    pub(super) fn alone(&self, number: usize, value: f64) -> f64 {
        self.places[number].place(value)
    }

    /// How far the bounds of a number are apart.
    pub(super) fn room(&self, number: usize) -> f64 {
        self.places[number].high - self.places[number].low
    }

    /// How far a step of a difference is.
    pub(super) fn step(&self, unknown: usize) -> f64 {
        self.free().nth(unknown).map_or(STEP, |own| self.places[own].step())
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
