//! Single runs, from a network to its report: by hand and by ours.

use std::{cell::RefCell, hint::black_box};

use dashpot::analysis::{Accuracy, Solve, SolveSettings, sweep::ScenePoint};

use super::{
    Contender, foam, impact, race, record,
    thesis::{self, Besides},
    tolerance, tolerances,
};

/// The height of the drop \[m\].
const HEIGHT: f64 = 0.8;
/// How many tolerances that suffice are tried for the one of the least work.
const NEXT: usize = 8;
/// A tolerance at which what is by hand counts as true.
const FINEST: f64 = 1e-12;

/// A scene that is not linear.
struct Run<'r> {
    name: &'r str,
    scene: ScenePoint,
    keys: &'r [&'r str],
    /// The same measures by hand, at a tolerance.
    by_hand: &'r dyn Fn(f64) -> Vec<f64>,
}

pub(crate) fn runs() {
    let knee = RefCell::new(record::Knee::new());
    let only = std::env::var("RUN").unwrap_or_default();
    for run in [
        Run {
            name: "a drop on foam",
            scene: foam::scene(HEIGHT),
            keys: &foam::KEYS,
            by_hand: &|rtol| foam::by_hand(black_box(HEIGHT), rtol).to_vec(),
        },
        Run {
            name: "a pad that stiffens",
            scene: Besides::Stiffening.scene(),
            keys: &thesis::KEYS,
            by_hand: &|rtol| black_box(Besides::Stiffening).by_hand(rtol).to_vec(),
        },
        Run {
            name: "a pad with a stop",
            scene: Besides::Stop(0).scene(),
            keys: &thesis::KEYS,
            by_hand: &|rtol| black_box(Besides::Stop(0)).by_hand(rtol).to_vec(),
        },
        Run {
            name: "a knee under a measured pulse",
            scene: record::scene(),
            keys: &record::KEYS,
            by_hand: &|rtol| black_box(&knee).borrow_mut().by_hand(rtol).to_vec(),
        },
    ] {
        if run.name.contains(only.as_str()) {
            [1e-3, 1e-6].into_iter().for_each(|accuracy| run.race(accuracy));
        }
    }
    reference();
}

impl Run<'_> {
    /// Times the run with errors, and a single solution of it that is as good, beside that by hand.
    fn race(&self, accuracy: f64) {
        let truth = (self.by_hand)(FINEST);
        let off = |own: &[f64]| {
            let all = own.iter().zip(&truth).map(|(own, truth)| (own / truth - 1.0).abs());
            all.fold(0.0, f64::max)
        };
        let by_hand = tolerance(|rtol| off(&(self.by_hand)(rtol)) < accuracy);
        let with = |rtol: Option<f64>| {
            let settings = SolveSettings {
                accuracy: Accuracy::of_all(accuracy),
                estimate: rtol.is_none(),
                rtol,
                ..self.scene.settings.clone()
            };
            ScenePoint { network: self.scene.network.clone(), settings }
        };
        let measured = |scene: &ScenePoint| -> Vec<f64> {
            let report = black_box(&scene.network).solve_with(&scene.settings).expect("a run");
            self.keys.iter().map(|key| report.value(key).expect("a measure")).collect()
        };
        let full = with(None);
        // What is coarser may be solved a slower way.
        let good = tolerances().filter(|rtol| off(&measured(&with(Some(*rtol)))) < accuracy);
        let work = |rtol: &f64| {
            let scene = with(Some(*rtol));
            scene.network.solve_with(&scene.settings).expect("a run").solver.work
        };
        let own = good.take(NEXT).min_by_key(work).expect("a tolerance");
        let single = with(Some(own));
        race(
            &format!("{} to {accuracy:.0e}", self.name),
            &[
                Contender {
                    name: "by hand: order 5, events",
                    scenes: 1,
                    solve: Box::new(|| (self.by_hand)(by_hand)[0]),
                },
                Contender {
                    name: "with errors",
                    scenes: 1,
                    solve: Box::new(|| measured(&full)[0]),
                },
                Contender {
                    name: "without errors",
                    scenes: 1,
                    solve: Box::new(|| measured(&single)[0]),
                },
            ],
        );
        let [first, last] = [&full, &single].map(|scene| off(&measured(scene)));
        println!(
            "off by: by hand {:.1e} at {by_hand:.0e}, ours {first:.1e}, and {last:.1e} at {own:.0e}",
            off(&(self.by_hand)(by_hand))
        );
    }
}

fn reference() {
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
