//! What the uncertainty of the numbers makes of anything that follows from them: measures, curves.

use dashpot_numerics::decompositions::symmetric;
use nalgebra::DVector;
use serde::Serialize;

use super::{Interval, KNOWN, NetworkFit, TestFit, certainty::TAKES_PART};

/// The shortest step along a direction of the numbers, in logarithms, so that the error of a run is small beside its
/// change, and the longest.
const SHORTEST: f64 = 1e-3;
const LONGEST: f64 = 0.2;
/// The step to both sides along a direction that the tests do not determine.
const OPEN: f64 = 0.01;
/// A band is bent where the mean of both sides is off by more than this part of it.
const BENT: f64 = 0.2;

/// Reads values where the numbers have some: `None` where nothing can be read, or not one of them.
pub type Read<'r> = dyn Fn(&[f64]) -> Option<Vec<Option<f64>>> + 'r;

/// A value that follows from the numbers, and where it lies with 95 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// The value.
    pub value: f64,
    /// Half of the width of the band, or why there is none.
    pub half: Result<f64, NoBand>,
    /// Whether it is so curved over the band that this is only its order.
    pub is_bent: bool,
}

/// Why nothing is claimed of numbers, or of what follows from them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum NoBand {
    /// The search has not converged.
    NotConverged,
    /// A number is on its bound: where it was held, not where the tests put it.
    OnBound,
    /// Rows before the impact contradict the zero that was fitted.
    Contradicted,
    /// A record is clipped: its largest rows are no values.
    Clipped,
    /// More is left of a record than noise, and much of its peak.
    Missed,
    /// Noise does not tell the minimum from another.
    OtherMinimum,
    /// It depends on what the tests do not determine.
    NotDetermined,
    /// It cannot be computed beside the minimum.
    NotComputed,
}

impl NetworkFit {
    /// Why nothing is claimed of any number: a number on its bound counts where no direction that the tests leave open
    /// leads away from it.
    pub fn reservation(&self) -> Option<NoBand> {
        let is_held = |(at, own): (usize, &Interval)| {
            own.is_on_bound && self.undetermined.row(at).amax() < TAKES_PART
        };
        if !self.is_converged() {
            Some(NoBand::NotConverged)
        } else if self.numbers.iter().enumerate().any(is_held) {
            Some(NoBand::OnBound)
        } else {
            let any = |is_one: fn(&TestFit) -> bool| self.tests.iter().any(is_one);
            let reasons = [
                (any(|own| own.clipped > 0), NoBand::Clipped),
                (any(|own| own.other_zero.is_some()), NoBand::Contradicted),
                (any(|own| own.is_missed), NoBand::Missed),
            ];
            reasons.into_iter().find(|own| own.0).map(|own| own.1)
        }
    }

    /// Whether the values of a number at all minima that noise does not tell apart lie within its interval.
    pub(super) fn is_alone(&self, at: usize) -> bool {
        let [low, high] = self.numbers[at].ends;
        let is_within =
            |own: f64| low.is_none_or(|low| low <= own) && high.is_none_or(|high| own <= high);
        self.others.iter().all(|other| is_within(other.values[at]))
    }

    /// Directions of the logarithms of the numbers that are open: those that the tests do not determine, and numbers
    /// whose intervals have no end.
    fn open(&self) -> Vec<DVector<f64>> {
        let count = self.numbers.len();
        let is_open = |at: &usize| {
            self.numbers[*at].ends.contains(&None) && self.undetermined.row(*at).amax() < TAKES_PART
        };
        let numbers = (0..count).filter(is_open);
        let numbers =
            numbers.map(|at| DVector::from_fn(count, |own, _| f64::from(u8::from(own == at))));
        self.undetermined.column_iter().map(nalgebra::Matrix::into_owned).chain(numbers).collect()
    }

    /// The independent causes of what is not known of the numbers: what one standard deviation of each adds to their
    /// logarithms. The covariance is the sum of their squares, `Σ s sᵀ`, along what is determined. `None` where its
    /// axes are not found.
    pub fn causes(&self) -> Option<Vec<Vec<f64>>> {
        let own = symmetric(&self.determined)?;
        let each = own.eigenvalues.iter().zip(own.eigenvectors.column_iter());
        let known = each.filter(|own| *own.0 > 0.0);
        let causes =
            known.map(|(variance, axis)| axis.iter().map(|own| own * variance.sqrt()).collect());
        Some(causes.collect())
    }

    /// The bands of what is read where the numbers have some values, by differences along the axes of their covariance,
    /// one standard deviation long. `None` where there is nothing to read at the minimum; a value has no band where
    /// nothing is [claimed](Self::reservation) of the numbers, or it depends on one that is [open](NoBand).
    pub fn bands(&self, read: &Read<'_>) -> Option<Vec<Option<Band>>> {
        let values: Vec<f64> = self.numbers.iter().map(|own| own.value).collect();
        let base = read(&values)?;
        let is_alone = (0..values.len()).all(|at| self.is_alone(at));
        let none = self.reservation().or((!is_alone).then_some(NoBand::OtherMinimum));
        if let Some(reason) = none {
            let band = |value| Band { value, half: Err(reason), is_bent: false };
            return Some(base.into_iter().map(|own| own.map(band)).collect());
        }
        let beside = |direction: &DVector<f64>| {
            let moved = values.iter().zip(direction.iter()).map(|(own, by)| own * by.exp());
            read(&moved.collect::<Vec<_>>()).unwrap_or_else(|| vec![None; base.len()])
        };
        let own = symmetric(&self.determined);
        // For each value the variance, the bend, and why they are not known.
        let unknown = own.is_none().then_some(NoBand::NotComputed);
        let mut sums = vec![(0.0, 0.0, unknown); base.len()];
        let own =
            own.iter().flat_map(|own| own.eigenvalues.iter().zip(own.eigenvectors.column_iter()));
        for (variance, axis) in own {
            let deviation = variance.max(0.0).sqrt();
            if deviation <= 0.0 {
                continue;
            }
            let step = deviation.clamp(SHORTEST, LONGEST);
            let [above, below] = [step, -step].map(|step| beside(&(axis * step)));
            let part = deviation / step;
            for (at, sum) in sums.iter_mut().enumerate() {
                let (Some(here), Some(above), Some(below)) = (base[at], above[at], below[at])
                else {
                    sum.2 = Some(NoBand::NotComputed);
                    continue;
                };
                sum.0 += (0.5 * part * (above - below)).powi(2);
                sum.1 += 0.5 * part * part * (above - here + (below - here));
            }
        }
        for axis in self.open() {
            // By both sides, as such directions are those of curved surfaces.
            let [above, below] = [OPEN, -OPEN].map(|step| beside(&(&axis * step)));
            for (at, sum) in sums.iter_mut().enumerate() {
                let sides = above[at].zip(below[at]).zip(base[at]);
                let is_same = sides.is_some_and(|((above, below), here)| {
                    (above - below).abs() <= 2.0 * OPEN * KNOWN * here.abs()
                });
                if !is_same {
                    sum.2 = Some(NoBand::NotDetermined);
                }
            }
        }
        let bands = base.into_iter().zip(sums).map(|(value, (variance, bend, none))| {
            let half = self.quantile * f64::sqrt(variance);
            let is_bent = self.quantile * self.quantile * f64::abs(bend) > BENT * half;
            Some(Band {
                value: value?,
                half: none.map_or(Ok(half), Err),
                is_bent: none.is_none() && is_bent,
            })
        });
        Some(bands.collect())
    }
}
