use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::*;
use crate::{LinearForm, Outputs, Unknown, UnknownKind, tests::problems};

/// Rounding errors in parts of `ε` times the magnitude that are accepted.
const ROUNDING: f64 = 16.0;

fn judge(found: &Derivatives, k: usize, i: usize, expected: f64) {
    let (value, magnitude) = (found.values[k][i], found.magnitudes[k][i]);
    let difference = (value - expected).abs();
    let what = format!("order {k} of {i}: {value}, not {expected}; {magnitude}");
    assert!(difference <= ROUNDING * f64::EPSILON * magnitude, "{what}");
    assert!(value.abs() <= magnitude * (1.0 + 1e-14), "{what}");
}

#[test]
fn a_driven_oscillator_follows_its_equation_in_all_orders() {
    let system = problems::driven_by_sine().system;
    let (x, v) = (0.3, -0.8);
    let found = derivatives(&system, &[x, v], 6).unwrap();
    // x″ = sin 2t − 0.4 x′ − x.
    let force = |k: usize| [0.0, 2.0, 0.0, -8.0, 0.0, 32.0, 0.0][k];
    let mut orders = vec![x, v];
    for k in 0..6 {
        orders.push(force(k) - 0.4 * orders[k + 1] - orders[k]);
        assert!((found.inputs[k][0] - force(k)).abs() <= 1e-15 * force(k).abs());
    }
    for k in 0..=6 {
        judge(&found, k, 0, orders[k]);
        judge(&found, k, 1, orders[k + 1]);
    }
}

#[test]
fn a_maxwell_element_relaxes_in_all_orders() {
    let system = problems::maxwell_relaxation().system;
    let found = derivatives(&system, &[0.0, 7.0], 6).unwrap();
    for k in 0..=6 {
        let force = if k % 2 == 0 { 1.0 } else { -1.0 };
        judge(&found, k, 1, force);
        judge(&found, k, 0, if k == 0 { 0.0 } else { -force });
    }
}

#[test]
fn a_cubic_spring_is_exact_up_to_its_second_rate() {
    let system = problems::cubic_spring().system;
    let (x, v) = (0.8_f64, 0.3);
    let found = derivatives(&system, &[x, v, 0.0], 3).unwrap();
    let force = x + x.powi(3);
    let rate = (1.0 + 3.0 * x * x) * v;
    for (k, expected) in [[x, v, force], [v, -force, rate]].into_iter().enumerate() {
        for (i, value) in expected.into_iter().enumerate() {
            judge(&found, k, i, value);
        }
    }
    judge(&found, 2, 0, -force);
    judge(&found, 2, 1, -rate);
    judge(&found, 3, 0, -rate);
    // With its tangent the spring lacks 6 x v² in the second rate of the force.
    judge(&found, 2, 2, (1.0 + 3.0 * x * x) * -force);
}

#[test]
fn a_force_in_its_own_law_is_solved_before_it_is_differentiated() {
    let problem = problems::springs_in_series();
    let found = derivatives(&problem.system, &[0.0, 0.0], 2).unwrap();
    // z = 1, f = z², x′ = f; z′ (1 + z) = −z² and f′ = 2 z z′.
    judge(&found, 0, 1, 1.0);
    judge(&found, 1, 0, 1.0);
    judge(&found, 1, 1, -1.0);
    judge(&found, 2, 0, -1.0);
}

#[test]
fn inputs_of_laws_drive_their_rates() {
    let system = problems::pulled_spring().system;
    let found = derivatives(&system, &[-0.5, 0.0], 2).unwrap();
    // z = u − x = ½ and u′ = 2: f = z², x′ = f, f′ = 2 z (u′ − f).
    judge(&found, 0, 1, 0.25);
    judge(&found, 1, 0, 0.25);
    judge(&found, 1, 1, 1.75);
    judge(&found, 2, 0, 1.75);
}

#[test]
fn every_problem_agrees_with_differences_of_its_solution() {
    for problem in problems::all() {
        let system = &problem.system;
        let found = derivatives(system, &system.initial, 2).unwrap();
        let at = |t: f64| problem.exact(t * system.time_scale);
        // One-sided differences of order 4 and 3 with a step in units of the fastest rate.
        let step = if problem.stiff { 1e-9 } else { 1e-3 };
        let points: Vec<Vec<f64>> = (0..=4).map(|k| at(step * f64::from(k))).collect();
        let first = [-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25];
        let second = [35.0 / 12.0, -26.0 / 3.0, 9.5, -14.0 / 3.0, 11.0 / 12.0];
        let sum = |weights: [f64; 5], i: usize| -> f64 {
            weights.iter().zip(&points).map(|(weight, row)| weight * row[i]).sum()
        };
        for i in 0..system.len() {
            let size = 1.0 + found.magnitudes[1][i];
            let (rate, expected) = (found.values[1][i], sum(first, i) / step);
            // A law that begins with the power 3/2 has a difference quotient of order 1/2 only.
            let rough = problem.name.contains("Hertz");
            let tolerance = if rough { 0.1 } else { 1e-6 };
            let what = format!("{} {i}: {rate} {expected}", problem.name);
            assert!((rate - expected).abs() < tolerance * size, "{what}");
            if system.unknowns[i].kind == UnknownKind::Differential && !problem.stiff && !rough {
                let (rate, expected) = (found.values[2][i], sum(second, i) / (step * step));
                let size = 1.0 + found.magnitudes[2][i];
                let what = format!("{} {i}, second: {rate} {expected}", problem.name);
                assert!((rate - expected).abs() < 20.0 * tolerance * size, "{what}");
            }
        }
    }
}

/// `x′ = 0`, `z′ = 0`, `0 = 10⁸ (x − z) − f`.
fn difference_of_large_numbers() -> System {
    use UnknownKind::{Algebraic, Differential};
    let mut jacobian = CooMatrix::new(3, 3);
    for (row, column, value) in [(2, 0, 1e8), (2, 1, -1e8), (2, 2, -1.0)] {
        jacobian.push(row, column, value);
    }
    let unknown = |(name, kind)| Unknown { name: String::from(name), kind, scale: 2.0, unit: "N" };
    let unknowns = [("x", Differential), ("z", Differential), ("f", Algebraic)];
    System {
        unknowns: unknowns.map(unknown).to_vec(),
        jacobian: CsrMatrix::from(&jacobian),
        input_matrix: CsrMatrix::zeros(3, 0),
        inputs: Vec::new(),
        waveforms: Vec::new(),
        terms: Vec::new(),
        initial: vec![0.0; 3],
        outputs: Outputs::new(),
        time_scale: 1.0,
    }
}

#[test]
fn magnitudes_tell_what_cancels() {
    let system = difference_of_large_numbers();
    let found = derivatives(&system, &[0.1 + 0.2, 0.3, 0.0], 0).unwrap();
    let (value, magnitude) = (found.values[0][2], found.magnitudes[0][2]);
    // The force is nothing but the rounding of 0.1 + 0.2.
    assert!(value != 0.0 && value.abs() < f64::EPSILON * magnitude, "{value} {magnitude}");
    assert!((magnitude - 6e7).abs() < 1.0, "{magnitude}");
}

#[test]
fn outputs_are_scaled_and_carry_their_magnitude() {
    let system = problems::driven_by_sine().system;
    let found = derivatives(&system, &[3.0, 2.0], 1).unwrap();
    let mut outputs = Outputs::new();
    let unknowns = LinearForm::sum(vec![(0, 1.0), (1, -2.0)]);
    outputs.push("sum", "N", -10.0, &unknowns, &LinearForm::term(0, 0.5));
    let output = outputs.at(0);
    let (value, magnitude) = found.output(output, 0);
    assert!((value - 10.0).abs() < 1e-13 && (magnitude - 70.0).abs() < 1e-13);
    // x′ = 2, x″ = −3.8, and the force begins with the rate 2.
    let (value, magnitude) = found.output(output, 1);
    assert!((value + 10.0 * (2.0 + 7.6 + 1.0)).abs() < 1e-12, "{value}");
    assert!((magnitude - 10.0 * (2.0 + 7.6 + 1.0)).abs() < 1e-12, "{magnitude}");
}

#[test]
fn what_has_no_derivatives_is_refused() {
    let mut system = difference_of_large_numbers();
    let lost = derivatives(&system, &[f64::NAN, 0.0, 0.0], 1);
    assert!(matches!(lost, Err(SolveError::NotFinite { unknown, .. }) if unknown == "x"));
    system.jacobian.values_mut()[2] = 0.0;
    let Err(error) = derivatives(&system, &[1.0, 0.0, 0.0], 1) else { panic!("{system:?}") };
    assert!(error.to_string().contains("no balance determines `f`"), "{error}");
}

#[test]
fn dense_and_sparse_matrices_give_the_same_derivatives() {
    for problem in problems::all() {
        let system = &problem.system;
        let dense = derivatives_in::<NalgebraMat<f64>>(system, &system.initial, 4).unwrap();
        let sparse = derivatives_in::<FaerSparseMat<f64>>(system, &system.initial, 4).unwrap();
        for k in 0..=4 {
            for i in 0..system.len() {
                let difference = (dense.values[k][i] - sparse.values[k][i]).abs();
                let size = dense.magnitudes[k][i].max(sparse.magnitudes[k][i]);
                let what = format!("{} {k} {i}: {difference:e} of {size:e}", problem.name);
                assert!(difference <= 16.0 * f64::EPSILON * size, "{what}");
            }
        }
    }
}

#[test]
fn magnitudes_of_drives_are_not_below_their_values() {
    let piece = Piece {
        start: -0.7,
        value: 1.0,
        slope: -2.0,
        curvature: 3.0,
        jerk: -0.5,
        sine: 0.4,
        cosine: -0.9,
        omega: 3.0,
        sweep: 0.6,
    };
    for order in 0..6 {
        for t in [-0.7, 0.0, 2.0] {
            let value = piece.derivative(order, t).abs();
            let magnitude = magnitude(&piece, order, t);
            assert!(value <= magnitude * (1.0 + 1e-15), "{order} {t}: {value} {magnitude}");
            assert!(magnitude < 1e3 * (1.0 + value), "{order} {t}: {value} {magnitude}");
        }
    }
}
