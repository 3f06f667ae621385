//! Single runs, from a network to its report: by hand and by ours.

use std::hint::black_box;

use dashpot::analysis::{Accuracy, Solve, SolveSettings, sweep::ScenePoint};

use super::{Contender, foam, impact, race, tolerance_by_hand};

/// The height of the drop \[m\].
const HEIGHT: f64 = 0.8;

pub(crate) fn runs() {
    for accuracy in [1e-3, 1e-6] {
        let rtol = tolerance_by_hand(accuracy);
        let scene = foam::scene(HEIGHT);
        let with = |estimate: bool| {
            let accuracy = Accuracy::of_all(accuracy);
            let rtol = (!estimate).then_some(rtol);
            let settings = SolveSettings { accuracy, estimate, rtol, ..scene.settings.clone() };
            ScenePoint { network: scene.network.clone(), settings }
        };
        let (full, single) = (with(true), with(false));
        let solved = |scene: &ScenePoint| {
            let report = black_box(&scene.network).solve_with(&scene.settings).expect("a run");
            report.value("pad.peak-force").expect("a force")
        };
        race(
            &format!("a run of a drop on foam to {accuracy:.0e}"),
            &[
                Contender {
                    name: "by hand: order 5, events",
                    scenes: 1,
                    solve: Box::new(|| foam::by_hand(black_box(HEIGHT), rtol)[0]),
                },
                Contender { name: "with errors", scenes: 1, solve: Box::new(|| solved(&full)) },
                Contender {
                    name: "without errors",
                    scenes: 1,
                    solve: Box::new(|| solved(&single)),
                },
            ],
        );
    }
    let reference = impact::network(1, 1e4);
    let settings = SolveSettings::lasting(0.02);
    let solve = || {
        let report = black_box(&reference).solve_with(&settings).expect("a run");
        report.value("padding.peak-force").expect("a force")
    };
    race(
        "a run of the reference impact",
        &[
            Contender {
                name: "by hand: exponential and 500 products",
                scenes: 1,
                solve: Box::new(|| {
                    super::scene_by_hand(black_box(&impact::Impact::with_mount(0.2)))
                }),
            },
            Contender { name: "network to report", scenes: 1, solve: Box::new(solve) },
        ],
    );
}
