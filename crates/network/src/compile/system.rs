//! Rows in SI turned into a dimensionless system.

use dashpot_dae::{Input, LinearForm, Output, System, Unknown, UnknownKind};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use super::{
    outputs::Outputs,
    row::Row,
    scales::power_of_two,
    unknowns::{Inputs, Places},
};
use crate::NetworkError;

/// The system of all rows, with `time` \[s\] as its unit of time.
pub(super) fn dimensionless(
    places: &Places,
    inputs: &Inputs,
    outputs: &Outputs,
    time: f64,
    duration: f64,
) -> Result<System, NetworkError> {
    let columns: Vec<f64> = places.drafts.iter().map(|draft| draft.scale).collect();
    let heights: Vec<f64> = inputs
        .waveforms
        .iter()
        .map(|waveform| {
            power_of_two(Some(waveform.bound(duration)).filter(|&h| h > 0.0).unwrap_or(1.0))
        })
        .collect();
    let scale_of =
        |input: &Input| heights[input.waveform] / time.powi(input.derivative.cast_signed());
    let input_columns: Vec<f64> = inputs.entries.iter().map(scale_of).collect();

    let count = places.drafts.len();
    let mut jacobian = CooMatrix::new(count, count);
    let mut input_matrix = CooMatrix::new(count, inputs.entries.len());
    for (at, draft) in places.drafts.iter().enumerate() {
        let (own, given) = scaled(&draft.row, &columns, &input_columns);
        let factor = match draft.kind {
            UnknownKind::Differential => time / draft.scale,
            UnknownKind::Algebraic => 1.0 / power_of_two(largest(&own).max(f64::MIN_POSITIVE)),
        };
        for &(column, value) in own.terms() {
            jacobian.push(at, column, finite(factor * value)?);
        }
        for &(column, value) in given.terms() {
            input_matrix.push(at, column, finite(factor * value)?);
        }
    }
    let report = |(output, row): &(Output, Row)| {
        let (own, given) = scaled(row, &columns, &input_columns);
        let scale = largest(&own).max(largest(&given));
        let scale = power_of_two(if scale > 0.0 { scale } else { 1.0 });
        finite(scale)?;
        Ok(Output {
            name: output.name.clone(),
            unit: output.unit,
            scale,
            unknowns: divided(&own, scale),
            inputs: divided(&given, scale),
        })
    };
    Ok(System {
        unknowns: places
            .drafts
            .iter()
            .map(|draft| Unknown {
                name: draft.name.clone(),
                kind: draft.kind,
                scale: draft.scale,
                unit: draft.unit,
            })
            .collect(),
        jacobian: CsrMatrix::from(&jacobian),
        input_matrix: CsrMatrix::from(&input_matrix),
        inputs: inputs.entries.clone(),
        waveforms: inputs
            .waveforms
            .iter()
            .zip(&heights)
            .map(|(waveform, &height)| waveform.in_units(time, height))
            .collect(),
        initial: places.drafts.iter().map(|draft| draft.initial / draft.scale).collect(),
        outputs: outputs.list.iter().map(report).collect::<Result<_, NetworkError>>()?,
        time_scale: time,
    })
}

fn scaled(row: &Row, columns: &[f64], input_columns: &[f64]) -> (LinearForm, LinearForm) {
    (row.unknowns.scaled(columns), row.inputs.scaled(input_columns))
}

fn divided(form: &LinearForm, by: f64) -> LinearForm {
    LinearForm::sum(form.terms().iter().map(|&(at, value)| (at, value / by)).collect())
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
