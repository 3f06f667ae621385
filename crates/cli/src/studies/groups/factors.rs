//! Factors between similar scenes.

use dashpot_analysis::{measures::SeverityIndex, similarity::Scale};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use serde::Serialize;

use super::DIGITS;
use crate::{numbers::significant, output::Pairs};

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
