//! Models of a scene tested alone: curves over deformation or time, and moduli.

use dashpot_analysis::rheometer::{Answer, Drive};
use dashpot_fit::{
    linear::Record,
    network::{Curve, Kind},
};
use dashpot_network::{first_nonlinear, linear_model, parameters::Dimension};
use dashpot_plot::{
    FitQuantity,
    figures::{CREEP, FitFigure, HISTORY, OSCILLATION, RELAXATION},
};
use dashpot_rheology::LinearModel;

use super::{
    asked::{Asked, Measured},
    solver::{Poser, RTOL},
};
use crate::{error::CliError, output::list};

/// What is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Looked {
    Relaxation,
    Creep,
    Storage,
    Loss,
    Answer(Drive),
}

/// A test of a model alone.
#[derive(Debug, Clone)]
pub(super) struct Alone {
    /// The element, model or material.
    name: String,
    is_material: bool,
    looked: Looked,
    /// What was done, `(time, value)`, where it bends.
    history: Vec<(f64, f64)>,
}

/// A test with its rows.
type WithRows = (Alone, Vec<(f64, f64)>);

/// Parts by which a slope may differ where a line goes straight on.
const STRAIGHT: f64 = 1e-9;

impl Alone {
    /// The tests that a record is, each with its rows.
    pub(super) fn of(asked: &Asked, measured: &Measured) -> Result<Vec<WithRows>, CliError> {
        measured.record.check().map_err(|fault| {
            let line = fault.row().and_then(|row| measured.lines.get(row));
            let line = line.map_or(String::new(), |line| format!("line {line}: "));
            CliError::Fit { text: asked.text.clone(), reason: format!("{line}{fault}") }
        })?;
        let of = |looked, history| Self {
            name: asked.target.clone(),
            is_material: measured.is_material,
            looked,
            history,
        };
        let column = |rows: &[[f64; 3]], at: usize| list(rows.iter().map(|own| (own[0], own[at])));
        let driven = |rows: &[[f64; 3]], drive| {
            vec![(of(Looked::Answer(drive), bends(&column(rows, 1))), column(rows, 2))]
        };
        Ok(match &measured.record {
            Record::Relaxation(rows) => vec![(of(Looked::Relaxation, Vec::new()), rows.clone())],
            Record::Creep(rows) => vec![(of(Looked::Creep, Vec::new()), rows.clone())],
            Record::Storage(rows) => vec![(of(Looked::Storage, Vec::new()), rows.clone())],
            Record::Loss(rows) => vec![(of(Looked::Loss, Vec::new()), rows.clone())],
            Record::Oscillation(rows) => vec![
                (of(Looked::Storage, Vec::new()), column(rows, 1)),
                (of(Looked::Loss, Vec::new()), column(rows, 2)),
            ],
            Record::Strained(rows) => driven(rows, Drive::Deformation),
            Record::Stressed(rows) => driven(rows, Drive::Force),
        })
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn is_material(&self) -> bool {
        self.is_material
    }

    /// What is looked at, in the words of what it is.
    pub(super) fn word(&self) -> &'static str {
        match (self.looked, self.is_material) {
            (Looked::Relaxation, _) => "relaxation",
            (Looked::Creep, _) => "creep",
            (Looked::Storage, _) => "storage",
            (Looked::Loss, _) => "loss",
            (Looked::Answer(Drive::Deformation), true) => "stress",
            (Looked::Answer(Drive::Deformation), false) => "force",
            (Looked::Answer(Drive::Force), true) => "strain",
            (Looked::Answer(Drive::Force), false) => "deformation",
        }
    }

    pub(super) fn kind(&self) -> Kind {
        if matches!(self.looked, Looked::Answer(_)) { Kind::Answer } else { Kind::Modulus }
    }

    /// What it is drawn as, over what, and the SI unit of its values.
    pub(super) fn drawn(&self) -> (&'static FitFigure, &'static str, FitQuantity, &'static str) {
        let (figure, x) = match self.looked {
            Looked::Relaxation => (&RELAXATION, "time [s]"),
            Looked::Creep => (&CREEP, "time [s]"),
            Looked::Storage | Looked::Loss => (&OSCILLATION, "frequency [Hz]"),
            Looked::Answer(_) => (&HISTORY, "time [s]"),
        };
        let (quantity, unit) = match (self.looked, self.is_material) {
            (Looked::Relaxation | Looked::Storage | Looked::Loss, true) => {
                (FitQuantity::Modulus, "Pa")
            }
            (Looked::Relaxation | Looked::Storage | Looked::Loss, false) => {
                (FitQuantity::Stiffness, "N/m")
            }
            (Looked::Creep, true) => (FitQuantity::Compliance, "1/Pa"),
            (Looked::Creep, false) => (FitQuantity::PadCompliance, "m/N"),
            (Looked::Answer(Drive::Deformation), true) => (FitQuantity::Stress, "Pa"),
            (Looked::Answer(Drive::Deformation), false) => (FitQuantity::Force, "N"),
            (Looked::Answer(Drive::Force), true) => (FitQuantity::Strain, "1"),
            (Looked::Answer(Drive::Force), false) => (FitQuantity::Deformation, "m"),
        };
        (figure, x, quantity, unit)
    }

    /// Whether its rows are over a frequency \[rad/s\].
    pub(super) fn is_oscillation(&self) -> bool {
        matches!(self.looked, Looked::Storage | Looked::Loss)
    }

    /// The dimension of what is left of it: moduli are compared in parts of them.
    pub(super) fn dimension(&self) -> Dimension {
        match (self.looked, self.is_material) {
            (Looked::Answer(Drive::Deformation), true) => Dimension::PRESSURE,
            (Looked::Answer(Drive::Deformation), false) => Dimension::FORCE,
            (Looked::Answer(Drive::Force), false) => Dimension::LENGTH,
            _ => Dimension::NUMBER,
        }
    }

    /// Its curve where the numbers have these values.
    pub(super) fn curve(
        &self,
        poser: &Poser<'_>,
        values: &[f64],
    ) -> Result<Box<dyn Curve>, String> {
        let model = poser.model(&self.name, values)?.model;
        if let Looked::Answer(drive) = self.looked {
            let answer = Answer::to(&model, drive, &self.history, RTOL);
            return Ok(Box::new(Answered(answer.map_err(|fault| fault.to_string())?)));
        }
        if let Some(element) = first_nonlinear(&model) {
            return Err(format!(
                "`{}` has a {}, which has no {} that every size of test shows: fit it to the stress or force under \
                 its measured history",
                self.name,
                element.kind(),
                self.word()
            ));
        }
        Ok(Box::new(Modulus { model: linear_model(&model), looked: self.looked }))
    }
}

/// The points of a line at which it bends, and its ends.
fn bends(line: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let slope = |one: (f64, f64), other: (f64, f64)| (other.1 - one.1) / (other.0 - one.0);
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (at, own) in line.iter().enumerate() {
        let is_straight = kept.last().zip(line.get(at + 1)).is_some_and(|(last, next)| {
            let [before, after] = [slope(*last, *own), slope(*own, *next)];
            (after - before).abs() <= STRAIGHT * before.abs().max(after.abs())
        });
        if !is_straight {
            kept.push(*own);
        }
    }
    kept
}

struct Answered(Answer);

impl Curve for Answered {
    fn value(&self, time: f64) -> f64 {
        self.0.value(time)
    }

    fn peak(&self) -> (f64, f64) {
        self.0.peak()
    }
}

struct Modulus {
    model: LinearModel,
    looked: Looked,
}

impl Curve for Modulus {
    fn value(&self, at: f64) -> f64 {
        match self.looked {
            Looked::Relaxation => self.model.relaxation(at),
            Looked::Creep => self.model.creep(at),
            Looked::Loss => self.model.loss(at),
            Looked::Storage | Looked::Answer(_) => self.model.storage(at),
        }
    }

    /// Moduli are not aligned by a peak.
    fn peak(&self) -> (f64, f64) {
        (0.0, self.value(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_kept_where_it_bends() {
        let line = [(0.0, 0.0), (0.1, 1.0), (0.3, 3.0), (0.4, 3.0), (0.9, 3.0), (1.0, 2.0)];
        assert_eq!(bends(&line), [(0.0, 0.0), (0.3, 3.0), (0.9, 3.0), (1.0, 2.0)]);
        assert_eq!(bends(&line[..1]), line[..1]);
    }
}
