//! Jacobi's elliptic functions.

/// `sn`, `cn` and `dn` of `u` for the parameter `m = k²` from 0 to below 1, by the arithmetic-geometric
/// mean.
///
/// Abramowitz and Stegun, Handbook of mathematical functions (1964), 16.4.
pub(super) fn jacobi(u: f64, m: f64) -> [f64; 3] {
    /// Enough for all digits: the ratios fall quadratically.
    const MEANS: usize = 6;
    let (mut a, mut b) = (1.0, (1.0 - m).sqrt());
    let mut ratios = [0.0; MEANS];
    for ratio in &mut ratios {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        *ratio = c / a;
    }
    let mut phase = f64::from(1_u32 << MEANS) * a * u;
    for ratio in ratios.iter().rev() {
        phase = 0.5 * (phase + (ratio * phase.sin()).asin());
    }
    let (sn, cn) = phase.sin_cos();
    [sn, cn, (1.0 - m * sn * sn).sqrt()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_of_the_period_is_the_complete_integral() {
        // K(1/4) by its series π/2 Σ ((2n)!/(2²ⁿ n!²))² mⁿ.
        let (mut term, mut sum) = (1.0_f64, 0.0);
        for n in 0..40 {
            sum += term;
            let n = f64::from(n);
            term *= ((2.0 * n + 1.0) / (2.0 * n + 2.0)).powi(2) * 0.25;
        }
        let quarter = std::f64::consts::FRAC_PI_2 * sum;
        let [sn, cn, dn] = jacobi(quarter, 0.25);
        assert!((sn - 1.0).abs() < 1e-15 && cn.abs() < 1e-15, "{sn} {cn}");
        assert!((dn - 0.75_f64.sqrt()).abs() < 1e-15, "{dn}");
    }

    #[test]
    fn doubled_arguments_follow_from_single_ones() {
        for k in 0..50 {
            let u = 0.07 * f64::from(k);
            let [s, c, d] = jacobi(u, 0.25);
            let below = 1.0 - 0.25 * s.powi(4);
            let [_, doubled, _] = jacobi(2.0 * u, 0.25);
            let expected = (c * c - s * s * d * d) / below;
            assert!((doubled - expected).abs() < 5e-15, "{u}: {doubled} {expected}");
        }
    }
}
