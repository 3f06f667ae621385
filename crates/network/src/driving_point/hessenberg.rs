//! Eigenvalues of a real matrix in twice the digits of a double.

use dashpot_numerics::DoubleDouble;

use super::{DrivingPointError, complex::Complex, links::dot};

type Matrix = Vec<Vec<DoubleDouble>>;

/// Relative size below which an entry beside the diagonal is rounding.
const NEGLIGIBLE: f64 = 2e-32;
const MOST_STEPS: usize = 120;

/// All eigenvalues: reflections to Hessenberg form, then double-shift QR steps (Francis).
///
/// The errors are those of a change of the matrix by some 10⁻³¹ of its norm.
/// Errors: [`DrivingPointError::NoConvergence`] if the steps do not come to an end.
pub(super) fn eigenvalues(mut matrix: Matrix) -> Result<Vec<Complex>, DrivingPointError> {
    reduce(&mut matrix);
    let norm = matrix.iter().flatten().map(|entry| entry.high().abs()).sum();
    let mut found = Vec::with_capacity(matrix.len());
    let mut shifted = DoubleDouble::ZERO;
    let mut end = matrix.len();
    let mut steps = 0;
    while end > 0 {
        let last = end - 1;
        let first = split(&mut matrix, last, norm);
        if first == last {
            found.push(Complex::new(matrix[last][last] + shifted, 0.0));
            end -= 1;
            steps = 0;
        } else if first + 1 == last {
            found.extend(pair_of(&matrix, last, shifted));
            end -= 2;
            steps = 0;
        } else {
            if steps == MOST_STEPS {
                return Err(DrivingPointError::NoConvergence);
            }
            let shift = if steps % 10 == 9 {
                exceptional(&mut matrix, last, &mut shifted)
            } else {
                let (x, y) = (matrix[last][last], matrix[last - 1][last - 1]);
                [x, y, matrix[last][last - 1] * matrix[last - 1][last]]
            };
            steps += 1;
            step(&mut matrix, first, last, shift);
        }
    }
    Ok(found)
}

/// Reflects to Hessenberg form.
fn reduce(matrix: &mut Matrix) {
    let count = matrix.len();
    for at in 0..count.saturating_sub(2) {
        let mut mirror: Vec<DoubleDouble> = (at + 1..count).map(|i| matrix[i][at]).collect();
        let largest = mirror.iter().map(|x| x.high().abs()).fold(0.0, f64::max);
        if largest < 1e-140 {
            continue;
        }
        let length = dot(&mirror, &mirror).sqrt();
        let length = if mirror[0] < 0.0 { -length } else { length };
        mirror[0] += length;
        let square = dot(&mirror, &mirror);
        for j in at..count {
            let column: Vec<DoubleDouble> = (at + 1..count).map(|i| matrix[i][j]).collect();
            let share = dot(&mirror, &column) * 2.0 / square;
            for (i, m) in mirror.iter().enumerate() {
                matrix[at + 1 + i][j] -= share * *m;
            }
        }
        for row in matrix.iter_mut() {
            let share = dot(&mirror, &row[at + 1..]) * 2.0 / square;
            for (entry, m) in row[at + 1..].iter_mut().zip(&mirror) {
                *entry -= share * *m;
            }
        }
        for row in matrix.iter_mut().skip(at + 2) {
            row[at] = DoubleDouble::ZERO;
        }
    }
}

/// First row of the block that ends at `last` and does not fall apart.
fn split(matrix: &mut Matrix, last: usize, norm: f64) -> usize {
    for at in (1..=last).rev() {
        let around = matrix[at - 1][at - 1].high().abs() + matrix[at][at].high().abs();
        let around = if around > 0.0 { around } else { norm };
        if matrix[at][at - 1].high().abs() <= NEGLIGIBLE * around {
            matrix[at][at - 1] = DoubleDouble::ZERO;
            return at;
        }
    }
    0
}

/// The eigenvalues of the block of two that ends at `last`.
fn pair_of(matrix: &Matrix, last: usize, shifted: DoubleDouble) -> [Complex; 2] {
    let (x, y) = (matrix[last][last], matrix[last - 1][last - 1]);
    let product = matrix[last][last - 1] * matrix[last - 1][last];
    let half = (y - x) * 0.5;
    let square = half * half + product;
    let root = square.abs().sqrt();
    if square >= 0.0 {
        let far = half + if half < 0.0 { -root } else { root };
        let near = if far.high().abs() > 0.0 { product / far } else { far };
        [Complex::new(x + shifted + far, 0.0), Complex::new(x + shifted - near, 0.0)]
    } else {
        [Complex::new(x + shifted + half, root), Complex::new(x + shifted + half, -root)]
    }
}

/// A shift that breaks a cycle of steps.
fn exceptional(matrix: &mut Matrix, last: usize, shifted: &mut DoubleDouble) -> [DoubleDouble; 3] {
    let x = matrix[last][last];
    *shifted += x;
    for i in 0..=last {
        matrix[i][i] -= x;
    }
    let size = matrix[last][last - 1].abs() + matrix[last - 1][last - 2].abs();
    [size * 0.75, size * 0.75, size * size * -0.4375]
}

/// One double step on the rows and columns `first..=last`.
fn step(matrix: &mut Matrix, first: usize, last: usize, [x, y, w]: [DoubleDouble; 3]) {
    let mut start = last - 2;
    let mut mirror;
    loop {
        let z = matrix[start][start];
        let (r, s) = (x - z, y - z);
        mirror = [
            (r * s - w) / matrix[start + 1][start] + matrix[start][start + 1],
            matrix[start + 1][start + 1] - z - r - s,
            matrix[start + 2][start + 1],
        ];
        let size = mirror[0].abs() + mirror[1].abs() + mirror[2].abs();
        mirror = mirror.map(|entry| entry / size);
        if start == first {
            break;
        }
        let beside = matrix[start][start - 1].high().abs()
            * (mirror[1].high().abs() + mirror[2].high().abs());
        let around = matrix[start - 1][start - 1].high().abs()
            + z.high().abs()
            + matrix[start + 1][start + 1].high().abs();
        if beside <= NEGLIGIBLE * mirror[0].high().abs() * around {
            break;
        }
        start -= 1;
    }
    let zero = DoubleDouble::ZERO;
    for i in start + 2..=last {
        matrix[i][i - 2] = zero;
        if i > start + 2 {
            matrix[i][i - 3] = zero;
        }
    }
    for at in start..last {
        let mut scale = DoubleDouble::ONE;
        let is_short = at == last - 1;
        if at > start {
            let third = if is_short { zero } else { matrix[at + 2][at - 1] };
            mirror = [matrix[at][at - 1], matrix[at + 1][at - 1], third];
            scale = mirror[0].abs() + mirror[1].abs() + mirror[2].abs();
            if scale <= 0.0 {
                continue;
            }
            mirror = mirror.map(|entry| entry / scale);
        }
        let length = dot(&mirror, &mirror).sqrt();
        let length = if mirror[0] < 0.0 { -length } else { length };
        if at > start {
            matrix[at][at - 1] = -(length * scale);
        } else if first < start {
            matrix[at][at - 1] = -matrix[at][at - 1];
        }
        reflect(matrix, first, last, at, mirror, length);
    }
}

/// Applies one reflection of three rows and columns (two at the end of the block).
fn reflect(
    matrix: &mut Matrix,
    first: usize,
    last: usize,
    at: usize,
    [p, q, r]: [DoubleDouble; 3],
    length: DoubleDouble,
) {
    let is_short = at == last - 1;
    let p = p + length;
    let (x, y, z) = (p / length, q / length, r / length);
    let (q, r) = (q / p, r / p);
    for j in at..=last {
        let mut sum = matrix[at][j] + q * matrix[at + 1][j];
        if !is_short {
            sum += r * matrix[at + 2][j];
            matrix[at + 2][j] -= sum * z;
        }
        matrix[at + 1][j] -= sum * y;
        matrix[at][j] -= sum * x;
    }
    for row in &mut matrix[first..=last.min(at + 3)] {
        let mut sum = x * row[at] + y * row[at + 1];
        if !is_short {
            sum += z * row[at + 2];
            row[at + 2] -= sum * r;
        }
        row[at + 1] -= sum * q;
        row[at] -= sum;
    }
}
