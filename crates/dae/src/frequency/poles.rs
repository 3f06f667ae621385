//! The poles of a system.

use nalgebra::{Complex, DMatrix, Schur};

use crate::{System, UnknownKind};

/// More unknowns are too many for the poles to be looked for.
pub const MOST_UNKNOWNS: usize = 400;
/// Thresholds of the iteration that are tried in turn.
const THRESHOLDS: [f64; 3] = [1.0, 16.0, 256.0];

/// The poles \[rad/s\] of a linear system: it swings freely with `e^{pt}` for each of them. They are
/// in no order, and good to about a rounding of the largest one.
///
/// `None` where the system is not linear, has more than [`MOST_UNKNOWNS`] unknowns, or its poles
/// could not be found.
pub fn poles(system: &System) -> Option<Vec<Complex<f64>>> {
    if !system.is_linear() || system.len() > MOST_UNKNOWNS {
        return None;
    }
    let matrix = reduced(system)?;
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    let size = matrix.nrows();
    let found = THRESHOLDS.iter().find_map(|&threshold| {
        Schur::try_new(matrix.clone(), threshold * f64::EPSILON, 100 + 60 * size)
    })?;
    let poles: Vec<Complex<f64>> = found
        .complex_eigenvalues()
        .iter()
        .map(|complex_eigenvalue| complex_eigenvalue / system.time_scale)
        .collect();
    poles.iter().all(|pole| pole.re.is_finite() && pole.im.is_finite()).then_some(poles)
}

/// The matrix of the differential unknowns alone.
fn reduced(system: &System) -> Option<DMatrix<f64>> {
    let (mut own, mut others) = (Vec::new(), Vec::new());
    for (at, unknown) in system.unknowns.iter().enumerate() {
        match unknown.kind {
            UnknownKind::Differential => own.push(at),
            UnknownKind::Algebraic => others.push(at),
        }
    }
    let full = DMatrix::from(&system.jacobian);
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| full[(rows[i], columns[j])])
    };
    let matrix = part(&own, &own);
    if others.is_empty() {
        return Some(matrix);
    }
    let followed = part(&others, &others).lu().solve(&part(&others, &own))?;
    Some(matrix - part(&own, &others) * followed)
}
