//! Laws that are written as formulas beside the built-in ones of the same form.

use std::hint::black_box;

use dashpot::{
    analysis::{
        Solve, SolveSettings,
        sweep::{Grid, ScenePoint, SweepOptions},
    },
    network::{
        Element, Network, Node,
        effects::Separation,
        elements::{CubicSpring, Dashpot, Formula, StiffeningSpring},
        parameters, part,
    },
    rheology::Tree,
};

use super::{Contender, asked, ours, race};

/// Scenes of a sweep.
const SCENES: usize = 200;

/// A mass on a pad of a spring and a dashpot, with separation.
fn scene(spring: impl Element + 'static, speed: f64) -> ScenePoint {
    let mut network = Network::new();
    let head = network.add_node(Node::mass("head", 5.0).moving(speed));
    let pad = Tree::parallel([part(spring), part(Dashpot { damping: 80.0 })]);
    network.connect("pad", head, network.ground(), pad).thickness = Some(0.05);
    network.add_effect(Separation { element: "pad".to_owned(), at: None, restitution: 0.0 });
    ScenePoint { network, settings: SolveSettings::lasting(0.05) }
}

fn formula(text: &str) -> Formula {
    let text = parameters::Formula::parse(text, &|name| ["y", "v"].contains(&name));
    Formula::new(text.expect("a formula"), None, None).expect("a law")
}

pub(crate) fn formulas() {
    pair(
        "a cubic spring",
        CubicSpring { stiffness: 2e4, cubic: 6e7 },
        &formula("20 kN/m * y + 60 MN/m^3 * y^3"),
    );
    pair(
        "a spring that stiffens, tan",
        StiffeningSpring { stiffness: 2e4, limit: 0.06 },
        &formula("2 * 20 kN/m * 6 cm / pi * tan(pi * y / (2 * 6 cm))"),
    );
}

fn pair(title: &str, law: impl Element + Copy + 'static, formula: &Formula) {
    let keys = ["pad.peak-force", "pad.peak-deformation"];
    let columns = asked(&scene(law, 3.0), &keys);
    let grid = Grid::new(vec![SCENES]).expect("a grid");
    let solved = |scene: &ScenePoint| {
        let report = black_box(&scene.network).solve_with(&scene.settings).expect("a run");
        report.value("pad.peak-force").expect("a force")
    };
    let speed = |place: usize| 1.0 + 2.0 * place as f64 / (SCENES - 1) as f64;
    let options = SweepOptions { threads: 1, ..SweepOptions::default() };
    let swept = |pose: &(dyn Fn(&[usize]) -> ScenePoint + Sync)| {
        ours(&grid, &columns, options, pose).values[0]
    };
    let built_in = |name, scenes, solve| Contender { name, scenes, solve };
    race(
        &format!("{title}: a run"),
        &[
            built_in("built in", 1, Box::new(|| solved(&scene(law, 3.0)))),
            built_in("as a formula", 1, Box::new(|| solved(&scene(formula.clone(), 3.0)))),
        ],
    );
    race(
        &format!("{title}: a sweep"),
        &[
            built_in("built in", SCENES, Box::new(|| swept(&|at| scene(law, speed(at[0]))))),
            built_in(
                "as a formula",
                SCENES,
                Box::new(|| swept(&|at| scene(formula.clone(), speed(at[0])))),
            ),
        ],
    );
}
