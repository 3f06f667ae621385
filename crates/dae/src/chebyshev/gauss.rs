//! Gauss–Legendre quadrature.

use std::{borrow::Cow, f64::consts::PI, sync::OnceLock};

use super::order;

/// Largest number of points that is kept ready.
const KEPT: usize = 32;

/// The Gauss–Legendre rule on `[−1, 1]`: `∫ f ≈ Σ w_i f(x_i)`, exact up to degree `2n − 1`.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussLegendre {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl GaussLegendre {
    /// The rule with this many points, at least one, by Newton's method on the Legendre polynomial.
    pub fn new(points: usize) -> Self {
        let n = points.max(1);
        let mut nodes = vec![0.0; n];
        let mut weights = vec![0.0; n];
        for i in 0..n.div_ceil(2) {
            let mut x = (PI * (order(i) + 0.75) / (order(n) + 0.5)).cos();
            if 2 * i + 1 == n {
                x = 0.0;
            }
            for _ in 0..10 {
                let (value, slope) = legendre(n, x);
                let step = value / slope;
                x -= step;
                if step.abs() < 1e-16 {
                    break;
                }
            }
            let slope = legendre(n, x).1;
            let weight = 2.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
            (nodes[i], nodes[n - 1 - i]) = (-x, x);
            (weights[i], weights[n - 1 - i]) = (weight, weight);
        }
        Self { nodes, weights }
    }

    /// As [`new`](Self::new), but shared for up to 32 points.
    pub fn with_points(points: usize) -> Cow<'static, Self> {
        static TABLE: [OnceLock<GaussLegendre>; KEPT + 1] = [const { OnceLock::new() }; KEPT + 1];
        match TABLE.get(points) {
            Some(cell) => Cow::Borrowed(cell.get_or_init(|| Self::new(points))),
            None => Cow::Owned(Self::new(points)),
        }
    }

    /// The nodes, in rising order.
    pub fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The weights, which add up to 2.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The integral of `f` from `a` to `b`.
    pub fn integrate(&self, a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let pairs = self.nodes.iter().zip(&self.weights);
        half * pairs.map(|(x, weight)| weight * f(middle + half * x)).sum::<f64>()
    }
}

/// The Legendre polynomial `P_n(x)` and its derivative, `|x| < 1`.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = order(k);
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, order(n) * (before - x * value) / ((1.0 - x) * (1.0 + x)))
}
