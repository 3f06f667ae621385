//! Integrals: rules of Gauss and Legendre, and of Gauss and Kronrod on halved intervals.

use std::{borrow::Cow, f64::consts::PI, sync::OnceLock};

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
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
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

    /// The nodes and weights of the rule with `N` points on `[0, 1]`.
    pub fn on_unit<const N: usize>() -> ([f64; N], [f64; N]) {
        let rule = Self::with_points(N);
        (
            std::array::from_fn(|at| 0.5 * (1.0 + rule.nodes[at])),
            std::array::from_fn(|at| 0.5 * rule.weights[at]),
        )
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
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, n as f64 * (before - x * value) / ((1.0 - x) * (1.0 + x)))
}

/// Nodes of Kronrod's rule with 31 points on \[−1, 1\], those ≥ 0 in falling order. That is so many that laws which are
/// smooth seldom need halves.
///
/// Source: R. Piessens et al., QUADPACK (1983), `qk31`.
const NODES: [f64; 16] = [
    0.998_002_298_693_397_1,
    0.987_992_518_020_485_4,
    0.967_739_075_679_139_1,
    0.937_273_392_400_706,
    0.897_264_532_344_081_9,
    0.848_206_583_410_427_2,
    0.790_418_501_442_466,
    0.724_417_731_360_170_1,
    0.650_996_741_297_417,
    0.570_972_172_608_538_8,
    0.485_081_863_640_239_7,
    0.394_151_347_077_563_4,
    0.299_180_007_153_168_84,
    0.201_194_093_997_434_51,
    0.101_142_066_918_717_5,
    0.0,
];
/// Weights of Kronrod's rule at these nodes.
const KRONROD: [f64; 16] = [
    0.005_377_479_872_923_349,
    0.015_007_947_329_316_122,
    0.025_460_847_326_715_32,
    0.035_346_360_791_375_85,
    0.044_589_751_324_764_88,
    0.053_481_524_690_928_09,
    0.062_009_567_800_670_64,
    0.069_854_121_318_728_26,
    0.076_849_680_757_720_38,
    0.083_080_502_823_133_02,
    0.088_564_443_056_211_76,
    0.093_126_598_170_825_32,
    0.096_642_726_983_623_68,
    0.099_173_598_721_791_96,
    0.100_769_845_523_875_59,
    0.101_330_007_014_791_54,
];

/// A part of the interval counts as done where both rules agree within this part of it. The better rule is
/// then right to the last digits of a double, also next to a bend.
const AGREEMENT: f64 = 1e-13;
/// How many intervals are halved at most, should `f` be rougher than promised.
const MOST_HALVINGS: usize = 400;

/// The integral of `f ≥ 0` from `a` to `b`, by Gauss and Kronrod's rules on halved intervals, to
/// about 1e-14 of its value where `f` is smooth but for single points.
pub fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    halved(f, (a, b), None)
}

/// The integral of any `f` from `a` to `b`: intervals are halved until both rules agree to `tolerance`,
/// by which the better one is then right by far.
pub fn integral_to(f: impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> f64 {
    halved(f, (a, b), Some(tolerance))
}

/// The same; without a tolerance it is a part of what both rules make of the whole.
fn halved(f: impl Fn(f64) -> f64, span: (f64, f64), mut tolerance: Option<f64>) -> f64 {
    let mut pending = vec![span];
    let (mut sum, mut halvings) = (0.0, 0);
    while let Some((from, to)) = pending.pop() {
        let (kronrod, gauss) = both_rules(&f, from, to);
        let own = AGREEMENT * kronrod.abs();
        let tolerance = *tolerance.get_or_insert(own);
        // A comparison with NaN is false: what is not a number ends here, too.
        let is_rough = (kronrod - gauss).abs() > tolerance.max(own);
        if is_rough && halvings < MOST_HALVINGS {
            let middle = f64::midpoint(from, to);
            pending.push((from, middle));
            pending.push((middle, to));
            halvings += 1;
        } else {
            sum += kronrod;
        }
    }
    sum
}

fn both_rules(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, f64) {
    let (middle, half) = (f64::midpoint(a, b), 0.5 * (b - a));
    // Every second node is one of the rule of Gauss with 15 points.
    let rule = GaussLegendre::with_points(15);
    let (mut kronrod, mut gauss) = (0.0, 0.0);
    for (at, (&node, &weight)) in NODES.iter().zip(&KRONROD).enumerate() {
        let value =
            if node > 0.0 { f(middle - half * node) + f(middle + half * node) } else { f(middle) };
        kronrod += weight * value;
        if at % 2 == 1 {
            gauss += rule.weights[at / 2] * value;
        }
    }
    (half * kronrod, half * gauss)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_is_exact_up_to_its_degree() {
        for points in 1..=40_u32 {
            let rule = GaussLegendre::with_points(points as usize);
            let degree = 2 * points.cast_signed() - 1;
            let power = rule.integrate(0.0, 1.0, |x| x.powi(degree));
            assert!((power * f64::from(degree + 1) - 1.0).abs() < 1e-13, "{points}: {power}");
            assert!((rule.weights().iter().sum::<f64>() - 2.0).abs() < 1e-14);
            assert!(rule.nodes().windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn both_rules_are_exact_for_polynomials_of_their_degree() {
        for degree in 0..=46 {
            let exact = f64::from(degree + 1).recip();
            let (kronrod, gauss) = both_rules(|x| x.powi(degree), 0.0, 1.0);
            assert!((kronrod - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
            assert!(degree > 29 || (gauss - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
        }
    }

    #[test]
    fn steep_bent_and_kinked_functions_are_integrated_to_the_last_digits() {
        let close = |found: f64, exact: f64| {
            assert!((found / exact - 1.0).abs() < 1e-13, "{found} {exact}");
        };
        close(integral(|x| x.powf(1.5), 0.0, 2.0), 2_f64.powf(2.5) / 2.5);
        close(integral(|x| (1.0 - x).powi(-4), 0.0, 0.99), (1e6 - 1.0) / 3.0);
        close(integral(|x: f64| (x - 0.3).abs(), 0.0, 1.0), 0.29);
        assert!(integral(|_| f64::NAN, 0.0, 1.0).is_nan());
        assert!(integral(|x| x, 1.0, 1.0).abs() < f64::MIN_POSITIVE);
    }
}
