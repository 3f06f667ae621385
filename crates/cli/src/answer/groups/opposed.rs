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
    /// How far they are apart, over the larger one.
    pub(super) apart: Option<f64>,
    /// By how much errors alone may part them, over the same.
    error: Option<f64>,
    /// Whether errors alone, or rounding, may part them.
    pub(super) within_errors: bool,
    /// The factor of the measure from the first to the second.
    pub(super) factor: f64,
}

impl Opposed {
    /// A measure of two scenes; what cannot be told from zero is zero.
    pub(crate) fn of(own: &Measured) -> Self {
        let [one, other] = [0, 1].map(|at| {
            own.values[at].map(|value| if value.abs() <= own.noise[at] { 0.0 } else { value })
        });
        Self {
            measure: own.key.clone(),
            unit: own.unit,
            values: [one, other],
            apart: own.apart,
            error: own.error,
            within_errors: own.is_within_errors(),
            factor: own.factor,
        }
    }
}

impl Opposed {
    /// A measure of a real scene and what a laboratory reads.
    pub(crate) fn read(own: &Measured) -> Self {
        let told = Self::of(own);
        let [real, at_scale] = told.values;
        Self { values: [real, at_scale.map(|value| value * own.factor)], ..told }
    }
}

/// The measures of both as a table.
pub(super) fn opposed(caption: &str, names: [&str; 2], measures: &[Opposed]) -> Table {
    let row = |own: &Opposed| {
        let said = |value: Option<f64>| {
            value.map_or("–".to_owned(), |value| quantity(value, own.unit, MEASURED))
        };
        let [one, other] = own.values.map(said);
        let by = own.apart.map_or("–".to_owned(), |by| {
            if own.within_errors { "within the errors".to_owned() } else { apart(by) }
        });
        vec![own.measure.clone(), one, other, by]
    };
    let header = ["measure", names[0], names[1], "apart (of larger)"].map(str::to_owned);
    Table {
        caption: caption.to_owned(),
        header: header.into(),
        rows: measures.iter().map(row).collect(),
    }
}
