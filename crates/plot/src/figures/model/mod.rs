//! Figures of linear models: what a spring–dashpot model answers at every time and frequency.
//!
//! A figure is one line of [`MODEL_FIGURES`]. Several models in one figure are told apart by pattern as well as by
//! colour, so that a comparison can be printed in black: the first one is broad and pale, the second one dashed on top
//! of it.

mod curves;
mod loading;
mod rheometer;

use self::curves::{Kind, draw};
use crate::{Chart, Pattern, Scale, Series};

pub use curves::{ModelCurve, ModelSeries, ModelSubject};
pub use loading::{Loop, LoopSeries};
pub use rheometer::{Measured, RheometerLine, RheometerSeries};

/// Every figure of linear models, in the order of a report. **A new one is registered here.**
pub const MODEL_FIGURES: &[ModelFigure] = &[RELAXATION, CREEP, SWEEP, LOSS_FACTOR];

/// Relaxation function `G(t)` over time, and of a single model the lines of its spectrum: the strength `K_j` at each
/// relaxation time `τ_j`.
pub const RELAXATION: ModelFigure = ModelFigure {
    name: "relaxation",
    titles: ["Relaxation stiffness", "Relaxation modulus"],
    x: ("time", "s"),
    y: [("relaxation stiffness", "N/m"), ("relaxation modulus", "Pa")],
    kinds: &[Kind { curve: ModelCurve::Relaxation, name: "relaxation", colour: 0 }],
};

/// Creep function `J(t)` over time.
pub const CREEP: ModelFigure = ModelFigure {
    name: "creep",
    titles: ["Creep compliance"; 2],
    x: ("time", "s"),
    y: [("creep compliance", "m/N"), ("creep compliance", "1/Pa")],
    kinds: &[Kind { curve: ModelCurve::Creep, name: "creep", colour: 0 }],
};

/// Storage and loss over angular frequency, in a dark and a light colour, which differ in print without colours too.
pub const SWEEP: ModelFigure = ModelFigure {
    name: "sweep",
    titles: ["Storage and loss stiffness", "Storage and loss modulus"],
    x: ("angular frequency", "rad/s"),
    y: [("stiffness", "N/m"), ("modulus", "Pa")],
    kinds: &[
        Kind { curve: ModelCurve::Storage, name: "storage", colour: 0 },
        Kind { curve: ModelCurve::Loss, name: "loss", colour: 4 },
    ],
};

/// Loss factor `tan δ`, the ratio of loss to storage, over angular frequency.
pub const LOSS_FACTOR: ModelFigure = ModelFigure {
    name: "loss-factor",
    titles: ["Loss factor"; 2],
    x: ("angular frequency", "rad/s"),
    y: [("loss factor tan δ", ""); 2],
    kinds: &[Kind { curve: ModelCurve::LossFactor, name: "loss factor", colour: 0 }],
};

/// A figure drawn from one model, or from several that are compared; both axes are logarithmic.
#[derive(Debug, Clone, Copy)]
pub struct ModelFigure {
    /// Name in files and on the command line, as in `relaxation`.
    pub name: &'static str,
    /// Heading for pads and for materials.
    titles: [&'static str; 2],
    /// Quantity and unit along the horizontal axis.
    x: (&'static str, &'static str),
    /// Quantity and unit along the vertical axis, for pads and for materials.
    y: [(&'static str, &'static str); 2],
    kinds: &'static [Kind],
}

/// A curve that ends falling as this power of time or faster ends at the last place where it does not: the rest of an
/// exponential decay would take up all of a logarithmic axis.
const STEEPEST: f64 = -10.0;

impl ModelFigure {
    /// The chart of `models`, all of them of pads or all of materials; what they have nothing of stays empty.
    pub fn chart(&self, models: &[ModelSeries], subject: ModelSubject) -> Chart {
        let at = usize::from(subject == ModelSubject::Material);
        let is_relaxation = self.name == RELAXATION.name;
        let cut: Option<Vec<ModelSeries>> =
            is_relaxation.then(|| models.iter().map(without_decay).collect());
        let mut drawn = draw(cut.as_deref().unwrap_or(models), self.kinds);
        let is_cut = |(cut, whole): (&ModelSeries, &ModelSeries)| {
            cut.relaxation.len() < whole.relaxation.len()
        };
        if cut.iter().flatten().zip(models).any(is_cut) {
            drawn.note_also("final decay shown until it falls as t⁻¹⁰");
        }
        if let [model] = models
            && is_relaxation
            && !model.spectrum.is_empty()
        {
            let (name, points) = ("spectrum: K over τ", model.spectrum.clone());
            drawn.series.push(Series::drawn(name, (1, Pattern::Stems), points));
        }
        Chart {
            title: self.titles[at].into(),
            note: drawn.note,
            x_label: self.x.0.into(),
            y_label: self.y[at].0.into(),
            x_scale: Scale::logarithmic(self.x.1),
            y_scale: Scale::logarithmic(self.y[at].1),
            series: drawn.series,
            ..Chart::default()
        }
    }
}

/// What the figure of relaxation shows of a model but its spectrum.
fn without_decay(model: &ModelSeries) -> ModelSeries {
    ModelSeries {
        name: model.name.clone(),
        relaxation: model.relaxation[..before_decay(&model.relaxation)].to_vec(),
        ..ModelSeries::default()
    }
}

/// Number of points before the final exponential decay.
fn before_decay(points: &[(f64, f64)]) -> usize {
    let is_steep = |pair: &[(f64, f64)]| {
        let slope = (pair[1].1 / pair[0].1).ln() / (pair[1].0 / pair[0].0).ln();
        !(pair[0].0 > 0.0 && slope > STEEPEST)
    };
    let steep = points.windows(2).rev().take_while(|pair| is_steep(pair)).count();
    let kept = points.len() - steep;
    if kept < 2 { points.len() } else { kept }
}

#[cfg(test)]
mod tests;
