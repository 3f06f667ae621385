use std::f64::consts::PI;

use super::*;
use crate::Stream;

/// A number in `[−1, 1]`.
fn next(stream: &mut Stream) -> f64 {
    2.0 * stream.share() - 1.0
}

fn coefficients(stream: &mut Stream, degree: usize) -> Vec<f64> {
    (0..=degree).map(|_| next(stream)).collect()
}

fn places() -> impl Iterator<Item = f64> {
    (0..=40_u32).map(|i| f64::from(i) / 20.0 - 1.0)
}

fn interpolate(degree: usize, f: impl Fn(f64) -> f64) -> Vec<f64> {
    let interpolation = Interpolation::new(degree);
    let values: Vec<f64> = interpolation.nodes().iter().map(|&x| f(x)).collect();
    let mut coefficients = vec![0.0; degree + 1];
    interpolation.coefficients(&values, &mut coefficients);
    coefficients
}

#[test]
fn places_of_the_smallest_numbers_are_searched_to_an_end() {
    for exponent in [-1000, -1040, -1060, -1070, -1074] {
        let size = f64::from(exponent).exp2();
        // Sines over some periods, as they come from a table of Chebyshev coefficients.
        let nodes = Interpolation::of_degree(16);
        let values: Vec<f64> = nodes.nodes().iter().map(|x| size * (7.0 * x + 0.3).sin()).collect();
        let mut coefficients = vec![0.0; 17];
        nodes.coefficients(&values, &mut coefficients);
        let found = sign_changes(&coefficients);
        assert!(found.len() <= 17, "{exponent}: {found:?}");
        if exponent >= -1040 {
            let zeros: Vec<f64> = (-2..=2).map(|k| (PI * f64::from(k) - 0.3) / 7.0).collect();
            let is_near = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-3;
            let all = found.len() == zeros.len() && found.iter().zip(&zeros).all(is_near);
            assert!(all, "{exponent}: {found:?}");
        }
    }
}

#[test]
fn evaluation_agrees_with_the_cosine_form() {
    for degree in 0..=20 {
        let mut unit = vec![0.0; degree + 1];
        unit[degree] = 1.0;
        for x in places() {
            let exact = (degree as f64 * x.acos()).cos();
            assert!((evaluate(&unit, x) - exact).abs() < 4e-15 * (1.0 + degree as f64));
        }
    }
}

#[test]
fn interpolation_returns_the_coefficients_of_a_polynomial() {
    let mut stream = Stream::new(1);
    for degree in 0..=40 {
        let exact = coefficients(&mut stream, degree);
        let found = interpolate(degree, |x| evaluate(&exact, x));
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found - exact).abs() < 4e-16 * bound(&[degree as f64 + 4.0]));
        }
    }
}

#[test]
fn nodes_rise_from_end_to_end() {
    for degree in 1..=40 {
        let interpolation = Interpolation::new(degree);
        let nodes = interpolation.nodes();
        assert_eq!((nodes[0], nodes[degree]), (-1.0, 1.0));
        assert!(nodes.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

#[test]
fn derivative_undoes_antiderivative() {
    let mut stream = Stream::new(3);
    for degree in 0..=20 {
        let p = coefficients(&mut stream, degree);
        let area = antiderivative(&p);
        assert!(evaluate(&area, -1.0).abs() < 1e-14);
        assert!((evaluate(&area, 1.0) - integral(&p)).abs() < 1e-14);
        for (c, exact) in derivative(&area).iter().zip(&p) {
            assert!((c - exact).abs() < 1e-13);
        }
    }
    assert_eq!(*derivative(&[3.0]), [0.0]);
}

#[test]
fn restriction_is_the_same_polynomial() {
    let mut stream = Stream::new(4);
    for degree in 0..=20 {
        let p = coefficients(&mut stream, degree);
        let (a, b) = (next(&mut stream) * 0.5 - 0.5, next(&mut stream) * 0.5 + 0.5);
        let part = restrict(&p, a, b);
        for x in places() {
            let exact = evaluate(&p, 0.5 * (a + b) + 0.5 * (b - a) * x);
            assert!((evaluate(&part, x) - exact).abs() < 1e-14 * (1.0 + degree as f64));
        }
        let area = antiderivative(&p);
        let exact = evaluate(&area, b) - evaluate(&area, a);
        let found = 0.5 * (b - a) * integral(&part);
        assert!((found - exact).abs() < 1e-14 * (1.0 + degree as f64));
    }
}

#[test]
fn sign_changes_are_the_zeros_of_chebyshev_polynomials() {
    for degree in 1..=24_usize {
        let mut unit = vec![0.0; degree + 1];
        unit[degree] = 1.0;
        let zeros = sign_changes(&unit);
        assert_eq!(zeros.len(), degree);
        for (k, zero) in zeros.iter().enumerate() {
            let exact = -(PI * (k as f64 + 0.5) / degree as f64).cos();
            assert!((zero - exact).abs() < 4e-16);
        }
    }
}

#[test]
fn sign_changes_leave_out_zeros_of_even_order() {
    let double = interpolate(3, |x| (x - 0.3) * (x - 0.3) * (x + 0.5));
    let zeros = sign_changes(&double);
    assert!(zeros.len() == 1 || zeros.len() == 3, "{zeros:?}");
    assert!((zeros[0] + 0.5).abs() < 1e-15);
    assert!(zeros[1..].iter().all(|zero| (zero - 0.3).abs() < 1e-7));
    let triple = sign_changes(&interpolate(3, |x| (x - 0.3).powi(3)));
    assert!(!triple.is_empty() && triple.iter().all(|zero| (zero - 0.3).abs() < 3e-5));
    assert!(sign_changes(&[1.0, 0.5, 0.49]).is_empty());
    assert!(sign_changes(&[0.0]).is_empty());
    assert!(sign_changes(&[]).is_empty());
    assert!(sign_changes(&[0.0, 0.0, 0.0]).is_empty());
    assert_eq!(sign_changes(&[0.0, 0.0, 0.0, 1.0]).len(), 3);
}

/// Zeros in order, each with a `|p|` that is rounding.
fn assert_zeros(p: &[f64]) {
    let zeros = sign_changes(p);
    assert!(zeros.windows(2).all(|pair| pair[0] < pair[1]));
    for &zero in &zeros {
        assert!(evaluate(p, zero).abs() < 1e-14 * bound(p), "{p:?}: {zero}");
    }
}

/// Divided without end around a zero of higher order, a single one of these took many seconds.
#[test]
fn zeros_of_higher_order_are_found_without_endless_division() {
    for degree in [8, 12, 16, 24, 32, 64] {
        for step in 0..=16_u32 {
            let touched = f64::from(step) / 8.0 - 1.0;
            for power in 2..=8 {
                let plain = |x: f64| (x - touched).powi(power);
                let waved = |x: f64| plain(x) * (x + 0.2 * touched).cos();
                let twice = |x: f64| (x - touched).powi(2) * (x + 0.1).powi(power);
                assert_zeros(&interpolate(degree, plain));
                assert_zeros(&interpolate(degree, waved));
                assert_zeros(&interpolate(degree, twice));
            }
        }
    }
    let odd = interpolate(20, |x| (1.0 + x).powi(2) * x.cos() * (x - 0.25));
    let zeros = sign_changes(&odd);
    assert!((zeros[zeros.len() - 1] - 0.25).abs() < 1e-14, "{zeros:?}");
}

#[test]
fn sign_changes_of_random_polynomials_agree_with_dense_samples() {
    let mut stream = Stream::new(5);
    for round in 0..2000 {
        let p = coefficients(&mut stream, round % 21);
        let zeros = sign_changes(&p);
        let mut side = evaluate(&p, -1.0) < 0.0;
        let mut sampled = 0;
        for i in 1..=4000_u32 {
            let next = evaluate(&p, f64::from(i) / 2000.0 - 1.0) < 0.0;
            sampled += usize::from(next != side);
            side = next;
        }
        assert!(
            zeros.len() >= sampled && (zeros.len() - sampled).is_multiple_of(2),
            "{p:?}: {zeros:?}"
        );
        assert!(zeros.len() < p.len().max(1) && zeros.windows(2).all(|pair| pair[0] < pair[1]));
        let slope = derivative(&p);
        for &zero in &zeros {
            let noise = 1e-14 + 2e-16 * bound(&slope);
            assert!(evaluate(&p, zero).abs() < noise);
        }
    }
}

#[test]
fn products_are_integrated_as_the_polynomials_that_they_are() {
    let mut stream = Stream::new(7);
    for [one, other] in
        [[0, 0], [3, 0], [0, 4], [5, 5], [16, 15], [31, 31], [2, 31], [32, 1], [40, 33]]
    {
        let (p, q) = (coefficients(&mut stream, one), coefficients(&mut stream, other));
        let product = interpolate(one + other, |x| evaluate(&p, x) * evaluate(&q, x));
        let off = integral_of_product(&p, &q) - integral(&product);
        assert!(off.abs() < 1e-15 * bound(&p) * bound(&q), "{one} and {other}: {off:e}");
    }
}
