//! Small matrices of a fixed size, which live on the stack.
//!
//! They are what many systems of a few states are solved with, one after the other: nothing is
//! allocated, and the compiler knows every loop's length. A matrix is kept by its columns, so that
//! `[[f64; M]; N]` takes `N` numbers to `M`.

/// A square matrix by its columns.
pub type Square<const N: usize> = [[f64; N]; N];

/// `matrix · z`.
#[inline]
pub fn apply<const M: usize, const N: usize>(matrix: &[[f64; M]; N], z: &[f64; N]) -> [f64; M] {
    let mut sum = [0.0; M];
    for (column, &factor) in matrix.iter().zip(z) {
        for (own, &entry) in sum.iter_mut().zip(column) {
            *own += entry * factor;
        }
    }
    sum
}

/// `row · matrix`.
#[inline]
pub fn apply_left<const M: usize, const N: usize>(
    row: &[f64; M],
    matrix: &[[f64; M]; N],
) -> [f64; N] {
    let mut product = [0.0; N];
    for (own, column) in product.iter_mut().zip(matrix) {
        *own = dot(row, column);
    }
    product
}

/// `row · z`.
#[inline]
pub fn dot<const N: usize>(row: &[f64; N], z: &[f64; N]) -> f64 {
    row.iter().zip(z).map(|(one, other)| one * other).sum()
}

/// `first · second`.
#[inline]
pub fn product<const M: usize, const N: usize, const K: usize>(
    first: &[[f64; M]; N],
    second: &[[f64; N]; K],
) -> [[f64; M]; K] {
    let mut all = [[0.0; M]; K];
    for (own, column) in all.iter_mut().zip(second) {
        *own = apply(first, column);
    }
    all
}

/// The largest sum of magnitudes in a column: the norm that belongs to `Σ |zᵢ|`.
pub fn norm<const N: usize>(matrix: &Square<N>) -> f64 {
    let sums = matrix.iter().map(|column| column.iter().map(|own| own.abs()).sum());
    sums.fold(0.0, f64::max)
}

/// A matrix with its first powers, from which exponentials are made.
#[derive(Debug, Clone)]
pub struct Powers<const N: usize> {
    all: [Square<N>; 4],
    rate: f64,
}

/// Up to this product of rate and time the series is summed: its remainder is then below 2.4·10⁻¹⁸.
const NEAR: f64 = 0.25;
/// More often nothing is squared; beyond, an exponential has no digits left.
const MOST_SQUARINGS: u32 = 60;

impl<const N: usize> Powers<N> {
    /// The powers of a matrix.
    pub fn of(matrix: &Square<N>) -> Self {
        let second = product(matrix, matrix);
        let third = product(&second, matrix);
        let fourth = product(&second, &second);
        // Norms of high powers tell the rate much better than that of the matrix.
        let rate = norm(&fourth).sqrt().sqrt().max(norm(&third).cbrt());
        Self { all: [*matrix, second, third, fourth], rate }
    }

    /// How fast anything changes: a bound of `‖Aᵏ‖^(1/k)` at the powers 3 and 4, and so of all powers
    /// beyond, give or take a factor near one.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// `e^{A time}` by its series to the twelfth power, scaled and squared.
    ///
    /// The error is of the size of rounding times the rate times the time, relative to the largest
    /// entry on the way.
    pub fn exponential(&self, time: f64) -> Square<N> {
        let mut squarings = 0;
        let mut scale = time;
        while self.rate * scale.abs() > NEAR && squarings < MOST_SQUARINGS {
            scale *= 0.5;
            squarings += 1;
        }
        let mut powers = self.all;
        let mut factor = 1.0;
        for power in &mut powers {
            factor *= scale;
            power.iter_mut().flatten().for_each(|own| *own *= factor);
        }
        // Paterson and Stockmeyer: four powers, and Horner's scheme over the fourth one.
        let mut sum = combination(SERIES[2], &powers);
        for factors in [SERIES[1], SERIES[0]] {
            sum = product(&sum, &powers[3]);
            add(&mut sum, &combination(factors, &powers));
        }
        for _ in 0..squarings {
            sum = product(&sum, &sum);
        }
        sum
    }
}

/// `1/k!` for the powers 0…3, 4…7 and 8…12.
const SERIES: [[f64; 5]; 3] = [
    [1.0, 1.0, 0.5, 1.0 / 6.0, 0.0],
    [1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0, 1.0 / 5_040.0, 0.0],
    [1.0 / 40_320.0, 1.0 / 362_880.0, 1.0 / 3_628_800.0, 1.0 / 39_916_800.0, 1.0 / 479_001_600.0],
];

/// `c₀ + c₁ X + c₂ X² + c₃ X³ + c₄ X⁴`.
#[inline]
fn combination<const N: usize>(factors: [f64; 5], powers: &[Square<N>; 4]) -> Square<N> {
    let mut sum = [[0.0; N]; N];
    for (at, column) in sum.iter_mut().enumerate() {
        for row in 0..N {
            let entry = |power: usize| factors[power + 1] * powers[power][at][row];
            column[row] = entry(0) + entry(1) + entry(2) + entry(3);
        }
        column[at] += factors[0];
    }
    sum
}

#[inline]
fn add<const N: usize>(sum: &mut Square<N>, other: &Square<N>) {
    for (own, other) in sum.iter_mut().flatten().zip(other.iter().flatten()) {
        *own += other;
    }
}

/// Terms beyond this count are not summed.
const MOST_TERMS: u32 = 48;

/// `e^{matrix · time} · z` by its series, for a norm of the matrix times the time of about one at
/// most: beyond, digits cancel.
#[inline]
pub fn advanced<const N: usize>(matrix: &Square<N>, time: f64, z: &[f64; N]) -> [f64; N] {
    let size = |z: &[f64; N]| z.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    let (mut sum, mut term) = (*z, *z);
    let least = 0.1 * f64::EPSILON * size(z);
    for at in 1..=MOST_TERMS {
        let factor = time / f64::from(at);
        term = apply(matrix, &term);
        for (own, term) in sum.iter_mut().zip(&mut term) {
            *term *= factor;
            *own += *term;
        }
        if size(&term) <= least {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass on a spring and a dashpot: `ẍ + 2 d ẋ + x = 0`, by columns.
    fn oscillator(d: f64) -> Square<2> {
        [[0.0, -1.0], [1.0, -2.0 * d]]
    }

    #[test]
    fn the_exponential_is_that_of_an_oscillator() {
        for time in [1e-9, 0.1, 1.0, 30.0] {
            let d: f64 = 0.3;
            let omega = (1.0 - d * d).sqrt();
            let found = Powers::of(&oscillator(d)).exponential(time);
            let (sine, cosine) = (omega * time).sin_cos();
            let decay = (-d * time).exp();
            let right = [decay * (cosine + d / omega * sine), -decay * sine / omega];
            for (found, right) in found[0].iter().zip(right) {
                assert!((found - right).abs() < 64.0 * f64::EPSILON * (1.0 + time), "{time}");
            }
        }
    }

    #[test]
    fn the_series_of_a_state_is_the_exponential_applied() {
        let matrix = oscillator(0.1);
        let z = [0.7, -0.2];
        for time in [-0.4, 0.0, 1e-3, 0.5] {
            let found = advanced(&matrix, time, &z);
            let right = apply(&Powers::of(&matrix).exponential(time), &z);
            assert!(found.iter().zip(right).all(|(a, b)| (a - b).abs() < 1e-15), "{time}");
        }
    }

    #[test]
    fn rows_and_columns_are_told_apart() {
        let matrix = [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]];
        let bits = |own: &[f64]| own.iter().map(|own| own.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&apply(&matrix, &[1.0, 10.0, 100.0])), bits(&[531.0, 642.0]));
        assert_eq!(bits(&apply_left(&[1.0, 10.0], &matrix)), bits(&[21.0, 43.0, 65.0]));
        assert_eq!(product(&matrix, &[[1.0, 0.0, 0.0]]), [[1.0, 2.0]]);
    }
}
