//! Integrals without a closed form.

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

/// A part of the interval counts as done where both rules agree within this part of the whole. The
/// better rule is then right to the last digits of a double, also next to a bend.
const AGREEMENT: f64 = 1e-13;
/// How often the interval is halved at most: to the resolution of a double.
const MOST_HALVINGS: u32 = 50;

/// The integral of `f ≥ 0` from `a` to `b`, by Gauss and Kronrod's rules on halved intervals, to
/// about 1e-14 of its value where `f` is smooth but for single points.
pub(crate) fn integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let scale = both_rules(&f, a, b).0.abs();
    let mut pending = vec![(a, b, 0)];
    let mut sum = 0.0;
    while let Some((from, to, halvings)) = pending.pop() {
        let (kronrod, gauss) = both_rules(&f, from, to);
        // A comparison with NaN is false: what is not a number ends here, too.
        if halvings < MOST_HALVINGS && (kronrod - gauss).abs() > AGREEMENT * scale {
            let middle = f64::midpoint(from, to);
            pending.push((from, middle, halvings + 1));
            pending.push((middle, to, halvings + 1));
        } else {
            sum += kronrod;
        }
    }
    sum
}

/// Nodes > 0 of Gauss' rule with 4 points on \[−1, 1\], and their weights.
const FOUR: [(f64, f64); 2] = [
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
];

/// The integral of a polynomial of at most the seventh degree from `a` to `b`.
pub(super) fn polynomial_integral(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let (middle, half) = (f64::midpoint(a, b), 0.5 * (b - a));
    let pair =
        |(node, weight): (f64, f64)| weight * (f(middle - half * node) + f(middle + half * node));
    half * FOUR.into_iter().map(pair).sum::<f64>()
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
    fn both_rules_are_exact_for_polynomials_of_their_degree() {
        for degree in 0..=22 {
            let exact = f64::from(degree + 1).recip();
            let (kronrod, gauss) = both_rules(|x| x.powi(degree), 0.0, 1.0);
            assert!((kronrod - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
            assert!(degree > 13 || (gauss - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
        }
    }

    #[test]
    fn four_points_are_exact_up_to_the_seventh_degree() {
        for degree in 0..=7 {
            let exact = f64::from(degree + 1).recip();
            let found = polynomial_integral(|x| x.powi(degree), 0.0, 1.0);
            assert!((found - exact).abs() < 4.0 * f64::EPSILON, "{degree}");
        }
        assert!((polynomial_integral(|x| x.powi(8), 0.0, 1.0) - 1.0 / 9.0).abs() > 1e-6);
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
