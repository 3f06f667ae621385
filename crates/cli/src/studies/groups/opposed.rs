//! Measures of two scenes.

use dashpot_analysis::similarity::Measured;
use dashpot_plot::Table;
use serde::Serialize;

use crate::{
    numbers::{apart, quantity},
    output::{list, object},
};

/// Digits of measures.
const MEASURED: usize = 5;

/// The measures, where what cannot be told from zero is zero.
pub(super) fn cleared(all: Vec<Measured>) -> Vec<Measured> {
    let cleared = |mut measured: Measured| {
        for (value, noise) in measured.values.iter_mut().zip(measured.noise) {
            *value = value.map(|value| if value.abs() <= noise { 0.0 } else { value });
        }
        measured
    };
    list(all.into_iter().map(cleared))
}

/// The measures as objects.
pub(super) fn objects(all: &[Measured]) -> impl Serialize {
    list(all.iter().map(|own| {
        object! {
            measure: &own.key,
            unit: own.unit,
            values: own.values,
            apart: own.apart,
            error: own.error,
            within_errors: own.is_within_errors(),
            factor: own.factor,
        }
    }))
}

/// A value of a measure.
pub(super) fn shown(measured: &Measured, value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| quantity(value, measured.unit, MEASURED))
}

/// The measures of both as a table.
pub(super) fn table(caption: &str, [first, second]: [&str; 2], measures: &[Measured]) -> Table {
    let row = |measured: &Measured| {
        let [one, other] = measured.values.map(|value| shown(measured, value));
        let by = measured.apart.map_or("–".to_owned(), |by| {
            if measured.is_within_errors() { "within the errors".to_owned() } else { apart(by) }
        });
        vec![measured.key.clone(), one, other, by]
    };
    let header = ["measure", first, second, "difference (of larger)"];
    Table::new(caption, &header, measures.iter().map(row))
}
