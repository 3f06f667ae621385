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

/// Nodes of Kronrod's rule with 15 points on \[−1, 1\], those ≥ 0 in falling order.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Weights of Kronrod's rule at these nodes.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_89,
    0.209_482_141_084_727_82,
];
/// Weights of Gauss' rule with 7 points, at every second of these nodes.
const GAUSS: [f64; 4] = [
    0.129_484_966_168_869_7,
    0.279_705_391_489_276_64,
    0.381_830_050_505_118_9,
    0.417_959_183_673_469_4,
];

/// A part of the interval counts as done where both rules agree within this part of it. The better rule is
/// then right to the last digits of a double, also next to a bend.
const AGREEMENT: f64 = 1e-13;
/// How many intervals are halved at most, should `f` be rougher than promised.
const MOST_HALVINGS: usize = 400;

/// The integral of `f ≥ 0` from `a` to `b`, by Gauss and Kronrod's rules on halved intervals, to
/// about 1e-14 of its value where `f` is smooth but for single points.
pub fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let scale = both_rules(&f, a, b).0.abs();
    integral_to(f, a, b, AGREEMENT * scale)
}

/// The integral of any `f` from `a` to `b`: intervals are halved until both rules agree to `tolerance`,
/// by which the better one is then right by far.
pub fn integral_to(f: impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> f64 {
    let mut pending = vec![(a, b)];
    let (mut sum, mut halvings) = (0.0, 0);
    while let Some((from, to)) = pending.pop() {
        let (kronrod, gauss) = both_rules(&f, from, to);
        // A comparison with NaN is false: what is not a number ends here, too.
        let is_rough = (kronrod - gauss).abs() > tolerance.max(AGREEMENT * kronrod.abs());
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
    let (mut kronrod, mut gauss) = (0.0, 0.0);
    for (at, (&node, &weight)) in NODES.iter().zip(&KRONROD).enumerate() {
        let value =
            if node > 0.0 { f(middle - half * node) + f(middle + half * node) } else { f(middle) };
        kronrod += weight * value;
        if at % 2 == 1 {
            gauss += GAUSS[at / 2] * value;
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
        for degree in 0..=22 {
            let exact = f64::from(degree + 1).recip();
            let (kronrod, gauss) = both_rules(|x| x.powi(degree), 0.0, 1.0);
            assert!((kronrod - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
            assert!(degree > 13 || (gauss - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
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
