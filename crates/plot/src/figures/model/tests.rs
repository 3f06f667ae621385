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
        markers: Vec::new(),
    }
}

#[test]
fn names_are_unique_and_every_figure_draws_both_models() {
    let models = [zener("A"), zener("B")];
    for (i, figure) in MODEL_FIGURES.iter().enumerate() {
        assert!(MODEL_FIGURES[..i].iter().all(|other| other.name() != figure.name()));
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
            assert!(chart.series.is_empty(), "{}", figure.name());
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
fn a_marker_appears_in_the_figure_of_its_curve_only() {
    let label = "worst: 3 % at 500 rad/s".to_owned();
    let marker = ModelMarker { curve: ModelCurve::Loss, at: 500.0, value: 1e7, label };
    let models = [ModelSeries { markers: vec![marker], ..zener("A") }, zener("B")];
    for figure in MODEL_FIGURES {
        let chart = figure.chart(&models, ModelSubject::Pad);
        assert_eq!(chart.markers.len(), usize::from(figure.name() == "sweep"));
        assert!(chart.markers.iter().all(|m| (m.x, m.y) == (500.0, 1e7)));
    }
}

#[test]
fn what_is_not_shown_is_said() {
    let spring = ModelSeries {
        storage: over(-1, 5, |_| 1e6),
        loss: over(-1, 5, |_| 0.0),
        ..zener("spring")
    };
    let chart = Sweep.chart(&[spring], ModelSubject::Pad);
    assert_eq!(chart.note, "loss of spring is zero");
    assert_eq!(chart.series.len(), 1);

    let liquid = ModelSeries { storage: over(-20, 2, |w| w * w), ..zener("liquid") };
    let chart = Sweep.chart(&[liquid], ModelSubject::Pad);
    assert!(chart.note.contains("10⁻²⁴"), "{}", chart.note);

    let many: Vec<ModelSeries> = (0..6).map(|i| zener(&format!("model {i}"))).collect();
    let chart = Creep.chart(&many, ModelSubject::Pad);
    assert_eq!((chart.note.as_str(), chart.series.len()), ("the first 4 of 6 models", 4));
    let patterns: std::collections::HashSet<Pattern> =
        chart.series.iter().filter_map(|s| s.stroke.map(|s| s.pattern)).collect();
    assert_eq!(patterns.len(), 4);
}
