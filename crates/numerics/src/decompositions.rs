//! Iterative decompositions of matrices, each with a limit of its steps.
//!
//! Those of nalgebra that go by shorter names have none: on degenerate spectra (two equal masses that just touch
//! have four eigenvalues that are nearly zero) and on numbers that are not finite they never end.

use nalgebra::{Complex, DMatrix, Dyn, SVD, Schur, SymmetricEigen};

/// Shifts of the eigenvalues and thresholds of the iteration, both relative. It judges by the sizes of the eigenvalues,
/// so without a shift it keeps small ones accurate, but does not always end where several are zero.
const ATTEMPTS: [(f64, f64); 4] = [
    (0.0, f64::EPSILON),
    (0.7, f64::EPSILON),
    (-1.3, 4.0 * f64::EPSILON),
    (1.9, 64.0 * f64::EPSILON),
];

/// Steps of an iteration on a matrix of this size: it usually takes two or three for each eigenvalue.
fn most_steps(size: usize) -> usize {
    100 + 60 * size
}

/// The real Schur form `A = Q T Qᵀ` of a square matrix, as `Q` and `T`; `None` where an entry is not finite, or the
/// iteration does not converge in `100 + 60 n` steps by any of four shifts.
pub fn schur(matrix: &DMatrix<f64>) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let size = matrix.nrows();
    let norm = matrix.amax();
    if !matrix.iter().all(|own| own.is_finite()) {
        return None;
    }
    ATTEMPTS.iter().find_map(|&(shift, threshold)| {
        let mut shifted = matrix.clone();
        (0..size).for_each(|at| shifted[(at, at)] += shift * norm);
        let (basis, mut triangle) = Schur::try_new(shifted, threshold, most_steps(size))?.unpack();
        (0..size).for_each(|at| triangle[(at, at)] -= shift * norm);
        Some((basis, triangle))
    })
}

/// The eigenvalues of a square matrix, in no order, to about a rounding of the largest one; `None` as in [`schur`].
///
/// # Examples
///
/// ```
/// use dashpot_numerics::decompositions::eigenvalues;
/// use nalgebra::dmatrix;
///
/// // Two equal masses, a spring of 10⁻⁹ between them: 0, 0, ±i √(2·10⁻⁹).
/// let pair = dmatrix![0.0, 0.0, 1.0, 0.0; 0.0, 0.0, 0.0, 1.0; -1e-9, 1e-9, 0.0, 0.0; 1e-9, -1e-9, 0.0, 0.0];
/// let sizes = eigenvalues(&pair).unwrap().iter().map(|own| own.norm()).fold(0.0, f64::max);
/// assert!((sizes / 2e-9_f64.sqrt() - 1.0).abs() < 1e-6);
/// ```
pub fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let (_, triangle) = schur(matrix)?;
    let mut found = Vec::with_capacity(triangle.nrows());
    while let Some(at) = Some(found.len()).filter(|at| *at < triangle.nrows()) {
        let first = triangle[(at, at)];
        let below = if at + 1 < triangle.nrows() { triangle[(at + 1, at)] } else { 0.0 };
        if below == 0.0 {
            found.push(Complex::new(first, 0.0));
            continue;
        }
        let second = triangle[(at + 1, at + 1)];
        let (middle, half) = (0.5 * (first + second), 0.5 * (first - second));
        let root = Complex::new(half * half + below * triangle[(at, at + 1)], 0.0).sqrt();
        found.extend([root, -root].map(|root| middle + root));
    }
    Some(found)
}

/// Eigenvalues and vectors of a symmetric matrix; `None` where an entry is not finite, or the iteration does not
/// converge in `100 + 60 n` steps.
pub fn symmetric(matrix: &DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    let is_finite = matrix.iter().all(|own| own.is_finite());
    let own = is_finite.then(|| matrix.clone())?;
    SymmetricEigen::try_new(own, f64::EPSILON, most_steps(matrix.nrows()))
}

/// The singular values and vectors of a matrix that is not empty, the largest value first; `None` where an entry is
/// not finite, or the iteration does not converge in `100 + 60 n` steps.
pub fn singular(matrix: &DMatrix<f64>) -> Option<SVD<f64, Dyn, Dyn>> {
    let size = matrix.nrows().min(matrix.ncols());
    let is_finite = size > 0 && matrix.iter().all(|own| own.is_finite());
    let own = is_finite.then(|| matrix.clone())?;
    SVD::try_new(own, true, true, 5.0 * f64::EPSILON, most_steps(size))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chain of masses with springs between neighbours, as the matrix of places and speeds.
    fn chain(masses: &[f64], stiffness: &[f64]) -> DMatrix<f64> {
        let count = masses.len();
        let mut own = DMatrix::zeros(2 * count, 2 * count);
        for at in 0..count {
            own[(at, count + at)] = 1.0;
        }
        for (at, k) in stiffness.iter().enumerate() {
            for (row, other) in [(at, at + 1), (at + 1, at)] {
                own[(count + row, row)] -= k / masses[row];
                own[(count + row, other)] += k / masses[row];
            }
        }
        own
    }

    #[test]
    fn degenerate_spectra_have_eigenvalues() {
        let all: [&[f64]; 4] = [&[1.0, 1.0], &[1.0, 2.0], &[1.0, 1.0, 2.0], &[1.0, 1.0, 1.0, 1.0]];
        for (masses, power) in all.into_iter().flat_map(|own| (-320..=12).map(move |p| (own, p))) {
            let k = 10.0_f64.powi(power);
            let matrix = chain(masses, &vec![k; masses.len() - 1]);
            let found = eigenvalues(&matrix).unwrap_or_else(|| panic!("{masses:?} {k:e}"));
            let fastest = found.iter().map(|own| own.norm()).fold(0.0, f64::max);
            let expected = match masses {
                [_, other] => (k * (1.0 + 1.0 / other)).sqrt(),
                // 1:1:2 has ω²/k = (5 ± √5)/… of its own: bounded by Gershgorin and by the largest entry.
                _ => continue,
            };
            let rounding = 1e-7 * matrix.amax().max(1.0);
            assert!((fastest - expected).abs() <= 1e-9 * expected + rounding, "{masses:?} {k:e}");
        }
    }

    #[test]
    fn jordan_blocks_have_eigenvalues() {
        for size in 1..=8 {
            let jordan = DMatrix::from_fn(size, size, |i, j| if j == i + 1 { 1.0 } else { 0.0 });
            let found = eigenvalues(&jordan).unwrap();
            let bound = 10.0 * f64::EPSILON.powf(1.0 / size as f64);
            assert!(
                found.len() == size && found.iter().all(|own| own.norm() <= bound),
                "{found:?}"
            );
        }
    }

    #[test]
    fn numbers_that_are_not_finite_have_none() {
        for wrong in [f64::NAN, f64::INFINITY] {
            let mut own = DMatrix::<f64>::identity(4, 4);
            own[(1, 2)] = wrong;
            assert!(eigenvalues(&own).is_none());
            assert!(symmetric(&own).is_none() && singular(&own).is_none());
        }
        assert!(singular(&DMatrix::zeros(0, 3)).is_none());
    }
}
