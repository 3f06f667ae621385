//! From the rows of steps to the Chebyshev coefficients of their polynomials.

use dashpot_numerics::chebyshev::{Coefficients, Interpolation};

use super::{
    between,
    lagrange::{HIGHEST, Lagrange},
};

/// The matrices that make coefficients of the values of any output in the rows of steps, one after the other.
#[derive(Debug, Default)]
pub(super) struct Conversions {
    /// Of each step `weights[j][k]`: `c_k = Σ_j weights[j][k] v_j`; of none whose rows are where the
    /// [interpolation](Interpolation) has its nodes.
    weights: Vec<f64>,
    /// Whether a step's are among them.
    are_own: Vec<bool>,
}

impl Conversions {
    /// Adds the conversion of values at `nodes`, at most `HIGHEST + 1` times, between `start` and `end`.
    pub(super) fn push(&mut self, nodes: &[f64], (start, end): (f64, f64)) {
        let count = nodes.len();
        let interpolation = Interpolation::of_degree(count - 1);
        let places = interpolation.nodes().iter().map(|&node| between(start, end, node));
        let is_own = !places.eq(nodes.iter().copied());
        self.are_own.push(is_own);
        if !is_own {
            return;
        }
        let lagrange = Lagrange::new(nodes);
        let first = self.weights.len();
        self.weights.resize(first + count * count, 0.0);
        let own = &mut self.weights[first..];
        for (&node, to_coefficients) in interpolation.nodes().iter().zip(interpolation.rows()) {
            let of_rows = lagrange.weights(between(start, end, node));
            for (weights, share) in own.chunks_exact_mut(count).zip(&of_rows) {
                for (weight, factor) in weights.iter_mut().zip(to_coefficients) {
                    *weight += share * factor;
                }
            }
        }
    }

    /// The matrices in order, for one to be taken at each step.
    pub(super) fn reader(&self) -> Reader<'_> {
        Reader { left: &self.weights, are_own: self.are_own.iter() }
    }
}

/// The matrices of the steps that are still to come.
#[derive(Debug, Clone)]
pub(super) struct Reader<'c> {
    left: &'c [f64],
    are_own: std::slice::Iter<'c, bool>,
}

impl Reader<'_> {
    /// The coefficients of the next step's polynomial, which has these values in its rows.
    pub(super) fn coefficients(&mut self, values: &[f64]) -> Coefficients {
        let count = values.len();
        // A constant is the same in all rows: what is converted are distances from it, which steps that
        // are short beside their rows' distances leave free of its rounding.
        let constant = values[count - 1];
        let mut sums = [0.0; HIGHEST + 1];
        let mut add = |(value, weights): (&f64, &[f64])| {
            let distance = value - constant;
            sums.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * distance);
        };
        if self.are_own.next() == Some(&true) {
            let (own, left) = self.left.split_at(count * count);
            self.left = left;
            values.iter().zip(own.chunks_exact(count)).for_each(&mut add);
        } else {
            values.iter().zip(Interpolation::of_degree(count - 1).rows()).for_each(&mut add);
        }
        sums[0] += constant;
        sums[..count].into()
    }
}

#[cfg(test)]
mod tests {
    use dashpot_numerics::chebyshev::evaluate;

    use super::*;

    #[test]
    fn polynomial_through_rows_before_a_step_is_found_in_it() {
        let cubic = |t: f64| 2.0 - t + 3.0 * t * t * t;
        let nodes = [-1.5, -0.7, 0.0, 0.4];
        let mut conversions = Conversions::default();
        conversions.push(&[0.0], (0.0, 0.1));
        conversions.push(&nodes, (0.0, 0.4));
        let mut reader = conversions.reader();
        assert_eq!(*reader.coefficients(&[7.0]), [7.0]);
        let found = reader.coefficients(&nodes.map(cubic));
        assert_eq!(found.len(), 4);
        for x in [-1.0, -0.3, 0.0, 0.8, 1.0] {
            let (value, exact) = (evaluate(&found, x), cubic(0.2 + 0.2 * x));
            assert!((value - exact).abs() < 1e-14, "{x}: {value}, not {exact}");
        }
    }

    #[test]
    fn short_steps_far_from_zero_know_their_slopes() {
        let line = |t: f64| 1e3 + t;
        let nodes = [0.0, 0.5, 0.5 + 1e-9];
        let mut conversions = Conversions::default();
        conversions.push(&nodes, (0.5, nodes[2]));
        let found = conversions.reader().coefficients(&nodes.map(line));
        let slope = 0.5 * (line(nodes[2]) - line(0.5));
        assert!((found[1] / slope - 1.0).abs() < 1e-6, "{} is not {slope}", found[1]);
    }
}
