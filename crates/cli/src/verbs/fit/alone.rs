//! Models of a scene tested alone: curves over deformation or time, and moduli.

use dashpot_analysis::rheometer::{Answer, Drive};
use dashpot_fit::{
    linear::{Column, Kind},
    network::{Curve, Kind as TestKind},
};
use dashpot_network::{first_nonlinear, linear_model, parameters::Dimension};
use dashpot_rheology::LinearModel;

use super::{
    asked::{Asked, Measured},
    figures::{DrawnAs, drawn_as},
    solver::{Poser, RTOL},
};
use crate::{error::CliError, output::list};

/// A test of a model alone.
#[derive(Debug, Clone)]
pub(super) struct Alone {
    /// The element, model or material.
    name: String,
    is_material: bool,
    kind: Kind,
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
        let checked = measured.record.check();
        checked.map_err(|fault| measured.fault(asked, fault.row(), &fault))?;
        let (name, is_material) = (&asked.target, measured.is_material);
        let test = |Column { kind, places, done, values }: Column| {
            let history = bends(&list(places.iter().copied().zip(done)));
            let rows = list(places.into_iter().zip(values));
            (Self { name: name.clone(), is_material, kind, history }, rows)
        };
        Ok(list(measured.record.columns().into_iter().map(test)))
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn is_material(&self) -> bool {
        self.is_material
    }

    /// What is looked at, in the words of what it is.
    pub(super) fn word(&self) -> &'static str {
        match (self.kind, self.is_material) {
            (Kind::Relaxation, _) => "relaxation",
            (Kind::Creep, _) => "creep",
            (Kind::Storage, _) => "storage",
            (Kind::Loss, _) => "loss",
            (Kind::Stress, true) => "stress",
            (Kind::Stress, false) => "force",
            (Kind::Strain, true) => "strain",
            (Kind::Strain, false) => "deformation",
        }
    }

    pub(super) fn kind(&self) -> TestKind {
        if self.kind.has_history() { TestKind::Answer } else { TestKind::Modulus }
    }

    /// What it is drawn as.
    pub(super) fn drawn(&self) -> DrawnAs {
        drawn_as(self.kind, self.is_material)
    }

    /// Between which times, or frequencies, it is known.
    pub(super) fn span(&self) -> (f64, f64) {
        let [first, last] = [self.history.first(), self.history.last()];
        (first.map_or(0.0, |own| own.0), last.map_or(0.0, |own| own.0))
    }

    /// Whether its rows are over a frequency \[rad/s\].
    pub(super) fn is_oscillation(&self) -> bool {
        self.kind.is_oscillation()
    }

    /// The dimension of what is left of it: moduli are compared in parts of them.
    pub(super) fn dimension(&self) -> Dimension {
        match (self.kind, self.is_material) {
            (Kind::Stress, true) => Dimension::PRESSURE,
            (Kind::Stress, false) => Dimension::FORCE,
            (Kind::Strain, false) => Dimension::LENGTH,
            _ => Dimension::NUMBER,
        }
    }

    /// Its curve where the numbers have these values; one that was solved is judged by its energy or not.
    pub(super) fn curve(
        &self,
        poser: &Poser<'_>,
        values: &[f64],
        is_judged: bool,
    ) -> Result<Box<dyn Curve>, String> {
        let (model, _) = poser.model(&self.name, values)?;
        let drive = match self.kind {
            Kind::Stress => Some(Drive::Deformation),
            Kind::Strain => Some(Drive::Force),
            _ => None,
        };
        if let Some(drive) = drive {
            let answer = Answer::to(&model, drive, &self.history, (RTOL, is_judged));
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
        Ok(Box::new(Modulus { model: linear_model(&model), kind: self.kind }))
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
    kind: Kind,
}

impl Curve for Modulus {
    fn value(&self, at: f64) -> f64 {
        match self.kind {
            Kind::Relaxation => self.model.relaxation(at),
            Kind::Creep => self.model.creep(at),
            Kind::Loss => self.model.loss(at),
            _ => self.model.storage(at),
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
