//! Conversion and comparison of models of many modes.
//!
//! `cargo bench -p dashpot-benches --bench models`. Conversion of 60 modes is meant to stay below 1 ms, and the
//! comparison of two models of 30 modes, one of each form, below 10 ms.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion};
use dashpot::rheology::{
    Canonical, LinearModel,
    Primitive::{self, Dashpot, Spring},
    Tree,
    equivalence::compare,
    sensitivity::sensitivity,
};

/// Maxwell elements side by side, their times over 24 decades and their weights over 15.
fn prony(modes: u32) -> Tree<Primitive> {
    let element = |at: u32| {
        let share = f64::from(at) / f64::from(modes - 1);
        let (time, weight) = (10_f64.powf(24.0 * share - 12.0), 10_f64.powf(7.5 - 15.0 * share));
        Tree::series([Spring(weight).into(), Dashpot(weight * time).into()])
    };
    Tree::parallel((0..modes).map(element))
}

fn model(tree: &Tree<Primitive>) -> LinearModel {
    LinearModel::of(tree, |&part| part)
}

fn main() {
    let mut criterion = Criterion::default().configure_from_args();
    let mut group = criterion.benchmark_group("models");
    for modes in [11, 30, 60] {
        let tree = prony(modes);
        group.bench_function(BenchmarkId::new("both forms of a Prony series", modes), |bench| {
            bench.iter(|| model(black_box(&tree)));
        });
    }
    let maxwell = prony(30);
    let Some(kelvin) = model(&maxwell).tree(Canonical::Kelvin) else { return };
    group.bench_function("comparison of 30 modes", |bench| {
        bench.iter(|| compare(&model(black_box(&maxwell)), &model(black_box(&kelvin))).is_same);
    });
    group.bench_function("comparison of 30 modes, with the map of their parameters", |bench| {
        bench.iter(|| {
            let is_same = compare(&model(black_box(&maxwell)), &model(black_box(&kelvin))).is_same;
            let [first, second] = [&maxwell, &kelvin].map(|own| sensitivity(own, |&part| part));
            let map = first.zip(second).and_then(|(first, second)| first.map_to(&second));
            (is_same, map.map(|own| own.condition()))
        });
    });
    group.finish();
    criterion.final_summary();
}
