//! Steady oscillation: the answer of a linear system to one waveform that is a sine.
//!
//! With `w(t) = Re(ŵ e^{iωt})` and all transients gone, `y(t) = Re(ŷ e^{iωt})`, and the complex
//! amplitudes follow from `(s M − J) ŷ = B ŵ` with `s = iω` in the system's own unit of time. An
//! input that is the n-th derivative of the waveform has the amplitude `sⁿ û`.
//!
//! Each frequency is solved by itself, with as few entries as the network has, and refined. The
//! error of each amplitude is that of equations whose coefficients are each off by a few roundings,
//! to first order: it takes one solution with the transposed matrix.

mod factors;

use dashpot_numerics::decompositions::eigenvalues;
use nalgebra::{Complex, DMatrix};

use self::factors::{Entries, Factors};
use crate::{System, UnknownKind};

/// Rounds of iterative refinement.
const REFINEMENTS: usize = 2;
/// So many roundings of each coefficient are allowed for in an error.
const ROUNDINGS: f64 = 4.0;

/// A system whose waveforms are sines in phase.
#[derive(Debug, Clone, Copy)]
pub struct FrequencyResponse<'s> {
    system: &'s System,
    units: &'s [f64],
}

impl<'s> FrequencyResponse<'s> {
    /// The response to all waveforms at once, with an amplitude for each in the system's own, dimensionless values; those
    /// beyond the end of `units` are zero. `None` for a system that is not linear: it does not answer with sines.
    pub fn new(system: &'s System, units: &'s [f64]) -> Option<Self> {
        system.is_linear().then_some(Self { system, units })
    }

    /// The steady oscillation with the angular frequency `omega` \[rad/s\], ≥ 0; 0 is rest under a constant drive.
    ///
    /// `None` where the equations have no finite solution: at an undamped resonance, and at rest
    /// where something drifts.
    pub fn at(&self, omega: f64) -> Option<Harmonic<'s>> {
        self.at_rate(Complex::new(0.0, omega))
    }

    /// The same for a drive that grows or decays as `e^{st}` with a complex `rate` s \[1/s\].
    ///
    /// `None` where the equations have no finite solution.
    pub fn at_rate(&self, rate: Complex<f64>) -> Option<Harmonic<'s>> {
        let system = self.system;
        let s = rate * system.time_scale;
        let (mut inputs, mut input_slopes) = (Vec::new(), Vec::new());
        for input in &system.inputs {
            let unit = self.units.get(input.waveform).copied().unwrap_or(0.0);
            inputs.push(s.powu(input.derivative) * unit);
            let order = input.derivative;
            let power = s.powu(order.saturating_sub(1));
            input_slopes.push(power * (f64::from(order) * unit));
        }
        let matrix = self.matrix(s);
        let (right, size) = forced(system, &inputs);
        let factors = Factors::of(matrix.clone())?;
        let state = refined(&matrix, &factors, &right);
        let (mut slope, _) = forced(system, &input_slopes);
        for (at, unknown) in system.unknowns.iter().enumerate() {
            if unknown.kind == UnknownKind::Differential {
                slope[at] -= state[at];
            }
        }
        let slope = refined(&matrix, &factors, &slope);
        let threshold = thresholds(&matrix, &state, &right, &size);
        let is_finite =
            |all: &[Complex<f64>]| all.iter().all(|z| z.re.is_finite() && z.im.is_finite());
        (is_finite(&state) && is_finite(&slope)).then_some(Harmonic {
            system,
            state,
            slope,
            inputs,
            input_slopes,
            factors,
            threshold,
        })
    }

    /// `s M − J`, row by row.
    fn matrix(&self, s: Complex<f64>) -> Entries {
        let system = self.system;
        let row = |(at, unknown): (usize, &crate::Unknown)| {
            let own = system.jacobian.row(at);
            let mut entries: Vec<(usize, Complex<f64>)> = own
                .col_indices()
                .iter()
                .zip(own.values())
                .map(|(&column, &value)| (column, Complex::from(-value)))
                .collect();
            if unknown.kind == UnknownKind::Differential {
                match entries.binary_search_by_key(&at, |entry| entry.0) {
                    Ok(found) => entries[found].1 += s,
                    Err(place) => entries.insert(place, (at, s)),
                }
            }
            entries
        };
        system.unknowns.iter().enumerate().map(row).collect()
    }
}

/// A complex amplitude in SI units: the quantity is `Re(value · e^{iωt})` where the waveform is
/// `Re(e^{iωt})`, so that a negative angle lags behind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitude {
    /// The amplitude, for one unit of the waveform.
    pub value: Complex<f64>,
    /// Its derivative over the angular frequency \[1/(rad/s)\].
    pub slope: Complex<f64>,
    /// How wrong the value may be, from rounding; of the same unit.
    pub error: f64,
}

/// A system in steady oscillation.
#[derive(Debug, Clone)]
pub struct Harmonic<'s> {
    system: &'s System,
    state: Vec<Complex<f64>>,
    /// Derivative of the state over `s`.
    slope: Vec<Complex<f64>>,
    inputs: Vec<Complex<f64>>,
    input_slopes: Vec<Complex<f64>>,
    factors: Factors,
    /// By how much each equation may be missed.
    threshold: Vec<f64>,
}

impl Harmonic<'_> {
    /// The amplitude of a sum of outputs, each with its factor.
    ///
    /// # Panics
    ///
    /// When the system does not have so many outputs.
    pub fn amplitude(&self, sum: &[(usize, f64)]) -> Amplitude {
        let mut adjoint = vec![Complex::<f64>::default(); self.state.len()];
        let (mut value, mut slope) = (Complex::<f64>::default(), Complex::<f64>::default());
        let mut size = 0.0;
        for &(at, factor) in sum {
            let output = self.system.outputs.at(at);
            let factor = factor * output.scale;
            for (unknown, weight) in output.unknowns.terms() {
                let weight = factor * weight;
                value += self.state[unknown] * weight;
                slope += self.slope[unknown] * weight;
                size += (self.state[unknown] * weight).norm();
                adjoint[unknown] += weight;
            }
            for (input, weight) in output.inputs.terms() {
                let weight = factor * weight;
                value += self.inputs[input] * weight;
                slope += self.input_slopes[input] * weight;
                size += (self.inputs[input] * weight).norm();
            }
        }
        self.factors.solve_transposed(&mut adjoint);
        let passed: f64 = adjoint
            .iter()
            .zip(&self.threshold)
            .map(|(own, threshold)| own.norm() * threshold)
            .sum();
        Amplitude {
            value,
            slope: slope * Complex::new(0.0, self.system.time_scale),
            error: passed + ROUNDINGS * f64::EPSILON * size,
        }
    }
}

/// `B ŵ`, and the sum of the absolute values of its terms.
fn forced(system: &System, inputs: &[Complex<f64>]) -> (Vec<Complex<f64>>, Vec<f64>) {
    let mut right = vec![Complex::<f64>::default(); system.len()];
    let mut size = vec![0.0; system.len()];
    for (row, column, &value) in system.input_matrix.triplet_iter() {
        let term = inputs[column] * value;
        right[row] += term;
        size[row] += term.norm();
    }
    (right, size)
}

fn residual(matrix: &Entries, state: &[Complex<f64>], right: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let of = |(row, right): (&Vec<(usize, Complex<f64>)>, &Complex<f64>)| {
        row.iter().fold(*right, |sum, &(at, value)| sum - value * state[at])
    };
    matrix.iter().zip(right).map(of).collect()
}

fn refined(matrix: &Entries, factors: &Factors, right: &[Complex<f64>]) -> Vec<Complex<f64>> {
    let mut state = right.to_vec();
    factors.solve(&mut state);
    for _ in 0..REFINEMENTS {
        let mut missing = residual(matrix, &state, right);
        factors.solve(&mut missing);
        state.iter_mut().zip(missing).for_each(|(own, missing)| *own += missing);
    }
    state
}

/// By how much each equation is missed, and may be with its coefficients rounded otherwise.
fn thresholds(
    matrix: &Entries,
    state: &[Complex<f64>],
    right: &[Complex<f64>],
    size: &[f64],
) -> Vec<f64> {
    let missed = residual(matrix, state, right);
    let of = |(at, row): (usize, &Vec<(usize, Complex<f64>)>)| {
        let terms: f64 = row.iter().map(|&(column, value)| (value * state[column]).norm()).sum();
        missed[at].norm() + ROUNDINGS * f64::EPSILON * (terms + size[at])
    };
    matrix.iter().enumerate().map(of).collect()
}

/// More unknowns are too many for the poles to be looked for.
pub const MOST_UNKNOWNS: usize = 400;

/// The poles \[rad/s\] of a linear system: it swings freely with `e^{pt}` for each of them. They are
/// in no order, and good to about a rounding of the largest one.
///
/// `None` where the system is not linear, has more than [`MOST_UNKNOWNS`] unknowns, or its poles could not be found.
pub fn poles(system: &System) -> Option<Vec<Complex<f64>>> {
    if !system.is_linear() || system.len() > MOST_UNKNOWNS {
        return None;
    }
    let found = free_rates(system, &DMatrix::from(&system.jacobian))?;
    let poles: Vec<Complex<f64>> = found.iter().map(|own| own / system.time_scale).collect();
    poles.iter().all(|pole| pole.re.is_finite() && pole.im.is_finite()).then_some(poles)
}

/// The eigenvalues of `M ẏ = J y` with the mass matrix of `system`, in its own unit of time: those of the differential
/// unknowns, which the algebraic ones follow.
pub(crate) fn free_rates(system: &System, jacobian: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let moves = |at: &usize| system.unknowns[*at].kind == UnknownKind::Differential;
    let (own, others): (Vec<usize>, Vec<usize>) = (0..system.len()).partition(moves);
    let part = |rows: &[usize], columns: &[usize]| {
        DMatrix::from_fn(rows.len(), columns.len(), |i, j| jacobian[(rows[i], columns[j])])
    };
    let mut matrix = part(&own, &own);
    if !others.is_empty() {
        matrix -= part(&own, &others) * part(&others, &others).lu().solve(&part(&others, &own))?;
    }
    eigenvalues(&matrix)
}

#[cfg(test)]
mod tests;
