//! Tests of all figures of models at once, with models in closed form.

use super::*;
use crate::well_formed::assert_well_formed;
use crate::{Pattern, Series};

/// Samples over decades, forty in each.
pub(super) fn over(from: i32, to: i32, value: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let places = (40 * from..=40 * to).map(|i| 10_f64.powf(f64::from(i) / 40.0));
    places.map(|x| (x, value(x))).collect()
}

/// A Zener element: a spring of 1 MN/m beside a Maxwell element of 20 MN/m with a relaxation time of 2 ms.
pub(super) fn zener(name: &str) -> ModelSeries {
    let (equilibrium, strength, time) = (1e6, 2e7, 2e-3);
    let retardation = time * (equilibrium + strength) / equilibrium;
    let storage = move |w: f64| {
        let x = (w * time).powi(2);
        equilibrium + strength * x / (1.0 + x)
    };
    let loss = move |w: f64| strength * w * time / (1.0 + (w * time).powi(2));
    ModelSeries {
        name: name.into(),
        relaxation: over(-5, 1, |t| equilibrium + strength * (-t / time).exp()),
        spectrum: vec![(time, strength)],
        creep: over(-5, 1, |t| {
            let share = strength / (equilibrium + strength);
            (1.0 - share * (-t / retardation).exp()) / equilibrium
        }),
        storage: over(-1, 5, storage),
        loss: over(-1, 5, loss),
        loss_factor: over(-1, 5, |w| loss(w) / storage(w)),
    }
}

#[test]
fn names_are_unique_and_every_figure_draws_both_models() {
    let models = [zener("A"), zener("B")];
    for (i, figure) in MODEL_FIGURES.iter().enumerate() {
        assert!(MODEL_FIGURES[..i].iter().all(|other| other.name != figure.name));
        for subject in [ModelSubject::Pad, ModelSubject::Material] {
            let chart = figure.chart(&models, subject);
            let drawn = |pattern| {
                let is_drawn = |s: &&Series| s.stroke.is_some_and(|s| s.pattern == pattern);
                chart.series.iter().filter(is_drawn).count()
            };
            let kinds = chart.series.len() / 2;
            assert_eq!((drawn(Pattern::Broad), drawn(Pattern::Dashed)), (kinds, kinds));
            assert_well_formed(&chart.svg().unwrap());
            assert_eq!(chart.note, "");
        }
    }
}

#[test]
fn every_figure_draws_from_nothing() {
    for figure in MODEL_FIGURES {
        for models in [vec![], vec![ModelSeries::default()]] {
            let chart = figure.chart(&models, ModelSubject::Pad);
            assert!(chart.series.is_empty(), "{}", figure.name);
            assert_well_formed(&chart.svg().unwrap());
        }
    }
}

#[test]
fn units_stand_at_the_ticks_or_behind_the_quantity() {
    let texts = |subject| MODEL_FIGURES.iter().map(move |f| f.chart(&[zener("pad")], subject));
    let pad: String = texts(ModelSubject::Pad).map(|chart| chart.text(80, 16)).collect();
    for part in ["10 MN/m ┤", "100 nm/N ┤", "1 ms", "angular frequency (rad/s)"] {
        assert!(pad.contains(part), "{part} in\n{pad}");
    }
    let material: String = texts(ModelSubject::Material).map(|chart| chart.text(80, 16)).collect();
    for part in ["10 MPa ┤", "creep compliance (1/Pa)", "10⁻⁷ ┤", "relaxation modulus"] {
        assert!(material.contains(part), "{part} in\n{material}");
    }
}

#[test]
fn what_is_not_shown_is_said() {
    let spring = ModelSeries {
        storage: over(-1, 5, |_| 1e6),
        loss: over(-1, 5, |_| 0.0),
        ..zener("spring")
    };
    let chart = SWEEP.chart(&[spring], ModelSubject::Pad);
    assert_eq!(chart.note, "loss of spring is zero");
    assert_eq!(chart.series.len(), 1);

    let liquid = ModelSeries { storage: over(-20, 2, |w| w * w), ..zener("liquid") };
    let chart = SWEEP.chart(&[liquid], ModelSubject::Pad);
    assert!(chart.note.contains("10⁻²⁴"), "{}", chart.note);

    let many: Vec<ModelSeries> = (0..6).map(|i| zener(&format!("model {i}"))).collect();
    let chart = CREEP.chart(&many, ModelSubject::Pad);
    assert_eq!((chart.note.as_str(), chart.series.len()), ("the first 4 of 6 models", 4));
    let patterns: std::collections::HashSet<Pattern> =
        chart.series.iter().filter_map(|s| s.stroke.map(|s| s.pattern)).collect();
    assert_eq!(patterns.len(), 4);
}

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
    let chart = RELAXATION.chart(&[model], ModelSubject::Pad);
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
        let chart = RELAXATION.chart(models, ModelSubject::Pad);
        chart.series.into_iter().map(|s| s.name).collect()
    };
    assert_eq!(names(std::slice::from_ref(&model)), ["pad", "spectrum: K over τ"]);
    assert_eq!(names(&[model.clone(), model]), ["pad", "pad"]);
}
