//! Numbers of a form as products of powers of parameters, as most are: `K`, `E A/T`, `√(2 g h)`.

/// Numbers may be off from products by this part of themselves.
const ALIKE: f64 = 1e-11;
/// Exponents are multiples of this fraction, where they are so near to one.
const FRACTION: f64 = 12.0;
const NEAR: f64 = 1e-9;

/// What stands before the powers, and the exponents of each number.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Products {
    base: Vec<f64>,
    at: Vec<f64>,
    exponents: Vec<Vec<f64>>,
}

impl Products {
    /// The numbers that are `read` at a point, as products; `None` where they are none within the bounds.
    pub(super) fn of(
        at: &[f64],
        bounds: &[[f64; 2]],
        read: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Option<Self> {
        let base = read(at)?;
        let mut exponents = vec![vec![0.0; at.len()]; base.len()];
        for (parameter, [low, high]) in bounds.iter().enumerate() {
            let mut moved = at.to_vec();
            let end = if high / at[parameter] > at[parameter] / low { *high } else { *low };
            moved[parameter] = (end * at[parameter]).sqrt();
            let ratio = (moved[parameter] / at[parameter]).ln();
            let found = read(&moved)?;
            for ((own, before), row) in found.iter().zip(&base).zip(&mut exponents) {
                if own.to_bits() == before.to_bits() {
                    continue;
                }
                let exponent = (own / before).ln() / ratio;
                let rounded = (exponent * FRACTION).round() / FRACTION;
                row[parameter] =
                    if (exponent - rounded).abs() < NEAR { rounded } else { return None };
            }
        }
        let own = Self { base, at: at.to_vec(), exponents };
        // Sums and other formulas are none.
        let is_one = |share: &dyn Fn(usize) -> f64| {
            let between = bounds.iter().enumerate();
            let point: Vec<f64> = between
                .map(|(at, [low, high])| low * (high / low).powf(share(at).fract()))
                .collect();
            read(&point).is_some_and(|right| {
                let pairs = own.at(&point).into_iter().zip(right);
                pairs.into_iter().all(|(own, right)| (own - right).abs() <= ALIKE * right.abs())
            })
        };
        let golden = |at: usize| 0.618_033_988_75 * (at + 1) as f64;
        let silver = |at: usize| 0.23 + 0.414_213_562_37 * (at + 1) as f64;
        (is_one(&golden) && is_one(&silver)).then_some(own)
    }

    /// The numbers where the parameters have these values.
    pub(super) fn at(&self, values: &[f64]) -> Vec<f64> {
        let factor = |row: &Vec<f64>| -> f64 {
            let own = row.iter().zip(values).zip(&self.at).filter(|own| *own.0.0 != 0.0);
            own.map(|((exponent, value), at)| (value / at).powf(*exponent)).product()
        };
        self.base.iter().zip(&self.exponents).map(|(own, row)| own * factor(row)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_of_powers_are_found_and_sums_are_not() {
        let bounds = [[1.0, 100.0], [0.01, 1.0]];
        let read =
            |own: &[f64]| Some(vec![3.0 * own[0], own[0] / own[1], 7.0, -own[1].sqrt(), 0.0]);
        let own = Products::of(&[10.0, 0.1], &bounds, &read).unwrap();
        let found = own.at(&[42.0, 0.7]);
        for (own, right) in found.iter().zip(read(&[42.0, 0.7]).unwrap()) {
            assert!((own - right).abs() <= 1e-13 * right.abs(), "{found:?}");
        }
        let sum = |own: &[f64]| Some(vec![own[0] + 10.0 * own[1]]);
        assert!(Products::of(&[10.0, 0.1], &bounds, &sum).is_none());
        let other = |own: &[f64]| Some(vec![own[0] * (1.0 + own[0] * own[1] * 1e-6)]);
        assert!(Products::of(&[10.0, 0.1], &bounds, &other).is_none());
    }
}
