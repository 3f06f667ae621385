//! Test problems with known solutions, shared by tests, benches and examples.

mod balances;
mod chains;
mod contact;
mod driven;
mod jacobi;
mod lattice;
mod nonlinear;
mod oscillators;

pub(crate) use balances::{maxwell_relaxation, maxwell_under_steps};
pub(crate) use chains::{diagonal_chain, short_chain, stiff_pair, vibrating_chain};
pub(crate) use contact::hertz_contact;
pub(crate) use driven::{driven_by_sine, driven_by_table, struck_by_pulse};
pub(crate) use lattice::solitary_wave;
pub(crate) use nonlinear::{
    cubic_spring, pulled_spring, quadratic_dashpot, root_dashpot, springs_in_series,
};
pub(crate) use oscillators::{critically_damped, free_motion, overdamped, underdamped};

use std::fmt;

use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::{Input, LinearForm, Outputs, Piece, System, Unknown, UnknownKind, Waveform};

/// A system with its solution.
pub(crate) struct Problem {
    /// Short name in words.
    pub(crate) name: &'static str,
    /// What is hard about it.
    pub(crate) difficulty: &'static str,
    /// The system; its outputs are its unknowns, under the same names.
    pub(crate) system: System,
    /// A time span over which it is interesting \[s\].
    pub(crate) t_end: f64,
    /// Whether an explicit method can follow it in a reasonable number of steps.
    pub(crate) stiff: bool,
    solution: Box<dyn Fn(f64) -> Vec<f64> + Send + Sync>,
}

impl Problem {
    /// The exact values of all unknowns at `t` \[s\], dimensionless, from the right at a jump.
    pub(crate) fn exact(&self, t: f64) -> Vec<f64> {
        (self.solution)(t / self.system.time_scale)
    }
}

impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Problem")
            .field("name", &self.name)
            .field("difficulty", &self.difficulty)
            .finish_non_exhaustive()
    }
}

/// All problems on which every method that applies shows its order.
pub(crate) fn all() -> Vec<Problem> {
    vec![
        free_motion(),
        underdamped(),
        critically_damped(),
        overdamped(),
        maxwell_relaxation(),
        maxwell_under_steps(),
        driven_by_sine(),
        driven_by_table(),
        struck_by_pulse(),
        stiff_pair(),
        diagonal_chain(),
        vibrating_chain(),
        cubic_spring(),
        quadratic_dashpot(),
        root_dashpot(),
        springs_in_series(),
        hertz_contact(),
        solitary_wave(),
    ]
}

/// Seconds in one unit of dimensionless time of all problems, so that no test passes by leaving the
/// scale out.
const TIME_SCALE: f64 = 0.01;

/// SI value of the dimensionless value 1 of all unknowns.
const SCALE: f64 = 0.5;

/// What a problem's system is built from.
struct Parts<'p> {
    /// Names and kinds of the unknowns.
    unknowns: Vec<(String, UnknownKind)>,
    jacobian: &'p [(usize, usize, f64)],
    /// Entries of `B`, and the function behind each column.
    input_matrix: &'p [(usize, usize, f64)],
    waveforms: Vec<Waveform>,
    initial: Vec<f64>,
}

impl Parts<'_> {
    fn build(self) -> System {
        let size = self.unknowns.len();
        let matrix = |columns, entries: &[(usize, usize, f64)]| {
            let mut matrix = CooMatrix::new(size, columns);
            for &(row, column, value) in entries {
                matrix.push(row, column, value);
            }
            CsrMatrix::from(&matrix)
        };
        let unknown = |(name, kind)| Unknown { name, kind, scale: SCALE, unit: "m" };
        let unknowns: Vec<Unknown> = self.unknowns.into_iter().map(unknown).collect();
        let mut outputs = Outputs::new();
        for (at, Unknown { name, unit, scale, .. }) in unknowns.iter().enumerate() {
            outputs.push(name, unit, *scale, &LinearForm::term(at, 1.0), &LinearForm::zero());
        }
        let input = |waveform| Input { waveform, derivative: 0 };
        System {
            outputs,
            unknowns,
            jacobian: matrix(size, self.jacobian),
            input_matrix: matrix(self.waveforms.len(), self.input_matrix),
            inputs: (0..self.waveforms.len()).map(input).collect(),
            waveforms: self.waveforms,
            terms: Vec::new(),
            initial: self.initial,
            time_scale: TIME_SCALE,
        }
    }
}

/// Differential unknowns of these names.
fn differential(names: &[&str]) -> Vec<(String, UnknownKind)> {
    names.iter().map(|name| ((*name).to_owned(), UnknownKind::Differential)).collect()
}

/// The waveform of these pieces, which are in order.
fn waveform(pieces: Vec<Piece>) -> Waveform {
    Waveform::new(pieces).unwrap_or_else(|| Waveform::constant(0.0))
}
