//! Values of an interpolation polynomial between its nodes.

/// Highest degree of a step's polynomial.
pub(super) const HIGHEST: usize = 7;

/// The Lagrange polynomials on a few nodes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lagrange<'n> {
    nodes: &'n [f64],
    /// What distances are multiplied by, lest their products leave the range of numbers: a power of two.
    unit: f64,
    /// `1/Π_{i≠j} (x_j − x_i)`, with distances in that unit.
    factors: [f64; HIGHEST + 1],
}

impl<'n> Lagrange<'n> {
    /// The polynomials on these nodes: at least one, at most `HIGHEST + 1`, all different.
    pub(super) fn new(nodes: &'n [f64]) -> Self {
        let unit = unit(nodes);
        let mut factors = [1.0; HIGHEST + 1];
        for (j, at) in nodes.iter().enumerate() {
            for (i, before) in nodes[..j].iter().enumerate() {
                let distance = (at - before) * unit;
                factors[i] *= -distance;
                factors[j] *= distance;
            }
        }
        for factor in factors.iter_mut().take(nodes.len()) {
            *factor = factor.recip();
        }
        Self { nodes, unit, factors }
    }

    /// Their values at `x`, the weights of the values at the nodes; zero beyond the last node.
    pub(super) fn weights(&self, x: f64) -> [f64; HIGHEST + 1] {
        let mut weights = [0.0; HIGHEST + 1];
        let mut product = 1.0;
        for ((weight, node), factor) in weights.iter_mut().zip(self.nodes).zip(&self.factors) {
            *weight = factor * product;
            product *= (x - node) * self.unit;
        }
        product = 1.0;
        for (weight, node) in weights.iter_mut().zip(self.nodes).rev() {
            *weight *= product;
            product *= (x - node) * self.unit;
        }
        weights
    }
}

/// The reciprocal of the power of two below the distance of the last node from the first one.
fn unit(nodes: &[f64]) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let (Some(first), Some(last)) = (nodes.first(), nodes.last()) else { return 1.0 };
    let below = f64::from_bits((last - first).to_bits() & EXPONENT);
    if below > 0.0 && below.is_finite() { below.recip() } else { 1.0 }
}

/// Writes to each row of `out` the polynomial through `rows` at one of the times; `rows` holds one row for each node.
///
/// The same as [`Lagrange`] for a number of nodes that the compiler knows, as sampling is most of
/// what many outputs cost.
pub(super) fn sample<'o>(
    nodes: &[f64],
    rows: &[f64],
    size: usize,
    places: impl Iterator<Item = (f64, &'o mut [f64])>,
) {
    match nodes.len() {
        1 => sample_on::<1>(nodes, rows, size, places),
        2 => sample_on::<2>(nodes, rows, size, places),
        3 => sample_on::<3>(nodes, rows, size, places),
        4 => sample_on::<4>(nodes, rows, size, places),
        5 => sample_on::<5>(nodes, rows, size, places),
        6 => sample_on::<6>(nodes, rows, size, places),
        7 => sample_on::<7>(nodes, rows, size, places),
        _ => sample_on::<8>(nodes, rows, size, places),
    }
}

fn sample_on<'o, const N: usize>(
    nodes: &[f64],
    rows: &[f64],
    size: usize,
    places: impl Iterator<Item = (f64, &'o mut [f64])>,
) {
    let Ok(nodes) = <&[f64; N]>::try_from(nodes) else { return };
    let rows: [&[f64]; N] = std::array::from_fn(|at| &rows[at * size..(at + 1) * size]);
    let Lagrange { unit, factors, .. } = Lagrange::new(nodes);
    for (x, out) in places {
        let mut weights = [0.0; N];
        let (mut before, mut after) = (1.0, 1.0);
        for at in 0..N {
            weights[at] = factors[at] * before;
            before *= (x - nodes[at]) * unit;
        }
        for at in (0..N).rev() {
            weights[at] *= after;
            after *= (x - nodes[at]) * unit;
        }
        for (unknown, value) in out.iter_mut().enumerate() {
            let mut sum = 0.0;
            for at in 0..N {
                sum += weights[at] * rows[at][unknown];
            }
            *value = sum;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_of_any_distance_have_finite_weights() {
        for size in [1e-300, 1e-107, 1e200] {
            let nodes = [0.0, 0.1, 0.4, 0.5, 0.9, 1.0].map(|x| x * size);
            let weights = Lagrange::new(&nodes).weights(0.7 * size);
            let at_nodes = nodes.iter().zip(weights);
            let value: f64 = at_nodes.map(|(t, weight)| weight * (t / size).powi(5)).sum();
            assert!((value - 0.7_f64.powi(5)).abs() < 1e-13, "{size}: {value}");
        }
    }

    #[test]
    fn a_polynomial_is_reproduced_between_its_nodes() {
        let nodes = [-1.0, -0.8, -0.1, 0.3, 0.31, 0.9, 1.0];
        for degree in 0..nodes.len() {
            let lagrange = Lagrange::new(&nodes[..=degree]);
            let power = i32::try_from(degree).unwrap();
            for x in [-1.0, -0.83, 0.0, 0.4, 1.0] {
                let weights = lagrange.weights(x);
                let at_nodes = nodes[..=degree].iter().zip(weights);
                let value: f64 = at_nodes.map(|(t, weight)| weight * (t + 0.3).powi(power)).sum();
                let noise: f64 = weights.iter().map(|weight| weight.abs()).sum();
                assert!((value - (x + 0.3).powi(power)).abs() < 1e-14 * noise, "degree {degree}");
            }
        }
    }
}
