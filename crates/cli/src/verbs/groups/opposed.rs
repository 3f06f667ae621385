//! Measures of two scenes, and the factors between them.

use dashpot_analysis::{
    measures::SeverityIndex,
    similarity::{Measured, Scale},
};
use dashpot_network::parameters::Dimension;
use dashpot_report::Table;
use serde::Serialize;

use super::DIGITS;
use crate::{
    output::{Pairs, list, object},
    verbs::run::measure_text,
};
use dashpot_report::numbers::{apart, significant};

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
    let text = |value: f64| measure_text(&measured.key, value, measured.unit, MEASURED);
    value.map_or("–".to_owned(), text)
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

/// All factors, with their keys and what they are called.
fn all(scale: &Scale) -> [(&'static str, &'static str, f64); 12] {
    let of = |key, dimension| (key, key, scale.of(dimension));
    [
        ("mass", "mass", scale.mass),
        ("length", "length", scale.length),
        ("time", "time", scale.time),
        of("velocity", Dimension::VELOCITY),
        of("acceleration", Dimension::ACCELERATION),
        of("force", Dimension::FORCE),
        of("energy", Dimension::ENERGY),
        of("impulse", Dimension::IMPULSE),
        of("stiffness", Dimension::STIFFNESS),
        of("damping", Dimension::DAMPING),
        ("pressure", "stress, modulus", scale.of(Dimension::PRESSURE)),
        ("severity_index", "severity index, HIC", scale.of_measure(&SeverityIndex::default())),
    ]
}

/// The factors as an object.
pub(super) fn factors(scale: &Scale) -> impl Serialize + use<> {
    all(scale).into_iter().map(|(key, _, factor)| (key, factor)).collect::<Pairs<_, _>>()
}

/// Whether both scenes have one scale.
pub(super) fn is_one(scale: &Scale) -> bool {
    [scale.mass, scale.length, scale.time].iter().all(|own| (own - 1.0).abs() <= 1e-12)
}

/// The factors and the way back.
pub(super) fn factor_table(caption: &str, scale: &Scale) -> Table {
    let row = |(_, name, factor): (_, &str, f64)| {
        vec![name.to_owned(), significant(factor, DIGITS), significant(factor.recip(), DIGITS)]
    };
    Table::new(caption, &["factor of", "there", "and back"], all(scale).map(row))
}
