//! The equations of the network at one frequency.

use dashpot_dae::{Piece, System, UnknownKind, Waveform};
use dashpot_network::{Model, Network, Node};
use nalgebra::{Complex, DMatrix, DVector};

use super::{Obstacle, shaking::shake};

/// Rounds of iterative refinement.
const REFINEMENTS: usize = 2;

/// The network of a model whose head moves to and fro, compiled, at any frequency.
#[derive(Debug)]
pub(super) struct Shaker {
    system: System,
    force: usize,
    /// The dimensionless value of an amplitude of 1 m.
    amplitude: f64,
}

impl Shaker {
    /// The network of `model`, or why there is none; `time` \[s\] is what its times are like.
    pub(super) fn new(model: &Model, time: f64) -> Result<Self, Obstacle> {
        let wave = Piece { sine: 1.0, omega: 1.0 / time, ..Piece::default() };
        let motion = Waveform::new(vec![wave]).ok_or(Obstacle::OutOfRange)?;
        let mut network = Network::new();
        let head = network.add_node(Node::prescribed("head", motion));
        network.connect("model", head, network.ground(), model.clone());
        let assembly = network.compile(time)?;
        let force = assembly.connections.first().and_then(|connection| connection.force);
        let force = force.ok_or(Obstacle::Undetermined)?;
        let amplitude =
            assembly.system.waveforms.first().map_or(0.0, |waveform| waveform.pieces()[0].sine);
        Ok(Self { system: assembly.system, force, amplitude })
    }

    /// The same network with each coefficient of its equations moved by a rounding.
    pub(super) fn shaken(mut self, seed: u64) -> Self {
        shake(&mut self.system, seed);
        self
    }

    /// The force over the deformation \[N/m\] in steady oscillation with the angular frequency
    /// `omega` \[rad/s\]: `(iω M − J) y = B w` is solved as it stands.
    ///
    /// `None` where the equations have no finite solution.
    pub(super) fn stiffness(&self, omega: f64) -> Option<Complex<f64>> {
        let system = &self.system;
        let s = Complex::new(0.0, omega * system.time_scale);
        let inputs: Vec<Complex<f64>> =
            system.inputs.iter().map(|input| s.powu(input.derivative) * self.amplitude).collect();
        let count = system.len();
        let mut matrix = DMatrix::<Complex<f64>>::zeros(count, count);
        for (row, column, value) in system.jacobian.triplet_iter() {
            matrix[(row, column)] -= Complex::from(*value);
        }
        for (at, unknown) in system.unknowns.iter().enumerate() {
            if unknown.kind == UnknownKind::Differential {
                matrix[(at, at)] += s;
            }
        }
        let mut right = DVector::<Complex<f64>>::zeros(count);
        for (row, column, value) in system.input_matrix.triplet_iter() {
            right[row] += inputs[column] * *value;
        }
        let state = solve(matrix, right)?;
        let output = system.outputs.at(self.force);
        let own = output.unknowns.terms().map(|(at, weight)| state[at] * weight);
        let given = output.inputs.terms().map(|(at, weight)| inputs[at] * weight);
        let force = own.chain(given).sum::<Complex<f64>>() * output.scale;
        (force.re.is_finite() && force.im.is_finite()).then_some(force)
    }
}

/// The solution of `matrix · y = right`, refined; `None` where the matrix is singular.
fn solve(
    mut matrix: DMatrix<Complex<f64>>,
    mut right: DVector<Complex<f64>>,
) -> Option<DVector<Complex<f64>>> {
    if matrix.is_empty() {
        return Some(right);
    }
    level(&mut matrix, &mut right);
    let factors = matrix.clone().lu();
    let mut state = factors.solve(&right)?;
    for _ in 0..REFINEMENTS {
        state += factors.solve(&(&right - &matrix * &state))?;
    }
    Some(state)
}

/// Brings the largest entry of each row to about one.
fn level(matrix: &mut DMatrix<Complex<f64>>, right: &mut DVector<Complex<f64>>) {
    for row in 0..matrix.nrows() {
        let largest = matrix.row(row).iter().map(|entry| entry.norm()).fold(0.0, f64::max);
        if largest > 0.0 {
            matrix.row_mut(row).iter_mut().for_each(|entry| *entry /= largest);
            right[row] /= largest;
        }
    }
}
