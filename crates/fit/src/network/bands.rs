//! What the uncertainty of the numbers makes of anything that follows from them: measures, curves.

use dashpot_numerics::decompositions::symmetric;
use nalgebra::DVector;

use super::NetworkFit;

/// The longest step along a direction of the numbers, in logarithms.
const LONGEST: f64 = 0.2;
/// The step along a direction that the tests do not determine, and the change beyond which something depends on it.
const OPEN: f64 = 0.05;
const CHANGED: f64 = 1e-5;
/// A band is bent where the mean of both sides is off by more than this part of it.
const BENT: f64 = 0.2;

/// Reads values where the numbers have some: `None` where nothing can be read, or not one of them.
pub type Read<'r> = dyn Fn(&[f64]) -> Option<Vec<Option<f64>>> + 'r;

/// A value that follows from the numbers, and where it lies with 95 %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// The value.
    pub value: f64,
    /// Half of the width of the band; `None` where the value depends on what the tests do not determine, or cannot be
    /// computed beside the minimum.
    pub half: Option<f64>,
    /// Whether it is so curved over the band that this is only its order.
    pub is_bent: bool,
}

impl NetworkFit {
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
    /// one standard deviation long. `None` where there is nothing to read at the minimum.
    pub fn bands(&self, read: &Read<'_>) -> Option<Vec<Option<Band>>> {
        let values: Vec<f64> = self.numbers.iter().map(|own| own.value).collect();
        let base = read(&values)?;
        let beside = |direction: &DVector<f64>| {
            let moved = values.iter().zip(direction.iter()).map(|(own, by)| own * by.exp());
            read(&moved.collect::<Vec<_>>()).unwrap_or_else(|| vec![None; base.len()])
        };
        let own = symmetric(&self.determined);
        // For each value the variance, the bend, and whether they are known.
        let mut sums = vec![(0.0, 0.0, own.is_some()); base.len()];
        let own =
            own.iter().flat_map(|own| own.eigenvalues.iter().zip(own.eigenvectors.column_iter()));
        for (variance, axis) in own {
            let deviation = variance.max(0.0).sqrt();
            if deviation <= 0.0 {
                continue;
            }
            let step = deviation.min(LONGEST);
            let [above, below] = [step, -step].map(|step| beside(&(axis * step)));
            let part = deviation / step;
            for (at, sum) in sums.iter_mut().enumerate() {
                let (Some(here), Some(above), Some(below)) = (base[at], above[at], below[at])
                else {
                    sum.2 = false;
                    continue;
                };
                sum.0 += (0.5 * part * (above - below)).powi(2);
                sum.1 += 0.5 * part * part * (above - here + (below - here));
            }
        }
        for axis in self.undetermined.column_iter() {
            let moved = beside(&(axis * OPEN));
            for ((sum, here), moved) in sums.iter_mut().zip(&base).zip(moved) {
                let is_same = moved
                    .zip(*here)
                    .is_some_and(|(moved, here)| (moved - here).abs() <= CHANGED * here.abs());
                sum.2 &= is_same;
            }
        }
        let bands = base.into_iter().zip(sums).map(|(value, (variance, bend, is_known))| {
            let half = self.quantile * f64::sqrt(variance);
            let is_bent = self.quantile * self.quantile * f64::abs(bend) > BENT * half;
            Some(Band {
                value: value?,
                half: is_known.then_some(half),
                is_bent: is_known && is_bent,
            })
        });
        Some(bands.collect())
    }
}
