//! Factors between similar scenes.

use dashpot_analysis::{measures::SeverityIndex, similarity::Scale};
use dashpot_network::parameters::Dimension;
use dashpot_plot::Table;
use serde::Serialize;

use super::DIGITS;
use crate::numbers::significant;

/// Factors from one scene to another.
#[derive(Serialize)]
pub(crate) struct Factors {
    mass: f64,
    length: f64,
    time: f64,
    velocity: f64,
    acceleration: f64,
    force: f64,
    energy: f64,
    impulse: f64,
    stiffness: f64,
    damping: f64,
    pressure: f64,
    /// That of the severity index and of the head injury criterion.
    severity_index: f64,
}

impl Factors {
    /// Those of a scale.
    pub(super) fn of(scale: &Scale) -> Self {
        Self {
            mass: scale.mass,
            length: scale.length,
            time: scale.time,
            velocity: scale.of(Dimension::VELOCITY),
            acceleration: scale.of(Dimension::ACCELERATION),
            force: scale.of(Dimension::FORCE),
            energy: scale.of(Dimension::ENERGY),
            impulse: scale.of(Dimension::IMPULSE),
            stiffness: scale.of(Dimension::STIFFNESS),
            damping: scale.of(Dimension::DAMPING),
            pressure: scale.of(Dimension::PRESSURE),
            severity_index: scale.of_measure(&SeverityIndex::default()),
        }
    }

    /// Whether both scenes have one scale.
    pub(crate) fn is_one(&self) -> bool {
        [self.mass, self.length, self.time].iter().all(|own| (own - 1.0).abs() <= 1e-12)
    }

    /// The factors and the way back.
    pub(crate) fn table(&self, caption: &str) -> Table {
        let all = [
            ("mass", self.mass),
            ("length", self.length),
            ("time", self.time),
            ("velocity", self.velocity),
            ("acceleration", self.acceleration),
            ("force", self.force),
            ("energy", self.energy),
            ("impulse", self.impulse),
            ("stiffness", self.stiffness),
            ("damping", self.damping),
            ("stress, modulus", self.pressure),
            ("severity index, HIC", self.severity_index),
        ];
        let row = |(name, factor): (&str, f64)| {
            vec![name.to_owned(), significant(factor, DIGITS), significant(factor.recip(), DIGITS)]
        };
        Table {
            caption: caption.to_owned(),
            header: ["factor of", "there", "and back"].map(str::to_owned).into(),
            rows: all.map(row).into(),
        }
    }
}
