//! Measures of two scenes.

use dashpot_analysis::similarity::Measured;
use dashpot_plot::Table;
use serde::Serialize;

use crate::numbers::{apart, quantity};

/// Digits of measures.
pub(super) const MEASURED: usize = 5;

/// A measure of both.
#[derive(Serialize)]
pub(crate) struct Opposed {
    /// Its key.
    pub(super) measure: String,
    /// Its SI unit.
    pub(super) unit: &'static str,
    /// Its values.
    pub(super) values: [Option<f64>; 2],
    /// How far they are apart, relative.
    pub(super) apart: Option<f64>,
    error: Option<f64>,
    /// The factor of the measure from the first to the second.
    pub(super) factor: f64,
}

impl Opposed {
    /// A measure of two scenes.
    pub(crate) fn of(own: &Measured) -> Self {
        Self {
            measure: own.key.clone(),
            unit: own.unit,
            values: own.values,
            apart: own.apart,
            error: own.error,
            factor: own.factor,
        }
    }
}

impl Opposed {
    /// A measure of a real scene and what a laboratory reads.
    pub(crate) fn read(own: &Measured) -> Self {
        let [real, at_scale] = own.values;
        Self { values: [real, at_scale.map(|value| value * own.factor)], ..Self::of(own) }
    }
}

/// The measures of both as a table.
pub(super) fn opposed(caption: &str, names: [&str; 2], measures: &[Opposed]) -> Table {
    let row = |own: &Opposed| {
        let said = |value: Option<f64>| {
            value.map_or("–".to_owned(), |value| quantity(value, own.unit, MEASURED))
        };
        let [one, other] = own.values.map(said);
        let by = own.apart.map_or("–".to_owned(), |by| match own.error {
            Some(error) if by <= error => "within the errors".to_owned(),
            _ => apart(by),
        });
        vec![own.measure.clone(), one, other, by]
    };
    let header = ["measure", names[0], names[1], "apart"].map(str::to_owned);
    Table {
        caption: caption.to_owned(),
        header: header.into(),
        rows: measures.iter().map(row).collect(),
    }
}
