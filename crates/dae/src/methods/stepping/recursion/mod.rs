//! The derivatives of all unknowns at the start, each order from the last.

use diffsol::{FaerSparseMat, NalgebraMat};

use super::{
    algebra::{Algebra, DENSE_UP_TO},
    balance::Balance,
    equations::Equations,
    failure::Site,
    newton::consistent,
};
use crate::{Derivatives, Piece, SolveError, System, UnknownKind};

/// Who failed, where something fails.
const NAME: &str = "derivatives";

/// The derivatives of orders 0 to `order` of all unknowns of `system` at `t = 0`, on the pieces of the
/// waveforms that hold from there on.
///
/// The differential entries of `state` are kept; the algebraic ones are a first guess, and those that
/// satisfy the balances take their place. The differential unknowns' derivatives of each order follow
/// from the last order, those of the algebraic unknowns from the differentiated balances.
///
/// For linear systems all orders are exact up to rounding. Terms that are not linear enter with their
/// slopes at the state: then orders up to 2 of the differential unknowns and up to 1 of the algebraic
/// ones are exact, all higher ones lack what the curvature of the laws adds. Where a law has a kink its
/// own slope there counts; where it is infinite, that of a narrow secant.
///
/// There is an example at [`System`].
///
/// # Errors
///
/// [`SolveError::NotApplicable`] where the balances do not determine their unknowns,
/// [`SolveError::Inconsistent`] where no values that satisfy them are found, and
/// [`SolveError::NotFinite`] for numbers that are not finite.
///
/// # Panics
///
/// When `state` has not as many entries as there are unknowns.
pub fn derivatives(
    system: &System,
    state: &[f64],
    order: usize,
) -> Result<Derivatives, SolveError> {
    assert_eq!(state.len(), system.len(), "the state must have one entry for each unknown");
    if system.len() <= DENSE_UP_TO {
        derivatives_in::<NalgebraMat<f64>>(system, state, order)
    } else {
        derivatives_in::<FaerSparseMat<f64>>(system, state, order)
    }
}

fn derivatives_in<M: Algebra>(
    system: &System,
    state: &[f64],
    order: usize,
) -> Result<Derivatives, SolveError> {
    let site = Site { method: NAME, time: 0.0, system };
    site.finite(state)?;
    site.structure()?;
    let mut recursion = Recursion::<M>::start(site, state)?;
    for order in (1..).take(order) {
        recursion.next(order)?;
    }
    Ok(recursion.found)
}

struct Recursion<'s, M: Algebra> {
    site: Site<'s>,
    equations: Equations<'s, M>,
    balance: Option<(Balance<M>, Spread)>,
    found: Derivatives,
}

impl<'s, M: Algebra> Recursion<'s, M> {
    /// Order 0: the consistent state.
    fn start(site: Site<'s>, state: &[f64]) -> Result<Self, SolveError> {
        let mut values = state.to_vec();
        let mut equations = Equations::<M>::new(site.system).map_err(|_| site.singular(&values))?;
        equations.enter(0.0, &values);
        let mut balance = None;
        if let Some(mut own) = Balance::apart(site.system).map_err(|_| site.singular(state))? {
            consistent(&mut own, &equations, &mut values)
                .map_err(|failure| site.imbalance(failure, &values))?;
            let spread = Spread::of(&mut own, site.system.len());
            balance = Some((own, spread.ok_or_else(|| site.singular(&values))?));
        }
        let magnitudes = values.iter().map(|value| value.abs()).collect();
        let mut recursion = Self { site, equations, balance, found: Derivatives::default() };
        recursion.push(0, values, magnitudes)?;
        Ok(recursion)
    }

    /// The next order from the last.
    fn next(&mut self, order: u32) -> Result<(), SolveError> {
        let Derivatives { values, magnitudes, input_magnitudes, .. } = &self.found;
        let (Some(state), Some(last)) = (values.first(), values.last()) else { return Ok(()) };
        let mut slopes = self.equations.rates(order - 1, last);
        if let Some((balance, _)) = &mut self.balance {
            let solved = balance.slopes(order, &self.equations, state, &mut slopes);
            solved.map_err(|_| self.site.singular(state))?;
        }
        let driven = input_magnitudes.last().map_or(&[][..], Vec::as_slice);
        let sizes = magnitudes.last().map(|last| self.equations.magnitudes(last, driven));
        self.push(order, slopes, sizes.unwrap_or_default())
    }

    /// Adds an order, of which the `magnitudes` of the differential unknowns are known.
    fn push(
        &mut self,
        order: u32,
        values: Vec<f64>,
        mut magnitudes: Vec<f64>,
    ) -> Result<(), SolveError> {
        self.site.finite(&values)?;
        let system = self.site.system;
        let drives = system.inputs.iter().map(|input| {
            let piece = system.waveforms[input.waveform].piece_at(0.0);
            let order = input.derivative + order;
            (piece.derivative(order, 0.0), magnitude(piece, order, 0.0))
        });
        let (inputs, input_magnitudes): (Vec<_>, Vec<_>) = drives.unzip();
        if let Some((_, spread)) = &self.balance {
            let kinds = system.unknowns.iter().map(|unknown| unknown.kind);
            let sizes: Vec<f64> = kinds
                .zip(magnitudes.iter().zip(&values))
                .map(|(kind, (&magnitude, value))| match kind {
                    UnknownKind::Differential => magnitude,
                    UnknownKind::Algebraic => value.abs(),
                })
                .collect();
            let mut rows = self.equations.magnitudes(&sizes, &input_magnitudes);
            if let Some(terms) = self.equations.terms() {
                let sizes = (&*sizes, &*input_magnitudes);
                match self.found.values.first() {
                    None => terms.add_sizes((0.0, &values), sizes, &mut rows),
                    Some(state) => terms.add_magnitudes((0.0, state), sizes, &mut rows),
                }
            }
            spread.apply(&rows, &mut magnitudes);
        }
        self.found.values.push(values);
        self.found.magnitudes.push(magnitudes);
        self.found.inputs.push(inputs);
        self.found.input_magnitudes.push(input_magnitudes);
        Ok(())
    }
}

/// How the algebraic unknowns follow errors of the balances: the sizes of the entries of the inverse.
struct Spread {
    algebraic: Vec<usize>,
    columns: Vec<Vec<f64>>,
}

impl Spread {
    fn of<M: Algebra>(balance: &mut Balance<M>, size: usize) -> Option<Self> {
        let algebraic = balance.algebraic().to_vec();
        let mut columns = Vec::with_capacity(algebraic.len());
        for &row in &algebraic {
            let mut unit = vec![0.0; size];
            unit[row] = 1.0;
            let column = balance.direction(&unit)?;
            columns.push(algebraic.iter().map(|&at| column[at].abs()).collect());
        }
        Some(Self { algebraic, columns })
    }

    /// The `magnitudes` of the algebraic unknowns from those of the `rows`.
    fn apply(&self, rows: &[f64], magnitudes: &mut [f64]) {
        for (k, &unknown) in self.algebraic.iter().enumerate() {
            let parts = self.columns.iter().zip(&self.algebraic);
            magnitudes[unknown] = parts.map(|(column, &row)| column[k] * rows[row]).sum();
        }
    }
}

/// The scale of the rounding error of a piece's derivative at `t`: `Σ |terms|`, that of the phase included.
fn magnitude(piece: &Piece, order: u32, t: f64) -> f64 {
    let s = t - piece.start;
    let powers = [piece.value, piece.slope, piece.curvature, piece.jerk];
    let mut factor = 1.0;
    let mut sum = 0.0;
    for (own, degree) in powers.iter().skip(order as usize).zip(1_u32..) {
        sum += (own * factor).abs();
        factor *= s / f64::from(degree);
    }
    if !piece.is_wave() {
        return if order == 0 { sum + piece.cosine.abs() } else { sum };
    }
    let phase = (piece.omega + 0.5 * piece.sweep * s) * s;
    let (sin, cos) = phase.sin_cos();
    let along = (piece.sine * sin).abs() + (piece.cosine * cos).abs();
    let across = (piece.sine * cos).abs() + (piece.cosine * sin).abs();
    let blur = phase.abs();
    // The recursion of the derivatives themselves, on absolute values.
    let (mut last, mut now) = ([0.0; 2], [along + blur * across, across + blur * along]);
    let frequency = piece.omega.abs() + (piece.sweep * s).abs();
    for n in 0..order {
        let turn = f64::from(n) * piece.sweep.abs();
        let next = [frequency * now[1] + turn * last[1], frequency * now[0] + turn * last[0]];
        (last, now) = (now, next);
    }
    sum + now[0]
}

#[cfg(test)]
mod tests;
