//! The noise of filtered samples: white before the filter, correlated behind it.

use crate::{Cfc, CfcFault, Padding};

/// After so many periods of the design frequency what an impulse leaves is less than 10⁻⁷ of it.
const REACH: f64 = 4.0;
/// Samples are taken so far apart that the filter passes this part of what lies at half their rate: noise that it has
/// cut off tells nothing, and a covariance with it has no inverse that digits bear.
const PASSED: f64 = 0.03;

/// Makes the noise of filtered samples white again. With the filter as a matrix `H`, noise of one standard deviation
/// `σ` before it has the covariance `σ² H Hᵀ`, ends of the record included; of every so-manyth sample that is `σ² L Lᵀ`,
/// and `L⁻¹` of a residual has independent members of the standard deviation `σ`.
#[derive(Debug, Clone, PartialEq)]
pub struct Whitener {
    first: usize,
    stride: usize,
    /// The rows of `L`, each from its first member that is not zero to the diagonal.
    rows: Vec<Vec<f64>>,
}

impl Whitener {
    /// That of so many samples behind a filter at a rate \[Hz\].
    ///
    /// # Errors
    ///
    /// [`CfcFault::TooSlow`] and [`CfcFault::TooFast`] where the filter does not exist at that rate.
    pub fn new(count: usize, cfc: Cfc, rate: f64, padding: Padding) -> Result<Self, CfcFault> {
        cfc.memory(rate)?;
        let mut stride = 2;
        while cfc.gain(0.5 * rate / stride as f64, rate) < PASSED {
            stride += 1;
        }
        let first = count.saturating_sub(1) % stride / 2;
        let filter = Responses::new(count, cfc, rate, padding)?;
        let places: Vec<usize> = (first..count).step_by(stride).collect();
        let responses: Vec<Response> = places.iter().map(|at| filter.at(*at)).collect();
        let band = 2 * filter.reach / stride + 1;
        let covariance = |row: usize, column: usize| responses[row].times(&responses[column]);
        Ok(Self { first, stride, rows: factor(places.len(), band, covariance) })
    }

    /// How many members it leaves.
    pub fn count(&self) -> usize {
        self.rows.len()
    }

    /// The independent members of a residual, which has a value for each sample.
    pub fn whitened(&self, residual: &[f64]) -> Vec<f64> {
        let mut all = Vec::with_capacity(self.rows.len());
        let picked = residual.iter().skip(self.first).step_by(self.stride);
        for (row, value) in self.rows.iter().zip(picked) {
            let Some((diagonal, before)) = row.split_last() else { continue };
            let known = &all[all.len() - before.len()..];
            let sum: f64 =
                before.iter().zip(known).map(|(one, other): (&f64, &f64)| one * other).sum();
            all.push((value - sum) / diagonal);
        }
        all
    }

    /// How many of its members are of samples before this one.
    pub fn before(&self, sample: usize) -> usize {
        sample.saturating_sub(self.first).div_ceil(self.stride).min(self.count())
    }
}

/// What a filtered sample is made of: from which sample on, and their weights.
struct Response {
    from: usize,
    weights: Vec<f64>,
}

impl Response {
    fn times(&self, other: &Self) -> f64 {
        let from = self.from.max(other.from);
        let own = self.weights.get(from - self.from..).unwrap_or_default();
        let others = other.weights.get(from - other.from..).unwrap_or_default();
        own.iter().zip(others).map(|(one, other)| one * other).sum()
    }
}

/// The rows of the filter's matrix, read off a short record: they are alike but at the ends.
struct Responses {
    count: usize,
    reach: usize,
    /// What each sample of the short record leaves in all.
    columns: Vec<Vec<f64>>,
}

impl Responses {
    fn new(count: usize, cfc: Cfc, rate: f64, padding: Padding) -> Result<Self, CfcFault> {
        let mut reach = 1;
        while (reach as f64) < REACH * rate / cfc.design_frequency() {
            reach += 1;
        }
        let short = count.min(4 * reach);
        let mut impulse = vec![0.0; short];
        let column = |at: usize| {
            impulse.fill(0.0);
            impulse[at] = 1.0;
            cfc.filter(&impulse, rate, padding)
        };
        let columns = (0..short).map(column).collect::<Result<_, _>>()?;
        Ok(Self { count, reach, columns })
    }

    fn at(&self, sample: usize) -> Response {
        let short = self.columns.len();
        // The same place in the short record: as far from the nearer end, or in its midst.
        let middle = (2 * self.reach).min(sample);
        let place = middle.max((sample + short).saturating_sub(self.count));
        let from = place.saturating_sub(self.reach);
        let to = (place + self.reach + 1).min(short);
        let weights = self.columns[from..to].iter().map(|column| column[place]).collect();
        Response { from: sample + from - place, weights }
    }
}

/// The factor of Cholesky of a matrix with a band.
fn factor(count: usize, band: usize, matrix: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(count);
    for at in 0..count {
        let from = at.saturating_sub(band);
        let mut row: Vec<f64> = Vec::with_capacity(at - from + 1);
        for column in from..at {
            let other = &rows[column];
            let other_from = column + 1 - other.len();
            let both = from.max(other_from);
            let pairs = row[both - from..].iter().zip(&other[both - other_from..other.len() - 1]);
            let sum: f64 = pairs.map(|(one, other)| one * other).sum();
            row.push((matrix(at, column) - sum) / other[other.len() - 1]);
        }
        let whole = matrix(at, at);
        let left = whole - row.iter().map(|own| own * own).sum::<f64>();
        row.push(left.max(f64::EPSILON * whole).sqrt());
        rows.push(row);
    }
    rows
}

#[cfg(test)]
mod tests {
    use dashpot_numerics::Stream;

    use super::*;

    const RATE: f64 = 2e4;

    /// The covariance by the whole matrix of the filter.
    fn whole(count: usize, cfc: Cfc, padding: Padding) -> Vec<Vec<f64>> {
        let columns: Vec<Vec<f64>> = (0..count)
            .map(|at| {
                let mut impulse = vec![0.0; count];
                impulse[at] = 1.0;
                cfc.filter(&impulse, RATE, padding).unwrap()
            })
            .collect();
        let of = |one: usize, other: usize| columns.iter().map(|own| own[one] * own[other]).sum();
        (0..count).map(|one| (0..count).map(|other| of(one, other)).collect()).collect()
    }

    #[test]
    fn its_factor_gives_back_the_covariance_of_the_filter_up_to_the_ends() {
        for padding in Padding::ALL {
            let cfc = Cfc::new(600.0).unwrap();
            for count in [90, 500] {
                let own = Whitener::new(count, cfc, RATE, padding).unwrap();
                let right = whole(count, cfc, padding);
                for at in 0..own.count() {
                    for other in 0..=at {
                        let [one, two] = [&own.rows[at], &own.rows[other]];
                        let [from, from_two] = [at + 1 - one.len(), other + 1 - two.len()];
                        let both = from.max(from_two);
                        let until = other + 1;
                        let product: f64 = (both..until.max(both))
                            .map(|k| one[k - from] * two[k - from_two])
                            .sum();
                        let [row, column] =
                            [at, other].map(|own_at| own.first + own.stride * own_at);
                        let off = (product - right[row][column]).abs();
                        assert!(
                            off < 3e-7 * right[row][row],
                            "{padding:?} {count} {row} {column} {off}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn noise_behind_a_filter_is_white_again_with_its_own_size() {
        let cfc = Cfc::new(180.0).unwrap();
        let count = 40_000;
        let own = Whitener::new(count, cfc, RATE, Padding::Odd).unwrap();
        let mut stream = Stream::new(4);
        let mut normal = || {
            let (one, other) = (1.0 - stream.share(), stream.share());
            (-2.0 * one.ln()).sqrt() * (std::f64::consts::TAU * other).cos()
        };
        let noise: Vec<f64> = (0..count).map(|_| 3.0 * normal()).collect();
        let white = own.whitened(&cfc.filter(&noise, RATE, Padding::Odd).unwrap());
        let size = white.len() as f64;
        assert!(size > 2000.0, "{size}");
        for lag in 0..20 {
            let pairs = white.iter().zip(&white[lag..]);
            let mean = pairs.map(|(one, other)| one * other).sum::<f64>() / size;
            let right = if lag == 0 { 9.0 } else { 0.0 };
            // Five standard deviations of the mean.
            let room = 5.0 * 9.0 * (if lag == 0 { 2.0 } else { 1.0 } / size).sqrt();
            assert!((mean - right).abs() < room, "{lag} {mean}");
        }
        assert_eq!((own.before(0), own.before(own.first + 1)), (0, 1));
        assert_eq!(own.before(count), own.count());
    }
}
