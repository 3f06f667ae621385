//! The sum whose deviation has one size and alternating signs at given places.

use nalgebra::{DMatrix, DVector};

use super::sum::Sum;

/// Deviations below this are rounding errors of the sums and of their target.
const DIGITS: f64 = 1e-12;

/// The sum of n terms whose relative deviation from `shares` is `±level` in turn at 2n + 1 `places`,
/// from any sum to start with.
///
/// Newton's method alone finds it from near by. From further away, the shares are led from those of
/// the start, which it meets with the level 0, to those wanted. All mixtures of the two belong to
/// positive spectra, for each of which there is one such sum, so that the way cannot end between. Where
/// it gets too steep for the digits of a double, the sum reached on it is returned.
pub(super) fn equalised(start: &Sum, places: &[f64], shares: &[f64]) -> Option<Sum> {
    let own: Vec<f64> = places.iter().map(|place| start.share(*place)).collect();
    let mut reached = (start.clone(), 0.0);
    let (mut part, mut stride) = (0.0, 1.0_f64);
    while part < 1.0 {
        let ahead = (part + stride).min(1.0);
        let mixed: Vec<f64> = own
            .iter()
            .zip(shares)
            .map(|(own, share)| own * (1.0 - ahead) + share * ahead)
            .collect();
        if let Some(found) = newton(&reached, places, &mixed) {
            (reached, part) = (found, ahead);
            stride *= 2.0;
        } else {
            stride *= 0.25;
            if stride < 1e-5 {
                break;
            }
        }
    }
    (part > 0.0).then_some(reached.0)
}

/// Newton's method from a sum and a level near by; `None` as soon as its steps do not shrink.
///
/// Steps are measured, not deviations: in some directions the parameters hardly change the sum, and
/// deviations that are still large there may well be close to the end.
fn newton(start: &(Sum, f64), places: &[f64], shares: &[f64]) -> Option<(Sum, f64)> {
    let size = places.len();
    let (mut sum, mut level) = start.clone();
    let mut slopes = vec![0.0; size - 1];
    let mut last_step = 1.5;
    for _ in 0..30 {
        let mut system = DMatrix::zeros(size, size);
        let mut missing = DVector::zeros(size);
        for (index, (place, share)) in places.iter().zip(shares).enumerate() {
            let sign = if index % 2 == 0 { 1.0 } else { -1.0 };
            missing[index] = sign * level - sum.deviation(*place, *share, &mut slopes);
            for (column, slope) in slopes.iter().enumerate() {
                system[(index, column)] = *slope;
            }
            system[(index, size - 1)] = -sign;
        }
        let missing_most = missing.amax();
        if missing_most <= DIGITS.max(1e-3 * f64::abs(level)) {
            return Some((sum, level));
        }
        let change = system.lu().solve(&missing)?;
        let step = change.rows(0, size - 1).amax();
        if step.is_nan() || step > 0.7 * last_step {
            return None;
        }
        sum = sum.moved(&change.as_slice()[..size - 1]);
        level += change[size - 1];
        last_step = step;
    }
    None
}
