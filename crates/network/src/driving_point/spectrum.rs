//! The poles of a circuit with masses.

use dashpot_numerics::DoubleDouble;

use super::{
    DrivingPointError,
    circuit::Circuit,
    complex::Complex,
    hessenberg::eigenvalues,
    links::{Links, dot},
};

/// How much farther than what is left out the nearest pole must be, to be told from it.
const CLEAR: f64 = 1e3;

/// All poles besides those at zero, in units of the circuit's time.
///
/// The states are the forces of the springs (`K = F Fᵀ`) and the momenta of the masses (`M = G Gᵀ`), both weighted to
/// energies. With `A = M + C + K = L Lᵀ` at the rate 1 the resolvent there is
///
/// ```text
///   T = ⎡ 1 − UᵀU   UᵀV ⎤      U = L⁻¹F,  V = L⁻¹G,
///       ⎣  −VᵀU     VᵀV ⎦
/// ```
///
/// a matrix whose entries are below 1. Its eigenvalues are `1/(1 − λ)`; 0 for each part that
/// follows its springs without delay and 1 for each that moves freely, neither of them defective.
/// The graph says how many these are, so no threshold decides on them.
/// Errors: [`DrivingPointError::NoConvergence`] where a pole cannot be told from those left out.
pub(super) fn poles(circuit: &Circuit) -> Result<Vec<Complex>, DrivingPointError> {
    let zero = DoubleDouble::ZERO;
    let factor = circuit.stiffness_at_one().factor();
    let mut columns = Links::of(circuit.bodies, &circuit.springs).factor().columns();
    let springs = columns.len();
    for (body, mass) in circuit.masses.iter().enumerate().filter(|(_, mass)| **mass > 0.0) {
        let mut column = vec![zero; circuit.bodies];
        column[body] = mass.sqrt();
        columns.push(column);
    }
    columns.iter_mut().for_each(|column| factor.solve_lower(column));
    let matrix = (0..columns.len()).map(|i| {
        let entry = |j: usize| {
            let product = dot(&columns[i], &columns[j]);
            match (i < springs, j < springs) {
                (true, true) if i == j => DoubleDouble::ONE - product,
                (_, true) => -product,
                (_, false) => product,
            }
        };
        (0..columns.len()).map(entry).collect()
    });
    let mut found = eigenvalues(matrix.collect())?;
    leave_out(&mut found, circuit.algebraic_parts(), Complex::size)?;
    leave_out(&mut found, circuit.free_parts(), |value| (value - Complex::one()).size())?;
    Ok(found.into_iter().map(|value| (value - Complex::one()).over(value)).collect())
}

/// Leaves out the `count` nearest values by some distance.
fn leave_out(
    values: &mut Vec<Complex>,
    count: usize,
    distance: impl Fn(Complex) -> f64,
) -> Result<(), DrivingPointError> {
    values.sort_by(|a, b| distance(*a).total_cmp(&distance(*b)));
    if values.len() < count {
        return Err(DrivingPointError::NoConvergence);
    }
    let noise = count.checked_sub(1).map_or(1e-31, |last| distance(values[last]).max(1e-31));
    if values.get(count).is_some_and(|nearest| distance(*nearest) < CLEAR * noise) {
        return Err(DrivingPointError::NoConvergence);
    }
    values.drain(..count);
    Ok(())
}
