//! The reference impact, in groups and in SI units, to the digits of its tables.

use super::{Scene, Solved};

/// Agreement to the last digit given.
fn same(got: f64, expected: f64, digit: f64) {
    assert!((got - expected).abs() <= 0.6 * digit, "{got:.12} for {expected:.12}");
}

/// Equations 2.20–2.22 with states ζ, ζ′, η, η′, φ, φ′ and the output ξ, ξ′.
fn groups(alpha: f64) -> Scene {
    let (a, b, c, d, beta, gamma) = (26.6, 66.66, 8.0, 80.0, 2.0, 0.1);
    Scene::new(
        &[
            &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, -1.0, 0.0],
            &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            &[0.0, 0.0, -beta, -alpha, gamma, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            &[0.0, d, c * beta, c * alpha - d, -b - c * (1.0 + gamma), -a],
        ],
        &[0.0, 1.0, 0.0, 0.0, 0.0, c],
    )
    .reporting(&[1.0, 0.0, -1.0, 0.0, 0.0, 0.0], None)
    .reporting(&[0.0, 1.0, 0.0, -1.0, 0.0, 0.0], None)
}

const PHI: usize = 4;
const XI: usize = 6;
const XI_RATE: usize = 7;

fn energy(solved: &Solved, until: f64) -> f64 {
    solved.signal(PHI).integral_of_product(&solved.signal(XI_RATE), (0.0, until))
}

#[test]
fn printed_groups_with_light_support_damping() {
    let solved = groups(0.2).solve(10.0);
    let (phi, xi) = (solved.signal(PHI), solved.signal(XI));
    let window = (0.0, 10.0);
    let peak = phi.maximum(window);
    same(peak.value, 0.767_833_515, 1e-9);
    same(peak.time, 0.488_318_669, 1e-9);
    let deepest = xi.maximum(window);
    same(deepest.value, 0.876_753_841, 1e-9);
    same(deepest.time, 3.426_861_744, 1e-9);
    let tension = phi.first_crossing(0.0, (1e-9, 10.0), Some(false)).unwrap();
    same(tension.time, 3.712_820_255, 1e-9);
    same(energy(&solved, 5.0), 0.479_133_623, 1e-9);
    same(energy(&solved, 10.0), 0.481_784_126, 1e-9);
    assert!(phi.error.unwrap() < 1e-13);
}

#[test]
fn printed_groups_with_heavy_support_damping() {
    let solved = groups(200.0).solve(10.0);
    let (phi, xi) = (solved.signal(PHI), solved.signal(XI));
    let window = (0.0, 10.0);
    let peak = phi.maximum(window);
    same(peak.value, 0.782_469_363, 1e-9);
    same(peak.time, 0.505_911_201, 1e-9);
    let deepest = xi.maximum(window);
    same(deepest.value, 0.847_727_298, 1e-9);
    same(deepest.time, 2.336_375_231, 1e-9);
    let tension = phi.first_crossing(0.0, (1e-9, 10.0), Some(false)).unwrap();
    same(tension.time, 2.914_717_554, 1e-9);
    same(energy(&solved, 5.0), 0.499_715_097, 1e-9);
    same(energy(&solved, deepest.time), 0.499_715_337, 1e-9);
}

/// Burgers pad with the deformations of Kelvin element and dashpot as states, in SI units:
/// x1, v1, x2, v2, s1, s2 and the outputs force and deformation.
fn si(c3: f64) -> Scene {
    let (m1, k1, k2, c1, c2, m3, k3) = (10.0, 20e6, 20e6, 4000.0, 6000.0, 100.0, 50e6);
    let force = [k2, 0.0, -k2, 0.0, -k2, -k2];
    let times = |factor: f64| force.map(|f| f * factor);
    let mut support = times(1.0 / m3);
    support[2] -= k3 / m3;
    support[3] -= c3 / m3;
    let mut kelvin = times(1.0 / c1);
    kelvin[4] -= k1 / c1;
    Scene::new(
        &[
            &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            &times(-1.0 / m1),
            &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0],
            &support,
            &kelvin,
            &times(1.0 / c2),
        ],
        &[0.0, 10.0, 0.0, 0.0, 0.0, 0.0],
    )
    .reporting(&force, None)
    .reporting(&[1.0, 0.0, -1.0, 0.0, 0.0, 0.0], None)
    .reporting(&[0.0, 1.0, 0.0, -1.0, 0.0, 0.0], None)
}

/// Peak force \[N\] and time \[ms\], deepest point \[mm\] and time \[ms\], tension \[ms\], speed then
/// \[m/s\], work on the padding \[J\], severity index \[s\].
fn judge_si(c3: f64, expected: [f64; 8]) {
    let solved = si(c3).solve(0.01);
    let (force, deformation) = (solved.signal(6), solved.signal(7));
    let window = (0.0, 0.01);
    let peak = force.maximum(window);
    same(peak.value, expected[0], 1e-6);
    same(peak.time * 1e3, expected[1], 1e-9);
    let deepest = deformation.maximum(window);
    same(deepest.value * 1e3, expected[2], 1e-9);
    same(deepest.time * 1e3, expected[3], 1e-9);
    let tension = force.first_crossing(0.0, (1e-9, 0.01), Some(false)).unwrap().time;
    same(tension * 1e3, expected[4], 1e-9);
    same(solved.signal(1).value(tension), expected[5], 1e-9);
    same(force.integral_of_product(&solved.signal(8), window), expected[6], 1e-6);
    let severity = |f: f64| (f.max(0.0) / (10.0 * 9.80665)).powf(2.5);
    same(force.integral_of((0.0, tension), &[tension], severity), expected[7], 1e-6);
}

#[test]
fn si_reference_with_light_support_damping() {
    judge_si(
        1e4,
        [
            38_359.411_601,
            0.978_689_266,
            17.538_566_287,
            6.852_164_736,
            7.425_568_132,
            -0.481_681_328,
            479.124_454,
            5_019.610_794_304,
        ],
    );
}

#[test]
fn si_reference_with_heavy_support_damping() {
    judge_si(
        1e7,
        [
            39_091.473_661,
            1.013_937_856,
            16.961_880_656,
            4.663_139_515,
            5.822_143_300,
            -0.113_413_391,
            499.715_175,
            5_362.343_040,
        ],
    );
}
