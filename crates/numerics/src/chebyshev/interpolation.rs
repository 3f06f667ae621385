//! From values at nodes to coefficients.

use std::{borrow::Cow, f64::consts::FRAC_PI_2, f64::consts::PI, sync::OnceLock};

use super::{antiderivative, evaluate};

/// Highest degree that is kept ready.
const KEPT: usize = 32;

/// Interpolation of one degree at the Chebyshev–Lobatto points `x_j = −cos(π j/d)`, in rising
/// order with both ends among them; the single node of degree 0 is the midpoint.
#[derive(Debug, Clone, PartialEq)]
pub struct Interpolation {
    nodes: Vec<f64>,
    /// `c_k = Σ_j transform[j (d+1) + k] v_j`.
    transform: Vec<f64>,
    /// The integral from −1 to `x_k` is `Σ_j integration[j (d+1) + k] v_j`.
    integration: Vec<f64>,
}

impl Interpolation {
    /// Interpolation by polynomials of this degree.
    pub fn new(degree: usize) -> Self {
        if degree == 0 {
            return Self { nodes: vec![0.0], transform: vec![1.0], integration: vec![1.0] };
        }
        let count = degree + 1;
        let d = degree as f64;
        // The sine makes the nodes symmetric about an exact zero.
        let nodes: Vec<f64> =
            (0..count).map(|j| (FRAC_PI_2 * (2.0 * j as f64 - d) / d).sin()).collect();
        let half = |index: usize| if index == 0 || index == degree { 0.5 } else { 1.0 };
        let mut transform = Vec::with_capacity(count * count);
        for j in 0..count {
            for k in 0..count {
                // T_k(x_j) = cos(π k (d − j)/d), with the argument reduced exactly.
                let angle = PI * (k * (degree - j) % (2 * degree)) as f64 / d;
                transform.push(2.0 / d * half(k) * half(j) * angle.cos());
            }
        }
        let mut integration = Vec::with_capacity(count * count);
        for row in transform.chunks_exact(count) {
            let own = antiderivative(row);
            let first = evaluate(&own, -1.0);
            integration.extend(nodes.iter().map(|&node| evaluate(&own, node) - first));
        }
        Self { nodes, transform, integration }
    }

    /// As [`new`](Self::new), but shared for degrees up to 32.
    pub fn of_degree(degree: usize) -> Cow<'static, Self> {
        static TABLE: [OnceLock<Interpolation>; KEPT + 1] = [const { OnceLock::new() }; KEPT + 1];
        match TABLE.get(degree) {
            Some(cell) => Cow::Borrowed(cell.get_or_init(|| Self::new(degree))),
            None => Cow::Owned(Self::new(degree)),
        }
    }

    /// The degree of the polynomials.
    pub fn degree(&self) -> usize {
        self.nodes.len() - 1
    }

    /// The nodes in rising order, `degree + 1` of them.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// For each node what a value of 1 there adds to the coefficients.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.transform.chunks_exact(self.nodes.len())
    }

    /// For each node the integrals of the polynomial that is 1 there and 0 at the others, from −1 to each node.
    pub fn integrals(&self) -> impl Iterator<Item = &[f64]> {
        self.integration.chunks_exact(self.nodes.len())
    }

    /// Writes to `out` the coefficients of the polynomial with these `values` at the nodes.
    ///
    /// # Panics
    ///
    /// When `values` or `out` has not `degree + 1` entries.
    pub fn coefficients(&self, values: &[f64], out: &mut [f64]) {
        let count = self.nodes.len();
        assert_eq!(values.len(), count, "a value for each node");
        assert_eq!(out.len(), count, "a coefficient for each node");
        out.fill(0.0);
        for (value, weights) in values.iter().zip(self.transform.chunks_exact(count)) {
            for (sum, weight) in out.iter_mut().zip(weights) {
                *sum += weight * value;
            }
        }
    }
}
