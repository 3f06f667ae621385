//! Gauss–Legendre quadrature.

use std::f64::consts::PI;

/// Nodes and weights of the rule with `N` nodes on \[−1, 1\].
pub(super) fn gauss_legendre<const N: usize>() -> [(f64, f64); N] {
    let mut rule = [(0.0, 0.0); N];
    for (index, entry) in rule.iter_mut().enumerate() {
        let mut node = -((index as f64 + 0.75) / (N as f64 + 0.5) * PI).cos();
        let mut slope = 1.0;
        // Newton's method doubles the digits of this start, about three, each time.
        for _ in 0..5 {
            let (value, derivative) = legendre(N, node);
            slope = derivative;
            node -= value / derivative;
        }
        *entry = (node, 2.0 / ((1.0 - node * node) * slope * slope));
    }
    rule
}

/// The Legendre polynomial of `degree` ≥ 1 and its derivative at `x` within (−1, 1).
fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for n in 2..=degree {
        let n = n as f64;
        (before, value) = (value, ((2.0 * n - 1.0) * x * value - (n - 1.0) * before) / n);
    }
    (value, degree as f64 * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_up_to_twice_the_nodes_are_integrated_exactly() {
        let rule = gauss_legendre::<12>();
        for power in 0..24 {
            let sum: f64 = rule.iter().map(|(x, w)| w * x.powi(power)).sum();
            let exact = if power % 2 == 0 { 2.0 / (f64::from(power) + 1.0) } else { 0.0 };
            assert!((sum - exact).abs() < 4e-15, "power {power}: {sum} instead of {exact}");
        }
    }
}
