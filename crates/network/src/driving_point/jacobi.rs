//! Orthogonal columns by rotations.

use dashpot_numerics::DoubleDouble;

use super::{DrivingPointError, links::dot};

/// Columns whose cosine is below this count as orthogonal.
const ORTHOGONAL: f64 = 1e-30;
const MOST_SWEEPS: usize = 80;

/// Rotates the columns among each other until they are orthogonal (one-sided Jacobi): their norms
/// are then the singular values, each to its own relative accuracy where the columns are graded.
/// Errors: [`DrivingPointError::NoConvergence`] if it doesn't come to an end.
pub(super) fn orthogonalise(columns: &mut [Vec<DoubleDouble>]) -> Result<(), DrivingPointError> {
    let mut squares: Vec<DoubleDouble> = columns.iter().map(|column| dot(column, column)).collect();
    for _ in 0..MOST_SWEEPS {
        let mut is_done = true;
        for p in 0..columns.len() {
            for q in p + 1..columns.len() {
                let product = dot(&columns[p], &columns[q]);
                let size = squares[p].high().sqrt() * squares[q].high().sqrt();
                if product.high().abs() <= ORTHOGONAL * size {
                    continue;
                }
                is_done = false;
                let (first, second) = columns.split_at_mut(q);
                rotate(&mut first[p], &mut second[0], squares[q] - squares[p], product);
                squares[p] = dot(&columns[p], &columns[p]);
                squares[q] = dot(&columns[q], &columns[q]);
            }
        }
        if is_done {
            return Ok(());
        }
    }
    Err(DrivingPointError::NoConvergence)
}

/// Makes two columns orthogonal; `gap` is the difference of their squares.
fn rotate(
    p: &mut [DoubleDouble],
    q: &mut [DoubleDouble],
    gap: DoubleDouble,
    product: DoubleDouble,
) {
    let one = DoubleDouble::ONE;
    let cotangent = gap / (product * 2.0);
    let size = cotangent.abs();
    let tangent = if size.high() > 1e40 {
        one / (cotangent * 2.0)
    } else {
        let tangent = one / (size + (one + cotangent * cotangent).sqrt());
        if cotangent < 0.0 { -tangent } else { tangent }
    };
    let cosine = one / (one + tangent * tangent).sqrt();
    let sine = cosine * tangent;
    for (x, y) in p.iter_mut().zip(q) {
        let (old_x, old_y) = (*x, *y);
        *x = cosine * old_x - sine * old_y;
        *y = sine * old_x + cosine * old_y;
    }
}
