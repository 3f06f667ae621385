//! Rows in SI turned into a dimensionless system.

use std::{collections::BTreeMap, sync::Arc};

use dashpot_dae::{
    Argument, Characteristic, LinearForm, Outputs, System, Term, Unknown, UnknownKind,
};
use nalgebra_sparse::CsrMatrix;

use super::{
    expand::Expansion,
    laws::law_of,
    motion::Motion,
    rates::ForceRate,
    row::{Combination, Row},
    scales::{Scales, power_of_two},
    unknowns::{Inputs, Law, Places},
};
use crate::NetworkError;

/// What makes rows dimensionless.
#[derive(Debug)]
pub(super) struct Scaling {
    /// SI value of 1 of each unknown, times the lift.
    columns: Vec<f64>,
    input_columns: Vec<f64>,
    /// The unit of time \[s\].
    time: f64,
    /// See [`Scales::lift`].
    lift: f64,
}

impl Scaling {
    pub(super) fn of(places: &Places, inputs: &Inputs, scales: &Scales, duration: f64) -> Self {
        let Scales { time, lift, .. } = *scales;
        let columns = places.drafts.iter().map(|draft| draft.scale).collect();
        let input_columns = inputs.columns(time, duration).into_iter().map(|column| column * lift);
        Self { columns, input_columns: input_columns.collect(), time, lift }
    }

    /// The forms of a row over unknowns and inputs in units of its largest coefficient, and this in SI units.
    pub(super) fn scaled(&self, row: &Row) -> Result<(f64, [LinearForm; 2]), NetworkError> {
        let (own, given) = scaled(row, &self.columns, &self.input_columns);
        let scale = largest(&own).max(largest(&given));
        let scale = finite(power_of_two(if scale > 0.0 { scale } else { 1.0 }))?;
        Ok((scale / self.lift, [divided(&own, scale), divided(&given, scale)]))
    }
}

/// The system of all rows, without outputs; it takes the names of the drafts.
pub(super) fn dimensionless(
    expansion: &Expansion,
    least_dashpots: &BTreeMap<usize, f64>,
    motion: &Motion,
    places: &mut Places,
    inputs: &Inputs,
    scaling: &Scaling,
    duration: f64,
) -> Result<System, NetworkError> {
    let Scaling { columns, input_columns, time, lift } = scaling;
    let (time, lift) = (*time, *lift);
    let heights = inputs.heights(duration);

    let count = places.drafts.len();
    let mut terms = Vec::new();
    let mut jacobian = Matrix::new(count);
    let mut input_matrix = Matrix::new(count);
    for (at, draft) in places.drafts.iter().enumerate() {
        let (own, given) = scaled(&places.rows.row(at), columns, input_columns);
        let factor = match draft.kind {
            UnknownKind::Differential => time / draft.scale,
            UnknownKind::Algebraic => {
                // A law alone in its balance is as large as the force that it is solved for.
                let alone = draft.law.is_some() && own.terms().is_empty();
                let size = if alone { draft.scale } else { largest(&own) };
                1.0 / power_of_two(size.max(f64::MIN_POSITIVE))
            }
        };
        if let Some(law @ (Law::Force(primitive) | Law::ForceRate(primitive))) = draft.law {
            // A force, where its rate is what the law gives.
            let of_rate = matches!(law, Law::ForceRate(_)).then_some(draft.scale * time);
            let least = least_dashpots.get(&primitive).copied().unwrap_or(0.0);
            let (law, rows) = law_in(expansion, motion, (primitive, of_rate), least);
            let arguments = rows.map(|row| {
                let (unknowns, inputs) = scaled(&row, columns, input_columns);
                Argument { scale: lift.recip(), unknowns, inputs }
            });
            terms.push(Term { row: at, factor: finite(factor * lift)?, law, arguments });
        }
        jacobian.push(&own, factor)?;
        input_matrix.push(&given, factor)?;
    }
    Ok(System {
        unknowns: places
            .drafts
            .iter_mut()
            .map(|draft| Unknown {
                name: std::mem::take(&mut draft.name),
                kind: draft.kind,
                scale: draft.scale / lift,
                unit: draft.unit,
            })
            .collect(),
        jacobian: jacobian.of_columns(count),
        input_matrix: input_matrix.of_columns(inputs.entries.len()),
        inputs: inputs.entries.clone(),
        waveforms: inputs
            .waveforms
            .iter()
            .zip(&heights)
            .map(|(waveform, &height)| waveform.in_units(time, height))
            .collect(),
        terms,
        initial: places.drafts.iter().map(|draft| draft.initial * lift / draft.scale).collect(),
        outputs: Outputs::new(),
        time_scale: time,
    })
}

/// A sparse matrix, row by row.
struct Matrix {
    ends: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
}

impl Matrix {
    fn new(rows: usize) -> Self {
        let mut ends = Vec::with_capacity(rows + 1);
        ends.push(0);
        Self { ends, columns: Vec::new(), values: Vec::new() }
    }

    /// Adds a row that is `factor` times a form.
    fn push(&mut self, form: &LinearForm, factor: f64) -> Result<(), NetworkError> {
        for &(column, value) in form.terms() {
            self.columns.push(column);
            self.values.push(finite(factor * value)?);
        }
        self.ends.push(self.columns.len());
        Ok(())
    }

    fn of_columns(self, count: usize) -> CsrMatrix<f64> {
        let Self { ends, mut columns, mut values } = self;
        columns.shrink_to_fit();
        values.shrink_to_fit();
        // The variables of a form rise.
        CsrMatrix::try_from_csr_data(ends.len() - 1, count, ends, columns, values)
            .unwrap_or_else(|fault| panic!("{fault}"))
    }
}

/// The law of a primitive that is not linear, or of the rate of its force, whose size is then known \[N\], and what it is a
/// law of.
fn law_in(
    expansion: &Expansion,
    motion: &Motion,
    (primitive, of_rate): (usize, Option<f64>),
    least: f64,
) -> (Arc<dyn Characteristic>, [Row; 2]) {
    let own = &expansion.primitives[primitive];
    let [_, damping] = own.slopes();
    let rate = motion.rate.get(primitive).filter(|_| damping > 0.0 || of_rate.is_some());
    let law: Arc<dyn Characteristic> = match of_rate {
        Some(size) => Arc::new(ForceRate::of(expansion, primitive, size)),
        None => law_of(own, least),
    };
    let rows = if own.is_reflected() {
        let sum = rate.map(|rate| motion.force.row(primitive).plus(damping, &rate));
        [sum.unwrap_or_default(), Row::default()]
    } else {
        [motion.deformation.row(primitive), rate.unwrap_or_default()]
    };
    (law, rows)
}

fn scaled(row: &Row, columns: &[f64], input_columns: &[f64]) -> (LinearForm, LinearForm) {
    (row.unknowns.scaled(columns), row.inputs.scaled(input_columns))
}

fn divided(form: &LinearForm, by: f64) -> LinearForm {
    let terms = form.terms().iter().map(|&(at, value)| (at, value / by));
    LinearForm::of(terms.filter(|term| term.1 != 0.0))
}

fn largest(form: &LinearForm) -> f64 {
    form.terms().iter().map(|term| term.1.abs()).fold(0.0, f64::max)
}

fn finite(value: f64) -> Result<f64, NetworkError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(NetworkError::OutOfScale { what: "a coefficient of the equations", value, unit: "1" })
    }
}
