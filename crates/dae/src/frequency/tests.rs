use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::*;
use crate::{Input, LinearForm, Outputs, Unknown, Waveform};

/// `(row, column, value)`.
type Triplets<'a> = &'a [(usize, usize, f64)];

const TIME_SCALE: f64 = 0.125;

/// A system with the output `y` and one waveform, of which each of `orders` is a derivative.
fn system(
    kinds: &[UnknownKind],
    jacobian: Triplets<'_>,
    input_matrix: Triplets<'_>,
    orders: &[u32],
) -> System {
    let matrix = |columns: usize, triplets: Triplets<'_>| {
        let mut matrix = CooMatrix::new(kinds.len(), columns);
        triplets.iter().for_each(|&(row, column, value)| matrix.push(row, column, value));
        CsrMatrix::from(&matrix)
    };
    let unknown =
        |&kind: &UnknownKind| Unknown { name: "y".to_owned(), kind, scale: 1.0, unit: "m" };
    let mut outputs = Outputs::new();
    for at in 0..kinds.len() {
        let (name, own) = (format!("y{at}"), LinearForm::term(at, 0.25));
        outputs.push(&name, "m", 4.0, &own, &LinearForm::zero());
    }
    System {
        unknowns: kinds.iter().map(unknown).collect(),
        jacobian: matrix(kinds.len(), jacobian),
        input_matrix: matrix(orders.len(), input_matrix),
        inputs: orders.iter().map(|&derivative| Input { waveform: 0, derivative }).collect(),
        waveforms: vec![Waveform::constant(0.0)],
        terms: Vec::new(),
        initial: vec![0.0; kinds.len()],
        outputs,
        time_scale: TIME_SCALE,
    }
}

/// `x' = v, v' = −x − 2ζ v + u + 2ζ u'` in dimensionless time.
fn mount(zeta: f64) -> System {
    let entries = [(0, 1, 1.0), (1, 0, -1.0), (1, 1, -2.0 * zeta)];
    let driven = [(1, 0, 1.0), (1, 1, 2.0 * zeta)];
    system(&[UnknownKind::Differential; 2], &entries, &driven, &[0, 1])
}

fn closed(zeta: f64, r: f64) -> Complex<f64> {
    let loss = Complex::new(0.0, 2.0 * zeta * r);
    (loss + 1.0) / (loss + (1.0 - r) * (1.0 + r))
}

#[test]
fn a_mount_passes_on_what_the_closed_form_says_within_the_stated_error() {
    for zeta in [1e-4, 0.01, 0.3, 2.0] {
        let system = mount(zeta);
        let response = FrequencyResponse::new(&system, &[1.0]).unwrap();
        for r in [0.0, 0.125, 0.9, 1.0, 1.0 + 2e-4, 3.0, 100.0] {
            let own = response.at(r / TIME_SCALE).unwrap().amplitude(&[(0, 1.0)]);
            let exact = closed(zeta, r);
            let off = (own.value - exact).norm();
            assert!(off <= own.error, "{zeta} {r}: {off:e} > {:e}", own.error);
            // Four roundings in each of some ten terms, as often as the resonance multiplies them.
            let most = 40.0 * f64::EPSILON * exact.norm().max(1.0) / zeta.min(1.0);
            assert!(own.error <= most, "{zeta} {r}: {:e}", own.error);
        }
    }
}

#[test]
fn the_slope_is_the_derivative_over_the_frequency() {
    let zeta = 0.05;
    let system = mount(zeta);
    let response = FrequencyResponse::new(&system, &[1.0]).unwrap();
    for r in [0.3, 1.0, 1.7] {
        let own = response.at(r / TIME_SCALE).unwrap().amplitude(&[(0, 2.0)]);
        // d/dr of (1 + iqr)/(1 − r² + iqr), q = 2ζ.
        let q = Complex::new(0.0, 2.0 * zeta);
        let below = q * r + 1.0 - r * r;
        let exact = (q * below - (q * r + 1.0) * (q - 2.0 * r)) / (below * below);
        let exact = exact * 2.0 * TIME_SCALE;
        assert!((own.slope - exact).norm() <= 1e-12 * exact.norm(), "{r}: {} {exact}", own.slope);
    }
}

#[test]
fn an_algebraic_unknown_is_solved_with_the_others() {
    // y0' = −y1 + u', 0 = y0 − 2 y1: y0 (s + ½) = s u, y1 = y0/2.
    use UnknownKind::{Algebraic, Differential};
    let entries = [(0, 1, -1.0), (1, 0, 1.0), (1, 1, -2.0)];
    let system = system(&[Differential, Algebraic], &entries, &[(0, 0, 1.0)], &[1]);
    let harmonic = FrequencyResponse::new(&system, &[3.0]).unwrap().at(5.0).unwrap();
    let s = Complex::new(0.0, 5.0 * TIME_SCALE);
    let exact = s / (s + 0.5) * 1.5;
    let own = harmonic.amplitude(&[(1, 1.0)]);
    assert!((own.value - exact).norm() <= 1e-15);
    let both = harmonic.amplitude(&[(1, 2.0), (0, -1.0)]);
    assert!(both.value.norm() <= both.error && both.error < 1e-14);
    let poles = poles(&system).unwrap();
    assert_eq!(poles.len(), 1);
    assert!((poles[0] * TIME_SCALE + 0.5).norm() < 1e-15);
}

#[test]
fn the_poles_of_a_mount_are_its_damped_frequency() {
    let zeta = 0.1_f64;
    let found = poles(&mount(zeta)).unwrap();
    let exact = Complex::new(-zeta, (1.0 - zeta * zeta).sqrt()) / TIME_SCALE;
    assert!(found.iter().any(|own| (own - exact).norm() < 1e-14 / TIME_SCALE));
    assert!(found.iter().any(|own| (own - exact.conj()).norm() < 1e-14 / TIME_SCALE));
}

#[test]
fn an_undamped_resonance_has_no_answer_or_a_boundless_error() {
    let system = mount(0.0);
    let response = FrequencyResponse::new(&system, &[1.0]).unwrap();
    let own = response.at(1.0 / TIME_SCALE).map(|own| own.amplitude(&[(0, 1.0)]));
    assert!(own.is_none_or(|own| own.error > 0.1 * own.value.norm()));
}

#[test]
fn amplitudes_that_are_not_given_are_zero() {
    let system = mount(0.1);
    let still = FrequencyResponse::new(&system, &[]).unwrap().at(5.0).unwrap();
    assert_eq!(still.amplitude(&[(0, 1.0)]).value, Complex::default());
}
