//! A laboratory test.

use dashpot_analysis::similarity::{Chosen, Laboratory};
use dashpot_plot::Table;
use serde::Serialize;

use super::{
    DIGITS, Factors, Opposed, Reference,
    opposed::{MEASURED, opposed},
    reference, si,
};
use crate::numbers::{constant, quantity, significant};

/// A laboratory test.
#[derive(Serialize)]
pub(crate) struct Test {
    chosen: Vec<Choice>,
    kept: Vec<Reference>,
    scale: Factors,
    /// Gravity in the real scene and in the laboratory; null where it is off.
    gravity: Option<[f64; 2]>,
    /// The measures of the real scene, and those of the laboratory with its own gravity, at the scale
    /// of the real one; none where gravity is right.
    pub(crate) with_own_gravity: Vec<Opposed>,
    /// The measures of the real scene, and what the laboratory reads.
    pub(crate) measures: Vec<Opposed>,
    pub(crate) left_out: Vec<String>,
    pub(crate) written: Option<String>,
}

#[derive(Serialize)]
struct Choice {
    parameter: String,
    real: f64,
    laboratory: f64,
    unit: String,
}

impl Test {
    /// A laboratory test of which nothing has been solved.
    pub(crate) fn of(laboratory: &Laboratory) -> Self {
        let choice = |own: &Chosen| Choice {
            parameter: own.real.name.clone(),
            real: own.real.value,
            laboratory: own.value,
            unit: si(own.real.dimension),
        };
        Self {
            chosen: laboratory.chosen.iter().map(choice).collect(),
            kept: laboratory.kept.iter().map(|own| reference("", own)).collect(),
            scale: Factors::of(&laboratory.scale),
            gravity: laboratory.gravity,
            with_own_gravity: Vec::new(),
            measures: Vec::new(),
            left_out: Vec::new(),
            written: None,
        }
    }

    /// What is chosen, and what stays as it is.
    pub(crate) fn choices(&self) -> Table {
        let chosen = self.chosen.iter().map(|own| {
            let said = |value| constant(value, &own.unit);
            vec![own.parameter.clone(), said(own.real), said(own.laboratory)]
        });
        let kept = self.kept.iter().map(|own| {
            let value = constant(own.value, &own.unit);
            vec![own.name.clone(), value.clone(), format!("{value} (kept)")]
        });
        Table {
            caption: "The laboratory test".to_owned(),
            header: ["parameter", "real", "laboratory"].map(str::to_owned).into(),
            rows: chosen.chain(kept).collect(),
        }
    }

    /// The map.
    pub(crate) fn map(&self) -> Table {
        self.scale.table("The map: laboratory over real, and back")
    }

    /// What the laboratory will read.
    pub(crate) fn predicted(&self) -> Table {
        let row = |own: &Opposed| {
            let [one, other] = own.values.map(|value| {
                value.map_or("–".to_owned(), |value| quantity(value, own.unit, MEASURED))
            });
            vec![own.measure.clone(), one, other, significant(own.factor.recip(), DIGITS)]
        };
        Table {
            caption: "What the laboratory reads".to_owned(),
            header: ["measure", "real", "laboratory", "and back"].map(str::to_owned).into(),
            rows: self.measures.iter().map(row).collect(),
        }
    }

    /// What gravity that cannot be scaled does.
    pub(crate) fn gravity(&self) -> Option<(String, Table)> {
        let [real, needed] = self.gravity?;
        if (needed - real).abs() <= 1e-9 * real.abs() {
            return None;
        }
        let said = |value| constant(value, "m/s^2");
        let text = format!(
            "gravity would have to be {} in the laboratory, where it is {} in the real scene; the \
             scene that is written has it so. What a laboratory under {} measures is shown below.",
            said(needed),
            said(real),
            said(real)
        );
        let caption = "The laboratory with gravity as it is, at the real scale";
        Some((text, opposed(caption, ["real", "laboratory"], &self.with_own_gravity)))
    }
}
