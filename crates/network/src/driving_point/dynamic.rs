//! The dynamic stiffness `P(s) = s²M + sC + K` of a circuit at a complex rate.

use dashpot_numerics::DoubleDouble;

use super::{
    circuit::{Circuit, Ends, Link},
    complex::Complex,
    links::pair,
};

/// `P(s)` as triangular factors with exchanged rows.
pub(super) struct DynamicStiffness {
    rows: Vec<Vec<Complex>>,
    order: Vec<usize>,
}

impl Circuit {
    /// Factors `P(s)`. A pivot that vanishes becomes one as small as the rounding, which is what
    /// inverse iteration at a pole needs.
    pub(super) fn stiffness_at(&self, s: Complex) -> DynamicStiffness {
        let count = self.bodies;
        let mut rows = vec![vec![Complex::zero(); count]; count];
        let mut add = |ends: Ends, value: Complex| {
            for end in ends.into_iter().flatten() {
                rows[end][end] = rows[end][end] + value;
            }
            if let [Some(p), Some(q)] = ends {
                rows[p][q] = rows[p][q] - value;
                rows[q][p] = rows[q][p] - value;
            }
        };
        for link in &self.springs {
            add(link.ends, Complex::new(link.constant, 0.0));
        }
        for link in &self.dashpots {
            add(link.ends, s.times(link.constant));
        }
        for (body, &mass) in self.masses.iter().enumerate() {
            add([Some(body), None], (s * s).times(mass));
        }
        let mut order: Vec<usize> = (0..count).collect();
        for at in 0..count {
            let best =
                (at..count).max_by(|&p, &q| rows[p][at].size().total_cmp(&rows[q][at].size()));
            let best = best.unwrap_or(at);
            rows.swap(at, best);
            order.swap(at, best);
            if rows[at][at].size() < f64::MIN_POSITIVE {
                rows[at][at] = Complex::new(1e-32, 0.0);
            }
            let (above, below) = rows.split_at_mut(at + 1);
            let pivot = &above[at];
            for row in below.iter_mut().filter(|row| row[at].size() > 0.0) {
                let factor = row[at].over(pivot[at]);
                row[at] = factor;
                for j in at + 1..count {
                    row[j] = row[j] - factor * pivot[j];
                }
            }
        }
        DynamicStiffness { rows, order }
    }

    /// The receptance at a rate that is no pole.
    pub(super) fn receptance(&self, s: Complex) -> Complex {
        let zero = DoubleDouble::ZERO;
        let forces = pair(self.bodies, self.forces);
        let forces: Vec<Complex> = forces.into_iter().map(|re| Complex { re, im: zero }).collect();
        stretch(self.forces, &self.stiffness_at(s).solve(&forces))
    }
}

impl DynamicStiffness {
    pub(super) fn solve(&self, forces: &[Complex]) -> Vec<Complex> {
        let count = self.rows.len();
        let mut x: Vec<Complex> = self.order.iter().map(|&row| forces[row]).collect();
        for i in 0..count {
            x[i] = (0..i).fold(x[i], |rest, j| rest - self.rows[i][j] * x[j]);
        }
        for i in (0..count).rev() {
            let rest = (i + 1..count).fold(x[i], |rest, j| rest - self.rows[i][j] * x[j]);
            x[i] = rest.over(self.rows[i][i]);
        }
        x
    }
}

/// Difference of the displacements of two ends.
pub(super) fn stretch(ends: Ends, shape: &[Complex]) -> Complex {
    let [p, q] = ends.map(|end| end.map_or_else(Complex::zero, |body| shape[body]));
    p - q
}

/// A sum over elements, and the sum of the absolute values of its terms.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sum {
    pub(super) value: Complex,
    pub(super) size: f64,
}

/// `xᵀP x` with sizes in place of signs, and `xᵀP′x`, for a shape `x` at the rate `s`.
pub(super) fn forms(circuit: &Circuit, s: Complex, shape: &[Complex]) -> (Sum, Complex) {
    let mut form = Sum { value: Complex::zero(), size: 0.0 };
    let mut slope = Complex::zero();
    let mut add = |constant: DoubleDouble, square: Complex, power: Complex, derivative: Complex| {
        let term = (square * power).times(constant);
        form = Sum { value: form.value + term, size: form.size + term.size() };
        slope = slope + (square * derivative).times(constant);
    };
    let square = |link: &Link| {
        let stretch = stretch(link.ends, shape);
        stretch * stretch
    };
    for link in &circuit.springs {
        add(link.constant, square(link), Complex::one(), Complex::zero());
    }
    for link in &circuit.dashpots {
        add(link.constant, square(link), s, Complex::one());
    }
    for (x, &mass) in shape.iter().zip(&circuit.masses) {
        add(mass, *x * *x, s * s, s + s);
    }
    (form, slope)
}
