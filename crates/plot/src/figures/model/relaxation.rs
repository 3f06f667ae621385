//! Relaxation function over time.

use super::curves::{Kind, draw};
use super::{ModelCurve, ModelFigure, ModelSeries, ModelSubject};
use crate::{Chart, Pattern, Scale, Series, Stroke};

/// A curve that ends falling as this power of time or faster ends at the last place where it does not: the rest of an
/// exponential decay would take up all of a logarithmic axis.
const STEEPEST: f64 = -10.0;

/// Relaxation function `G(t)` over time, and of a single model the lines of its spectrum: the strength `K_j` at each
/// relaxation time `τ_j`.
#[derive(Debug, Clone, Copy)]
pub struct Relaxation;

impl ModelFigure for Relaxation {
    fn name(&self) -> &'static str {
        "relaxation"
    }

    fn title(&self, subject: ModelSubject) -> &'static str {
        match subject {
            ModelSubject::Pad => "Relaxation stiffness",
            ModelSubject::Material => "Relaxation modulus",
        }
    }

    fn chart(&self, models: &[ModelSeries], subject: ModelSubject) -> Chart {
        let kinds = [Kind { curve: ModelCurve::Relaxation, name: "relaxation", colour: 0 }];
        let cut: Vec<ModelSeries> = models.iter().map(without_decay).collect();
        let mut drawn = draw(&cut, &kinds);
        if cut.iter().zip(models).any(|(cut, whole)| cut.relaxation.len() < whole.relaxation.len())
        {
            drawn.remark("final decay shown until it falls as t⁻¹⁰");
        }
        if let [model] = models
            && !model.spectrum.is_empty()
        {
            drawn.series.push(Series {
                name: "spectrum: K over τ".into(),
                points: model.spectrum.clone(),
                stroke: Some(Stroke { colour: 1, pattern: Pattern::Stems }),
            });
        }
        Chart {
            title: self.title(subject).into(),
            note: drawn.note,
            x_label: "time".into(),
            y_label: format!("relaxation {}", subject.stiffness()),
            x_scale: Scale::logarithmic("s"),
            y_scale: Scale::logarithmic(subject.stiffness_unit()),
            series: drawn.series,
            markers: drawn.markers,
            ..Chart::default()
        }
    }
}

/// What this figure shows of a model but its spectrum.
fn without_decay(model: &ModelSeries) -> ModelSeries {
    ModelSeries {
        name: model.name.clone(),
        relaxation: model.relaxation[..before_decay(&model.relaxation)].to_vec(),
        markers: model.markers.clone(),
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
mod tests {
    use super::*;

    fn sampled(relaxation: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        let times = (-120..=120).map(|i| 10_f64.powf(f64::from(i) / 40.0));
        times.map(|t| (t, relaxation(t))).collect()
    }

    #[test]
    fn a_liquid_is_shown_to_ten_relaxation_times_and_a_solid_to_its_end() {
        let liquid = sampled(|t| 1e6 * (-t / 3.0).exp());
        let last = liquid[before_decay(&liquid) - 1].0;
        // The mean slope between neighbours is −t/τ between them, which are 6 % apart.
        assert!((28.0..32.0).contains(&last), "{last}");
        let solid = sampled(|t| 1e-6 + 1e6 * (-t / 3.0).exp());
        assert_eq!(before_decay(&solid), solid.len());
        let zero = sampled(|t| if t < 1.0 { 1.0 } else { 0.0 });
        assert_eq!(before_decay(&zero), 120);
        let model = ModelSeries { relaxation: liquid, ..ModelSeries::default() };
        let chart = Relaxation.chart(&[model], ModelSubject::Pad);
        assert_eq!(chart.note, "final decay shown until it falls as t⁻¹⁰");
    }

    #[test]
    fn only_a_single_model_shows_its_spectrum() {
        let model = ModelSeries {
            name: "pad".into(),
            relaxation: sampled(|t| 1e3 + 1e6 * (-t).exp()),
            spectrum: vec![(1.0, 1e6)],
            ..ModelSeries::default()
        };
        let names = |models: &[ModelSeries]| -> Vec<String> {
            let chart = Relaxation.chart(models, ModelSubject::Pad);
            chart.series.into_iter().map(|s| s.name).collect()
        };
        assert_eq!(names(std::slice::from_ref(&model)), ["pad", "spectrum: K over τ"]);
        assert_eq!(names(&[model.clone(), model]), ["pad", "pad"]);
    }
}
