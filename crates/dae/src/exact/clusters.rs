//! Which eigenvalues belong together.

use super::schur::ComplexSchur;

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

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;

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
