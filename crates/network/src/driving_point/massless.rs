//! The terms of circuits without masses: all poles are real, all residues positive.

use dashpot_numerics::DoubleDouble;

use super::{
    DrivingPointError,
    circuit::Circuit,
    complex::Complex,
    jacobi::orthogonalise,
    links::{Links, dot},
    terms::Term,
};

/// Rates closer than this, relative, are one rate: only one combination of its modes is seen.
const SAME_RATE: f64 = 1e-13;

/// All terms besides that at zero, those that cannot be seen too.
///
/// With `A = K + C = L Lᵀ` at the rate 1 and `K = F Fᵀ`, the singular values `w` of `L⁻¹F` give the
/// rates `w²/(1 − w²)`; their left vectors `u` give the shapes `x = L⁻ᵀu`. Rate and residue are
/// then quotients of sums of positive terms, over the springs and over the dashpots. Those with
/// `w = 1` follow the springs at once, and the graph says how many they are.
pub(super) fn terms(circuit: &Circuit) -> Result<Vec<Term>, DrivingPointError> {
    let factor = circuit.stiffness_at_one().factor();
    let mut columns = Links::of(circuit.bodies, &circuit.springs).factor().columns();
    columns.iter_mut().for_each(|column| factor.solve_lower(column));
    orthogonalise(&mut columns)?;
    let mut pairs: Vec<(DoubleDouble, Vec<DoubleDouble>)> =
        columns.into_iter().map(|column| (dot(&column, &column), column)).collect();
    pairs.sort_by(|(a, _), (b, _)| a.high().total_cmp(&b.high()));
    pairs.truncate(pairs.len().saturating_sub(circuit.algebraic_parts()));
    let mut modes = Vec::with_capacity(pairs.len());
    for (square, mut shape) in pairs {
        let norm = square.sqrt();
        shape.iter_mut().for_each(|value| *value = *value / norm);
        factor.solve_upper(&mut shape);
        let lost = Circuit::energy(&circuit.dashpots, &shape);
        let seen = Circuit::stretch(circuit.forces, &shape);
        let (rate, residue) =
            (Circuit::energy(&circuit.springs, &shape) / lost, seen * seen / lost);
        if !(rate > 0.0 && rate.high().is_finite() && residue.high().is_finite()) {
            return Err(DrivingPointError::NoConvergence);
        }
        modes.push((rate, residue));
    }
    modes.sort_by(|(a, _), (b, _)| a.high().total_cmp(&b.high()));
    let of_one_rate = modes.chunk_by(|a, b| (b.0 - a.0).high() <= SAME_RATE * b.0.high());
    Ok(of_one_rate.map(together).collect())
}

/// One term for the modes of one rate.
fn together(modes: &[(DoubleDouble, DoubleDouble)]) -> Term {
    let residue = modes.iter().fold(DoubleDouble::ZERO, |sum, mode| sum + mode.1);
    let first = modes[0].0;
    let later = |rest, mode: &(DoubleDouble, DoubleDouble)| rest + (mode.0 - first) * mode.1;
    let weighted = modes.iter().fold(DoubleDouble::ZERO, later);
    let rate = if residue > 0.0 { first + weighted / residue } else { first };
    let term = Term::simple(Complex::new(-rate, 0.0), Complex::new(residue, 0.0));
    Term { count: modes.len(), ..term }
}
