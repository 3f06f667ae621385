//! From a triangular matrix to a block-diagonal one: which eigenvalues belong together, and the basis in
//! which those that do not are apart.

use nalgebra::DMatrix;

use super::{Complex, schur::ComplexSchur};

/// Couplings above this between eigenvalues that rounding cannot tell apart join them.
const VERY_STRONG: f64 = 1e3;
/// Distance, relative to the norm, of eigenvalues that are equal but for rounding.
const EQUAL: f64 = 1e-14;
/// How far, relative to the norm, rounding may move the eigenvalues of a defective matrix.
const BLUR: f64 = 1e-7;

/// When two eigenvalues share a cluster.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Caution {
    /// Couplings above this between eigenvalues that look alike join them.
    strong: f64,
    /// Change of phase or decay over a lifetime below which two modes look alike.
    alike: f64,
}

/// From separate modes to ever larger clusters. What is gained by fewer cancellations is lost in
/// exponentials of blocks with different rates, so the first that is good enough is the best.
pub(super) const CAUTIONS: [Caution; 4] = [
    Caution { strong: 30.0, alike: 0.5 },
    Caution { strong: 2.0, alike: 2.0 },
    Caution { strong: 0.2, alike: 8.0 },
    Caution { strong: 0.01, alike: 30.0 },
];

/// A partition of the eigenvalues that is closed under conjugation: what holds for some of them
/// holds for their conjugates.
#[derive(Debug, Clone)]
pub(super) struct Clusters {
    /// The label of the cluster of each eigenvalue, in the order of the diagonal.
    pub(super) labels: Vec<usize>,
    /// The cluster that each label now stands for.
    joined: Vec<usize>,
    /// The label that the conjugate of the eigenvalue with each label began with.
    conjugates: Vec<usize>,
}

impl Clusters {
    /// Each eigenvalue on its own, of a form in which conjugate eigenvalues still adjoin.
    pub(super) fn single(schur: &ComplexSchur) -> Self {
        let labels: Vec<usize> = (0..schur.triangle.nrows()).collect();
        let mut conjugates = labels.clone();
        let mut k = 0;
        while k + 1 < labels.len() {
            if schur.eigenvalue(k).im == 0.0 {
                k += 1;
            } else {
                conjugates.swap(k, k + 1);
                k += 2;
            }
        }
        Self { joined: labels.clone(), labels, conjugates }
    }

    /// The label of the cluster that holds the conjugates of the cluster with this label.
    pub(super) fn conjugate(&self, label: usize) -> usize {
        self.joined[self.conjugates[label]]
    }

    /// Joins the clusters of both eigenvalues of each pair, given by their places on the diagonal,
    /// and those of their conjugates.
    pub(super) fn join(&mut self, pairs: &[(usize, usize)]) {
        for &(a, b) in pairs {
            let (a, b) = (self.labels[a], self.labels[b]);
            let (c, d) = (self.conjugate(a), self.conjugate(b));
            self.merge(a, b);
            self.merge(self.joined[c], self.joined[d]);
        }
    }

    fn merge(&mut self, a: usize, b: usize) {
        let (keep, drop) = (a.min(b), a.max(b));
        if keep != drop {
            let all = self.labels.iter_mut().chain(&mut self.joined);
            all.filter(|label| **label == drop).for_each(|label| *label = keep);
        }
    }
}

/// `T Y = Y D` with block-diagonal `D`: the blocks' sizes and the unit upper triangular `Y`.
#[derive(Debug, Clone)]
pub(super) struct Decoupling {
    /// The sizes of the blocks, in order.
    pub(super) sizes: Vec<usize>,
    /// `Y`; its diagonal blocks are identities.
    pub(super) transform: DMatrix<Complex>,
}

/// Sorts the eigenvalues of `schur` so that those that belong together adjoin, and decouples the
/// clusters (after Bavely & Stewart, SIAM J. Numer. Anal. 16 (1979) 359).
///
/// Eigenvalues are told apart wherever they can be. Two of them share a cluster only if the decoupling of one from the
/// other is ill-conditioned *and* they stay alike over their lifetime within `horizon`, or lie within the blur that
/// rounding gives a defective eigenvalue: then their modes nearly cancel, and only their common exponential is
/// well-conditioned (rigid motion, critical damping, resonance). Also those share one that are equal but for rounding
/// and stay alike, as their modes are anything (displacements that rest wherever they are left).
pub(super) fn decouple(
    schur: &mut ComplexSchur,
    clusters: &mut Clusters,
    horizon: f64,
    caution: Caution,
) -> Decoupling {
    let size = schur.triangle.nrows();
    let norm = schur.triangle.iter().map(|z| z.norm()).fold(0.0, f64::max);
    loop {
        schur.sort(&mut clusters.labels);
        let labels = &clusters.labels;
        let (transform, mut joined) = solve(&schur.triangle, labels);
        for b in 0..size {
            for a in 0..b {
                let coupling = transform[(a, b)].norm();
                let (first, second) = (schur.eigenvalue(a), schur.eigenvalue(b));
                let gap = (first - second).norm();
                let equal = gap <= EQUAL * norm;
                if labels[a] == labels[b] || !(equal || coupling > caution.strong) {
                    continue;
                }
                let slower = first.re.abs().min(second.re.abs());
                let lifetime = if slower * horizon > 1.0 { slower.recip() } else { horizon };
                let blurred = gap <= BLUR * norm && coupling > VERY_STRONG;
                if gap * lifetime <= caution.alike || blurred {
                    joined.push((a, b));
                }
            }
        }
        if joined.is_empty() {
            return Decoupling { sizes: sizes(labels), transform };
        }
        clusters.join(&joined);
    }
}

/// The lengths of the runs of equal labels.
fn sizes(labels: &[usize]) -> Vec<usize> {
    labels.chunk_by(|a, b| a == b).map(<[usize]>::len).collect()
}

/// Solves `T Y = Y D` column by column from the diagonal up; also returns the pairs of equal
/// eigenvalues that cannot be decoupled.
fn solve(t: &DMatrix<Complex>, labels: &[usize]) -> (DMatrix<Complex>, Vec<(usize, usize)>) {
    let size = labels.len();
    let mut y = DMatrix::identity(size, size);
    let mut inseparable = Vec::new();
    for b in 0..size {
        let first = labels.partition_point(|&label| label < labels[b]);
        for a in (0..first).rev() {
            let mut rest = -t[(a, b)];
            for k in a + 1..first {
                rest -= t[(a, k)] * y[(k, b)];
            }
            for k in first..b {
                rest += y[(a, k)] * t[(k, b)];
            }
            if rest == Complex::default() {
                continue;
            }
            let gap = t[(a, a)] - t[(b, b)];
            let value = rest / gap;
            if value.re.is_finite() && value.im.is_finite() {
                y[(a, b)] = value;
            } else {
                inseparable.push((a, b));
            }
        }
    }
    (y, inseparable)
}

/// The inverse of a unit upper triangular matrix.
pub(super) fn invert_unit_triangle(y: &DMatrix<Complex>) -> DMatrix<Complex> {
    let size = y.nrows();
    let mut inverse = DMatrix::identity(size, size);
    for b in 0..size {
        for a in (0..b).rev() {
            let sum: Complex = (a + 1..=b).map(|k| y[(a, k)] * inverse[(k, b)]).sum();
            inverse[(a, b)] = -sum;
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes_of(rows: &[f64], size: usize, horizon: f64) -> Vec<usize> {
        let a = DMatrix::from_row_slice(size, size, rows);
        let mut schur = ComplexSchur::new(&a).unwrap();
        let mut clusters = Clusters::single(&schur);
        let mut sizes = decouple(&mut schur, &mut clusters, horizon, CAUTIONS[0]).sizes;
        sizes.sort_unstable();
        sizes
    }

    #[test]
    fn only_what_cannot_be_told_apart_is_joined() {
        assert_eq!(sizes_of(&[0.0, 1.0, -1.0, -2.0], 2, 10.0), [2], "critical damping");
        assert_eq!(sizes_of(&[0.0, 1.0, 0.0, 0.0], 2, 10.0), [2], "free mass");
        assert_eq!(sizes_of(&[0.0, 1.0, -1.0, -0.1], 2, 10.0), [1, 1], "oscillator");
        assert_eq!(sizes_of(&[0.0, 0.0, 0.0, 0.0], 2, 10.0), [2], "two resting states");
        assert_eq!(sizes_of(&[-1e-9, 0.0, 1.0, -1e3], 2, 1e6), [1, 1], "rates far apart");
    }

    #[test]
    fn the_decoupled_matrix_is_similar() {
        let a = DMatrix::from_fn(9, 9, |i, j| ((5 * i + 2 * j + i * j) as f64).sin());
        let mut schur = ComplexSchur::new(&a).unwrap();
        let mut clusters = Clusters::single(&schur);
        let Decoupling { sizes, transform } = decouple(&mut schur, &mut clusters, 3.0, CAUTIONS[0]);
        let d = invert_unit_triangle(&transform) * &schur.triangle * &transform;
        assert_eq!(sizes, [1; 9]);
        for i in 0..9 {
            for j in 0..9 {
                let expected = if i == j { schur.eigenvalue(i) } else { Complex::default() };
                assert!((d[(i, j)] - expected).norm() < 1e-12);
            }
        }
    }

    #[test]
    fn conjugates_are_joined_alike() {
        // Two oscillators and a decay.
        let mut a = DMatrix::zeros(5, 5);
        for (k, frequency) in [(0, 1.0), (3, 2.0)] {
            a[(k, k + 1)] = frequency;
            a[(k + 1, k)] = -frequency;
        }
        a[(2, 2)] = -1.0;
        let schur = ComplexSchur::new(&a).unwrap();
        let mut clusters = Clusters::single(&schur);
        let place = |im: f64| (0..5).find(|&k| (schur.eigenvalue(k).im - im).abs() < 1e-9).unwrap();
        clusters.join(&[(place(1.0), place(2.0))]);
        let label = |im: f64| clusters.labels[place(im)];
        assert_eq!((label(1.0), label(-1.0)), (label(2.0), label(-2.0)));
        assert_ne!(label(1.0), label(-1.0));
        assert_eq!(clusters.conjugate(label(1.0)), label(-1.0));
        assert_eq!(clusters.conjugate(label(0.0)), label(0.0));
    }
}
